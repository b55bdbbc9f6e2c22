//! The closed enum of all controllers: one dispatch, then the code of one.

use crate::controller::budget::control::BudgetController;
use crate::controller::budget::knowledge::Sighting;
use crate::controller::composed::ComposedController;
use crate::controller::links::control::LinksController;
use crate::controller::links::peer::Ledger;
use crate::controller::none::Unfiltered;
use crate::controller::{AtOnce, Control, Decision, Kept, Standing, View};
use crate::equations::link::LinkShape;
use crate::id::Member;
use crate::need::Need;
use crate::num::Vector;
use crate::robot::neighbor::Slot;
use crate::robot::report::Mode;
use crate::robot::scratch::{Needs, Scratch};
use crate::settings::{Controller, Settings};
use crate::time::Instant;

/// A controller of any kind, with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyController<const D: usize> {
    /// The paper's controller.
    Composed(ComposedController<D>),
    /// Our controller.
    Budget(BudgetController<D>),
    /// Our controller that holds links.
    Links(LinksController<D>),
    /// No controller.
    None(Unfiltered<D>),
}

/// What can be done with every controller whose teams can be computed at once.
pub trait WithAtOnce<const D: usize> {
    /// What it comes to.
    type Output;

    /// Does it with this controller.
    fn with<C: AtOnce<D> + Copy + Send + Sync + 'static>(self, controller: C) -> Self::Output;
}

/// Calls the same method of whichever controller it is.
macro_rules! dispatch {
    ($of:expr, $controller:ident => $call:expr) => {
        match $of {
            AnyController::Composed($controller) => $call,
            AnyController::Budget($controller) => $call,
            AnyController::Links($controller) => $call,
            AnyController::None($controller) => $call,
        }
    };
}

impl<const D: usize> AnyController<D> {
    pub(crate) fn new(settings: &Settings<D>, link: LinkShape) -> Self {
        match &settings.controller {
            Controller::Composed(of) => Self::Composed(ComposedController::new(settings, of, link)),
            Controller::Budget(of) => Self::Budget(BudgetController::new(settings, of)),
            Controller::Links(of) => Self::Links(LinksController::new(settings, of, link)),
            Controller::None => Self::None(Unfiltered::new(settings)),
        }
    }

    /// The shape that it gives to links, where that of the settings is `link`. Only `budget` has one of its own.
    #[must_use]
    pub fn link(&self, link: LinkShape) -> LinkShape {
        match self {
            Self::Budget(controller) => {
                LinkShape { radius_m: link.radius_m, ..*controller.budget.curvature.link() }
            }
            Self::Composed(_) | Self::Links(_) | Self::None(_) => link,
        }
    }

    /// The controller, if many worlds can be computed side by side under it.
    #[must_use]
    pub fn in_lanes(&self) -> Option<ComposedController<D>> {
        match self {
            Self::Composed(controller) => controller.in_lanes(),
            Self::Budget(_) | Self::Links(_) | Self::None(_) => None,
        }
    }

    /// Who counts for whom ([`Control::need`]).
    #[must_use]
    pub fn need(&self) -> &Need {
        dispatch!(self, controller => controller.need())
    }

    /// How far sensed robots matter, m ([`Control::sight_m`]).
    #[must_use]
    pub fn sight_m(&self, link: &LinkShape) -> f64 {
        dispatch!(self, controller => controller.sight_m(link.radius_m))
    }

    /// True if it promises something ([`Control::promises`]).
    #[must_use]
    pub fn promises(&self) -> bool {
        dispatch!(self, controller => controller.promises())
    }

    /// What it keeps ([`Control::kept`]).
    #[must_use]
    pub fn kept(&self, link: &LinkShape, distance_min_m: f64) -> Kept {
        dispatch!(self, controller => controller.kept(link, distance_min_m))
    }

    /// How many neighbours a robot must be able to count on ([`Control::keep`]).
    #[must_use]
    pub fn keep(&self, own: Member) -> u16 {
        dispatch!(self, controller => controller.keep(own))
    }

    /// True if robots use what they were told in earlier ticks ([`Control::remembers`]).
    #[must_use]
    pub fn remembers(&self) -> bool {
        dispatch!(self, controller => controller.remembers())
    }

