//! At which distances two robots need no row for each other, whatever either does in a tick: most neighbours are there.
//!
//! With f the length of the longest move within the box, neither row binds where, for D = d²,
//!
//! ```text
//! (near)  d f       ≤ (γ_c/4) (D − Δ_d²)      from d = ( f + √(f² + (γ_c Δ_d)²/4) ) · 2/γ_c on
//! (held)  d f + f²  ≤ (γ/4) (R_h² − D)        up to d = ( −f + √(f² + γ ((γ/4) R_h² − f²)) ) · 2/γ
//! ```
//!
//! both with a margin that is far more than rounding.

use crate::controller::links::Links;
use crate::num::sqrt;
use crate::program::balls::reach::Reach;

/// Far more than rounding, and far less than matters.
const MARGIN: f64 = 1e-6;

/// The squares of those distances, m². There are none if errors are stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slack {
    near_m2: f64,
    held_m2: f64,
}

impl Slack {
    /// Those of robots that can move within `reach`.
    pub(super) fn new<const D: usize>(links: &Links, reach: &Reach<D>) -> Self {
        if links.errors.offset_m > 0.0 {
            return Self { near_m2: f64::NAN, held_m2: f64::NAN };
        }
        let far_m = reach.corner_m() * (1.0 + MARGIN);
        let (least_m, most_m, gamma, gamma_c) =
            (links.distance_held_m, links.radius_m, links.gamma, links.gamma_c);
        let near_m = (far_m + sqrt(far_m * far_m + 0.25 * square(gamma_c * least_m))) * 2.0 / gamma_c;
        let left_m2 = 0.25 * gamma * most_m * most_m - far_m * far_m;
        let held_m = (sqrt(far_m * far_m + gamma * left_m2) - far_m) * 2.0 / gamma;
        Self { near_m2: square(near_m) * (1.0 + MARGIN), held_m2: square(held_m.max(0.0)) * (1.0 - MARGIN) }
    }

    /// True if (near) cannot bind at this squared distance, m².
    #[inline]
    pub(super) fn is_near_slack(&self, square_m2: f64) -> bool {
        self.near_m2 <= square_m2
    }

    /// True if (held) cannot bind at this squared distance, m².
    #[inline]
    pub(super) fn is_held_slack(&self, square_m2: f64) -> bool {
        square_m2 <= self.held_m2
    }
}

fn square(x: f64) -> f64 {
    x * x
}
