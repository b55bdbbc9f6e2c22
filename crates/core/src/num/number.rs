//! The arithmetic of links and rows, in plain numbers and in those that cannot overflow.

use crate::num::exponential::{exp, exp_scaled};
use crate::num::scaled::Scaled;

/// The arithmetic that links and rows are made of: plain `f64`, or [`Scaled`] where that runs out of range.
///
/// Both give the same bits wherever `f64` neither overflows nor underflows.
pub trait Number: Copy {
    /// 0.
    const ZERO: Self;
    /// `eˣ`.
    #[must_use]
    fn exp(x: f64) -> Self;
    /// The number as `f64`; 0 or infinity where that is out of range.
    #[must_use]
    fn to_f64(self) -> f64;
    /// The number with this mantissa and exponent. As `f64` it becomes 0 or infinity where that is out of range.
    #[must_use]
    fn from_scaled(number: Scaled) -> Self;
    /// The number of an ordinary one, which is 0 or not subnormal.
    #[must_use]
    fn from_f64(number: f64) -> Self;
    /// Sum.
    #[must_use]
    fn plus(self, other: Self) -> Self;
    /// Product.
    #[must_use]
    fn times(self, other: Self) -> Self;
    /// Product with an ordinary number.
    #[must_use]
    fn times_f64(self, factor: f64) -> Self;
}

impl Number for f64 {
    const ZERO: Self = 0.0;
    #[inline]
    fn exp(x: f64) -> Self {
        exp(x)
    }
    fn to_f64(self) -> f64 {
        self
    }
    fn from_scaled(number: Scaled) -> Self {
        number.value()
    }
    fn from_f64(number: f64) -> Self {
        number
    }
    fn plus(self, other: Self) -> Self {
        self + other
    }
    fn times(self, other: Self) -> Self {
        self * other
    }
    fn times_f64(self, factor: f64) -> Self {
        self * factor
    }
}

impl Number for Scaled {
    const ZERO: Self = Self::ZERO;
    fn exp(x: f64) -> Self {
        exp_scaled(x)
    }
    fn to_f64(self) -> f64 {
        self.value()
    }
    fn from_scaled(number: Scaled) -> Self {
        number
    }
    fn from_f64(number: f64) -> Self {
        Self::new(number)
    }
    fn plus(self, other: Self) -> Self {
        Self::plus(self, other).normalized()
    }
    fn times(self, other: Self) -> Self {
        Self::times(self, other)
    }
    fn times_f64(self, factor: f64) -> Self {
        Self::times(self, Self::new(factor)).normalized()
    }
}
