//! Where one tick can take a robot.

use crate::num::{Vector, cut, larger, length};
use crate::program::InputBox;

/// No tick takes a robot farther along an axis, m.
const EDGE_MAX_M: f64 = 1e12;
/// Far more than the rounding of a row and of its largest value in the box.
const SURELY: f64 = 1.0 + 1e-9;

/// The displacements of one tick, `T U_i`: a box that contains 0, and a ball around 0. No corner has a −0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_field_names, reason = "units last")]
pub struct Reach<const D: usize> {
    min_m: Vector<D>,
    max_m: Vector<D>,
    /// How far the longer side of each axis reaches, m.
    far_m: Vector<D>,
    /// The radius of the ball, m; infinite where it cuts nothing off.
    ball_m: f64,
    /// ρ, m.
    longest_m: f64,
}

impl<const D: usize> Reach<D> {
    /// `T U_i` for a tick of `period_s`. A corner that is not a number, or on the wrong side of 0, becomes 0.
    #[must_use]
    pub fn new(input: &InputBox<D>, period_s: f64) -> Self {
        let ball_m = if input.is_round() { edge(period_s * input.speed_max_m_s) } else { f64::INFINITY };
        Self::within(
            input.min_m_s.map(|speed| 0.0 - edge(-period_s * speed)),
            input.max_m_s.map(|speed| edge(period_s * speed)),
            ball_m,
        )
    }

    fn within(min_m: Vector<D>, max_m: Vector<D>, ball_m: f64) -> Self {
        let far_m = core::array::from_fn(|d| larger(max_m[d], -min_m[d]));
        let longest_m = length(&far_m).min(ball_m) * (1.0 + 4.0 * f64::EPSILON);
        Self { min_m, max_m, far_m, ball_m, longest_m }
    }

    /// Least displacement per axis, m, at most 0.
    #[must_use]
    pub fn min_m(&self) -> &Vector<D> {
        &self.min_m
    }

    /// Greatest displacement per axis, m, at least 0.
    #[must_use]
    pub fn max_m(&self) -> &Vector<D> {
        &self.max_m
    }

    /// ρ, m: no displacement is longer.
    #[must_use]
    pub fn longest_m(&self) -> f64 {
        self.longest_m
    }

    /// How far the farthest corner of the box is, m.
    pub(crate) fn corner_m(&self) -> f64 {
        length(&self.far_m)
    }

    /// The radius of the ball, m, if it cuts anything off the box.
    #[must_use]
    pub fn ball_m(&self) -> Option<f64> {
        self.ball_m.is_finite().then_some(self.ball_m)
    }

    /// How many rows it takes: two for each axis, and one for the ball if it cuts anything off.
    pub(crate) fn rows(&self) -> usize {
        2 * D + usize::from(self.ball_m().is_some())
    }

    /// A number that `n·v + c |v|²` is at most, anywhere in the box, for a `normal` n known up to `error` along each axis and a
    /// `curvature` c. It is NaN if c is no curvature. A row surely holds wherever the robot can go if this is at most its bound.
    #[inline]
    pub(crate) fn lhs_max(&self, normal: &Vector<D>, error: f64, curvature: f64) -> f64 {
        let mut most = 0.0;
        for (component, far_m) in normal.iter().zip(&self.far_m) {
            most += (component.abs() + error + curvature * far_m) * far_m;
        }
        if curvature >= 0.0 { most * SURELY } else { f64::NAN }
    }

    /// The point of the box closest to `v`, which the ball may cut off; a component that is not a number becomes 0.
    #[must_use]
    pub fn clip(&self, v: &Vector<D>) -> Vector<D> {
        let number = |component: f64| if component.is_nan() { 0.0 } else { component };
        core::array::from_fn(|d| cut(number(v[d]), self.min_m[d], self.max_m[d]))
    }

    /// True when `v` is inside, borders included.
    #[must_use]
    pub fn contains(&self, v: &Vector<D>) -> bool {
        (0..D).all(|d| self.min_m[d] <= v[d] && v[d] <= self.max_m[d]) && length(v) <= self.ball_m
    }
}

/// How far an axis reaches to one side, m: far inside `f64`, so that squares stay finite.
fn edge(reach_m: f64) -> f64 {
    if reach_m > 0.0 { reach_m.min(EDGE_MAX_M) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tick_of_the_input_box() {
        let input = InputBox::of([-1.5, 0.0], [2.0, 4.0]);
        let reach = Reach::new(&input, 0.5);
        assert_eq!(reach, Reach::within([-0.75, 0.0], [1.0, 2.0], f64::INFINITY));
        assert!((reach.longest_m() - libm::sqrt(5.0)).abs() < 1e-14);
        assert_eq!(reach.clip(&[-3.0, f64::NAN]), [-0.75, 0.0]);
        assert!(reach.contains(&[1.0, 2.0]) && !reach.contains(&[1.0, -1e-300]));
    }

    #[test]
    fn no_point_of_the_box_exceeds_the_largest_left_hand_side() {
        let reach = Reach::within([-0.75, -0.5], [0.25, 1.0], f64::INFINITY);
        let (normal, curvature) = ([2.0, -3.0], 0.5);
        for (x, y) in [(-0.75, -0.5), (-0.75, 1.0), (0.25, -0.5), (0.25, 1.0)] {
            let value = normal[0] * x + normal[1] * y + curvature * (x * x + y * y);
            assert!(value <= reach.lhs_max(&normal, 0.0, curvature));
        }
        assert!((reach.lhs_max(&normal, 0.1, 0.0) - (2.1 * 0.75 + 3.1 * 1.0)).abs() < 1e-8);
        assert!(reach.lhs_max(&normal, 0.0, -0.5).is_nan() && reach.lhs_max(&normal, 0.0, f64::NAN).is_nan());
    }

    #[test]
    fn zeros_at_a_side_are_positive() {
        let reach = Reach::new(&InputBox::of([0.0, -1.0], [1.0, 0.0]), 0.5);
        let bits = |v: &Vector<2>| v.map(f64::to_bits);
        assert_eq!(bits(reach.min_m()), bits(&[0.0, -0.5]));
        for v in [[0.0, 0.0], [-0.0, -0.0], [-1.0, 1.0]] {
            assert_eq!(bits(&reach.clip(&v)), [0; 2], "{v:?}");
        }
        assert_eq!(bits(&reach.clip(&[0.25, -0.25])), bits(&[0.25, -0.25]));
    }

    #[test]
    fn a_corner_without_a_number_forbids_any_move() {
        let input = InputBox::of([f64::NAN, 1.0], [f64::NAN, -1.0]);
        assert_eq!(Reach::new(&input, 0.5), Reach::within([0.0; 2], [0.0; 2], f64::INFINITY));
    }
}
