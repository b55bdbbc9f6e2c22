//! Bytes as a source of choices and numbers.

use closeranks_core::num::Vector;

/// Where arithmetic ends, and where settings do.
const NASTY: [f64; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    5e-324,
    -5e-324,
    f64::MIN_POSITIVE,
    f64::EPSILON,
    1e-160,
    1e-6,
    3.0,
    1e6,
    -1e6,
    1e150,
    1e154,
    -1e155,
    1e300,
    -1e300,
    f64::MAX,
    f64::MIN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    -f64::NAN,
];

/// The bytes not yet used. When there are none left, zeros follow.
pub(crate) struct Source<'a>(pub(crate) &'a [u8]);

impl Source<'_> {
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn byte(&mut self) -> u8 {
        let [byte] = self.take();
        byte
    }

    /// One of `0..count`, count at most 256.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    pub(crate) fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// The next N bytes, zeros after the last.
    pub(crate) fn take<const N: usize>(&mut self) -> [u8; N] {
        let (now, later) = self.0.split_at(N.min(self.0.len()));
        self.0 = later;
        core::array::from_fn(|index| now.get(index).copied().unwrap_or(0))
    }

    /// Small as a rule, nasty now and then, and sometimes any bits at all.
    pub(crate) fn number(&mut self) -> f64 {
        match self.byte() {
            0..=159 => self.near(),
            160..=207 => self.pick(&NASTY),
            208..=231 => f64::from(f32::from_le_bytes(self.take())),
            232..=255 => f64::from_le_bytes(self.take()),
        }
    }

    /// From −4 to 4.
    pub(crate) fn near(&mut self) -> f64 {
        f64::from(i16::from_le_bytes(self.take())) / 8_192.0
    }

    /// Close to the origin as a rule.
    pub(crate) fn position<const D: usize>(&mut self) -> Vector<D> {
        if self.byte() < 224 {
            core::array::from_fn(|_| self.near() / 2.0)
        } else {
            core::array::from_fn(|_| self.number())
        }
    }
}
