//! The search for the closest point, one broken row after the other.

use crate::num::{Vector, add_scaled, dot, is_finite, sqrt, subtract};
use crate::program::balls::Program;
use crate::program::balls::intersection::closest_on;
use crate::program::balls::row::Row;

/// A candidate may break a row by this fraction of its terms before [`settle`] pulls it back.
const NEARLY: f64 = 1e-6;

impl<const D: usize> Program<'_, D> {
    /// The closest point and the size of the working set.
    ///
    /// The closest point is that of a *working set* of rows. While a row outside it is broken, the most broken one joins
    /// and the closest point for the working set is found anew; it lies on the boundary of the newcomer. By the
    /// optimality conditions it is the point closest to the desired one among those where some subset of at most D rows
    /// holds with equality. (If another such point were as close, the Lagrangian, which is strictly convex, would have two
    /// minima.) So each subset with the newcomer gives one candidate in closed form, and the closest one that breaks no row is
    /// taken. If a boundary circle meets the rest in two arcs, both are looked at in this way. Every row joins once at most.
    /// Where no multipliers exist, the set is {0}, because two points of it would have a midpoint inside all balls.
    //= theory sec:program
    pub(super) fn search(&mut self, desired: &Vector<D>) -> (Vector<D>, usize) {
        let (mut v, mut working) = (*desired, 0);
        while let Some(worst) = self.worst(working, &v) {
            self.rows.swap(working, worst);
            v = repair(&self.rows[..=working], &v, desired);
            working += 1;
        }
        // No row beyond the working set is broken.
        let holds = is_finite(&v) && self.rows[..working].iter().all(|row| row.holds(&v));
        (if holds { v } else { [0.0; D] }, working)
    }

    /// The row beyond the working set that `v` breaks most.
    fn worst(&self, working: usize, v: &Vector<D>) -> Option<usize> {
        let (mut worst, mut most, square) = (None, 0.0, dot(v, v));
        for (row, index) in self.rows.get(working..self.count)?.iter().zip(working..) {
            if row.clears(v, square) {
                continue;
            }
            let excess = row.excess(v);
            if excess > most || excess.is_nan() {
                (worst, most) = (Some(index), excess);
            }
        }
        worst
    }
}

/// The closest point for `rows`, of which all but the last hold at `before`, the closest point without the last.
///
/// If the newcomer alone gives a point that holds everywhere, that is it. Else only rows which that point breaks can be
/// active with the newcomer: for two rows of which it breaks neither, it is the closest point already.
fn repair<const D: usize>(rows: &[Row<D>], before: &Vector<D>, desired: &Vector<D>) -> Vector<D> {
    let Some((newcomer, others)) = rows.split_last() else { return *before };
    let alone = closest_on(&[newcomer], desired);
    if let Some(alone) = alone.filter(|alone| is_finite(alone) && rows.iter().all(|row| row.holds(alone))) {
        return alone;
    }
    let mut search = Search { rows, desired, best: settle(rows, shorten(newcomer, before)) };
    if let Some(alone) = alone {
        search.consider(alone);
    }
    let breaks = |row: &Row<D>| alone.is_none_or(|alone| !row.holds(&alone));
    for (index, first) in others.iter().enumerate() {
        let first_breaks = breaks(first);
        if D >= 2 && first_breaks {
            search.consider_all(&[first, newcomer]);
        }
        if D >= 3 {
            for second in others[..index].iter().filter(|second| first_breaks || breaks(second)) {
                search.consider_all(&[first, second, newcomer]);
            }
        }
    }
    search.best
}

struct Search<'a, const D: usize> {
    rows: &'a [Row<D>],
    desired: &'a Vector<D>,
    best: Vector<D>,
}

impl<const D: usize> Search<'_, D> {
    fn consider_all(&mut self, boundaries: &[&Row<D>]) {
        if let Some(candidate) = closest_on(boundaries, self.desired) {
            self.consider(candidate);
        }
    }

    /// Takes the candidate if it is the best yet.
    fn consider(&mut self, candidate: Vector<D>) {
        if !is_finite(&candidate) || !self.is_closer(&candidate) {
            return;
        }
        if self.rows.iter().all(|row| row.holds(&candidate)) {
            self.best = candidate;
            return;
        }
        if self.rows.iter().all(|row| row.nearly_holds(&candidate, NEARLY)) {
            let settled = settle(self.rows, candidate);
            if self.is_closer(&settled) {
                self.best = settled;
            }
        }
    }

    /// `|v − desired|² < |best − desired|²`, without the cancellation.
    fn is_closer(&self, v: &Vector<D>) -> bool {
        let sum: Vector<D> =
            core::array::from_fn(|d| (v[d] - self.desired[d]) + (self.best[d] - self.desired[d]));
        dot(&subtract(v, &self.best), &sum) < 0.0
    }
}

/// Where the way from 0 to `v` leaves the row: `s v` with `c|v|² s² + n·v s = b`.
fn shorten<const D: usize>(row: &Row<D>, v: &Vector<D>) -> Vector<D> {
    let (along, square) = (dot(row.normal(), v), row.curvature() * dot(v, v));
    let root = sqrt(along * along + 4.0 * square * row.bound());
    let fraction =
        if along > 0.0 { 2.0 * row.bound() / (along + root) } else { (root - along) / (2.0 * square) };
    if (0.0..1.0).contains(&fraction) { v.map(|component| fraction * component) } else { *v }
}

/// Pulls `v` towards 0 until every row holds: by a few units in the last place, then by ever larger steps, to 0 at last.
fn settle<const D: usize>(rows: &[Row<D>], v: Vector<D>) -> Vector<D> {
    let mut settled = v;
    let mut step = f64::EPSILON;
    while step < 1.0 {
        if rows.iter().all(|row| row.holds(&settled)) {
            return settled;
        }
        settled = add_scaled(&settled, -step, &settled);
        step *= 4.0;
    }
    [0.0; D]
}
