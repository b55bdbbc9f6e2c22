//! Time as an argument: the core reads no clock.

use core::time::Duration;

/// A moment on the owner's own monotonic clock, in nanoseconds since any fixed start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Instant(u64);

impl Instant {
    /// The start of the clock, t₀.
    pub const START: Self = Self(0);

    /// The moment so many nanoseconds after the start.
    #[must_use]
    pub fn from_nanos(nanos: u64) -> Self {
        Self(nanos)
    }

    /// How many nanoseconds after the start it is.
    #[must_use]
    pub fn as_nanos(self) -> u64 {
        self.0
    }

    /// This moment plus `period`. At the end of time (584 years) it stops instead of wrapping.
    #[must_use]
    pub fn after(self, period: Duration) -> Self {
        let seconds = period.as_secs().saturating_mul(1_000_000_000);
        Self(self.0.saturating_add(seconds.saturating_add(u64::from(period.subsec_nanos()))))
    }

    /// True if `earlier` is no longer ago than `most`, or lies in the future: [`since`](Self::since) is at most `most`.
    #[must_use]
    pub fn is_within(self, most: Duration, earlier: Self) -> bool {
        self <= earlier.after(most)
    }

    /// Time since `earlier`, 0 if that lies in the future.
    #[must_use]
    pub fn since(self, earlier: Self) -> Duration {
        Duration::from_nanos(self.0.saturating_sub(earlier.0))
    }
}

/// A clock that is due every `period`, as `t_l = l τ₁` and `t_p = p τ₂` in the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Timer {
    period: Duration,
    due: Instant,
}

impl Timer {
    /// A timer that is due at `first`, and then every `period` (positive).
    pub(crate) fn new(first: Instant, period: Duration) -> Self {
        Self { period, due: first }
    }

    /// When the timer is due next.
    pub(crate) fn due(&self) -> Instant {
        self.due
    }

    /// True once for each time it was due. After a long pause it fires once, at once, and stays on its grid.
    pub(crate) fn fires(&mut self, now: Instant) -> bool {
        let due = now >= self.due;
        if due {
            self.skip(now);
        }
        due
    }

    /// As [`fires`](Self::fires), but whoever is later than `slack` for a turn waits for the next one.
    pub(crate) fn fires_in_turn(&mut self, now: Instant, slack: Duration) -> bool {
        let period = u64::try_from(self.period.as_nanos()).unwrap_or(u64::MAX).max(1);
        let late = now.0.saturating_sub(self.due.0) % period;
        self.fires(now) && u128::from(late) <= slack.as_nanos()
    }

    fn skip(&mut self, now: Instant) {
        self.due = self.due.after(self.period);
        if self.due <= now {
            let period = u64::try_from(self.period.as_nanos()).unwrap_or(u64::MAX).max(1);
            let late = now.0 - self.due.0;
            self.due = Instant(now.0.saturating_add(period - late % period));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_timer_keeps_its_grid_and_does_not_pile_up_missed_turns() {
        let mut timer = Timer::new(Instant::START, Duration::from_millis(100));
        let at = |ms: u64| Instant::from_nanos(ms * 1_000_000);
        assert!(timer.fires(at(0)) && !timer.fires(at(0)) && !timer.fires(at(99)));
        assert!(timer.fires(at(105)));
        assert_eq!(timer.due(), at(200), "late by 5 ms, the grid stays");
        assert!(timer.fires(at(1_030)) && !timer.fires(at(1_050)));
        assert_eq!(timer.due(), at(1_100));
    }

    #[test]
    fn who_is_too_late_for_a_turn_waits_for_the_next_one() {
        let mut timer = Timer::new(Instant::START, Duration::from_millis(100));
        let at = |ms: u64| Instant::from_nanos(ms * 1_000_000);
        let mut fires = |ms| timer.fires_in_turn(at(ms), Duration::from_millis(5));
        assert!(fires(0) && fires(105));
        assert!(!fires(206) && !fires(250) && fires(300));
        assert!(!fires(430) && fires(901));
        assert_eq!(timer.due(), at(1_000));
    }

    #[test]
    fn the_end_of_time_is_a_bound_and_not_a_panic() {
        let end = Instant::from_nanos(u64::MAX);
        assert_eq!(end.after(Duration::MAX), end);
        assert_eq!(Instant::START.since(end), Duration::ZERO);
    }
}
