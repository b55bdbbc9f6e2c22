//! The exact program of one robot: the closest point of a box with one row.

use crate::math::{Vector, dot};

/// The input set U_i, a box that contains 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputBox<const D: usize> {
    /// Least velocity per axis, m/s, finite, at most 0.
    pub min_m_s: Vector<D>,
    /// Greatest velocity per axis, m/s, finite, at least 0.
    pub max_m_s: Vector<D>,
}

/// The constraint `normal · u ≥ bound` (eq:split), scaled so that the largest component of the normal lies in [1, 2).
///
/// A normal of zeros is allowed: then the row holds for every u or for none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<const D: usize> {
    /// Direction of H_i.
    pub normal: Vector<D>,
    /// Right-hand side, m/s once scaled.
    pub bound: f64,
}

/// What the program found; each is an answer, none is an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The desired velocity, cut to the box, already satisfies the row.
    Free,
    /// The row changed the velocity and holds with equality.
    Active,
    /// No velocity in the box satisfies the row; the answer is the one that comes closest to it.
    Infeasible,
}

/// Answer of [`closest`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution<const D: usize> {
    /// The velocity, m/s, always inside the box.
    pub velocity_m_s: Vector<D>,
    /// How it came about.
    pub outcome: Outcome,
}

impl<const D: usize> InputBox<D> {
    /// The point of the box closest to `u`.
    #[must_use]
    pub fn clip(&self, u: &Vector<D>) -> Vector<D> {
        core::array::from_fn(|d| u[d].max(self.min_m_s[d]).min(self.max_m_s[d]))
    }

    /// True when `u` is inside, borders included.
    #[must_use]
    pub fn contains(&self, u: &Vector<D>) -> bool {
        (0..D).all(|d| self.min_m_s[d] <= u[d] && u[d] <= self.max_m_s[d])
    }

    /// The box point that maximises `normal · u`; where the normal is 0, the closest to `desired`.
    fn furthest(&self, normal: &Vector<D>, desired: &Vector<D>) -> Vector<D> {
        let clipped = self.clip(desired);
        core::array::from_fn(|d| match normal[d] {
            slope if slope > 0.0 => self.max_m_s[d],
            slope if slope < 0.0 => self.min_m_s[d],
            _ => clipped[d],
        })
    }
}

/// `arg min ‖u_des − u‖²  s.t.  u ∈ box, normal·u ≥ bound` in closed form.
///
/// ```text
/// u(λ) = clip(u_des + λ normal),  the smallest λ ≥ 0 with normal·u(λ) ≥ bound
/// ```
///
/// By the optimality conditions the answer is u(λ), and `normal·u(λ)` is non-decreasing and linear between at most 2·D
/// kinks, where a component enters or leaves its bounds; so the kinks are walked until the row holds. No iteration
/// count, no tolerance. If no box point satisfies the row, the answer is the one that maximises `normal·u`.
///
/// `desired` (m/s), `row` and `input` must be finite, with `min ≤ max`; then the answer lies in the box and the row
/// holds up to the rounding of one inner product. Without allocation; about 2·D² comparisons at worst.
//= paper seq:qp
#[must_use]
pub fn closest<const D: usize>(desired: &Vector<D>, row: &Row<D>, input: &InputBox<D>) -> Solution<D> {
    let clipped = input.clip(desired);
    if dot(&row.normal, &clipped) >= row.bound {
        return Solution { velocity_m_s: clipped, outcome: Outcome::Free };
    }
    let furthest = input.furthest(&row.normal, desired);
    if dot(&row.normal, &furthest) < row.bound {
        return Solution { velocity_m_s: furthest, outcome: Outcome::Infeasible };
    }
    Solution { velocity_m_s: walk(desired, row, input), outcome: Outcome::Active }
}

/// Follows u(λ) from kink to kink to the segment on which the row begins to hold.
fn walk<const D: usize>(desired: &Vector<D>, row: &Row<D>, input: &InputBox<D>) -> Vector<D> {
    let mut start = 0.0;
    for _ in 0..2 * D {
        let end = next_kink(desired, row, input, start);
        let at_end = along(desired, &row.normal, input, end);
        if end.is_infinite() || dot(&row.normal, &at_end) >= row.bound {
            return on_segment(desired, row, input, start, end);
        }
        start = end;
    }
    on_segment(desired, row, input, start, f64::INFINITY)
}

