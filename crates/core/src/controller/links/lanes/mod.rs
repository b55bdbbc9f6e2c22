//! The rule who releases whom for the same robot of many worlds at once, with the bits of each.
//!
//! This is the rule of [`line`](crate::controller::links::line) in ticks in which nobody comes into range or leaves it. Every function has
//! loops over the lanes without branches, which the compiler vectorises, and calls the formulas of a robot on its own. Facts are numbers
//! that are 0 or 1, so that they lie beside the others. What is rare, to release or to list somebody, is left to whoever computes the worlds,
//! robot by robot ([`EndInLanes::line`]).

mod choose;
mod end;
mod rows;

use crate::controller::links::bond::Moment;
use crate::controller::links::control::LinksController;
use crate::controller::links::cut::Room;
use crate::controller::links::deal::{Deal, Look};
pub use crate::controller::links::lanes::end::{EndInLanes, SaidInLanes};
pub use crate::controller::links::lanes::rows::{Bits, BitsInLanes, Others};
use crate::controller::links::policy::STEP_MAX_S;
use crate::num::lane::{LANES, Lane, at, fact, is_so};
use crate::num::{Vector, add_scaled, dot, sqrt, subtract};

/// A tick of many worlds whose robots have looked in the tick before.
#[derive(Clone, Copy, Debug)]
pub struct MomentInLanes {
    /// The tick as each world has it.
    pub moment: Moment,
    tick: f64,
    elapsed_s: f64,
    /// What is forgotten in that time.
    forgotten: f64,
}

/// What both ends of a pair share, in every lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairInLanes {
    /// D, m².
    pub squares_m2: Lane,
    /// Δ, m.
    distances_m: Lane,
    /// Facts: both are in each other's lists and sense each other.
    pub sensed: Lane,
    /// The tick in which the two came into range.
    pub born: Lane,
}

/// What a robot told all others in the tick before, in every lane.
#[derive(Clone, Copy, Debug)]
pub struct VoiceInLanes<const D: usize> {
    /// How far apart two robots must end for a promise, m.
    pub prices_m: Lane,
    /// Where it wants to go, m/s, no faster than a robot can go.
    pub wishes_m_s: [Lane; D],
}

/// A robot and a neighbour, as the robot looks at it.
#[derive(Clone, Copy, Debug)]
pub struct Facing<'a, const D: usize> {
    /// What both share.
    pub pair: &'a PairInLanes,
    /// Where the robot is, m.
    pub own_m: &'a [Lane; D],
    /// Where the neighbour is, m.
    pub other_m: &'a [Lane; D],
    /// Where the robot wants to go, m/s.
    pub wishes_m_s: &'a [Lane; D],
    /// What the neighbour told all.
    pub voice: &'a VoiceInLanes<D>,
    /// What the robot said to the neighbour in the tick before, and the neighbour to it.
    pub said: [&'a SaidInLanes; 2],
}

/// What a look at a neighbour comes to in this tick.
#[derive(Clone, Copy, Debug)]
pub struct LookInLanes {
    /// V, m.
    gains_m: Lane,
    /// V with what an engaged pair is preferred by, m; below 0 if nothing may be promised.
    keys_m: Lane,
    /// How many of the eligible come before it.
    before: Lane,
    /// Facts.
    engaged: Lane,
    stretched: Lane,
    counted: Lane,
    let_go: Lane,
}

/// What the looks of a robot at all others come to.
#[derive(Clone, Copy, Debug)]
pub struct TurnInLanes {
    /// How many it counts on.
    pub counted: Lane,
    /// How many are in range and can be counted on, now or soon.
    in_range: Lane,
    /// How many may be promised something.
    eligible: Lane,
    /// Facts: somebody is to be released or listed, or waits for it.
    pub eventful: Lane,
}

impl MomentInLanes {
    /// The tick of worlds in which it is `moment`; `None` if what was told in the tick before does not count any more.
    #[must_use]
    pub fn new(moment: Moment) -> Option<Self> {
        let before = moment.before().filter(|_| moment.told)?;
        let elapsed_s = moment.now().since(before.now()).as_secs_f64().min(STEP_MAX_S);
        let forgotten = Deal::forgotten(elapsed_s);
        Some(Self { moment, tick: f64::from(moment.tick), elapsed_s, forgotten })
    }
}

impl PairInLanes {
    /// Of two robots out of range.
    pub const NONE: Self = Self {
        squares_m2: [f64::INFINITY; LANES],
        distances_m: [f64::INFINITY; LANES],
        sensed: [0.0; LANES],
        born: [0.0; LANES],
    };

