//! Advice against brute force: the starts it calls possible are run for a tick, and those a hair beyond are not.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::Mode;
use closeranks_sim::advice::cost::Stated::{self, All, Hold, Nothing, Position, Tracking};
use closeranks_sim::advice::patch::start;
use closeranks_sim::advice::question::Question;
use closeranks_sim::advice::{Advice, advise};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Options, World};

/// The question with some numbers set.
fn question(dimension: usize, assume: &str, numbers: &[(&str, f64)]) -> Question {
    let mut question = Question::new(Scenario::default());
    question.set_dimension(dimension);
    question.set_assume(assume);
    for (name, value) in numbers {
        question.set(name, *value);
    }
    question
}

/// The least h of any robot in the first tick at this spacing, and whether all robots say that they are guaranteed.
fn first_tick<const D: usize>(question: &Question, spacing_m: f64) -> (f64, bool) {
    let mut scenario = question.settled();
    scenario.start = start(scenario.team.robots, spacing_m, D);
    scenario.malicious = Vec::new();
    let mut world = World::<D>::new(&scenario, Options::default()).unwrap();
    let frame = world.step();
    let guaranteed = frame.modes.iter().all(|mode| *mode == Mode::Guaranteed);
    (frame.h.iter().copied().fold(f64::INFINITY, f64::min), guaranteed)
}

#[track_caller]
fn holds<const D: usize>(question: &Question) -> Advice {
    let advice = advise(question).unwrap();
    let spacings = advice.fit().spacings;
    let (largest_m, best) = (spacings.largest_m.unwrap(), spacings.best.unwrap());
    // Rounding at a limit costs no guarantee, and is less than the second.
    let (hair, rounding) = (1e-12, 1e-9);
    assert!(first_tick::<D>(question, largest_m).0 >= 0.0);
    assert!(first_tick::<D>(question, largest_m * (1.0 + hair)).0 < 0.0);
    assert!(first_tick::<D>(question, spacings.least_m * (1.0 + hair)).1, "the least is certain");
    assert!(!first_tick::<D>(question, spacings.least_m * (1.0 - rounding)).1, "and nothing below it");
    assert!(first_tick::<D>(question, largest_m * (1.0 - hair)).1);
    let (h, guaranteed) = first_tick::<D>(question, best.spacing_m);
    assert!(guaranteed && (h - best.h).abs() < 1e-12, "{h} and {}", best.h);
    assert!(spacings.least_m < best.spacing_m && best.spacing_m < largest_m);
    let share = |spacing_m: f64| {
        let way = (spacing_m - spacings.least_m) / (largest_m - spacings.least_m);
        way.min(first_tick::<D>(question, spacing_m).0 / spacings.h_at_least)
    };
    for step in 0..=20 {
        let spacing_m = spacings.least_m + (largest_m - spacings.least_m) * f64::from(step) / 20.0;
        assert!(share(spacing_m) <= best.share + 1e-9, "no spacing has more room");
    }
    advice
}

#[test]
fn spacings_are_those_of_the_world() {
    for assume in ["obedient", "free"] {
        holds::<2>(&question(2, assume, &[]));
        holds::<2>(&question(2, assume, &[("team.robots", 5.0), ("team.faults", 1.0)]));
        holds::<2>(&question(
            2,
            assume,
            &[("team.robots", 24.0), ("team.faults", 1.0), ("link.radius_m", 4.0)],
        ));
        holds::<2>(&question(2, assume, &[("controller.position_error_m", 0.01), ("lag", 0.02)]));
        holds::<2>(&question(
            2,
            assume,
            &[("controller.position_error_m", 0.03), ("clock.hold_max_s", 0.02)],
        ));
        holds::<3>(&question(3, assume, &[]));
        holds::<3>(&question(3, assume, &[("controller.position_error_m", 0.01), ("lag", 0.01)]));
    }
}

/// Settings at the limits are checked, those a hair beyond are refused.
#[test]
fn speeds_and_ticks_are_where_the_checks_end() {
    for numbers in
        [&[][..], &[("lag", 0.05)], &[("controller.position_error_m", 0.1), ("clock.hold_max_s", 0.01)]]
    {
        let asked = question(2, "obedient", numbers);
        let limits = advise(&asked).unwrap().limits;
        let with = |name: &str, value: f64| {
            let mut asked = asked.clone();
            if name == "clock.tau_1_s" && asked.scenario.clock.hold_max.is_some() {
                asked.set("clock.hold_max_s", value + 0.005);
            }
            asked.set(name, value);
            asked.settled().params::<2>().is_ok()
        };
        let (speed_m_s, tick_s) = (limits.speed_m_s.unwrap(), limits.tick_s.unwrap());
        assert!(with("speed", speed_m_s) && !with("speed", speed_m_s * (1.0 + 1e-12)));
        assert!(with("clock.tau_1_s", tick_s - 1e-9) && !with("clock.tau_1_s", tick_s + 2e-9), "{tick_s}");
    }
}

