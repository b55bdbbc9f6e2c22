//! The controllers: what stands between the desired and the safe velocity. One file each, behind one closed enum.
//!
//! [`Control`] is the seam. A robot on its own calls [`Control::alone`], which looks at what it senses and hears and ends
//! in [`Control::decide`]. Whoever computes a whole team at once makes [`Control::Pair`] once for both ends of a link, adds
//! up [`Control::Sums`], and calls the same `decide`: so both give the same bits.
//!
//! | controller | file | needs | promises |
//! | --- | --- | --- | --- |
//! | the paper's | [`composed`] | told levels | nothing in discrete time |
//! | ours | [`budget`] | positions, and told levels if trusted | docs/budget.md |
//! | ours, without weights | [`links`] | positions, lists and acknowledgements | docs/links.md |
//! | none | [`none`] | nothing | nothing |

pub mod any;
pub mod budget;
pub mod composed;
pub mod kept;
pub mod links;
pub mod none;

pub use any::AnyController;
pub use kept::Kept;

use crate::controller::links::peer::Ledger;
use crate::equations::link::{Link, LinkShape};
use crate::need::Need;
use crate::num::{Vector, subtract};
use crate::program::Outcome;
use crate::robot::id::Member;
use crate::robot::neighbor::{RobotId, Slot};
use crate::robot::report::{Mode, Reason};
use crate::robot::scratch::{Needs, Scratch};
use crate::time::Instant;

/// A robot itself, as its neighbours do not know it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Own {
    /// Its number.
    pub id: RobotId,
    /// c_i, or what the controller has in its place.
    pub level: f64,
    /// The level that it tells. By Assumption 1 a liar's own row uses its lie.
    pub told_level: f64,
    /// How many neighbours may count: those in sight.
    pub degree: u16,
}

/// A neighbour as a controller needs it.
#[derive(Clone, Copy, Debug)]
pub struct Neighbor<'a, const D: usize, Pair, Known> {
    /// Its number.
    pub id: RobotId,
    /// x_i − x_j, m.
    pub offset_m: Vector<D>,
    /// What both ends share; `None` where the pair bounds the move of neither.
    pub pair: Option<&'a Pair>,
    /// What the robot knows of it.
    pub known: Known,
}

/// What a robot on its own senses and hears in a tick.
#[derive(Clone, Copy, Debug)]
pub struct View<'a, const D: usize> {
    /// Its number.
    pub id: RobotId,
    /// Its rank.
    pub rank: u16,
    /// The present time on its clock.
    pub now: Instant,
    /// Its level as it tells it.
    pub told_level: f64,
    /// The velocity of the tick before, m/s.
    pub before_m_s: Vector<D>,
    /// What it holds of its own messages, under `links`.
    pub ledger: &'a Ledger<D>,
    /// Its neighbours in order of their numbers; some may not be sensed in this tick.
    pub slots: &'a [Slot<D>],
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

/// Links whose pairs are made together.
#[derive(Debug)]
pub struct Batch<'a, const D: usize> {
    /// Where all robots are, m.
    pub positions_m: &'a [Vector<D>],
    /// Index of the first and of the second end of each.
    pub ends: &'a [[u16; 2]],
    /// Squared distance of each, m². A controller may overwrite it.
    pub distances_m2: &'a mut [f64],
    /// `a_ij` of each.
    pub weights: &'a [f64],
    /// `2 ∂a/∂Δ²` of each, 1/m².
    pub slopes: &'a [f64],
}

impl<const D: usize> Batch<'_, D> {
    /// Position of the first less that of the second end of a link, m.
    #[inline]
    #[must_use]
    pub fn offset_m(&self, index: usize) -> Vector<D> {
        let [first, second] = self.ends[index].map(usize::from);
        subtract(&self.positions_m[first], &self.positions_m[second])
    }
}

/// What can be said of a neighbour j as robot i sees it, in a world in which all sense exactly and hear the same.
#[derive(Clone, Copy)]
pub struct Glimpse<'a, Told> {
    /// The number of j.
    pub id: RobotId,
    /// The level that j told.
    pub told_level: f64,
    /// What others make of it.
    pub told: &'a Told,
    /// The true level of j.
    pub level: f64,
    /// How many neighbours j has.
    pub degree: u16,
    /// How many robots of the team i does not see.
    pub unseen: usize,
    /// How many of these are neighbours of j.
    pub unseen_near: usize,
    /// Distance of i and j, m.
    pub distance_m: f64,
    /// The sum of the weights of j with i and with whomever i sees, in order of numbers.
    pub low: Low<'a>,
}

