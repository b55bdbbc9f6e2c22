//! The robot over time: what it holds, exchanges, refuses, forgets and says (eq:connectivity).

#![expect(clippy::float_cmp, reason = "what is held keeps its bits")]

use core::time::Duration;

use closeranks_core::controller::AnyController;
use closeranks_core::program::Outcome;
use closeranks_core::robot::error::{ObserveError, Observed, ReceiveError, RobotError, SenseError};
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::robot::report::{Mode, Output, Reason};
use closeranks_core::robot::sized::SizedRobot;
use closeranks_core::settings::Team;
use closeranks_core::settings::params::{Params, Settings};
use scene::{ME, Scene, TestRobot, at, lend, lend_with, message, message_at, new_robot};
use seeded::Seeded;

mod scene;
mod seeded;

/// The level is that of the last t_l until τ₁ has passed, own and told ones alike, while positions are of this tick.
//= paper eq:connectivity type=test
#[test]
fn levels_are_held_between_updates() {
    lend(|params: Params<2>| {
        let mut robot = new_robot(params);
        let mut tick = |ms: u64, x: f64, told: Option<f64>| {
            robot.sense(at(ms), [0.0, 0.0]).unwrap();
            robot.observe(RobotId(1), [x, 0.0]).unwrap();
            let shared = robot.share();
            if let Some(level) = told {
                robot
                    .receive(RobotId(1), &message_at(at(ms), u32::try_from(ms).unwrap() + 1, level, None))
                    .unwrap();
            }
            (robot.tick([0.0, 0.0]).report, shared, robot.neighbors()[0].told_level())
        };
        let (first, shared, told) = tick(0, 2.0, Some(6.5));
        let weight = params.link().link::<2, f64>(&[2.0, 0.0]).unwrap().weight;
        assert_eq!((first.level, shared.and_then(|message| message.level())), (weight, Some(weight)));
        assert_eq!((told, first.told_age_max), (Some(6.5), Duration::ZERO));

        let (held, shared, told) = tick(3, 1.0, None);
        assert_eq!((held.level, shared, told), (weight, None, Some(6.5)), "nothing new before 5 ms");
        assert_eq!(held.told_age_max, Duration::from_millis(3));

        let (renewed, shared, _) = tick(5, 1.0, None);
        let closer = params.link().link::<2, f64>(&[1.0, 0.0]).unwrap().weight;
        assert_eq!((renewed.level, shared.and_then(|message| message.level())), (closer, Some(closer)));
        assert!(closer > weight);
    });
}

/// Values count only in rounds; the mean is computed at the end of one and taken up at the beginning of the next.
//= paper eq:linear type=test
#[test]
fn values_are_exchanged_in_rounds_and_taken_up_at_the_next() {
    lend_with(
        Settings::<3> { team: Team { faults: 0, ..Team::default() }, ..Settings::default() },
        |params| {
            let mut robot = new_robot(params);
            let mut sequence = 0;
            let mut tick = |ms: u64, told: [f64; 2]| {
                robot.sense(at(ms), [0.0; 3]).unwrap();
                for id in [1, 2] {
                    robot.observe(RobotId(id), [f64::from(id), 0.0, 0.0]).unwrap();
                }
                let shared = robot.share();
                sequence += 1;
                for (id, value) in (1..).zip(told) {
                    robot.receive(RobotId(id), &message_at(at(ms), sequence, 7.0, Some(value))).unwrap();
                }
                let round = robot.tick([0.0; 3]).report.round;
                (
                    shared.and_then(|message| message.value()),
                    round.map(|round| (round.kept, round.silent)),
                    robot.value(),
                )
            };
            assert_eq!(
                tick(0, [4.0, 10.0]),
                (Some(1.0), Some((2, 0)), 1.0),
                "the mean is 5, not taken up yet"
            );
            assert_eq!(tick(50, [1e9, -1e9]), (None, None, 1.0), "no round is on");
            assert_eq!(tick(100, [5.0, 8.0]), (Some(5.0), Some((2, 0)), 5.0), "plain mean, F = 0");
            assert_eq!(tick(200, [6.0, 6.0]), (Some(6.0), Some((2, 0)), 6.0));
        },
    );
}

