//! What a robot under `budget` can check of its assumptions, and for how long it says so.

use core::time::Duration;

use closeranks_core::message::Message;
use closeranks_core::num::Vector;
use closeranks_core::robot::error::ReceiveError;
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::robot::report::{Mode, Reason};
use closeranks_core::robot::sized::SizedRobot;
use closeranks_core::settings::params::{Controller, Params, Settings};
use closeranks_core::settings::{BudgetSettings, Clock, Errors, Team};
use closeranks_core::time::Instant;

/// Room for four neighbours, also with stated errors.
type TestRobot = SizedRobot<2, 4, 16>;

const GUARANTEED: Mode = Mode::Guaranteed;

fn at(ms: u64) -> Instant {
    Instant::from_nanos(ms * 1_000_000)
}

fn settings() -> Settings<2> {
    let told_max = Duration::from_millis(20);
    Settings {
        team: Team { robots: 4, faults: 0 },
        controller: Controller::Budget(BudgetSettings::default()),
        clock: Clock { told_max, ..Clock::default() },
        ..Settings::default()
    }
}

/// A robot with three others around it, all of them standing still unless moved.
fn with_robot<R>(settings: &Settings<2>, play: impl FnOnce(&mut TestRobot) -> R) -> R {
    let params = Params::new(*settings).expect("settings in range");
    play(&mut TestRobot::new(params, RobotId(1), 1.0).expect("memory"))
}

const OTHERS: [Vector<2>; 3] = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0]];

/// A tick in which the robot wants to stay; `own` and the first of the others may be elsewhere.
fn tick(robot: &mut TestRobot, ms: u64, own: Vector<2>, first: Vector<2>) -> Mode {
    robot.sense(at(ms), own).expect("time rises");
    for (id, place) in (2..).zip([first, OTHERS[1], OTHERS[2]]) {
        robot.observe(RobotId(id), place).expect("a slot for each");
    }
    let _ = robot.share();
    robot.tick([0.0; 2]).report.mode
}

fn still(robot: &mut TestRobot, ms: u64) -> Mode {
    tick(robot, ms, [0.0; 2], OTHERS[0])
}

#[test]
fn a_missed_tick_is_said_for_a_while() {
    with_robot(&settings(), |robot| {
        assert_eq!([still(robot, 0), still(robot, 5)], [GUARANTEED; 2]);
        for ms in [20, 25, 30, 35, 40] {
            assert_eq!(still(robot, ms), Mode::Degraded(Reason::Late), "at {ms} ms");
        }
        assert_eq!(still(robot, 45), GUARANTEED);
    });
    let clock = Clock { hold_max: Some(Duration::from_millis(15)), ..settings().clock };
    let patient = Settings { clock, ..settings() };
    with_robot(&patient, |robot| assert_eq!([still(robot, 0), still(robot, 15)], [GUARANTEED; 2]));
}

#[test]
fn a_robot_that_is_not_where_it_should_be_says_so() {
    let moved = Mode::Degraded(Reason::Moved);
    with_robot(&settings(), |robot| {
        still(robot, 0);
        assert_eq!(tick(robot, 5, [0.001, 0.0], OTHERS[0]), moved);
        assert!(robot.began_anew());
    });
    with_robot(&settings(), |robot| {
        still(robot, 0);
        assert_eq!(tick(robot, 5, [0.0; 2], [1.02, 0.0]), GUARANTEED, "two longest moves are 2.1 cm");
        assert_eq!(tick(robot, 10, [0.0; 2], [1.05, 0.0]), moved);
    });
    let blurred = Settings { errors: Errors { position_m: 0.01, tracking_m: 0.0 }, ..settings() };
    with_robot(&blurred, |robot| {
        still(robot, 0);
        assert_eq!(tick(robot, 5, [0.019, 0.0], OTHERS[0]), GUARANTEED);
        assert_eq!(tick(robot, 10, [-0.019, 0.0], OTHERS[0]), moved);
    });
}

#[test]
fn with_a_tracking_error_a_robot_counts_itself_where_its_moves_took_it() {
    let lagging = Settings { errors: Errors { position_m: 0.0, tracking_m: 0.05 }, ..settings() };
    with_robot(&lagging, |robot| {
        still(robot, 0);
        assert_eq!(tick(robot, 5, [0.04, 0.0], OTHERS[0]), GUARANTEED);
        assert_eq!(robot.reference(), Some([0.0; 2]), "it did not tell itself to move");
        assert_eq!(tick(robot, 10, [0.06, 0.0], OTHERS[0]), Mode::Degraded(Reason::Moved));
        assert_eq!(robot.reference(), Some([0.06, 0.0]), "it begins anew");
    });
}

/// With stated errors a state is certainly safe, certainly broken, or carried on by the theorem.
#[test]
fn what_may_be_broken_is_uncertain_unless_it_was_certain_before() {
    let blurred = Settings { errors: Errors { position_m: 0.01, tracking_m: 0.0 }, ..settings() };
    let near = [0.31, 0.0];
    with_robot(&blurred, |robot| {
        assert_eq!(tick(robot, 0, [0.0; 2], near), Mode::Degraded(Reason::Uncertain));
    });
    with_robot(&blurred, |robot| {
        assert_eq!(tick(robot, 0, [0.0; 2], [0.33, 0.0]), GUARANTEED);
        assert_eq!(tick(robot, 5, [0.0; 2], near), GUARANTEED);
        assert_eq!(tick(robot, 10, [0.0; 2], [0.27, 0.0]), Mode::Degraded(Reason::OutsideSafeSet));
    });
}

#[test]
fn messages_are_in_the_order_of_their_stamps_and_a_restarted_robot_begins_again() {
    let message = |sequence, ms, level| Message::new(sequence, at(ms), Some(level), None).expect("finite");
    with_robot(&settings(), |robot| {
        still(robot, 10);
        assert_eq!(robot.receive(RobotId(2), &message(7, 5, 3.0)), Ok(()));
        assert_eq!(robot.receive(RobotId(2), &message(8, 4, 3.0)), Err(ReceiveError::Stale));
        assert_eq!(robot.receive(RobotId(2), &message(1, 6, 2.5)), Ok(()), "restarted since");
        robot.restart(4.0).expect("a value");
        assert_eq!((robot.value(), robot.neighbors().len(), robot.reference()), (4.0, 0, None));
        assert!(robot.restart(f64::NAN).is_err());
        assert_eq!(still(robot, 15), GUARANTEED);
    });
}

/// A value may come late in its round, not after it.
#[test]
fn a_value_counts_in_the_round_in_which_it_was_told() {
    let value = |sequence, ms, value| Message::new(sequence, at(ms), Some(3.0), Some(value)).expect("finite");
    with_robot(&settings(), |robot| {
        still(robot, 0);
        still(robot, 5);
        robot.receive(RobotId(2), &value(1, 0, 5.0)).expect("news");
        let round = robot.tick([0.0; 2]).report.round.map(|round| (round.kept, round.silent));
        assert_eq!(round, Some((1, 2)), "late by a tick");
        still(robot, 100);
        assert_eq!(robot.value(), 3.0, "the mean of 1 and 5");
        robot.receive(RobotId(3), &value(1, 0, 50.0)).expect("news");
        assert_eq!(robot.neighbors()[1].told_value(), None, "of the round before");
    });
}
