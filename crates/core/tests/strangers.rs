//! A robot among robots of another team: it keeps its distance to them, and they count for nothing.

mod scene;
mod seeded;

use closeranks_core::controller::assume::Assume;
use closeranks_core::num::{add_scaled, length};
use closeranks_core::robot::error::{ObserveError, Observed, ReceiveError};
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::robot::report::Output;
use closeranks_core::robot::sized::SizedRobot;
use closeranks_core::settings::params::{Controller, Params, Settings};
use closeranks_core::settings::{BudgetSettings, LinksSettings, Team};

use scene::{at, message};

type Alone = SizedRobot<2, 4, 16>;

fn controllers() -> [Controller; 3] {
    let free = BudgetSettings { assume: Assume::Free, ..BudgetSettings::default() };
    [
        Controller::Budget(BudgetSettings::default()),
        Controller::Budget(free),
        Controller::Links(LinksSettings::default()),
    ]
}

/// Robot 1 of 4.
fn robot(controller: Controller) -> Alone {
    let settings = Settings { team: Team { robots: 4, faults: 0 }, controller, ..Settings::default() };
    Alone::new(Params::new(settings).expect("settings in range"), RobotId(1), 1.0).expect("memory")
}

/// A tick at the origin among these strangers, in which the robot wishes to go to the right.
fn tick(robot: &mut Alone, ms: u64, own: [f64; 2], strangers: &[(u16, [f64; 2])]) -> Output<2> {
    robot.sense(at(ms), own).expect("time rises");
    for (id, place) in strangers {
        assert_eq!(robot.observe_stranger(RobotId(*id), *place), Ok(Observed::Stranger));
    }
    let _ = robot.share();
    robot.tick([1.5, 0.0])
}

//= theory sec:strangers type=test
#[test]
fn a_stranger_is_no_neighbour_and_is_kept_away_from() {
    for controller in controllers() {
        let (mut robot, mut own) = (robot(controller), [0.0, 0.0]);
        for ms in 0..400 {
            let output = tick(&mut robot, 5 * ms, own, &[(9, [1.0, 0.0]), (700, [0.0, 2.0])]);
            assert_eq!((output.report.degree, output.report.level), (0, 0.0));
            assert!(robot.neighbors().is_empty() && robot.strangers().len() == 2);
            assert_eq!((robot.keeps_rows_for().count(), robot.counted().count()), (0, 0));
            own = add_scaled(&own, 0.005, &output.velocity_m_s);
            let gap_m = length(&[1.0 - own[0], own[1]]);
            assert!(gap_m >= 0.3, "{controller:?}: {gap_m} m");
        }
        assert!(own[0] > 0.65, "it goes as near as it may: {own:?}");
    }
}

#[test]
fn nobody_listens_to_a_stranger() {
    let mut robot = robot(Controller::Budget(BudgetSettings::default()));
    let output = tick(&mut robot, 0, [0.0, 0.0], &[(9, [1.0, 0.0])]);
    assert_eq!(output.report.round.map(|round| (round.kept, round.silent)), Some((0, 0)));
    let told = message(1, 4.0, Some(77.0));
    assert_eq!(robot.receive(RobotId(9), &told), Err(ReceiveError::NotNeighbor));
    assert_eq!(robot.receive_bytes(RobotId(9), &told.encode()), Err(ReceiveError::NotNeighbor));
    for ms in 1..100 {
        tick(&mut robot, 5 * ms, [0.0, 0.0], &[(9, [1.0, 0.0])]);
    }
    assert_eq!(robot.value(), 1.0);
}

#[test]
fn a_stranger_that_vanishes_keeps_its_row_as_long_as_it_must_be_there() {
    for controller in controllers() {
        let mut robot = robot(controller);
        tick(&mut robot, 0, [0.0, 0.0], &[(9, [0.31, 0.0])]);
        let output = tick(&mut robot, 5, [0.0, 0.0], &[]);
        assert!(robot.strangers().len() == 1 && output.velocity_m_s[0] <= 0.0, "{controller:?} {output:?}");
        robot.dismiss(RobotId(9));
        let output = tick(&mut robot, 10, [0.0, 0.0], &[]);
        assert!(robot.strangers().is_empty() && output.velocity_m_s[0] > 1.0, "{controller:?} {output:?}");
    }
}

#[test]
fn numbers_tell_teams_apart_and_slots_are_shared() {
    let mut robot = robot(Controller::Budget(BudgetSettings::default()));
    robot.sense(at(0), [0.0, 0.0]).expect("a position");
    for member in [0, 1, 4] {
        assert_eq!(robot.observe_stranger(RobotId(member), [1.0, 0.0]), Err(ObserveError::Member));
    }
    assert_eq!(robot.observe(RobotId(5), [1.0, 0.0]), Err(ObserveError::UnknownId));
    assert_eq!(robot.observe_stranger(RobotId(8), [9.0, 0.0]), Ok(Observed::OutOfRange));
    for id in [8, 6, 9] {
        assert_eq!(robot.observe_stranger(RobotId(id), [f64::from(id) / 10.0, 0.0]), Ok(Observed::Stranger));
    }
    assert_eq!(robot.observe(RobotId(2), [0.0, 1.0]), Ok(Observed::Neighbor));
    assert_eq!(robot.observe(RobotId(3), [0.0, 2.0]), Err(ObserveError::Full));
    assert_eq!(robot.neighbors().len(), 1);
    assert_eq!(robot.strangers().iter().map(|slot| slot.id().0).collect::<Vec<_>>(), [6, 8, 9]);
}
