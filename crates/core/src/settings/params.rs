//! Checked settings: what a robot is told once, constant from then on.

use crate::controller::budget::settings::Budget;
use crate::controller::links::Links;
use crate::controller::{AnyController, Kept};
use crate::equations::composition::Composed;
use crate::equations::link::LinkShape;
use crate::need::{Keep, Listen, Need};
use crate::num::{Vector, is_finite};
use crate::program::balls::reach::Reach;
use crate::settings::Team;
use crate::settings::field::{Field, TABLE};
pub use crate::settings::range::{Allowed, MAGNITUDE_MAX, ROBOTS_MAX};
pub use crate::settings::{Controller, Settings};

/// Settings that were checked, and what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Params<const D: usize> {
    settings: Settings<D>,
    link: LinkShape,
    need: Need,
    controller: AnyController<D>,
    reach: Reach<D>,
    sight_m2: f64,
    hold_s: f64,
}

/// A setting outside what is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParamsError {
    /// Which number it is about.
    pub field: Field,
    /// What the number is (in s for periods).
    pub value: f64,
    /// What it may be.
    pub allowed: Allowed,
}

impl<const D: usize> Params<D> {
    /// Checks every setting; the first that is outside its range is the error.
    pub fn new(settings: Settings<D>) -> Result<Self, ParamsError> {
        settings.check_input()?;
        settings.check()?;
        settings.check_ranks()?;
        let paper_link = settings.paper_link();
        let controller = AnyController::new(&settings, paper_link);
        let link = controller.link(paper_link);
        let sight_m = controller.sight_m(&link);
        Ok(Self {
            link,
            need: *controller.need(),
            controller,
            reach: settings.reach(),
            sight_m2: sight_m * sight_m,
            hold_s: settings.clock.hold_max().as_secs_f64(),
            settings,
        })
    }

    /// The settings as they were given.
    #[must_use]
    pub fn settings(&self) -> &Settings<D> {
        &self.settings
    }

    /// Shape of the links, of the weight that the controller gives to them: that of the settings, or one of its own.
    #[must_use]
    pub fn link(&self) -> &LinkShape {
        &self.link
    }

    /// True if the controller gives links a weight of its own.
    #[must_use]
    pub fn weighs_its_own_way(&self) -> bool {
        self.link != self.paper_link()
    }

    /// True if robots tell each other levels of the paper's weight, from which φ_i follows.
    #[must_use]
    pub fn tells_paper_levels(&self) -> bool {
        self.controller.tells_levels() && !self.weighs_its_own_way()
    }

    /// Shape of the links of the settings, which is the paper's, whatever the controller. φ is about it.
    #[must_use]
    pub fn paper_link(&self) -> LinkShape {
        self.settings.paper_link()
    }

    /// Who counts for whom, and how many of them each robot must keep.
    #[must_use]
    pub fn need(&self) -> &Need {
        &self.need
    }

    /// True if robots take the values of all neighbours in a consensus round.
    #[must_use]
    pub fn listens_to_all(&self) -> bool {
        self.settings.ranks.is_none_or(|ranks| ranks.listen == Listen::All)
    }

    /// The controller with its parameters.
    #[must_use]
    pub fn controller(&self) -> &AnyController<D> {
        &self.controller
    }

    /// The paper's controller, if the robot runs it.
    #[must_use]
    pub fn composed(&self) -> Option<&Composed> {
        match &self.controller {
            AnyController::Composed(composed) => Some(&composed.composed),
            _ => None,
        }
    }

    /// Our controller that holds links, if the robot runs it.
    #[must_use]
    pub fn links(&self) -> Option<&Links> {
        match &self.controller {
            AnyController::Links(links) => Some(&links.links),
            _ => None,
        }
    }

    /// Our controller, if the robot runs it.
    #[must_use]
    pub fn budget(&self) -> Option<&Budget> {
        match &self.controller {
            AnyController::Budget(budget) => Some(&budget.budget),
            _ => None,
        }
    }

    /// What the controller keeps. With stated errors this is about references and not about positions.
    #[must_use]
    pub fn kept(&self) -> Kept {
        self.controller.kept(&self.link, self.settings.limits.distance_min_m)
    }

