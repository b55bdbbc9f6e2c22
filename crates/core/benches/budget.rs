//! One robot under `budget`: its rows, the closest point, both.
//!
//! `cargo bench -p closeranks-core --bench budget`

mod offsets;

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
use divan::{Bencher, black_box};
use offsets::OFFSETS;

fn main() {
    divan::main();
}

/// Few rows cut the box at 5 ms, nearly all at 50 ms.
const PERIODS_S: [f64; 2] = [0.005, 0.05];

fn scene<const D: usize>(period_s: f64, assume: Assume, form: Form) -> (Budget, Reach<D>, [Sighting<D>; 10]) {
    let reach = Reach::new(&InputBox::of([-1.5; D], [1.5; D]), period_s);
    let budget = Budget {
        curvature: Curvature::new(LinkShape { radius_m: 3.0, q1: 2.099, q2: 0.3 }),
        need: Need::new(11, 2, assume.keep()),
        faults: 2,
        distance_min_m: 0.3,
        move_max_m: reach.longest_m(),
        gamma: 0.2,
        gamma_c: 0.2,
        assume,
        form,
        errors: ErrorBounds::NONE,
    };
    let mut ids = (2..).map(RobotId);
    let sightings = OFFSETS.map(|[x, y]| {
        let id = ids.next().unwrap_or(RobotId(0));
        Sighting::new(id, core::array::from_fn(|d| [x, y, 0.3 * x * y][d]))
    });
    (budget, reach, sightings)
}

fn whole<const D: usize>(bencher: Bencher<'_, '_>, period_s: f64, assume: Assume, form: Form) {
    let (budget, reach, sightings) = scene::<D>(period_s, assume, form);
    let (mut rows, mut weights) = ([Row::default(); 27], [0.0; 100]);
    let mut desired = [0.0; D];
    desired[0] = -period_s;
    bencher.bench_local(|| {
        let memory = Memory { rows: &mut rows, weights: &mut weights };
        budget.rows(RobotId(1), black_box(&sightings), black_box(&desired), reach, memory).closest()
    });
}

#[divan::bench(args = PERIODS_S)]
fn links_of_ten_neighbours(bencher: Bencher<'_, '_>, period_s: f64) {
    whole::<2>(bencher, period_s, Assume::Obedient, Form::Link);
}

#[divan::bench(args = PERIODS_S)]
fn levels_of_ten_neighbours(bencher: Bencher<'_, '_>, period_s: f64) {
    whole::<2>(bencher, period_s, Assume::Obedient, Form::Level);
}

#[divan::bench(args = PERIODS_S)]
fn free_of_ten_neighbours(bencher: Bencher<'_, '_>, period_s: f64) {
    whole::<2>(bencher, period_s, Assume::Free, Form::Link);
}

#[divan::bench(args = PERIODS_S)]
fn levels_of_ten_neighbours_in_3d(bencher: Bencher<'_, '_>, period_s: f64) {
    whole::<3>(bencher, period_s, Assume::Obedient, Form::Level);
}

#[divan::bench(args = PERIODS_S)]
fn closest_of_ten_neighbours(bencher: Bencher<'_, '_>, period_s: f64) {
    let (budget, reach, sightings) = scene::<2>(period_s, Assume::Obedient, Form::Level);
    let (mut rows, mut weights) = ([Row::default(); 27], [0.0; 100]);
    let memory = Memory { rows: &mut rows, weights: &mut weights };
    let mut rows = budget.rows(RobotId(1), &sightings, &[-period_s, 0.0], reach, memory);
    bencher.bench_local(|| black_box(&mut rows).closest());
}
