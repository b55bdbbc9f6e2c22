//! The calls that bytes stand for, and what is known of a robot while they are played.

use closeranks_core::controller::links::protocol::{Entry, Number};
use closeranks_core::controller::links::wire::{Head, Item, LinkMessage, bytes_max};
use closeranks_core::message::{MESSAGE_BYTES, Message};
use closeranks_core::num::{Vector, is_finite};
use closeranks_core::robot::Robot;
use closeranks_core::robot::neighbor::{RobotId, Slot};
use closeranks_core::robot::scratch::Scratch;
use closeranks_core::settings::params::Params;
use closeranks_core::time::Instant;

use crate::source::Source;

/// A robot with everything that was done to it.
pub(super) struct Play<'memory, const D: usize> {
    pub(super) params: Params<D>,
    pub(super) robot: Robot<D, Vec<Slot<D>>>,
    scratch: Scratch<'memory, D>,
    pub(super) slots: usize,
    /// Least and greatest value that it was ever told, its first included.
    pub(super) hull: [f64; 2],
    /// Whether the last `sense` gave a usable position.
    pub(super) placed: bool,
    /// Whether `sense` was called since the last tick.
    pub(super) sensed: bool,
    now: u64,
    sequence: u32,
}

impl<'memory, const D: usize> Play<'memory, D> {
    pub(super) fn new(
        params: Params<D>,
        robot: Robot<D, Vec<Slot<D>>>,
        scratch: Scratch<'memory, D>,
        slots: usize,
        value: f64,
    ) -> Self {
        Self {
            params,
            robot,
            scratch,
            slots,
            hull: [value; 2],
            placed: false,
            sensed: false,
            now: 0,
            sequence: 0,
        }
    }

    /// Plays every call of `source`.
    pub(super) fn all(&mut self, source: &mut Source<'_>) {
        while !source.is_empty() {
            self.call(source);
            self.check_state();
        }
    }

    fn call(&mut self, source: &mut Source<'_>) {
        match source.byte() % 16 {
            0 | 1 => self.sense(source),
            2..=4 => self.observe(source),
            5 | 6 => self.share(),
            7..=9 => self.receive(source),
            10 => self.robot.restate(source.number()),
            11 | 12 => self.tick(source),
            _ => self.whole_tick(source),
        }
    }

    fn sense(&mut self, source: &mut Source<'_>) {
        let now = later(self.now, self.robot.poll_at(), source);
        let rises = now >= self.now;
        let position = source.position();
        self.placed = rises && is_finite(&position);
        self.sensed = true;
        let taken = self.robot.sense(Instant::from_nanos(now), position);
        assert_eq!(taken.is_ok(), self.placed, "{taken:?} for {position:?}");
        if rises {
            self.now = now;
        }
    }

    fn observe(&mut self, source: &mut Source<'_>) {
        let id = other(source);
        let position = source.position();
        let taken = self.robot.observe(id, position);
        assert!(
            taken.is_err() || (self.placed && id != self.robot.id() && is_finite(&position)),
            "{taken:?}"
        );
    }

    fn share(&mut self) {
        let shared = self.robot.share(&mut self.scratch);
        if let Some(message) = shared {
            assert!(self.placed);
            assert_eq!(Message::parse(&message.encode()), Ok(message));
            let mut bytes = vec![0; bytes_max(self.params.settings().team.robots, D).max(MESSAGE_BYTES)];
            let length = self.robot.encode(&message, &mut bytes).expect("there is room for the longest");
            let lists = LinkMessage::<D>::parse(&bytes[..length]).is_ok();
            assert_eq!(lists, self.params.controller().tells_lists());
        }
        let next = self.robot.poll_at().as_nanos();
        assert!(!self.placed || next > self.now || next == u64::MAX, "due again at once");
    }

