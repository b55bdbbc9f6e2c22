//! What a robot is told once, unchecked. `Default` holds the paper's values and, where the paper prints none, ours
//! (docs/theory, `sec:choices`).
//!
//! Every single number has one row in [`field`]: its name in files, what it is, and what it may be.

mod check;
pub mod clock;
pub mod controller;
pub mod field;
pub mod params;
mod parts;
pub mod range;

pub use clock::Clock;
pub use controller::{BudgetSettings, ComposedSettings, Controller, LinksSettings};

use crate::consensus::Rule;
use crate::controller::budget::weight::Conditions;
use crate::controller::errors::ErrorBounds;
use crate::equations::link::LinkShape;
use crate::need::{Keep, Need, Ranks};
use crate::program::InputBox;
use crate::program::balls::reach::Reach;

/// Who is in the team.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Team {
    /// n, the number of robots, 2 to [`ROBOTS_MAX`](range::ROBOTS_MAX).
    pub robots: u16,
    /// F, how many of them may be malicious, with 2F + 1 ≤ n.
    pub faults: u16,
}

/// What a link is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkSettings {
    /// R, how far a link reaches, m.
    pub radius_m: f64,
    /// ε of q₁ = 2 + ε, with 0 < ε < 1/(n−1); `None` stands for [`epsilon_of`].
    pub epsilon: Option<f64>,
    /// q₂, the steepness of the weight, 1/m⁴.
    pub q2: f64,
}

/// What no controller may exceed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits<const D: usize> {
    /// Δ_d, how near two robots may come, m, less than R.
    pub distance_min_m: f64,
    /// U_i, the velocities that a robot may be given.
    pub input: InputBox<D>,
    /// How near a robot may come to an obstacle, m, at least 0.
    pub clearance_m: f64,
}

/// Stated bounds of errors. `composed` does not use them, because its theorem has no room for errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Bound e of the error of every sensed position, own or another's, m.
    pub position_m: f64,
    /// Bound of how far a robot is from where its velocities would have taken it, m. For a first-order lag, the time
    /// constant times the greatest speed.
    pub tracking_m: f64,
}

/// Everything the paper leaves as a parameter, unchecked.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings<const D: usize> {
    /// Who is in the team.
    pub team: Team,
    /// What a link is.
    pub link: LinkSettings,
    /// What no controller may exceed.
    pub limits: Limits<D>,
    /// Which controller the robot runs, with the parameters of that one.
    pub controller: Controller,
    /// When things happen, and how old they may be.
    pub clock: Clock,
    /// Stated bounds of errors.
    pub errors: Errors,
    /// Ranks of the team, if it has any.
    pub ranks: Option<Ranks>,
    /// How values are updated.
    pub consensus: Rule,
}

impl Default for Team {
    fn default() -> Self {
        Self { robots: 11, faults: 2 }
    }
}

impl Default for LinkSettings {
    fn default() -> Self {
        Self { radius_m: 3.0, epsilon: None, q2: 0.3 }
    }
}

impl<const D: usize> Default for Limits<D> {
    fn default() -> Self {
        Self { distance_min_m: 0.3, input: InputBox::of([-1.5; D], [1.5; D]), clearance_m: 0.15 }
    }
}

/// ε for a team of `robots`: 1/(n−1) − 0.001, or half of 1/(n−1) where that is not positive.
#[must_use]
pub fn epsilon_of(robots: u16) -> f64 {
    let limit = 1.0 / (f64::from(robots) - 1.0);
    if limit > 0.001 { limit - 0.001 } else { limit / 2.0 }
}

impl<const D: usize> Settings<D> {
    /// ε: the given one, or the default for this n.
    #[must_use]
    pub fn epsilon(&self) -> f64 {
        self.link.epsilon.unwrap_or(epsilon_of(self.team.robots))
    }

    /// Shape of the links of these settings, as the paper has it.
    #[must_use]
    pub fn paper_link(&self) -> LinkShape {
        LinkShape { radius_m: self.link.radius_m, q1: 2.0 + self.epsilon(), q2: self.link.q2 }
    }

    /// What `budget` chooses its own weight for.
    #[must_use]
    pub fn conditions(&self, parameters: &BudgetSettings) -> Conditions {
        let need = self.need(parameters.assume.keep());
        Conditions {
            radius_m: self.link.radius_m,
            need: need.most(),
            period_s: self.clock.level_period.as_secs_f64(),
            move_max_m: self.reach().longest_m(),
            offset_error_m: self.error_bounds().offset_m,
        }
    }

    /// What errors of sensing and tracking cost; nothing where the controller has no room for them.
    #[must_use]
    pub fn error_bounds(&self) -> ErrorBounds {
        if self.controller.traits().leaves_room {
            ErrorBounds::new(self.errors.position_m, self.errors.tracking_m)
        } else {
            ErrorBounds::NONE
        }
    }

    /// The displacements `T U_i`, with T the longest that a velocity is held.
    pub(crate) fn reach(&self) -> Reach<D> {
        Reach::new(&self.limits.input, self.clock.hold_max().as_secs_f64())
    }

    /// Who counts for whom in the team, and how many of them a robot must `keep`.
    #[must_use]
    pub fn need(&self, keep: Keep) -> Need {
        need_of(self.team, self.ranks, keep)
    }

    /// The need F′ of controllers that count all neighbours.
    pub(crate) fn need_of_neighbors(&self) -> Need {
        Need::new(self.team.robots, self.team.faults, Keep::Neighbors)
    }
}

/// The rule of a team with `ranks`, if it has any, in which a robot must `keep` enough of those.
fn need_of(Team { robots, faults }: Team, ranks: Option<Ranks>, keep: Keep) -> Need {
    match ranks {
        None => Need::new(robots, faults, keep),
        Some(ranks) => Need::ranked(robots, ranks.core, faults, keep),
    }
}
