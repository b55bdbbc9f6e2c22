//! What a robot holds of a neighbour where nothing is lost or late, in few bytes: for whoever computes a large team at once.
//!
//! Where every message arrives in the tick in which it is sent, numbers and acknowledgements follow from the ticks in which things
//! began. Let `n(t)` be the number of the messages of tick t: here t + 1, because only the order of numbers matters. Of a neighbour
//! that came into range in tick b and is listed since tick s, a robot holds before the messages of tick t (and after them, with
//! t + 1 in place of t)
//!
//! ```text
//! born = n(b − 1)    listed_after = n(s − 1)    heard = n(t − 1) if b < t    acknowledged = n(t − 2) if b < t − 1
//! ```
//!
//! and 0 otherwise. [`Hold`], the rule who releases whom and the rows are those of a robot on its own, so both come to the same bits.

pub use crate::controller::links::deal::{Deal, Look};
use crate::controller::links::partner::HEARD;
use crate::controller::links::peer::Told;
use crate::controller::links::protocol::{Entry, Hold, Number, Word};
use crate::controller::links::rows::Beside;
use crate::controller::links::wire::Head;
use crate::id::Member;
use crate::num::{Vector, subtract};
use crate::robot::missing::Horizon;
use crate::robot::neighbor::Slot;
use crate::time::Instant;

/// Stands for a tick that never was.
pub(super) const NEVER: u32 = u32::MAX;

/// A tick of a team whose clocks show the same time, from 0 on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment {
    pub(super) tick: u32,
    period_nanos: u64,
    /// True if what was told in the tick before still counts.
    pub(super) told: bool,
}

/// What a robot says to one neighbour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Said {
    pub(super) listed: bool,
    pub(super) promised: bool,
}

/// What a robot says to all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Voice<const D: usize> {
    /// How far apart two robots must end for a promise, m.
    pub price_m: f64,
    /// Where it wants to go, m/s, and the same no faster than a robot can go.
    pub wish_m_s: Vector<D>,
    pub(super) capped_m_s: Vector<D>,
}

/// What a robot holds of a neighbour from tick to tick: all that matters to others and to the rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bond {
    /// The tick in which it came, and since which it is listed.
    pub(super) born: u32,
    pub(super) listed: u32,
    pub(super) held: bool,
    pub(super) promised: bool,
    /// What it said in the tick before.
    pub(super) their: Said,
}

/// Where a neighbour is that is not sensed and keeps its place, because others may rest on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unseen<const D: usize> {
    /// Where it was sensed last, m, and when.
    position_m: Vector<D>,
    pub(super) sensed_at: Instant,
    /// How far it can have gone since, m.
    pub(super) gone_m: f64,
    pub(super) ticks: u32,
    vanished: bool,
    inside: bool,
}

impl<const D: usize> Voice<D> {
    /// That of a robot which has said nothing yet.
    pub const SILENCE: Self = Self { price_m: f64::INFINITY, wish_m_s: [0.0; D], capped_m_s: [0.0; D] };
}

impl Moment {
    /// Tick number `tick` of a team that ticks every so many nanoseconds.
    #[must_use]
    pub fn new(tick: u32, period_nanos: u64) -> Self {
        let moment = Self { tick, period_nanos, told: false };
        let told = moment.before().is_some_and(|before| moment.now().is_within(HEARD, before.now()));
        Self { told, ..moment }
    }

    /// The number of the tick.
    #[must_use]
    pub fn tick(&self) -> u32 {
        self.tick
    }

    /// The time.
    #[must_use]
    pub fn now(&self) -> Instant {
        Instant::from_nanos(u64::from(self.tick).saturating_mul(self.period_nanos))
    }

    /// The tick before, if there is one.
    #[must_use]
    pub fn before(&self) -> Option<Self> {
        self.tick.checked_sub(1).map(|tick| Self { tick, told: false, ..*self })
    }

    /// The number of the newest message before those of `tick`.
    pub(super) fn last(tick: u32) -> Number {
        Number(u64::from(tick))
    }
}

impl Bond {
    /// Nothing is known of a neighbour that comes now.
    #[must_use]
    pub fn new(moment: &Moment) -> Self {
        Self { born: moment.tick, listed: NEVER, held: false, promised: false, their: Said::default() }
    }

    /// What is said to the neighbour now.
    #[must_use]
    #[inline]
    pub fn said(&self) -> Said {
        Said { listed: self.listed != NEVER, promised: self.promised }
    }

    /// Takes what the neighbour says.
    #[inline]
    pub fn hear(&mut self, said: Said) {
        self.their = said;
    }

    /// What the neighbour said in the tick before.
    #[must_use]
    pub fn heard(&self) -> Said {
        self.their
    }