    fn receive(&mut self, source: &mut Source<'_>) {
        let id = other(source);
        if self.params.controller().tells_lists() {
            return self.receive_lists(id, source);
        }
        let told = if source.byte() < 224 { self.built(source) } else { Message::parse(&raw(source)).ok() };
        let Some(message) = told else { return };
        if self.robot.receive(id, &message).is_ok() {
            assert!(self.placed && id != self.robot.id());
            let value = message.value().unwrap_or(self.hull[0]);
            self.hull = [self.hull[0].min(value), self.hull[1].max(value)];
        }
    }

    /// A message of lists: newer than all before as a rule, and with what was received of the robot, or anything.
    fn receive_lists(&mut self, sender: RobotId, source: &mut Source<'_>) {
        let choice = source.byte();
        let near = |from: u64, source: &mut Source<'_>| match source.byte() {
            byte @ 0..=199 => from.saturating_add(u64::from(byte)).saturating_sub(20),
            _ => u64::from_le_bytes(source.take()),
        };
        let (number, acknowledged) = (near(self.now, source), near(self.now, source));
        let value = (choice & 1 == 0).then(|| source.number());
        let wish_m_s: Vector<D> = core::array::from_fn(|_| source.number());
        let head = Head { number: Number(number), value, price_m: source.near().abs(), wish_m_s };
        let entry = Entry { listed: choice & 2 == 0, acknowledged: Number(acknowledged) };
        let item = Item { id: self.robot.id(), entry, promised: choice & 4 == 0 };
        let mut bytes = [0; bytes_max(2, 3)];
        let Some(length) = head.encode(core::iter::once(item), &mut bytes) else { return };
        if self.robot.receive_bytes(sender, &bytes[..length]).is_ok() {
            assert!(sender != self.robot.id() && head.checked().is_ok());
            let value = value.unwrap_or(self.hull[0]);
            self.hull = [self.hull[0].min(value), self.hull[1].max(value)];
        }
    }

    /// A message as a robot may send it, newer than all before as a rule.
    fn built(&mut self, source: &mut Source<'_>) -> Option<Message> {
        let choice = source.byte();
        let sequence = if choice < 240 { self.sequence.saturating_add(1) } else { u32::from(source.byte()) };
        self.sequence = self.sequence.max(sequence);
        let level = if choice & 2 == 0 { 5.0 + source.near() } else { source.number() };
        let value = (choice & 1 == 0).then(|| source.number());
        message(sequence, self.now, level, value)
    }

    fn tick(&mut self, source: &mut Source<'_>) {
        let desired = core::array::from_fn(|_| source.number());
        let before = self.robot.neighbors().len();
        let output = self.robot.tick(desired, &mut self.scratch);
        self.check_answer(&desired, before, &output);
        self.sensed = false;
    }

    /// The documented order, with as many neighbours as fit.
    fn whole_tick(&mut self, source: &mut Source<'_>) {
        self.sense(source);
        let count = source.below(self.slots + 1);
        for _ in 0..count {
            self.observe(source);
        }
        self.share();
        for _ in 0..count {
            self.receive(source);
        }
        self.tick(source);
    }
}

/// The one place that makes messages; `None` where its numbers are refused.
fn message(sequence: u32, now: u64, level: f64, value: Option<f64>) -> Option<Message> {
    Message::new(sequence, Instant::from_nanos(now), Some(level), value).ok()
}

/// Bytes as they may come from the network: of the right length, or one too few.
fn raw(source: &mut Source<'_>) -> Vec<u8> {
    let mut bytes = source.take::<MESSAGE_BYTES>().to_vec();
    if source.byte() < 64 {
        bytes.pop();
    }
    bytes
}

fn other(source: &mut Source<'_>) -> RobotId {
    RobotId(u16::try_from(source.below(14)).unwrap_or(0))
}

/// Another moment: when the robot is due, a little later, or anywhere.
fn later(now: u64, due: Instant, source: &mut Source<'_>) -> u64 {
    match source.byte() {
        0..=127 => due.as_nanos().max(now),
        128..=199 => now.saturating_add(u64::from(u32::from_le_bytes(source.take()))),
        200..=219 => now,
        220..=229 => now.saturating_sub(u64::from(source.byte())),
        230..=249 => u64::from_le_bytes(source.take()),
        250..=255 => u64::MAX,
    }
}
