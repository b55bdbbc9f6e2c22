//! One constraint on the displacement of a tick: a ball or a half-space that contains 0.

use crate::num::{Vector, add_scaled, dot, is_finite, larger};
use crate::program::balls::reach::Reach;

/// Relative rounding margin of [`Row::holds`].
pub const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// `normal·v + curvature |v|² ≤ bound`, with `curvature ≥ 0` and `bound ≥ 0`: a ball if the curvature is positive, a
/// half-space if it is 0. Every row holds at v = 0.
///
/// Scaled by a power of two so that its largest coefficient lies in [1, 2): then nothing overflows or vanishes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<const D: usize> {
    normal: Vector<D>,
    curvature: f64,
    bound: f64,
}

impl<const D: usize> Default for Row<D> {
    fn default() -> Self {
        Self { normal: [0.0; D], curvature: 0.0, bound: 0.0 }
    }
}

impl<const D: usize> Row<D> {
    /// The row with these coefficients, in any common unit.
    ///
    /// A negative or undefined bound counts as 0. If a coefficient is no finite number or the curvature is negative,
    /// the row allows v = 0 alone.
    #[must_use]
    pub fn new(normal: Vector<D>, curvature: f64, bound: f64) -> Self {
        if !(is_finite(&normal) && (0.0..f64::INFINITY).contains(&curvature)) {
            return Self { normal: [0.0; D], curvature: 1.0, bound: 0.0 };
        }
        let largest = normal.iter().fold(curvature, |most, component| larger(component.abs(), most));
        let scale = inverse_power(largest);
        Self {
            normal: normal.map(|component| scale * component),
            curvature: scale * curvature,
            bound: larger(scale * bound, 0.0),
        }
    }

    /// `sign·v_axis ≤ bound`, m, for a sign of ±1.
    pub(crate) fn side(axis: usize, sign: f64, bound_m: f64) -> Self {
        let normal = core::array::from_fn(|d| if d == axis { sign } else { 0.0 });
        Self { normal, curvature: 0.0, bound: larger(bound_m, 0.0) }
    }

    /// This row as one for steps w from the point `to`, at which it must hold: `n·(to + w) + c |to + w|² ≤ b`.
    pub(crate) fn shifted(&self, to: &Vector<D>) -> Self {
        Self::new(self.gradient(to), self.curvature, self.bound - self.value(to))
    }

    /// Gradient part, scaled.
    #[must_use]
    pub fn normal(&self) -> &Vector<D> {
        &self.normal
    }

    /// Factor of |v|², scaled, at least 0.
    #[must_use]
    pub fn curvature(&self) -> f64 {
        self.curvature
    }

    /// Right-hand side, scaled, at least 0; may be infinite.
    #[must_use]
    pub fn bound(&self) -> f64 {
        self.bound
    }

    /// True when v satisfies the row in floating point:
    ///
    /// ```text
    /// P + N ≤ bound + ROUNDING·2|N|      P, N: sums of the positive and of the negative terms of normal·v + curvature |v|²
    /// ```
    ///
    /// The margin is what the cancellation of P and N leaves undecided; without cancellation there is none. It is what
    /// lets a robot slide along a row whose bound is 0.
    #[must_use]
    pub fn holds(&self, v: &Vector<D>) -> bool {
        if self.value(v) <= self.bound {
            return true;
        }
        let (value, size) = self.value_and_size(v);
        value <= self.bound + ROUNDING * (size - value)
    }

    /// True when v, of which |v|² is `square`, is at the boundary or inside it, with no margin: then the row holds too.
    pub(crate) fn clears(&self, v: &Vector<D>, square: f64) -> bool {
        dot(&self.normal, v) + self.curvature * square <= self.bound
    }

    /// By how much the left-hand side at v, of which |v|² is `square`, is below the bound.
    pub(crate) fn slack(&self, v: &Vector<D>, square: f64) -> f64 {
        self.bound - (dot(&self.normal, v) + self.curvature * square)
    }

    /// Gradient of the left-hand side at v.
    pub(crate) fn gradient(&self, v: &Vector<D>) -> Vector<D> {
        add_scaled(&self.normal, 2.0 * self.curvature, v)
    }

    /// True when v breaks the row by no more than `fraction` of its terms.
    pub(crate) fn nearly_holds(&self, v: &Vector<D>, fraction: f64) -> bool {
        let (value, size) = self.value_and_size(v);
        value <= self.bound + fraction * size
    }

