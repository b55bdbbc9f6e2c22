//! The decision of a tick under `budget`: velocity, outcome, and the mode that the robot reports.

use core::time::Duration;

use crate::controller::budget::Move;
use crate::controller::budget::knowledge::Claim;
use crate::controller::budget::rows::Rows;
use crate::num::Vector;
use crate::program::Outcome;
use crate::robot::neighbor::RobotId;
use crate::robot::report::{Mode, Reason};
use crate::settings::params::{Params, Settings};

/// The decision of a tick under [`Controller::Budget`](crate::settings::params::Controller::Budget).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision<const D: usize> {
    /// u_i, m/s, inside U_i.
    pub velocity_m_s: Vector<D>,
    /// How the program found it.
    pub outcome: Outcome,
    /// What in this tick speaks against the state.
    pub doubt: Option<Reason>,
}

impl<const D: usize> Params<D> {
    /// How far a velocity of `desired` (m/s) takes the robot while it is held, m.
    #[must_use]
    pub fn desired_m(&self, desired: &Vector<D>) -> Vector<D> {
        desired.map(|component| component * self.hold_s())
    }

    /// The velocity that keeps every row for as long as it may be held. The velocity of the tick before, `before` (m/s), makes
    /// it faster to find, and changes it by no more than rounding.
    #[must_use]
    pub fn decision(&self, rows: &mut Rows<'_, D>, before: &Vector<D>) -> Decision<D> {
        let Move { displacement_m, outcome, doubt } = rows.decide(&self.desired_m(before));
        let velocity = displacement_m.map(|component| component / self.hold_s());
        Decision { velocity_m_s: self.settings().input.clip(&velocity), outcome, doubt }
    }

    /// The mode that robot `id` reports with this `degree` and `h` when `reason`, if any, speaks against the state. It is
    /// `Guaranteed` unless something does.
    #[must_use]
    pub fn mode(&self, id: RobotId, reason: Option<Reason>, degree: u16, h: f64) -> Mode {
        let degree_low = degree < self.budget().need.need(id);
        let exact = self.budget().errors.offset_m == 0.0;
        match reason {
            _ if degree_low => Mode::Degraded(Reason::Degree),
            Some(reason) => Mode::Degraded(reason),
            None if exact && h < 0.0 => Mode::Degraded(Reason::OutsideSafeSet),
            None => Mode::Guaranteed,
        }
    }
}

impl<const D: usize> Settings<D> {
    /// A level told `age` ago as a claim, its age in whole ticks, rounded up. `None` if it is too old, or older than can be
    /// counted: a claim that seemed younger than it is would be discounted too little.
    #[must_use]
    pub fn claim(&self, level: f64, age: Duration) -> Option<Claim> {
        let age_ticks = if age.is_zero() { 0 } else { ticks(age, self.level_period)? };
        (age <= self.told_max).then_some(Claim { level, age_ticks })
    }
}

/// `age` in periods, rounded up. A period that does not fit into 64 bits of nanoseconds counts as shorter than it is, so that
/// the age is greater.
fn ticks(age: Duration, period: Duration) -> Option<u32> {
    let nanos = |span: Duration| u64::try_from(span.as_nanos());
    let period_ns = nanos(period).unwrap_or(u64::MAX).max(1);
    u32::try_from(nanos(age).ok()?.div_ceil(period_ns)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn claims_are_never_younger_than_they_are() {
        let (level_period, told_max) = (Duration::from_nanos(1), Duration::MAX);
        let mut settings = Settings::<2> { level_period, told_max, ..Settings::default() };
        let age = |nanos| settings.claim(7.0, Duration::from_nanos(nanos)).map(|claim| claim.age_ticks);
        let most = u64::from(u32::MAX);
        assert_eq!([0, 1, most].map(age), [Some(0), Some(1), Some(u32::MAX)]);
        assert_eq!([most + 1, u64::MAX].map(age), [None; 2]);
        assert_eq!(settings.claim(7.0, Duration::MAX), None);
        settings.level_period = Duration::MAX;
        let aged = settings.claim(7.0, Duration::from_secs(1)).map(|claim| claim.age_ticks);
        assert_eq!(aged, Some(1));
    }
}