#[test]
fn what_cannot_be_used_is_refused_by_name() {
    lend(|params: Params<2>| {
        let mut robot = SizedRobot::<2, 2>::new(params, ME, 1.0).unwrap();
        assert_eq!(robot.observe(RobotId(1), [0.0; 2]), Err(ObserveError::NoPosition));
        robot.sense(at(10), [0.0; 2]).unwrap();
        assert_eq!(robot.observe(ME, [1.0; 2]), Err(ObserveError::OwnId));
        assert_eq!(robot.observe(RobotId(1), [f64::NAN, 0.0]), Err(ObserveError::NotFinite));
        assert_eq!(robot.observe(RobotId(1), [3.1, 0.0]), Ok(Observed::OutOfRange));
        assert_eq!(robot.receive(RobotId(1), &message(1, 0.0, None)), Err(ReceiveError::NotNeighbor));
        assert_eq!(robot.observe(RobotId(1), [1.0, 0.0]), Ok(Observed::Neighbor));
        assert_eq!(robot.observe(RobotId(2), [2.0, 0.0]), Ok(Observed::Neighbor));
        assert_eq!(robot.observe(RobotId(3), [0.0, 1.0]), Err(ObserveError::Full));
        assert_eq!(robot.observe(RobotId(2), [0.0, 2.0]), Ok(Observed::Neighbor), "its slot is there");
        for (sequence, expected) in
            [(7, Ok(())), (7, Err(ReceiveError::Stale)), (3, Err(ReceiveError::Stale)), (8, Ok(()))]
        {
            assert_eq!(robot.receive(RobotId(1), &message(sequence, f64::from(sequence), None)), expected);
        }
        assert_eq!(robot.neighbors()[0].told_level(), Some(8.0));
        assert_eq!(robot.sense(at(9), [0.0; 2]), Err(SenseError::TimeFell));
        assert_eq!(robot.sense(at(10), [f64::INFINITY, 0.0]), Err(SenseError::NotFinite));
        assert_eq!(robot.observe(RobotId(0), [1.0, 0.0]), Err(ObserveError::UnknownId));
        assert_eq!(robot.observe(RobotId(12), [1.0, 0.0]), Err(ObserveError::UnknownId));
        let new = |id, value| SizedRobot::<2, 2>::new(params, RobotId(id), value).map(|_| ()).unwrap_err();
        assert_eq!(new(5, f64::NAN), RobotError::Value);
        assert_eq!(new(0, 1.0), RobotError::Id { id: 0, robots: 11 });
        assert_eq!(new(12, 1.0), RobotError::Id { id: 12, robots: 11 });
    });
}

#[test]
fn a_neighbour_not_observed_is_forgotten_with_what_it_told() {
    lend(|params: Params<2>| {
        let mut robot = new_robot(params);
        let seen = |robot: &mut TestRobot<2>, ms: u64, ids: &[u16]| {
            robot.sense(at(ms), [0.0; 2]).unwrap();
            for &id in ids {
                robot.observe(RobotId(id), [1.0, f64::from(id)]).unwrap();
            }
            let _ = robot.share();
        };
        seen(&mut robot, 0, &[1, 2]);
        robot.receive(RobotId(1), &message(9, 4.0, None)).unwrap();
        robot.receive(RobotId(2), &message(9, 4.0, None)).unwrap();
        assert_eq!((robot.tick([0.0; 2]).report.degree, robot.neighbors()[1].told_level()), (2, Some(4.0)));
        seen(&mut robot, 5, &[1]);
        assert_eq!(robot.receive(RobotId(2), &message(10, 4.0, None)), Err(ReceiveError::NotNeighbor));
        assert_eq!(robot.tick([0.0; 2]).report.degree, 1);
        seen(&mut robot, 10, &[1, 2]);
        let report = robot.tick([0.0; 2]).report;
        assert_eq!((report.degree, report.untold, robot.neighbors()[1].told_level()), (2, 1, None));
        assert_eq!(
            robot.receive(RobotId(2), &message(1, 4.0, None)),
            Ok(()),
            "its old number is forgotten too"
        );
    });
}

#[test]
fn without_a_wish_it_holds() {
    let mut free = 0;
    for seed in 0..100 {
        let scene = Scene::<2>::random(&mut Seeded(seed));
        let play = |desired| {
            lend(|params: Params<2>| {
                let mut robot = new_robot(params);
                Scene { desired, ..scene.clone() }.play(&mut robot, 10)
            })
        };
        let (held, still) = (play([f64::NAN, 1.0]), play([0.0; 2]));
        assert_eq!(held.report.mode, Mode::Hold);
        assert_eq!(held.velocity_m_s, still.velocity_m_s);
        free += usize::from(held.velocity_m_s == [0.0; 2]);
    }
    assert!((1..100).contains(&free), "some may stand still, others must move: {free}");
}

