//! What the controller `budget` is told once.

use crate::controller::assume::Assume;
use crate::controller::budget::curvature::Curvature;
use crate::controller::errors::ErrorBounds;
use crate::need::Need;
use crate::num::exp;

/// What bounds the loss of connectivity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// (far): every link is bounded by itself.
    Link,
    /// (far′): the level of every robot is bounded; leaving one neighbour may be paid for by approaching another. Sound under
    /// [`Assume::Obedient`] only; under [`Assume::Free`], `Link` is used in its place.
    Level,
}

/// The controller `budget`. All robots of a team must have the same.
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
    /// γ_c in (0, 1]: the fraction of D − Δ_d² that may be lost in a tick.
    pub gamma_c: f64,
    /// What malicious robots may do.
    pub assume: Assume,
    /// Which rows bound the loss of connectivity.
    pub form: Form,
    /// Errors of sensing and tracking; `curvature` and `distance_min_m` are those of the references.
    pub errors: ErrorBounds,
}

impl Budget {
    /// s(h) = γ h: what all robots together may take of h_k ≥ 0 in a tick. The proof needs no more than `s(b) ≤ s(h) ≤ h` for
    /// `b ≤ h`.
    //= theory eq:loss
    #[inline]
    #[must_use]
    pub fn loss_max(&self, h: f64) -> f64 {
        self.gamma * h
    }
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

    #[test]
    fn a_rate_is_the_same_over_one_long_tick_and_many_short_ones() {
        let kept = (0..10).fold(1.0, |kept, _| kept * (1.0 - fraction_of_rate(2.0, 0.005)));
        assert!((kept - (1.0 - fraction_of_rate(2.0, 0.05))).abs() < 1e-15);
    }
}
