//! Columns of tables of numbers, in TOML as lists of lists and in files.

use core::fmt;

use closeranks_core::settings::range::Allowed;

/// A column and what its numbers may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Column {
    /// Its name with its unit, such as `x_m`.
    pub(crate) name: &'static str,
    /// The range of its numbers.
    pub(crate) allowed: Allowed,
    /// True if they must be whole.
    pub(crate) whole: bool,
}

impl Column {
    /// A column of numbers in `allowed`.
    pub(crate) const fn new(name: &'static str, allowed: Allowed) -> Self {
        Self { name, allowed, whole: false }
    }

    /// The number of a robot, from 1.
    pub(crate) fn robot(robots: u16) -> Self {
        Self { name: "robot", allowed: Allowed::Closed(1.0, f64::from(robots)), whole: true }
    }

    /// True if `number` may stand in the column.
    pub(crate) fn holds(&self, number: f64) -> bool {
        self.allowed.holds(number) && !(self.whole && number.fract() != 0.0)
    }
}

impl fmt::Display for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.whole { "a whole number" } else { "a finite number" };
        write!(f, "{kind} ({}), {}", self.name, self.allowed)
    }
}

/// The names of columns, with commas between.
pub(crate) fn names(columns: &[Column]) -> String {
    columns.iter().map(|column| column.name).collect::<Vec<_>>().join(", ")
}
