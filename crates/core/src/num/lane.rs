//! A lane is the same number of many worlds, side by side. What is computed for all of them in one loop without branches is vectorised.

use crate::num::Vector;

/// How many worlds lie side by side. With 8 the compiler unrolls loops before it looks for what it can vectorise.
pub const LANES: usize = 16;

/// A number of each world.
pub type Lane = [f64; LANES];

/// A fact as a number that lies beside others: 1 if it is so, else 0.
#[inline]
#[must_use]
pub fn fact(is_so: bool) -> f64 {
    if is_so { 1.0 } else { 0.0 }
}

/// True if such a number says that it is so.
#[inline]
#[must_use]
pub fn is_so(fact: f64) -> bool {
    fact != 0.0
}

/// `bits` if it is so, else none.
#[inline]
#[must_use]
pub fn bits_if(is_so: bool, bits: u64) -> u64 {
    u64::from(is_so).wrapping_neg() & bits
}

/// A vector in one lane.
#[inline]
#[must_use]
pub fn at<const D: usize>(vectors: &[Lane; D], lane: usize) -> Vector<D> {
    core::array::from_fn(|d| vectors[d][lane])
}
