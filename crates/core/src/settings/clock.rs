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
    /// A level told longer ago than this counts as not told. It bounds how long a broken assumption is felt.
    pub told_max: Duration,
    /// Bound of the difference between the clocks of any two robots. A told level counts as that much older than it says.
    pub error: Duration,
    /// Bound p of what any clock gains or loses in a second, less than a second. Ages are stretched by `(1 + p)/(1 − p)`: if all
    /// clocks are slow together, their differences do not show it.
    pub drift: Duration,
}

impl Default for Clock {
    fn default() -> Self {
        Self {
            level_period: Duration::from_millis(5),
            value_period: Duration::from_millis(100),
            hold_max: None,
            told_max: Duration::from_secs(1),
            error: Duration::ZERO,
            drift: Duration::ZERO,
        }
    }
}

impl Clock {
    /// How long a velocity may be held: the given time, or τ₁.
    #[must_use]
    pub fn hold_max(&self) -> Duration {
        self.hold_max.unwrap_or(self.level_period)
    }

    /// The longest time that other robots may have counted while the own clock counted `age`.
    ///
    /// ```text
    /// (1 + p)/(1 − p) · age        rounded up; without end if p is a second or more
    /// ```
    //= theory sec:clocks
    #[must_use]
    pub fn stretched(&self, age: Duration) -> Duration {
        const SECOND: u128 = 1_000_000_000;
        let drift = self.drift.as_nanos();
        if drift == 0 {
            return age;
        }
        let Some(slowest) = SECOND.checked_sub(drift).filter(|slowest| *slowest > 0) else {
            return Duration::MAX;
        };
        let nanos = age.as_nanos().saturating_mul(SECOND + drift).div_ceil(slowest);
        u64::try_from(nanos).map_or(Duration::MAX, Duration::from_nanos)
    }
}
