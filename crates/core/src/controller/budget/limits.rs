//! What one neighbour, and a robot's own level, allow: the rows one by one, and what recovery adds to them.

use crate::controller::budget::knowledge::Known;
use crate::controller::budget::rows::Rows;
use crate::controller::budget::settings::{Budget, Form};
use crate::controller::budget::tie::{Neighbor, Tie};
use crate::num::{Vector, add_scaled, length};
use crate::program::balls::row::Row;

/// Own state that every row of a tick needs.
pub(crate) struct Own<const D: usize> {
    pub(crate) h: f64,
    degree: f64,
    /// ∂h_i/∂x_i, 1/m.
    gradient: Vector<D>,
    /// κ_ii.
    bend: f64,
    /// Bound of the error of the gradient, 1/m.
    wrong: f64,
}

impl Budget {
    /// h_i and δ_i; the gradient and κ_ii are summed with the rows.
    pub(crate) fn own<const D: usize>(&self, level: f64, degree: f64) -> Own<D> {
        let h = level - f64::from(self.required());
        Own { h, degree, gradient: [0.0; D], bend: 0.0, wrong: 0.0 }
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

    /// What a neighbour adds to the own gradient and κ_ii, and its rows where they bound the move.
    #[inline]
    pub(crate) fn push_neighbor<const D: usize>(
        &self,
        own: &mut Own<D>,
        neighbor: &Neighbor<D>,
        rows: &mut Rows<'_, D>,
    ) {
        let Neighbor { offset_m, tie, known } = neighbor;
        let gradient = tie.gradient(offset_m);
        own.gradient = add_scaled(&own.gradient, 1.0, &gradient);
        (own.bend, own.wrong) = (own.bend + tie.bend, own.wrong + tie.wrong);
        let slack = self.form() == Form::Level && self.is_slack(tie.most, known) && known.deficit <= 0.0;
        if !slack {
            self.push_far(own, neighbor, &gradient, rows);
        }
        if !tie.clear {
            self.push_near(offset_m, tie, rows);
        }
    }

    /// (far) or (far′), and what h_k below 0 asks for.
    #[inline(never)]
    fn push_far<const D: usize>(
        &self,
        own: &Own<D>,
        Neighbor { offset_m, tie, known }: &Neighbor<D>,
        gradient: &Vector<D>,
        rows: &mut Rows<'_, D>,
    ) {
        match self.form() {
            Form::Link => self.push_link(own, offset_m, tie.bend, known, rows),
            Form::Level if self.is_slack(tie.most, known) => {}
            Form::Level => {
                let spend = self.spend(known);
                rows.push(gradient, tie.wrong, |gradient| Row::far_level(gradient, tie.bend, spend));
            }
        }
        if known.deficit > 0.0 {
            rows.count(true);
            rows.raise(gradient, self.mend_m(known.deficit, gradient));
        }
    }

    /// (far)
    fn push_link<const D: usize>(
        &self,
        own: &Own<D>,
        offset: &Vector<D>,
        slope_max: f64,
        known: &Known,
        rows: &mut Rows<'_, D>,
    ) {
        let error_m = self.margin.offset_m;
        let own_share = self.loss_max(own.h.max(0.0)) / own.degree.max(1.0);
        let known_share = self.loss_max(known.budget) / known.degree_max;
        let beta_m2 = self.beta_m2(slope_max, own_share, known_share);
        if exceeds(rows.program.reach.most(offset, error_m, 1.0), beta_m2) {
            rows.push(offset, error_m, |offset| Row::far(offset, beta_m2));
        }
    }

    /// True when (far′), whose left-hand side is `most` wherever the robot can go, surely holds. No quotient: this is asked
    /// of every neighbour.
    fn is_slack(&self, most: f64, known: &Known) -> bool {
        most * (known.degree_max + 1.0) <= self.loss_max(known.budget)
    }

    pub(crate) fn push_own<const D: usize>(&self, own: &Own<D>, rows: &mut Rows<'_, D>) {
        if self.form() == Form::Level {
            let spend = self.loss_max(own.h.max(0.0)) / (own.degree + 1.0);
            if exceeds(rows.program.reach.most(&own.gradient, own.wrong, own.bend), spend) {
                rows.push(&own.gradient, own.wrong, |gradient| Row::far_level(gradient, own.bend, spend));
            }
        }
        if own.h < 0.0 {
            rows.count(own.h + own.degree * self.weight_error() < 0.0);
            rows.raise(&own.gradient, self.mend_m(-own.h, &own.gradient));
        }
    }

    #[inline(never)]
    fn push_near<const D: usize>(&self, offset: &Vector<D>, tie: &Tie, rows: &mut Rows<'_, D>) {
        let error_m = self.margin.offset_m;
        let spare_m2 = self.spare_m2(tie, -error_m);
        let give_m2 = self.give_m2(spare_m2);
        if exceeds(rows.program.reach.most(offset, error_m, 0.0), 0.5 * give_m2) {
            rows.push(offset, error_m, |offset| Row::near(offset, give_m2));
        }
        if spare_m2 < 0.0 {
            rows.count(self.spare_m2(tie, error_m) < 0.0);
            let missing_m = self.distance_min_m + error_m - tie.distance_m;
            rows.raise(offset, (0.5 * missing_m).min(self.move_max_m));
        }
    }

    /// How far to go along `gradient` (1/m) to make up for `deficit`, m, at most ρ.
    fn mend_m<const D: usize>(&self, deficit: f64, gradient: &Vector<D>) -> f64 {
        (deficit / length(gradient)).min(self.move_max_m)
    }
}

/// True where a row is needed: unless its left-hand side is never more than its `bound`, and for NaN.
fn exceeds(most: f64, bound: f64) -> bool {
    most > bound || most.is_nan() || bound.is_nan()
}
