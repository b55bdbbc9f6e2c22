//! What tests of controllers with a view of the whole team share.

use crate::attack::ValueAttack;
use crate::controllers::shared::barrier::Barrier;
use crate::controllers::{Controller, TeamView, Tuning};
use crate::scenario::Scenario;
use crate::scenario::desired::Desired;
use crate::world::{Options, World};
use closeranks_core::num::{Vector, dot, sin, sqrt};
use closeranks_core::settings::params::Params;

/// Eleven robots without liars that pull away from each other.
pub(in crate::controllers) fn outward(controller: Controller) -> Scenario {
    Scenario {
        controller,
        malicious: Vec::new(),
        attack: ValueAttack::None.into(),
        desired: Desired::Paper,
        duration_s: 4.0,
        ..Scenario::default()
    }
}

/// Runs a team and calls `look` with every tick's positions as a view; gives the radius at the end over that at the start.
pub(in crate::controllers) fn watch(scenario: &Scenario, mut look: impl FnMut(&TeamView<'_, 2>)) -> f64 {
    let params = scenario.params::<2>().unwrap();
    let mut world = World::<2>::new(scenario, Options::default()).unwrap();
    let mut radii_m = Vec::new();
    while !world.is_over() {
        let frame = world.step();
        radii_m.push(frame.positions_m.iter().map(|x| dot(x, x)).sum::<f64>());
        look(&view(&params, &frame.positions_m));
    }
    sqrt(radii_m[radii_m.len() - 1] / radii_m[0])
}

pub(in crate::controllers) fn view<'a>(
    params: &'a Params<2>,
    positions_m: &'a [Vector<2>],
) -> TeamView<'a, 2> {
    let tuning = Tuning::USUAL;
    TeamView { params, positions_m, velocities_m_s: positions_m, desired_m_s: positions_m, tuning }
}

/// Compares the gradients of a barrier with differences of its value.
pub(in crate::controllers) fn check_gradients(
    places: &[Vector<2>],
    barrier: impl Fn(&TeamView<'_, 2>) -> Barrier<2>,
) {
    const STEP_M: f64 = 1e-5;
    let params = Scenario::default().params::<2>().unwrap();
    let here = barrier(&view(&params, places));
    assert!(!here.gradients.is_empty());
    for (robot, gradient) in &here.gradients {
        for axis in 0..2 {
            let at = |step_m: f64| {
                let mut moved = places.to_vec();
                moved[*robot][axis] += step_m;
                barrier(&view(&params, &moved)).h
            };
            let slope = (at(STEP_M) - at(-STEP_M)) / (2.0 * STEP_M);
            assert!((slope - gradient[axis]).abs() <= 1e-6 * (1.0 + slope.abs()), "{slope} {gradient:?}");
        }
    }
}

/// Eleven places that have no symmetry.
pub(in crate::controllers) fn places() -> Vec<Vector<2>> {
    (0..11)
        .map(|k| {
            let k = f64::from(k);
            [1.3 * sin(0.9 * k) + 0.21 * k, 1.1 * sin(1.7 * k + 1.0) - 0.13 * k]
        })
        .collect()
}
