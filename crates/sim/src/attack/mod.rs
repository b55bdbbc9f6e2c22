//! What malicious robots tell instead of the truth, and where they go, as data. [`crate::attack::liars`] plays it.

pub mod liars;

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
    /// A bias that grows, `rate · t`.
    Ramp {
        /// 1/s.
        rate_per_s: f64,
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
    /// The same, drawn for every neighbour on its own.
    Faces {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
    },
    /// The level of some time ago, told as if it were of now.
    Replay {
        /// s.
        age_s: f64,
    },
    /// Bytes with NaN, infinities and huge numbers in them, stamps from the future, half messages.
    Garbage,
    /// No message at all.
    Silent,
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
    /// Always the same.
    Constant {
        /// Told.
        value: f64,
    },
    /// `start + rate · t`.
    Ramp {
        /// Told at first.
        start: f64,
        /// 1/s.
        rate_per_s: f64,
    },
    /// `amplitude · sin(2π t/period)`.
    Sine {
        /// Greatest.
        amplitude: f64,
        /// s.
        period_s: f64,
    },
    /// ±10³⁰⁰, by turns.
    Extreme,
    /// Drawn for every neighbour on its own. Outside thm:rs_robust, which needs one voice; covered by Theorem A′.
    Faces {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
    },
    /// Colluding with one voice: every other one tells the greatest value of normal robots, the rest the least, so that none
    /// of it is discarded where it helps.
    Sway,
    /// Colluding with two faces, the strongest we know: whoever is in the upper half hears the greatest value of normal
    /// robots, the others the least.
    Split,
    /// No value.
    Silent,
}

impl ValueAttack {
    /// True when all neighbours are told the same, as def:malicious wants it.
    #[must_use]
    pub fn one_voice(&self) -> bool {
        !matches!(self, Self::Faces { .. } | Self::Split)
    }
}

/// Where malicious robots go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MotionAttack {
    /// Where their controller lets them (Assumption 1).
    #[default]
    Obedient,
    /// Away from the others as fast as they can.
    Flee,
    /// Somewhere else every 20 ticks, as fast as they can.
    Wander,
}
