//! A robot that is nearer to an obstacle than it may be, because it started there or was pushed, stayed there for ever if it wished to rest, and said
//! that its answer was guaranteed. It goes away from the obstacle, and says why it promises nothing until it is clear.

mod scene;
mod seeded;

use closeranks_core::num::{Vector, add_scaled, length};
use closeranks_core::obstacle::Obstacle;
use closeranks_core::program::Outcome;
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::robot::report::{Mode, Reason};
use closeranks_core::robot::sized::SizedRobot;
use closeranks_core::settings::params::{Controller, Params, Settings};
use closeranks_core::settings::{BudgetSettings, Errors, LinksSettings, Team};

use scene::at;

type Alone = SizedRobot<2, 4, 16>;

/// What a robot keeps from obstacles by default, m, and the longest move of a tick of 5 ms, m.
const CLEARANCE_M: f64 = 0.15;
const LONGEST_M: f64 = 0.005 * 1.5 * core::f64::consts::SQRT_2;

fn gap_m(map: &[Obstacle<2>], x: &Vector<2>) -> f64 {
    map.iter().map(|one| length(&one.offset_m(x)) - one.radius_m).fold(f64::INFINITY, f64::min)
}

/// Distances of a robot that starts at `own` and wishes to rest among `map`, tick by tick, and what it says.
fn ticks(
    controller: Controller,
    errors: Errors,
    own: Vector<2>,
    map: &[Obstacle<2>],
) -> Vec<(f64, Outcome, Mode)> {
    let settings =
        Settings { team: Team { robots: 4, faults: 0 }, controller, errors, ..Settings::default() };
    let params = Params::new(settings).expect("settings in range");
    let mut robot = Alone::new(params, RobotId(1), 1.0).expect("memory");
    let mut own = own;
    (0..60)
        .map(|tick| {
            robot.sense(at(5 * tick), own).expect("time rises");
            let _ = robot.share();
            let output = robot.tick_among([0.0; 2], map);
            let gap_m = gap_m(map, &own);
            own = add_scaled(&own, 0.005, &output.velocity_m_s);
            (gap_m, output.report.outcome, output.report.mode)
        })
        .collect()
}

//= theory sec:clear-recovery type=test
#[test]
fn it_goes_straight_away_at_the_stated_pace_and_says_so() {
    let (disc, wall) = (Obstacle::disc([0.0, 0.0], 0.5), Obstacle::wall([-1.0, 0.0], [1.0, 0.0]));
    for controller in
        [Controller::Budget(BudgetSettings::default()), Controller::Links(LinksSettings::default())]
    {
        for (map, own) in
            [([disc], [0.3, 0.42]), ([disc], [-0.2, 0.1]), ([wall], [0.3, 0.01]), ([wall], [1.05, 0.0])]
        {
            let run = ticks(controller, Errors::default(), own, &map);
            for pair in run.windows(2) {
                let [(before_m, outcome, mode), (after_m, ..)] = pair else { continue };
                let missing_m = CLEARANCE_M - before_m;
                if missing_m > 0.0 {
                    assert_eq!(*outcome, Outcome::Recovering);
                    // Alone it has too few neighbours too, which may be graver.
                    assert!(
                        matches!(
                            mode,
                            Mode::Degraded(Reason::Obstacle | Reason::Degree | Reason::OutsideSafeSet)
                        ),
                        "{mode:?}"
                    );
                    // A box lets no more than a speed along each axis pass.
                    let pace_m = missing_m.min(LONGEST_M / core::f64::consts::SQRT_2);
                    assert!(after_m - before_m >= 0.99 * pace_m, "{before_m} {after_m}");
                } else {
                    assert!(*after_m >= CLEARANCE_M && after_m - before_m < 1e-8, "{before_m} {after_m}");
                }
            }
            let last = run.last().expect("ticks");
            assert!(last.0 >= CLEARANCE_M && last.2 != Mode::Degraded(Reason::Obstacle), "{own:?}: {last:?}");
        }
    }
}

/// A robot that need have no neighbours says nothing but the obstacle.
#[test]
fn with_enough_neighbours_the_obstacle_is_the_reason() {
    let settings = Settings {
        team: Team { robots: 2, faults: 0 },
        controller: Controller::Budget(BudgetSettings::default()),
        ..Settings::default()
    };
    let mut robot = Alone::new(Params::new(settings).expect("in range"), RobotId(1), 1.0).expect("memory");
    let map = [Obstacle::disc([0.0, 0.0], 0.5)];
    let mut own = [0.56, 0.0];
    let mut said = std::vec::Vec::new();
    for tick in 0..20 {
        robot.sense(at(5 * tick), own).expect("time rises");
        robot.observe(RobotId(2), [1.5, 0.0]).expect("a slot");
        let _ = robot.share();
        let output = robot.tick_among([0.0; 2], &map);
        own = add_scaled(&own, 0.005, &output.velocity_m_s);
        said.push(output.report.mode);
    }
    assert_eq!(said.first(), Some(&Mode::Degraded(Reason::Obstacle)));
    assert_eq!(said.last(), Some(&Mode::Guaranteed), "{said:?}");
}

/// With an error of its place it goes until it is certainly clear.
#[test]
fn with_an_error_it_goes_farther() {
    let errors = Errors { position_m: 0.02, tracking_m: 0.0 };
    let map = [Obstacle::disc([0.0, 0.0], 0.5)];
    let run = ticks(Controller::Budget(BudgetSettings::default()), errors, [0.0, 0.55], &map);
    let end_m = run.last().expect("ticks").0;
    assert!((CLEARANCE_M + 0.02..CLEARANCE_M + 0.021).contains(&end_m), "{end_m}");
}
