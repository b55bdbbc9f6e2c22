//! All rows of one robot in one tick, and recovery from starts outside the set.

use crate::budget::interval::number;
use crate::budget::knowledge::{Known, Sighting};
use crate::budget::project::{Closest, Program};
use crate::budget::reach::Reach;
use crate::budget::row::Row;
use crate::budget::settings::{Budget, Form};
use crate::budget::survey::Survey;
use crate::budget::tie::{Knowledge, NO_SLOPE, Neighbor, Tie};
use crate::math::{Vector, add_scaled, dot, is_finite, length};

/// Memory that the caller lends for one tick.
#[derive(Debug)]
pub struct Memory<'memory, const D: usize> {
    /// `2·D + 2·N + 1` rows are always enough for N neighbours, with a margin `2·D + 2ᴰ (2·N + 1)`.
    pub rows: &'memory mut [Row<D>],
    /// At least N numbers; with 3·N, or N² under [`Assume::Free`](crate::budget::knowledge::Assume::Free), the weights between
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

/// Own state that every row of a tick needs.
struct Own<const D: usize> {
    h: f64,
    degree: f64,
    /// ∂h_i/∂x_i, 1/m.
    gradient: Vector<D>,
    /// κ_ii.
    bend: f64,
    /// Bound of the error of the gradient, 1/m.
    wrong: f64,
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

    /// Adds `row` of the vector that is known to `wrong`, which does not surely hold: once if that is 0, else for every corner
    /// of the cube around it.
    //= method margins
    fn push(&mut self, vector: &Vector<D>, wrong: f64, row: impl Fn(&Vector<D>) -> Row<D>) {
        if wrong == 0.0 {
            return self.program.keep(row(vector));
        }
        for corner in 0..1_usize << D.min(8) {
            let tilt = |d: usize| if corner >> d & 1 == 1 { wrong } else { -wrong };
            self.program.push(row(&core::array::from_fn(|d| vector[d] + tilt(d))));
        }
    }

    fn count(&mut self, certain: bool) {
        self.doubtful += 1;
        self.broken += usize::from(certain);
    }

