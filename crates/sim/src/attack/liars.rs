//! The malicious robots of a run. They wrap the network and the plant: a robot never knows that it lies.

use closeranks_core::message::{MESSAGE_BYTES, Message, VALUE_MAX};
use closeranks_core::num::{Vector, length, sin, subtract};
use closeranks_core::program::InputBox;
use closeranks_core::time::Instant;

use crate::attack::{LevelAttack, MotionAttack, ValueAttack};
use crate::random::{Random, Stream};
use crate::scenario::Scenario;

/// Ticks for which a wandering robot keeps its way.
const WANDER_TICKS: u32 = 20;

/// What malicious robots do in a run.
#[derive(Clone, Debug)]
pub struct Liars {
    level: LevelAttack,
    value: ValueAttack,
    motion: MotionAttack,
    malicious: Vec<bool>,
    tick_s: f64,
    tick: u32,
    random: Random,
    level_random: Random,
    faces: Random,
    ways: Random,
    /// What is added to the level in this tick.
    bias: f64,
    /// What is told in its place, if anything.
    told_levels: Vec<Option<f64>>,
    /// True levels of all ticks, for who tells old ones.
    past: Vec<Vec<f64>>,
    told_values: Vec<f64>,
    /// Least and greatest value of normal robots in this round; 0 if there are none.
    normal: [f64; 2],
    /// Where wandering robots go, m/s per m/s.
    wander: Vec<Vec<f64>>,
}

impl Liars {
    /// The liars of `scenario`.
    #[must_use]
    pub fn new(scenario: &Scenario) -> Self {
        let robots = usize::from(scenario.robots);
        let random = |stream| Random::new(scenario.seed, stream);
        Self {
            level: scenario.level_attack,
            value: scenario.value_attack,
            motion: scenario.motion_attack,
            malicious: scenario.malicious_mask(),
            tick_s: scenario.tick_s(),
            tick: 0,
            random: random(Stream::Attack),
            level_random: random(Stream::Levels),
            faces: random(Stream::Faces),
            ways: random(Stream::Motion),
            bias: 0.0,
            told_levels: vec![None; robots],
            past: vec![Vec::new(); robots],
            told_values: vec![0.0; robots],
            normal: [0.0; 2],
            wander: vec![Vec::new(); robots],
        }
    }

    /// Decides what is told of levels in `tick`; random levels are drawn in order of robot numbers.
    pub fn begin_tick(&mut self, tick: u32) {
        self.tick = tick;
        let time_s = self.time_s();
        self.bias = match self.level {
            LevelAttack::Bias(bias) => bias,
            LevelAttack::Step { bias, from_s } if time_s >= from_s => bias,
            LevelAttack::Ramp { rate_per_s } => rate_per_s * time_s,
            LevelAttack::Sine { amplitude, period_s } => swing(amplitude, period_s, time_s),
            _ => 0.0,
        };
        let LevelAttack::Random { min, max } = self.level else { return };
        for (told, _) in self.told_levels.iter_mut().zip(&self.malicious).filter(|(_, malicious)| **malicious)
        {
            *told = Some(self.level_random.uniform(min, max));
        }
    }

    /// The level that robot `index` holds and tells in this tick when its true one is `level`. Who tells each neighbour
    /// another one holds the true one.
    pub fn level(&mut self, index: usize, level: f64) -> f64 {
        if !self.malicious[index] {
            return level;
        }
        if let LevelAttack::Replay { age_s } = self.level {
            return self.replayed(index, level, age_s);
        }
        match self.told_levels[index] {
            Some(told) => told,
            None if self.bias != 0.0 => level + self.bias,
            None => level,
        }
    }

    fn replayed(&mut self, index: usize, level: f64, age_s: f64) -> f64 {
        let past = &mut self.past[index];
        past.push(level);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let ticks = (age_s / self.tick_s).round() as usize;
        past[past.len().saturating_sub(ticks.saturating_add(1))]
    }

