//! What each kind of liar tells, and where it goes.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::message::{Message, VALUE_MAX};
use closeranks_core::program::InputBox;
use closeranks_core::time::Instant;
use closeranks_sim::attack::liars::{Face, Liars};
use closeranks_sim::attack::{Attack, LevelAttack, MotionAttack, ValueAttack};
use closeranks_sim::scenario::Scenario;

/// Robots 1 and 2 lie; the normal ones hold 10, 11, ... 18.
fn liars(level: LevelAttack, value: ValueAttack) -> Liars {
    let attack = Attack { level, value, ..Attack::default() };
    Liars::new(&Scenario { attack, ..Scenario::default() })
}

/// What robot 1 tells of a level of 7 in each tick.
fn levels(level_attack: LevelAttack, ticks: u32) -> Vec<f64> {
    let mut liars = liars(level_attack, ValueAttack::None);
    (0..ticks)
        .map(|tick| {
            liars.begin_tick(tick);
            assert_eq!(liars.level(5, 7.0), 7.0, "a normal robot tells the truth");
            liars.level(0, 7.0 + f64::from(tick))
        })
        .collect()
}

/// What robots 1 and 2 tell everybody in a round at tick 0, having 0 themselves.
fn values(value_attack: ValueAttack) -> [f64; 2] {
    let mut liars = liars(LevelAttack::None, value_attack);
    liars.begin_tick(0);
    liars.begin_round((0..11).map(|index| if index < 2 { 0.0 } else { 8.0 + f64::from(index) }));
    assert_eq!(liars.value(4, 12.0), 12.0);
    [liars.value(0, 0.0), liars.value(1, 0.0)]
}

/// What robot 1 tells one neighbour that holds `value`.
fn told(liars: &mut Liars, value: f64) -> Option<Message> {
    let honest = Message::new(3, Instant::START, Some(7.0), Some(1.0)).unwrap();
    match liars.face(0, &honest, value) {
        Face::Silence => None,
        Face::Bytes(bytes) => Message::parse(&bytes).ok(),
        Face::Message(message) => Some(message),
    }
}

#[test]
fn levels_ramp_step_swing_and_are_replayed() {
    assert_eq!(levels(LevelAttack::Bias(-2.5), 2), [4.5, 5.5]);
    assert_eq!(levels(LevelAttack::Step { bias: 2.0, from_s: 0.005 }, 3), [7.0, 10.0, 11.0]);
    let ramp = levels(LevelAttack::Ramp { rate_per_s: 100.0 }, 3);
    assert_eq!(ramp, [7.0, 8.5, 10.0]);
    assert_eq!(levels(LevelAttack::Replay { age_s: 0.01 }, 4), [7.0, 7.0, 7.0, 8.0], "two ticks ago");
    assert_eq!(levels(LevelAttack::Replay { age_s: f64::MAX }, 3), [7.0; 3], "the first one for ever");
    let random = levels(LevelAttack::Random { min: -1.0, max: 1.0 }, 9);
    assert!(random.iter().all(|level| level.abs() <= 1.0) && random[0] != random[1]);
}

#[test]
fn values_are_constant_extreme_or_those_that_sway() {
    assert_eq!(values(ValueAttack::Constant { value: 500.0 }), [500.0; 2]);
    assert_eq!(values(ValueAttack::Ramp { start: 3.0, rate_per_s: 9.0 }), [3.0; 2]);
    assert_eq!(values(ValueAttack::Extreme), [VALUE_MAX, -VALUE_MAX]);
    assert_eq!(values(ValueAttack::Sway), [18.0, 10.0], "the greatest and the least of normal robots");
    assert_eq!(values(ValueAttack::None), [0.0; 2]);
}

#[test]
fn where_nobody_is_normal_they_sway_nobody() {
    let scenario =
        Scenario { malicious: (1..=11).collect(), attack: ValueAttack::Sway.into(), ..Scenario::default() };
    let mut liars = Liars::new(&scenario);
    liars.begin_tick(0);
    liars.begin_round((0..11).map(f64::from));
    assert_eq!([liars.value(0, 3.0), liars.value(1, 3.0)], [0.0; 2]);
}

#[test]
fn liars_with_faces_tell_each_neighbour_something_else() {
    let mut faces = liars(LevelAttack::Faces { min: 0.0, max: 1.0 }, ValueAttack::Split);
    faces.begin_round((0..11).map(f64::from));
    let [low, high] = [2.5, 9.0].map(|value| told(&mut faces, value).unwrap());
    assert_eq!([low.value(), high.value()], [Some(2.0), Some(10.0)], "whoever is low hears the least");
    assert!(low.level() != high.level() && low.level().is_some_and(|level| (0.0..1.0).contains(&level)));
    let honest = Message::new(3, Instant::START, Some(7.0), Some(1.0)).unwrap();
    assert_eq!(faces.face(7, &honest, 0.0), Face::Message(honest));
}

#[test]
fn liars_fall_silent_or_send_garbage() {
    let mut silent = liars(LevelAttack::Silent, ValueAttack::None);
    assert_eq!(told(&mut silent, 0.0), None);
    let mut mute = liars(LevelAttack::None, ValueAttack::Silent);
    assert_eq!(
        told(&mut mute, 0.0).map(|message| (message.level(), message.value())),
        Some((Some(7.0), None))
    );
    let mut garbage = liars(LevelAttack::Garbage, ValueAttack::None);
    let parsed: Vec<Option<Message>> = (0..200).map(|_| told(&mut garbage, 0.0)).collect();
    let refused = parsed.iter().filter(|message| message.is_none()).count();
    assert!((20..180).contains(&refused), "some of it is a message: {refused}");
}

#[test]
fn the_disobedient_flee_or_wander_as_fast_as_they_can() {
    let input = InputBox::of([-1.5; 2], [1.5; 2]);
    let positions = [[1.0, 0.0], [0.0, 0.0], [0.0, 0.1]];
    let velocity = |motion: MotionAttack| {
        let mut liars = Liars::new(&Scenario { attack: motion.into(), ..Scenario::default() });
        liars.begin_tick(0);
        assert_eq!(liars.velocity(2, &positions, &input), None, "a normal robot");
        liars.velocity(0, &positions, &input)
    };
    assert_eq!(velocity(MotionAttack::Obedient), None);
    let flight = velocity(MotionAttack::Flee).unwrap();
    assert!(flight[0] == 1.5 && flight[1].abs() < 0.3, "{flight:?}");
    let way = velocity(MotionAttack::Wander).unwrap();
    assert!(way.iter().any(|component| component.abs() > 0.1) && input.contains(&way));
}
