//! Neighbours that are not sensed although they are there: they keep their rows for as long as they cannot have left, and
//! whoever may overlook somebody says so.

use core::time::Duration;

use closeranks_core::equations::link::{Link, LinkShape};
use closeranks_core::message::Message;
use closeranks_core::num::{Vector, add_scaled, subtract};
use closeranks_core::robot::error::{ObserveError, Observed};
use closeranks_core::robot::missing::Horizon;
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::robot::report::{Mode, Reason};
use closeranks_core::robot::sized::SizedRobot;
use closeranks_core::settings::params::{Controller, Params, Settings};
use closeranks_core::settings::{BudgetSettings, Clock, Team};
use closeranks_core::time::Instant;

type TestRobot<const N: usize> = SizedRobot<2, N, 16>;

const TICK_MS: u64 = 5;
const TICK_S: f64 = 0.005;
const OVERLOOKED: Mode = Mode::Degraded(Reason::Overlooked);

fn at(tick: u64) -> Instant {
    Instant::from_nanos(tick * TICK_MS * 1_000_000)
}

/// Four robots, each of which must keep two neighbours.
fn robot<const N: usize>() -> TestRobot<N> {
    let settings = Settings {
        team: Team { robots: 4, faults: 0 },
        controller: Controller::Budget(BudgetSettings {
            q2: Some(0.3),
            epsilon: Some(1.0 / 3.0 - 0.001),
            gamma: Some(0.01),
            ..BudgetSettings::default()
        }),
        clock: Clock { told_max: Duration::from_millis(20), ..Clock::default() },
        ..Settings::default()
    };
    let params = Params::new(settings).expect("settings in range");
    TestRobot::new(params, RobotId(1), 1.0).expect("memory")
}

/// Robots 2, 3 and 4 as robot 1 sees them from the origin. Robot 4 has little more than it needs.
const OTHERS: [Vector<2>; 3] = [[1.0, 0.0], [-1.0, 0.0], [0.0, 2.4]];

/// A tick in which those of the others are observed that `seen` says.
fn tick<const N: usize>(
    robot: &mut TestRobot<N>,
    tick: u64,
    own: Vector<2>,
    desired: Vector<2>,
    seen: [bool; 3],
) -> (Mode, Vector<2>) {
    robot.sense(at(tick), own).expect("time rises");
    for (id, (place, seen)) in (2..).zip(OTHERS.iter().zip(seen)) {
        if seen {
            let _ = robot.observe(RobotId(id), *place);
        }
    }
    let _ = robot.share();
    let output = robot.tick(desired);
    (output.report.mode, output.velocity_m_s)
}

/// h of robot 4 when robot 1 is at `own`.
fn h_of_4(own: Vector<2>) -> f64 {
    let shape = LinkShape { radius_m: 3.0, q1: 2.0 + 1.0 / 3.0 - 0.001, q2: 0.3 };
    let weight = |x: Vector<2>| -> f64 {
        let link: Option<Link<f64>> = shape.link(&subtract(&OTHERS[2], &x));
        link.map_or(0.0, |link| link.weight)
    };
    weight(own) + weight(OTHERS[0]) + weight(OTHERS[1]) - 2.0
}

/// The hole: robot 1 walks away from robot 4, which it does not sense any more and which needs it. Without a row for robot 4
/// its h falls below 0 after 46 ticks while robot 1 says that all is guaranteed.
//= theory sec:unsensed type=test
#[test]
fn who_was_well_inside_and_is_not_sensed_keeps_its_row() {
    let (mut one, mut own) = (robot::<4>(), [0.0; 2]);
    let mut silent = 0;
    for k in 0..400 {
        let (mode, velocity) = tick(&mut one, k, own, [0.0, -1.5], [true, true, k < 3]);
        if mode != Mode::Guaranteed {
            assert_eq!(mode, OVERLOOKED, "in tick {k}");
            assert!(silent > 20, "given up after {silent} ticks");
            assert!(h_of_4(own) > 0.0);
            return;
        }
        let floor = 0.98 * h_of_4(own);
        own = add_scaled(&own, TICK_S, &velocity);
        assert!(h_of_4(own) >= floor, "h of robot 4 is {} in tick {k}", h_of_4(own));
        silent += u64::from(k >= 3);
    }
    panic!("robot 4 is never given up");
}

#[test]
fn a_short_dropout_costs_no_promise_and_no_message() {
    let mut one = robot::<4>();
    for k in 0..40 {
        let seen = k % 5 != 4;
        let (mode, _) = tick(&mut one, k, [0.0; 2], [0.0; 2], [true, true, seen]);
        assert_eq!(mode, Mode::Guaranteed, "in tick {k}");
        assert_eq!(one.neighbors()[2].is_missing(), !seen);
        let told = Message::new(u32::try_from(k).unwrap_or(0) + 1, at(k), None, Some(2.5)).expect("finite");
        assert_eq!(one.receive(RobotId(4), &told), Ok(()), "in tick {k}");
    }
}

