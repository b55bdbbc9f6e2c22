//! Scratch for a whole team: one piece, because robots take turns.

use closeranks_core::controller::budget::knowledge::Sighting;
use closeranks_core::obstacle::Obstacle;
use closeranks_core::program::balls::row::Row;
use closeranks_core::robot::scratch::{Needs, Scratch};
use closeranks_core::settings::params::Params;

/// So many obstacles at most can be about to cut each link in one tick before a robot stands still.
const CUTTING_MAX: usize = 8;

/// Scratch for robots that may all be neighbours of each other.
#[derive(Clone, Debug)]
pub struct Memory<const D: usize> {
    params: Params<D>,
    robots: usize,
    values: Vec<f64>,
    sightings: Vec<Sighting<D>>,
    rows: Vec<Row<D>>,
    /// The obstacles of the scenario: every robot knows all of them.
    map: Vec<Obstacle<D>>,
}

impl<const D: usize> Memory<D> {
    /// For a team of `robots` with these `params`, without obstacles.
    #[must_use]
    pub fn new(params: &Params<D>, robots: usize) -> Self {
        let needs = Needs::new(params, robots);
        // Every row may be there once for every corner of a cube, if all others are missing.
        let rows = needs.rows.max((2 * robots + 1) * (1 << D) + 2 * D + 1);
        Self {
            params: *params,
            robots,
            values: vec![0.0; needs.values],
            sightings: vec![Sighting::NOBODY; needs.sightings],
            rows: vec![Row::default(); rows],
            map: Vec::new(),
        }
    }

    /// Grows for a robot that has so many slots.
    pub fn fit(&mut self, slots: usize) {
        if slots > self.robots {
            *self = Self::new(&self.params, slots).among(&self.map);
        }
    }

    /// The same among the obstacles of `map`, with rows for all of them.
    #[must_use]
    pub fn among(mut self, map: &[Obstacle<D>]) -> Self {
        if !map.is_empty() {
            let needs = Needs { values: 0, sightings: 0, rows: self.rows.len() };
            let cutting = map.iter().filter(|obstacle| obstacle.cuts_links).count().min(CUTTING_MAX);
            let needs = needs.among::<D>(map.len()).among_cuts::<D>(self.robots, cutting);
            self.rows.resize(needs.rows, Row::default());
            self.map = map.to_vec();
        }
        self
    }

    /// The scratch to hand to a call.
    ///
    /// # Panics
    ///
    /// Never: what is lent was made for these parameters.
    pub fn lend(&mut self) -> Scratch<'_, D> {
        Scratch::new(&self.params, self.robots, &mut self.values, &mut self.sightings, &mut self.rows)
            .expect("made for these params")
            .among(&self.map)
    }
}
