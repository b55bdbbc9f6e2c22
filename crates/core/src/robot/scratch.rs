//! Memory that a robot needs during a call and not between calls: one piece for any number of robots that take turns.

use crate::controller::budget::knowledge::Sighting;
use crate::program::balls::row::Row;

/// Scratch for the calls of a robot. It is enough for robots with the parameters and the number of slots that it was made
/// for.
#[derive(Debug)]
pub struct Scratch<'memory, const D: usize> {
    /// For how many neighbours it is enough.
    pub(super) neighbors: usize,
    /// Numbers: the values of a round, or weights between neighbours.
    pub(crate) values: &'memory mut [f64],
    /// Neighbours as `budget` sees them.
    pub(crate) sightings: &'memory mut [Sighting<D>],
    /// Rows of a program.
    pub(crate) rows: &'memory mut [Row<D>],
}

/// How much of each a robot needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs {
    /// How many numbers.
    pub values: usize,
    /// How many sightings.
    pub sightings: usize,
    /// How many rows.
    pub rows: usize,
}

impl<const D: usize> Scratch<'_, D> {
    /// True if it is enough for `count` neighbours.
    pub(crate) fn is_for(&self, count: usize) -> bool {
        count <= self.neighbors
    }
}
