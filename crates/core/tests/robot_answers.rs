//! What a robot answers: the equations, whatever the order of calls, and something safe whatever the calls.

use closeranks_core::controller::AnyController;
use closeranks_core::controller::assume::Assume;
use closeranks_core::equations::composition::{PhiSplit, Term};
use closeranks_core::message::{MESSAGE_BYTES, Message};
use closeranks_core::num::{Vector, dot, is_finite, subtract};
use closeranks_core::program::InputBox;
use closeranks_core::program::box_row::closest;
use closeranks_core::robot::neighbor::{RobotId, Slot};
use closeranks_core::robot::report::{Mode, Output};
use closeranks_core::robot::sized::SizedRobot;
use closeranks_core::settings::params::{Controller, Params, Settings};
use closeranks_core::settings::range::MAGNITUDE_MAX;
use closeranks_core::settings::{BudgetSettings, ComposedSettings, Limits, LinkSettings};
use closeranks_core::time::Instant;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use scene::{ME, Scene, lend, lend_with, new_robot};
use seeded::Seeded;

mod scene;
mod seeded;

//= paper eq:connectivity type=test
//= paper eq:split type=test
#[test]
fn what_it_answers_is_the_equations() {
    for seed in 0..300 {
        check_equations(&Scene::<2>::random(&mut Seeded(seed)));
        check_equations(&Scene::<3>::random(&mut Seeded(seed)));
    }
}

#[test]
fn the_order_of_observations_and_messages_does_not_matter() {
    for seed in 0..300 {
        check_order(&mut Scene::<2>::random(&mut Seeded(seed)), seed);
        check_order(&mut Scene::<3>::random(&mut Seeded(seed)), seed);
    }
}

/// One call, with anything in it.
#[derive(Clone, Debug)]
enum Call<const D: usize> {
    Sense(u64, Vector<D>),
    Observe(u16, Vector<D>),
    PhiSplit,
    Receive(u16, Vec<u8>),
    Restate(f64),
    Tick(Vector<D>),
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 600,
        rng_seed: RngSeed::Fixed(2),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_calls_with_any_numbers_give_a_safe_answer_in_the_plane(calls in sequence::<2>()) {
        check_calls(&calls);
    }

    #[test]
    fn any_calls_with_any_numbers_give_a_safe_answer_in_space(calls in sequence::<3>()) {
        check_calls(&calls);
    }
}

/// Plays the calls to a robot with room for three neighbours, with ordinary or the largest settings; looks at every answer.
fn check_calls<const D: usize>(calls: &[Call<D>]) {
    let composed = |composed| Settings { controller: Controller::Composed(composed), ..Settings::default() };
    let ordinary: Settings<D> =
        composed(ComposedSettings { phi_split: PhiSplit::Own, ..ComposedSettings::default() });
    let largest = MAGNITUDE_MAX;
    let weights =
        ComposedSettings { w_r: largest, w_c: largest, alpha: largest, ..ComposedSettings::default() };
    let input = InputBox::of([-MAGNITUDE_MAX; D], [0.0; D]);
    let extreme = Settings {
        link: LinkSettings { radius_m: MAGNITUDE_MAX, ..LinkSettings::default() },
        limits: Limits { input, ..Limits::default() },
        ..composed(weights)
    };
    let budget =
        |budget, settings: Settings<D>| Settings { controller: Controller::Budget(budget), ..settings };
    let usual = BudgetSettings::default();
    let free = BudgetSettings { assume: Assume::Free, ..usual };
    let none = Settings { controller: Controller::None, ..Settings::default() };
    let choices = [
        ordinary,
        extreme,
        Settings::default(),
        budget(usual, ordinary),
        budget(usual, extreme),
        budget(free, Settings::default()),
        none,
    ];
    lend_with(choices[calls.len() % choices.len()], |params| {
        let mut robot = SizedRobot::<D, 3>::new(params, ME, 1.0).expect("memory and a value");
        for call in calls {
            match call {
                Call::Sense(nanos, position) => drop(robot.sense(Instant::from_nanos(*nanos), *position)),
                Call::Observe(id, position) => drop(robot.observe(RobotId(*id), *position)),
                Call::PhiSplit => {
                    if let Some(message) = robot.share() {
                        assert_eq!(Message::parse(&message.encode()), Ok(message));
                    }
                }
                Call::Receive(id, bytes) => {
                    if let Ok(message) = Message::parse(bytes) {
                        let _ = robot.receive(RobotId(*id), &message);
                    }
                }
                Call::Restate(level) => robot.restate(*level),
                Call::Tick(desired) => check_answer(&params, &robot.tick(*desired)),
            }
            assert!(robot.value().is_finite() && robot.told_level().is_finite());
            assert!(robot.neighbors().is_sorted_by(|a, b| a.id() < b.id()) && robot.neighbors().len() <= 3);
        }
    });
}

fn check_answer<const D: usize>(params: &Params<D>, output: &Output<D>) {
    let Output { velocity_m_s, report } = output;
    assert!(
        is_finite(velocity_m_s) && params.settings().limits.input.contains(velocity_m_s),
        "{velocity_m_s:?}"
    );
    assert!(report.phi.is_none_or(|phi| phi.is_finite() && phi <= 1.0 / 11.0), "{report:?}");
    assert!(report.h.is_finite() && report.level >= 0.0, "{report:?}");
    assert!(report.mode != Mode::Guaranteed && report.degree <= 3, "{report:?}");
}

fn sequence<const D: usize>() -> impl Strategy<Value = Vec<Call<D>>> {
    prop::collection::vec(call(), 1..60)
}

