//! Slots of neighbours in order of their numbers. There are never more of them than were lent.

use crate::controller::links::peer::Peer;
use crate::robot::error::ObserveError;
use crate::robot::neighbor::{RobotId, Slot};
use crate::robot::report::Reason;
use crate::robot::{Robot, Slots};

impl<const D: usize, S: Slots<D>> Robot<D, S> {
    /// Where the slot of `id` is. If it has none, one is made at its place in the order. When all slots are taken, that of a
    /// robot that was not yet sensed in this tick is given up.
    pub(crate) fn slot(&mut self, id: RobotId) -> Result<usize, ObserveError> {
        if let Some(index) = self.find(id) {
            return Ok(index);
        }
        if self.count == self.slots.as_ref().len() {
            let unsensed = self
                .neighbors()
                .iter()
                .rposition(|slot| !slot.sensed && !self.stays(slot))
                .ok_or(ObserveError::Full)?;
            self.slots.as_mut().copy_within(unsensed + 1..self.count, unsensed);
            self.count -= 1;
        }
        let index = self.neighbors().partition_point(|slot| slot.id < id);
        let (slots, last) = (self.slots.as_mut(), self.ledger.numbers.last());
        slots.copy_within(index..self.count, index + 1);
        slots[index] = Slot { id, peer: Peer::new(last), ..Slot::default() };
        self.count += 1;
        Ok(index)
    }

    /// True if a robot keeps its slot although it is not sensed.
    fn stays(&self, slot: &Slot<D>) -> bool {
        self.params.controller().keeps_unseen(slot)
    }

    /// The slot of `id`, if it has one. As a rule it is the one after that found last, because robots come in order.
    pub(crate) fn find(&mut self, id: RobotId) -> Option<usize> {
        let next = if self.next < self.count { self.next } else { 0 };
        let slots = self.neighbors();
        let index = match slots.get(next) {
            Some(slot) if slot.id == id => next,
            _ => slots.binary_search_by_key(&id, |slot| slot.id).ok()?,
        };
        self.next = index + 1;
        Some(index)
    }

    /// A robot seen out of range is not a neighbour, whatever was observed before.
    pub(crate) fn lose(&mut self, id: RobotId) {
        if let Some(index) = self.find(id) {
            let slot = &mut self.slots.as_mut()[index];
            (slot.sensed, slot.peer) = (false, Peer::new(self.ledger.numbers.last()));
        }
    }

    /// Frees the slots of robots that were not sensed in this tick, but for those that stay.
    pub(crate) fn forget_unsensed(&mut self) {
        let mut kept = 0;
        for index in 0..self.count {
            let slot = &self.slots.as_ref()[index];
            let stays = !slot.sensed && self.stays(slot);
            if !slot.sensed && !stays && self.params.controller().misses(slot) {
                self.assurance.note(self.now, Reason::Unseen);
            }
            let slots = self.slots.as_mut();
            if slots[index].sensed || stays {
                if kept < index {
                    slots[kept] = slots[index];
                }
                kept += 1;
            }
        }
        self.count = kept;
    }
}
