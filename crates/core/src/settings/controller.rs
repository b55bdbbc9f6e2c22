//! Which controller a robot runs, each with its own parameters.

use core::time::Duration;

use crate::controller::assume::Assume;
use crate::controller::budget::settings::fraction_of_rate;
use crate::controller::budget::weight::{Conditions, Weight};
use crate::equations::composition::PhiSplit;

/// Which controller a robot runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Controller {
    /// The paper's, as printed ([`crate::controller::composed`]).
    Composed(ComposedSettings),
    /// Ours ([`crate::controller::budget`]): a guarantee in discrete time, from what is sensed alone.
    Budget(BudgetSettings),
    /// Ours without weights ([`crate::controller::links`]): robots agree on the links that they keep.
    Links(LinksSettings),
    /// No program: the desired velocity, cut to the box. For whoever wants the consensus alone, or filters elsewhere.
    None,
}

/// Parameters of `composed`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComposedSettings {
    /// How φ is split into φ_i.
    pub phi_split: PhiSplit,
    /// w_r, the weight of degrees.
    pub w_r: f64,
    /// w_c, the weight of collisions, 1/m².
    pub w_c: f64,
    /// α(s) = alpha·s, 1/s.
    pub alpha: f64,
}

/// Parameters of `budget`. All robots of a team must have the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BudgetSettings {
    /// q₂ of its own weight, 1/m⁴. `None`, here and below, stands for what is chosen for the task
    /// ([`weight`](crate::controller::budget::weight)).
    pub q2: Option<f64>,
    /// ε of its own weight, with 0 < ε < 2/(need − 1).
    pub epsilon: Option<f64>,
    /// γ: the fraction of h_k that may be lost in a tick, in (0, 1].
    pub gamma: Option<f64>,
    /// γ_c: the fraction of D − Δ_d² that may be lost in a tick, in (0, 1].
    pub gamma_c: Option<f64>,
    /// What malicious robots are assumed to do.
    pub assume: Assume,
}

/// What the settings themselves must know of a kind of controller, before one is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Traits {
    /// Its rows leave room for stated errors.
    pub(super) leaves_room: bool,
    /// Robots that are not linked have no row for their distance, so that Δ_d must be well below R.
    pub(super) ignores_unlinked: bool,
    /// Ranks may tell who counts for whom.
    pub(super) knows_ranks: bool,
}

impl Controller {
    pub(super) fn traits(&self) -> Traits {
        match self {
            Self::Budget(_) | Self::Links(_) => {
                Traits { leaves_room: true, ignores_unlinked: true, knows_ranks: true }
            }
            Self::Composed(_) | Self::None => {
                Traits { leaves_room: false, ignores_unlinked: false, knows_ranks: false }
            }
        }
    }
}

impl BudgetSettings {
    /// What is set, and for the rest what is chosen for these conditions.
    #[must_use]
    pub fn weight(&self, of: &Conditions) -> Weight {
        let chosen = of.chosen();
        Weight {
            q2: self.q2.unwrap_or(chosen.q2),
            epsilon: self.epsilon.unwrap_or(chosen.epsilon),
            gamma: self.gamma.unwrap_or(chosen.gamma),
            gamma_c: self.gamma_c.unwrap_or(chosen.gamma_c),
        }
    }
}

/// Parameters of `links`. All robots of a team must have the same; only the last two may differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinksSettings {
    /// γ: the fraction of R² − D that may be lost in a tick, in (0, 1]. `None` stands for a rate of 8/s.
    pub gamma: Option<f64>,
    /// γ_c: the fraction of D − Δ_d² that may be lost in a tick, in (0, 1]. `None` stands for a rate of 45/s.
    pub gamma_c: Option<f64>,
    /// What malicious robots are assumed to do.
    pub assume: Assume,
    /// H, s: robots release each other by where they would be after so long.
    pub horizon_s: f64,
    /// Whether robots that meet pass each other on the right.
    pub pass_right: bool,
}

impl Default for Controller {
    fn default() -> Self {
        Self::Composed(ComposedSettings::default())
    }
}

impl Default for ComposedSettings {
    fn default() -> Self {
        Self { phi_split: PhiSplit::Neighbors, w_r: 15.0, w_c: 25.0, alpha: 0.1 }
    }
}

impl Default for BudgetSettings {
    fn default() -> Self {
        Self { q2: None, epsilon: None, gamma: None, gamma_c: None, assume: Assume::Obedient }
    }
}

impl Default for LinksSettings {
    fn default() -> Self {
        Self { gamma: None, gamma_c: None, assume: Assume::Obedient, horizon_s: 4.0, pass_right: false }
    }
}

impl LinksSettings {
    /// γ: the given one, or that of a rate of 8/s in a tick of `period`.
    #[must_use]
    pub fn gamma(&self, period: Duration) -> f64 {
        self.gamma.unwrap_or_else(|| fraction_of_rate(8.0, period.as_secs_f64()))
    }

    /// γ_c: the given one, or that of a rate of 45/s in a tick of `period`.
    #[must_use]
    pub fn gamma_c(&self, period: Duration) -> f64 {
        self.gamma_c.unwrap_or_else(|| fraction_of_rate(45.0, period.as_secs_f64()))
    }
}