    /// The displacements of one tick, `T U_i`.
    #[must_use]
    pub fn reach(&self) -> &Reach<D> {
        &self.reach
    }

    /// Square of the distance up to which sensed robots matter, m²: R, and what stated errors add to it.
    #[must_use]
    pub fn sight_m2(&self) -> f64 {
        self.sight_m2
    }

    /// How long a velocity may be held, s.
    #[must_use]
    pub fn hold_s(&self) -> f64 {
        self.hold_s
    }

    /// How far `desired` (m/s) goes while a velocity is held, m.
    #[must_use]
    pub fn desired_m(&self, desired: &Vector<D>) -> Vector<D> {
        desired.map(|component| component * self.hold_s)
    }
}

impl<const D: usize> Settings<D> {
    fn check(mut self) -> Result<(), ParamsError> {
        let limit_m = self.distance_limit();
        let parts = self.parts(limit_m);
        for row in &TABLE {
            let Some(value) = (row.get)(&parts) else { continue };
            let allowed = row.allowed(&parts);
            if !allowed.holds(value) {
                return Err(ParamsError { field: row.field, value, allowed });
            }
        }
        Ok(())
    }

    /// What Δ_d must be below: R, and with `budget` and `links` R − 2ρ − 4A, because robots that are not linked have no row for their
    /// distance.
    fn distance_limit(&self) -> f64 {
        match self.controller {
            Controller::Composed(_) | Controller::None => self.link.radius_m,
            Controller::Budget(_) | Controller::Links(_) => {
                self.link.radius_m - 2.0 * self.reach().longest_m() - 4.0 * self.error_bounds().away_m
            }
        }
    }

    /// The displacements `T U_i`, with T the longest that a velocity is held.
    pub(crate) fn reach(&self) -> Reach<D> {
        Reach::new(&self.limits.input, self.clock.hold_max().as_secs_f64())
    }

    /// Who counts for whom in the team, and how many of them a robot must `keep`.
    #[must_use]
    pub fn need(&self, keep: Keep) -> Need {
        Need::of(self.team, self.ranks, keep)
    }

    /// The need F′ of controllers that count all neighbours.
    pub(crate) fn need_of_neighbors(&self) -> Need {
        Need::new(self.team.robots, self.team.faults, Keep::Neighbors)
    }

    /// m is at least 2F + 1; n where the controller knows of no ranks.
    fn check_ranks(&self) -> Result<(), ParamsError> {
        let Some(ranks) = self.ranks else { return Ok(()) };
        let (core, Team { robots, faults }) = (f64::from(ranks.core), self.team);
        let ranked = matches!(self.controller, Controller::Links(_) | Controller::Budget(_));
        let least = if ranked { f64::from(faults) * 2.0 + 1.0 } else { f64::from(robots) };
        let allowed = Allowed::Closed(least, f64::from(robots));
        if allowed.holds(core) {
            Ok(())
        } else {
            Err(ParamsError { field: Field::Core, value: core, allowed })
        }
    }

    fn check_input(&self) -> Result<(), ParamsError> {
        let low = Allowed::Closed(-MAGNITUDE_MAX, 0.0);
        let high = Allowed::Closed(0.0, MAGNITUDE_MAX);
        let input = &self.limits.input;
        for (field, corner, allowed) in
            [(Field::InputMinMS, input.min_m_s, low), (Field::InputMaxMS, input.max_m_s, high)]
        {
            if let Some(&value) = corner.iter().find(|&&value| !allowed.holds(value)) {
                return Err(ParamsError { field, value, allowed });
            }
        }
        debug_assert!(is_finite(&input.min_m_s) && is_finite(&input.max_m_s));
        Ok(())
    }
}

impl core::fmt::Display for ParamsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{} is {}, allowed is {}", self.field.name(), self.value, self.allowed)?;
        let why = self.field.why();
        if why.is_empty() { Ok(()) } else { write!(f, " ({why})") }
    }
}

impl core::error::Error for ParamsError {}

#[cfg(test)]
mod tests {
    extern crate std;

    use core::time::Duration;

    use super::*;
    use crate::controller::assume::Assume;
    use crate::need::Ranks;
    use crate::robot::neighbor::RobotId;
    use crate::settings::range::ROBOTS_MAX;
    use crate::settings::{BudgetSettings, ComposedSettings, LinksSettings};

