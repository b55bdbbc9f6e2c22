//! Starts outside the set: nothing that is broken gets worse, and what can be mended is.

use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::Memory;
use closeranks_core::controller::budget::curvature::Curvature;
use closeranks_core::controller::budget::knowledge::Sighting;
use closeranks_core::controller::budget::settings::{Budget, Form};
use closeranks_core::controller::errors::ErrorBounds;
use closeranks_core::equations::link::LinkShape;
use closeranks_core::need::{Keep, Need};
use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};
use closeranks_core::program::InputBox;
use closeranks_core::program::balls::reach::Reach;
use closeranks_core::program::balls::row::Row;
use closeranks_core::robot::neighbor::RobotId;
use seeded::Seeded;

mod seeded;

/// The start that the paper prints: robots 1 and 10 stand 0.2236 m apart.
const PUBLISHED: [Vector<2>; 11] = [
    [-1.1, 0.4],
    [-0.8, -0.1],
    [0.8, -0.3],
    [0.1, -1.2],
    [0.4, -0.7],
    [-0.5, -1.0],
    [-0.9, -0.4],
    [1.0, 0.8],
    [0.4, 0.9],
    [-0.9, 0.5],
    [1.3, 0.3],
];

fn budget(form: Form) -> (Budget, Reach<2>) {
    let reach = Reach::new(&InputBox::of([-1.5; 2], [1.5; 2]), 0.005);
    let budget = Budget {
        curvature: Curvature::new(LinkShape { radius_m: 3.0, q1: 2.099, q2: 0.3 }),
        need: Need::new(11, 2, Keep::Neighbors),
        faults: 2,
        distance_min_m: 0.3,
        move_max_m: reach.longest_m(),
        gamma: 0.2,
        gamma_c: 0.2,
        assume: Assume::Obedient,
        form,
        errors: ErrorBounds::NONE,
    };
    (budget, reach)
}

fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap_or(u16::MAX))
}

struct Tick {
    positions: Vec<Vector<2>>,
    h: Vec<f64>,
    broken: usize,
}

/// One tick without lies, every robot wanting to move by `desired`.
fn tick(positions: &[Vector<2>], desired: impl Fn(usize) -> Vector<2>, form: Form) -> Tick {
    let (budget, reach) = budget(form);
    let sightings = |i: usize| -> Vec<Sighting<2>> {
        let offsets = positions.iter().enumerate().filter(|(j, _)| *j != i);
        let near = offsets.map(|(j, x)| (j, subtract(&positions[i], x))).filter(|(_, r)| dot(r, r) <= 9.0);
        near.map(|(j, offset_m)| Sighting::new(id(j), offset_m)).collect()
    };
    let mut tick = Tick { positions: Vec::new(), h: Vec::new(), broken: 0 };
    for (i, x) in positions.iter().enumerate() {
        let memory = Memory { rows: &mut [Row::default(); 25], weights: &mut [0.0; 100] };
        let mut rows = budget.rows(id(i), &sightings(i), &desired(i), reach, memory);
        tick.broken += rows.broken;
        tick.h.push(rows.h);
        let v = rows.closest().displacement_m;
        assert!(reach.contains(&v) && rows.program.rows().iter().all(|row| row.holds(&v)));
        tick.positions.push(add_scaled(x, 1.0, &v));
    }
    tick
}