/// The least λ > `after` at which a component enters or leaves its bounds; infinity if there is none.
fn next_kink<const D: usize>(desired: &Vector<D>, row: &Row<D>, input: &InputBox<D>, after: f64) -> f64 {
    let mut next = f64::INFINITY;
    for d in 0..D {
        for edge in [input.min_m_s[d], input.max_m_s[d]] {
            let kink = (edge - desired[d]) / row.normal[d];
            if kink > after && kink < next {
                next = kink;
            }
        }
    }
    next
}

/// u(λ).
fn along<const D: usize>(
    desired: &Vector<D>,
    normal: &Vector<D>,
    input: &InputBox<D>,
    lambda: f64,
) -> Vector<D> {
    input.clip(&core::array::from_fn(|d| {
        if normal[d] == 0.0 { desired[d] } else { desired[d] + lambda * normal[d] }
    }))
}

/// The point of the segment `start < λ ≤ end` where the row holds with equality.
///
/// Between two kinks every component is either fixed at a bound or free, so this is one linear equation; it is solved
/// in units of the largest free component, which keeps it exact for rows that are nearly parallel to an axis.
fn on_segment<const D: usize>(
    desired: &Vector<D>,
    row: &Row<D>,
    input: &InputBox<D>,
    start: f64,
    end: f64,
) -> Vector<D> {
    let middle = if end.is_infinite() { 2.0 * start + 1.0 } else { 0.5 * (start + end) };
    let mut point = along(desired, &row.normal, input, middle);
    let free = |d: usize, at: f64| row.normal[d] != 0.0 && input.min_m_s[d] < at && at < input.max_m_s[d];
    let largest =
        (0..D).filter(|&d| free(d, point[d])).fold(0.0, |most: f64, d| most.max(row.normal[d].abs()));
    if largest == 0.0 {
        return point;
    }
    let (mut missing, mut square) = (row.bound, 0.0);
    for d in 0..D {
        if free(d, point[d]) {
            missing -= row.normal[d] * desired[d];
            square += (row.normal[d] / largest) * (row.normal[d] / largest);
        } else {
            missing -= row.normal[d] * point[d];
        }
    }
    let step = missing / largest / square;
    for d in 0..D {
        if free(d, point[d]) {
            point[d] = desired[d] + step * (row.normal[d] / largest);
        }
    }
    input.clip(&point)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: InputBox<2> = InputBox { min_m_s: [-1.5, -1.5], max_m_s: [1.5, 1.5] };

    #[test]
    fn free_active_and_infeasible_by_hand() {
        let right = |bound: f64| Row { normal: [1.0, 0.0], bound };
        let still = closest(&[0.2, 0.3], &right(-1.0), &SQUARE);
        assert_eq!(still, Solution { velocity_m_s: [0.2, 0.3], outcome: Outcome::Free });
        let pushed = closest(&[0.2, 0.3], &right(1.0), &SQUARE);
        assert_eq!(pushed, Solution { velocity_m_s: [1.0, 0.3], outcome: Outcome::Active });
        let stuck = closest(&[0.2, 0.3], &right(2.0), &SQUARE);
        assert_eq!(stuck, Solution { velocity_m_s: [1.5, 0.3], outcome: Outcome::Infeasible });
    }

    #[test]
    fn a_component_outside_its_bounds_is_cut_first_and_enters_later() {
        let row = Row { normal: [-1.0, -1.0], bound: 2.5 };
        let solution = closest(&[4.0, 0.0], &row, &SQUARE);
        assert_eq!(solution.outcome, Outcome::Active);
        let [x, y] = solution.velocity_m_s;
        assert!((x + 1.0).abs() < 1e-15 && (y + 1.5).abs() < 1e-15, "{x} {y}");
    }

    #[test]
    fn a_row_of_zeros_holds_always_or_never() {
        let zero = |bound: f64| closest(&[2.0, 0.1], &Row { normal: [0.0, 0.0], bound }, &SQUARE);
        assert_eq!(zero(-1e-9), Solution { velocity_m_s: [1.5, 0.1], outcome: Outcome::Free });
        assert_eq!(zero(1e-9), Solution { velocity_m_s: [1.5, 0.1], outcome: Outcome::Infeasible });
    }
}
