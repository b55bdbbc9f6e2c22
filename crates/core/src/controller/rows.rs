//! The rows of a tick: the program, the desired displacement, what the state of this tick violates, and what comes of them.

use crate::num::{Vector, add_scaled, dot, larger, length};
use crate::program::Outcome;
use crate::program::balls::reach::Reach;
use crate::program::balls::row::Row;
use crate::program::balls::{Closest, Program};
use crate::robot::report::Reason;

/// What the rows of a tick come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move<const D: usize> {
    /// v, m: inside the box, and every row holds.
    pub displacement_m: Vector<D>,
    /// How the program found it.
    pub outcome: Outcome,
    /// What in this tick speaks against the state.
    pub doubt: Option<Reason>,
}

/// The rows of a tick.
#[derive(Debug)]
pub struct Rows<'memory, const D: usize> {
    /// The program; its rows are all that bounds the move.
    pub program: Program<'memory, D>,
    /// The desired displacement, m, as recovery has raised it.
    pub desired_m: Vector<D>,
    /// The robot's own h_i, of its level or of its trimmed level.
    pub h: f64,
    /// How many limits are certainly violated: h_i < 0, or another robot closer than Δ_d.
    pub broken: usize,
    /// How many limits may be violated. Without errors of positions this is the same as `broken`.
    pub doubtful: usize,
    /// True if the robot is certainly nearer to an obstacle than it may be.
    pub obstructed: bool,
}

impl<'memory, const D: usize> Rows<'memory, D> {
    /// The box alone.
    pub(crate) fn new(desired_m: &Vector<D>, reach: Reach<D>, memory: &'memory mut [Row<D>]) -> Self {
        let desired_m = desired_m.map(|component| if component.is_finite() { component } else { 0.0 });
        Self {
            program: Program::new(memory, reach),
            desired_m,
            h: 0.0,
            broken: 0,
            doubtful: 0,
            obstructed: false,
        }
    }

    /// Adds a row that holds at v = 0 alone, because nothing is known of the state.
    pub(crate) fn forbid_any_move(&mut self) {
        self.program.push(Row::new([0.0; D], 1.0, 0.0));
        self.doubtful += 1;
    }

    /// The displacement, m, that is closest to the desired one among those where every row holds.
    #[must_use]
    pub fn closest(&mut self) -> Closest<D> {
        self.program.closest(&self.desired_m)
    }

    /// This finds the same displacement up to rounding, faster where `before_m` is close to it ([`Program::closest_from`]).
    #[must_use]
    pub fn closest_from(&mut self, before_m: &Vector<D>) -> Closest<D> {
        self.program.closest_from(&self.desired_m, before_m)
    }

    /// As [`Program::push_around`](Program).
    pub(crate) fn push(&mut self, vector: &Vector<D>, error: f64, row: impl Fn(&Vector<D>) -> Row<D>) {
        self.program.push_around(vector, error, row);
    }

    /// Counts a violation that is possible, and `certain` or not.
    pub(crate) fn count_violation(&mut self, certain: bool) {
        self.doubtful += 1;
        self.broken += usize::from(certain);
    }

    /// Counts an obstacle that may be too near, and is so for `certain` or not.
    pub(crate) fn count_obstacle(&mut self, certain: bool) {
        self.doubtful += 1;
        self.obstructed |= certain;
    }

    /// Raises the desired displacement along `direction` to at least `wanted_m`.
    pub(crate) fn raise(&mut self, direction: &Vector<D>, wanted_m: f64) {
        let size = length(direction);
        if size > 0.0 && size.is_finite() && wanted_m > 0.0 {
            let unit = direction.map(|component| component / size);
            let missing = wanted_m - dot(&unit, &self.desired_m);
            if missing > 0.0 {
                self.desired_m = add_scaled(&self.desired_m, missing, &unit);
            }
        }
    }

    /// The closest point and what it means. `before_m` is the displacement of the tick before: where the closest point is near
    /// to it, it is found faster, and changes by no more than rounding.
    #[must_use]
    pub fn decide(&mut self, before_m: &Vector<D>) -> Move<D> {
        let closest = self.closest_from(before_m);
        let doubt = match (self.broken, self.doubtful) {
            (0, 0) => None,
            (0, _) if self.obstructed => Some(Reason::Obstacle),
            (0, _) => Some(Reason::Uncertain),
            _ => Some(Reason::OutsideSafeSet),
        };
        let outcome = if self.broken > 0 || self.obstructed { Outcome::Recovering } else { closest.outcome };
        Move { displacement_m: closest.displacement_m, outcome, doubt }
    }
}

impl<const D: usize> Row<D> {
    /// (far) for `offset` r, m, and β, m²: `r·v + |v|² ≤ β`.
    //= theory eq:far
    #[must_use]
    pub fn far(offset: &Vector<D>, beta_m2: f64) -> Self {
        Self::new(*offset, 1.0, beta_m2)
    }

    /// (near) for `offset` r, m: `−2 r·v ≤ give`, m².
    //= theory eq:near
    #[must_use]
    pub fn near(offset: &Vector<D>, give_m2: f64) -> Self {
        Self::new(offset.map(|component| -2.0 * component), 0.0, give_m2)
    }
}

/// True where a row is needed: unless its left-hand side is never more than its bound, and where either is NaN.
pub(crate) fn may_bind(lhs_max: f64, bound: f64) -> bool {
    lhs_max > bound || lhs_max.is_nan() || bound.is_nan()
}

/// What (near) lets one of two robots take of `D − Δ_d²`, m².
//= theory eq:near
pub(crate) fn give_m2(gamma_c: f64, spare_m2: f64) -> f64 {
    0.5 * gamma_c * larger(spare_m2, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    //= theory eq:far type=test
    //= theory eq:near type=test
    #[test]
    fn rows_by_hand() {
        let far = Row::far(&[0.5, 0.0], 0.75);
        assert!(far.holds(&[0.65, 0.0]) && !far.holds(&[0.66, 0.0]) && far.holds(&[-1.15, 0.0]));
        assert!(!far.holds(&[-1.16, 0.0]));
        let near = Row::near(&[0.5, 0.0], give_m2(0.5, 0.4));
        assert!(near.holds(&[-0.1, 9.0]) && !near.holds(&[-0.1 - 1e-15, 9.0]));
        assert_eq!(give_m2(0.5, -0.4), 0.0);
    }
}
