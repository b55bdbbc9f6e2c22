//! All rows of one robot in one tick, and recovery from starts outside the set.

use crate::controller::budget::interval::number;
use crate::controller::budget::knowledge::Sighting;
use crate::controller::budget::settings::Budget;
use crate::controller::budget::survey::Survey;
use crate::controller::budget::tie::Neighbor;
use crate::num::{Vector, add_scaled, dot, is_finite, length};
use crate::program::balls::reach::Reach;
use crate::program::balls::row::Row;
use crate::program::balls::{Closest, Program};

/// Memory that the caller lends for one tick.
#[derive(Debug)]
pub struct Memory<'memory, const D: usize> {
    /// `2·D + 2·N + 1` rows are always enough for N neighbours, with a margin `2·D + 2ᴰ (2·N + 1)`.
    pub rows: &'memory mut [Row<D>],
    /// At least N numbers; with 3·N, or N² under [`Assume::Free`](crate::controller::budget::knowledge::Assume::Free), the weights between
    /// neighbours are computed once instead of twice.
    pub weights: &'memory mut [f64],
}

/// The rows of a tick.
#[derive(Debug)]
pub struct Rows<'memory, const D: usize> {
    /// The program; its rows are all that bounds the move.
    pub program: Program<'memory, D>,
    /// The desired displacement, m, with the push of recovery.
    pub desired_m: Vector<D>,
    /// Own h_i, of the level or of the trimmed one.
    pub h: f64,
    /// What is violated for certain: h_i < 0, h_j < 0, or a pair closer than Δ_d.
    pub broken: usize,
    /// What may be violated, with a margin; without one the same as `broken`.
    pub doubtful: usize,
}

impl<'memory, const D: usize> Rows<'memory, D> {
    /// The box alone.
    fn new(desired_m: &Vector<D>, reach: Reach<D>, memory: &'memory mut [Row<D>]) -> Self {
        let desired_m = desired_m.map(|component| if component.is_finite() { component } else { 0.0 });
        Self { program: Program::new(memory, reach), desired_m, h: 0.0, broken: 0, doubtful: 0 }
    }

    /// The displacement, m: closest to the desired one, every row holds.
    #[must_use]
    pub fn closest(&mut self) -> Closest<D> {
        self.program.closest(&self.desired_m)
    }

    /// The same up to rounding, faster where `before_m` is close to it ([`Program::closest_from`]).
    #[must_use]
    pub fn closest_from(&mut self, before_m: &Vector<D>) -> Closest<D> {
        self.program.closest_from(&self.desired_m, before_m)
    }

    /// Adds `row` of the vector that is known to `wrong`, which does not surely hold: once if that is 0, else for every corner
    /// of the cube around it.
    //= method margins
    pub(crate) fn push(&mut self, vector: &Vector<D>, wrong: f64, row: impl Fn(&Vector<D>) -> Row<D>) {
        if wrong == 0.0 {
            return self.program.keep(row(vector));
        }
        for corner in 0..1_usize << D.min(8) {
            let tilt = |d: usize| if corner >> d & 1 == 1 { wrong } else { -wrong };
            self.program.push(row(&core::array::from_fn(|d| vector[d] + tilt(d))));
        }
    }

    pub(crate) fn count(&mut self, certain: bool) {
        self.doubtful += 1;
        self.broken += usize::from(certain);
    }

    /// Recovery: raises the desired displacement along `direction` to at least `wanted_m`.
    pub(crate) fn raise(&mut self, direction: &Vector<D>, wanted_m: f64) {
        let size = length(direction);
        if size > 0.0 && size.is_finite() && wanted_m > 0.0 {
            let unit = direction.map(|component| component / size);
            let missing = wanted_m - dot(&unit, &self.desired_m);
            if missing > 0.0 {
                self.desired_m = add_scaled(&self.desired_m, missing, &unit);
            }
        }
    }
}

