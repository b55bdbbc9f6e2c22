//! What a robot with held links does beside all others: lists in its messages, and neighbours that it does not sense.

use crate::controller::links::protocol::{Entry, Word};
use crate::controller::links::wire::{Head, Item, LinkMessage, Notice, VERSION};
use crate::equations::link::Link;
use crate::message::{Message, MessageError};
use crate::num::{Vector, subtract};
use crate::robot::error::ReceiveError;
use crate::robot::neighbor::{NO_LINK, RobotId, Slot, Told};
use crate::robot::{Robot, Slots};
use crate::time::Instant;

impl<const D: usize, S: Slots<D>> Robot<D, S> {
    /// Writes `message`, which [`share`](Self::share) returned in this tick, as it goes out, and gives its length: 32 bytes, or
    /// under `links` as many as [`bytes_max`](crate::controller::links::wire::bytes_max) at most. `None` if `bytes` is too short.
    pub fn encode(&self, message: &Message, bytes: &mut [u8]) -> Option<usize> {
        if self.params.controller().tells_lists() {
            let head = Head { value: message.value(), ..self.ledger.head? };
            return head.encode(self.neighbors().iter().map(|slot| slot.peer.item(slot.id)), bytes);
        }
        let encoded = message.encode();
        bytes.get_mut(..encoded.len())?.copy_from_slice(&encoded);
        Some(encoded.len())
    }

    /// Takes the bytes of a message that arrived from `sender`, of the kind that robots with its controller tell.
    pub fn receive_bytes(&mut self, sender: RobotId, bytes: &[u8]) -> Result<(), ReceiveError> {
        if self.params.controller().tells_lists() {
            let message = LinkMessage::parse(bytes).map_err(ReceiveError::Bytes)?;
            return self.receive_notice(sender, &message.to(self.id));
        }
        self.receive(sender, &Message::parse(bytes).map_err(ReceiveError::Bytes)?)
    }

    /// Takes what a message that arrived from `sender` says to this robot.
    pub fn receive_notice(&mut self, sender: RobotId, notice: &Notice<D>) -> Result<(), ReceiveError> {
        if !self.params.controller().tells_lists() {
            return Err(ReceiveError::Bytes(MessageError::Version(VERSION)));
        }
        let index = self.find(sender).ok_or(ReceiveError::NotNeighbor)?;
        let (now, stamp) = (self.now, Instant::from_nanos(notice.head.number.0));
        let in_round = notice.head.value.is_some() && self.in_round(stamp);
        let (slot, last) = (&mut self.slots.as_mut()[index], self.ledger.numbers.last());
        if !slot.peer.hear(notice, last, now) {
            return Err(ReceiveError::Stale);
        }
        // A value counts only if its sender is a neighbour in this tick.
        let earlier = slot.told.and_then(|told| told.value);
        let value = earlier.or(notice.head.value.filter(|_| in_round && slot.sensed));
        slot.told = Some(Told { sequence: 0, stamp, level: None, at: now, value });
        self.round_news |= value != earlier;
        Ok(())
    }

    /// What `message`, which [`share`](Self::share) returned in this tick, says to robot `to`: what [`encode`](Self::encode) and
    /// [`LinkMessage::to`] come to, without bytes. `None` unless the robot tells lists.
    #[must_use]
    pub fn notice(&self, message: &Message, to: RobotId) -> Option<Notice<D>> {
        let head = Head { value: message.value(), ..self.ledger.head? };
        let slot = self.neighbors().binary_search_by_key(&to, |slot| slot.id).ok();
        let (entry, promised) = slot.map_or((Entry::default(), false), |index| {
            let Item { entry, promised, .. } = self.neighbors()[index].peer.item(to);
            (entry, promised)
        });
        Some(Notice { head, word: Word { number: head.number, entry }, promised })
    }

    /// True if the robot reckons with a neighbour that it does not sense although it cannot have left.
    pub fn misses_somebody(&self) -> bool {
        let controller = self.params.controller();
        self.neighbors().iter().any(|slot| !slot.sensed && controller.misses(slot))
    }

    /// The link of this squared length, m²; `None` beyond R. Who keeps lists has no use for its weight.
    pub(crate) fn link_at(&self, distance_m2: f64) -> Option<Link<f64>> {
        let shape = self.params.link();
        if self.params.controller().tells_lists() {
            return (distance_m2 <= shape.radius_m * shape.radius_m).then_some(NO_LINK);
        }
        shape.link_at(distance_m2)
    }

    /// Keeps the row for every neighbour from now on, whatever was agreed.
    ///
    /// A robot that says what is so never needs this. It is how the world makes a robot malicious that acknowledges what it did not
    /// receive: it is assumed to obey the rows of those whose list it has acknowledged.
    pub fn oblige(&mut self) {
        self.ledger.obliged = true;
    }

    /// Where the robot wants to go, m/s, as it tells it under `links`.
    #[must_use]
    pub fn wish_m_s(&self) -> &Vector<D> {
        &self.ledger.wish_m_s
    }

    /// For whom the robot keeps its row, under `links`, among those that have a slot.
    pub fn keeps_rows_for(&self) -> impl Iterator<Item = RobotId> + Clone {
        let obliged = self.ledger.obliged;
        let keeps = move |slot: &&Slot<D>| obliged || slot.peer.hold.is_active();
        self.neighbors().iter().filter(keeps).map(|slot| slot.id)
    }

    /// Reckons where neighbours are that keep their slots although they are not sensed: where they were sensed last, with an
    /// error as large as they can have gone since ([`missing`](crate::robot::missing)). What they tell of their value does not count.
    //= theory sec:unsensed
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
