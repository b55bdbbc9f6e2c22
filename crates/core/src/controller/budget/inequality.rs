//! Both sides of the inequalities (far), (far′) and (near): their rows, their left-hand sides as far as both ends of a pair
//! share them, what their right-hand sides let a robot spend, and when one of them needs no row.

use crate::controller::assume::Assume;
use crate::controller::budget::Own;
use crate::controller::budget::knowledge::KnownMargin;
use crate::controller::budget::settings::{Budget, Form};
use crate::controller::rows::give_m2;
use crate::id::Member;
use crate::num::{Vector, dot, length, sqrt};
use crate::program::balls::reach::Reach;
use crate::program::balls::row::Row;

/// What the rows of two robots for each other share: everything but the direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Δ², m².
    pub distance_m2: f64,
    /// Δ, m.
    pub distance_m: f64,
    /// `2 ∂a/∂Δ²`, 1/m², never positive; 0 without a link.
    pub slope: f64,
    /// κ of (far′), or L of (far), 1/m².
    pub bend: f64,
    /// Bound of the error of the gradient along each axis, 1/m.
    pub gradient_error: f64,
    /// The left-hand side of (far′) is at most this wherever the robot can go. It has no meaning for (far).
    pub(crate) lhs_max: f64,
    /// True if the pair is far enough apart and (near) holds wherever the robot can go.
    pub(crate) near_is_slack: bool,
}

/// A neighbour, with all that its rows need.
#[derive(Clone, Copy, Debug)]
pub struct Neighbor<'a, const D: usize> {
    /// Which robot it is.
    pub member: Member,
    /// x_i − x_j, m.
    pub offset_m: Vector<D>,
    /// What both ends share, made with the reach that the rows are for.
    pub pair: &'a Pair,
    /// What is known of its h_j.
    pub known: KnownMargin,
}

impl<const D: usize> Row<D> {
    /// (far′) for the gradient g, 1/m, and κ, 1/m²: `−g·v + κ|v|² ≤ spend`.
    //= theory eq:far-prime
    #[must_use]
    pub fn far_level(gradient: &Vector<D>, bend: f64, spend: f64) -> Self {
        Self::new(gradient.map(|component| -component), bend, spend)
    }
}

/// The left-hand sides of the rows.
impl Budget {
    /// The pair of two robots at `offset` (m) that can both move within `reach`. `slope` is that of their link, or 0.
    #[inline]
    #[must_use]
    pub fn pair<const D: usize>(&self, offset: &Vector<D>, slope: f64, reach: &Reach<D>) -> Pair {
        let bend = &mut [length(offset)];
        self.bends_max(bend);
        let [bend] = *bend;
        self.pair_with(offset, slope, bend, reach)
    }

    /// Replaces the distances of many pairs, m, by their κ of (far′) or L of (far), 1/m².
    #[inline]
    pub fn bends_max(&self, distances_m: &mut [f64]) {
        let (move_max_m, error_m) = (self.move_max_m, self.errors.offset_m);
        match self.form() {
            Form::Level => self.curvature.bends_max(distances_m, move_max_m, error_m),
            Form::Link => {
                for distance_m in distances_m {
                    *distance_m = self.curvature.slope_max(*distance_m, move_max_m, error_m);
                }
            }
        }
    }

    /// [`pair`](Self::pair) with a bend that [`bends_max`](Self::bends_max) gave.
    #[inline]
    #[must_use]
    pub fn pair_with<const D: usize>(
        &self,
        offset: &Vector<D>,
        slope: f64,
        bend: f64,
        reach: &Reach<D>,
    ) -> Pair {
        let (distance_m2, error_m) = (dot(offset, offset), self.errors.offset_m);
        let distance_m = sqrt(distance_m2);
        let gradient_error = match self.form() {
            Form::Link => 0.0,
            Form::Level => self.curvature.gradient_error(distance_m, error_m),
        };
        let mut pair =
            Pair { distance_m2, distance_m, slope, bend, gradient_error, lhs_max: 0.0, near_is_slack: false };
        pair.lhs_max = reach.lhs_max(&pair.gradient(offset), gradient_error, bend);
        let spare_m2 = self.spare_m2(&pair, -error_m);
        pair.near_is_slack =
            spare_m2 >= 0.0 && reach.lhs_max(offset, error_m, 0.0) <= 0.5 * give_m2(self.gamma_c, spare_m2);
        pair
    }

