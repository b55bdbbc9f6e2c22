//! What the controller `budget` is told once.

use crate::controller::assume::Assume;
use crate::controller::budget::curvature::Curvature;
use crate::controller::errors::ErrorBounds;
use crate::need::Need;
use crate::num::exp;

/// What a robot believes about the levels of its neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// What was told, cut to what is possible.
    Told,
    /// The larger of what was told and what is seen.
    ToldOrSeen,
    /// What is seen alone. No level need be sent, so there is nothing to lie about.
    Seen,
}

/// What bounds the loss of connectivity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// (far): every link is bounded by itself.
    Link,
    /// (far′): the level of every robot is bounded; leaving one neighbour may be paid for by approaching another. Sound under
    /// [`Assume::Obedient`] only; under [`Assume::Free`], `Link` is used in its place.
    Level,
}

/// The controller `budget`. All robots of a team must have the same; only trust may differ.
///
/// The form must be the same too. (far) bounds the loss of a link by the distance, (far′) by the joint move of both ends, and
/// a pair whose ends have different forms is covered by neither proof (docs/theory, sec:mixing).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Bounds of the link weight's derivatives, and its shape.
    pub curvature: Curvature,
    /// Who counts for whom, and how many each robot must keep.
    pub need: Need,
    /// F, the number of terms that a trimmed sum leaves out.
    pub faults: u16,
    /// Δ_d, m.
    pub distance_min_m: f64,
    /// ρ, m: the longest move of *any* robot in a tick, see [`Reach::longest_m`](crate::program::balls::reach::Reach::longest_m).
    pub move_max_m: f64,
    /// γ in (0, 1]: the fraction of h_k that may be lost in a tick, see [`fraction_of_rate`].
    pub gamma: f64,
    /// q ≥ 0, by how much that fraction rises with h_k, see [`loss_max`](Self::loss_max).
    pub gain_slope: f64,
    /// γ_c in (0, 1]: the fraction of D − Δ_d² that may be lost in a tick.
    pub gamma_c: f64,
    /// What is believed of levels.
    pub trust: Trust,
    /// What malicious robots may do.
    pub assume: Assume,
    /// Which rows bound the loss of connectivity.
    pub form: Form,
    /// Errors of sensing and tracking; `curvature` and `distance_min_m` are those of the references.
    pub errors: ErrorBounds,
}

impl Budget {
    /// s(h): what all robots together may take of h_k ≥ 0 in a tick.
    ///
    /// ```text
    /// s(h) = γ h (1 + q h)/(1 + γ q h),      h − s(h) = (1 − γ) h/(1 + γ q h) ≥ 0
    /// ```
    ///
    /// This is what `ḣ = −α (h + q h²)` loses in a tick of length T, with `γ = 1 − e^(−αT)`: far from the limit robots may
    /// spend faster than close to it. The proof needs no more than `s(b) ≤ s(h) ≤ h` for `b ≤ h`. With q = 0 it is `γ h`.
    //= theory eq:loss
    #[inline]
    #[must_use]
    pub fn loss_max(&self, h: f64) -> f64 {
        if self.gain_slope == 0.0 {
            return self.gamma * h;
        }
        self.gamma * h * ((1.0 + self.gain_slope * h) / (1.0 + self.gain_slope * self.gamma * h))
    }

    /// The least that `ticks` ticks leave of h. This is the law of [`loss_max`](Self::loss_max) over a longer time; it has a
    /// closed form because it is that of a differential equation.
    ///
    /// ```text
    /// g h/(1 + q (1 − g) h),   g = (1 − γ)^ticks
    /// ```
    //= theory eq:decayed
    #[must_use]
    pub fn decayed(&self, h: f64, ticks: u32) -> f64 {
        let kept = power(1.0 - self.gamma, ticks);
        kept * h / (1.0 + self.gain_slope * (1.0 - kept) * h)
    }
}

/// `baseᵉ` by squaring, in the same order on every target.
fn power(base: f64, exponent: u32) -> f64 {
    let (mut result, mut square, mut rest) = (1.0, base, exponent);
    while rest > 0 {
        if rest & 1 == 1 {
            result *= square;
        }
        square *= square;
        rest >>= 1;
    }
    result
}

/// `γ = 1 − e^(−αT)`: the fraction per tick of `period_s` (s) that loses at the rate α (1/s), whatever the tick.
///
/// The guarantee holds for every γ, but how far and how fast a team gets depends on it (docs/theory, sec:own-weight). A robot
/// that spends all in one tick is held where it happens to stand.
#[must_use]
pub fn fraction_of_rate(rate_per_s: f64, period_s: f64) -> f64 {
    1.0 - exp(-rate_per_s * period_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equations::link::LinkShape;
    use crate::need::Keep;

    fn paper() -> Budget {
        Budget {
            curvature: Curvature::new(LinkShape { radius_m: 3.0, q1: 2.099, q2: 0.3 }),
            need: Need::new(11, 2, Keep::Neighbors),
            faults: 2,
            distance_min_m: 0.3,
            move_max_m: 0.0107,
            gamma: fraction_of_rate(2.0, 0.005),
            gain_slope: 0.0,
            gamma_c: 0.2,
            trust: Trust::ToldOrSeen,
            assume: Assume::Obedient,
            form: Form::Level,
            errors: ErrorBounds::NONE,
        }
    }

    /// s rises, leaves what `decayed` says, and m ticks of it leave what m ticks leave.
    //= theory eq:loss type=test
    //= theory eq:decayed type=test
    #[test]
    fn what_may_be_lost_follows_one_law() {
        for (gamma, gain_slope) in [(0.01, 0.0), (0.01, 3.0), (0.5, 0.7), (1.0, 2.0)] {
            let budget = Budget { gamma, gain_slope, ..paper() };
            let mut last = -1e-300;
            for k in 0..400 {
                let h = 0.01 * f64::from(k);
                let loss = budget.loss_max(h);
                assert!(loss > last && loss <= h * (1.0 + 1e-15), "{loss} of {h}");
                assert!((h - loss - budget.decayed(h, 1)).abs() < 1e-14);
                let step_by_step = (0..7).fold(h, |h, _| budget.decayed(h, 1));
                assert!((step_by_step - budget.decayed(h, 7)).abs() < 1e-14);
                last = loss;
            }
        }
    }

    #[test]
    fn a_rate_is_the_same_over_one_long_tick_and_many_short_ones() {
        let kept = (0..10).fold(1.0, |kept, _| kept * (1.0 - fraction_of_rate(2.0, 0.005)));
        assert!((kept - (1.0 - fraction_of_rate(2.0, 0.05))).abs() < 1e-15);
    }
}
