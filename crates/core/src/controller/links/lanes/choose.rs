//! Whom a robot promises a release, at which price, and whether anything else is to be done, in every lane.

use crate::controller::links::control::LinksController;
use crate::controller::links::lanes::{EndInLanes, LookInLanes, PairInLanes, SaidInLanes, TurnInLanes};
use crate::num::lane::{LANES, Lane, fact, is_so};

/// How many slots a robot has left, and what is engaged of them.
#[derive(Clone, Copy, Debug)]
struct Slots {
    left: Lane,
    engaged: Lane,
    least_m: Lane,
}

impl<const D: usize> LinksController<D> {
    /// Promises the slots that are left to those who come first, once a robot that must count on `keep` has looked at all. `says` is what it
    /// says to each; gives the price of a promise, m.
    pub fn promise_in_lanes(
        &self,
        keep: u16,
        turn: &TurnInLanes,
        looks: &mut [LookInLanes],
        says: &mut [SaidInLanes],
    ) -> Lane {
        let keep = f64::from(keep);
        let left = turn.in_range.map(|in_range| (in_range - keep).max(0.0));
        if turn.eligible.iter().zip(&left).all(|(eligible, left)| eligible <= left) {
            nobody_before(looks);
        } else {
            line_up(looks);
        }
        let mut slots = Slots { left, engaged: [0.0; LANES], least_m: [f64::INFINITY; LANES] };
        for (look, says) in looks.iter_mut().zip(says) {
            promise(look, says, &mut slots);
        }
        core::array::from_fn(|k| match slots.left[k] {
            0.0 => f64::INFINITY,
            left if slots.engaged[k] < left => 0.0,
            _ => slots.least_m[k],
        })
    }

    /// Notes in which lanes a robot that must count on `keep` is to release or to list this neighbour, or lets it wait.
    #[inline(never)]
    pub fn note_events_in_lanes(
        &self,
        keep: u16,
        pair: &PairInLanes,
        (end, hears): (&EndInLanes, &SaidInLanes),
        look: &LookInLanes,
        turn: &mut TurnInLanes,
    ) {
        let keep = f64::from(keep);
        let [near_m, all_m] = [false, true].map(|all| self.links.reach_m(all));
        for k in 0..LANES {
            let (listed, sensed) = (end.is_listed(k), is_so(pair.sensed[k]));
            let (stretched, engaged) = (is_so(look.stretched[k]), is_so(look.engaged[k]));
            let follows = look.let_go[k] > look.counted[k];
            let loose = engaged | follows;
            let spare = turn.counted[k] >= keep + look.counted[k];
            let releases = stretched & listed & loose & spare;
            let reach_m = if turn.counted[k] < keep { all_m } else { near_m };
            let (near, waited_for) = (pair.squares_m2[k] <= reach_m * reach_m, is_so(hears.listed[k]));
            let wanted = near | waited_for;
            let lists = !listed & wanted;
            let waits = end.waiting_ticks[k] > 0.0;
            let any = releases | lists | waits;
            let any = any & sensed;
            turn.eventful[k] += fact(any);
        }
    }
}

fn nobody_before(looks: &mut [LookInLanes]) {
    for look in looks {
        look.before = [0.0; LANES];
    }
}

/// Counts for each how many of the others come before it: larger keys, and of equals lower numbers.
fn line_up(looks: &mut [LookInLanes]) {
    nobody_before(looks);
    for later in 1..looks.len() {
        let (firsts, rest) = looks.split_at_mut(later);
        let LookInLanes { keys_m, before, .. } = &mut rest[0];
        for first in firsts {
            pass(&first.keys_m, keys_m, &mut first.before, before);
        }
    }
}

/// One of two comes before the other.
#[inline(never)]
fn pass(first_m: &Lane, later_m: &Lane, before_first: &mut Lane, before_later: &mut Lane) {
    for k in 0..LANES {
        let passes = later_m[k] > first_m[k];
        before_first[k] += fact(passes);
        before_later[k] += fact(!passes);
    }
}

#[inline(never)]
fn promise(look: &mut LookInLanes, says: &mut SaidInLanes, slots: &mut Slots) {
    for k in 0..LANES {
        let (eligible, first) = (look.keys_m[k] >= 0.0, look.before[k] < slots.left[k]);
        let promised = eligible & first;
        let engaged = is_so(look.engaged[k]) & promised;
        says.promised[k] = fact(promised);
        look.engaged[k] = fact(engaged);
        slots.engaged[k] += fact(engaged);
        let gain_m = if engaged { look.gains_m[k] } else { f64::INFINITY };
        slots.least_m[k] = if gain_m < slots.least_m[k] { gain_m } else { slots.least_m[k] };
    }
}

impl EndInLanes {
    /// Says who is listed now.
    #[inline(never)]
    pub fn tell(&self, says: &mut SaidInLanes) {
        for k in 0..LANES {
            says.listed[k] = fact(self.is_listed(k));
        }
    }
}
