//! Checked settings: what a robot is told once, constant from then on.

use crate::controller::{AnyController, Kept};
use crate::equations::link::LinkShape;
use crate::need::{Listen, Need};
use crate::num::Vector;
use crate::program::balls::reach::Reach;
pub use crate::settings::check::ParamsError;
pub use crate::settings::range::{Allowed, MAGNITUDE_MAX, ROBOTS_MAX};
pub use crate::settings::{Controller, Settings};

/// Settings that were checked, and what follows from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Params<const D: usize> {
    settings: Settings<D>,
    link: LinkShape,
    need: Need,
    controller: AnyController<D>,
    kept: Kept,
    reach: Reach<D>,
    sight_m2: f64,
    hold_s: f64,
}

impl<const D: usize> Params<D> {
    /// Checks every setting; the first that is outside its range is the error.
    pub fn new(settings: Settings<D>) -> Result<Self, ParamsError> {
        settings.check()?;
        let paper_link = settings.paper_link();
        let controller = AnyController::new(&settings, paper_link);
        let link = controller.link(paper_link);
        let sight_m = controller.sight_m(&link);
        Ok(Self {
            link,
            need: *controller.need(),
            kept: controller.kept(&link, settings.limits.distance_min_m),
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

    /// What the controller keeps. With stated errors this is about references and not about positions.
    #[must_use]
    pub fn kept(&self) -> &Kept {
        &self.kept
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::neighbor::RobotId;

    #[test]
    fn the_defaults_are_the_papers() {
        let params = Params::<2>::new(Settings::default()).unwrap();
        assert_eq!(params.need().need(RobotId(1)), 7);
        assert!((params.link().q1 - 2.099).abs() < 1e-12);
        Params::<3>::new(Settings::default()).unwrap();
    }

    #[test]
    fn the_largest_team_has_an_epsilon() {
        let mut settings = Settings::<2>::default();
        settings.team.robots = ROBOTS_MAX;
        Params::new(settings).unwrap();
    }
}
