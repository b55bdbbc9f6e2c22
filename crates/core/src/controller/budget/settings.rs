//! What the controller `budget` is told once.

use crate::controller::budget::curvature::Curvature;
use crate::controller::budget::knowledge::{Assume, Trust};
use crate::controller::budget::margin::Margin;
use crate::num::exp;

/// What bounds the loss of connectivity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// (far): every link by itself.
    Link,
    /// (far′): the level of every robot; leaving one neighbour may be paid for by approaching another. Sound under
    /// [`Assume::Obedient`] only; under [`Assume::Free`], `Link` is used in its place.
    Level,
}

/// The controller `budget`. All robots of a team must have the same; only trust may differ.
///
/// Not even the form: (far) bounds the loss of a link by the distance, (far′) by the joint move of both ends, and a pair
/// of which one end has each is covered by neither proof.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Bounds of the link weight's derivatives, and its shape.
    pub curvature: Curvature,
    /// n.
    pub robots: u16,
    /// F.
    pub faults: u16,
    /// Δ_d, m.
    pub distance_min_m: f64,
    /// ρ, m: the longest move of *any* robot in a tick, see [`Reach::longest_m`](crate::program::balls::reach::Reach::longest_m).
    pub move_max_m: f64,
    /// γ in (0, 1]: the share of h_k that may be lost in a tick, see [`share_of_rate`].
    pub gamma: f64,
    /// κ ≥ 0, by how much the share rises with h_k, see [`loss_max`](Self::loss_max).
    pub rise: f64,
    /// γ_c in (0, 1]: the share of D − Δ_d² that may be lost in a tick.
    pub gamma_c: f64,
    /// What is believed of levels.
    pub trust: Trust,
    /// What malicious robots may do.
    pub assume: Assume,
    /// Which rows bound the loss of connectivity.
    pub form: Form,
    /// Errors of sensing and tracking; `curvature` and `distance_min_m` are those of the references.
    pub margin: Margin,
}

/// Why the theorem would not hold with some settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unsound {
    /// γ is not in (0, 1].
    Gamma,
    /// γ_c is not in (0, 1].
    GammaC,
    /// κ is negative or no number.
    Rise,
    /// `R − 2ρ < Δ_d`: two robots that do not see each other yet could be too close a tick later.
    Blind,
    /// `q₁/2 (required − 1) ≥ required`: h ≥ 0 would not mean that many neighbours.
    Height,
    /// More neighbours are required than there are other robots.
    Required,
}

impl Budget {
    /// Checks what the theorem assumes of the settings; the first that fails is the error. Nothing else is unsafe then:
    /// any settings give moves in the box that satisfy their rows.
    pub fn check(&self) -> Result<(), Unsound> {
        let (required, link) = (f64::from(self.required()), self.curvature.link());
        let share = |gamma: f64| 0.0 < gamma && gamma <= 1.0;
        let checks = [
            (share(self.gamma), Unsound::Gamma),
            (share(self.gamma_c), Unsound::GammaC),
            ((0.0..f64::INFINITY).contains(&self.rise), Unsound::Rise),
            (link.radius_m - 2.0 * self.move_max_m >= self.distance_min_m, Unsound::Blind),
            (0.5 * link.q1 * (required - 1.0) < required, Unsound::Height),
            (required < f64::from(self.robots), Unsound::Required),
        ];
        checks.into_iter().find(|(holds, _)| !holds).map_or(Ok(()), |(_, unsound)| Err(unsound))
    }

    /// s(h): what all robots together may take of h_k ≥ 0 in a tick.
    ///
    /// ```text
    /// s(h) = γ h (1 + κ h)/(1 + κγ h),      h − s(h) = (1 − γ) h/(1 + κγ h) ≥ 0
    /// ```
    ///
    /// the loss of `ḣ = −α (h + κ h²)` in a tick, `γ = 1 − e^(−αT)`: far from the limit robots may spend faster than close to it.
    /// The proof needs no more than `s(b) ≤ s(h) ≤ h` for `b ≤ h`, and s rises. With κ = 0 it is METHOD.md's `γ h`.
    //= method far-prime
    #[inline]
    #[must_use]
    pub fn loss_max(&self, h: f64) -> f64 {
        if self.rise == 0.0 {
            return self.gamma * h;
        }
        self.gamma * h * ((1.0 + self.rise * h) / (1.0 + self.rise * self.gamma * h))
    }

