//! What a robot tells, and what it is told: levels and values, or lists of links, as messages and as bytes.

use crate::controller::links::protocol::{Entry, Word};
use crate::controller::links::wire::{self, Head, Item, LinkMessage, Notice};
use crate::message::{Message, MessageError, VERSION};
use crate::num::Vector;
use crate::obstacle::{Obstacle, is_cut};
use crate::robot::error::ReceiveError;
use crate::robot::neighbor::{Member, NO_LINK, RobotId, Slot, Told};
use crate::robot::scratch::Scratch;
use crate::robot::{Robot, Slots};
use crate::time::Instant;

impl<const D: usize, S: Slots<D>> Robot<D, S> {
    /// What to tell now: the level when τ₁ has passed, if the controller tells levels, and the value when τ₂ has.
    ///
    /// A robot that is late for a round by more than a velocity may be held, as after a crash, waits for the next one, so that all
    /// have theirs at the same time. Robots that were not observed in this tick are forgotten, but for those that are missing
    /// ([`missing`](crate::robot::missing)).
    ///
    /// `None` while nothing is due, the own position is unknown, or `scratch` is too short for the robot.
    //= paper eq:connectivity
    pub fn share(&mut self, scratch: &mut Scratch<'_, D>) -> Option<Message> {
        self.position.filter(|_| scratch.is_for(self.slots.as_ref().len()))?;
        self.reckon();
        self.settle();
        self.part(scratch.map);
        let level_due = self.level_timer.fires(self.now);
        let value_due = self.value_timer.fires_in_turn(self.now, self.params.settings().clock.hold_max());
        if level_due {
            let members = self.members();
            let (controller, slots) = (self.params.controller(), &mut self.slots.as_mut()[..members]);
            controller.agree(
                Member { id: self.id, rank: self.rank },
                &mut self.ledger,
                slots,
                self.now,
                scratch,
            );
            self.level = self.params.controller().level(&self.view(), scratch);
            self.level_at = self.now;
            self.told_level = self.level;
        }
        if value_due {
            self.begin_round();
        }
        let controller = self.params.controller();
        let (levels, lists) = (controller.tells_levels(), controller.tells_lists());
        if !value_due && !(level_due && (levels || lists)) {
            return None;
        }
        let value = value_due.then_some(self.value);
        if lists {
            self.ledger.head(self.now, value)?;
        }
        self.sequence = self.sequence.saturating_add(1);
        let level = (levels || lists).then_some(self.told_level);
        Message::new(self.sequence, self.level_at, level, value).ok()
    }

    /// Takes the links away that something of `map` cuts, as sensed.
    //= theory sec:cut
    fn part(&mut self, map: &[Obstacle<D>]) {
        let Some(own) = self.position.filter(|_| map.iter().any(|obstacle| obstacle.cuts_links)) else {
            return;
        };
        for slot in &mut self.slots.as_mut()[..self.count] {
            if slot.linked && is_cut(map, &own, &slot.position_m) {
                (slot.linked, slot.link) = (false, NO_LINK);
            }
        }
    }

    /// Takes a message that arrived from `sender`. Under `links` messages are of another kind ([`receive_bytes`](Self::receive_bytes)).
    pub fn receive(&mut self, sender: RobotId, message: &Message) -> Result<(), ReceiveError> {
        if self.params.controller().tells_lists() {
            return Err(ReceiveError::Bytes(MessageError::Version(VERSION)));
        }
        let (now, stamp) = (self.now, message.stamp());
        let in_round = message.value().is_some() && self.in_round(stamp);
        let index = self.find_member(sender).ok_or(ReceiveError::NotNeighbor)?;
        let slot = &mut self.slots.as_mut()[index];
        if !slot.sensed && !slot.is_missing() {
            return Err(ReceiveError::NotNeighbor);
        }
        let sequence = message.sequence();
        if slot.told.is_some_and(|told| (stamp, sequence) <= (told.stamp, told.sequence)) {
            return Err(ReceiveError::Stale);
        }
        let earlier = slot.told.and_then(|told| told.value);
        let value = earlier.or(message.value().filter(|_| in_round));
        slot.told = Some(Told { sequence, stamp, level: message.level(), at: now, value });
        self.round_news |= value != earlier;
        Ok(())
    }

    /// Replaces the level that the robot holds and tells, until the next update.
    ///
    /// A robot that follows eq:connectivity never needs this. It is how the world makes a robot malicious in the sense
    /// of `misbeh`: by Assumption 1 such a robot uses its false `c_i` in its own row too. Ignored unless finite.
    pub fn restate(&mut self, level: f64) {
        if level.is_finite() {
            self.told_level = level;
        }
    }

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
            return Err(ReceiveError::Bytes(MessageError::Version(wire::VERSION)));
        }
        let index = self.find_member(sender).ok_or(ReceiveError::NotNeighbor)?;
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
        let slot = self.place(to);
        let (entry, promised) = slot.map_or((Entry::default(), false), |index| {
            let Item { entry, promised, .. } = self.neighbors()[index].peer.item(to);
            (entry, promised)
        });
        Some(Notice { head, word: Word { number: head.number, entry }, promised })
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

    /// Whom the robot counts on, under `links`: neighbours that keep the link to it as it keeps the link to them.
    pub fn counted(&self) -> impl Iterator<Item = RobotId> + Clone {
        self.neighbors().iter().filter(|slot| slot.peer.is_counted()).map(|slot| slot.id)
    }
}