#[test]
fn without_a_position_it_stops_until_the_next_good_call() {
    let scene = Scene::<2>::random(&mut Seeded(1));
    lend(|params: Params<2>| {
        let mut robot = new_robot(params);
        let Output { velocity_m_s, report } = robot.tick([1.0; 2]);
        assert_eq!(
            (velocity_m_s, report.mode, report.outcome),
            ([0.0; 2], Mode::Stopped, Outcome::Infeasible)
        );
        for (ms, position) in [(9, [0.0; 2]), (200, [f64::NAN; 2])] {
            assert!(matches!(scene.play(&mut robot, 10).report.mode, Mode::Degraded(_)));
            assert!(robot.sense(at(ms), position).is_err());
            let stopped = robot.tick([1.0; 2]);
            assert_eq!((stopped.velocity_m_s, stopped.report.mode), ([0.0; 2], Mode::Stopped));
            assert_eq!(robot.share(), None, "though due");
        }
    });
}

#[test]
fn a_value_is_marked_as_discarded_in_its_own_round_only() {
    lend(|params: Params<2>| {
        let mut robot = new_robot(params);
        let mut discarded = |ms: u64, told: Option<f64>| {
            robot.sense(at(ms), [0.0; 2]).unwrap();
            robot.observe(RobotId(1), [1.0, 0.0]).unwrap();
            let _ = robot.share();
            robot
                .receive(RobotId(1), &message_at(at(ms), u32::try_from(ms).unwrap() + 1, 7.0, told))
                .unwrap();
            let round = robot.tick([0.0; 2]).report.round;
            (robot.neighbors()[0].discarded(), round.map(|round| (round.discarded, round.silent)))
        };
        assert_eq!(discarded(0, Some(9.0)), (true, Some((1, 0))));
        assert_eq!(discarded(50, Some(1.0)), (true, None), "the last round is still the one of 9");
        assert_eq!(discarded(100, None), (false, Some((0, 1))));
        assert_eq!(discarded(200, Some(1.0)), (false, Some((0, 0))), "a tie with the own value");
    });
}

/// A restated level is told and used in the own row, and lasts until the next update; the report keeps the true one.
//= paper misbeh type=test
#[test]
fn a_restated_level_is_told_and_obeyed_until_the_next_update() {
    let scene = Scene::<2>::random(&mut Seeded(2));
    lend(|params: Params<2>| {
        let mut robot = new_robot(params);
        let honest = scene.play(&mut robot, 0).report;
        robot.restate(honest.level - 2.5);
        robot.restate(f64::NAN);
        assert_eq!(robot.told_level(), honest.level - 2.5);
        let lying = scene.play(&mut robot, 0).report;
        assert_eq!((lying.level, lying.h), (honest.level, honest.h));
        let AnyController::Composed(controller) = params.controller() else { panic!("the default") };
        let term = |level| controller.composed.degree_term::<f64>(level);
        let [honest_phi, lying_phi] = [honest, lying].map(|report| report.phi.unwrap());
        let more = (term(honest.level - 2.5) - term(honest.level)) / 8.0;
        assert!(((honest_phi - lying_phi) / more - 1.0).abs() < 1e-9, "φ_i falls by {more}");
        let again = scene.play(&mut robot, 5).report;
        assert_eq!((robot.told_level(), again.phi), (honest.level, honest.phi));
    });
}

#[test]
fn the_gravest_reason_is_named() {
    lend_with(Settings::<2> { team: Team { robots: 3, faults: 0 }, ..Settings::default() }, |params| {
        let mut robot = TestRobot::new(params, RobotId(3), 1.0).unwrap();
        let mut mode = |ms: u64, near: &[f64], told: Option<f64>| {
            robot.sense(at(ms), [0.0; 2]).unwrap();
            for (id, &x) in (1..).zip(near) {
                robot.observe(RobotId(id), [x, 0.0]).unwrap();
            }
            let _ = robot.share();
            if let Some(level) = told {
                for (id, _) in (1..).zip(near) {
                    robot
                        .receive(
                            RobotId(id),
                            &message_at(at(ms), u32::try_from(ms).unwrap() + 1, level, None),
                        )
                        .unwrap();
                }
            }
            robot.tick([0.0; 2]).report.mode
        };
        assert_eq!(mode(0, &[], None), Mode::Degraded(Reason::Degree));
        assert_eq!(mode(5, &[1.0, -1.0], None), Mode::Degraded(Reason::Untold));
        assert_eq!(mode(10, &[1.0, -1.0], Some(2.0)), Mode::Degraded(Reason::ContinuousTime));
        assert_eq!(mode(15, &[1.0, -1.2], Some(-1e6)), Mode::Degraded(Reason::Infeasible));
        assert_eq!(mode(20, &[0.28, -1.0], Some(2.0)), Mode::Degraded(Reason::OutsideSafeSet));
    });
}
