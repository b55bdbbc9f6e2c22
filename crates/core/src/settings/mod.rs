//! What a robot is told once, unchecked: the paper's values by default.

pub mod params;
pub mod range;

use core::time::Duration;

use crate::controller::budget::knowledge::{Assume, Trust};
use crate::controller::budget::margin::ErrorBounds;
use crate::controller::budget::settings::fraction_of_rate;
use crate::equations::composition::Share;
use crate::program::InputBox;

/// Which controller a robot runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Controller {
    /// The paper's, as printed ([`crate::equations::composition`]).
    Composed,
    /// Ours ([`crate::controller::budget`]): a guarantee in discrete time, for any lie and any loss of told levels.
    Budget,
}

/// Everything the paper leaves as a parameter, unchecked. `Default` holds the paper's values and, where it prints
/// none, ours (METHOD.md section 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings<const D: usize> {
    /// n, 2 to [`ROBOTS_MAX`](crate::settings::params::ROBOTS_MAX).
    pub robots: u16,
    /// F, with 2F + 1 ≤ n.
    pub faults: u16,
    /// R, m.
    pub radius_m: f64,
    /// Δ_d, m, less than R.
    pub distance_min_m: f64,
    /// ε of q₁ = 2 + ε, with 0 < ε < 1/(n−1); `None` for 1/(n−1) − 0.001, and half of 1/(n−1) where that is not positive.
    pub epsilon: Option<f64>,
    /// q₂, 1/m⁴.
    pub q2: f64,
    /// w_r.
    pub w_r: f64,
    /// w_c, 1/m².
    pub w_c: f64,
    /// α(s) = alpha·s, 1/s.
    pub alpha: f64,
    /// Which φ_i.
    pub share: Share,
    /// Which controller.
    pub controller: Controller,
    /// γ of `budget`: the share of h_k that may be lost in a tick, in (0, 1]; `None` for a rate of 2/s, which lets robots
    /// get farther than METHOD.md's 0.2 a tick ([`fraction_of_rate`]).
    pub gamma: Option<f64>,
    /// κ of `budget`, at least 0: by how much that share rises with h_k.
    pub rise: f64,
    /// γ_c of `budget`: the share of D − Δ_d² that may be lost in a tick, in (0, 1].
    pub gamma_c: f64,
    /// What `budget` believes of levels.
    pub trust: Trust,
    /// What `budget` assumes of malicious robots.
    pub assume: Assume,
    /// U_i.
    pub input: InputBox<D>,
    /// τ₁: how often the level is shared.
    pub level_period: Duration,
    /// τ₂: how often the value is shared and updated.
    pub value_period: Duration,
    /// `budget`: the longest that a velocity is held before the next tick, at least τ₁; `None` for τ₁. Rows are for moves
    /// of this length.
    pub hold_max: Option<Duration>,
    /// `budget`: a level told longer ago counts as not told. It bounds how long a broken assumption is felt.
    pub told_max: Duration,
    /// Bound of the difference between the clocks of any two robots; a told level is that much older than it says.
    pub clock_error: Duration,
    /// `budget`: bound e of the error of every sensed position, own or another's, m.
    pub position_error_m: f64,
    /// `budget`: bound of how far a robot is from where its velocities would have taken it, m. For a first-order lag,
    /// the time constant times the greatest speed.
    pub tracking_error_m: f64,
}

impl<const D: usize> Default for Settings<D> {
    fn default() -> Self {
        Self {
            robots: 11,
            faults: 2,
            radius_m: 3.0,
            distance_min_m: 0.3,
            epsilon: None,
            q2: 0.3,
            w_r: 15.0,
            w_c: 25.0,
            alpha: 0.1,
            share: Share::Neighbours,
            controller: Controller::Composed,
            gamma: None,
            rise: 0.0,
            gamma_c: 0.2,
            trust: Trust::ToldOrSeen,
            assume: Assume::Obedient,
            input: InputBox { min_m_s: [-1.5; D], max_m_s: [1.5; D] },
            level_period: Duration::from_millis(5),
            value_period: Duration::from_millis(100),
            hold_max: None,
            told_max: Duration::from_secs(1),
            clock_error: Duration::ZERO,
            position_error_m: 0.0,
            tracking_error_m: 0.0,
        }
    }
}

impl<const D: usize> Settings<D> {
    /// ε: the one given, or the default for this n.
    #[must_use]
    pub fn epsilon(&self) -> f64 {
        let limit = 1.0 / (f64::from(self.robots) - 1.0);
        self.epsilon.unwrap_or(if limit > 0.001 { limit - 0.001 } else { limit / 2.0 })
    }

    /// γ: the one given, or the share of a rate of 2/s for this tick.
    #[must_use]
    pub fn gamma(&self) -> f64 {
        self.gamma.unwrap_or_else(|| fraction_of_rate(2.0, self.level_period.as_secs_f64()))
    }

    /// How long a velocity may be held: the time given, or τ₁.
    #[must_use]
    pub fn hold_max(&self) -> Duration {
        self.hold_max.unwrap_or(self.level_period)
    }

    /// What errors of sensing and tracking cost; nothing under [`Controller::Composed`], whose theorem has no room for them.
    #[must_use]
    pub fn margin(&self) -> ErrorBounds {
        match self.controller {
            Controller::Composed => ErrorBounds::NONE,
            Controller::Budget => ErrorBounds::new(self.position_error_m, self.tracking_error_m),
        }
    }
}
