//! A stretch of time in which something is wrong with one robot.

use closeranks_core::settings::range::Allowed;

use crate::parse::common::{small, times};
use crate::parse::reader::{Reader, Section};

/// A stretch of time in which something is wrong with one robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spell {
    /// The number of the robot, from 1.
    pub robot: u16,
    /// From when, s.
    pub from_s: f64,
    /// Until when, s, not included.
    pub to_s: f64,
}

impl Spell {
    /// True while it lasts.
    #[must_use]
    pub fn lasts(&self, time_s: f64) -> bool {
        self.from_s <= time_s && time_s < self.to_s
    }

    /// Index of its robot.
    #[must_use]
    pub fn index(&self) -> usize {
        usize::from(self.robot).saturating_sub(1)
    }

    /// Reads the table `key` with its fields `robot`, `from_s` and `to_s`, if it is there.
    pub(crate) fn read(
        reader: &mut Reader,
        section: &mut Section<'_>,
        key: &'static str,
        robots: u16,
    ) -> Option<Self> {
        section
            .has(key)
            .then(|| reader.table(section, key, |reader, spell| Self::fields(reader, spell, robots)))
    }

    /// Reads the table `key` as above, with one more field for a number, which is 1 by default.
    pub(crate) fn read_with(
        reader: &mut Reader,
        section: &mut Section<'_>,
        key: &'static str,
        robots: u16,
        (number, allowed): (&'static str, Allowed),
    ) -> Option<(Self, f64)> {
        section.has(key).then(|| {
            reader.table(section, key, |reader, spell| {
                (Self::fields(reader, spell, robots), reader.number_or(spell, number, allowed, 1.0))
            })
        })
    }

    fn fields(reader: &mut Reader, spell: &mut Section<'_>, robots: u16) -> Self {
        let robot = reader.whole(spell, "robot", 1..u64::from(robots) + 1).map_or(robots, small);
        let [from_s, to_s] = times(reader, spell);
        Self { robot, from_s, to_s }
    }
}
