//! The rows of a tick: the program, the desired displacement, and what the state of this tick violates.

use crate::num::Vector;
use crate::program::balls::reach::Reach;
use crate::program::balls::row::Row;
use crate::program::balls::{Closest, Program};

/// Memory that the caller lends for one tick.
#[derive(Debug)]
pub struct Memory<'memory, const D: usize> {
    /// `2·D + 2·N + 1` rows are always enough for N neighbours. If positions have errors, `2·D + 2ᴰ (2·N + 1)` are.
    pub rows: &'memory mut [Row<D>],
    /// Numbers for [`Budget::survey`](crate::controller::budget::settings::Budget::survey).
    pub weights: &'memory mut [f64],
}

/// The rows of a tick.
#[derive(Debug)]
pub struct Rows<'memory, const D: usize> {
    /// The program; its rows are all that bounds the move.
    pub program: Program<'memory, D>,
    /// The desired displacement, m, as recovery has raised it.
    pub desired_m: Vector<D>,
    /// The robot's own h_i, of its level or of its trimmed level.
    pub h: f64,
    /// How many limits are certainly violated: h_i < 0, or another robot closer than Δ_d.
    pub broken: usize,
    /// How many limits may be violated. Without errors of positions this is the same as `broken`.
    pub doubtful: usize,
}

impl<'memory, const D: usize> Rows<'memory, D> {
    /// The box alone.
    pub(crate) fn new(desired_m: &Vector<D>, reach: Reach<D>, memory: &'memory mut [Row<D>]) -> Self {
        let desired_m = desired_m.map(|component| if component.is_finite() { component } else { 0.0 });
        Self { program: Program::new(memory, reach), desired_m, h: 0.0, broken: 0, doubtful: 0 }
    }

    /// Adds a row that holds at v = 0 alone, because nothing is known of the state.
    pub(super) fn forbid_any_move(&mut self) {
        self.program.push(Row::new([0.0; D], 1.0, 0.0));
        self.doubtful += 1;
    }

    /// The displacement, m, that is closest to the desired one among those where every row holds.
    #[must_use]
    pub fn closest(&mut self) -> Closest<D> {
        self.program.closest(&self.desired_m)
    }

    /// The same displacement up to rounding, found faster where `before_m` is close to it ([`Program::closest_from`]).
    #[must_use]
    pub fn closest_from(&mut self, before_m: &Vector<D>) -> Closest<D> {
        self.program.closest_from(&self.desired_m, before_m)
    }

    /// Adds the `row` of a `vector` that is known up to `error` along each axis. If the error is 0 that is one row; else it
    /// is one row for every corner of the cube around the vector.
    //= theory sec:margins
    pub(crate) fn push(&mut self, vector: &Vector<D>, error: f64, row: impl Fn(&Vector<D>) -> Row<D>) {
        if error == 0.0 {
            return self.program.keep(row(vector));
        }
        for corner in 0..1_usize << D.min(8) {
            let tilt = |d: usize| if corner >> d & 1 == 1 { error } else { -error };
            self.program.push(row(&core::array::from_fn(|d| vector[d] + tilt(d))));
        }
    }
}
