//! When things happen, and how old they may be.

use core::time::Duration;

/// Periods and ages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Clock {
    /// τ₁: how often the level is shared.
    pub level_period: Duration,
    /// τ₂: how often the value is shared and updated.
    pub value_period: Duration,
    /// The longest that a velocity is held before the next tick, at least τ₁; `None` stands for τ₁. The rows of `budget` are
    /// made for moves over this time, so it must cover the jitter of the ticks.
    pub hold_max: Option<Duration>,
    /// A robot that saw an assumption broken promises nothing for so long. Under `links` what was told longer ago counts as not
    /// told, and a neighbour that is not sensed for so long is given up.
    pub told_max: Duration,
    /// Bound of the difference between the clocks of any two robots: a value that seems to be of before a round counts in it
    /// up to so much.
    pub error: Duration,
}

impl Default for Clock {
    fn default() -> Self {
        Self {
            level_period: Duration::from_millis(5),
            value_period: Duration::from_millis(100),
            hold_max: None,
            told_max: Duration::from_secs(1),
            error: Duration::ZERO,
        }
    }
}

impl Clock {
    /// How long a velocity may be held: the given time, or τ₁.
    #[must_use]
    pub fn hold_max(&self) -> Duration {
        self.hold_max.unwrap_or(self.level_period)
    }
}