fn call<const D: usize>() -> impl Strategy<Value = Call<D>> {
    let nanos = prop_oneof![0..400_000_000_u64, any::<u64>()];
    prop_oneof![
        2 => (nanos, position()).prop_map(|(nanos, position)| Call::Sense(nanos, position)),
        4 => (0..7_u16, position()).prop_map(|(id, position)| Call::Observe(id, position)),
        2 => Just(Call::PhiSplit),
        4 => (0..7_u16, bytes()).prop_map(|(id, bytes)| Call::Receive(id, bytes)),
        1 => number().prop_map(Call::Restate),
        3 => [(); D].map(|()| number()).prop_map(Call::Tick),
    ]
}

/// Positions that are near each other as a rule, and any numbers otherwise.
fn position<const D: usize>() -> impl Strategy<Value = Vector<D>> {
    prop_oneof![3 => [(); D].map(|()| -2.0..2.0), 1 => [(); D].map(|()| number())]
}

fn number() -> impl Strategy<Value = f64> {
    let special = [0.0, -0.0, 1e308, -1e308, f64::MAX, f64::MIN, 5e-324, f64::MIN_POSITIVE, f64::INFINITY];
    prop_oneof![-2.0..2.0, any::<f64>(), prop::sample::select(special.to_vec()), Just(f64::NAN), -1e3..1e3]
}

/// Messages as sent, messages with a byte changed, and rubbish.
fn bytes() -> impl Strategy<Value = Vec<u8>> {
    let stamp = prop_oneof![0..400_000_000_u64, any::<u64>()];
    let sent = (0..40_u32, stamp, number(), prop::option::of(number()));
    let sent = sent.prop_map(|(sequence, stamp, level, value)| {
        Message::new(sequence, Instant::from_nanos(stamp), Some(level), value)
            .map_or(vec![], |message| message.encode().to_vec())
    });
    let changed = (0..MESSAGE_BYTES, any::<u8>(), -10.0..10.0).prop_map(|(at, byte, level)| {
        let mut bytes = Message::new(9, Instant::START, Some(level), Some(level))
            .map_or([0; MESSAGE_BYTES], |message| message.encode());
        bytes[at] = byte;
        bytes.to_vec()
    });
    prop_oneof![4 => sent, 1 => changed, 1 => prop::collection::vec(any::<u8>(), 0..40)]
}

fn check_equations<const D: usize>(scene: &Scene<D>) {
    lend(|params: Params<D>| {
        let mut robot = new_robot(params);
        let Output { velocity_m_s, report } = scene.play(&mut robot, 0);
        let AnyController::Composed(controller) = params.controller() else { panic!("the default") };
        let composed = &controller.composed;
        let mut others = scene.others.clone();
        others.sort_by_key(|&(id, ..)| id);
        let terms: Vec<Term<D>> = others
            .iter()
            .filter_map(|(_, position, message)| {
                let offset_m = subtract(&scene.own, position);
                let link = params.link().link(&offset_m)?;
                let collision = composed.collision_term(dot(&offset_m, &offset_m));
                Some(Term { offset_m, link, collision, told: composed.degree_term(message.level()?) })
            })
            .collect();
        let level = terms.iter().fold(0.0, |level, term| level + term.link.weight);
        let composition = composed.compose(composed.degree_term(level), terms.iter().copied());
        let solution = closest(&scene.desired, &composition.row, &params.settings().limits.input);
        assert_eq!((velocity_m_s, report.outcome), (solution.velocity_m_s, solution.outcome));
        assert_eq!((report.phi, report.level, report.h), (Some(composition.phi), level, level - 7.0));
        assert_eq!(usize::from(report.degree), terms.len());
        assert_eq!((report.degree_margin, report.untold), (i32::from(report.degree) - 7, 0));
        assert!(matches!(report.mode, Mode::Degraded(_)));

        let round = report.round.expect("the first tick begins a round");
        let discarded: Vec<RobotId> =
            robot.neighbors().iter().filter(|slot| slot.discarded()).map(Slot::id).collect();
        assert_eq!((usize::from(round.discarded), round.silent), (discarded.len(), 0));
        assert_eq!(round.kept + round.discarded, report.degree);
        let kept = robot.neighbors().iter().filter(|slot| !slot.discarded()).map(Slot::id);
        let told = |id| others.iter().find(|other| other.0 == id).and_then(|other| other.2.value());
        let sum = kept.filter_map(told).fold(1.0, |sum, value| sum + value);
        scene.play(&mut robot, 100);
        // whole values: the sum is exact in any order
        assert_eq!(robot.value().to_bits(), (sum / (f64::from(round.kept) + 1.0)).to_bits());
    });
}

fn check_order<const D: usize>(scene: &mut Scene<D>, seed: u64) {
    let mut random = Seeded(!seed);
    let play = |scene: &Scene<D>| {
        lend(|params: Params<D>| {
            let mut robot = new_robot(params);
            let output = scene.play(&mut robot, 0);
            let discarded: Vec<_> =
                robot.neighbors().iter().map(|slot| (slot.id(), slot.discarded())).collect();
            let value = scene.play(&mut robot, 100);
            (output, discarded, value, robot.value().to_bits())
        })
    };
    let first = play(scene);
    assert!(first.0.velocity_m_s.iter().zip(first.2.velocity_m_s).all(|(a, b)| a.to_bits() == b.to_bits()));
    for _ in 0..3 {
        for last in (1..scene.others.len()).rev() {
            scene.others.swap(last, random.below(last + 1));
        }
        assert_eq!(play(scene), first);
    }
}