fn closest_pair(positions: &[Vector<2>]) -> f64 {
    let pairs = (0..positions.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.map(|(i, j)| length(&subtract(&positions[i], &positions[j]))).fold(f64::INFINITY, f64::min)
}

//= theory sec:recovery type=test
#[test]
fn robots_that_start_too_close_part_and_nothing_gets_worse() {
    for form in [Form::Link, Form::Level] {
        let mut positions = PUBLISHED.to_vec();
        let mut ticks = 0;
        loop {
            let before = closest_pair(&positions);
            let now = tick(&positions, |_| [0.002, -0.001], form);
            if now.broken == 0 {
                break;
            }
            positions = now.positions;
            ticks += 1;
            assert!(closest_pair(&positions) >= before.min(0.3) - 1e-12, "the distance fell in tick {ticks}");
            assert!(now.h.iter().all(|&h| h > 0.0) && ticks < 100, "still broken after {ticks} ticks");
        }
        assert!(closest_pair(&positions) >= 0.3 - 1e-12, "{form:?} in {ticks} ticks");
    }
}

/// The paper's places, spread by a factor, each robot with a wish along its own place: how long until every h_i is 0 or more,
/// `None` if that takes more than 1500 ticks, and the least h_i then. The least h_i never falls on the way.
fn closes_ranks(factor: f64, wish_m: f64) -> (Option<usize>, f64) {
    let mut positions: Vec<Vector<2>> = PUBLISHED.iter().map(|x| x.map(|c| factor * c)).collect();
    let mut least = f64::NEG_INFINITY;
    for ticks in 0..1_500 {
        let now = tick(&positions, |i| positions[i].map(|component| wish_m * component), Form::Level);
        let h = now.h.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(h >= least.min(0.0) - 1e-12, "h fell from {least} to {h} in tick {ticks}");
        (least, positions) = (h, now.positions);
        if least >= 0.0 {
            return (Some(ticks), least);
        }
    }
    (None, least)
}

//= theory sec:recovery type=test
#[test]
fn a_team_that_starts_too_wide_closes_ranks() {
    let (leave, rest, gather) = (0.003, 0.0, -0.003);
    for (factor, wish_m) in [(1.4, leave), (1.4, rest), (1.6, leave), (1.6, rest), (1.75, gather)] {
        let (ticks, least) = closes_ranks(factor, wish_m);
        assert!(ticks.is_some_and(|ticks| ticks > 10), "{factor} {wish_m}: {ticks:?}, {least}");
    }
}

/// What it costs that nobody mends the h of others: from this start the team comes to a standstill unless it wishes to gather.
/// Robot 1 may not come nearer to robot 10, and robot 10 may not leave it.
//= theory sec:recovery type=test
#[test]
fn a_team_that_starts_far_too_wide_may_come_to_a_standstill() {
    let (ticks, least) = closes_ranks(1.75, 0.0);
    assert!(ticks.is_none() && (-1.4..-1.3).contains(&least), "{ticks:?}, {least}");
}

#[test]
fn any_floats_give_an_admissible_move() {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, 1e-320, 0.0, 1e-9];
    for seed in 0..2_000 {
        let mut random = Seeded(seed);
        let mut number = || odd.get(random.below(30)).copied().unwrap_or(random.between(-2.0, 2.0));
        let sightings: Vec<Sighting<2>> =
            (0..8).map(|j| Sighting::new(id(j), [number(), number()])).collect();
        let (mut budget, mut reach) = budget([Form::Link, Form::Level][usize::from(number() > 0.0)]);
        if number() > 1.0 {
            budget = Budget { gamma: number(), gamma_c: number(), move_max_m: number(), ..budget };
            reach = Reach::new(&InputBox::of([number(); 2], [number(); 2]), number());
        }
        let memory = Memory { rows: &mut [Row::default(); 21], weights: &mut [0.0; 64] };
        let mut rows = budget.rows(id(8), &sightings, &[number(), number()], reach, memory);
        let v = rows.closest().displacement_m;
        assert!(!rows.program.is_full() && reach.contains(&v), "{v:?}");
        assert!(rows.program.rows().iter().all(|row| row.holds(&v)));
        if sightings.iter().any(|sighting| !sighting.offset_m.iter().all(|component| component.is_finite())) {
            // below 1e-154 m the square of a move vanishes
            assert!(length(&v) < 1e-150, "a neighbour somewhere unknown");
        }
    }
}

/// Two malicious robots walk off: they have next to no neighbours left and are certainly below their need. The others stand
/// close together and want to rest, so nothing moves them, and nothing of theirs is violated.
//= theory sec:recovery type=test
#[test]
fn a_team_that_wishes_to_rest_is_not_towed_by_those_who_walk_off() {
    for form in [Form::Link, Form::Level] {
        let mut positions: Vec<Vector<2>> = PUBLISHED.iter().map(|x| x.map(|c| 0.8 * c)).collect();
        // far enough apart, and the first two have nearly left
        for (k, x) in positions.iter_mut().enumerate() {
            let k_m = f64::from(u32::try_from(k).unwrap_or(0));
            *x = if k < 2 {
                [2.9, [0.3, -0.3][k]]
            } else {
                [0.45 * (k_m % 3.0) - 0.45, 0.45 * libm::floor(k_m / 3.0) - 0.7]
            };
        }
        let now = tick(&positions, |_| [0.0; 2], form);
        assert!(now.h[..2].iter().all(|h| *h < -0.5), "those who left need others: {:?}", &now.h[..2]);
        assert!(now.h[2..].iter().all(|h| *h > 0.0), "{form:?}: {:?}", now.h);
        assert_eq!(now.positions[2..], positions[2..], "{form:?}: who rests is not moved");
        assert_eq!(now.broken, 2, "only those who left say that something is wrong");
    }
}
