//! Memory that a robot needs during a call and not between calls: one piece for any number of robots that take turns.

use crate::controller::budget::knowledge::Sighting;
use crate::obstacle::Obstacle;
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
    /// The obstacles that a robot knows of.
    pub(crate) map: &'memory [Obstacle<D>],
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

impl Needs {
    /// Adds rows for up to `obstacles` that are within reach of one move. In a tick in which more of them are, and the rows for
    /// neighbours leave no room, the robot stands still, which is always allowed.
    #[must_use]
    pub fn among<const D: usize>(self, obstacles: usize) -> Self {
        let more = obstacles.saturating_mul(1 << D.min(8)).saturating_add(2 * D + 1);
        let rows = self.rows.saturating_add(more);
        Self { rows, ..self }
    }

    /// Adds rows for the links to so many `neighbors`, each of which up to `obstacles` could cut in one move. In a tick in which more of
    /// them could, and there is no room left, the robot stands still.
    #[must_use]
    pub fn among_cuts<const D: usize>(self, neighbors: usize, obstacles: usize) -> Self {
        let more = neighbors.saturating_mul(obstacles).saturating_mul(1 << D.min(8));
        Self { rows: self.rows.saturating_add(more), ..self }
    }
}

impl<'memory, const D: usize> Scratch<'memory, D> {
    /// Lends the obstacles of `map` too, in the frame of the robot. Whoever knows of many hands over those near it:
    /// in a tick only those matter that the longest move could take nearer than allowed.
    #[must_use]
    pub fn among(self, map: &'memory [Obstacle<D>]) -> Self {
        Self { map, ..self }
    }

    /// True if it is enough for `count` neighbours.
    pub(crate) fn is_for(&self, count: usize) -> bool {
        count <= self.neighbors
    }
}
