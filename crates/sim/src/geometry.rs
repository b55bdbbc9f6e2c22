//! Distances of pairs of robots.

use closeranks_core::num::{Vector, dot, subtract};

/// `‖x − y‖²`, m².
#[must_use]
pub fn squared_distance<const D: usize>(x: &Vector<D>, y: &Vector<D>) -> f64 {
    let offset = subtract(x, y);
    dot(&offset, &offset)
}
