//! The robot under [`Controller::Budget`]: what it senses and hears as rows, and what its answer is worth.

use core::time::Duration;

use crate::budget::knowledge::{Claim, Sighting};
use crate::budget::rows::Memory;
use crate::math::Vector;
use crate::neighbor::Slot;
use crate::params::{Controller, Settings};
use crate::program::Outcome;
use crate::report::{Mode, Reason};
use crate::robot::Robot;
use crate::time::Instant;

impl<const D: usize> Robot<'_, D> {
    /// What the robot has to tell: Σ a_ij, or the trimmed sum under `budget` with free liars.
    pub(crate) fn own_level(&mut self) -> f64 {
        if self.params.settings().controller == Controller::Composed || self.params.budget().is_plain() {
            return self.linked().fold(0.0, |level, slot| level + slot.link.weight);
        }
        let count = self.see();
        self.params.budget().level(&self.sightings[..count], self.values)
    }

    /// The velocity closest to `desired` (m/s) that keeps every row for as long as it may be held.
    pub(crate) fn budget_velocity(&mut self, desired: &Vector<D>) -> (Vector<D>, Outcome) {
        let hold_s = self.params.settings().hold_max().as_secs_f64();
        let count = self.see();
        if count < self.sensed().count() {
            self.assurance.doubt(self.now, Some(Reason::OutsideSafeSet));
            return ([0.0; D], Outcome::Recovering);
        }
        let memory = Memory { rows: self.rows, weights: self.values };
        let desired_m = desired.map(|component| component * hold_s);
        let mut rows =
            self.params.budget().rows(&self.sightings[..count], &desired_m, *self.params.reach(), memory);
        let closest = rows.closest();
        let doubt = match (rows.broken, rows.doubtful) {
            (0, 0) => None,
            (0, _) => Some(Reason::Uncertain),
            _ => Some(Reason::OutsideSafeSet),
        };
        let outcome = if rows.broken > 0 { Outcome::Recovering } else { closest.outcome };
        self.assurance.doubt(self.now, doubt);
        let velocity = closest.displacement_m.map(|component| component / hold_s);
        (self.params.settings().input.clip(&velocity), outcome)
    }

    /// Guaranteed as long as nothing that the robot can check speaks against it.
    pub(crate) fn budget_mode(&self, degree_low: bool, h: f64) -> Mode {
        let exact = self.params.budget().margin.offset_m == 0.0;
        match self.assurance.reason(self.now, self.params.settings().told_max) {
            _ if degree_low => Mode::Degraded(Reason::Degree),
            Some(reason) => Mode::Degraded(reason),
            None if exact && h < 0.0 => Mode::Degraded(Reason::OutsideSafeSet),
            None => Mode::Guaranteed,
        }
    }

    /// Fills the sightings from the slots; gives how many fit.
    fn see(&mut self) -> usize {
        let (settings, mut count) = (self.params.settings(), 0);
        let latest = self.now.after(settings.clock_error);
        let sensed = self.slots[..self.count].iter().filter(|slot| slot.sensed);
        for (sighting, slot) in self.sightings.iter_mut().zip(sensed) {
            *sighting = Sighting { offset_m: slot.offset_m, claim: claim(slot, latest, settings) };
            count += 1;
        }
        count
    }
}

/// What a neighbour told, with its age at `latest` in whole ticks, rounded up; nothing if it is too old, or from later.
fn claim<const D: usize>(slot: &Slot<D>, latest: Instant, settings: &Settings<D>) -> Option<Claim> {
    let told = slot.told?;
    let age = latest.checked_since(told.stamp)?;
    let age_ticks = if age.is_zero() { 0 } else { ticks(age, settings.level_period) };
    (age <= settings.told_max).then_some(Claim { level: told.level, age_ticks })
}

fn ticks(age: Duration, period: Duration) -> u32 {
    let nanos = |span: Duration| u64::try_from(span.as_nanos()).unwrap_or(u64::MAX);
    u32::try_from(nanos(age).div_ceil(nanos(period).max(1))).unwrap_or(u32::MAX)
}
