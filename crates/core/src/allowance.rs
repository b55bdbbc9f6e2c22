//! The robot under [`Controller::Budget`]: what it senses and hears as rows, and what its answer is worth.

use core::time::Duration;

use crate::budget::knowledge::{Claim, Sighting};
use crate::budget::rows::Memory;
use crate::math::Vector;
use crate::neighbor::Slot;
use crate::params::Controller;
use crate::program::Outcome;
use crate::report::{Mode, Reason};
use crate::robot::Robot;
use crate::time::Instant;

impl<const D: usize> Robot<'_, D> {
    /// What the robot has to tell: Σ a_ij, or the trimmed sum under `budget` with free liars.
    pub(crate) fn own_level(&mut self) -> f64 {
        if self.params.settings().controller == Controller::Composed {
            return self.sensed().fold(0.0, |level, slot| level + slot.link.weight);
        }
        let count = self.see();
        self.params.budget().level(&self.sightings[..count], self.values)
    }

    /// The velocity closest to `desired` (m/s) that keeps every row for a tick of τ₁.
    pub(crate) fn budget_velocity(&mut self, desired: &Vector<D>) -> (Vector<D>, Outcome) {
        let period_s = self.params.settings().level_period.as_secs_f64();
        let count = self.see();
        if count < self.sensed().count() {
            return ([0.0; D], Outcome::Recovering);
        }
        let memory = Memory { rows: self.rows, weights: self.values };
        let desired_m = desired.map(|component| component * period_s);
        let mut rows =
            self.params.budget().rows(&self.sightings[..count], &desired_m, *self.params.reach(), memory);
        let closest = rows.closest();
        let velocity = closest.displacement_m.map(|component| component / period_s);
        let outcome = if rows.broken > 0 { Outcome::Recovering } else { closest.outcome };
        (self.params.settings().input.clip(&velocity), outcome)
    }

    /// Guaranteed as long as nothing that the robot can check speaks against it.
    pub(crate) fn budget_mode(&self, degree_low: bool, outcome: Outcome, h: f64) -> Mode {
        let period = self.params.settings().level_period;
        let late = self.last_tick.is_some_and(|last| self.now.since(last) > period);
        match outcome {
            _ if degree_low => Mode::Degraded(Reason::Degree),
            Outcome::Recovering => Mode::Degraded(Reason::OutsideSafeSet),
            _ if h < 0.0 => Mode::Degraded(Reason::OutsideSafeSet),
            _ if late => Mode::Degraded(Reason::Late),
            _ => Mode::Guaranteed,
        }
    }

    /// Fills the sightings from the slots; gives how many fit.
    fn see(&mut self) -> usize {
        let (now, period) = (self.now, self.params.settings().level_period);
        let sensed = self.slots[..self.count].iter().filter(|slot| slot.sensed);
        let mut count = 0;
        for (sighting, slot) in self.sightings.iter_mut().zip(sensed) {
            *sighting = Sighting { offset_m: slot.offset_m, claim: claim(slot, now, period) };
            count += 1;
        }
        count
    }
}

/// What a neighbour told, with its age in whole ticks, rounded up.
fn claim<const D: usize>(slot: &Slot<D>, now: Instant, period: Duration) -> Option<Claim> {
    let told = slot.told?;
    let ticks = now.since(told.at).as_nanos().div_ceil(period.as_nanos().max(1));
    Some(Claim { level: told.level, age_ticks: u32::try_from(ticks).unwrap_or(u32::MAX) })
}
