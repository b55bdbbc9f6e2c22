//! A consensus round as the robot lives it: values told since it began, W-MSR as soon as they are there.

use crate::robot::neighbor::{Slot, Told};
use crate::robot::report::{RoundReport, small};
use crate::robot::{Robot, Slots};
use crate::time::Instant;
use crate::wmsr;

impl<const D: usize, S: Slots<D>> Robot<D, S> {
    /// Takes up the value of the last round and forgets what was told in it.
    pub(crate) fn begin_round(&mut self) {
        self.value = self.next_value;
        (self.round, self.round_news) = (Some(self.now), true);
        for slot in &mut self.slots.as_mut()[..self.count] {
            slot.discarded = false;
            slot.told = slot.told.map(|told| Told { value: None, ..told });
        }
    }

    /// True for a value told since the round began, as far as clocks agree. A value is told with the last level, which may
    /// be τ₁ older.
    pub(crate) fn in_round(&self, stamp: Instant) -> bool {
        let clock = &self.params.settings().clock;
        let latest = stamp.after(clock.error).after(clock.level_period);
        self.round.is_some_and(|began| latest > began)
    }

    /// Runs the rule of consensus on what was told since the round began, and again when more came late. A value that comes after the next
    /// round began is not used.
    pub(crate) fn end_round(&mut self, values: &mut [f64]) -> Option<RoundReport> {
        if !core::mem::take(&mut self.round_news) {
            return None;
        }
        let (mut heard, mut others) = (0, 0);
        for slot in self.neighbors().iter().filter(|slot| self.listens_to(slot)) {
            others += 1;
            if let Some(value) = slot.told_value() {
                values[heard] = value;
                heard += 1;
            }
        }
        let settings = self.params.settings();
        let round = settings.consensus.update(self.value, &mut values[..heard], settings.team.faults);
        self.mark_discarded(&round);
        self.next_value = round.value;
        Some(RoundReport {
            kept: small(round.kept),
            discarded: small(round.below + round.above),
            silent: small(others - heard),
        })
    }

    /// Marks the neighbours whose values were discarded. Of equal values at an edge, those of the lowest numbers are marked.
    fn mark_discarded(&mut self, round: &wmsr::Round) {
        let (need, own, all) = (*self.params.need(), self.member(), self.params.listens_to_all());
        let taken = |slot: &Slot<D>| {
            let listens = all || need.counts(own, slot.member());
            slot.told_value().filter(|_| listens)
        };
        let values = |slots: &[Slot<D>], beyond: fn(f64, f64) -> bool, edge: f64| {
            slots.iter().filter(|slot| taken(slot).is_some_and(|value| beyond(value, edge))).count()
        };
        let slots = &mut self.slots.as_mut()[..self.count];
        let mut low_ties = round.below.saturating_sub(values(slots, |value, edge| value < edge, round.low));
        let mut high_ties = round.above.saturating_sub(values(slots, |value, edge| value > edge, round.high));
        for slot in slots {
            // Who has not told a value, or whose value does not count any more, is silent.
            slot.discarded = taken(slot).is_some_and(|value| {
                value < round.low
                    || value > round.high
                    || (value == round.low && take_one(&mut low_ties))
                    || (value == round.high && take_one(&mut high_ties))
            });
        }
    }
}

fn take_one(left: &mut usize) -> bool {
    let some = *left > 0;
    *left = left.saturating_sub(1);
    some
}
