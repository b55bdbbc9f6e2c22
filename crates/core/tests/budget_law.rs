//! The theorems of docs/theory: whatever is wanted, no tick takes more than it may. Mutants of the rows do.

use budget_literal::{known, level};
use budget_team::{Builder, ROWS_MAX, Team, crate_rows};
use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::knowledge::Sighting;
use closeranks_core::controller::budget::settings::{Budget, Form};
use closeranks_core::equations::link::Link;
use closeranks_core::need::{Keep, Need};
use closeranks_core::num::{add_scaled, dot, length};
use closeranks_core::program::balls::Program;
use closeranks_core::program::balls::reach::Reach;
use closeranks_core::program::balls::row::Row;
use closeranks_core::robot::neighbor::RobotId;

mod budget_literal;
mod budget_team;
mod seeded;

const TEAMS: core::ops::Range<u64> = 0..120;
/// Seeds of teams with ranks.
const RANKED: core::ops::Range<u64> = 1_000..1_150;
/// Mutants need so many teams.
const TEAMS_FOR_MUTANTS: core::ops::Range<u64> = 0..240;
const TICKS: usize = 25;

/// Runs teams until one breaks the law, and returns how many ticks went by.
fn law<const D: usize>(
    assume: Assume,
    form: Form,
    teams: core::ops::Range<u64>,
    builder: Builder<'_, D>,
) -> Result<usize, String> {
    let mut ticks = 0;
    for seed in teams {
        let team = if RANKED.contains(&seed) { Team::ranked } else { Team::random };
        let Some(mut team) = team(seed, assume, form) else { continue };
        for tick in 0..TICKS {
            team.tick(builder).map_err(|broken| format!("seed {seed}, tick {tick}: {broken}"))?;
            ticks += 1;
        }
    }
    Ok(ticks)
}

fn holds<const D: usize>(assume: Assume, form: Form) {
    match law::<D>(assume, form, TEAMS, &crate_rows) {
        Ok(ticks) => assert!(ticks > 500, "only {ticks} ticks"),
        Err(broken) => panic!("{broken}"),
    }
}

//= theory thm:discrete type=test
//= theory thm:sensed type=test
//= theory eq:loss type=test
//= theory eq:far type=test
//= theory eq:near type=test
#[test]
fn the_theorem_holds_for_every_move() {
    holds::<2>(Assume::Obedient, Form::Link);
    holds::<3>(Assume::Obedient, Form::Link);
}

//= theory eq:far-prime type=test
#[test]
fn it_holds_when_leaving_one_may_be_paid_for_by_approaching_another() {
    holds::<2>(Assume::Obedient, Form::Level);
    holds::<3>(Assume::Obedient, Form::Level);
}

//= theory thm:free type=test
#[test]
fn the_theorem_for_free_liars_holds_when_malicious_robots_move_as_they_like() {
    holds::<2>(Assume::Free, Form::Link);
    holds::<3>(Assume::Free, Form::Link);
}

/// With ranks a robot loses what those who count for it take, who share what may be lost by weights and by numbers.
//= theory eq:known-ranked type=test
#[test]
fn the_theorems_hold_with_ranks() {
    for (assume, form) in
        [(Assume::Obedient, Form::Level), (Assume::Obedient, Form::Link), (Assume::Free, Form::Link)]
    {
        let ticks = law::<2>(assume, form, RANKED, &crate_rows).unwrap_or_else(|broken| panic!("{broken}"));
        assert!(ticks > 500, "only {ticks} ticks");
    }
}

/// Shares that add up to more than what may be lost break the law, and the test notices.
#[test]
fn larger_shares_break_the_law_with_ranks() {
    for form in [Form::Level, Form::Link] {
        let greedy = |budget: &Budget, own: RobotId, sightings: &[Sighting<2>], reach: Reach<2>| {
            crate_rows(&Budget { gamma: 4.0 * budget.gamma, ..*budget }, own, sightings, reach)
        };
        assert!(law(Assume::Obedient, form, RANKED, &greedy).is_err(), "{form:?}");
    }
}

/// What may be wrong with a row.
#[derive(Clone, Copy, Debug)]
struct Mutant {
    /// What the budget of every row is multiplied with.
    factor: f64,
    /// What the |v|² term is multiplied with.
    square: f64,
    /// What the move that L or κ reckons with is multiplied with.
    moves: f64,
    /// What stands in place of δ⁺, if anything does.
    degree: Option<f64>,
    near: f64,
}

const CORRECT: Mutant = Mutant { factor: 1.0, square: 1.0, moves: 1.0, degree: None, near: 1.0 };