impl Budget {
    /// All rows for a robot that senses `sightings`, wants to move by `desired_m` (m) and can move within `reach`.
    ///
    /// Whoever is farther away than R gets no row. A sighting that is not finite, or too little memory, allows no move. Where a
    /// budget is negative, the right-hand side is 0 and the desired displacement is raised along the gradient of what is
    /// violated, by what would mend it to first order, at most ρ: the violated h or distance cannot get worse.
    //= method far
    //= method near
    //= method far-prime
    //= method recovery
    #[must_use]
    pub fn rows<'memory, const D: usize>(
        &self,
        sightings: &[Sighting<D>],
        desired_m: &Vector<D>,
        reach: Reach<D>,
        memory: Memory<'memory, D>,
    ) -> Rows<'memory, D> {
        let Memory { rows, weights } = memory;
        let mut rows = Rows::new(desired_m, reach, rows);
        match self.survey(sightings, weights) {
            Some(survey) => self.push_surveyed(sightings, &survey, &mut rows),
            None => self.push_tabulated(sightings, weights, &mut rows),
        }
        rows
    }

    /// The same rows for a robot with this own `level` and `degree`, from all its `neighbors` in order of their numbers: for
    /// whoever computes a whole team at once. Their ties must have been made with this `reach`: which rows can bind depends on it.
    #[must_use]
    pub fn rows_between<'memory, const D: usize>(
        &self,
        (level, degree): (f64, u16),
        neighbors: impl Iterator<Item = Neighbor<D>>,
        desired_m: &Vector<D>,
        reach: Reach<D>,
        memory: &'memory mut [Row<D>],
    ) -> Rows<'memory, D> {
        let mut rows = Rows::new(desired_m, reach, memory);
        let mut own = self.own(level, f64::from(degree));
        rows.h = own.h;
        for neighbor in neighbors {
            self.push_neighbor(&mut own, &neighbor, &mut rows);
        }
        self.push_own(&own, &mut rows);
        rows
    }

    fn push_surveyed<const D: usize>(
        &self,
        sightings: &[Sighting<D>],
        survey: &Survey<'_>,
        rows: &mut Rows<'_, D>,
    ) {
        let mut own = self.own(survey.level, self.degree(sightings));
        rows.h = own.h;
        for (index, &Sighting { offset_m, claim, .. }) in sightings.iter().enumerate() {
            if self.bounds_move(&offset_m, rows) {
                let tie = self.tie(&offset_m, survey.slopes[index], &rows.program.reach);
                let known = self.known_from(&survey.seen(index, self.worth(claim)), tie.distance_m);
                self.push_neighbor(&mut own, &Neighbor { offset_m, tie, known }, rows);
            }
        }
        self.push_own(&own, rows);
    }

    /// The same from a table of all weights, or from no table if there is no room for one.
    fn push_tabulated<const D: usize>(
        &self,
        sightings: &[Sighting<D>],
        weights: &mut [f64],
        rows: &mut Rows<'_, D>,
    ) {
        let mut own = self.own(self.level(sightings, weights), self.degree(sightings));
        rows.h = own.h;
        if weights.len() < sightings.len() {
            rows.program.push(stay());
        }
        let (count, unseen) = (sightings.len(), self.unseen(sightings));
        let tabulated = self.tabulate(sightings, weights);
        for (index, &Sighting { offset_m, claim, .. }) in sightings.iter().enumerate() {
            if !self.bounds_move(&offset_m, rows) {
                continue;
            }
            let interval = if tabulated {
                self.bounds(&offset_m, &mut weights[index * count..(index + 1) * count], unseen)
            } else {
                self.interval(index, sightings, weights)
            };
            let slope = self.link(&offset_m).map_or(0.0, |link| link.slope);
            let tie = self.tie(&offset_m, slope, &rows.program.reach);
            let known = self.believe(&interval, claim);
            self.push_neighbor(&mut own, &Neighbor { offset_m, tie, known }, rows);
        }
        self.push_own(&own, rows);
    }

    /// True for a neighbour, false for whoever is out of range; who is nowhere allows no move.
    fn bounds_move<const D: usize>(&self, offset: &Vector<D>, rows: &mut Rows<'_, D>) -> bool {
        let somewhere = is_finite(offset);
        if !somewhere {
            rows.program.push(stay());
        }
        somewhere && self.in_range(offset)
    }

    fn degree<const D: usize>(&self, sightings: &[Sighting<D>]) -> f64 {
        number(sightings.iter().filter(|sighting| self.in_range(&sighting.offset_m)).count())
    }
}

/// The row that allows no move.
fn stay<const D: usize>() -> Row<D> {
    Row::new([0.0; D], 1.0, 0.0)
}
