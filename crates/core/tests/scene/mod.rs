//! A robot in the middle of others, for one tick, and the memory it needs.

#![allow(dead_code, reason = "not every file of tests needs every part")]

use closeranks_core::message::Message;
use closeranks_core::num::Vector;
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::robot::report::Output;
use closeranks_core::robot::sized::SizedRobot;
use closeranks_core::settings::params::{Params, Settings};
use closeranks_core::time::Instant;

use crate::seeded::Seeded;

pub(crate) const SLOTS: usize = 12;
/// Robot [`ME`] with room for [`SLOTS`] neighbours, whatever errors are stated.
pub(crate) type TestRobot<const D: usize> = SizedRobot<D, SLOTS, 20>;
pub(crate) const ME: RobotId = RobotId(5);

/// What robot [`ME`] senses and is told in one tick.
#[derive(Clone)]
pub(crate) struct Scene<const D: usize> {
    pub(crate) own: Vector<D>,
    pub(crate) others: Vec<(RobotId, Vector<D>, Message)>,
    pub(crate) desired: Vector<D>,
}

impl<const D: usize> Scene<D> {
    /// Up to ten robots around it, most in range, some claims false, values whole so that ties are frequent.
    pub(crate) fn random(random: &mut Seeded) -> Self {
        let count = u16::try_from(3 + random.below(8)).unwrap_or(0);
        let mut place = |reach: f64| core::array::from_fn(|_| random.between(-reach, reach));
        let (own, desired) = (place(0.5), place(2.0));
        let places: Vec<Vector<D>> = (0..count).map(|_| place(2.2)).collect();
        let others = (0..count)
            .map(|k| {
                let value = f64::from(u32::try_from(random.below(6)).unwrap_or(0));
                let level = [random.between(6.8, 9.0), random.between(-3.0, 20.0)][usize::from(k == 0)];
                (
                    RobotId(if k + 1 < ME.0 { k + 1 } else { k + 2 }),
                    places[usize::from(k)],
                    message(1, level, Some(value)),
                )
            })
            .collect();
        Self { own, others, desired }
    }

    /// One tick at `ms` in the documented order of calls.
    pub(crate) fn play(&self, robot: &mut TestRobot<D>, ms: u64) -> Output<D> {
        robot.sense(at(ms), self.own).expect("a finite position, and time rises");
        for (id, position, _) in &self.others {
            robot.observe(*id, *position).expect("a slot for each");
        }
        let _ = robot.share();
        for (id, _, told) in &self.others {
            let sequence = u32::try_from(ms).unwrap_or(0) + 1;
            let numbered = Message::new(sequence, at(ms), told.level(), told.value());
            let _ = robot.receive(*id, &numbered.expect("finite numbers"));
        }
        robot.tick(self.desired)
    }
}

pub(crate) fn at(ms: u64) -> Instant {
    Instant::from_nanos(ms * 1_000_000)
}

pub(crate) fn message(sequence: u32, level: f64, value: Option<f64>) -> Message {
    message_at(Instant::START, sequence, level, value)
}

pub(crate) fn message_at(stamp: Instant, sequence: u32, level: f64, value: Option<f64>) -> Message {
    Message::new(sequence, stamp, Some(level), value).expect("finite numbers")
}

/// Calls `play` with the paper's parameters.
pub(crate) fn lend<const D: usize, R>(play: impl FnOnce(Params<D>) -> R) -> R {
    lend_with(Settings::default(), play)
}

pub(crate) fn lend_with<const D: usize, R>(settings: Settings<D>, play: impl FnOnce(Params<D>) -> R) -> R {
    play(Params::new(settings).expect("settings in range"))
}

pub(crate) fn new_robot<const D: usize>(params: Params<D>) -> TestRobot<D> {
    TestRobot::new(params, ME, 1.0).expect("memory and a value")
}