/// The rows of docs/theory, written a second time.
fn rows<const D: usize>(
    mutant: Mutant,
    budget: &Budget,
    own: RobotId,
    sightings: &[Sighting<D>],
) -> Vec<Row<D>> {
    let shape = budget.curvature.link();
    let move_m = mutant.moves * budget.move_max_m;
    let own_h = (level(budget, own, sightings) - f64::from(budget.need.need(own))).max(0.0);
    let degree = f64::from(u32::try_from(sightings.len()).unwrap_or(0));
    let (mut rows, mut own_gradient, mut own_bend) = (Vec::new(), [0.0; D], 0.0);
    for (index, Sighting { offset_m, .. }) in sightings.iter().enumerate() {
        let known = known(budget, own, index, sightings);
        let distance_m = length(offset_m);
        if budget.form == Form::Level {
            let gradient = shape.link(offset_m).map_or([0.0; D], |link: Link<f64>| link.gradient(offset_m));
            let bend = mutant.square * budget.curvature.bend_max(distance_m, move_m, 0.0);
            let fraction = mutant.degree.unwrap_or(known.degree_max + 1.0);
            rows.push(Row::far_level(
                &gradient,
                bend,
                mutant.factor * budget.loss_max(known.budget) / fraction,
            ));
            own_gradient = add_scaled(&own_gradient, 1.0, &gradient);
            own_bend += bend;
        } else {
            let slope = budget.curvature.slope_max(distance_m, move_m, 0.0);
            let fraction = mutant.degree.unwrap_or(known.degree_max);
            let beta = mutant.factor
                * budget.beta_m2(
                    slope,
                    budget.loss_max(own_h) / degree,
                    budget.loss_max(known.budget) / fraction,
                );
            rows.push(Row::new(*offset_m, mutant.square, beta));
        }
        let spare = dot(offset_m, offset_m) - budget.distance_min_m * budget.distance_min_m;
        rows.push(Row::near(offset_m, mutant.near * 0.5 * budget.gamma_c * spare.max(0.0)));
    }
    if budget.form == Form::Level {
        let spend = mutant.factor * budget.loss_max(own_h) / (degree + 1.0);
        rows.push(Row::far_level(&own_gradient, own_bend, spend));
    }
    rows
}

#[test]
fn the_rows_written_twice_are_the_same() {
    let kept = |rows: Vec<Row<2>>, reach| {
        let mut memory = [Row::default(); ROWS_MAX];
        let mut program = Program::new(&mut memory, reach);
        for row in rows {
            program.push(row);
        }
        program.rows().to_vec()
    };
    for form in [Form::Link, Form::Level] {
        let same = |budget: &Budget, own: RobotId, sightings: &[Sighting<2>], reach: Reach<2>| {
            let rows = crate_rows(budget, own, sightings, reach);
            assert_eq!(rows, kept(self::rows(CORRECT, budget, own, sightings), reach));
            rows
        };
        law(Assume::Obedient, form, 0..6, &same).expect("the crate's rows");
    }
}

/// The law is broken when any part of a row is left out, and the test notices.
#[test]
fn every_mutant_breaks_the_law() {
    let mutants = [
        ("budget fourfold", Mutant { factor: 4.0, ..CORRECT }),
        ("no |v|²", Mutant { square: 0.0, ..CORRECT }),
        ("L and κ here and now only", Mutant { moves: 0.0, ..CORRECT }),
        ("half in place of 1/δ⁺", Mutant { degree: Some(2.0), ..CORRECT }),
        ("near twofold", Mutant { near: 2.0, ..CORRECT }),
    ];
    for (name, mutant) in mutants {
        for form in [Form::Link, Form::Level] {
            let builder = |budget: &Budget, own: RobotId, sightings: &[Sighting<2>], _: Reach<2>| {
                rows(mutant, budget, own, sightings)
            };
            match law(Assume::Obedient, form, TEAMS_FOR_MUTANTS, &builder) {
                Ok(ticks) => panic!("{name} goes unnoticed in {ticks} ticks, {form:?}"),
                Err(broken) => eprintln!("{name}, {form:?}: {broken}"),
            }
        }
    }
}

/// With free liars the theorem needs the trimmed sum.
#[test]
fn the_rows_of_assumption_1_break_when_malicious_robots_move_as_they_like() {
    type Rows = fn(&Budget, RobotId, &[Sighting<2>], Reach<2>) -> Vec<Row<2>>;
    let untrimmed: Rows = |budget, own, sightings, reach| {
        let need = Need::new(budget.need.robots(), budget.faults, Keep::Neighbors);
        let obedient = Budget { need, assume: Assume::Obedient, form: Form::Link, ..*budget };
        crate_rows(&obedient, own, sightings, reach)
    };
    match law(Assume::Free, Form::Link, TEAMS, &untrimmed) {
        Ok(ticks) => panic!("untrimmed goes unnoticed in {ticks} ticks"),
        Err(broken) => eprintln!("untrimmed: {broken}"),
    }
}

/// (far) bounds a link's loss by its distance, (far′) by the joint move. A pair whose ends have different forms is covered by
/// neither.
//= theory sec:mixing type=test
#[test]
fn robots_with_different_forms_break_the_law() {
    let mixed = |budget: &Budget, own: RobotId, sightings: &[Sighting<2>], reach: Reach<2>| {
        let bits = sightings.iter().fold(0, |bits, sighting| bits ^ sighting.offset_m[0].to_bits());
        let form = if bits & 1 == 0 { Form::Link } else { Form::Level };
        crate_rows(&Budget { form, ..*budget }, own, sightings, reach)
    };
    let broken = law(Assume::Obedient, Form::Link, TEAMS, &mixed);
    assert!(broken.is_err(), "mixed forms go unnoticed");
}
