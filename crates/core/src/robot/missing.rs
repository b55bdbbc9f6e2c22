//! Neighbours that were not sensed in a tick although they must still be there.
//!
//! A neighbour that leaves passes the rim of the range first: in a tick nobody goes farther than the longest move ρ. So one that
//! was last sensed well inside R and is not observed now is not gone but *missing*. A sensor failed, an observation was refused,
//! or something stood between. Where it is is known up to how far it can have gone:
//!
//! ```text
//! x_j ∈ ball(where it was sensed, g),    g = ρ for every tick since, or more for one that came late
//! missing as long as  |x_i − (where it was sensed)| + g + (stated error of an offset) < R
//! ```
//!
//! No clock is in it: a tick of the robot itself lasts no longer than a velocity may be held, and ρ is the longest move over
//! that time. A missing neighbour keeps its slot, what it told, and a row for every place where it can be (docs/theory, sec:unsensed). Once
//! it may have left unseen, it is given up, and the robot says [`Reason::Overlooked`].
//! One that was last sensed so near the rim that it may have left in a tick is taken for gone at once: nobody can tell.
//!
//! This is for controllers that reckon with those whom they do not see. `links` does so too, and keeps whom it holds beside
//! (docs/theory, sec:unseen-links). All others forget who is not observed.

use core::time::Duration;

use crate::num::{Vector, dot, length, subtract};
use crate::robot::error::ObserveError;
use crate::robot::neighbor::{NO_LINK, Slot, Told};
use crate::robot::report::Reason;
use crate::robot::{Robot, Slots};
use crate::settings::params::Params;

/// Nobody whose distance is rounded is taken for one inside R: as a fraction of R.
const HAIR: f64 = 1e-9;

/// How far robots go, and how far they are sensed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Horizon {
    /// The greatest speed of any robot, m/s, and ρ, its longest move in a tick, m.
    pub speed_m_s: f64,
    /// See `speed_m_s`.
    pub move_max_m: f64,
    /// How far a robot is surely sensed, m: R, less what offsets may be wrong.
    pub radius_m: f64,
}

impl Horizon {
    /// That of robots with these `params`.
    #[must_use]
    pub fn new<const D: usize>(params: &Params<D>) -> Self {
        let longest_m = params.reach().longest_m();
        let radius_m = params.link().radius_m - params.kept().errors.offset_m;
        Self { speed_m_s: longest_m / params.hold_s(), move_max_m: longest_m, radius_m }
    }

    /// How far a robot can have gone in a tick that took `elapsed` on the own clock, m: ρ at least.
    //= theory sec:unsensed
    #[must_use]
    pub fn went_m(&self, elapsed: Duration) -> f64 {
        (self.speed_m_s * elapsed.as_secs_f64()).max(self.move_max_m)
    }

    /// True if a robot that was last sensed at `offset_m` (m) and can have gone `gone_m` since must still be within R.
    //= theory sec:unsensed
    #[must_use]
    pub fn surely_holds<const D: usize>(&self, offset_m: &Vector<D>, gone_m: f64) -> bool {
        length(offset_m) + gone_m < self.radius_m * (1.0 - HAIR)
    }
}

impl<const D: usize, S: Slots<D>> Robot<D, S> {
    /// Forgets whom it did not sense in this tick, but for those that are missing; says so when one is given up that was
    /// missing.
    pub(crate) fn settle(&mut self) {
        if self.everybody().iter().all(|slot| slot.sensed) {
            return;
        }
        let horizon = self.horizon();
        let Some(own) = self.position.filter(|_| self.params.controller().reckons()) else {
            return self.forget_unsensed();
        };
        let mut overlooked = false;
        self.keep(|slot| {
            let missing = slot.sensed || horizon.reckon(slot, &own);
            overlooked |= !missing && !slot.seen_before;
            missing
        });
        if overlooked {
            self.overlook();
        }
    }

    /// Notes that a robot within R may be overlooked, under a controller that promises something.
    pub(crate) fn overlook(&mut self) {
        if self.params.controller().promises() {
            self.assurance.note(self.now, Reason::Overlooked);
        }
    }

    /// An observation that was refused is noted in the same way.
    pub(crate) fn refuse(&mut self, error: ObserveError) -> ObserveError {
        self.overlook();
        error
    }

    /// The slot of the farthest robot that was not sensed in this tick. To give up one that is missing is to overlook it.
    pub(crate) fn farthest_unsensed(&mut self) -> Option<usize> {
        let unsensed =
            self.everybody().iter().enumerate().filter(|(_, slot)| !slot.sensed && !self.stays(slot));
        let distance_m2 = |slot: &Slot<D>| dot(&slot.offset_m, &slot.offset_m);
        let (index, slot) = unsensed.max_by(|(_, a), (_, b)| distance_m2(a).total_cmp(&distance_m2(b)))?;
        if self.horizon().surely_holds(&slot.offset_m, 2.0 * slot.gone_m) {
            self.overlook();
        }
        Some(index)
    }

    /// How far robots go, and how far this one surely senses them.
    pub(crate) fn horizon(&self) -> Horizon {
        Horizon::new(&self.params)
    }

    /// True if the robot reckons with a neighbour that it does not sense although it cannot have left.
    pub fn misses_somebody(&self) -> bool {
        let controller = self.params.controller();
        self.everybody().iter().any(|slot| !slot.sensed && controller.misses(slot))
    }

    /// Reckons where neighbours are that keep their slots although they are not sensed: where they were sensed last, with an
    /// error as large as they can have gone since. What they tell of their value does not count.
    //= theory sec:unseen-links
    pub(crate) fn reckon(&mut self) {
        let Some(own) = self.position.filter(|_| self.params.controller().tells_lists()) else { return };
        let horizon = self.horizon();
        for slot in &mut self.slots.as_mut()[..self.count] {
            if slot.sensed {
                (slot.peer.unseen_ticks, slot.peer.vanished, slot.peer.inside) = (0, false, false);
                continue;
            }
            slot.peer.unseen_ticks = slot.peer.unseen_ticks.saturating_add(1);
            (slot.offset_m, slot.linked) = (subtract(&own, &slot.position_m), false);
            slot.peer.inside = horizon.surely_holds(&slot.offset_m, slot.gone_m);
            if slot.peer.unseen_ticks == 1 {
                slot.peer.vanished = slot.peer.inside;
            }
            slot.told = slot.told.map(|told| Told { value: None, ..told });
        }
    }
}

impl Horizon {
    /// Notes where a robot that was not sensed is as seen from `own`, and says whether it is missing.
    fn reckon<const D: usize>(&self, slot: &mut Slot<D>, own: &Vector<D>) -> bool {
        // Never 0, which stands for a robot that was sensed.
        let gone_m = slot.gone_m.max(f64::MIN_POSITIVE);
        slot.offset_m = subtract(own, &slot.position_m);
        (slot.linked, slot.link) = (false, NO_LINK);
        let missing = self.surely_holds(&slot.offset_m, gone_m);
        slot.unsensed_m = if missing { gone_m } else { 0.0 };
        missing
    }
}