/// A limit in any direction is scaled with the box, and counts: of a disc in a square the longest move is its radius.
#[test]
fn limits_in_any_direction_are_a_part_of_the_answer() {
    let mut asked = question(2, "obedient", &[("controller.speed_max_m_s", 1.2)]);
    let hold_s = asked.scenario.clock.hold_max().as_secs_f64();
    let close = |x: f64, y: f64| (x - y).abs() < 1e-12;
    assert_eq!(asked.axis_speed_m_s(), 1.2);
    assert!(close(asked.speed_m_s(), 1.2) && close(asked.move_max_m(), 1.2 * hold_s));
    let limits = advise(&asked).unwrap().limits;
    let speed_m_s = limits.speed_m_s.unwrap();
    let square = advise(&question(2, "obedient", &[])).unwrap().limits.speed_m_s.unwrap();
    assert!((speed_m_s / square - core::f64::consts::SQRT_2).abs() < 1e-9, "{speed_m_s} {square}");
    let with = |disc_m_s: f64| {
        let mut asked = asked.clone();
        asked.scenario.limits.input_min_m_s.fill(-1.25 * disc_m_s);
        asked.scenario.limits.input_max_m_s.fill(1.25 * disc_m_s);
        asked.set("controller.speed_max_m_s", disc_m_s);
        asked.settled().params::<2>().is_ok()
    };
    assert!(with(speed_m_s) && !with(speed_m_s * (1.0 + 1e-9)));
    asked.set_dimension(3);
    assert!(asked.axis_speed_m_s() == 1.2 && close(asked.speed_m_s(), 1.2));
    asked.set("speed", 2.0);
    assert_eq!(asked.axis_speed_m_s(), 2.0, "a speed along each axis takes the place of the disc");
}

/// F and n at the limits have a start, and one more or less has none.
#[test]
fn teams_are_the_largest_and_the_smallest() {
    let has_start = |assume: &str, robots: u16, faults: u16| {
        let asked = question(2, assume, &[("team.robots", robots.into()), ("team.faults", faults.into())]);
        advise(&asked).is_ok_and(|advice| advice.fit().exists())
    };
    for assume in ["obedient", "free"] {
        let counts = advise(&question(2, assume, &[])).unwrap().fit().counts;
        let faults = counts.faults_max_apart.unwrap();
        assert!(has_start(assume, 11, faults) && !has_start(assume, 11, faults + 1), "{assume} {faults}");
        let robots = counts.robots_min.unwrap();
        assert!(has_start(assume, robots, 2) && !has_start(assume, robots - 1, 2), "{assume} {robots}");
        assert!(counts.faults_max >= counts.faults_max_apart);
    }
}

#[test]
fn each_error_costs_something_of_its_own() {
    let numbers = [("controller.position_error_m", 0.01), ("lag", 0.02), ("clock.hold_max_s", 0.006)];
    let costs = advise(&question(2, "obedient", &numbers)).unwrap().costs;
    let errors: Vec<Stated> = costs.iter().map(|cost| cost.error).collect();
    assert_eq!(errors, [Nothing, Position, Tracking, Hold, All]);
    let [nothing, position, tracking, hold, all] = &costs[..] else { unreachable!() };
    assert_eq!((nothing.link_m, nothing.apart_m, nothing.h_lost), (3.0, 0.3, 0.0));
    assert_eq!((position.link_m, position.apart_m), (3.0, 0.3));
    assert!((tracking.link_m - (3.0 - 2.0 * tracking.stated)).abs() < 1e-12);
    assert!((all.apart_m - (0.3 + 2.0 * (tracking.stated + 0.01))).abs() < 1e-12);
    assert!(0.0 < position.h_lost && position.h_lost < tracking.h_lost && tracking.h_lost < all.h_lost);
    // Rows for longer moves are better off with a wider step of the weight, which costs a little of h.
    assert!(0.0 < hold.h_lost && hold.h_lost < position.h_lost && hold.move_max_m > nothing.move_max_m);
}

#[test]
fn what_cannot_be_is_said() {
    let tight = advise(&question(2, "obedient", &[("controller.distance_min_m", 2.0)])).unwrap();
    assert!(!tight.fit().exists() && tight.fit().spacings.largest_m.is_some());
    let flat = [("link.radius_m", 0.7), ("controller.distance_min_m", 0.1), ("controller.q2", 0.3)];
    let light = advise(&question(2, "obedient", &flat)).unwrap();
    assert!(light.fit().spacings.largest_m.is_none() && light.fit().counts.h_most < 0.0);
    let free = advise(&question(2, "free", &[("team.faults", 5.0)])).unwrap();
    assert!(free.fit().counts.need > free.fit().counts.counted && !free.fit().exists());
    let fast = advise(&question(2, "obedient", &[("speed", 1_000.0)])).unwrap_err();
    assert!(fast.too_fast.unwrap().speed_m_s.unwrap() < 1_000.0);
    let wide = advise(&question(2, "obedient", &[("controller.distance_min_m", 3.5)])).unwrap_err();
    assert!(wide.error.field.name() == "controller.distance_min_m");
    let many = advise(&question(2, "obedient", &[("team.faults", 6.0)])).unwrap_err();
    assert_eq!((many.error.field.name(), many.too_fast), ("team.faults", None));
}

#[test]
fn extremes_have_answers() {
    let small = advise(&question(3, "free", &[("team.robots", 2.0)])).unwrap();
    assert!(small.fit().exists());
    let still = advise(&question(2, "obedient", &[("speed", 0.0)])).unwrap();
    assert!(still.limits.speed_m_s.unwrap() > 1.0 && still.limits.tick_s == Some(3_600.0));
    let huge = [("link.radius_m", 1e6), ("controller.distance_min_m", 1e-6), ("clock.tau_1_s", 1e-6)];
    advise(&question(2, "obedient", &huge)).unwrap();
}
