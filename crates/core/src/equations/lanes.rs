//! Links, collision terms and φ_i of the same robots of many worlds at once, with the bits of each.
//!
//! Every function has loops over the lanes, without branches, and calls the formulas that a robot on its own uses. They are not inlined, and take
//! their arguments one by one: only then does the compiler know that none of them overlap, and vectorises.

use crate::equations::composition::{Composed, Sum};
use crate::equations::link::{Link, LinkShape};
use crate::num::exponential::exps_in_lanes;
use crate::num::lane::{LANES, Lane, at};
use crate::num::{dot, subtract};

/// In place of the collision term of two robots that have no link.
const UNLINKED: f64 = -1.0;

/// What both ends of a link share, in every lane. Without a link all numbers are 0 but the collision term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairInLanes {
    /// `a_ij`.
    pub weights: Lane,
    /// `2 ∂a/∂Δ²`, 1/m².
    pub(crate) slopes: Lane,
    /// `E^c_ij`, or [`UNLINKED`].
    collisions: Lane,
}

/// The sums behind φ_i, in every lane.
#[derive(Clone, Copy, Debug)]
pub struct PhiInLanes {
    /// E of the robot itself.
    pub own: Lane,
    terms: Lane,
    collisions: Lane,
}

impl PairInLanes {
    /// Of two robots without a link in any lane.
    pub const NONE: Self =
        Self { weights: [0.0; LANES], slopes: [0.0; LANES], collisions: [UNLINKED; LANES] };

    /// `E^c_ij` in a lane, 0 without a link, and whether there is one.
    #[inline]
    #[must_use]
    pub fn collision(&self, lane: usize) -> (f64, bool) {
        let linked = self.collisions[lane] >= 0.0;
        (if linked { self.collisions[lane] } else { 0.0 }, linked)
    }
}

impl Composed {
    /// What two robots at these positions share.
    #[inline(never)]
    pub fn pair_in_lanes<const D: usize>(
        &self,
        link: &LinkShape,
        first: &[Lane; D],
        second: &[Lane; D],
        pair: &mut PairInLanes,
    ) {
        let mut slacks_m2 = [0.0; LANES];
        let (mut of_links, mut of_collisions) = ([0.0; LANES], [0.0; LANES]);
        for k in 0..LANES {
            let offset_m = subtract(&at(first, k), &at(second, k));
            let distance_m2 = dot(&offset_m, &offset_m);
            slacks_m2[k] = link.slack_m2(distance_m2);
            let linked = slacks_m2[k] >= 0.0;
            of_links[k] = if linked { link.exponent(slacks_m2[k]) } else { 0.0 };
            of_collisions[k] = if linked { self.collision_exponent(distance_m2) } else { 0.0 };
        }
        let (tails, collisions) = (exps_in_lanes(&of_links), exps_in_lanes(&of_collisions));
        for k in 0..LANES {
            let linked = slacks_m2[k] >= 0.0;
            let Link { weight, slope }: Link<f64> = link.link_of(slacks_m2[k], tails[k]);
            pair.weights[k] = if linked { weight } else { 0.0 };
            pair.slopes[k] = if linked { slope } else { 0.0 };
            pair.collisions[k] = if linked { collisions[k] } else { UNLINKED };
        }
    }

    /// Ê of levels.
    #[inline(never)]
    #[must_use]
    pub fn terms_in_lanes(&self, levels: &Lane) -> Lane {
        let mut exponents = [0.0; LANES];
        for k in 0..LANES {
            exponents[k] = self.degree_exponent(levels[k]);
        }
        exps_in_lanes(&exponents)
    }

    /// Adds a pair to the sums behind φ_i of both ends; in the order of [`Composed::phi`] if each end takes the others in order of their
    /// numbers. Where there is no link it adds 0, which changes no sum: none of them is ever −0.
    #[inline(never)]
    pub fn add_phis_in_lanes(&self, first: &mut PhiInLanes, second: &mut PhiInLanes, pair: &PairInLanes) {
        for k in 0..LANES {
            let (collision, linked) = pair.collision(k);
            first.collisions[k] += collision;
            second.collisions[k] += collision;
            first.terms[k] += if linked { self.shared(second.own[k]) } else { 0.0 };
            second.terms[k] += if linked { self.shared(first.own[k]) } else { 0.0 };
        }
    }

    /// φ_i; not finite where something overflowed.
    #[inline(never)]
    #[must_use]
    pub fn phis_in_lanes(&self, sums: &PhiInLanes) -> Lane {
        let mut phis = [0.0; LANES];
        for k in 0..LANES {
            phis[k] = Sum::of([], sums.terms[k], sums.collisions[k]).phi(self);
        }
        phis
    }
}

impl PhiInLanes {
    /// The sums of a robot without neighbours whose E_i are `own`.
    #[must_use]
    pub fn new(own: Lane) -> Self {
        Self { own, terms: own, collisions: [0.0; LANES] }
    }
}
