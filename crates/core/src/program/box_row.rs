//! The exact program of one robot: the closest point of a box with one row.

use crate::num::{Vector, add_scaled, dot};
use crate::program::{InputBox, Outcome};

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

/// Answer of [`closest`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution<const D: usize> {
    /// The velocity, m/s, always inside the box.
    pub velocity_m_s: Vector<D>,
    /// How the program found it.
    pub outcome: Outcome,
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
/// holds up to the rounding of one inner product over the box, however far outside it `desired` lies. Without
/// allocation; about 4·D² comparisons at worst.
//= paper seq:qp
//= theory sec:box-row
#[must_use]
pub fn closest<const D: usize>(desired: &Vector<D>, row: &Row<D>, input: &InputBox<D>) -> Solution<D> {
    let clipped = input.clip(desired);
    if dot(&row.normal, &clipped) >= row.bound {
        return Solution { velocity_m_s: clipped, outcome: Outcome::Free };
    }
    if clipped == *desired
        && let Some(velocity_m_s) = foot(desired, row).filter(|foot| input.contains(foot))
    {
        return Solution { velocity_m_s, outcome: Outcome::Active };
    }
    let furthest = furthest(input, &row.normal, desired);
    if dot(&row.normal, &furthest) < row.bound {
        return Solution { velocity_m_s: furthest, outcome: Outcome::Infeasible };
    }
    let ray = Ray::new(desired, row, input, clipped, furthest);
    let (before, after) = ray.bracket(row);
    Solution { velocity_m_s: input.clip(&between(&before, &after, row)), outcome: Outcome::Active }
}

/// The box point that maximises `normal · u`; where the normal is 0, the closest to `desired`.
fn furthest<const D: usize>(input: &InputBox<D>, normal: &Vector<D>, desired: &Vector<D>) -> Vector<D> {
    let clipped = input.clip(desired);
    core::array::from_fn(|d| match normal[d] {
        slope if slope > 0.0 => input.max_m_s[d],
        slope if slope < 0.0 => input.min_m_s[d],
        _ => clipped[d],
    })
}

/// The foot of the perpendicular from `desired` on the row: the answer if both lie in the box, as they mostly do.
/// `None` for rows so small or large that their square is not an ordinary number.
fn foot<const D: usize>(desired: &Vector<D>, row: &Row<D>) -> Option<Vector<D>> {
    let square = dot(&row.normal, &row.normal);
    let ordinary = 1e-200 < square && square < 1e200;
    ordinary.then(|| perpendicular(desired, row, square))
}

/// The foot for a row whose normal has this `square`.
#[inline]
fn perpendicular<const D: usize>(desired: &Vector<D>, row: &Row<D>, square: f64) -> Vector<D> {
    add_scaled(desired, (row.bound - dot(&row.normal, desired)) / square, &row.normal)
}

/// The answer of [`closest`] in the two cases that are there mostly, and whether this is one of them: the desired velocity, cut to
/// the box, is free, or the foot of an uncut one lies in the box. For boxes alone and normals in [1, 2); no branches, for many
/// worlds at once.
#[inline]
pub(crate) fn closest_mostly<const D: usize>(
    desired: &Vector<D>,
    row: &Row<D>,
    input: &InputBox<D>,
) -> (Vector<D>, Mostly) {
    let clipped = input.clip_to_box(desired);
    let free = dot(&row.normal, &clipped) >= row.bound;
    let foot = perpendicular(desired, row, dot(&row.normal, &row.normal));
    let mut active = true;
    for d in 0..D {
        active &= clipped[d] == desired[d];
        active &= input.min_m_s[d] <= foot[d];
        active &= foot[d] <= input.max_m_s[d];
    }
    let velocity = core::array::from_fn(|d| if free { clipped[d] } else { foot[d] });
    (velocity, Mostly { free, found: free | active })
}

/// What became of [`closest_mostly`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Mostly {
    /// The outcome is `Free`, else `Active`.
    pub(crate) free: bool,
    /// False in all other cases.
    pub(crate) found: bool,
}

/// The points u(λ). Each component rests on the edge of the box nearest to the desired one until λ = `enter`, is free until
/// λ = `leave`, and rests on the opposite edge from then on.
struct Ray<const D: usize> {
    desired: Vector<D>,
    normal: Vector<D>,
    enter: Vector<D>,
    leave: Vector<D>,
    nearest: Vector<D>,
    furthest: Vector<D>,
}

impl<const D: usize> Ray<D> {
    fn new(
        desired: &Vector<D>,
        row: &Row<D>,
        input: &InputBox<D>,
        nearest: Vector<D>,
        furthest: Vector<D>,
    ) -> Self {
        let reach = |d: usize, edge: f64| {
            if row.normal[d] == 0.0 { f64::INFINITY } else { (edge - desired[d]) / row.normal[d] }
        };
        let kinks = |edge_up: &Vector<D>, edge_down: &Vector<D>| {
            core::array::from_fn(|d| reach(d, if row.normal[d] > 0.0 { edge_up[d] } else { edge_down[d] }))
        };
        let enter = kinks(&input.min_m_s, &input.max_m_s);
        let leave = kinks(&input.max_m_s, &input.min_m_s);
        Self { desired: *desired, normal: row.normal, enter, leave, nearest, furthest }
    }

    /// The two ends of the segment on which the row begins to hold; it holds at [`furthest`] at the latest.
    fn bracket(&self, row: &Row<D>) -> (Vector<D>, Vector<D>) {
        let (mut lambda, mut before) = (0.0, self.nearest);
        for _ in 0..2 * D {
            lambda = self.next_kink(lambda);
            if lambda.is_infinite() {
                break;
            }
            let after = self.at(lambda);
            if dot(&row.normal, &after) >= row.bound {
                return (before, after);
            }
            before = after;
        }
        (before, self.furthest)
    }

    /// The least λ > `after` at which a component enters or leaves its bounds; infinity if there is none.
    fn next_kink(&self, after: f64) -> f64 {
        let kinks = self.enter.iter().chain(&self.leave).copied();
        kinks.filter(|&kink| kink > after).fold(f64::INFINITY, f64::min)
    }

    fn at(&self, lambda: f64) -> Vector<D> {
        core::array::from_fn(|d| {
            if lambda <= self.enter[d] {
                self.nearest[d]
            } else if lambda >= self.leave[d] {
                self.furthest[d]
            } else {
                self.desired[d] + lambda * self.normal[d]
            }
        })
    }
}

/// The point from `before` to `after` where the row begins to hold.
///
/// Between two kinks u(λ) is straight, so this is one linear equation. It is written in points of the box and not in λ
/// and the desired velocity: however far away that is, the row holds to the rounding of an inner product over the box.
fn between<const D: usize>(before: &Vector<D>, after: &Vector<D>, row: &Row<D>) -> Vector<D> {
    let (low, high) = (dot(&row.normal, before), dot(&row.normal, after));
    let share = (row.bound - low) / (high - low);
    core::array::from_fn(|d| before[d] + share * (after[d] - before[d]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: InputBox<2> = InputBox::of([-1.5, -1.5], [1.5, 1.5]);

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
