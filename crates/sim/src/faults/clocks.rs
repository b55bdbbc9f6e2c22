//! The robots' own clocks, which need not show the time of the world.

use core::time::Duration;

use closeranks_core::settings::range::Allowed;
use closeranks_core::time::Instant;

use crate::parse::common::set;
use crate::parse::reader::{Reader, Section};
use crate::random::{Random, Stream};

/// How far clocks are off. Each robot's offset and drift are drawn evenly.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clocks {
    /// Each clock is ahead by an offset between 0 and this, s.
    pub offset_max_s: f64,
    /// Each clock is fast or slow by up to this, s/s.
    pub drift_max: f64,
}

impl Clocks {
    /// Reads the table `clocks` of a scenario text.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>) -> Self {
        let mut clocks = Self::default();
        set(&mut clocks.offset_max_s, reader.number(section, "offset_max_s", Allowed::Closed(0.0, 3_600.0)));
        set(&mut clocks.drift_max, reader.number(section, "drift_max", Allowed::Closed(0.0, 0.5)));
        clocks
    }
}

/// The clocks of a run.
#[derive(Clone, Debug)]
pub struct Shown {
    offsets_s: Vec<f64>,
    drifts: Vec<f64>,
    tick_nanos: u64,
}

impl Shown {
    /// The clocks of so many robots that tick every `tick`.
    #[must_use]
    pub fn new(clocks: Clocks, seed: u64, robots: u16, tick: Duration) -> Self {
        let Clocks { offset_max_s, drift_max } = clocks;
        let mut random = Random::new(seed, Stream::Clocks);
        let mut draws = |min, max| (0..robots).map(|_| random.uniform(min, max)).collect();
        Self {
            offsets_s: draws(0.0, offset_max_s),
            drifts: draws(-drift_max, drift_max),
            tick_nanos: u64::try_from(tick.as_nanos()).unwrap_or(u64::MAX),
        }
    }

    /// What the clock of robot `index` shows at `tick`.
    #[must_use]
    pub fn now(&self, index: usize, tick: u32) -> Instant {
        let world = u64::from(tick).saturating_mul(self.tick_nanos);
        let (offset_s, drift) = (self.offsets_s[index], self.drifts[index]);
        if offset_s == 0.0 && drift == 0.0 {
            return Instant::from_nanos(world);
        }
        #[expect(clippy::cast_precision_loss, reason = "a nanosecond more or less in three months")]
        let off = offset_s * 1e9 + drift * world as f64;
        #[expect(clippy::cast_possible_truncation, reason = "saturates")]
        let off = off as i64;
        Instant::from_nanos(world.saturating_add_signed(off))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clocks_differ_by_their_offsets_and_ever_more_by_their_drifts() {
        let shown = |clocks| Shown::new(clocks, 1, 11, Duration::from_millis(5));
        assert_eq!(shown(Clocks::default()).now(3, 7), Instant::from_nanos(35_000_000));
        let shown = shown(Clocks { offset_max_s: 0.2, drift_max: 0.01 });
        let spread_s = |tick| {
            let times = || (0..11).map(|index| shown.now(index, tick));
            times().max().zip(times().min()).map_or(0.0, |(last, first)| last.since(first).as_secs_f64())
        };
        assert!((0.05..=0.2).contains(&spread_s(0)));
        assert!((0.05..=0.4).contains(&spread_s(2_000)), "at most 0.2 more after 10 s");
        assert_ne!(spread_s(0), spread_s(2_000));
        assert!((0..11).all(|index| shown.now(index, 1) > shown.now(index, 0)));
    }
}
