//! Numbers whose exponent cannot overflow: for exponentials of told levels, which may be anything.

/// `mantissa · 2^exponent`.
///
/// The mantissa stays within a few orders of 1 (or is 0); scaling by powers of two is exact, so a sum of `Scaled`
/// numbers rounds exactly as the same sum of `f64` does wherever `f64` neither overflows nor underflows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled {
    /// Finite; 0 means the number is 0.
    pub mantissa: f64,
    /// The binary exponent, which saturates.
    pub exponent: i32,
}

/// `2^exponent`; 0 below 2⁻¹⁰²¹ (so that no product with a mantissa is subnormal), infinity above 2¹⁰²³.
#[inline]
fn power_of_two(exponent: i32) -> f64 {
    let biased = exponent.saturating_add(1023).clamp(1, 2047).unsigned_abs();
    if biased == 1 { 0.0 } else { f64::from_bits(u64::from(biased) << 52) }
}

impl Scaled {
    /// 0.
    pub const ZERO: Self = Self { mantissa: 0.0, exponent: 0 };

    /// The number of a finite `f64`, with the mantissa in [1, 2) up to sign. Subnormal numbers count as 0.
    #[must_use]
    pub fn new(value: f64) -> Self {
        let biased = i32::try_from((value.to_bits() >> 52) & 0x7ff).unwrap_or(0);
        if biased == 0 {
            return Self::ZERO;
        }
        let exponent = biased - 1023;
        let mantissa_bits = (value.to_bits() & !(0x7ff << 52)) | (1023 << 52);
        Self { mantissa: f64::from_bits(mantissa_bits), exponent }
    }

    /// This is the same number with its mantissa in [1, 2), up to the sign.
    #[must_use]
    pub fn normalized(self) -> Self {
        let inner = Self::new(self.mantissa);
        Self { mantissa: inner.mantissa, exponent: self.exponent.saturating_add(inner.exponent) }
    }

    /// The number as `f64`: 0 below 2⁻¹⁰²¹, ±infinity above the largest.
    #[inline]
    #[must_use]
    pub fn value(self) -> f64 {
        if self.mantissa == 0.0 { 0.0 } else { self.mantissa * power_of_two(self.exponent) }
    }

    /// The number times `2^shift`.
    #[must_use]
    pub fn shifted(self, shift: i32) -> Self {
        Self { mantissa: self.mantissa, exponent: self.exponent.saturating_add(shift) }
    }

    /// Product.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        Self {
            mantissa: self.mantissa * other.mantissa,
            exponent: self.exponent.saturating_add(other.exponent),
        }
    }

    /// The sum, aligned to the larger exponent. What lies 2¹⁰²¹ below it is lost.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        if self.mantissa == 0.0 {
            return other;
        }
        if other.mantissa == 0.0 {
            return self;
        }
        let (large, small) = if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let gap = small.exponent.saturating_sub(large.exponent);
        Self { mantissa: large.mantissa + small.mantissa * power_of_two(gap), exponent: large.exponent }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::number::Number;

    #[test]
    fn new_and_value_are_inverse() {
        for x in [1.0, -2.5, 0.1, 1e300, -1e-300, 2.0 * f64::MIN_POSITIVE, f64::MAX] {
            assert_eq!(Scaled::new(x).value(), x);
        }
        assert_eq!(Scaled::new(0.0).value(), 0.0);
    }

    #[test]
    fn sums_round_as_f64_does() {
        let numbers = [0.1, 3e7, -0.7, 1e-9, 5.5, -3e7];
        let plain: f64 = numbers.iter().sum();
        let scaled = numbers.iter().fold(Scaled::ZERO, |sum, &x| Number::plus(sum, Scaled::new(x)));
        assert_eq!(scaled.value(), plain);
    }

    #[test]
    fn a_vanishing_number_keeps_its_direction_and_a_huge_one_its_sign() {
        let tiny = Scaled { mantissa: -1.5, exponent: -90_000 };
        assert_eq!(tiny.value(), 0.0);
        assert_eq!(tiny.shifted(90_000).value(), -1.5);
        assert_eq!(Scaled { mantissa: -1.5, exponent: 90_000 }.value(), f64::NEG_INFINITY);
        assert_eq!(tiny.plus(Scaled::new(1.0)).value(), 1.0);
    }
}
