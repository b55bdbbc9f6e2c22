//! The controllers: what stands between the desired and the safe velocity. One file each, behind one closed enum.
//!
//! [`Control`] is the seam: what a robot on its own asks. A controller implements what it has; only `need`, `alone` and `mode`
//! have no default. One whose teams can be computed at once implements [`AtOnce`] too. [`Control::alone`] then looks at what the
//! robot senses and hears and ends in [`AtOnce::decide`]. Whoever computes a team makes [`AtOnce::Pair`] once for both ends of a
//! link, adds up [`AtOnce::Sums`], and calls the same `decide`: so both give the same bits.
//!
//! | controller | file | needs | promises |
//! | --- | --- | --- | --- |
//! | the paper's | [`composed`] | told levels | nothing in discrete time |
//! | ours | [`budget`] | positions | docs/budget.md |
//! | ours, without weights | [`links`] | positions, lists and acknowledgements | docs/links.md |
//! | none | [`none`] | nothing | nothing |
//!
//! What several of them use stands beside them: [`assume`], [`clearance`], [`errors`], [`kept`] and [`rows`].

pub mod any;
pub mod assume;
pub mod at_once;
pub mod budget;
pub mod clearance;
pub mod composed;
pub mod errors;
pub mod kept;
pub mod links;
pub mod none;
pub mod rows;

pub use any::{AnyController, WithAtOnce};
pub use at_once::{AtOnce, Batch, Glimpse, Motion, Neighbor, Own};
pub use kept::Kept;

use crate::controller::budget::knowledge::Sighting;
use crate::controller::links::peer::Ledger;
use crate::equations::link::LinkShape;
use crate::id::Member;
use crate::need::Need;
use crate::num::Vector;
use crate::program::Outcome;
use crate::robot::neighbor::{RobotId, Slot};
use crate::robot::report::{Mode, Reason};
use crate::robot::scratch::{Needs, Scratch};
use crate::time::Instant;

/// What a robot on its own senses and hears in a tick.
#[derive(Clone, Copy, Debug)]
pub struct View<'a, const D: usize> {
    /// Its number.
    pub id: RobotId,
    /// Its rank.
    pub rank: u16,
    /// The present time on its clock.
    pub now: Instant,
    /// Its level as it tells it, if it does.
    pub told_level: f64,
    /// Where it counts itself, m.
    pub position_m: Vector<D>,
    /// The velocity of the tick before, m/s.
    pub before_m_s: Vector<D>,
    /// What it holds of its own messages, under `links`.
    pub ledger: &'a Ledger<D>,
    /// Its neighbours in order of their numbers; some may not be sensed in this tick.
    pub slots: &'a [Slot<D>],
    /// Robots of other teams that it keeps its distance to, and nothing else; some may not be sensed in this tick.
    pub strangers: &'a [Slot<D>],
}

impl<'a, const D: usize> View<'a, D> {
    /// The robot itself, as the roster has it.
    #[must_use]
    pub fn member(&self) -> Member {
        Member { id: self.id, rank: self.rank }
    }

    /// The neighbours sensed in this tick.
    pub fn sensed(&self) -> impl Iterator<Item = &'a Slot<D>> + Clone + use<'a, D> {
        self.slots.iter().filter(|slot| slot.sensed)
    }

    /// The neighbours sensed in this tick, and those that are missing ([`missing`](crate::robot::missing)).
    pub fn in_view(&self) -> impl Iterator<Item = &'a Slot<D>> + Clone + use<'a, D> {
        self.slots.iter().filter(|slot| slot.sensed || slot.is_missing())
    }

    /// True if nobody is missing.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        !self.slots.iter().any(Slot::is_missing)
    }

    /// The sensed neighbours within R. Without stated errors these are all sensed neighbours.
    pub fn linked(&self) -> impl Iterator<Item = &'a Slot<D>> + Clone + use<'a, D> {
        self.sensed().filter(|slot| slot.linked)
    }
}

/// What a controller decided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision<const D: usize> {
    /// u_i, m/s, finite and inside U_i.
    pub velocity_m_s: Vector<D>,
    /// How the program found it.
    pub outcome: Outcome,
    /// φ_i (eq:phi_i), if the controller uses it.
    pub phi: Option<f64>,
    /// Why the state of the robot may not be safe in this tick, if there is a reason.
    pub doubt: Option<Reason>,
}

