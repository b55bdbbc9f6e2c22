//! What the rows of two robots for each other have in common: all but the direction.

use crate::budget::knowledge::{Assume, Known};
use crate::budget::settings::{Budget, Form};
use crate::budget::survey::Seen;
use crate::math::{Vector, sqrt};

/// Stands for no link; slopes are never positive.
pub(crate) const NO_SLOPE: f64 = 1.0;

/// Two robots at some distance, the same from both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tie {
    /// Δ², m².
    pub distance_m2: f64,
    /// Δ, m.
    pub distance_m: f64,
    /// `2 ∂a/∂Δ²`, 1/m²; positive without a link.
    pub slope: f64,
    /// κ of (far′), or L of (far), 1/m².
    pub bend: f64,
    /// Bound of the error of the gradient, 1/m.
    pub wrong: f64,
}

/// A neighbour, with all that its rows need.
#[derive(Clone, Copy, Debug)]
pub struct Neighbor<'a, const D: usize> {
    /// x_i − x_j, m.
    pub offset_m: Vector<D>,
    /// What holds for both ends.
    pub tie: &'a Tie,
    /// What is known of its spare connectivity.
    pub knowledge: Knowledge<'a>,
}

/// What a robot knows of h_j, or what it follows from: most rows hold wherever the robot can go, whatever the rest is.
#[derive(Clone, Copy, Debug)]
pub enum Knowledge<'a> {
    /// All of it.
    Known(&'a Known),
    /// For [`Budget::known_from`].
    Seen(Seen),
}

impl Budget {
    /// The tie of two robots at Δ², m², with the `slope` of their link.
    #[inline]
    #[must_use]
    pub fn tie(&self, distance_m2: f64, slope: f64) -> Tie {
        let (distance_m, error_m) = (sqrt(distance_m2), self.margin.offset_m);
        let (bend, wrong) = match self.form() {
            Form::Link => (self.curvature.slope_max(distance_m, self.move_max_m, error_m), 0.0),
            Form::Level => (
                self.curvature.bend_max(distance_m, self.move_max_m, error_m),
                self.curvature.gradient_error(distance_m, error_m),
            ),
        };
        Tie { distance_m2, distance_m, slope, bend, wrong }
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
    /// ∂a/∂x_i, 1/m, of the end from which the other is at −`offset`.
    #[must_use]
    pub fn gradient<const D: usize>(&self, offset: &Vector<D>) -> Vector<D> {
        if self.slope <= 0.0 { offset.map(|component| self.slope * component) } else { [0.0; D] }
    }
}
