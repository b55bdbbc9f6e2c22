//! On which side of a line a point lies, exactly.

use core::cmp::Ordering;

/// A point of the plane.
pub type Point = [f64; 2];

/// Splits a number into two halves of 26 bits: 2²⁷ + 1.
const SPLITTER: f64 = 134_217_729.0;
/// Above this share of the sum of all terms a rounded sum has the right sign: sums of six products err by less.
const SURE: f64 = 16.0 * f64::EPSILON;

/// `Greater` if `c` lies to the left of the way from `a` to `b`, `Less` to the right, `Equal` on the line.
///
/// Exact for coordinates below 2⁵⁰⁰ whose products do not fall below what `f64` holds: products are kept as two numbers, and their sum is
/// taken without rounding where rounding could decide.
#[must_use]
pub fn orientation(a: &Point, b: &Point, c: &Point) -> Ordering {
    let factors = [[a[0], b[1]], [-a[0], c[1]], [-c[0], b[1]], [-a[1], b[0]], [a[1], c[0]], [c[1], b[0]]];
    let (mut sum, mut size) = (0.0, 0.0);
    for [x, y] in factors {
        sum += x * y;
        size += (x * y).abs();
    }
    if sum.abs() > SURE * size {
        return sum.total_cmp(&0.0);
    }
    let mut exact = Vec::with_capacity(12);
    for [x, y] in factors {
        let [high, low] = product(x, y);
        add(&mut exact, low);
        add(&mut exact, high);
    }
    let largest = exact.iter().rev().find(|part| **part != 0.0);
    largest.map_or(Ordering::Equal, |part| part.total_cmp(&0.0))
}

/// `x y` as the rounded product and its error (Dekker).
fn product(x: f64, y: f64) -> [f64; 2] {
    let split = |number: f64| {
        let wide = SPLITTER * number;
        let high = wide - (wide - number);
        (high, number - high)
    };
    let ((x_high, x_low), (y_high, y_low)) = (split(x), split(y));
    let rounded = x * y;
    let error = x_low * y_low - (((rounded - x_high * y_high) - x_low * y_high) - x_high * y_low);
    [rounded, error]
}

/// Adds a number to a sum of numbers that do not overlap, smallest first (Shewchuk).
fn add(parts: &mut Vec<f64>, number: f64) {
    let mut carry = number;
    for part in parts.iter_mut() {
        let sum = carry + *part;
        let virtual_part = sum - carry;
        *part = (carry - (sum - virtual_part)) + (*part - virtual_part);
        carry = sum;
    }
    parts.push(carry);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points on one line of slope 1 that differ in the last bit: a rounded determinant says 0 for most of them.
    #[test]
    fn the_last_bit_decides() {
        let bit = f64::EPSILON;
        let (a, b) = ([12.0, 12.0], [24.0, 24.0]);
        for k in 0..200_i32 {
            for l in 0..200_i32 {
                let c = [0.5 + f64::from(k) * bit, 0.5 + f64::from(l) * bit];
                assert_eq!(orientation(&a, &b, &c), l.cmp(&k), "{k} {l}");
            }
        }
    }

    #[test]
    fn whole_numbers_agree_with_whole_arithmetic() {
        let mut state = 3_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            i64::try_from(state >> 60).unwrap_or(0) - 8
        };
        for _ in 0..20_000 {
            let [ax, ay, bx, by, cx, cy] = core::array::from_fn(|_| draw());
            let whole = (ax - cx) * (by - cy) - (ay - cy) * (bx - cx);
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let point = |x: i64, y: i64| [x as f64, y as f64];
            assert_eq!(orientation(&point(ax, ay), &point(bx, by), &point(cx, cy)), whole.cmp(&0));
        }
    }
}