    /// Which rows bound the loss of connectivity: those of the settings, or (far) where (far′) would not be sound.
    pub(super) fn form(&self) -> Form {
        match self.assume {
            Assume::Obedient => self.form,
            Assume::Free => Form::Link,
        }
    }
}

/// The right-hand sides of the rows.
impl Budget {
    /// What a robot may spend of a neighbour's h_k by moving: `s(b_ik)/(δ⁺_ik + 1)`.
    //= theory eq:far-prime
    pub(super) fn spend(&self, known: &KnownMargin) -> f64 {
        self.loss_max(known.budget) / (known.degree_max + 1.0)
    }

    /// What a robot may spend of its own h_i by moving: `s(h_i⁺)/(δ_i + 1)`, or under ranks a third.
    //= theory eq:far-prime
    //= theory eq:known-ranked
    pub(super) fn spend_own<const D: usize>(&self, own: &Own<D>) -> f64 {
        let parts = if self.need.is_ranked() { 3.0 } else { own.degree + 1.0 };
        self.loss_max(own.h.max(0.0)) / parts
    }

    /// True when (far′) holds wherever the robot can go, where its left-hand side is at most `lhs_max`. There is no quotient
    /// in it, because this is asked of every neighbour.
    pub(super) fn far_level_is_slack(&self, lhs_max: f64, known: &KnownMargin) -> bool {
        lhs_max * (known.degree_max + 1.0) <= self.loss_max(known.budget)
    }

    /// β_ij of two robots that count for each other, m²: what one link may spend. `+∞` where the link cannot be weakened.
    ///
    /// ```text
    /// β_ij = min( s(h_i⁺)/δ_i, s(b_ij)/δ⁺_ij )/(4 L_ij)
    /// ```
    ///
    /// The proof needs no more than fractions that sum to at most 1 over the neighbours of j, and `δ⁺_ij ≥ δ_j` for each of
    /// them. A fraction of 1/(n − 1) would do as well, and is never larger.
    //= theory eq:far
    #[must_use]
    pub fn beta_m2(&self, slope_max: f64, own_fraction: f64, known_fraction: f64) -> f64 {
        let least = own_fraction.min(known_fraction);
        if slope_max <= 0.0 { f64::INFINITY } else { least / (4.0 * slope_max) }
    }

    /// β_ij for a neighbour, m². An end for which the other one does not count sets no bound.
    //= theory eq:far
    pub(super) fn beta_of<const D: usize>(&self, own: &Own<D>, neighbor: &Neighbor<'_, D>) -> f64 {
        let Neighbor { member, pair, known, .. } = neighbor;
        let (mut own_fraction, mut known_fraction) = (f64::INFINITY, f64::INFINITY);
        if self.need.counts(own.member, *member) {
            own_fraction = self.loss_max(own.h.max(0.0)) / own.degree.max(1.0);
        }
        if self.need.counts(*member, own.member) {
            known_fraction = self.loss_max(known.budget) / known.degree_max;
        }
        self.beta_m2(pair.bend, own_fraction, known_fraction)
    }

    /// `D − Δ_d²`, m², for a pair that is farther apart by `more_m`.
    pub(super) fn spare_m2(&self, pair: &Pair, more_m: f64) -> f64 {
        let least_m2 = self.distance_min_m * self.distance_min_m;
        if more_m == 0.0 {
            return pair.distance_m2 - least_m2;
        }
        let distance_m = (pair.distance_m + more_m).max(0.0);
        distance_m * distance_m - least_m2
    }
}

impl Pair {
    /// A place holder for two robots that do not see each other; it is not a pair of neighbours.
    pub const NONE: Self = Self {
        distance_m2: f64::INFINITY,
        distance_m: f64::INFINITY,
        slope: 0.0,
        bend: 0.0,
        gradient_error: 0.0,
        lhs_max: 0.0,
        near_is_slack: true,
    };

    /// ∂a/∂x_i, 1/m, of the end from which the other is at −`offset`.
    #[inline]
    #[must_use]
    pub fn gradient<const D: usize>(&self, offset: &Vector<D>) -> Vector<D> {
        core::array::from_fn(|d| self.slope * offset[d])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    //= theory eq:far-prime type=test
    #[test]
    fn a_row_by_hand() {
        let level = Row::far_level(&[2.0, 0.0], 1.0, 0.0);
        assert!(level.holds(&[2.0, 0.0]) && !level.holds(&[2.01, 0.0]) && !level.holds(&[-0.01, 0.0]));
    }
}
