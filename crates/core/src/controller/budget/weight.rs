//! The weight that `budget` gives to links, and how fast it lets margins be spent: chosen for the task unless it is set.
//!
//! The theorem holds for every choice (thm:discrete). How far and how fast a team gets depends on it, and what is best depends
//! on how long a tick is, how far a robot moves in it, and how wrong positions may be.

use crate::controller::budget::settings::fraction_of_rate;
use crate::num::sqrt;
use crate::settings::BudgetSettings;

/// α, 1/s: the rate at which h may be lost.
const RATE_PER_S: f64 = 16.0;
/// α_c, 1/s: the rate at which D − Δ_d² may be lost.
const RATE_C_PER_S: f64 = 45.0;
/// How much a move and an error of an offset widen the step of the weight ([`Conditions::width_m`]).
const OF_MOVE: f64 = 0.018;
const OF_ERROR: f64 = 0.11;
/// The step of the weight is at least and at most so many radii wide.
const NARROWEST: f64 = 1.0 / 300.0;
const WIDEST: f64 = 0.25;
/// ε as a fraction of its limit. One neighbour too few then makes h at most −0.001, far more than rounding hides.
const BELOW_LIMIT: f64 = 0.999;

/// What a weight is chosen for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditions {
    /// R, m.
    pub radius_m: f64,
    /// How many of those who count a robot must keep.
    pub need: u16,
    /// T, s: how long a tick is.
    pub period_s: f64,
    /// ρ, m: the longest move of a robot in a tick.
    pub move_max_m: f64,
    /// 2E, m: how far an offset may be wrong.
    pub offset_error_m: f64,
}

/// A weight, and what may be lost of margins in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight {
    /// q₂, the steepness of the weight, 1/m⁴.
    pub q2: f64,
    /// ε of q₁ = 2 + ε.
    pub epsilon: f64,
    /// γ: the fraction of h_k that may be lost in a tick.
    pub gamma: f64,
    /// γ_c: the fraction of D − Δ_d² that may be lost in a tick.
    pub gamma_c: f64,
}

impl Conditions {
    /// Below this, ε lets `h_k ≥ 0` mean as many neighbours as are needed: 2/(need − 1), or 2 where one is enough.
    //= theory lem:degree
    #[must_use]
    pub fn epsilon_limit(&self) -> f64 {
        2.0 / f64::from(self.need.saturating_sub(1).max(1))
    }

    /// w, m: how wide the step of the weight is made, between R/300 and R/4.
    ///
    /// ```text
    /// w = √( R (0.018 ρ + 0.11 · 2E) )
    /// ```
    ///
    /// A narrow step lets links be longer before they weigh less. In a wide one a move or an error changes less of a weight.
    /// Both costs are alike where w² is in proportion to the move and to the error. The two factors are measured.
    //= theory eq:own-width
    #[must_use]
    pub fn width_m(&self) -> f64 {
        let square = self.radius_m * (OF_MOVE * self.move_max_m + OF_ERROR * self.offset_error_m);
        sqrt(square).max(NARROWEST * self.radius_m).min(WIDEST * self.radius_m)
    }

    /// q₂ of a step of that width, 1/m⁴: `q₂ s² = 1` at `s = 2 R w`.
    fn q2(&self) -> f64 {
        let slack_m2 = 2.0 * self.radius_m * self.width_m();
        1.0 / (slack_m2 * slack_m2)
    }
}

impl BudgetSettings {
    /// What is set, and for the rest what is chosen for these conditions.
    //= theory sec:own-weight
    #[must_use]
    pub fn weight(&self, of: &Conditions) -> Weight {
        let rate = |rate_per_s| fraction_of_rate(rate_per_s, of.period_s);
        Weight {
            q2: self.q2.unwrap_or_else(|| of.q2()),
            epsilon: self.epsilon.unwrap_or_else(|| BELOW_LIMIT * of.epsilon_limit()),
            gamma: self.gamma.unwrap_or_else(|| rate(RATE_PER_S)),
            gamma_c: self.gamma_c.unwrap_or_else(|| rate(RATE_C_PER_S)),
        }
    }
}
