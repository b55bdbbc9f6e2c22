//! How many envelopes a second are looked at.

use closeranks_core::Instant;

/// Holds up to a number of tokens, fills evenly, and gives one for each envelope.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bucket {
    per_s: f64,
    burst: f64,
    tokens: f64,
    at: Instant,
}

impl Bucket {
    /// A full bucket.
    pub(crate) fn new(per_s: f64, burst: f64) -> Self {
        Self { per_s, burst, tokens: burst, at: Instant::START }
    }

    /// True if there is a token at `now`; it is gone then.
    pub(crate) fn take(&mut self, now: Instant) -> bool {
        self.tokens = (self.tokens + self.per_s * now.since(self.at).as_secs_f64()).min(self.burst);
        self.at = self.at.max(now);
        let some = self.tokens >= 1.0;
        if some {
            self.tokens -= 1.0;
        }
        some
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_pass_than_the_rate_and_the_burst() {
        let mut bucket = Bucket::new(10.0, 5.0);
        let passed = (0..1_000_u64).filter(|ms| bucket.take(Instant::from_nanos(ms * 1_000_000))).count();
        assert!((14..=15).contains(&passed), "{passed}");
        assert!(!bucket.take(Instant::START), "a clock that falls gives nothing");
    }
}
