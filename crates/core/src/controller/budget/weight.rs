//! The weight that `budget` gives to links, and how fast it lets margins be spent: chosen for the task unless it is set.
//!
//! The theorem holds for every choice (thm:discrete). How far and how fast a team gets depends on it, and what is best depends
//! on how long a tick is, how far a robot moves in it, and how wrong positions may be.

use crate::controller::budget::settings::fraction_of_rate;
use crate::num::sqrt;

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
/// Greatest q₂ that may be, 1/m⁴: enough for R of a centimetre.
pub(crate) const Q2_MAX: f64 = 1e12;
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
        (1.0 / (slack_m2 * slack_m2)).min(Q2_MAX)
    }

    /// What is chosen for these conditions.
    //= theory sec:own-weight
    #[must_use]
    pub fn chosen(&self) -> Weight {
        let rate = |rate_per_s| fraction_of_rate(rate_per_s, self.period_s);
        Weight {
            q2: self.q2(),
            epsilon: BELOW_LIMIT * self.epsilon_limit(),
            gamma: rate(RATE_PER_S),
            gamma_c: rate(RATE_C_PER_S),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controller::assume::Assume;
    use crate::equations::link::{Link, LinkShape};
    use crate::settings::params::Params;
    use crate::settings::{BudgetSettings, Clock, Controller, Errors, Settings, Team};

    /// n = 11, F = 2, R = 3 m, 1.5 m/s along each axis, ticks of 5 ms.
    const PAPER: Conditions =
        Conditions { radius_m: 3.0, need: 7, period_s: 0.005, move_max_m: 0.010_607, offset_error_m: 0.0 };

    fn q2(of: Conditions) -> f64 {
        BudgetSettings::default().weight(&of).q2
    }

    //= theory eq:own-width type=test
    //= theory sec:own-weight type=test
    #[test]
    fn longer_moves_and_larger_errors_make_the_step_wider() {
        let by_hand = 1.0 / (36.0 * 3.0 * 0.018 * 0.010_607);
        assert!((q2(PAPER) - by_hand).abs() < 1e-9, "{}", q2(PAPER));
        let [slow, wrong] =
            [Conditions { move_max_m: 0.106, ..PAPER }, Conditions { offset_error_m: 0.02, ..PAPER }];
        assert!((q2(slow) - 4.85).abs() < 0.01 && (q2(wrong) - 3.87).abs() < 0.01);
        let still = Conditions { move_max_m: 0.0, ..PAPER };
        assert!((still.width_m() - 0.01).abs() < 1e-15 && q2(still).is_finite());
        assert_eq!(Conditions { offset_error_m: 1e6, ..PAPER }.width_m(), 0.75);
    }

    #[test]
    fn what_is_set_is_not_chosen() {
        let set = BudgetSettings { q2: Some(0.3), gamma: Some(0.5), ..BudgetSettings::default() };
        let (weight, chosen) = (set.weight(&PAPER), BudgetSettings::default().weight(&PAPER));
        assert_eq!((weight.q2, weight.gamma, weight.epsilon), (0.3, 0.5, chosen.epsilon));
        assert!((chosen.gamma - 0.076_88).abs() < 1e-5 && (chosen.gamma_c - 0.201_5).abs() < 1e-4);
    }

    /// With the chosen ε, one neighbour too few makes h negative by far more than rounding, however close they stand; as many as
    /// are needed can have an h that is not.
    //= theory lem:degree type=test
    #[test]
    fn one_neighbor_too_few_makes_h_negative() {
        for robots in (2..200).chain([1_000, 9_999, 10_000]) {
            for faults in [0, 1, (robots - 1) / 2] {
                for assume in [Assume::Obedient, Assume::Free] {
                    let team = Team { robots, faults: faults.min((robots - 1) / 2) };
                    let parameters = BudgetSettings { assume, ..BudgetSettings::default() };
                    let settings = Settings::<2> {
                        team,
                        controller: Controller::Budget(parameters),
                        ..Settings::default()
                    };
                    let params = Params::new(settings).expect("what is chosen is allowed");
                    let most = params.link().link_at(0.0).map_or(0.0, |link: Link<f64>| link.weight);
                    let need = f64::from(settings.conditions(&parameters).need);
                    assert!((need - 1.0) * most - need < -4e-4, "{team:?} {assume:?}");
                    assert!(need * most - need > 0.0, "{team:?} {assume:?}");
                }
            }
        }
    }

    /// Whatever is allowed, the choice is allowed too, and its weight falls from its greatest to 0 within R.
    #[test]
    fn the_choice_is_allowed_for_every_task() {
        for radius_m in [0.01, 3.0, 1e6] {
            for tick_us in [1, 5_000, 3_600_000_000] {
                for (position, tracking) in [(0.0, 0.0), (1e-3, 0.0), (1e-3, 1e-2)] {
                    let errors = Errors { position_m: position * radius_m, tracking_m: tracking * radius_m };
                    let period = core::time::Duration::from_micros(tick_us);
                    let mut settings = Settings::<2> {
                        controller: Controller::Budget(BudgetSettings::default()),
                        clock: Clock { level_period: period, value_period: period, ..Clock::default() },
                        errors,
                        ..Settings::default()
                    };
                    settings.link.radius_m = radius_m;
                    settings.limits.distance_min_m = 0.01 * radius_m;
                    let speed_m_s = 1e-3 * radius_m / period.as_secs_f64();
                    settings.limits.input.min_m_s = [-speed_m_s.min(1e6); 2];
                    settings.limits.input.max_m_s = [speed_m_s.min(1e6); 2];
                    let params = Params::new(settings).expect("a task that can be");
                    let shape: &LinkShape = params.link();
                    let weight = |part: f64| {
                        let distance_m = part * radius_m;
                        shape.link_at(distance_m * distance_m).map_or(0.0, |link: Link<f64>| link.weight)
                    };
                    assert!(weight(0.1) > 0.99 * 0.5 * shape.q1 && weight(1.0 - 1e-9) < 0.01, "{settings:?}");
                }
            }
        }
    }
}