    /// The least that `ticks` ticks leave of h: the same law over a longer time, since it is that of a differential equation.
    ///
    /// ```text
    /// g h/(1 + κ (1 − g) h),   g = (1 − γ)^ticks
    /// ```
    #[must_use]
    pub fn left(&self, h: f64, ticks: u32) -> f64 {
        let kept = power(1.0 - self.gamma, ticks);
        kept * h / (1.0 + self.rise * (1.0 - kept) * h)
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

impl core::fmt::Display for Unsound {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Gamma => "gamma is not more than 0 and at most 1",
            Self::GammaC => "gamma_c is not more than 0 and at most 1",
            Self::Rise => "rise is negative",
            Self::Blind => "two robots out of range of each other could collide within a tick",
            Self::Height => "epsilon is too large for the required number of neighbours",
            Self::Required => "more neighbours are required than there are other robots",
        })
    }
}

impl core::error::Error for Unsound {}

/// `γ = 1 − e^(−αT)`: the share per tick of `period_s` (s) that loses at the rate α (1/s), whatever the tick.
///
/// The guarantee holds for every γ; how far a team gets does not. Who spends all in one tick is held where it happens to
/// stand. Mean radius of gyration of the paper's eleven robots after 10 s (q₂ = 0.3, start `inside`, twelve assignments of
/// robots to places, no attack; `examples/budget_spread.rs`), m:
///
/// ```text
/// α, 1/s              0.5    1      2      4      8      40
/// (far′), T =  5 ms   1.359  1.470  1.541  1.537  1.503  1.459      (γ = 0.2 at 5 ms is α = 45/s)
/// (far′), T = 50 ms   1.351  1.442  1.525  1.512  1.480  1.440
/// (far),  T =  5 ms   1.356  1.422  1.485  1.475  1.441  1.427
/// free,   T =  5 ms   1.305  1.337  1.348  1.358  1.350  1.315
/// ```
#[must_use]
pub fn share_of_rate(rate_per_s: f64, period_s: f64) -> f64 {
    1.0 - exp(-rate_per_s * period_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equations::link::LinkShape;

    fn paper() -> Budget {
        Budget {
            curvature: Curvature::new(LinkShape { radius_m: 3.0, q1: 2.099, q2: 0.3 }),
            robots: 11,
            faults: 2,
            distance_min_m: 0.3,
            move_max_m: 0.0107,
            gamma: share_of_rate(2.0, 0.005),
            rise: 0.0,
            gamma_c: 0.2,
            trust: Trust::ToldOrSeen,
            assume: Assume::Obedient,
            form: Form::Level,
            margin: Margin::NONE,
        }
    }

    #[test]
    fn what_the_theorem_assumes_is_checked() {
        assert_eq!(paper().check(), Ok(()));
        assert_eq!(Budget { assume: Assume::Free, ..paper() }.check(), Ok(()));
        let tall = Curvature::new(LinkShape { radius_m: 3.0, q1: 2.4, q2: 0.3 });
        for (budget, unsound) in [
            (Budget { gamma: 0.0, ..paper() }, Unsound::Gamma),
            (Budget { gamma: f64::NAN, ..paper() }, Unsound::Gamma),
            (Budget { gamma_c: 1.1, ..paper() }, Unsound::GammaC),
            (Budget { rise: -0.1, ..paper() }, Unsound::Rise),
            (Budget { move_max_m: 1.36, ..paper() }, Unsound::Blind),
            (Budget { curvature: tall, ..paper() }, Unsound::Height),
            (Budget { faults: 6, ..paper() }, Unsound::Required),
        ] {
            assert_eq!(budget.check(), Err(unsound));
        }
    }

    /// s rises, leaves what `left` says, and m ticks of it leave what m ticks leave.
    //= method far-prime type=test
    #[test]
    fn what_may_be_lost_follows_one_law() {
        for (gamma, rise) in [(0.01, 0.0), (0.01, 3.0), (0.5, 0.7), (1.0, 2.0)] {
            let budget = Budget { gamma, rise, ..paper() };
            let mut last = -1e-300;
            for k in 0..400 {
                let h = 0.01 * f64::from(k);
                let loss = budget.loss_max(h);
                assert!(loss > last && loss <= h * (1.0 + 1e-15), "{loss} of {h}");
                assert!((h - loss - budget.left(h, 1)).abs() < 1e-14);
                let step_by_step = (0..7).fold(h, |h, _| budget.left(h, 1));
                assert!((step_by_step - budget.left(h, 7)).abs() < 1e-14);
                last = loss;
            }
        }
    }

    #[test]
    fn a_rate_is_the_same_over_one_long_tick_and_many_short_ones() {
        let kept = (0..10).fold(1.0, |kept, _| kept * (1.0 - share_of_rate(2.0, 0.005)));
        assert!((kept - (1.0 - share_of_rate(2.0, 0.05))).abs() < 1e-15);
    }
}
