//! What is given to the world from outside for one tick.

use closeranks_core::message::VALUE_MAX;
use closeranks_core::num::{Vector, is_finite};

/// Arrays of the whole team, one entry a robot. `None` leaves to the scenario what is not given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Given<'a, const D: usize> {
    /// u_{i,des}, m/s, finite.
    pub desired_m_s: Option<&'a [Vector<D>]>,
    /// What malicious robots tell of their level, finite. Entries of normal robots are not used.
    pub levels: Option<&'a [f64]>,
    /// What malicious robots tell of their value in a round, at most 1e300. Entries of normal robots are not used.
    pub values: Option<&'a [f64]>,
}

/// Why an array that was given is not used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum GivenError {
    /// It has not one entry a robot.
    #[error("`{array}` has {found} entries, must have {robots}, one a robot")]
    Length {
        /// Which array.
        array: &'static str,
        /// How many entries it has.
        found: usize,
        /// n.
        robots: usize,
    },
    /// An entry is not finite, or too large to be told.
    #[error("`{array}` of robot {robot} is not a finite number that can be told")]
    Number {
        /// Which array.
        array: &'static str,
        /// The first such robot, from 1.
        robot: usize,
    },
}

impl<const D: usize> Given<'_, D> {
    /// Checks every array that is there, for a team of so many robots.
    pub(crate) fn check(&self, robots: usize) -> Result<(), GivenError> {
        if let Some(desired) = self.desired_m_s {
            check("desired_m_s", robots, desired.iter().map(is_finite))?;
        }
        if let Some(levels) = self.levels {
            check("levels", robots, levels.iter().map(|level| level.is_finite()))?;
        }
        if let Some(values) = self.values {
            check("values", robots, values.iter().map(|value| (-VALUE_MAX..=VALUE_MAX).contains(value)))?;
        }
        Ok(())
    }
}

fn check(
    array: &'static str,
    robots: usize,
    mut good: impl ExactSizeIterator<Item = bool>,
) -> Result<(), GivenError> {
    if good.len() != robots {
        return Err(GivenError::Length { array, found: good.len(), robots });
    }
    let bad = good.position(|good| !good);
    bad.map_or(Ok(()), |index| Err(GivenError::Number { array, robot: index + 1 }))
}
