//! Random numbers that are the same in every run: splitmix64.

#![allow(dead_code, reason = "not every file of tests draws both kinds")]

pub(crate) struct Seeded(pub(crate) u64);

impl Seeded {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// Uniform among `0..count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.bits() % (count as u64)).unwrap_or(0)
    }

    /// Uniform in `[low, high)`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = f64::from_bits(0x3ff0_0000_0000_0000 | (self.bits() >> 12)) - 1.0;
        low + (high - low) * unit
    }
}