    /// The level of a robot with these sightings, if the controller keeps one ([`Control::certain_level`]).
    #[must_use]
    pub fn certain_level(&self, own: Member, sightings: &[Sighting<D>], scratch: &mut [f64]) -> Option<f64> {
        dispatch!(self, controller => controller.certain_level(own, sightings, scratch))
    }

    /// True if malicious robots are assumed to move as its rows allow ([`Control::is_obeyed`]).
    #[must_use]
    pub fn is_obeyed(&self) -> bool {
        dispatch!(self, controller => controller.is_obeyed())
    }

    /// How much scratch a robot needs ([`Control::needs`]).
    #[must_use]
    pub fn needs(&self, neighbors: usize) -> Needs {
        dispatch!(self, controller => controller.needs(neighbors))
    }

    /// True if a whole team can be computed at once ([`Control::can_be_computed_at_once`]).
    #[must_use]
    pub fn can_be_computed_at_once(&self) -> bool {
        dispatch!(self, controller => controller.can_be_computed_at_once())
    }

    /// Does `what` with the controller as the type that it is, unless a team of it cannot be computed at once.
    pub fn at_once<What: WithAtOnce<D>>(self, what: What) -> Option<What::Output> {
        match self {
            _ if !self.can_be_computed_at_once() => None,
            Self::Composed(controller) => Some(what.with(controller)),
            Self::Budget(controller) => Some(what.with(controller)),
            Self::Links(_) => None,
            Self::None(controller) => Some(what.with(controller)),
        }
    }

    /// The controller whose robots tell lists of links, if it is that.
    #[must_use]
    pub fn lists(self) -> Option<LinksController<D>> {
        match self {
            Self::Links(controller) => Some(controller),
            Self::Composed(_) | Self::Budget(_) | Self::None(_) => None,
        }
    }

    /// True if a robot tells its level ([`Control::tells_levels`]).
    #[must_use]
    pub fn tells_levels(&self) -> bool {
        dispatch!(self, controller => controller.tells_levels())
    }

    /// True if a robot tells lists of links ([`Control::tells_lists`]).
    #[must_use]
    pub fn tells_lists(&self) -> bool {
        dispatch!(self, controller => controller.tells_lists())
    }

    /// True if a neighbour that is not sensed keeps its slot ([`Control::keeps_unseen`]).
    #[must_use]
    pub fn keeps_unseen(&self, slot: &Slot<D>) -> bool {
        dispatch!(self, controller => controller.keeps_unseen(slot))
    }

    /// True if a neighbour that loses its slot should have been sensed ([`Control::misses`]).
    #[must_use]
    pub fn misses(&self, slot: &Slot<D>) -> bool {
        dispatch!(self, controller => controller.misses(slot))
    }

    /// True if missing neighbours keep their rows ([`Control::reckons`]).
    #[must_use]
    pub fn reckons(&self) -> bool {
        dispatch!(self, controller => controller.reckons())
    }

    /// Decides on the lists that are told in this tick ([`Control::agree`]).
    pub fn agree(
        &self,
        own: Member,
        ledger: &mut Ledger<D>,
        slots: &mut [Slot<D>],
        now: Instant,
        scratch: &mut Scratch<'_, D>,
    ) {
        dispatch!(self, controller => controller.agree(own, ledger, slots, now, scratch));
    }

    /// Its connectivity ([`Control::level`]).
    #[must_use]
    pub fn level(&self, view: &View<'_, D>, scratch: &mut Scratch<'_, D>) -> f64 {
        dispatch!(self, controller => controller.level(view, scratch))
    }

    /// What a robot on its own does ([`Control::alone`]).
    #[must_use]
    pub fn alone(
        &self,
        view: &View<'_, D>,
        desired: &Vector<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decision<D> {
        dispatch!(self, controller => controller.alone(view, desired, scratch))
    }

    /// What an answer is worth ([`Control::mode`]).
    #[must_use]
    pub fn mode(&self, standing: &Standing) -> Mode {
        dispatch!(self, controller => controller.mode(standing))
    }
}
