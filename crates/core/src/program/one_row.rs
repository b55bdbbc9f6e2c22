//! The closest point of a program with one row more, at which 0 need not hold: the paper's row among obstacles.

use crate::num::{Vector, add_scaled, dot, length, subtract};
use crate::program::Outcome;
use crate::program::balls::row::Row as Ball;
use crate::program::balls::{Closest, Program};
use crate::program::box_row::Row;

/// The point of the program that is farthest along a direction is taken for the one closest to a point so many longest moves away.
const FAR: f64 = 1e6;

/// `arg min |v − desired|²` over all rows of `program` and `row`, m, with `row.bound` in m.
///
/// If the row holds at 0, it is one row more. If not, let f be the point of the program that is farthest along its normal. If the
/// row does not hold there, none does: the answer is f, and the outcome `Infeasible`. Else all rows hold at f, and seen from there
/// the program is one that contains 0. f is found to a millionth of the longest move; by so much a row may be called infeasible
/// that is not.
//= theory sec:obstacles-composed
#[must_use]
pub(crate) fn closest_beyond<const D: usize>(
    program: &mut Program<'_, D>,
    desired_m: &Vector<D>,
    row: &Row<D>,
) -> Closest<D> {
    let opposite = row.normal.map(|component| -component);
    if row.bound <= 0.0 {
        program.push(Ball::new(opposite, 0.0, -row.bound));
        return program.closest(desired_m);
    }
    let far_m = FAR * program.reach.longest_m() / length(&row.normal);
    if !far_m.is_finite() {
        return Closest { outcome: Outcome::Infeasible, ..program.closest(desired_m) };
    }
    let farthest = program.closest(&row.normal.map(|component| component * far_m));
    let above = dot(&row.normal, &farthest.displacement_m) - row.bound;
    if above.is_nan() || above < 0.0 || program.is_full() {
        return Closest { outcome: Outcome::Infeasible, ..farthest };
    }
    program.shift(&farthest.displacement_m);
    program.keep(Ball::new(opposite, 0.0, above));
    let found = program.closest(&subtract(desired_m, &farthest.displacement_m));
    let displacement_m = add_scaled(&farthest.displacement_m, 1.0, &found.displacement_m);
    let outcome = if displacement_m == *desired_m { Outcome::Free } else { Outcome::Active };
    Closest { displacement_m, outcome, ..found }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::InputBox;
    use crate::program::balls::reach::Reach;
    use crate::program::box_row;

    const SQUARE: InputBox<2> = InputBox::of([-1.5, -0.5], [1.0, 1.5]);

    fn beyond(desired: &[f64; 2], row: &Row<2>, more: &[Ball<2>]) -> Closest<2> {
        let mut memory = [Ball::default(); 12];
        let mut program = Program::new(&mut memory, Reach::new(&SQUARE, 1.0));
        for row in more {
            program.push(*row);
        }
        closest_beyond(&mut program, desired, row)
    }

    /// Without obstacles it is the paper's program, which is solved in another way.
    //= theory sec:obstacles-composed type=test
    #[test]
    fn in_a_box_alone_it_is_the_point_of_the_walk_along_kinks() {
        for k in 0..2000 {
            let (angle, turn) = (0.7 * f64::from(k), 0.31 * f64::from(k % 53));
            let row = Row { normal: [libm::cos(angle), libm::sin(angle)], bound: 0.002 * f64::from(k) - 2.0 };
            let desired = [2.5 * libm::cos(turn), 2.5 * libm::sin(turn)];
            let (one, other) = (beyond(&desired, &row, &[]), box_row::closest(&desired, &row, &SQUARE));
            let off_m = length(&subtract(&one.displacement_m, &other.velocity_m_s));
            assert!(off_m < 1e-5, "{k}: {one:?} {other:?}");
            let infeasible = [one.outcome, other.outcome].map(|outcome| outcome == Outcome::Infeasible);
            assert_eq!(infeasible[0], infeasible[1], "{k}");
        }
    }

    #[test]
    fn where_the_row_and_an_obstacle_conflict_the_obstacle_wins() {
        let (row, wall) = (Row { normal: [1.0, 0.0], bound: 0.5 }, Ball::new([1.0, 0.0], 0.0, 0.2));
        let stuck = beyond(&[0.0, 0.1], &row, &[wall]);
        assert_eq!(stuck.outcome, Outcome::Infeasible);
        assert!(stuck.displacement_m[0] <= 0.2 && stuck.displacement_m[0] > 0.2 - 1e-9);
        let slant = Ball::new([1.0, 1.0], 0.0, 0.2);
        let around = beyond(&[0.0, 0.1], &row, &[slant]);
        assert_eq!(around.outcome, Outcome::Active);
        assert!(length(&subtract(&around.displacement_m, &[0.5, -0.3])) < 1e-9, "{around:?}");
    }
}
