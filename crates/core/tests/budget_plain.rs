//! The rows of a tick, computed faster than they are written down, are the ones written down: the same rows in the same
//! order, bit for bit, and so the same answer.

use budget_plain_rows::{Plain, plain};
use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::Memory;
use closeranks_core::controller::budget::curvature::Curvature;
use closeranks_core::controller::budget::knowledge::Sighting;
use closeranks_core::controller::budget::settings::{Budget, Form};
use closeranks_core::controller::errors::ErrorBounds;
use closeranks_core::equations::link::LinkShape;
use closeranks_core::need::Need;
use closeranks_core::program::InputBox;
use closeranks_core::program::balls::reach::Reach;
use closeranks_core::program::balls::row::Row;
use closeranks_core::robot::neighbor::RobotId;
use seeded::Seeded;

mod budget_literal;
mod budget_plain_rows;
mod seeded;

fn settings<const D: usize>(random: &mut Seeded, form: Form) -> (Budget, Reach<D>) {
    let period_s = [0.005, 0.005, 0.05, 0.2][random.below(4)];
    let reach = Reach::new(&InputBox::of([-1.5; D], [1.5; D]), period_s);
    let errors = [ErrorBounds::NONE, ErrorBounds::NONE, ErrorBounds::NONE, ErrorBounds::new(0.01, 0.02)]
        [random.below(4)];
    let radius_m = [0.8, 3.0, 3.0, 30.0][random.below(4)];
    let faults = [0, 2, 2, 5][random.below(4)];
    let assume = [Assume::Obedient, Assume::Obedient, Assume::Free][random.below(3)];
    let budget = Budget {
        curvature: Curvature::new(LinkShape { radius_m, q1: 2.099, q2: [0.05, 0.3, 0.9][random.below(3)] }),
        need: Need::new(11, faults, assume.keep()),
        faults,
        distance_min_m: 0.3,
        move_max_m: reach.longest_m(),
        gamma: [0.01, 0.2, 1.0][random.below(3)],
        gamma_c: [0.2, 1.0][random.below(2)],
        assume,
        form,
        errors,
    };
    (budget, reach)
}

/// Up to ten neighbours, near, at the rim, beyond it, and now and then no number.
fn sightings<const D: usize>(random: &mut Seeded, budget: &Budget) -> (RobotId, Vec<Sighting<D>>) {
    let radius_m = budget.curvature.link().radius_m;
    let wide_m = radius_m * random.between(0.2, 1.1);
    let one = |id: u16, random: &mut Seeded| {
        let mut offset_m = core::array::from_fn(|_| random.between(-wide_m, wide_m));
        match random.below(60) {
            0 => offset_m[0] = f64::NAN,
            1 => offset_m = core::array::from_fn(|d| if d == 0 { radius_m } else { 0.0 }),
            2 => offset_m = [0.0; D],
            _ => {}
        }
        Sighting::new(RobotId(id), offset_m)
    };
    let count = [10, 10, 9, random.below(11)][random.below(4)];
    let own = 1 + u16::try_from(random.below(count + 1)).unwrap_or(0);
    let others = (1..12).filter(|id| *id != own).take(count);
    (RobotId(own), others.map(|id| one(id, random)).collect())
}

fn bits<const D: usize>(rows: &[Row<D>]) -> Vec<Vec<u64>> {
    let row = |row: &Row<D>| {
        let numbers = row.normal().iter().copied().chain([row.curvature(), row.bound()]);
        numbers.map(f64::to_bits).collect()
    };
    rows.iter().map(row).collect()
}

fn check<const D: usize>(seed: u64, form: Form) {
    let mut random = Seeded(seed);
    let (budget, reach) = settings::<D>(&mut random, form);
    let (own, sightings) = sightings::<D>(&mut random, &budget);
    let step = reach.longest_m();
    let desired_m = core::array::from_fn(|_| random.between(-step, step));
    let mut memory = vec![Row::default(); 2 * D + (1 << D) * 21];
    let Plain { rows, desired_m: pushed_m, h, broken } =
        plain(&budget, own, &sightings, &desired_m, reach, &mut memory);
    // the memory for weights may be any length from 3 N on
    let enough = Budget::survey_len(budget.assume, sightings.len());
    for scratch in [3 * sightings.len(), enough.saturating_sub(1), enough, 400] {
        let mut memory = vec![Row::default(); 2 * D + (1 << D) * 21];
        let mut weights = vec![f64::NAN; scratch.max(3 * sightings.len())];
        let memory = Memory { rows: &mut memory, weights: &mut weights };
        let mut found = budget.rows(own, &sightings, &desired_m, reach, memory);
        let place = || format!("seed {seed}, {scratch} weights, {budget:?}, {sightings:?}");
        assert_eq!(bits(found.program.rows()), bits(&rows), "{}", place());
        assert_eq!(found.desired_m.map(f64::to_bits), pushed_m.map(f64::to_bits), "{}", place());
        assert_eq!((found.h.to_bits(), found.broken), (h.to_bits(), broken), "{}", place());
        let closest = found.closest().displacement_m;
        assert!(rows.iter().all(|row| row.holds(&closest)), "{}", place());
    }
}

#[test]
fn the_rows_of_levels_are_those_written_down() {
    for seed in 0..6_000 {
        check::<2>(seed, Form::Level);
        check::<3>(seed, Form::Level);
    }
}

#[test]
fn the_rows_of_links_are_those_written_down() {
    for seed in 0..3_000 {
        check::<1>(seed, Form::Link);
        check::<2>(seed, Form::Link);
    }
}
