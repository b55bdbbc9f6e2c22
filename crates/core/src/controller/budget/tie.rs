//! What the rows of two robots for each other have in common: all but the direction.

use crate::controller::budget::knowledge::{Assume, Known};
use crate::controller::budget::settings::{Budget, Form};
use crate::num::{Vector, dot, larger, length, sqrt};
use crate::program::balls::reach::Reach;

/// Two robots at some distance, the same from both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tie {
    /// Δ², m².
    pub distance_m2: f64,
    /// Δ, m.
    pub distance_m: f64,
    /// `2 ∂a/∂Δ²`, 1/m², never positive; 0 without a link.
    pub slope: f64,
    /// κ of (far′), or L of (far), 1/m².
    pub bend: f64,
    /// Bound of the error of the gradient, 1/m.
    pub wrong: f64,
    /// At least the left-hand side of (far′) wherever the robot can go; without meaning for (far).
    pub(crate) most: f64,
    /// True if the pair is far enough apart and (near) holds wherever the robot can go.
    pub(crate) clear: bool,
}

/// A neighbour, with all that its rows need.
#[derive(Clone, Copy, Debug)]
pub struct Neighbor<const D: usize> {
    /// x_i − x_j, m.
    pub offset_m: Vector<D>,
    /// What holds for both ends, made with the reach that the rows are for.
    pub tie: Tie,
    /// What is known of its spare connectivity.
    pub known: Known,
}

impl Budget {
    /// The tie of two robots with this `offset` (m), `slope` their link's or 0, that can both move within `reach`.
    #[inline]
    #[must_use]
    pub fn tie<const D: usize>(&self, offset: &Vector<D>, slope: f64, reach: &Reach<D>) -> Tie {
        let bend = &mut [length(offset)];
        self.bends_max(bend);
        let [bend] = *bend;
        self.tie_with(offset, slope, bend, reach)
    }

    /// κ of (far′), or L of (far), 1/m², of many pairs in place of their distances, m.
    #[inline]
    pub fn bends_max(&self, distances_m: &mut [f64]) {
        let (move_max_m, error_m) = (self.move_max_m, self.margin.offset_m);
        match self.form() {
            Form::Level => self.curvature.bends_max(distances_m, move_max_m, error_m),
            Form::Link => {
                for distance_m in distances_m {
                    *distance_m = self.curvature.slope_max(*distance_m, move_max_m, error_m);
                }
            }
        }
    }

    /// [`tie`](Self::tie) with what [`bends_max`](Self::bends_max) gives.
    #[inline]
    #[must_use]
    pub fn tie_with<const D: usize>(
        &self,
        offset: &Vector<D>,
        slope: f64,
        bend: f64,
        reach: &Reach<D>,
    ) -> Tie {
        let (distance_m2, error_m) = (dot(offset, offset), self.margin.offset_m);
        let distance_m = sqrt(distance_m2);
        let wrong = match self.form() {
            Form::Link => 0.0,
            Form::Level => self.curvature.gradient_error(distance_m, error_m),
        };
        let mut tie = Tie { distance_m2, distance_m, slope, bend, wrong, most: 0.0, clear: false };
        tie.most = reach.most(&tie.gradient(offset), wrong, bend);
        let spare_m2 = self.spare_m2(&tie, -error_m);
        tie.clear = spare_m2 >= 0.0 && reach.most(offset, error_m, 0.0) <= 0.5 * self.give_m2(spare_m2);
        tie
    }

    /// `D − Δ_d²`, m², for a pair farther apart by `more_m`.
    pub(crate) fn spare_m2(&self, tie: &Tie, more_m: f64) -> f64 {
        let least_m2 = self.distance_min_m * self.distance_min_m;
        if more_m == 0.0 {
            return tie.distance_m2 - least_m2;
        }
        let distance_m = (tie.distance_m + more_m).max(0.0);
        distance_m * distance_m - least_m2
    }

    /// What (near) lets one of two robots take of `D − Δ_d²`, m².
    //= method near
    pub(crate) fn give_m2(&self, spare_m2: f64) -> f64 {
        0.5 * self.gamma_c * larger(spare_m2, 0.0)
    }

    /// What a robot may spend of h_k by moving: `s(b_ik)/(δ⁺_ik + 1)`.
    //= method far-prime
    pub(crate) fn spend(&self, known: &Known) -> f64 {
        self.loss_max(known.budget) / (known.degree_max + 1.0)
    }

    pub(crate) fn form(&self) -> Form {
        match self.assume {
            Assume::Obedient => self.form,
            Assume::Free => Form::Link,
        }
    }
}

impl Tie {
    /// Of two robots out of sight: in place of a tie, not a tie of neighbours.
    pub const NONE: Self = Self {
        distance_m2: f64::INFINITY,
        distance_m: f64::INFINITY,
        slope: 0.0,
        bend: 0.0,
        wrong: 0.0,
        most: 0.0,
        clear: true,
    };

    /// ∂a/∂x_i, 1/m, of the end from which the other is at −`offset`.
    #[inline]
    #[must_use]
    pub fn gradient<const D: usize>(&self, offset: &Vector<D>) -> Vector<D> {
        core::array::from_fn(|d| self.slope * offset[d])
    }
}
