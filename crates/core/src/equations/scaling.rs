//! A row H·u ≥ −α φ divided by a power of two, so that its program neither overflows nor loses its direction.

use crate::num::scaled::Scaled;
use crate::program::box_row::Row;

/// Stands for an infinite bound: larger than anything a box allows, small enough to multiply.
const BOUND_LIMIT: f64 = 1e200;
/// Three numbers of a size between these can be multiplied with a power of two that is the size of one of them, and nothing overflows
/// or becomes subnormal.
const USUAL_MIN: f64 = 1e-100;
const USUAL_MAX: f64 = 1e100;

/// The row with the largest component of H in [1, 2) up to its sign.
pub(super) fn scaled_row<const D: usize>(normal: &[Scaled; D], alpha: f64, phi: Scaled) -> Row<D> {
    let normal = normal.map(Scaled::normalized);
    let nonzero = normal.iter().filter(|component| component.mantissa != 0.0);
    let exponent = nonzero.map(|component| component.exponent).max().unwrap_or(0);
    let shift = exponent.saturating_neg();
    let bound = phi.times(Scaled::new(-alpha)).shifted(shift).value();
    Row { normal: normal.map(|component| component.shifted(shift).value()), bound: limited(bound) }
}

/// [`scaled_row`] of finite numbers, with its bits. Where all are of a usual size it takes a few multiplications.
#[inline]
pub(super) fn plain_row<const D: usize>(normal: &[f64; D], alpha: f64, phi: f64) -> Row<D> {
    if !is_usual(normal, alpha, phi) {
        return scaled_row(&normal.map(Scaled::new), alpha, Scaled::new(phi));
    }
    usual_row(normal, alpha, phi)
}

/// True if all numbers are of a usual size.
#[inline]
pub(super) fn is_usual<const D: usize>(normal: &[f64; D], alpha: f64, phi: f64) -> bool {
    let usual = |number: f64| {
        let (least, most) = (number.abs() >= USUAL_MIN, number.abs() <= USUAL_MAX);
        least & most
    };
    normal.iter().fold(usual(phi) & usual(alpha), |all, component| all & usual(*component))
}

/// [`scaled_row`] of numbers that are all of a usual size; of others it means nothing.
#[inline]
pub(super) fn usual_row<const D: usize>(normal: &[f64; D], alpha: f64, phi: f64) -> Row<D> {
    let largest = normal.iter().fold(0.0, |most: f64, component| most.max(component.abs()));
    // 2^−e of a number in [2^e, 2^(e+1)).
    let scale = f64::from_bits(2046_u64.wrapping_sub(largest.to_bits() >> 52) << 52);
    Row { normal: normal.map(|component| component * scale), bound: limited(phi * -alpha * scale) }
}

fn limited(bound: f64) -> f64 {
    bound.max(-BOUND_LIMIT).min(BOUND_LIMIT)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of all sizes and signs, most of them usual ones.
    fn number(draw: u64) -> f64 {
        let special = [0.0, -0.0, 1e-100, -1e100, 1e-310, 3e-200, f64::MIN_POSITIVE, 1e250, -2.0];
        let with_exponent = |biased: u64| f64::from_bits((draw & !(0x7ff << 52)) | (biased << 52));
        match draw % 16 {
            place @ 0..9 => special[usize::try_from(place).unwrap_or(0)],
            9 | 10 => with_exponent((draw >> 5) % 0x7ff),
            _ => with_exponent(1023 - 300 + (draw >> 5) % 600),
        }
    }

    //= paper eq:split type=test
    #[test]
    fn both_ways_have_the_same_bits() {
        let mut state = 1_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            number(state ^ (state >> 31))
        };
        for _ in 0..100_000 {
            let (normal, phi, alpha) = ([draw(), draw()], draw(), draw().abs());
            let careful = scaled_row(&normal.map(Scaled::new), alpha, Scaled::new(phi));
            let plain = plain_row(&normal, alpha, phi);
            let bits = |row: Row<2>| (row.normal.map(f64::to_bits), row.bound.to_bits());
            assert_eq!(bits(plain), bits(careful), "{normal:?} {phi} {alpha}");
        }
    }
}