    /// Recovery: raises the desired displacement along `direction` to at least `wanted_m`.
    fn raise(&mut self, direction: &Vector<D>, wanted_m: f64) {
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
    /// whoever computes a whole team at once.
    #[must_use]
    pub fn rows_between<'memory, 'a, const D: usize>(
        &self,
        (level, degree): (f64, u16),
        neighbors: impl Iterator<Item = Neighbor<'a, D>>,
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
                let tie = &self.tie(dot(&offset_m, &offset_m), survey.slopes[index]);
                let knowledge = Knowledge::Seen(survey.seen(index, claim));
                self.push_neighbor(&mut own, &Neighbor { offset_m, tie, knowledge }, rows);
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
            let slope = self.link(&offset_m).map_or(NO_SLOPE, |link| link.slope);
            let tie = &self.tie(dot(&offset_m, &offset_m), slope);
            let knowledge = Knowledge::Known(&self.believe(&interval, claim.as_ref()));
            self.push_neighbor(&mut own, &Neighbor { offset_m, tie, knowledge }, rows);
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

    /// β_ij, m²: what one link may spend. `+∞` where it cannot be weakened.
    ///
    /// ```text
    /// β_ij = min( s(h_i⁺)/δ_i, s(b_ij)/δ⁺_ij )/(4 L_ij)
    /// ```
    ///
    /// METHOD.md has n − 1 for δ⁺. The proof needs no more than shares that sum to at most 1 over the neighbours of j, and
    /// `δ⁺_ij ≥ δ_j` for each of them.
    //= method far
    #[must_use]
    pub fn beta_m2(&self, slope_max: f64, own_share: f64, known_share: f64) -> f64 {
        let least = own_share.min(known_share);
        if slope_max <= 0.0 { f64::INFINITY } else { least / (4.0 * slope_max) }
    }

    fn push_neighbor<const D: usize>(
        &self,
        own: &mut Own<D>,
        neighbor: &Neighbor<'_, D>,
        rows: &mut Rows<'_, D>,
    ) {
        let gradient = &neighbor.tie.gradient(&neighbor.offset_m);
        own.gradient = add_scaled(&own.gradient, 1.0, gradient);
        self.push_far(own, neighbor, gradient, rows);
        self.push_near(&neighbor.offset_m, neighbor.tie, rows);
    }

    fn push_far<const D: usize>(
        &self,
        own: &mut Own<D>,
        Neighbor { offset_m: offset, tie, knowledge }: &Neighbor<'_, D>,
        gradient: &Vector<D>,
        rows: &mut Rows<'_, D>,
    ) {
        let &Tie { bend, wrong, .. } = *tie;
        let most = rows.program.most(gradient, wrong, bend);
        let known = match knowledge {
            Knowledge::Known(known) => **known,
            Knowledge::Seen(seen) => self.known_from(seen, tie.distance_m),
        };
        match self.form() {
            Form::Link => {
                let error_m = self.margin.offset_m;
                let own_share = self.loss_max(own.h.max(0.0)) / own.degree.max(1.0);
                let known_share = self.loss_max(known.budget) / known.degree_max;
                let beta_m2 = self.beta_m2(bend, own_share, known_share);
                if !rows.program.surely_holds(offset, error_m, 1.0, beta_m2) {
                    rows.push(offset, error_m, |offset| Row::far(offset, beta_m2));
                }
            }
            Form::Level => {
                (own.bend, own.wrong) = (own.bend + bend, own.wrong + wrong);
                if !self.is_slack(most, &known) {
                    let spend = self.spend(&known);
                    rows.push(gradient, wrong, |gradient| Row::far_level(gradient, bend, spend));
                }
            }
        }
        if known.deficit > 0.0 {
            rows.count(true);
            rows.raise(gradient, self.mend_m(known.deficit, gradient));
        }
    }

    /// True when (far′), whose left-hand side is `most` wherever the robot can go, surely holds. No quotient: this is asked
    /// of every neighbour.
    fn is_slack(&self, most: f64, known: &Known) -> bool {
        self.form() == Form::Level && most * (known.degree_max + 1.0) <= self.loss_max(known.budget)
    }

    fn push_own<const D: usize>(&self, own: &Own<D>, rows: &mut Rows<'_, D>) {
        if self.form() == Form::Level {
            let spend = self.loss_max(own.h.max(0.0)) / (own.degree + 1.0);
            if !rows.program.surely_holds(&own.gradient, own.wrong, own.bend, spend) {
                rows.push(&own.gradient, own.wrong, |gradient| Row::far_level(gradient, own.bend, spend));
            }
        }
        if own.h < 0.0 {
            rows.count(own.h + own.degree * self.weight_error() < 0.0);
            rows.raise(&own.gradient, self.mend_m(-own.h, &own.gradient));
        }
    }

    fn push_near<const D: usize>(&self, offset: &Vector<D>, tie: &Tie, rows: &mut Rows<'_, D>) {
        let error_m = self.margin.offset_m;
        let spare_m2 = self.spare_m2(tie, -error_m);
        let give_m2 = 0.5 * self.gamma_c * spare_m2.max(0.0);
        if !rows.program.surely_holds(offset, error_m, 0.0, 0.5 * give_m2) {
            rows.push(offset, error_m, |offset| Row::near(offset, give_m2));
        }
        if spare_m2 < 0.0 {
            rows.count(self.spare_m2(tie, error_m) < 0.0);
            let missing_m = self.distance_min_m + error_m - tie.distance_m;
            rows.raise(offset, (0.5 * missing_m).min(self.move_max_m));
        }
    }

    /// `D − Δ_d²`, m², for a pair farther apart by `more_m`.
    fn spare_m2(&self, tie: &Tie, more_m: f64) -> f64 {
        let least_m2 = self.distance_min_m * self.distance_min_m;
        if more_m == 0.0 {
            return tie.distance_m2 - least_m2;
        }
        let distance_m = (tie.distance_m + more_m).max(0.0);
        distance_m * distance_m - least_m2
    }

    /// h_i and δ_i; the gradient and κ_ii are summed with the rows.
    fn own<const D: usize>(&self, level: f64, degree: f64) -> Own<D> {
        let h = level - f64::from(self.required());
        Own { h, degree, gradient: [0.0; D], bend: 0.0, wrong: 0.0 }
    }

    fn degree<const D: usize>(&self, sightings: &[Sighting<D>]) -> f64 {
        number(sightings.iter().filter(|sighting| self.in_range(&sighting.offset_m)).count())
    }

    /// How far to go along `gradient` (1/m) to make up for `deficit`, m, at most ρ.
    fn mend_m<const D: usize>(&self, deficit: f64, gradient: &Vector<D>) -> f64 {
        (deficit / length(gradient)).min(self.move_max_m)
    }
}

/// The row that allows no move.
fn stay<const D: usize>() -> Row<D> {
    Row::new([0.0; D], 1.0, 0.0)
}
