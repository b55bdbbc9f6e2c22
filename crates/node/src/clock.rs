//! The only file that reads a clock.
//!
//! All robots of a team use one clock, because a told level counts for less the older it is, and rounds of consensus begin
//! together. On one machine that is the machine's monotonic clock, which is the same in every process and never steps. On
//! several machines it is each machine's time of day as it was when the process began, carried on by the monotonic clock; NTP
//! or PTP must then hold the machines together within `clock.error_s` of the roster. Nobody can check that alone, but who is
//! ahead by more is noticed: what it sends is counted as from the future and not used.

use core::time::Duration;
use std::time::{SystemTime, UNIX_EPOCH};

use closeranks_core::Instant;
use rustix::time::{ClockId, clock_gettime};
use serde::{Deserialize, Serialize};

/// Which clock a team uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The monotonic clock of one machine, for teams whose processes all run there.
    Machine,
    /// The time of day at the start, and the monotonic clock from then on.
    #[default]
    Wall,
}

/// A clock that never falls.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// What is added to the monotonic clock, ns.
    ahead: u64,
}

impl Clock {
    /// Starts a clock.
    #[must_use]
    pub fn start(kind: Kind) -> Self {
        let ahead = match kind {
            Kind::Machine => 0,
            Kind::Wall => wall().saturating_sub(monotonic()),
        };
        Self { ahead }
    }

    /// What time it is.
    #[must_use]
    pub fn now(&self) -> Instant {
        Instant::from_nanos(monotonic().saturating_add(self.ahead))
    }
}

/// The last multiple of `period` that is not after `now`: the beginning of its tick.
#[must_use]
pub fn tick(now: Instant, period: Duration) -> Instant {
    let period = u64::try_from(period.as_nanos()).unwrap_or(u64::MAX).max(1);
    Instant::from_nanos(now.as_nanos() / period * period)
}

/// The beginning of a round after `now`, when ticks take `period` and rounds `round`.
#[must_use]
pub fn next_round(now: Instant, round: Duration) -> Instant {
    tick(now.after(round), round)
}

fn monotonic() -> u64 {
    let time = clock_gettime(ClockId::Monotonic);
    let [seconds, nanos] = [time.tv_sec, time.tv_nsec].map(|part| u64::try_from(part).unwrap_or(0));
    seconds.saturating_mul(1_000_000_000).saturating_add(nanos)
}

/// The CPU time that this process has used.
#[must_use]
pub fn cpu() -> Duration {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    let [seconds, nanos] = [time.tv_sec, time.tv_nsec].map(|part| u64::try_from(part).unwrap_or(0));
    Duration::from_nanos(seconds.saturating_mul(1_000_000_000).saturating_add(nanos))
}

/// Nanoseconds since 1970, for the stamps of ROS 2. Nothing is decided by it.
#[must_use]
pub fn wall_nanos() -> u64 {
    wall()
}

#[expect(clippy::disallowed_methods, reason = "the clock of the node")]
fn wall() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    u64::try_from(since.as_nanos()).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_does_not_fall_and_ticks_begin_on_a_grid() {
        for kind in [Kind::Machine, Kind::Wall] {
            let clock = Clock::start(kind);
            let (first, second) = (clock.now(), clock.now());
            assert!(second >= first);
            let period = Duration::from_millis(50);
            let began = tick(first, period);
            assert!(began <= first && first < began.after(period));
            assert_eq!(began.as_nanos() % 50_000_000, 0);
        }
    }
}