    type Change = fn(&mut Settings<2>);

    fn composed(settings: &mut Settings<2>, change: impl FnOnce(&mut ComposedSettings)) {
        if let Controller::Composed(composed) = &mut settings.controller {
            change(composed);
        }
    }

    fn budget(settings: &mut Settings<2>, change: impl FnOnce(&mut BudgetSettings)) {
        let mut parameters = BudgetSettings::default();
        change(&mut parameters);
        settings.controller = Controller::Budget(parameters);
    }

    #[test]
    fn the_defaults_are_the_papers() {
        let params = Params::<2>::new(Settings::default()).unwrap();
        assert_eq!(params.need().need(RobotId(1)), 7);
        assert!((params.link().q1 - 2.099).abs() < 1e-12);
        Params::<3>::new(Settings::default()).unwrap();
    }

    #[test]
    fn each_setting_is_refused_outside_its_range() {
        let wrong: [(Field, Change); 24] = [
            (Field::Robots, |s| s.team.robots = 1),
            (Field::Robots, |s| s.team.robots = ROBOTS_MAX + 1),
            (Field::Faults, |s| s.team.faults = 6),
            (Field::RadiusM, |s| s.link.radius_m = f64::NAN),
            (Field::DistanceMinM, |s| s.limits.distance_min_m = 3.0),
            (Field::Epsilon, |s| s.link.epsilon = Some(0.1)),
            (Field::Epsilon, |s| s.link.epsilon = Some(0.0)),
            (Field::Q2, |s| s.link.q2 = 0.0),
            (Field::WR, |s| composed(s, |composed| composed.w_r = -1.0)),
            (Field::WC, |s| composed(s, |composed| composed.w_c = f64::INFINITY)),
            (Field::Alpha, |s| composed(s, |composed| composed.alpha = 2e6)),
            (Field::Gamma, |s| budget(s, |budget| budget.gamma = Some(0.0))),
            (Field::GammaC, |s| budget(s, |budget| budget.gamma_c = Some(1.1))),
            (Field::OwnQ2, |s| budget(s, |budget| budget.q2 = Some(0.0))),
            (Field::OwnEpsilon, |s| budget(s, |budget| budget.epsilon = Some(0.0))),
            (Field::OwnEpsilon, |s| budget(s, |budget| budget.epsilon = Some(2.0 / 6.0))),
            (Field::OwnEpsilon, |s| {
                budget(s, |budget| (budget.epsilon, budget.assume) = (Some(2.0 / 5.0), Assume::Free));
            }),
            (Field::DistanceMinM, |s| {
                budget(s, |_| ());
                s.limits.distance_min_m = 2.98;
            }),
            (Field::InputMinMS, |s| s.limits.input.min_m_s[1] = 0.1),
            (Field::InputMaxMS, |s| s.limits.input.max_m_s[0] = f64::NAN),
            (Field::LevelPeriod, |s| s.clock.level_period = Duration::ZERO),
            (Field::Core, |s| {
                s.controller = Controller::Links(LinksSettings::default());
                s.ranks = Some(Ranks { core: 4, listen: Listen::All });
            }),
            (Field::Core, |s| {
                s.controller = Controller::Links(LinksSettings::default());
                s.ranks = Some(Ranks { core: 12, listen: Listen::All });
            }),
            (Field::Core, |s| s.ranks = Some(Ranks { core: 7, listen: Listen::All })),
        ];
        for (field, change) in wrong {
            let mut settings = Settings::default();
            change(&mut settings);
            assert_eq!(Params::new(settings).unwrap_err().field, field);
        }
    }

    #[test]
    fn an_error_names_the_field_of_a_file_and_what_is_allowed() {
        let mut settings = Settings::<2>::default();
        settings.team.faults = 6;
        let error = Params::new(settings).unwrap_err();
        assert_eq!(std::format!("{error}"), "team.faults is 6, allowed is 0 to 5 (2F + 1 <= n)");
    }

    #[test]
    fn the_largest_team_has_an_epsilon() {
        let mut settings = Settings::<2>::default();
        settings.team.robots = ROBOTS_MAX;
        Params::new(settings).unwrap();
    }
}
