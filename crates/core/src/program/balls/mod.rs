//! The exact program: the closest point of an intersection of balls, half-spaces and a box that all contain 0.

mod flat;
mod intersection;
pub mod reach;
pub mod row;
mod search;
mod warm_start;

use crate::num::Vector;
use crate::program::Outcome;
use crate::program::balls::reach::Reach;
use crate::program::balls::row::Row;

/// A desired displacement counts up to this many times the longest move.
const DESIRED_MAX: f64 = 1e6;

/// The rows of one tick in memory that the caller lends: 2·D for the box, one for a ball that cuts anything off it, and one for each row that does not contain it.
#[derive(Debug)]
pub struct Program<'memory, const D: usize> {
    rows: &'memory mut [Row<D>],
    count: usize,
    full: bool,
    pub(crate) reach: Reach<D>,
}

/// What [`Program::closest`] returns.
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
    /// A program that has the rows of the box, and of the ball if it cuts anything off.
    //= theory sec:disc
    #[must_use]
    pub fn new(memory: &'memory mut [Row<D>], reach: Reach<D>) -> Self {
        let mut program = Self { rows: memory, count: 0, full: false, reach };
        for d in 0..D {
            program.keep(Row::side(d, 1.0, reach.max_m()[d]));
            program.keep(Row::side(d, -1.0, -reach.min_m()[d]));
        }
        if let Some(ball_m) = reach.ball_m() {
            program.keep(Row::new([0.0; D], 1.0, ball_m * ball_m));
        }
        program
    }

    /// Adds a row, unless it holds in the whole box.
    pub fn push(&mut self, row: Row<D>) {
        if !row.contains(&self.reach) {
            self.keep(row);
        }
    }

    /// Adds the `row` of a `vector` that is known up to `error` along each axis. If the error is 0 that is one row; else it
    /// is one row for every corner of the cube around the vector.
    //= theory sec:margins
    pub(crate) fn push_around(&mut self, vector: &Vector<D>, error: f64, row: impl Fn(&Vector<D>) -> Row<D>) {
        if error == 0.0 {
            return self.keep(row(vector));
        }
        for corner in 0..1_usize << D.min(8) {
            let tilt = |d: usize| if corner >> d & 1 == 1 { error } else { -error };
            self.push(row(&core::array::from_fn(|d| vector[d] + tilt(d))));
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
    //= theory sec:program
    #[must_use]
    pub fn closest(&mut self, desired_m: &Vector<D>) -> Closest<D> {
        self.closest_from(desired_m, &[0.0; D])
    }

    /// The program seen from `to` (m), a point in which all rows hold: the same set of displacements, as steps from there.
    pub(crate) fn shift(&mut self, to: &Vector<D>) {
        for row in &mut self.rows[..self.count] {
            *row = row.shifted(to);
        }
    }

    /// The result of [`closest`](Self::closest) up to rounding. It is found faster where `before_m` is close to it, as the
    /// displacement of the tick before is.
    ///
    /// The two boundaries nearest to `before_m` give one candidate. If the optimality conditions hold there, it is the closest
    /// point; else the search begins as if nothing were known.
    #[must_use]
    pub fn closest_from(&mut self, desired_m: &Vector<D>, before_m: &Vector<D>) -> Closest<D> {
        let desired = self.finite(desired_m);
        let (v, working) = match self.warm_start(&desired, before_m) {
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

    fn finite(&self, desired_m: &Vector<D>) -> Vector<D> {
        let most = DESIRED_MAX * self.reach.longest_m();
        let number = desired_m.map(|component| if component.is_finite() { component } else { 0.0 });
        let largest = number.iter().fold(0.0_f64, |largest, component| largest.max(component.abs()));
        if largest <= most { number } else { number.map(|component| component / largest * most) }
    }
}
