//! What the rows of `budget` come to: velocity, outcome and what the answer is worth.

use core::time::Duration;

use crate::controller::budget::knowledge::Claim;
use crate::controller::budget::rows::Rows;
use crate::num::Vector;
use crate::program::Outcome;
use crate::robot::report::{Mode, Reason};
use crate::settings::params::{Params, Settings};

/// The answer to a tick under [`Controller::Budget`](crate::settings::params::Controller::Budget).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer<const D: usize> {
    /// u_i, m/s, inside U_i.
    pub velocity_m_s: Vector<D>,
    /// How it came about.
    pub outcome: Outcome,
    /// What in this tick speaks against the state.
    pub doubt: Option<Reason>,
}

impl<const D: usize> Params<D> {
    /// How far `desired` (m/s) goes while a velocity is held, m.
    #[must_use]
    pub fn desired_m(&self, desired: &Vector<D>) -> Vector<D> {
        desired.map(|component| component * self.hold_s())
    }

    /// The velocity that keeps every row for as long as it may be held. That of the tick before, `before` (m/s), makes it faster
    /// to find and changes it by no more than rounding.
    #[must_use]
    pub fn answer(&self, rows: &mut Rows<'_, D>, before: &Vector<D>) -> Answer<D> {
        let closest = rows.closest_from(&self.desired_m(before));
        let doubt = match (rows.broken, rows.doubtful) {
            (0, 0) => None,
            (0, _) => Some(Reason::Uncertain),
            _ => Some(Reason::OutsideSafeSet),
        };
        let outcome = if rows.broken > 0 { Outcome::Recovering } else { closest.outcome };
        let velocity = closest.displacement_m.map(|component| component / self.hold_s());
        Answer { velocity_m_s: self.settings().input.clip(&velocity), outcome, doubt }
    }

    /// What an answer is worth with so many robots in sight, `h` and what else speaks against it: guaranteed unless something
    /// does.
    #[must_use]
    pub fn mode(&self, reason: Option<Reason>, degree: u16, h: f64) -> Mode {
        let degree_low = degree < self.budget().required();
        let exact = self.budget().margin.offset_m == 0.0;
        match reason {
            _ if degree_low => Mode::Degraded(Reason::Degree),
            Some(reason) => Mode::Degraded(reason),
            None if exact && h < 0.0 => Mode::Degraded(Reason::OutsideSafeSet),
            None => Mode::Guaranteed,
        }
    }
}

impl<const D: usize> Settings<D> {
    /// A level told `age` ago, in whole ticks, rounded up; nothing if it is too old, or older than can be counted: younger
    /// than it is it would be worth too much.
    #[must_use]
    pub fn claim(&self, level: f64, age: Duration) -> Option<Claim> {
        let age_ticks = if age.is_zero() { 0 } else { ticks(age, self.level_period)? };
        (age <= self.told_max).then_some(Claim { level, age_ticks })
    }
}

/// `age` in periods, rounded up; a longer period than 64 bits hold counts as shorter, which makes the age greater.
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
