//! The exact programs: the velocity or displacement closest to the desired one.

pub mod balls;
pub mod box_row;

use crate::num::{Vector, cut};

/// The input set U_i, a box that contains 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputBox<const D: usize> {
    /// Least velocity per axis, m/s, finite, at most 0.
    pub min_m_s: Vector<D>,
    /// Greatest velocity per axis, m/s, finite, at least 0.
    pub max_m_s: Vector<D>,
}

/// What the program found. Each of these is an answer, and none is an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The desired velocity, cut to the box, already satisfies the row.
    Free,
    /// The row changed the velocity and holds with equality.
    Active,
    /// No velocity in the box satisfies the row; the answer is the one that comes closest to it.
    Infeasible,
    /// Only under `budget`, outside the safe set: nothing gets worse, and what is broken is being mended.
    Recovering,
}

impl<const D: usize> InputBox<D> {
    /// The point of the box closest to `u`.
    #[must_use]
    pub fn clip(&self, u: &Vector<D>) -> Vector<D> {
        core::array::from_fn(|d| cut(u[d], self.min_m_s[d], self.max_m_s[d]))
    }

    /// True when `u` is inside, borders included.
    #[must_use]
    pub fn contains(&self, u: &Vector<D>) -> bool {
        (0..D).all(|d| self.min_m_s[d] <= u[d] && u[d] <= self.max_m_s[d])
    }
}
