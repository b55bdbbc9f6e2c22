//! Rules of consensus on arrays.

use closeranks_core::consensus::Rule;
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors;

/// The rule of this name.
fn named(name: &str) -> PyResult<Rule> {
    let found = Rule::ALL.into_iter().find(|(each, _)| *each == name);
    found.map(|(_, rule)| rule).ok_or_else(|| {
        let allowed = Rule::ALL.map(|(name, _)| name).join(", ");
        errors::refused(format!("no rule on arrays is called \"{name}\", allowed are {allowed}"))
    })
}

/// Names of all rules, and the graph that each needs.
#[pyfunction]
pub(crate) fn rules() -> Vec<(&'static str, &'static str)> {
    Rule::ALL.map(|(name, rule)| (name, rule.condition())).to_vec()
}

/// One robot, one round: new value, discarded below and above, least and greatest value kept, how many kept.
#[pyfunction]
pub(crate) fn rule_update(
    name: &str,
    own: f64,
    told: PyReadonlyArray1<'_, f64>,
    faults: u16,
) -> PyResult<(f64, usize, usize, f64, f64, usize)> {
    if !own.is_finite() {
        return Err(errors::refused(format!("own is {own}, allowed is a finite number")));
    }
    let round = named(name)?.update(own, &mut told.as_array().to_vec(), faults);
    Ok((round.value, round.below, round.above, round.low, round.high, round.kept))
}

/// A whole team, one round: row i of `told` holds what robot i was told, NaN where it was told nothing.
#[pyfunction]
pub(crate) fn rule_step<'py>(
    py: Python<'py>,
    name: &str,
    values: PyReadonlyArray1<'py, f64>,
    told: PyReadonlyArray2<'py, f64>,
    faults: u16,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (values, told) = (values.as_array(), told.as_array());
    if told.dim() != (values.len(), values.len()) {
        let ((rows, columns), robots) = (told.dim(), values.len());
        return Err(errors::refused(format!("`told` is {rows} x {columns}, must be {robots} x {robots}")));
    }
    if let Some(robot) = values.iter().position(|value| !value.is_finite()) {
        return Err(errors::refused(format!("`values` of robot {} is not finite", robot + 1)));
    }
    let (rule, mut row) = (named(name)?, Vec::with_capacity(values.len()));
    let next = values.iter().zip(told.rows()).enumerate().map(|(index, (own, told))| {
        row.clear();
        row.extend(told.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, value)| *value));
        rule.update(*own, &mut row, faults).value
    });
    Ok(PyArray1::from_vec(py, next.collect()))
}
