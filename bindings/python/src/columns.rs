//! Numbers of a run as arrays of numpy.

use closeranks_core::program::Outcome;
use numpy::ndarray::ArrayView2;
use numpy::{Element, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::errors;

/// Flat vectors as an array of so many columns. Nothing is copied: the array owns them.
pub(crate) fn rows<T: Element>(
    py: Python<'_>,
    flat: Vec<T>,
    columns: usize,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let count = flat.len() / columns.max(1);
    PyArray1::from_vec(py, flat).reshape([count, columns])
}

/// A column of what `owner` keeps, as rows of `width` numbers: a view that cannot be written and keeps its owner alive.
#[expect(unsafe_code, reason = "numpy is lent memory of an object that never changes it")]
pub(crate) fn view<'py, T: Element>(
    column: &[T],
    width: usize,
    owner: Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<T>>> {
    let rows = column.len() / width.max(1);
    let shaped = ArrayView2::from_shape((rows, width), column).map_err(errors::refused)?;
    // SAFETY: `owner` is a frozen object, it owns `column`, and nothing in it changes or frees the column while it lives. The
    // array holds a reference to it, and is made read-only before anybody else sees it; numpy does not let such an array, which
    // does not own its data and whose base is no buffer, be made writeable again.
    let array = unsafe { PyArray2::borrow_from_array(&shaped, owner) };
    array.readwrite().make_nonwriteable();
    Ok(array)
}

/// One column a dimension as rows of points.
pub(crate) fn interleaved(columns: &[Vec<f64>]) -> Vec<f64> {
    let rows = columns.first().map_or(0, Vec::len);
    (0..rows).flat_map(|row| columns.iter().map(move |column| column[row])).collect()
}

/// Names of outcomes by their number.
pub(crate) const OUTCOMES: [Outcome; 4] =
    [Outcome::Free, Outcome::Active, Outcome::Infeasible, Outcome::Recovering];

/// The number of an outcome.
pub(crate) fn outcome_number(outcome: Outcome) -> u8 {
    match outcome {
        Outcome::Free => 0,
        Outcome::Active => 1,
        Outcome::Infeasible => 2,
        Outcome::Recovering => 3,
    }
}
