//! A warm start: the closest point is looked for first on the two boundaries that decided a tick ago.

use crate::num::{Vector, dot, subtract};
use crate::program::balls::Program;
use crate::program::balls::intersection::closest_on;
use crate::program::balls::row::Row;

/// A boundary is near within this fraction of the longest move, in the scale of rows.
const NEAR: f64 = 1e-3;
/// Gradients are far from parallel from this square of the sine of their angle on.
const APART: f64 = 1e-4;

impl<const D: usize> Program<'_, D> {
    /// Where the two boundaries near `before` meet, if that is the closest point: every row holds there, and [`decide`].
    pub(super) fn warm_start(&self, desired: &Vector<D>, before: &Vector<D>) -> Option<Vector<D>> {
        let [one, other] = self.nearest(before)?;
        let v = closest_on(&[one, other], desired)?;
        (decide(one, other, &v, desired) && self.rows().iter().all(|row| row.holds(&v))).then_some(v)
    }

    /// The two rows whose boundaries are nearest to `v` in the scale of rows, if they are near.
    fn nearest(&self, v: &Vector<D>) -> Option<[&Row<D>; 2]> {
        let (square, near_m) = (dot(v, v), NEAR * self.reach.longest_m());
        let (mut nearest, mut least) = ([None; 2], [near_m; 2]);
        for row in self.rows() {
            let slack = row.slack(v, square).abs();
            if slack < least[0] {
                (nearest, least) = ([Some(row), nearest[0]], [slack, least[0]]);
            } else if slack < least[1] {
                (nearest[1], least[1]) = (Some(row), slack);
            }
        }
        Some([nearest[0]?, nearest[1]?])
    }
}

/// True if no other point of the two balls is as close to `desired` as v, which is on both boundaries. That is so if the way
/// from v to `desired` is a sum of the two gradients with factors that are not negative.
fn decide<const D: usize>(one: &Row<D>, other: &Row<D>, v: &Vector<D>, desired: &Vector<D>) -> bool {
    let ([a, b], way) = ([one, other].map(|row| row.gradient(v)), subtract(desired, v));
    let (aa, ab, bb) = (dot(&a, &a), dot(&a, &b), dot(&b, &b));
    let (along_a, along_b) = (dot(&a, &way), dot(&b, &way));
    let apart = aa * bb - ab * ab > APART * aa * bb;
    apart && bb * along_a >= ab * along_b && aa * along_b >= ab * along_a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::InputBox;
    use crate::program::balls::reach::Reach;

    /// The corner (1, 0.5) of a box is the answer to a desire beyond both of its sides, and no answer to one beyond a single side.
    #[test]
    fn a_corner_is_taken_only_where_both_sides_push_back() {
        let input = InputBox::of([-1.0; 2], [1.0, 0.5]);
        let mut memory = [Row::default(); 5];
        let mut program = Program::new(&mut memory, Reach::new(&input, 1.0));
        let corner = [1.0, 0.5];
        assert_eq!(program.warm_start(&[3.0, 2.0], &corner), Some(corner));
        assert_eq!(program.warm_start(&[3.0, 2.0], &[0.9999, 0.5001]), Some(corner));
        assert_eq!(program.warm_start(&[3.0, 0.4], &corner), None);
        assert_eq!(program.warm_start(&[0.5, 2.0], &corner), None);
        assert_eq!(program.warm_start(&[3.0, 2.0], &[0.0, 0.0]), None);
        program.push(Row::new([1.0, 1.0], 0.0, 1.4));
        assert_eq!(program.warm_start(&[3.0, 2.0], &corner), None, "a third row is broken there");
    }

    #[test]
    fn where_gradients_are_nearly_parallel_there_is_no_warm_start() {
        let ball = Row::new([0.0, 0.0], 1.0, 1.0);
        let grazing = |sine: f64| Row::new([1.0, sine], 0.0, 1.0);
        for (sine, taken) in [(0.5, true), (0.1, true), (1e-3, false), (0.0, false)] {
            assert_eq!(decide(&ball, &grazing(sine), &[1.0, 0.0], &[2.0, 0.25 * sine]), taken, "{sine}");
        }
    }
}
