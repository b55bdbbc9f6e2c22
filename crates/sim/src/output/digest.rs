//! A digest of a run that grows tick by tick, so that two programs can compare runs that neither of them keeps.

use crate::frame::Frame;

/// The multiplier of FNV-1a.
const PRIME: u64 = 0x0000_0100_0000_01b3;

/// NaN has many bit patterns, and targets differ in which they choose.
const NAN_BITS: u64 = 0x7ff8_0000_0000_0000;

/// Equal digests mean equal runs: positions, inputs, degrees, levels, what was told, h, values and outcomes of every robot in every
/// tick, bit for bit, in the order of ticks and then of these columns.
///
/// ```text
/// digest ← rotate_left((digest ^ word) · 0x100000001b3, 29)      for each number as 64 bits
/// ```
///
/// φ_i is left out, because not every run wants to know it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Digest {
    /// Adds a tick.
    pub fn watch<const D: usize>(&mut self, frame: &Frame<D>) {
        let vectors = [&frame.positions_m, &frame.velocities_m_s];
        vectors.into_iter().flatten().flatten().for_each(|number| self.number(*number));
        frame.degrees.iter().for_each(|degree| self.word(u64::from(*degree)));
        let numbers = [&frame.levels, &frame.told, &frame.h, &frame.values];
        numbers.into_iter().flatten().for_each(|number| self.number(*number));
        frame.outcomes.iter().for_each(|outcome| self.word(*outcome as u64));
        frame.more_values.iter().flatten().for_each(|number| self.number(*number));
    }

    /// The digest of all ticks so far.
    #[must_use]
    pub fn value(self) -> u64 {
        self.0
    }

    fn number(&mut self, number: f64) {
        self.word(if number.is_nan() { NAN_BITS } else { number.to_bits() });
    }

    fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(PRIME).rotate_left(29);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn digest(frames: &[Frame<2>]) -> u64 {
        let mut digest = Digest::default();
        for frame in frames {
            digest.watch(frame);
        }
        digest.value()
    }

    #[test]
    fn every_number_counts_and_so_does_the_order_of_ticks() {
        let frame = Frame::new(vec![[0.0, 1.0], [2.0, 3.0]], vec![4.0, 5.0]);
        let changed = |change: &dyn Fn(&mut Frame<2>)| {
            let mut other = frame.clone();
            change(&mut other);
            other
        };
        let others = [
            changed(&|frame| frame.positions_m[1][0] = -2.0),
            changed(&|frame| frame.positions_m[0][0] = -0.0),
            changed(&|frame| frame.velocities_m_s[0][1] = 1e-300),
            changed(&|frame| frame.degrees[1] = 1),
            changed(&|frame| frame.told[0] = 1.0),
            changed(&|frame| frame.values[1] = 5.000_000_000_000_001),
            changed(&|frame| frame.values[1] = f64::NAN),
        ];
        let mut all: Vec<u64> = others.iter().map(|other| digest(core::slice::from_ref(other))).collect();
        all.push(digest(core::slice::from_ref(&frame)));
        all.push(digest(&[frame.clone(), others[0].clone()]));
        all.push(digest(&[others[0].clone(), frame.clone()]));
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count);
    }

    #[test]
    fn every_nan_is_alike() {
        let with = |nan| digest(&[Frame::new(vec![[0.0, 0.0]], vec![nan])]);
        assert_eq!(with(f64::NAN), with(-f64::NAN));
    }
}
