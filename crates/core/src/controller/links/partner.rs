//! A neighbour as the rule who releases whom looks at it, and what the rule may change. A robot on its own has a slot for each; whoever
//! computes a large team has less ([`bond`](crate::controller::links::bond)).

use core::time::Duration;

use crate::controller::links::Links;
use crate::controller::links::cut::Room;
use crate::controller::links::deal::{Deal, Look};
use crate::controller::links::peer::Told;
use crate::controller::links::protocol::Number;
use crate::id::Member;
use crate::need::Need;
use crate::num::Vector;
use crate::robot::neighbor::Slot;
use crate::time::Instant;

/// What was told longer ago does not count.
pub(super) const HEARD: Duration = Duration::from_secs(1);

/// What a neighbour has to offer, as it told it last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Offer<const D: usize> {
    /// How far apart two robots must end for a promise of it, m.
    pub(crate) price_m: f64,
    /// Where it wants to go, m/s, no faster than a robot can go.
    pub(crate) wish_m_s: Vector<D>,
    /// True if it promises a release.
    pub(crate) promised: bool,
}

/// A neighbour of which the rule asks.
pub(crate) trait Partner<const D: usize> {
    /// Which robot it is.
    fn member(&self) -> Member;
    /// Whether it counts for the robot `own`, and whether `own` counts for it.
    fn counts_with(&self, own: Member, need: &Need) -> [bool; 2] {
        [need.counts(own, self.member()), need.counts(self.member(), own)]
    }
    /// x_i − x_j, m, as sensed last.
    fn offset_m(&self) -> &Vector<D>;
    /// True if it is sensed in this tick.
    fn is_sensed(&self) -> bool;
    /// For how many ticks it has not been sensed.
    fn unseen_ticks(&self) -> u32;
    /// How far it can have gone since it was sensed last, m.
    fn gone_m(&self) -> f64;
    /// How much room the link to it has beside what would cut it.
    fn room(&self) -> Room {
        Room::OPEN
    }
    /// True if it was sensed no longer than `most` before `now`.
    fn was_sensed_within(&self, most: Duration, now: Instant) -> bool;
    /// What it told, if it is [`HEARD`] of at `now`.
    fn told(&self, links: &Links, now: Instant) -> Option<Offer<D>>;

    /// True if it has acknowledged a message since it is listed.
    fn acknowledges(&self) -> bool;
    /// True if it is listed.
    fn is_listed(&self) -> bool;
    /// True if it has let go of the robot.
    fn is_released(&self) -> bool;
    /// True if it lists the robot.
    fn lists(&self) -> bool;
    /// Lists it from the next message on, after the message `last`.
    fn list(&mut self, last: Number);
    /// Stops listing it, and counting on it.
    fn release(&mut self);

    /// True while it is counted on, once it was certainly within the held radius.
    fn is_held(&self) -> bool;
    /// Notes whether it is.
    fn hold(&mut self, held: bool);
    /// True if it is promised a release.
    fn is_promised(&self) -> bool;
    /// Promises it one, or none.
    fn promise(&mut self, promised: bool);
    /// What was agreed on with it.
    fn deal(&self) -> &Deal;
    /// Gives what was agreed on with it, to be changed.
    fn deal_mut(&mut self) -> &mut Deal;
    /// What came of the look at it in this tick.
    fn look(&self) -> &Look;
    /// Gives what came of the look at it, to be changed.
    fn look_mut(&mut self) -> &mut Look;

    /// True if it is counted on and within the held radius.
    fn is_counted(&self) -> bool {
        self.is_held() && self.acknowledges()
    }
}

impl<const D: usize> Partner<D> for Slot<D> {
    fn room(&self) -> Room {
        self.room
    }

    fn member(&self) -> Member {
        self.member()
    }

    fn offset_m(&self) -> &Vector<D> {
        &self.offset_m
    }

    fn is_sensed(&self) -> bool {
        self.sensed
    }

    fn unseen_ticks(&self) -> u32 {
        self.peer.unseen_ticks
    }

    fn gone_m(&self) -> f64 {
        self.gone_m
    }

    fn was_sensed_within(&self, most: Duration, now: Instant) -> bool {
        now.is_within(most, self.sensed_at)
    }

    fn told(&self, links: &Links, now: Instant) -> Option<Offer<D>> {
        let Told { head, promised, .. } = *self.peer.told_within(now, HEARD)?;
        Some(Offer { price_m: head.price_m, wish_m_s: links.capped(&head.wish_m_s), promised })
    }

    fn acknowledges(&self) -> bool {
        self.peer.hold.counts()
    }

    fn is_listed(&self) -> bool {
        self.peer.hold.is_listed()
    }

    fn is_released(&self) -> bool {
        self.peer.hold.is_released()
    }

    fn lists(&self) -> bool {
        self.peer.hold.lists()
    }

    fn list(&mut self, last: Number) {
        self.peer.hold.list(last);
    }

    fn release(&mut self) {
        self.peer.hold.release();
    }

    fn is_held(&self) -> bool {
        self.peer.held
    }

    fn hold(&mut self, held: bool) {
        self.peer.held = held;
    }

    fn is_promised(&self) -> bool {
        self.peer.promised
    }

    fn promise(&mut self, promised: bool) {
        self.peer.promised = promised;
    }

    fn deal(&self) -> &Deal {
        &self.peer.deal
    }

    fn deal_mut(&mut self) -> &mut Deal {
        &mut self.peer.deal
    }

    fn look(&self) -> &Look {
        &self.peer.look
    }

    fn look_mut(&mut self) -> &mut Look {
        &mut self.peer.look
    }
}
