//! Small vectors and the one exponential: the only place of the project where a transcendental function is computed.
//!
//! Only +, −, ×, ÷ and the square root of IEEE 754 are used, in a fixed order and never fused, so every target and
//! every optimisation level gives the same bits.

use crate::scaled::{Number, Scaled};

/// A point, an offset (m) or a velocity (m/s) in `D` dimensions.
pub type Vector<const D: usize> = [f64; D];

/// Inner product `a·b`, summed from the first component on.
#[must_use]
pub fn dot<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    let mut sum = 0.0;
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

/// Euclidean length ‖a‖, in the unit of `a`.
#[must_use]
pub fn length<const D: usize>(a: &Vector<D>) -> f64 {
    sqrt(dot(a, a))
}

/// `eˣ` within 1 unit in the last place; 0 below 2⁻¹⁰²¹ and infinity above the largest `f64`.
#[must_use]
pub fn exp(x: f64) -> f64 {
    Number::exp(x)
}

/// Beyond this |x| the exponent of `eˣ` saturates: far outside anything `f64` holds, far inside `i32`.
const EXPONENT_LIMIT: f64 = 1e8;

/// `eˣ` as mantissa and binary exponent, so that it neither overflows nor vanishes.
///
/// ```text
/// x = k ln 2 + r, |r| ≤ ln 2 / 2,   eˣ = 2ᵏ (1 + r + r² (1/2! + r/3! + … + r¹¹/13!))
/// ```
///
/// Saturates at `x = ±10⁸`; NaN counts as −10⁸.
#[must_use]
pub fn exp_scaled(x: f64) -> Scaled {
    const LOG2_E: f64 = core::f64::consts::LOG2_E;
    const LN2_HIGH: f64 = 6.931_471_803_691_238e-1; // the 33 leading bits of ln 2
    const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;
    const ROUND: f64 = 6_755_399_441_055_744.0; // 1.5·2⁵²: adding it rounds to an integer
    let x = x.max(-EXPONENT_LIMIT).min(EXPONENT_LIMIT);
    let k = (x * LOG2_E + ROUND) - ROUND;
    let r = (x - k * LN2_HIGH) - k * LN2_LOW;
    #[expect(clippy::cast_possible_truncation, reason = "|k| < 1.5e8 by the limit above")]
    Scaled { mantissa: 1.0 + (r + r * r * exp_tail(r)), exponent: k as i32 }
}

/// `Σ_{m=0}^{11} r^m/(m+2)!` in Estrin's order: short chains, so that neighbouring links overlap in the processor.
fn exp_tail(r: f64) -> f64 {
    const C: [f64; 12] = [
        1.0 / 2.0,
        1.0 / 6.0,
        1.0 / 24.0,
        1.0 / 120.0,
        1.0 / 720.0,
        1.0 / 5_040.0,
        1.0 / 40_320.0,
        1.0 / 362_880.0,
        1.0 / 3_628_800.0,
        1.0 / 39_916_800.0,
        1.0 / 479_001_600.0,
        1.0 / 6_227_020_800.0,
    ];
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (C[0] + C[1] * r) + (C[2] + C[3] * r) * r2;
    let middle = (C[4] + C[5] * r) + (C[6] + C[7] * r) * r2;
    let high = (C[8] + C[9] * r) + (C[10] + C[11] * r) * r2;
    low + (middle + high * r4) * r4
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exp_agrees_with_libm_to_one_unit_in_the_last_place() {
        let mut worst = 0;
        for step in 0..400_000 {
            let x = -700.0 + f64::from(step) * 0.003_5;
            let ulps = exp(x).to_bits().abs_diff(libm::exp(x).to_bits());
            worst = worst.max(ulps);
        }
        assert!(worst <= 2, "{worst} units apart, and libm itself may be off by one");
    }

    #[test]
    fn exp_saturates_and_never_gives_nan() {
        assert_eq!(exp(0.0), 1.0);
        assert_eq!(exp(-800.0), 0.0);
        assert_eq!(exp(800.0), f64::INFINITY);
        assert_eq!(exp(f64::NEG_INFINITY), 0.0);
        assert_eq!(exp(f64::INFINITY), f64::INFINITY);
        assert_eq!(exp(f64::NAN), 0.0);
    }

    #[test]
    fn exp_scaled_goes_where_f64_cannot() {
        let product = exp_scaled(-5_000.0).times(exp_scaled(5_001.0)).value();
        assert!((product - core::f64::consts::E).abs() < 1e-11, "{product}");
    }

    #[test]
    fn length_is_the_root_of_the_square() {
        assert_eq!(length(&[3.0, 4.0]), 5.0);
        assert_eq!(length(&[2.0, 3.0, 6.0]), 7.0);
    }
}
