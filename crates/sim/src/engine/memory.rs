//! Memory that a fleet lends to its robots.

use closeranks_core::controller::budget::knowledge::Sighting;
use closeranks_core::program::balls::row::Row;
use closeranks_core::robot::neighbor::Slot;

/// For all robots of a run.
#[derive(Clone, Debug)]
pub struct Memory<const D: usize> {
    slots: Vec<Slot<D>>,
    values: Vec<f64>,
    sightings: Vec<Sighting<D>>,
    rows: Vec<Row<D>>,
    robots: usize,
    rows_each: usize,
}

/// What one robot is lent.
pub(crate) struct Lent<'memory, const D: usize> {
    pub(crate) slots: &'memory mut [Slot<D>],
    pub(crate) values: &'memory mut [f64],
    pub(crate) sightings: &'memory mut [Sighting<D>],
    pub(crate) rows: &'memory mut [Row<D>],
}

impl<const D: usize> Memory<D> {
    /// For `robots` robots that may all be neighbours of each other, whose rows have a margin or none.
    #[must_use]
    pub fn new(robots: usize, margin: bool) -> Self {
        let corners = if margin { 1 << D } else { 1 };
        let rows_each = 2 * D + corners * (2 * robots + 1);
        Self {
            slots: vec![Slot::default(); robots * robots],
            values: vec![0.0; robots * values_each(robots)],
            sightings: vec![Sighting::NOBODY; robots * robots],
            rows: vec![Row::default(); robots * rows_each],
            robots,
            rows_each,
        }
    }

    /// The share of each robot.
    pub(crate) fn lend(&mut self) -> impl Iterator<Item = Lent<'_, D>> {
        let robots = self.robots.max(1);
        let values = self.values.chunks_mut(values_each(robots));
        let slots = self.slots.chunks_mut(robots).zip(values);
        let rows = self.rows.chunks_mut(self.rows_each.max(1));
        let more = self.sightings.chunks_mut(robots).zip(rows);
        slots.zip(more).map(|((slots, values), (sightings, rows))| Lent { slots, values, sightings, rows })
    }
}

/// Enough for `budget` to compute each pair once; with free liars that takes a table, which large teams do without.
fn values_each(robots: usize) -> usize {
    if robots <= 64 { robots * robots.max(3) } else { 3 * robots }
}
