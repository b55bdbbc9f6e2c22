//! Small vectors, the square root and the exponential. No other place computes a function that platforms differ in.

pub(crate) mod exponential;
pub mod lane;
pub mod number;
pub mod scaled;

pub use crate::num::exponential::{exp, exp_scaled};

/// A point, an offset (m) or a velocity (m/s) in `D` dimensions.
pub type Vector<const D: usize> = [f64; D];

/// Inner product `a·b`, summed from the first component on.
#[must_use]
pub fn dot<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    let mut sum = -0.0; // what is added to it stays as it is
    for d in 0..D {
        sum += a[d] * b[d];
    }
    sum
}

/// `a − b`.
#[must_use]
pub fn subtract<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> Vector<D> {
    core::array::from_fn(|d| a[d] - b[d])
}

/// `a + factor·b`.
#[must_use]
pub fn add_scaled<const D: usize>(a: &Vector<D>, factor: f64, b: &Vector<D>) -> Vector<D> {
    core::array::from_fn(|d| a[d] + factor * b[d])
}

/// The larger of two numbers; `least` if `x` is NaN.
#[inline]
#[must_use]
pub fn larger(x: f64, least: f64) -> f64 {
    if x > least { x } else { least }
}

/// `x` cut to `[least, most]`; `least` if `x` is NaN. Which of 0 and −0 comes out is always the same, which [`f64::max`] leaves
/// open.
#[inline]
#[must_use]
pub fn cut(x: f64, least: f64, most: f64) -> f64 {
    let inside = larger(x, least);
    if inside < most { inside } else { most }
}

/// True when no component is NaN or infinite.
#[must_use]
pub fn is_finite<const D: usize>(a: &Vector<D>) -> bool {
    a.iter().all(|component| component.is_finite())
}

/// Square root, correctly rounded on every target.
#[must_use]
pub fn sqrt(x: f64) -> f64 {
    libm::sqrt(x)
}

/// Sine of an angle in radians, with the same bits on every target.
#[must_use]
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Euclidean length ‖a‖, in the unit of `a`.
#[must_use]
pub fn length<const D: usize>(a: &Vector<D>) -> f64 {
    sqrt(dot(a, a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn length_is_the_root_of_the_square() {
        assert_eq!(length(&[3.0, 4.0]), 5.0);
        assert_eq!(length(&[2.0, 3.0, 6.0]), 7.0);
    }

    #[test]
    fn whatever_is_outside_is_cut_to_the_border() {
        let cuts = [-3.0, 0.5, 4.0, f64::NAN].map(|x| cut(x, -1.0, 2.0));
        assert_eq!(cuts, [-1.0, 0.5, 2.0, -1.0]);
        let zeros = [0.0, -0.0].map(|x| [cut(x, 0.0, 1.0), cut(x, -1.0, 0.0), cut(x, 0.0, 0.0)]);
        assert_eq!(zeros.map(|zeros| zeros.map(f64::to_bits)), [[0; 3]; 2]);
    }

    #[test]
    fn sums_and_differences_by_hand() {
        assert_eq!(dot(&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0]), 32.0);
        assert_eq!(subtract(&[1.0, 2.0], &[4.0, 1.0]), [-3.0, 1.0]);
        assert_eq!(add_scaled(&[1.0, 2.0], 2.0, &[4.0, 1.0]), [9.0, 4.0]);
        assert!(is_finite(&[0.0, -1e308]) && !is_finite(&[0.0, f64::NAN]) && !is_finite(&[f64::INFINITY]));
    }
}
