//! What malicious robots tell instead of the truth. They wrap the network: a robot never knows that it lies.

use closeranks_core::math::Vector;

use crate::random::{Random, Stream};
use crate::scenario::Scenario;

/// A lie about the connectivity level c_i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LevelAttack {
    /// The paper's nominal updating: the truth.
    None,
    /// The paper's understating (−2.5) and overstating (+3.5): a constant bias ε_i (thm:cbf-qp).
    Bias(f64),
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
        }
    }

    /// The level that robot `index` tells when its true one is `level`.
    #[must_use]
    pub fn level(&self, index: usize, level: f64) -> f64 {
        match self.level {
            LevelAttack::Bias(bias) if self.malicious[index] => level + bias,
            _ => level,
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