    /// Takes in where both are, m, and notes in which lanes they come into the range of `radius_m2` (m²) or leave it.
    #[inline(never)]
    pub fn measure<const D: usize>(
        &mut self,
        first_m: &[Lane; D],
        second_m: &[Lane; D],
        radius_m2: f64,
        changed: &mut Lane,
    ) {
        for k in 0..LANES {
            let offset_m = subtract(&at(first_m, k), &at(second_m, k));
            self.squares_m2[k] = dot(&offset_m, &offset_m);
            let senses = radius_m2 - self.squares_m2[k] >= 0.0;
            changed[k] += (fact(senses) - self.sensed[k]).abs();
        }
        // The square root is not vectorised.
        for k in 0..LANES {
            self.distances_m[k] = sqrt(self.squares_m2[k]);
        }
    }
}

impl LookInLanes {
    /// Before any look.
    pub const NOTHING: Self = Self {
        gains_m: [0.0; LANES],
        keys_m: [0.0; LANES],
        before: [0.0; LANES],
        engaged: [0.0; LANES],
        stretched: [0.0; LANES],
        counted: [0.0; LANES],
        let_go: [0.0; LANES],
    };

    /// The look of one world, after promises are made.
    fn of(&self, lane: usize) -> Look {
        let (engaged, stretched) = (is_so(self.engaged[lane]), is_so(self.stretched[lane]));
        Look { gain_m: self.gains_m[lane], engaged, eligible: self.keys_m[lane] >= 0.0, stretched }
    }
}

impl TurnInLanes {
    /// Before any look.
    pub const NOTHING: Self = Self {
        counted: [0.0; LANES],
        in_range: [0.0; LANES],
        eligible: [0.0; LANES],
        eventful: [0.0; LANES],
    };
}

impl<const D: usize> LinksController<D> {
    /// The controller itself if the rule can be computed so: everybody counts for everybody, and positions have no errors.
    #[must_use]
    pub fn in_lanes(&self) -> Option<Self> {
        let plain = !self.links.need.is_ranked() && self.links.errors.offset_m == 0.0;
        plain.then_some(*self)
    }

    /// A told wish, no faster than a robot can go.
    #[must_use]
    pub fn capped(&self, wish_m_s: &Vector<D>) -> Vector<D> {
        self.links.capped(wish_m_s)
    }

    /// A robot looks at one neighbour.
    #[inline(never)]
    pub fn look_in_lanes(
        &self,
        time: &MomentInLanes,
        facing: &Facing<'_, D>,
        end: &mut EndInLanes,
        look: &mut LookInLanes,
        turn: &mut TurnInLanes,
    ) {
        self.measure_gains(facing, look);
        let (pair, voice, [says, hears]) = (facing.pair, facing.voice, facing.said);
        let begun_m = self.links.begun_m();
        for k in 0..LANES {
            let (distance_m, sensed) = (pair.distances_m[k], is_so(pair.sensed[k]));
            let known = end.known(k, pair.born[k], hears, time.tick);
            let held = self.links.is_held(
                known.acknowledges,
                is_so(end.held[k]),
                (distance_m, self.links.error_m(0.0)),
                &Room::OPEN,
            );
            let mut deal = end.times(k);
            let stretched = self.links.is_stretched(distance_m);
            let engaged = is_so(says.promised[k]) & is_so(hears.promised[k]);
            let open = sensed && deal.is_open(stretched);
            let seen = Look::new(look.gains_m[k], [stretched, engaged], voice.prices_m[k], open);
            deal.pass(time.elapsed_s, time.forgotten, &seen);
            end.pass(k, &deal);
            end.held[k] = fact(held);
            let counted = held & known.acknowledges;
            look.keys_m[k] = if seen.eligible { seen.key_m() } else { INELIGIBLE };
            look.engaged[k] = fact(engaged);
            look.stretched[k] = fact(stretched);
            look.counted[k] = fact(counted);
            look.let_go[k] = fact(known.released);
            turn.counted[k] += fact(counted);
            turn.eligible[k] += fact(seen.eligible);
            let within = distance_m <= begun_m;
            turn.in_range[k] += fact(sensed & within);
        }
    }

    /// How far apart both would end.
    #[inline]
    fn measure_gains(&self, facing: &Facing<'_, D>, look: &mut LookInLanes) {
        for k in 0..LANES {
            let offset_m = subtract(&at(facing.own_m, k), &at(facing.other_m, k));
            let way_m_s = subtract(&at(facing.wishes_m_s, k), &at(&facing.voice.wishes_m_s, k));
            let ends_m = add_scaled(&offset_m, self.links.horizon_s, &way_m_s);
            look.gains_m[k] = dot(&ends_m, &ends_m);
        }
        for gain_m in &mut look.gains_m {
            *gain_m = sqrt(*gain_m);
        }
    }
}

/// Less than the key of anybody who may be promised something, m.
const INELIGIBLE: f64 = -1.0;

#[cfg(test)]
mod tests;
