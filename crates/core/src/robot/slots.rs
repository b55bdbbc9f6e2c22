//! Slots of neighbours in order of their numbers. There are never more of them than were lent.

use crate::controller::links::peer::Peer;
use crate::num::Vector;
use crate::robot::error::ObserveError;
use crate::robot::neighbor::{Member, RobotId, Slot};
use crate::robot::report::Reason;
use crate::robot::{Robot, Slots};

impl<const D: usize, S: Slots<D>> Robot<D, S> {
    /// Where the slot of `id` is. If it has none, one is made at its place in the order. When all slots are taken, that of the
    /// farthest robot that was not yet sensed in this tick is given up.
    pub(crate) fn slot(&mut self, id: RobotId) -> Result<usize, ObserveError> {
        if let Some(index) = self.find(id) {
            return Ok(index);
        }
        if self.count == self.slots.as_ref().len() {
            let unsensed = self.farthest_unsensed().ok_or(ObserveError::Full)?;
            self.slots.as_mut().copy_within(unsensed + 1..self.count, unsensed);
            self.count -= 1;
        }
        let index = self.everybody().partition_point(|slot| slot.id < id);
        let (slots, last) = (self.slots.as_mut(), self.ledger.numbers.last());
        slots.copy_within(index..self.count, index + 1);
        slots[index] = Slot { id, peer: Peer::new(last), ..Slot::default() };
        self.count += 1;
        Ok(index)
    }

    /// True if a robot keeps its slot although it is not sensed.
    pub(crate) fn stays(&self, slot: &Slot<D>) -> bool {
        self.params.controller().keeps_unseen(slot)
    }

    /// The slot of `id`, if it has one. As a rule it is the one after that found last, because robots come in order.
    pub(crate) fn find(&mut self, id: RobotId) -> Option<usize> {
        let next = if self.next < self.count { self.next } else { 0 };
        let slots = self.everybody();
        let index = match slots.get(next) {
            Some(slot) if slot.id == id => next,
            _ => slots.binary_search_by_key(&id, |slot| slot.id).ok()?,
        };
        self.next = index + 1;
        Some(index)
    }

    /// A robot seen out of range at `offset_m` is not sensed as a neighbour, whatever was observed before.
    pub(crate) fn lose(&mut self, id: RobotId, offset_m: &Vector<D>) {
        let Some(index) = self.find(id) else { return };
        let slot = &mut self.slots.as_mut()[index];
        if slot.seen_before && self.params.controller().promises() {
            self.assurance.watch(&self.params, self.now, slot, offset_m);
        }
        (slot.sensed, slot.peer) = (false, Peer::new(self.ledger.numbers.last()));
    }

    /// The robot of this number has left the plane: whoever owns this one knows, for instance because it carried the other away.
    /// All that is held of it is forgotten, so that it is not taken for [`missing`](crate::robot::missing). If it is observed again it
    /// is a neighbour as any other. This is trusted as positions are: nothing that a neighbour tells is a reason to call it.
    //= theory sec:departures
    pub fn dismiss(&mut self, id: RobotId) {
        self.keep(|slot| slot.id != id);
    }

    /// Keeps the slots for which `keep` says so.
    pub(crate) fn keep(&mut self, mut keep: impl FnMut(&mut Slot<D>) -> bool) {
        let (mut kept, slots) = (0, self.slots.as_mut());
        for index in 0..self.count {
            if keep(&mut slots[index]) {
                if kept < index {
                    slots[kept] = slots[index];
                }
                kept += 1;
            }
        }
        self.count = kept;
    }

    /// Frees the slots of robots that were not sensed in this tick, but for those that stay.
    pub(crate) fn forget_unsensed(&mut self) {
        let (controller, mut missed) = (*self.params.controller(), false);
        self.keep(|slot| {
            let stays = slot.sensed || controller.keeps_unseen(slot);
            missed |= !stays && controller.misses(slot);
            stays
        });
        if missed {
            self.assurance.note(self.now, Reason::Overlooked);
        }
    }

    /// The robot as the roster has it.
    #[must_use]
    pub fn member(&self) -> Member {
        Member { id: self.id, rank: self.rank }
    }

    /// True if the robot holds anything of this one: whatever comes from others is refused.
    #[must_use]
    pub fn knows(&self, id: RobotId) -> bool {
        self.place(id).is_some()
    }

    /// The slot of the neighbour `id`, if it has one. In a team in which everybody sees everybody it is the one at its number.
    pub(crate) fn place(&self, id: RobotId) -> Option<usize> {
        let (neighbors, likely) =
            (self.neighbors(), usize::from(id.0).wrapping_sub(1 + usize::from(id > self.id)));
        match neighbors.get(likely) {
            Some(slot) if slot.id == id => Some(likely),
            _ => neighbors.binary_search_by_key(&id, |slot| slot.id).ok(),
        }
    }

    /// True if this neighbour counts for the robot.
    #[must_use]
    pub fn counts(&self, slot: &Slot<D>) -> bool {
        self.params.need().counts(self.member(), slot.member())
    }

    /// True if the robot takes the value of this neighbour in a consensus round.
    #[must_use]
    pub fn listens_to(&self, slot: &Slot<D>) -> bool {
        self.params.listens_to_all() || self.counts(slot)
    }

    /// How many neighbours the robot can have.
    #[must_use]
    pub fn slot_count(&self) -> usize {
        self.slots.as_ref().len()
    }

    /// Gives the robot another number of slots, for whoever can. Those at the front stay as they are; neighbours whose slots are taken
    /// away are forgotten.
    pub fn change_slots(&mut self, change: impl FnOnce(&mut S)) {
        change(&mut self.slots);
        self.count = self.count.min(self.slots.as_ref().len());
    }

    /// The neighbours in order of their number, those of the own team alone.
    //= theory sec:strangers
    #[must_use]
    pub fn neighbors(&self) -> &[Slot<D>] {
        &self.everybody()[..self.members()]
    }

    /// The robots of other teams that were observed, in order of their number.
    #[must_use]
    pub fn strangers(&self) -> &[Slot<D>] {
        &self.everybody()[self.members()..]
    }

    /// All who have a slot.
    pub(crate) fn everybody(&self) -> &[Slot<D>] {
        &self.slots.as_ref()[..self.count]
    }

    /// How many slots the own team has. They come first, because others have higher numbers.
    pub(crate) fn members(&self) -> usize {
        match self.everybody().last() {
            Some(last) if !self.is_member(last.id) => {
                self.everybody().partition_point(|slot| self.is_member(slot.id))
            }
            _ => self.count,
        }
    }

    /// True if the own team has a robot of this number.
    pub(crate) fn is_member(&self, id: RobotId) -> bool {
        (1..=self.params.settings().team.robots).contains(&id.0)
    }

    /// The slot of `sender`, if it has one and is of the own team: nobody listens to others.
    //= theory sec:strangers
    pub(crate) fn find_member(&mut self, sender: RobotId) -> Option<usize> {
        self.find(sender).filter(|_| self.is_member(sender))
    }

    pub(crate) fn sensed(&self) -> impl Iterator<Item = &Slot<D>> + Clone {
        self.neighbors().iter().filter(|slot| slot.sensed)
    }

    /// The sensed neighbours within R. Without stated errors these are all sensed neighbours.
    pub(crate) fn linked(&self) -> impl Iterator<Item = &Slot<D>> + Clone {
        self.sensed().filter(|slot| slot.linked)
    }
}