    /// Decides what malicious robots tell in a new round, in order of their number; all robots hold `values`.
    pub fn begin_round(&mut self, values: impl Iterator<Item = f64>) {
        let normal = values.zip(&self.malicious).filter(|(_, malicious)| !**malicious);
        self.normal = normal.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (value, _)| {
            [low.min(value), high.max(value)]
        });
        if !self.malicious.contains(&false) {
            self.normal = [0.0; 2];
        }
        for index in 0..self.malicious.len() {
            if self.malicious[index] {
                self.told_values[index] = self.told_value(index);
            }
        }
    }

    fn told_value(&mut self, index: usize) -> f64 {
        let (time_s, [low, high]) = (self.time_s(), self.normal);
        let even = index.is_multiple_of(2);
        match self.value {
            ValueAttack::Random { min, max } => self.random.uniform(min, max),
            ValueAttack::Constant { value } => value,
            ValueAttack::Ramp { start, rate_per_s } => start + rate_per_s * time_s,
            ValueAttack::Sine { amplitude, period_s } => swing(amplitude, period_s, time_s),
            ValueAttack::Extreme if even == self.tick.is_multiple_of(2) => VALUE_MAX,
            ValueAttack::Extreme => -VALUE_MAX,
            ValueAttack::Sway if even => high,
            ValueAttack::Sway => low,
            ValueAttack::None | ValueAttack::Faces { .. } | ValueAttack::Split | ValueAttack::Silent => 0.0,
        }
    }

    /// The value that robot `index` tells everybody when it holds `value`.
    #[must_use]
    pub fn value(&self, index: usize, value: f64) -> f64 {
        match self.value {
            ValueAttack::None | ValueAttack::Faces { .. } | ValueAttack::Split | ValueAttack::Silent => value,
            _ if self.malicious[index] => self.told_values[index],
            _ => value,
        }
    }

    /// The bytes that go from `sender` to one robot that holds `value`: `message`, unless the sender has another face for it.
    pub fn bytes(&mut self, sender: usize, message: &Message, value: f64) -> Option<[u8; MESSAGE_BYTES]> {
        if !self.malicious[sender] {
            return Some(message.encode());
        }
        let level = match self.level {
            LevelAttack::Silent => return None,
            LevelAttack::Garbage => return Some(self.garbage(message)),
            LevelAttack::Faces { min, max } => self.faces.uniform(min, max),
            _ => message.level(),
        };
        let value = message.value().and_then(|told| self.face(told, value));
        Message::new(message.sequence(), message.stamp(), level, value).ok().map(|message| message.encode())
    }

    fn face(&mut self, told: f64, hearer: f64) -> Option<f64> {
        let [low, high] = self.normal;
        match self.value {
            ValueAttack::Silent => None,
            ValueAttack::Faces { min, max } => Some(self.faces.uniform(min, max)),
            ValueAttack::Split => Some(if hearer > 0.5 * (low + high) { high } else { low }),
            _ => Some(told),
        }
    }

    /// A message in which one number is no number, or much too large, or one byte is another.
    fn garbage(&mut self, message: &Message) -> [u8; MESSAGE_BYTES] {
        let far = Instant::from_nanos(u64::MAX);
        let huge = Message::new(u32::MAX, far, f64::MAX, message.value().map(|_| -VALUE_MAX));
        let mut bytes = huge.map_or_else(|_| message.encode(), |huge| huge.encode());
        let numbers = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -f64::MAX, 1e18, 0.0];
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 32")]
        let mut below = |most: f64| self.faces.uniform(0.0, most) as usize;
        match below(4.0) {
            0 => bytes[16..24].copy_from_slice(&numbers[below(6.0)].to_le_bytes()),
            1 => bytes[24..].copy_from_slice(&numbers[below(6.0)].to_le_bytes()),
            2 => bytes[below(32.0)] ^= 1 << below(8.0),
            _ => {}
        }
        bytes
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
        let way = match self.motion {
            MotionAttack::Obedient => return None,
            MotionAttack::Flee => away(index, positions_m),
            MotionAttack::Wander => self.wander(index),
        };
        let fastest = (0..D).map(|d| input.max_m_s[d].max(-input.min_m_s[d])).fold(0.0, f64::max);
        Some(input.clip(&way.map(|component| 2.0 * fastest * component)))
    }

    fn wander<const D: usize>(&mut self, index: usize) -> Vector<D> {
        if self.wander[index].len() != D || self.tick.is_multiple_of(WANDER_TICKS) {
            self.wander[index] = self.ways.in_ball::<D>().to_vec();
        }
        core::array::from_fn(|d| self.wander[index][d])
    }

    fn time_s(&self) -> f64 {
        f64::from(self.tick) * self.tick_s
    }
}

/// `amplitude · sin(2π t/period)`.
fn swing(amplitude: f64, period_s: f64, time_s: f64) -> f64 {
    amplitude * sin(2.0 * core::f64::consts::PI * (time_s / period_s))
}

/// From the mean of the others, of length 1.
fn away<const D: usize>(index: usize, positions_m: &[Vector<D>]) -> Vector<D> {
    let offsets = positions_m.iter().map(|other| subtract(&positions_m[index], other));
    let sum = offsets.fold([0.0; D], |sum, offset| core::array::from_fn(|d| sum[d] + offset[d]));
    let size = length(&sum);
    if size > 0.0 { sum.map(|component| component / size) } else { [0.0; D] }
}

/// Mean distance from normal to malicious robots, m; `None` without both kinds.
#[must_use]
pub fn mean_distance_to_liars<const D: usize>(positions: &[Vector<D>], malicious: &[bool]) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0_u32);
    for (x, _) in positions.iter().zip(malicious).filter(|(_, malicious)| !**malicious) {
        for (y, _) in positions.iter().zip(malicious).filter(|(_, malicious)| **malicious) {
            sum += length(&subtract(x, y));
            count += 1;
        }
    }
    (count > 0).then(|| sum / f64::from(count))
}
