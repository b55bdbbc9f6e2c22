//! This decides for the same robot of many worlds at once, with the bits of each.
//!
//! Every function has one loop over the lanes, without branches, and calls the formulas that a robot on its own uses. Numbers that are
//! not of a usual size come out as no decision; whoever computes the worlds then decides for that robot alone.
//!
//! They are not inlined, and take their arguments one by one: only then does the compiler know that none of them overlap, and vectorises.

use crate::controller::Decision;
use crate::controller::composed::{ComposedController, Sums};
use crate::equations::composition::{Composition, Sum, TERM_LARGE};
pub use crate::equations::lanes::PairInLanes;
use crate::equations::link::LinkShape;
use crate::num::Vector;
use crate::num::lane::{LANES, Lane, at};
use crate::program::Outcome;
use crate::program::box_row::{Mostly, closest, closest_mostly};

/// The sums behind φ_i and H_i, in every lane.
#[derive(Clone, Copy, Debug)]
pub struct SumsInLanes<const D: usize> {
    normal: [Lane; D],
    collisions: Lane,
    /// Ê of the robot itself.
    own: Lane,
    /// The sum of the Ê of the robot and its neighbours.
    terms: Lane,
}

/// What became of a robot in every lane.
#[derive(Clone, Copy, Debug)]
pub struct DecisionInLanes<const D: usize> {
    /// u_i, m/s.
    pub velocities_m_s: [Lane; D],
    /// φ_i.
    pub phis: Lane,
    /// How the program found the velocity; `None` where the robot must be computed alone.
    pub outcomes: [Option<Outcome>; LANES],
}

impl<const D: usize> SumsInLanes<D> {
    /// Sums of a robot without neighbours whose own Ê are `own`.
    #[must_use]
    pub fn new(own: &Lane) -> Self {
        Self { normal: [[0.0; LANES]; D], collisions: [0.0; LANES], own: *own, terms: *own }
    }
}

impl<const D: usize> ComposedController<D> {
    /// The controller itself if a velocity is bounded by a box alone, so that worlds can be computed side by side.
    pub(crate) fn in_lanes(&self) -> Option<Self> {
        let boxed = self.reach.ball_m().is_none() && self.input.speed_max_m_s.is_infinite();
        boxed.then_some(*self)
    }

    /// What two robots at these positions share.
    pub fn pair_in_lanes(&self, first: &[Lane; D], second: &[Lane; D], pair: &mut PairInLanes) {
        self.composed.pair_in_lanes(&self.link, first, second, pair);
    }

    /// The shape of links.
    #[must_use]
    pub fn link(&self) -> &LinkShape {
        &self.link
    }

    /// Ê of told levels.
    #[must_use]
    pub fn told_in_lanes(&self, levels: &Lane) -> Lane {
        self.composed.terms_in_lanes(levels)
    }

    /// Adds a pair to the sums of both ends, which are at these positions. To be called for every pair, for each end in order of the
    /// numbers of the other one. Where there is no link it adds 0, which changes no sum: none of them is ever −0.
    #[inline(never)]
    pub fn add_both_in_lanes(
        &self,
        first: &mut SumsInLanes<D>,
        second: &mut SumsInLanes<D>,
        first_m: &[Lane; D],
        second_m: &[Lane; D],
        pair: &PairInLanes,
    ) {
        for k in 0..LANES {
            let (collision, linked) = pair.collision(k);
            let pull = self.composed.coefficient(first.own[k], second.own[k], pair.slopes[k], collision);
            for d in 0..D {
                let offset_m = first_m[d][k] - second_m[d][k];
                first.normal[d][k] += pull * offset_m;
                second.normal[d][k] += -pull * offset_m;
            }
            first.collisions[k] += collision;
            second.collisions[k] += collision;
            first.terms[k] += if linked { second.own[k] } else { 0.0 };
            second.terms[k] += if linked { first.own[k] } else { 0.0 };
        }
    }

    /// The velocities closest to the desired ones.
    //= paper seq:qp
    #[inline(never)]
    #[must_use]
    pub fn decide_in_lanes(&self, sums: &SumsInLanes<D>, desired_m_s: &[Lane; D]) -> DecisionInLanes<D> {
        let (mut velocities_m_s, mut phis) = ([[0.0; LANES]; D], [0.0; LANES]);
        let (mut free, mut found) = ([false; LANES], [false; LANES]);
        for k in 0..LANES {
            let (Composition { row, phi }, usual) = self.row(&sums.of(k)).usual(&self.composed);
            let (velocity, mostly) = closest_mostly(&at(desired_m_s, k), &row, &self.input);
            for d in 0..D {
                velocities_m_s[d][k] = velocity[d];
            }
            phis[k] = phi;
            let Mostly { free: is_free, found: is_found } = mostly;
            let small = sums.terms[k] < TERM_LARGE;
            (free[k], found[k]) = (is_free, is_found & usual & small);
        }
        let outcome = |k: usize| if free[k] { Outcome::Free } else { Outcome::Active };
        let outcomes = core::array::from_fn(|k| found[k].then(|| outcome(k)));
        let mut decision = DecisionInLanes { velocities_m_s, phis, outcomes };
        for k in (0..LANES).filter(|k| !found[*k]) {
            self.decide_lane(k, &sums.of(k), &at(desired_m_s, k), &mut decision);
        }
        decision
    }

    /// The decision in a lane in which it is not one of the usual ones.
    #[cold]
    fn decide_lane(
        &self,
        lane: usize,
        sums: &Sums<D>,
        desired_m_s: &Vector<D>,
        decision: &mut DecisionInLanes<D>,
    ) {
        let plain = self.row(sums).finish(&self.composed).filter(|_| sums.terms < TERM_LARGE);
        let Some(Composition { row, phi }) = plain else { return };
        let solution = closest(desired_m_s, &row, &self.input);
        for d in 0..D {
            decision.velocities_m_s[d][lane] = solution.velocity_m_s[d];
        }
        decision.phis[lane] = phi;
        decision.outcomes[lane] = Some(solution.outcome);
    }
}

impl<const D: usize> DecisionInLanes<D> {
    /// The decision in a lane; `None` where the robot must be computed alone.
    #[inline]
    #[must_use]
    pub fn of(&self, lane: usize) -> Option<Decision<D>> {
        let outcome = self.outcomes[lane]?;
        let velocity_m_s = at(&self.velocities_m_s, lane);
        Some(Decision { velocity_m_s, outcome, phi: Some(self.phis[lane]), doubt: None })
    }
}

impl<const D: usize> SumsInLanes<D> {
    /// The sums in one lane.
    #[inline]
    fn of(&self, lane: usize) -> Sums<D> {
        let row = Sum::of(at(&self.normal, lane), self.own[lane], self.collisions[lane]);
        Sums { row, terms: self.terms[lane] }
    }
}
