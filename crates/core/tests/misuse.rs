//! What a robot says when its owner calls it in a wrong way: the table in the doc of `Robot`.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use core::time::Duration;

use closeranks_core::{
    BudgetSettings, Controller, Instant, Message, Mode, ObserveError, Observed, Params, Reason, ReceiveError,
    RobotError, RobotId, RobotMemory, Scratch, SenseError, Settings, SizedRobot, Team,
};

const ROBOTS: u16 = 4;
type TestRobot = SizedRobot<2, 3>;

fn params(controller: Controller) -> Params<2> {
    let team = Team { robots: ROBOTS, faults: 1 };
    Params::new(Settings { team, controller, ..Settings::default() }).unwrap()
}

fn budget() -> Params<2> {
    params(Controller::Budget(BudgetSettings::default()))
}

/// Robot 2 of four.
fn robot() -> TestRobot {
    TestRobot::new(budget(), RobotId(2), 1.0).unwrap()
}

fn at(ms: u64) -> Instant {
    Instant::START.after(Duration::from_millis(ms))
}

fn sense_and_observe(robot: &mut TestRobot, ms: u64) {
    robot.sense(at(ms), [0.0; 2]).unwrap();
    for (id, position) in [(1, [1.0, 0.0]), (3, [0.0, 1.0]), (4, [-1.0, 0.0])] {
        assert_eq!(robot.observe(RobotId(id), position), Ok(Observed::Neighbor));
    }
}

fn mode(robot: &mut TestRobot) -> Mode {
    robot.tick([0.0; 2]).report.mode
}

#[test]
fn numbers_outside_of_the_team_are_refused_whatever_was_sensed() {
    for id in [0, ROBOTS + 1, u16::MAX] {
        let made = TestRobot::new(budget(), RobotId(id), 1.0).map(|_| ());
        assert_eq!(made, Err(RobotError::Id { id, robots: ROBOTS }));
        assert_eq!(robot().observe(RobotId(id), [1.0, 0.0]), Err(ObserveError::UnknownId), "before `sense`");
        let mut robot = robot();
        sense_and_observe(&mut robot, 0);
        assert_eq!(robot.observe(RobotId(id), [1.0, 0.0]), Err(ObserveError::UnknownId));
        let message = Message::new(1, at(0), Some(3.0), None).unwrap();
        assert_eq!(robot.receive(RobotId(id), &message), Err(ReceiveError::NotNeighbor));
    }
}

#[test]
fn the_own_number_is_no_neighbor() {
    let mut robot = robot();
    sense_and_observe(&mut robot, 0);
    let echo = robot.share().unwrap();
    assert_eq!(robot.observe(RobotId(2), [1.0, 0.0]), Err(ObserveError::OwnId));
    assert_eq!(robot.receive(RobotId(2), &echo), Err(ReceiveError::NotNeighbor));
}

/// Of all numbers that there are, n − 1 are taken: with that many slots there is always room.
#[test]
fn there_are_never_more_neighbors_than_others_in_the_team() {
    let mut robot = SizedRobot::<2, 20>::new(budget(), RobotId(2), 1.0).unwrap();
    robot.sense(at(0), [0.0; 2]).unwrap();
    let taken = (0..=u16::MAX).filter(|&id| robot.observe(RobotId(id), [1.0, 0.0]).is_ok()).count();
    assert_eq!((taken, robot.neighbors().len()), (3, 3));
    let again = robot.observe(RobotId(3), [0.5, 0.0]);
    assert_eq!((again, robot.neighbors().len()), (Ok(Observed::Neighbor), 3), "the newer one counts");
}

#[test]
fn a_full_robot_says_so_and_keeps_those_observed_first() {
    let mut robot = SizedRobot::<2, 2>::new(budget(), RobotId(2), 1.0).unwrap();
    robot.sense(at(0), [0.0; 2]).unwrap();
    let observed = [4, 3, 1].map(|id| robot.observe(RobotId(id), [1.0, 0.0]));
    assert_eq!(observed, [Ok(Observed::Neighbor), Ok(Observed::Neighbor), Err(ObserveError::Full)]);
    assert_eq!(robot.neighbors().iter().map(|slot| slot.id().0).collect::<Vec<_>>(), [3, 4]);
}

#[test]
fn a_tick_without_sense_stands_still_and_says_so() {
    let mut robot = robot();
    assert_eq!(mode(&mut robot), Mode::Stopped, "never sensed");
    sense_and_observe(&mut robot, 0);
    let _ = robot.share();
    assert_eq!(mode(&mut robot), Mode::Guaranteed);
    let again = robot.tick([1.0, 0.0]);
    assert_eq!((again.velocity_m_s, again.report.mode), ([0.0; 2], Mode::Degraded(Reason::NotSensed)));
}

#[test]
fn a_tick_without_share_says_so_when_something_was_due() {
    for params in [budget(), params(Controller::default()), params(Controller::None)] {
        let mut robot = TestRobot::new(params, RobotId(2), 1.0).unwrap();
        sense_and_observe(&mut robot, 0);
        assert_eq!(mode(&mut robot), Mode::Degraded(Reason::NotShared));
        sense_and_observe(&mut robot, 1);
        let _ = robot.share();
        assert_ne!(mode(&mut robot), Mode::Degraded(Reason::NotShared));
        sense_and_observe(&mut robot, 3);
        assert_ne!(mode(&mut robot), Mode::Degraded(Reason::NotShared), "nothing is due before 5 ms");
        sense_and_observe(&mut robot, 5);
        assert_eq!(mode(&mut robot), Mode::Degraded(Reason::NotShared));
    }
}

#[test]
fn what_was_not_sensed_well_stops_the_robot() {
    for (ms, position, error) in
        [(4, [0.0; 2], SenseError::TimeFell), (6, [f64::NAN; 2], SenseError::NotFinite)]
    {
        let mut robot = robot();
        sense_and_observe(&mut robot, 5);
        assert_eq!(robot.sense(at(ms), position), Err(error));
        assert_eq!(robot.observe(RobotId(1), [1.0, 0.0]), Err(ObserveError::NoPosition));
        assert_eq!((robot.share(), mode(&mut robot)), (None, Mode::Stopped));
    }
}

#[test]
fn memory_that_is_too_small_is_refused_with_what_is_needed() {
    let errors = closeranks_core::Errors { position_m: 0.01, tracking_m: 0.0 };
    let stated = Params::new(Settings { errors, ..*budget().settings() }).unwrap();
    let needs = closeranks_core::Needs::new(&stated, 3);
    assert_eq!((needs.values, needs.sightings, needs.rows), (9, 3, 32));
    let refused = SizedRobot::<2, 3, 10>::new(stated, RobotId(2), 1.0).map(|_| ());
    assert_eq!(refused, Err(RobotError::Scratch(needs)));
    SizedRobot::<2, 3, 11>::new(stated, RobotId(2), 1.0).unwrap();
    RobotMemory::<2, 1>::new(&budget()).unwrap();
    assert!(Scratch::<2>::new(&budget(), 3, &mut [], &mut [], &mut []).is_err());
}