/// What decides how much an answer is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// How many neighbours may count: those in sight.
    pub degree: u16,
    /// How many of them the robot must keep.
    pub need: u16,
    /// h_i.
    pub h: f64,
    /// φ_i, if the controller uses it.
    pub phi: Option<f64>,
    /// What the program found.
    pub outcome: Outcome,
    /// Neighbours that have told no level yet.
    pub untold: u16,
    /// Neighbours that were not sensed in this tick and are reckoned with all the same.
    pub missing: u16,
    /// What else speaks against the answer, if anything does.
    pub reason: Option<Reason>,
}

/// A controller of one robot.
pub trait Control<const D: usize> {
    /// Who counts for whom, and how many of them a robot must keep.
    fn need(&self) -> &Need;

    /// Up to which distance sensed robots matter, m, where links reach as far as `radius_m`.
    fn sight_m(&self, radius_m: f64) -> f64 {
        radius_m
    }

    /// True if the controller promises something that rests on what the robot can watch: its moves, its clock.
    fn promises(&self) -> bool {
        false
    }

    /// What it keeps where links are `link` and no two robots may come nearer than `distance_min_m`.
    fn kept(&self, link: &LinkShape, distance_min_m: f64) -> Kept {
        Kept::plain(link, distance_min_m)
    }

    /// How many neighbours that count a robot must be able to count on, so that it keeps as many as it needs.
    fn keep(&self, own: Member) -> u16 {
        self.need().need(own)
    }

    /// True if robots go on using what they were told in earlier ticks.
    fn remembers(&self) -> bool {
        true
    }

    /// The level of robot `own` with these `sightings`, certain with the stated errors, if the controller keeps one. `scratch` has
    /// one number a sighting.
    fn certain_level(&self, _own: Member, _sightings: &[Sighting<D>], _scratch: &mut [f64]) -> Option<f64> {
        None
    }

    /// True if malicious robots are assumed to move as its rows allow (Assumption 1 of the paper).
    fn is_obeyed(&self) -> bool {
        true
    }

    /// How much scratch a robot needs for up to so many neighbours: at least a number for the value of each.
    fn needs(&self, neighbors: usize) -> Needs {
        Needs { values: neighbors, sightings: 0, rows: 0 }
    }

    /// True if the controller implements [`AtOnce`] and decisions rest on levels and links alone where nothing goes wrong.
    fn can_be_computed_at_once(&self) -> bool {
        false
    }

    /// True if a robot tells its level c_i.
    fn tells_levels(&self) -> bool {
        false
    }

    /// True if a robot tells lists of links.
    fn tells_lists(&self) -> bool {
        false
    }

    /// True if a neighbour that is not sensed keeps its slot, because others may rest on it.
    fn keeps_unseen(&self, _slot: &Slot<D>) -> bool {
        false
    }

    /// True if a neighbour that loses its slot should have been sensed, because others may rest on it.
    fn misses(&self, _slot: &Slot<D>) -> bool {
        false
    }

    /// True if a neighbour that must be within R and is not sensed keeps its row ([`missing`](crate::robot::missing)).
    fn reckons(&self) -> bool {
        false
    }

    /// Decides on the lists that are told in this tick.
    fn agree(
        &self,
        _own: Member,
        _ledger: &mut Ledger<D>,
        _slots: &mut [Slot<D>],
        _now: Instant,
        _scratch: &mut Scratch<'_, D>,
    ) {
    }

    /// The connectivity of a robot on its own: c_i, the sum of the weights of its links.
    //= paper eq:connectivity
    fn level(&self, view: &View<'_, D>, _scratch: &mut Scratch<'_, D>) -> f64 {
        let counted = view.linked().filter(|slot| self.need().counts(view.member(), slot.member()));
        counted.fold(0.0, |level, slot| level + slot.link.weight)
    }

    /// The decision of a robot on its own, from what it senses and hears.
    fn alone(&self, view: &View<'_, D>, desired: &Vector<D>, scratch: &mut Scratch<'_, D>) -> Decision<D>;

    /// What an answer is worth, given what it rests on.
    fn mode(&self, standing: &Standing) -> Mode;
}
