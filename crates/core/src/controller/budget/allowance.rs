//! The robot under [`Controller::Budget`]: it turns what it senses and hears into sightings, and asks for rows.

use crate::controller::budget::knowledge::{Claim, Sighting};
use crate::controller::budget::rows::Memory;
use crate::num::Vector;
use crate::program::Outcome;
use crate::robot::Robot;
use crate::robot::neighbor::Slot;
use crate::robot::report::{Mode, Reason};
use crate::settings::params::{Controller, Settings};
use crate::time::Instant;

impl<const D: usize> Robot<'_, D> {
    /// The level that the robot has to tell: Σ a_ij, or the trimmed sum under `budget` with free liars.
    pub(crate) fn own_level(&mut self) -> f64 {
        if self.params.settings().controller == Controller::Composed || self.params.budget().is_plain() {
            return self.linked().fold(0.0, |level, slot| level + slot.link.weight);
        }
        let count = self.see();
        self.params.budget().level(self.id, &self.sightings[..count], self.values)
    }

    /// The velocity closest to `desired` (m/s) that keeps every row for as long as it may be held.
    pub(crate) fn budget_velocity(&mut self, desired: &Vector<D>) -> (Vector<D>, Outcome) {
        let count = self.see();
        if count < self.sensed().count() {
            self.assurance.doubt(self.now, Some(Reason::OutsideSafeSet));
            return ([0.0; D], Outcome::Recovering);
        }
        let memory = Memory { rows: self.rows, weights: self.values };
        let desired_m = self.params.desired_m(desired);
        let mut rows = self.params.budget().rows(
            self.id,
            &self.sightings[..count],
            &desired_m,
            *self.params.reach(),
            memory,
        );
        let decision = self.params.decision(&mut rows, &self.before);
        self.before = decision.velocity_m_s;
        self.assurance.doubt(self.now, decision.doubt);
        (decision.velocity_m_s, decision.outcome)
    }

    /// The mode is `Guaranteed` as long as nothing that the robot can check speaks against it.
    pub(crate) fn budget_mode(&self, degree: u16, h: f64) -> Mode {
        let reason = self.assurance.reason(self.now, self.params.settings().told_max);
        self.params.mode(self.id, reason, degree, h)
    }

    /// Fills the sightings from the slots, and returns how many fit.
    fn see(&mut self) -> usize {
        let (settings, mut count) = (self.params.settings(), 0);
        let latest = self.now.after(settings.clock_error);
        let sensed = self.slots[..self.count].iter().filter(|slot| slot.sensed);
        for (sighting, slot) in self.sightings.iter_mut().zip(sensed) {
            let claim = claim(slot, latest, settings);
            *sighting = Sighting { id: slot.id, offset_m: slot.offset_m, position_m: slot.position_m, claim };
            count += 1;
        }
        count
    }
}

/// What a neighbour told; `None` if it seems to come from the future.
fn claim<const D: usize>(slot: &Slot<D>, latest: Instant, settings: &Settings<D>) -> Option<Claim> {
    let told = slot.told?;
    settings.claim(told.level, latest.checked_since(told.stamp)?)
}
