//! The numbers of the settings, of whichever controller, for whoever reads or sets them one by one.

use core::time::Duration;

use crate::controller::budget::weight::{Conditions, Weight};
use crate::controller::errors::ErrorBounds;
use crate::need::Ranks;
use crate::settings::{
    BudgetSettings, Clock, ComposedSettings, Controller, Errors, LinkSettings, LinksSettings, Settings, Team,
    need_of,
};

/// The settings of a team without those of a dimension. Parameters of a controller are there if it may be run.
#[derive(Debug)]
pub struct Parts<'a> {
    /// Who is in the team.
    pub team: &'a mut Team,
    /// Its ranks, if it has any.
    pub ranks: Option<Ranks>,
    /// What a link is.
    pub link: &'a mut LinkSettings,
    /// Δ_d, m.
    pub distance_min_m: &'a mut f64,
    /// How near a robot may come to an obstacle, m.
    pub clearance_m: &'a mut f64,
    /// The greatest speed, m/s; infinite for the box alone.
    pub speed_max_m_s: &'a mut f64,
    /// Parameters of `composed`.
    pub composed: Option<&'a mut ComposedSettings>,
    /// Parameters of `budget`.
    pub budget: Option<&'a mut BudgetSettings>,
    /// Parameters of `links`.
    pub links: Option<&'a mut LinksSettings>,
    /// Periods and ages.
    pub clock: &'a mut Clock,
    /// Stated bounds of errors.
    pub errors: &'a mut Errors,
    /// Δ_d must be below this, m. It depends on the input box.
    pub distance_limit_m: f64,
    /// ρ, the longest move of a robot in a tick, m. It depends on the input box too.
    pub move_max_m: f64,
}

impl<const D: usize> Settings<D> {
    /// All numbers but those of the input box. Δ_d may be up to `distance_limit_m`, m.
    #[must_use]
    pub fn parts(&mut self, distance_limit_m: f64) -> Parts<'_> {
        let move_max_m = self.reach().longest_m();
        let (composed, budget, links) = match &mut self.controller {
            Controller::Composed(composed) => (Some(composed), None, None),
            Controller::Budget(budget) => (None, Some(budget), None),
            Controller::Links(links) => (None, None, Some(links)),
            Controller::None => (None, None, None),
        };
        Parts {
            team: &mut self.team,
            ranks: self.ranks,
            link: &mut self.link,
            distance_min_m: &mut self.limits.distance_min_m,
            clearance_m: &mut self.limits.clearance_m,
            speed_max_m_s: &mut self.limits.input.speed_max_m_s,
            composed,
            budget,
            links,
            clock: &mut self.clock,
            errors: &mut self.errors,
            distance_limit_m,
            move_max_m,
        }
    }
}

/// What the weight of `budget` is chosen for; `None` without that controller.
pub(super) fn conditions(of: &Parts<'_>) -> Option<Conditions> {
    let keep = of.budget.as_ref()?.assume.keep();
    let need = need_of(*of.team, of.ranks, keep);
    Some(Conditions {
        radius_m: of.link.radius_m,
        need: need.most(),
        period_s: of.clock.level_period.as_secs_f64(),
        move_max_m: of.move_max_m,
        offset_error_m: ErrorBounds::new(of.errors.position_m, of.errors.tracking_m).offset_m,
    })
}

/// The weight of `budget` and its rates, set or chosen; `None` without that controller.
pub(super) fn weight(of: &Parts<'_>) -> Option<Weight> {
    Some(of.budget.as_ref()?.weight(&conditions(of)?))
}

/// Changes parameters of `composed`, if they are there.
pub(super) fn composed(of: &mut Parts<'_>, set: impl FnOnce(&mut ComposedSettings)) {
    if let Some(composed) = of.composed.as_deref_mut() {
        set(composed);
    }
}

/// Changes parameters of `budget`, if they are there.
pub(super) fn budget(of: &mut Parts<'_>, set: impl FnOnce(&mut BudgetSettings)) {
    if let Some(budget) = of.budget.as_deref_mut() {
        set(budget);
    }
}

/// Changes parameters of `links`, if they are there.
pub(super) fn links(of: &mut Parts<'_>, set: impl FnOnce(&mut LinksSettings)) {
    if let Some(links) = of.links.as_deref_mut() {
        set(links);
    }
}

pub(super) fn whole(number: f64) -> u16 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    let whole = number as u16;
    whole
}

/// The time, rounded to nanoseconds.
pub(super) fn time(seconds: f64) -> Duration {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
    let nanos = libm::round(seconds * 1e9) as u64;
    Duration::from_nanos(nanos)
}