    /// The tick in which the neighbour came.
    #[must_use]
    pub fn born(&self) -> u32 {
        self.born
    }

    /// What is held before the messages of `tick`.
    #[inline]
    pub(super) fn hold(&self, tick: u32) -> Hold {
        let acknowledged =
            if self.born < tick.saturating_sub(1) { Moment::last(tick - 1) } else { Number::NONE };
        let entry = Entry { listed: self.their.listed, acknowledged };
        let heard = (self.born < tick).then(|| Word { number: Moment::last(tick), entry });
        let listed_after = (self.listed != NEVER).then(|| Moment::last(self.listed));
        Hold::of(Moment::last(self.born), listed_after, heard, acknowledged)
    }

    /// True if it is counted on, once the messages of this tick are there.
    #[must_use]
    #[inline]
    pub fn is_counted(&self, moment: &Moment) -> bool {
        self.held && self.hold(moment.tick.saturating_add(1)).counts()
    }

    /// True if it has a row, once the messages of this tick are there.
    #[must_use]
    #[inline]
    pub fn is_active(&self, moment: &Moment) -> bool {
        self.hold(moment.tick.saturating_add(1)).is_active()
    }

    /// Makes `slot` that of the neighbour `who`, sensed at `offset_m` (m), before the messages of this tick; `told` is what it said to all in
    /// the tick before.
    pub fn fill<const D: usize>(
        &self,
        slot: &mut Slot<D>,
        deal: &Deal,
        moment: &Moment,
        who: Member,
        offset_m: Vector<D>,
        told: &Voice<D>,
    ) {
        (slot.id, slot.rank, slot.sensed, slot.linked) = (who.id, who.rank, true, true);
        (slot.offset_m, slot.sensed_at, slot.gone_m) = (offset_m, moment.now(), 0.0);
        let peer = &mut slot.peer;
        (peer.hold, peer.held) = (self.hold(moment.tick), self.held);
        (peer.unseen_ticks, peer.vanished, peer.inside) = (0, false, false);
        let (number, promised) = (Moment::last(moment.tick), self.their.promised);
        let head = Head { number, value: None, price_m: told.price_m, wish_m_s: told.wish_m_s };
        let then = moment.before().filter(|_| self.born < moment.tick);
        peer.told = then.map(|then| Told { head, promised, at: then.now() });
        (peer.promised, peer.deal) = (self.promised, *deal);
    }
}

impl<const D: usize> Unseen<D> {
    /// A neighbour that was sensed at `position_m` (m) in the tick before.
    #[must_use]
    pub fn new(moment: &Moment, position_m: Vector<D>) -> Self {
        let sensed_at = moment.before().map_or(Instant::START, |before| before.now());
        Self { position_m, sensed_at, gone_m: 0.0, ticks: 0, vanished: false, inside: false }
    }

    /// Reckons where it is in this tick, in which the robot is at `own_m` (m), as a robot on its own does.
    pub fn reckon(&mut self, moment: &Moment, horizon: &Horizon, own_m: &Vector<D>) {
        let then = moment.before().map_or(Instant::START, |before| before.now());
        self.gone_m += horizon.went_m(moment.now().since(then));
        self.ticks = self.ticks.saturating_add(1);
        self.inside = horizon.surely_holds(&subtract(own_m, &self.position_m), self.gone_m);
        if self.ticks == 1 {
            self.vanished = self.inside;
        }
    }

    /// Makes a slot that [`Bond::fill`] has filled that of a neighbour that is sensed no more.
    pub fn fill(&self, slot: &mut Slot<D>, own_m: &Vector<D>) {
        (slot.sensed, slot.linked, slot.gone_m) = (false, false, self.gone_m);
        (slot.offset_m, slot.sensed_at) = (subtract(own_m, &self.position_m), self.sensed_at);
        let peer = &mut slot.peer;
        (peer.unseen_ticks, peer.vanished, peer.inside) = (self.ticks, self.vanished, self.inside);
    }

    /// From where it was sensed last to a robot at `own_m`, m.
    #[must_use]
    pub fn offset_m(&self, own_m: &Vector<D>) -> Vector<D> {
        subtract(own_m, &self.position_m)
    }

    /// True if the robot reckons with it although it must have been sensed.
    #[must_use]
    pub fn is_missing(&self) -> bool {
        self.vanished
    }

    /// What bounds the move of a robot at `own_m` (m) next to it, of whose bond only whether it is `active` matters.
    #[must_use]
    pub fn beside(&self, own_m: &Vector<D>, active: bool) -> Beside<D> {
        Beside { offset_m: self.offset_m(own_m), gone_m: self.gone_m, sensed: false, active }
    }
}