/// A sum that is there, or that costs a walk over neighbours.
#[derive(Clone, Copy)]
pub enum Low<'a> {
    /// It is there.
    Known(f64),
    /// It is added up when it is asked for.
    Asked(&'a dyn Fn() -> f64),
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
    /// What both ends of a link share. Two robots of which [`pair`](Self::pair) makes nothing do not bound each other.
    type Pair: Copy + core::fmt::Debug + 'static;
    /// What others make of a level that a robot told.
    type Told: Copy + core::fmt::Debug;
    /// What a robot adds up over its neighbours.
    type Sums: Copy + core::fmt::Debug;
    /// What a robot knows of a neighbour when it decides.
    type Known: Copy + core::fmt::Debug;

    /// True if it adds up anything over neighbours.
    const ADDS: bool;
    /// True if it looks at every neighbour one by one; false if it does so only where sums fail.
    const LOOKS: bool;
    /// True if φ_i is part of its decision.
    const USES_PHI: bool;

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

    /// True if malicious robots are assumed to move as its rows allow (Assumption 1 of the paper).
    fn is_obeyed(&self) -> bool {
        true
    }

    /// How much scratch a robot needs for up to so many neighbours: at least a number for the value of each.
    fn needs(&self, neighbors: usize) -> Needs {
        Needs { values: neighbors, sightings: 0, rows: 0 }
    }

    /// True if a whole team can be computed at once where nothing goes wrong: decisions rest on levels and links alone.
    fn can_be_computed_at_once(&self) -> bool {
        true
    }

    /// True if a robot tells lists of links in place of its level.
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

    /// What a robot on its own has to tell of its connectivity: c_i, the sum of the weights of its links.
    //= paper eq:connectivity
    fn level(&self, view: &View<'_, D>, _scratch: &mut Scratch<'_, D>) -> f64 {
        let counted = view.linked().filter(|slot| self.need().counts(view.member(), slot.member()));
        counted.fold(0.0, |level, slot| level + slot.link.weight)
    }

    /// What both ends of a pair at `offset_m` (m) share, whose link is `link`.
    fn pair(&self, offset_m: &Vector<D>, link: &Link<f64>) -> Option<Self::Pair>;

    /// [`pair`](Self::pair) of many links, with the bits of each. `make` is called for every link in order.
    fn pairs(&self, links: &mut Batch<'_, D>, mut make: impl FnMut(usize, Option<Self::Pair>)) {
        for index in 0..links.ends.len() {
            let link = Link { weight: links.weights[index], slope: links.slopes[index] };
            make(index, self.pair(&links.offset_m(index), &link));
        }
    }

    /// What others make of a level that `robot` told, or of none.
    fn told(&self, robot: RobotId, level: Option<f64>) -> Self::Told;

    /// Sums of a robot without neighbours.
    fn sums(&self, own: &Self::Told) -> Self::Sums;

    /// Adds what a neighbour told. To be called for every neighbour, in order of their numbers.
    fn hear(&self, sums: &mut Self::Sums, told: &Self::Told);

    /// Adds a pair to the sums of one end, from which the other end is at −`offset_m`, with what this end and the other told.
    /// To be called for every neighbour with a pair, in order of their numbers.
    fn add(&self, sums: &mut Self::Sums, offset_m: &Vector<D>, pair: &Self::Pair, told: [&Self::Told; 2]);

    /// Adds a pair to the sums of both ends; `offset_m` is that of the first.
    fn add_both(
        &self,
        sums: [&mut Self::Sums; 2],
        offset_m: &Vector<D>,
        pair: &Self::Pair,
        told: [&Self::Told; 2],
    ) {
        let ([first, second], [one, other]) = (sums, told);
        self.add(first, offset_m, pair, [one, other]);
        self.add(second, &offset_m.map(|component| -component), pair, [other, one]);
    }

    /// What a robot knows of a neighbour, as whoever computes a whole team at once finds it.
    fn know(&self, glimpse: &Glimpse<'_, Self::Told>) -> Self::Known;

    /// The velocity closest to `desired` (m/s) that the controller allows. `neighbors` come in order of their numbers;
    /// `before_m_s` is the velocity of the tick before.
    fn decide<'a>(
        &self,
        own: &Own,
        sums: &Self::Sums,
        neighbors: impl Iterator<Item = Neighbor<'a, D, Self::Pair, Self::Known>> + Clone,
        motion: &Motion<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decision<D>;

    /// The decision of a robot on its own, from what it senses and hears.
    fn alone(&self, view: &View<'_, D>, desired: &Vector<D>, scratch: &mut Scratch<'_, D>) -> Decision<D>;

    /// What an answer is worth, given what it rests on.
    fn mode(&self, standing: &Standing) -> Mode;
}

/// Where a robot wants to go, and where it went before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<const D: usize> {
    /// u_{i,des}, m/s.
    pub desired_m_s: Vector<D>,
    /// u_i of the tick before, m/s.
    pub before_m_s: Vector<D>,
}