/// Who is sensed so near the rim that it may leave in a tick is taken for gone.
#[test]
fn who_may_have_left_is_no_neighbour() {
    let mut one = robot::<4>();
    let observe = |one: &mut TestRobot<4>, tick, fourth: Option<Vector<2>>| {
        one.sense(at(tick), [0.0; 2]).expect("time rises");
        for (id, place) in (2..).zip([Some(OTHERS[0]), Some(OTHERS[1]), fourth]) {
            if let Some(place) = place {
                one.observe(RobotId(id), place).expect("a slot");
            }
        }
        let _ = one.share();
        one.tick([0.0; 2]).report.mode
    };
    assert_eq!(observe(&mut one, 0, Some([0.0, 2.995])), Mode::Guaranteed);
    assert_eq!(observe(&mut one, 1, None), Mode::Guaranteed);
    assert_eq!(one.neighbors().len(), 2);
}

/// Says so in this tick and for `told_max` more.
fn says_so_for_a_while<const N: usize>(what: &str, act: impl FnOnce(&mut TestRobot<N>)) {
    let mut one = robot::<N>();
    let seen = [true, true, N > 2];
    for k in 0..3 {
        assert_eq!(tick(&mut one, k, [0.0; 2], [0.0; 2], seen).0, Mode::Guaranteed, "{what}");
    }
    one.sense(at(3), [0.0; 2]).expect("time rises");
    for (id, place) in (2..).zip(OTHERS).take(N.min(3)) {
        one.observe(RobotId(id), place).expect("a slot");
    }
    act(&mut one);
    let _ = one.share();
    assert_eq!(one.tick([0.0; 2]).report.mode, OVERLOOKED, "{what}");
    for k in 4..8 {
        assert_eq!(tick(&mut one, k, [0.0; 2], [0.0; 2], seen).0, OVERLOOKED, "{what}");
    }
    assert_eq!(tick(&mut one, 8, [0.0; 2], [0.0; 2], seen).0, Mode::Guaranteed, "{what}");
}

#[test]
fn refused_observations_are_said() {
    says_so_for_a_while::<4>("not finite", |one| {
        assert_eq!(one.observe(RobotId(4), [f64::NAN, 0.0]), Err(ObserveError::NotFinite));
    });
    says_so_for_a_while::<4>("more robots than there are", |one| {
        assert_eq!(one.observe(RobotId(5), [0.5, 0.5]), Err(ObserveError::UnknownId));
    });
    says_so_for_a_while::<4>("one robot in two places", |one| {
        assert_eq!(one.observe(RobotId(4), [0.0, 2.401]), Ok(Observed::Neighbor));
    });
    says_so_for_a_while::<2>("no slot", |one| {
        assert_eq!(one.observe(RobotId(4), OTHERS[2]), Err(ObserveError::Full));
    });
}

#[test]
fn a_stranger_out_of_range_is_nobody() {
    let mut one = robot::<4>();
    assert_eq!(tick(&mut one, 0, [0.0; 2], [0.0; 2], [true; 3]).0, Mode::Guaranteed);
    one.sense(at(1), [0.0; 2]).expect("time rises");
    assert_eq!(one.observe(RobotId(9), [50.0, 0.0]), Err(ObserveError::UnknownId));
    for (id, place) in (2..).zip(OTHERS) {
        one.observe(RobotId(id), place).expect("a slot");
    }
    let _ = one.share();
    assert_eq!(one.tick([0.0; 2]).report.mode, Mode::Guaranteed);
}

#[test]
fn who_jumps_out_of_range_has_moved_and_is_missing() {
    let mut one = robot::<4>();
    for k in 0..3 {
        let _ = tick(&mut one, k, [0.0; 2], [0.0; 2], [true; 3]);
    }
    one.sense(at(3), [0.0; 2]).expect("time rises");
    for (id, place) in (2..).zip([OTHERS[0], OTHERS[1], [0.0, 9.0]]) {
        let _ = one.observe(RobotId(id), place);
    }
    let _ = one.share();
    assert_eq!(one.tick([0.0; 2]).report.mode, Mode::Degraded(Reason::Moved));
    assert!(one.neighbors()[2].is_missing());
}

//= theory sec:unsensed type=test
#[test]
fn how_far_a_robot_can_have_gone_and_when_it_may_have_left() {
    let horizon = Horizon { speed_m_s: 2.0, move_max_m: 0.25, radius_m: 3.0 };
    assert_eq!(horizon.went_m(Duration::from_millis(250)), 0.5, "a tick that came late");
    assert_eq!(horizon.went_m(Duration::ZERO), 0.25, "a clock that stands still");
    assert!(horizon.surely_holds(&[2.0, 0.0], 0.99) && !horizon.surely_holds(&[2.0, 0.0], 1.0));
    assert!(!horizon.surely_holds(&[f64::NAN, 0.0], 0.0));
}
