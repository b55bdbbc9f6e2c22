//! What malicious robots tell instead of the truth. They wrap the network: a robot never knows that it lies.

use closeranks_core::math::{Vector, sin};

use crate::random::{Random, Stream};
use crate::scenario::Scenario;

/// A lie about the connectivity level c_i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LevelAttack {
    /// The paper's nominal updating: the truth.
    None,
    /// The paper's understating (−2.5) and overstating (+3.5): a constant bias ε_i (thm:cbf-qp).
    Bias(f64),
    /// The truth at first, then a bias: outside thm:cbf-qp (METHOD.md 2.6).
    Step {
        /// Added from then on.
        bias: f64,
        /// When it begins, s.
        from_s: f64,
    },
    /// A bias that swings, `amplitude · sin(2π t/period)`: outside thm:cbf-qp.
    Sine {
        /// Greatest bias.
        amplitude: f64,
        /// s.
        period_s: f64,
    },
    /// In place of the level, drawn evenly from the interval in every tick.
    Random {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
    },
}

/// A lie about the value y_i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ValueAttack {
    /// Follows W-MSR.
    None,
    /// The paper's: drawn evenly from the interval in every round, the same to every neighbour.
    Random {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
    },
}

/// The malicious robots of a run.
#[derive(Clone, Debug)]
pub struct Liars {
    level: LevelAttack,
    value: ValueAttack,
    malicious: Vec<bool>,
    random: Random,
    told_values: Vec<f64>,
    level_random: Random,
    /// What is added to the level in this tick.
    bias: f64,
    /// What is told in its place, if anything.
    told_levels: Vec<Option<f64>>,
}

impl Liars {
    /// The liars of `scenario`.
    #[must_use]
    pub fn new(scenario: &Scenario) -> Self {
        Self {
            level: scenario.level_attack,
            value: scenario.value_attack,
            malicious: scenario.malicious_mask(),
            random: Random::new(scenario.seed, Stream::Attack),
            told_values: vec![0.0; usize::from(scenario.robots)],
            level_random: Random::new(scenario.seed, Stream::Levels),
            bias: 0.0,
            told_levels: vec![None; usize::from(scenario.robots)],
        }
    }

    /// Decides what is told of levels in the tick at `time_s`; random levels are drawn in order of robot numbers.
    pub fn begin_tick(&mut self, time_s: f64) {
        self.bias = match self.level {
            LevelAttack::None | LevelAttack::Random { .. } => 0.0,
            LevelAttack::Bias(bias) => bias,
            LevelAttack::Step { bias, from_s } => {
                if time_s >= from_s {
                    bias
                } else {
                    0.0
                }
            }
            LevelAttack::Sine { amplitude, period_s } => {
                amplitude * sin(2.0 * core::f64::consts::PI * (time_s / period_s))
            }
        };
        let LevelAttack::Random { min, max } = self.level else { return };
        for (told, _) in self.told_levels.iter_mut().zip(&self.malicious).filter(|(_, malicious)| **malicious)
        {
            *told = Some(self.level_random.uniform(min, max));
        }
    }

    /// The level that robot `index` tells in this tick when its true one is `level`.
    #[must_use]
    pub fn level(&self, index: usize, level: f64) -> f64 {
        match self.told_levels[index] {
            Some(told) => told,
            None if self.malicious[index] && self.bias != 0.0 => level + self.bias,
            None => level,
        }
    }

    /// Draws what malicious robots tell in a new round, in order of their number.
    pub fn begin_round(&mut self) {
        let ValueAttack::Random { min, max } = self.value else { return };
        for index in 0..self.malicious.len() {
            if self.malicious[index] {
                self.told_values[index] = self.random.uniform(min, max);
            }
        }
    }

    /// The value that robot `index` tells when it holds `value`.
    #[must_use]
    pub fn value(&self, index: usize, value: f64) -> f64 {
        match self.value {
            ValueAttack::Random { .. } if self.malicious[index] => self.told_values[index],
            _ => value,
        }
    }
}

/// Mean distance from normal to malicious robots, m; `None` without both kinds.
#[must_use]
pub fn mean_distance_to_liars<const D: usize>(positions: &[Vector<D>], malicious: &[bool]) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0_u32);
    for (x, _) in positions.iter().zip(malicious).filter(|(_, malicious)| !**malicious) {
        for (y, _) in positions.iter().zip(malicious).filter(|(_, malicious)| **malicious) {
            sum += closeranks_core::math::length(&closeranks_core::math::subtract(x, y));
            count += 1;
        }
    }
    (count > 0).then(|| sum / f64::from(count))
}
