//! The exact program: the closest point of an intersection of balls, half-spaces and a box that all contain 0.

mod intersection;
pub mod reach;
pub mod row;
mod warm_start;

use crate::num::{Vector, add_scaled, dot, is_finite, sqrt, subtract};
use crate::program::Outcome;
use crate::program::balls::intersection::closest_on;
use crate::program::balls::reach::Reach;
use crate::program::balls::row::Row;

/// A candidate may break a row by this share of its terms before [`settle`] pulls it back.
const NEARLY: f64 = 1e-6;
/// A desired displacement counts up to this many times the longest move.
const DESIRED_MAX: f64 = 1e6;

/// The rows of one tick in memory that the caller lends: 2·D for the box, and one for each row that does not contain it.
#[derive(Debug)]
pub struct Program<'memory, const D: usize> {
    rows: &'memory mut [Row<D>],
    count: usize,
    full: bool,
    pub(crate) reach: Reach<D>,
}

/// Answer of [`Program::closest`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest<const D: usize> {
    /// v, m: in the box, and every row holds.
    pub displacement_m: Vector<D>,
    /// `Free` if the desired displacement was admissible, `Active` if rows changed it. `Infeasible` would say that not even
    /// 0 satisfies all rows: every [`Row`] is made so that it does.
    pub outcome: Outcome,
    /// How many rows had to be looked at together.
    pub working: usize,
}

impl<'memory, const D: usize> Program<'memory, D> {
    /// The box alone.
    #[must_use]
    pub fn new(memory: &'memory mut [Row<D>], reach: Reach<D>) -> Self {
        let mut program = Self { rows: memory, count: 0, full: false, reach };
        for d in 0..D {
            program.keep(Row::side(d, 1.0, reach.max_m()[d]));
            program.keep(Row::side(d, -1.0, -reach.min_m()[d]));
        }
        program
    }

    /// Adds a row, unless it holds in the whole box.
    pub fn push(&mut self, row: Row<D>) {
        if !row.contains(&self.reach) {
            self.keep(row);
        }
    }

    /// The rows kept, those of the box included.
    #[must_use]
    pub fn rows(&self) -> &[Row<D>] {
        &self.rows[..self.count]
    }

    /// True when the memory was too small for the rows. Then [`closest`](Self::closest) is 0.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.full
    }

    /// `arg min |v − desired|²` over the box and all rows, m.
    ///
    /// Exact for D ≤ 3 up to rounding: in boxes of 1 m certified to 1e-12 m for ordinary sets, and where duplicates,
    /// tangents and empty budgets meet, no sample was closer by more than 1e-9 m. Feasible for every D: each candidate is
    /// pulled towards 0 until every row of the working set [holds](Row::holds), and what breaks any row is not returned.
    /// A component that is not finite counts as 0, a desired displacement beyond 10⁶ longest moves is shortened to that.
    //= method computing
    #[must_use]
    pub fn closest(&mut self, desired_m: &Vector<D>) -> Closest<D> {
        self.closest_from(desired_m, &[0.0; D])
    }

    /// The same up to rounding, and faster where `before_m` is close to the answer, as the displacement of the tick before is.
    ///
    /// The two boundaries nearest to `before_m` give one candidate. If the optimality conditions hold there, it is the closest
    /// point; else the search begins as if nothing were known.
    #[must_use]
    pub fn closest_from(&mut self, desired_m: &Vector<D>, before_m: &Vector<D>) -> Closest<D> {
        let desired = self.finite(desired_m);
        let (v, working) = match self.guess(&desired, before_m) {
            _ if self.full => ([0.0; D], 0),
            Some(v) => (v, 2),
            None => self.search(&desired),
        };
        let outcome = match v {
            _ if v == [0.0; D] && !self.rows().iter().all(|row| row.holds(&v)) => Outcome::Infeasible,
            _ if v == *desired_m => Outcome::Free,
            _ => Outcome::Active,
        };
        Closest { displacement_m: v, outcome, working }
    }

    /// The answer and the size of the working set.
    ///
    /// The closest point is that of a *working set* of rows. While a row outside it is broken, the most broken one joins
    /// and the closest point for the working set is found anew; it lies on the boundary of the newcomer. By the
    /// optimality conditions it is the point closest to the desired one among those where some subset of at most D rows
    /// holds with equality (were another such point as close, the Lagrangian, strictly convex, had two minima): so each
    /// subset with the newcomer gives one candidate in closed form, and the closest one that breaks no row is taken. Both
    /// arcs, where a boundary circle meets the rest in two, are so looked at. Every row joins once at most. Where no
    /// multipliers exist, the set is {0}: two points of it would have a midpoint inside all balls.
    fn search(&mut self, desired: &Vector<D>) -> (Vector<D>, usize) {
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

    /// Adds a row.
    #[inline]
    pub(crate) fn keep(&mut self, row: Row<D>) {
        match self.rows.get_mut(self.count) {
            Some(place) => {
                *place = row;
                self.count += 1;
            }
            None => self.full = true,
        }
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

    fn finite(&self, desired_m: &Vector<D>) -> Vector<D> {
        let most = DESIRED_MAX * self.reach.longest_m();
        let number = desired_m.map(|component| if component.is_finite() { component } else { 0.0 });
        let largest = number.iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
        if largest <= most { number } else { number.map(|component| component / largest * most) }
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
    let share =
        if along > 0.0 { 2.0 * row.bound() / (along + root) } else { (root - along) / (2.0 * square) };
    if (0.0..1.0).contains(&share) { v.map(|component| share * component) } else { *v }
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
