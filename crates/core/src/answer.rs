//! What the rows of `budget` come to: velocity, outcome and what the answer is worth.

use core::time::Duration;

use crate::budget::knowledge::Claim;
use crate::budget::rows::Rows;
use crate::math::Vector;
use crate::params::{Params, Settings};
use crate::program::Outcome;
use crate::report::{Mode, Reason};

/// The answer to a tick under [`Controller::Budget`](crate::params::Controller::Budget).
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

    /// The velocity that keeps every row for as long as it may be held.
    #[must_use]
    pub fn answer(&self, rows: &mut Rows<'_, D>) -> Answer<D> {
        let closest = rows.closest();
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
    /// A level told `age` ago, in whole ticks, rounded up; nothing if it is too old.
    #[must_use]
    pub fn claim(&self, level: f64, age: Duration) -> Option<Claim> {
        let age_ticks = if age.is_zero() { 0 } else { ticks(age, self.level_period) };
        (age <= self.told_max).then_some(Claim { level, age_ticks })
    }
}

fn ticks(age: Duration, period: Duration) -> u32 {
    let nanos = |span: Duration| u64::try_from(span.as_nanos()).unwrap_or(u64::MAX);
    u32::try_from(nanos(age).div_ceil(nanos(period).max(1))).unwrap_or(u32::MAX)
}
