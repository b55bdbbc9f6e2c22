//! The malicious robots of a run. They wrap the network and the plant: a robot never knows that it lies.

use closeranks_core::message::{MESSAGE_BYTES, Message};
use closeranks_core::num::Vector;
use closeranks_core::program::InputBox;
use closeranks_core::robot::neighbor::RobotId;

use crate::attack::level::{LevelFace, LevelLiar};
use crate::attack::lists::ListsLiar;
use crate::attack::motion::MotionLiar;
use crate::attack::value::ValueLiar;
use crate::random::{Random, Stream};
use crate::scenario::Scenario;
use crate::transport::Bytes;

/// What one robot gets from a sender.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Face {
    /// Nothing.
    Silence,
    /// These bytes.
    Bytes([u8; MESSAGE_BYTES]),
    /// This message.
    Message(Message),
}

/// What malicious robots do in a run; normal robots tell the truth and obey.
#[derive(Clone, Debug)]
pub struct Liars {
    level: LevelLiar,
    lists: ListsLiar,
    value: ValueLiar,
    motion: MotionLiar,
    /// Draws what is told to one neighbour alone, levels and values in one order.
    faces: Random,
    malicious: Vec<bool>,
    /// Whether the lies of the scenario are the same for everybody.
    one_level: bool,
    one_value: bool,
    /// What is told in this tick in place of the scenario's lies, if it was given from outside.
    given_levels: Option<Vec<f64>>,
    given_values: Option<Vec<f64>>,
    tick_s: f64,
    tick: u32,
}

impl Liars {
    /// The liars of `scenario`.
    #[must_use]
    pub fn new(scenario: &Scenario) -> Self {
        let (robots, seed, tick_s) = (usize::from(scenario.team.robots), scenario.seed, scenario.tick_s());
        Self {
            level: LevelLiar::new(scenario.attack.level, seed, robots, tick_s),
            lists: ListsLiar::new(scenario.attack.lists, seed, scenario.team.robots, tick_s),
            value: ValueLiar::new(scenario.attack.value, seed, robots),
            motion: MotionLiar::new(scenario.attack.motion.clone(), seed, robots, tick_s),
            faces: Random::new(seed, Stream::Faces),
            malicious: scenario.malicious_mask(),
            one_level: scenario.attack.level.is_alike_for_all(),
            one_value: scenario.attack.value.is_alike_for_all() && scenario.attack.level.is_alike_for_all(),
            given_levels: None,
            given_values: None,
            tick_s,
            tick: 0,
        }
    }

    /// What malicious robots tell in the next tick instead of what the scenario says, one number a robot, the same to all.
    pub(crate) fn give(&mut self, levels: Option<&[f64]>, values: Option<&[f64]>) {
        self.given_levels = levels.map(<[f64]>::to_vec);
        self.given_values = values.map(<[f64]>::to_vec);
    }

    /// What malicious robots tell of values in this tick, if that was given from outside.
    pub(crate) fn given_values(&self) -> Option<&[f64]> {
        self.given_values.as_deref()
    }

    /// Decides what is told of levels in `tick`.
    pub fn begin_tick(&mut self, tick: u32) {
        self.tick = tick;
        self.level.begin_tick(self.time_s(), &self.malicious);
    }

    /// The level that robot `index` holds and tells in this tick when its true one is `level`.
    pub fn level(&mut self, index: usize, level: f64) -> f64 {
        match &self.given_levels {
            _ if !self.malicious[index] => level,
            Some(given) => given[index],
            None => self.level.level(index, level),
        }
    }

    /// Decides what is told of values in the round that begins with this tick; all robots hold `values`.
    pub fn begin_round(&mut self, values: impl Iterator<Item = f64>) {
        self.value.begin_round(self.tick, self.time_s(), values, &self.malicious);
    }

    /// The value that robot `index` tells everybody when it holds `value`.
    #[must_use]
    pub fn value(&self, index: usize, value: f64) -> f64 {
        match &self.given_values {
            _ if !self.malicious[index] => value,
            Some(given) => given[index],
            None => self.value.value(index, value),
        }
    }

    /// Whether robot `index` tells everybody the same level, and the same value.
    pub(crate) fn tells_alike(&self, index: usize) -> [bool; 2] {
        if !self.malicious[index] {
            return [true; 2];
        }
        [self.given_levels.is_some() || self.one_level, self.given_values.is_some() || self.one_value]
    }

    /// What goes from `sender` to one robot that holds `value`: `message`, unless the sender has another face for it.
    pub fn face(&mut self, sender: usize, message: &Message, value: f64) -> Face {
        if !self.malicious[sender] {
            return Face::Message(*message);
        }
        let level = match self.level.to_one(message, &mut self.faces) {
            _ if self.given_levels.is_some() => message.level(),
            LevelFace::Silence => return Face::Silence,
            LevelFace::Bytes(bytes) => return Face::Bytes(bytes),
            LevelFace::Level(level) => level,
        };
        let face = message.value().and_then(|told| self.value.to_one(told, value, &mut self.faces));
        let value = if self.given_values.is_some() { message.value() } else { face };
        let told = Message::new(message.sequence(), message.stamp(), level, value);
        told.map_or(Face::Silence, Face::Message)
    }

    /// What goes from `sender` to `reader`, who wants to go with `wish_m_s`, in place of `bytes`; `None` if nothing does.
    pub fn lists<const D: usize>(
        &mut self,
        sender: usize,
        reader: RobotId,
        wish_m_s: &Vector<D>,
        bytes: Bytes,
    ) -> Option<Bytes> {
        if !self.malicious[sender] {
            return Some(bytes);
        }
        self.lists.lists(self.tick, sender, reader, wish_m_s, bytes)
    }

    /// True if `index` keeps its row for everybody, because it acknowledges what it did not receive.
    #[must_use]
    pub fn binds(&self, index: usize) -> bool {
        self.malicious[index] && self.lists.binds()
    }

    /// Where a malicious robot goes that does not obey, m/s; `None` for all others.
    pub fn velocity<const D: usize>(
        &mut self,
        index: usize,
        positions_m: &[Vector<D>],
        input: &InputBox<D>,
    ) -> Option<Vector<D>> {
        if !self.malicious[index] {
            return None;
        }
        self.motion.velocity(index, self.tick, positions_m, input)
    }

    fn time_s(&self) -> f64 {
        f64::from(self.tick) * self.tick_s
    }
}
