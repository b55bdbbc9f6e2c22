//! How far the paper's team gets under `budget`, by rate, form and tick: the table in `budget::settings::fraction_of_rate`.
//!
//! `cargo run --release -p closeranks-core --example budget_spread`
//!
//! Eleven robots from the hexagonal patch `inside`, the paper's desired motion, no attack, 10 s; mean radius of gyration
//! over twelve assignments of robots to places. Least h and least distance are asserted along the way.

use closeranks_core::controller::budget::curvature::Curvature;
use closeranks_core::controller::budget::errors::ErrorBounds;
use closeranks_core::controller::budget::knowledge::{Claim, Sighting};
use closeranks_core::controller::budget::rows::Memory;
use closeranks_core::controller::budget::settings::{Assume, Budget, Form, Trust, fraction_of_rate};
use closeranks_core::equations::link::LinkShape;
use closeranks_core::need::Need;
use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};
use closeranks_core::program::InputBox;
use closeranks_core::program::balls::reach::Reach;
use closeranks_core::program::balls::row::Row;
use closeranks_core::robot::neighbor::RobotId;

const ROBOTS: usize = 11;
const ASSIGNMENTS: u64 = 12;
const DURATION_S: f64 = 10.0;
/// Column in half spacings and row of each place.
const PLACES: [[f64; 2]; ROBOTS] = [
    [-3.0, -1.0],
    [2.0, 0.0],
    [0.0, 0.0],
    [-1.0, -1.0],
    [1.0, 1.0],
    [3.0, 1.0],
    [-1.0, 1.0],
    [-2.0, 0.0],
    [3.0, -1.0],
    [1.0, -1.0],
    [-3.0, 1.0],
];

#[expect(clippy::print_stdout, reason = "a report")]
fn main() {
    let rates = [0.5, 1.0, 2.0, 4.0, 8.0, 40.0];
    println!("{:28}{}", "rate, 1/s", rates.map(|rate| format!("{rate:>8}")).concat());
    for period_s in [0.005, 0.05] {
        for (form, assume) in
            [(Form::Level, Assume::Obedient), (Form::Link, Assume::Obedient), (Form::Link, Assume::Free)]
        {
            let cells = rates.map(|rate| {
                let team = settings(fraction_of_rate(rate, period_s), period_s, form, assume);
                let sum: f64 = (0..ASSIGNMENTS).map(|assignment| run(&team, period_s, assignment)).sum();
                format!("{:8.4}", sum / 12.0)
            });
            println!("{:28}{}", format!("{form:?} {assume:?} {period_s} s"), cells.concat());
        }
    }
}

fn reach(period_s: f64) -> Reach<2> {
    Reach::new(&InputBox { min_m_s: [-1.5; 2], max_m_s: [1.5; 2] }, period_s)
}

fn settings(gamma: f64, period_s: f64, form: Form, assume: Assume) -> Budget {
    Budget {
        curvature: Curvature::new(LinkShape { radius_m: 3.0, q1: 2.099, q2: 0.3 }),
        need: Need::new(11, 2, assume.keep()),
        faults: 2,
        distance_min_m: 0.3,
        move_max_m: reach(period_s).longest_m(),
        gamma,
        gain_slope: 0.0,
        gamma_c: 0.2,
        trust: Trust::ToldOrSeen,
        assume,
        form,
        errors: ErrorBounds::NONE,
    }
}

/// Radius of gyration at the end, m.
fn run(budget: &Budget, period_s: f64, assignment: u64) -> f64 {
    let mut positions = start(assignment);
    let mut time_s = 0.5 * period_s;
    while time_s < DURATION_S {
        positions = tick(budget, period_s, &positions);
        time_s += period_s;
    }
    let center = positions.iter().fold([0.0; 2], |sum, x| add_scaled(&sum, 1.0 / 11.0, x));
    let square = |x: &Vector<2>| dot(&subtract(x, &center), &subtract(x, &center));
    (positions.iter().map(square).sum::<f64>() / 11.0).sqrt()
}

fn start(assignment: u64) -> [Vector<2>; ROBOTS] {
    let (mut places, mut state) = (PLACES, assignment);
    for last in (1..ROBOTS).rev() {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        places.swap(last, usize::try_from(state >> 33).unwrap_or(0) % (last + 1));
    }
    places.map(|[column, row]| [0.3 * column, 0.6 * 0.75_f64.sqrt() * row])
}

fn tick(budget: &Budget, period_s: f64, positions: &[Vector<2>; ROBOTS]) -> [Vector<2>; ROBOTS] {
    let offsets: [Vec<Sighting<2>>; ROBOTS] = core::array::from_fn(|i| sightings(positions, i));
    let levels: [f64; ROBOTS] =
        core::array::from_fn(|i| budget.level(id(i), &offsets[i], &mut [0.0; ROBOTS]));
    core::array::from_fn(|i| {
        let others = (0..ROBOTS).filter(|&j| j != i && in_range(positions, i, j));
        let heard: Vec<Sighting<2>> = others
            .zip(&offsets[i])
            .map(|(j, sighting)| Sighting {
                claim: Some(Claim { level: levels[j], age_ticks: 0 }),
                ..*sighting
            })
            .collect();
        let memory = Memory { rows: &mut [Row::default(); 25], weights: &mut [0.0; 100] };
        let desired_m = desired(i, &positions[i], period_s);
        let mut rows = budget.rows(id(i), &heard, &desired_m, reach(period_s), memory);
        assert!(rows.h >= -1e-12, "h is {}", rows.h);
        assert!(heard.iter().all(|sighting| length(&sighting.offset_m) >= 0.3 - 1e-12));
        add_scaled(&positions[i], 1.0, &rows.closest().displacement_m)
    })
}

fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap_or(u16::MAX))
}

fn in_range(positions: &[Vector<2>; ROBOTS], i: usize, j: usize) -> bool {
    let offset = subtract(&positions[i], &positions[j]);
    dot(&offset, &offset) <= 9.0
}

fn sightings(positions: &[Vector<2>; ROBOTS], i: usize) -> Vec<Sighting<2>> {
    (0..ROBOTS)
        .filter(|&j| j != i && in_range(positions, i, j))
        .map(|j| Sighting::new(id(j), subtract(&positions[i], &positions[j]), None))
        .collect()
}

/// `v = (−1)^i · 100 e_d − x_i`, `T v/‖v‖`, m; robots 1 to 5 along the first axis.
fn desired(index: usize, position: &Vector<2>, period_s: f64) -> Vector<2> {
    let (number, axis) = (index + 1, usize::from(index >= 5));
    let mut toward = position.map(|component| -component);
    toward[axis] += if number.is_multiple_of(2) { 100.0 } else { -100.0 };
    let distance = length(&toward);
    toward.map(|component| period_s * component / distance)
}
