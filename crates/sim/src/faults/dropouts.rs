//! Robots that others do not sense although they are within R, as a scenario writes it down.

use crate::faults::spell::Spell;
use crate::parse::common::{FRACTION, small};
use crate::parse::reader::{Reader, Section};

/// Who is not sensed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dropouts {
    /// Probability that one robot does not sense another one in a tick.
    pub missed: f64,
    /// For a while no other robot senses one robot.
    pub unseen: Option<Spell>,
    /// How many others each robot has slots for; by default for all.
    pub slots: Option<u16>,
}

impl Dropouts {
    /// Reads the fields of the table `sensing` of a scenario text that are about this, for a team of so many robots.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, robots: u16) -> Self {
        Self {
            missed: reader.number_or(section, "missed", FRACTION, 0.0),
            unseen: Spell::read(reader, section, "unseen", robots),
            slots: reader.whole(section, "slots", 1..u64::from(robots)).map(small),
        }
    }

    /// True if everybody within R is sensed.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}
