//! How scratch is made: of slices that are long enough, or with its size known when the program is built.

use crate::controller::budget::knowledge::Sighting;
use crate::program::balls::row::Row;
use crate::robot::error::RobotError;
use crate::robot::scratch::{Needs, Scratch};
use crate::settings::params::Params;

impl Needs {
    /// What a robot with these `params` needs for up to `neighbors` neighbours.
    #[must_use]
    pub fn new<const D: usize>(params: &Params<D>, neighbors: usize) -> Self {
        params.controller().needs(neighbors)
    }
}

impl<'memory, const D: usize> Scratch<'memory, D> {
    /// Scratch for robots with `params` and up to `neighbors` slots, or [`RobotError::Scratch`] if a slice is too short.
    pub fn new(
        params: &Params<D>,
        neighbors: usize,
        values: &'memory mut [f64],
        sightings: &'memory mut [Sighting<D>],
        rows: &'memory mut [Row<D>],
    ) -> Result<Self, RobotError> {
        let needs = Needs::new(params, neighbors);
        let given = Needs { values: values.len(), sightings: sightings.len(), rows: rows.len() };
        let enough =
            given.values >= needs.values && given.sightings >= needs.sightings && given.rows >= needs.rows;
        if enough {
            Ok(Self { neighbors, values, sightings, rows, map: &[] })
        } else {
            Err(RobotError::Scratch(needs))
        }
    }
}

/// Sized scratch for robots with up to `N` neighbours and `K` rows a neighbour.
///
/// Without stated errors `K = 10` is enough for any N in two and three dimensions, in the plane also while all of four and more
/// neighbours are [missing](crate::robot::missing). With fewer rows a robot stands still in a tick in which missing neighbours
/// need more. Where the rows are too few for those that are sensed, [`new`](Self::new) says how many are needed.
#[derive(Clone, Debug)]
pub struct RobotMemory<const D: usize, const N: usize, const K: usize = 10> {
    sums: [[f64; 3]; N],
    table: [[f64; N]; N],
    sightings: [Sighting<D>; N],
    rows: [[Row<D>; K]; N],
}

impl<const D: usize, const N: usize, const K: usize> RobotMemory<D, N, K> {
    /// Memory for robots with `params`, or [`RobotError::Scratch`] if `N` times `K` rows are too few.
    pub fn new(params: &Params<D>) -> Result<Self, RobotError> {
        let mut memory = Self {
            sums: [[0.0; 3]; N],
            table: [[0.0; N]; N],
            sightings: [Sighting::NOBODY; N],
            rows: [[Row::default(); K]; N],
        };
        let (values, sightings, rows) = memory.slices();
        Scratch::new(params, N, values, sightings, rows)?;
        Ok(memory)
    }

    /// The scratch to hand to a call.
    #[must_use]
    pub fn scratch(&mut self) -> Scratch<'_, D> {
        let (values, sightings, rows) = self.slices();
        Scratch { neighbors: N, values, sightings, rows, map: &[] }
    }

    fn slices(&mut self) -> (&mut [f64], &mut [Sighting<D>], &mut [Row<D>]) {
        let values = if N > 3 { self.table.as_flattened_mut() } else { self.sums.as_flattened_mut() };
        (values, &mut self.sightings, self.rows.as_flattened_mut())
    }
}
