//! For whom robots keep rows, on whom they count, and for whom a row is needed, in every lane.

use crate::controller::links::control::LinksController;
use crate::controller::links::lanes::{EndInLanes, MomentInLanes, PairInLanes, SaidInLanes};
use crate::num::lane::{LANES, bits_if, is_so};

/// Robots of a team of up to 64, a bit each, in every lane.
pub type Bits = [u64; LANES];

/// What a robot holds of the others in one world, a bit each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Others {
    /// On whom it counts.
    pub counted: u64,
    /// For whom it keeps its row.
    pub active: u64,
    /// Those of which a row may bind its move, or whom it may meet.
    pub near: u64,
}

/// What a robot holds of the others once the messages of a tick are there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BitsInLanes {
    /// On whom it counts.
    pub counted: Bits,
    /// For whom it keeps its row.
    pub active: Bits,
    /// Those of which a row may bind its move, or whom it may meet.
    pub near: Bits,
}

impl BitsInLanes {
    /// Nobody.
    pub const NONE: Self = Self { counted: [0; LANES], active: [0; LANES], near: [0; LANES] };

    /// Those of one world.
    #[must_use]
    pub fn of(&self, lane: usize) -> Others {
        Others { counted: self.counted[lane], active: self.active[lane], near: self.near[lane] }
    }
}

impl<const D: usize> LinksController<D> {
    /// Adds two robots of these numbers to what both hold of each other: `first` comes before `second`, and so do its end and what it says now.
    #[inline(never)]
    pub fn hold_in_lanes(
        &self,
        pair: &PairInLanes,
        ends: [(&EndInLanes, &SaidInLanes, usize); 2],
        time: &MomentInLanes,
        first: &mut BitsInLanes,
        second: &mut BitsInLanes,
    ) {
        let [(own, says, number), (other, hears, other_number)] = ends;
        let (bit, other_bit) = (1_u64 << (number % 64), 1_u64 << (other_number % 64));
        for k in 0..LANES {
            let (square_m2, sensed) = (pair.squares_m2[k], is_so(pair.sensed[k]));
            // Both came before this tick, so each has acknowledged the other: a row is dropped once neither lists the other.
            let (says, hears) = (is_so(says.listed[k]), is_so(hears.listed[k]));
            let keeps = says | hears;
            let active = sensed & keeps;
            let (long, close) = (!self.slack.is_held_slack(square_m2), !self.slack.is_near_slack(square_m2));
            let (meets, binds) = (self.links.may_meet(square_m2), active & long);
            let any = binds | close | meets;
            let near = sensed & any;
            first.active[k] |= bits_if(active, other_bit);
            second.active[k] |= bits_if(active, bit);
            first.near[k] |= bits_if(near, other_bit);
            second.near[k] |= bits_if(near, bit);
            first.counted[k] |= bits_if(own.is_counted(k, time), other_bit);
            second.counted[k] |= bits_if(other.is_counted(k, time), bit);
        }
    }
}
