//! Recovery: how a robot mends what is violated, such as a start outside of the safe set.
//!
//! Where h_k or a distance is below its limit, the right-hand side of its row is 0, so that it cannot get worse. In addition
//! the desired displacement is raised along the gradient of the robot's own h_i and of its own distances, where these are
//! violated, by what would mend them to first order, but by no more than the longest move ρ.
//!
//! A robot does not mend the h_k of another one. Robot k mends it itself; and if k lies and walks off, whoever mended its h_k
//! would be towed behind it.

use crate::controller::budget::Own;
use crate::controller::budget::inequality::Pair;
use crate::controller::budget::settings::Budget;
use crate::controller::rows::Rows;
use crate::num::{Vector, length};

/// h is a sum of weights near 1: it is rounded by less than this. What is missing by no more is mended, but nothing is said.
pub(super) const H_ROUNDING: f64 = 1e-11;
/// Squared distances near Δ_d² are rounded by less than this fraction.
const NEAR_ROUNDING: f64 = 1e-11;

impl Budget {
    /// Recovery of the robot's own h_i, if it is below 0. What may be missing only because a neighbour was not sensed is not
    /// mended: else a robot would follow those whom it lost from sight.
    //= theory sec:recovery
    pub(super) fn recover_own<const D: usize>(&self, own: &Own<D>, rows: &mut Rows<'_, D>) {
        if own.h < 0.0 {
            let h_max = own.h + own.unsensed;
            if own.h < -H_ROUNDING {
                rows.count_violation(h_max + own.degree * self.weight_error() < -H_ROUNDING);
            }
            rows.raise(&own.gradient, self.mend_m(-h_max, &own.gradient));
        }
    }

    /// Recovery of a distance that may be less than Δ_d: each of the two robots makes up for half of what is missing. From a
    /// robot that was not sensed nobody shies away unless it is too close wherever it can have gone.
    //= theory sec:recovery
    pub(super) fn recover_distance<const D: usize>(
        &self,
        offset: &Vector<D>,
        pair: &Pair,
        rows: &mut Rows<'_, D>,
    ) {
        let (error_m, unsensed_m) = (self.errors.offset_m, self.errors.unsensed_m);
        let hair_m2 = NEAR_ROUNDING * self.distance_min_m * self.distance_min_m;
        if self.spare_m2(pair, -error_m) < -hair_m2 {
            rows.count_violation(self.spare_m2(pair, error_m) < -hair_m2);
        }
        let missing_m = self.distance_min_m + (error_m - 2.0 * unsensed_m) - pair.distance_m;
        rows.raise(offset, (0.5 * missing_m).min(self.move_max_m));
    }

    /// How far to go along `gradient` (1/m) to make up for `deficit`, m, at most ρ.
    fn mend_m<const D: usize>(&self, deficit: f64, gradient: &Vector<D>) -> f64 {
        (deficit / length(gradient)).min(self.move_max_m)
    }
}