    /// By how much v breaks the row, scaled; 0 if it holds.
    pub(crate) fn excess(&self, v: &Vector<D>) -> f64 {
        let (value, size) = self.value_and_size(v);
        if value <= self.bound + ROUNDING * (size - value) { 0.0 } else { value - self.bound }
    }

    /// True when the row holds wherever `reach` allows: its largest value there, one axis at a time, is within bounds.
    #[must_use]
    pub fn contains(&self, reach: &Reach<D>) -> bool {
        let mut most = 0.0;
        for d in 0..D {
            let at = |v: f64| self.normal[d] * v + self.curvature * v * v;
            most += at(reach.min_m()[d]).max(at(reach.max_m()[d]));
        }
        most <= self.bound
    }

    /// The axis that the normal of a half-space is parallel to, if any.
    pub(crate) fn axis(&self) -> Option<usize> {
        let mut parts = (0..D).filter(|&d| self.normal[d] != 0.0);
        let axis = parts.next()?;
        (self.curvature == 0.0 && parts.next().is_none()).then_some(axis)
    }

    /// `normal·v + curvature |v|²`.
    pub(crate) fn value(&self, v: &Vector<D>) -> f64 {
        dot(&self.normal, v) + self.curvature * dot(v, v)
    }

    fn value_and_size(&self, v: &Vector<D>) -> (f64, f64) {
        let (mut along, mut size) = (0.0, 0.0);
        for d in 0..D {
            let term = self.normal[d] * v[d];
            along += term;
            size += term.abs();
        }
        let square = self.curvature * dot(v, v);
        (along + square, size + square)
    }
}

/// The power of two that takes `x ≥ 0` into [1, 2); the largest or smallest there is where that does not exist.
fn inverse_power(x: f64) -> f64 {
    let exponent = x.to_bits() >> 52;
    f64::from_bits((2046 - exponent.min(2045)) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::InputBox;

    #[test]
    fn rows_are_scaled_by_powers_of_two() {
        let row = Row::new([3.0, -40.0], 8.0, 16.0);
        assert_eq!(row, Row { normal: [3.0 / 32.0, -1.25], curvature: 0.25, bound: 0.5 });
        let tiny = Row::new([3e-300, 0.0], 0.0, 1e-300);
        assert!(
            (1.0..2.0).contains(&tiny.normal[0]) && (tiny.bound / tiny.normal[0] - 1.0 / 3.0).abs() < 1e-15
        );
        let huge = Row::new([f64::MAX, 0.0], f64::MAX, f64::MAX);
        assert!((1.0..4.0).contains(&huge.normal[0]) && huge.bound.is_finite());
        let nothing = Row::new([0.0, 0.0], 0.0, 0.0);
        assert!(nothing.holds(&[1e100, -1e100]));
    }

    #[test]
    fn a_coefficient_without_a_number_forbids_any_move() {
        for row in [
            Row::new([f64::NAN, 0.0], 1.0, 1.0),
            Row::new([0.0, f64::INFINITY], 1.0, 1.0),
            Row::new([1.0, 0.0], f64::NAN, 1.0),
            Row::new([1.0, 0.0], -1.0, 1.0),
        ] {
            assert!(row.holds(&[0.0, 0.0]) && !row.holds(&[1e-100, 0.0]));
        }
        assert_eq!(Row::new([1.0, 0.0], 0.0, f64::NAN).bound, 0.0);
        assert_eq!(Row::new([1.0, 0.0], 0.0, -3.0).bound, 0.0);
    }

    #[test]
    fn a_row_contains_a_box_when_it_holds_at_the_worst_corner() {
        let reach = Reach::new(&InputBox::of([-1.0, 0.0], [0.5, 2.0]), 1.0);
        let worst = Row::new([1.0, -1.0], 1.0, 0.0).value(&[0.5, 2.0]);
        assert!(Row::new([1.0, -1.0], 1.0, worst).contains(&reach));
        assert!(!Row::new([1.0, -1.0], 1.0, worst - 1e-12).contains(&reach));
        assert!(Row::new([0.0, 0.0], 0.0, 0.0).contains(&reach));
    }

    #[test]
    fn there_is_no_margin_without_cancellation() {
        let side = Row::new([1.0, 0.0], 0.0, 0.1);
        assert!(side.holds(&[0.1, 1e9]) && !side.holds(&[0.1 * (1.0 + f64::EPSILON), 1e9]));
        let along = Row::new([0.3, -0.1], 0.0, 0.0);
        assert!(along.holds(&[0.1, 0.3]) && along.holds(&[0.1, 0.3 * (1.0 - f64::EPSILON)]));
        assert!(!along.holds(&[0.1, 0.3 * (1.0 - 1e-13)]));
    }
}
