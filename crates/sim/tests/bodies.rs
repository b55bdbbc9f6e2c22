//! Bodies that turn and accelerate, under the controllers that promise something.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::num::{length, subtract};
use closeranks_sim::law::Law;
use closeranks_sim::parse;
use closeranks_sim::plant::Plant;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Engine, Options, World, run};

const LOOK_AHEAD_M: f64 = 0.08;

fn scenario(controller: &str, more: &str) -> Scenario {
    let text = format!(
        "duration_s = 4.0\n[controller]\nkind = \"{controller}\"\ninput_min_m_s = [-0.4, -0.4]\n\
         input_max_m_s = [0.4, 0.4]\n{more}"
    );
    parse::scenario(&text).unwrap()
}

/// The margin follows from the limit: 2U²/a, U the corner of the box.
#[test]
fn a_double_integrator_states_its_own_margin() {
    let read = scenario("budget", "[plant]\nacceleration_max_m_s2 = 10.0\n");
    assert!((read.errors.tracking_m - 2.0 * 0.32 / 10.0).abs() < 1e-12);
    let stated = scenario("budget", "tracking_error_m = 0.1\n[plant]\nacceleration_max_m_s2 = 10.0\n");
    assert_eq!(stated.errors.tracking_m, 0.1);
    assert!(matches!(stated.plant, Plant::Double { .. }));
}

/// Under the derived margin nothing that is promised is broken, for drawn starts and lies; with a tenth of it robots notice or come too close.
#[test]
fn double_integrators_keep_what_is_promised() {
    for controller in ["budget", "links"] {
        let plant = "[plant]\nacceleration_max_m_s2 = 10.0\n[start]\nkind = \"random\"\n";
        for seed in 1..=3 {
            let scenario = Scenario { seed, ..scenario(controller, plant) };
            let summary = run(&scenario, Options::default(), &mut |_| ()).unwrap().summary;
            assert_eq!(summary.violations(&scenario).count(), 0, "{controller} {seed}: {summary:?}");
            let laws = [Law::Distance, Law::Path, Law::Input];
            assert!(laws.iter().all(|law| summary.broken(*law) == 0), "{controller} {seed}");
        }
        // The mode is what says it where the margin is too small: nobody is held to a promise then.
        let small = scenario(controller, "tracking_error_m = 0.001\n[plant]\nacceleration_max_m_s2 = 10.0\n");
        let mut world = World::<2>::new(&small, Options::default()).unwrap();
        let mut broken = false;
        while !world.is_over() {
            broken |= world.step().assumptions.broken;
        }
        assert!(broken, "{controller}");
    }
}

/// Points of unicycles go as single integrators, bit for bit, and axles are as far apart as points less two look-ahead lengths.
#[test]
fn the_points_of_unicycles_are_single_integrators() {
    for controller in ["budget", "links", "composed"] {
        let turning = scenario(controller, &format!("[plant]\nlook_ahead_m = {LOOK_AHEAD_M}\n"));
        assert_eq!(turning.plant, Plant::Unicycle { look_ahead_m: LOOK_AHEAD_M });
        let single = Scenario { plant: Plant::Single, ..turning.clone() };
        let digest = |scenario: &Scenario, engine| {
            run(scenario, Options { digest: true, engine, ..Options::default() }, &mut |_| ()).unwrap().digest
        };
        assert_eq!(digest(&turning, Engine::Team), digest(&single, Engine::Team), "{controller}");
        assert_eq!(digest(&turning, Engine::Robots), digest(&single, Engine::Robots), "{controller}");
        let mut world = World::<2>::new(&turning, Options::default()).unwrap();
        let (mut nearest_points, mut nearest_axles) = (f64::INFINITY, f64::INFINITY);
        while !world.is_over() {
            let points = world.step().positions_m.clone();
            let axles = world.axles_m();
            nearest_points = nearest_points.min(nearest(&points));
            nearest_axles = nearest_axles.min(nearest(&axles));
            let ahead = points.iter().zip(&axles).map(|(point, axle)| length(&subtract(point, axle)));
            ahead.for_each(|ahead| assert!((ahead - LOOK_AHEAD_M).abs() < 1e-9));
        }
        let demanded = turning.limits.distance_min_m - 2.0 * LOOK_AHEAD_M;
        assert!(nearest_points >= turning.limits.distance_min_m - 1e-9 || controller == "composed");
        assert!(nearest_axles >= demanded - 1e-9, "{controller}: {nearest_axles}");
    }
}

fn nearest(places: &[[f64; 2]]) -> f64 {
    let pair = |one: usize| (0..one).map(move |other| (one, other));
    let distances = (0..places.len()).flat_map(pair).map(|(a, b)| length(&subtract(&places[a], &places[b])));
    distances.fold(f64::INFINITY, f64::min)
}

#[test]
fn bodies_that_cannot_be_are_refused_by_name() {
    let refused =
        |text: &str| parse::scenario(text).unwrap_err().iter().map(ToString::to_string).collect::<String>();
    let two = refused("[plant]\nlag_s = 0.1\nlook_ahead_m = 0.1");
    assert!(two.contains("plant") && two.contains("one of lag_s"), "{two}");
    let space = refused("dimension = 3\n[team]\nrobots = 12\n[plant]\nlook_ahead_m = 0.1");
    assert!(space.contains("plant.look_ahead_m") && space.contains("only in 2"), "{space}");
    let wide = refused("[controller]\nkind = \"budget\"\n[plant]\nacceleration_max_m_s2 = 0.1");
    assert!(wide.contains("distance_min_m") || wide.contains("tracking_error_m"), "{wide}");
}
