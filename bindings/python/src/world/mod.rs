//! A team in its world, one tick after another.

pub(crate) mod batch;

use core::time::Duration;
use std::time::Instant;

use closeranks_core::robot::report::Mode;
use closeranks_sim::output::record::outcome_name;
use closeranks_sim::scenario as sim;
use closeranks_sim::world::any::{AnyGiven, AnyWorld};
use closeranks_sim::world::{Engine, Options};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::rows;
use crate::errors;
use crate::run::{Run, laws};
use crate::scenario::Scenario;

/// Ticks between two looks at the clock.
const TICKS: u32 = 16;

/// A world that is stepped.
#[pyclass(module = "closeranks._native")]
pub(crate) struct World {
    scenario: sim::Scenario,
    text: String,
    /// None once the run was ended.
    world: Option<AnyWorld>,
}

impl World {
    fn open(&self) -> PyResult<&AnyWorld> {
        self.world.as_ref().ok_or_else(ended)
    }

    fn open_mut(&mut self) -> PyResult<&mut AnyWorld> {
        self.world.as_mut().ok_or_else(ended)
    }

    fn vectors<'py>(&self, py: Python<'py>, flat: &[f64]) -> PyResult<Bound<'py, PyArray2<f64>>> {
        rows(py, flat.to_vec(), self.scenario.dimension)
    }
}

fn ended() -> PyErr {
    errors::refused("this world was finished, allowed is a new one")
}

fn numbers<'a>(array: Option<&'a PyReadonlyArray1<'_, f64>>) -> PyResult<Option<&'a [f64]>> {
    array.map(|array| array.as_slice()).transpose().map_err(errors::refused)
}

#[pymethods]
impl World {
    #[new]
    #[pyo3(signature = (scenario, record, robustness, one_by_one))]
    fn new(scenario: &Scenario, record: bool, robustness: bool, one_by_one: bool) -> PyResult<Self> {
        let engine = if one_by_one { Engine::Robots } else { Engine::Team };
        let options = Options { record, robustness, engine, digest: record, ..Options::default() };
        let Scenario { scenario, text } = scenario.clone();
        let world = AnyWorld::new(&scenario, options).map_err(errors::scenario)?;
        Ok(Self { scenario, text, world: Some(world) })
    }

    /// Moves robots to where the next tick finds them.
    fn prepare(&mut self) -> PyResult<()> {
        self.open_mut()?.prepare();
        Ok(())
    }

    /// Computes the next tick with what is given, flat.
    #[pyo3(signature = (desired, levels, values))]
    fn step(
        &mut self,
        py: Python<'_>,
        desired: Option<PyReadonlyArray1<'_, f64>>,
        levels: Option<PyReadonlyArray1<'_, f64>>,
        values: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<()> {
        let given = AnyGiven {
            desired_m_s: numbers(desired.as_ref())?,
            levels: numbers(levels.as_ref())?,
            values: numbers(values.as_ref())?,
        };
        let world = self.open_mut()?;
        py.detach(|| world.step_with(&given)).map_err(errors::refused)
    }

    /// Computes ticks to the end of the run, but for `seconds` at most.
    fn advance(&mut self, py: Python<'_>, seconds: f64) -> PyResult<()> {
        let limit = Duration::try_from_secs_f64(seconds).map_err(errors::refused)?;
        let world = self.open_mut()?;
        py.detach(|| {
            #[expect(
                clippy::disallowed_methods,
                reason = "how often Python is asked, never what is computed"
            )]
            let start = Instant::now();
            while !world.is_over() {
                for _ in 0..TICKS {
                    if !world.is_over() {
                        world.step();
                    }
                }
                if start.elapsed() >= limit {
                    break;
                }
            }
        });
        Ok(())
    }

    /// Ends the run.
    fn finish(&mut self) -> PyResult<Run> {
        let world = self.world.take().ok_or_else(ended)?;
        if world.ticks_done() == 0 {
            self.world = Some(world);
            return Err(errors::refused("no tick was computed, allowed is at least one"));
        }
        Ok(Run::new(self.scenario.clone(), self.text.clone(), world.finish()))
    }

    #[getter]
    fn ticks_done(&self) -> PyResult<u32> {
        Ok(self.open()?.ticks_done())
    }

    #[getter]
    fn is_over(&self) -> PyResult<bool> {
        Ok(self.open()?.is_over())
    }

    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.vectors(py, self.open()?.positions_m())
    }

    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.vectors(py, self.open()?.velocities_m_s())
    }

    fn desired<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.vectors(py, self.open()?.desired_m_s())
    }

    fn h<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_slice(py, self.open()?.h()))
    }

    fn levels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_slice(py, self.open()?.levels()))
    }

    fn told<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_slice(py, self.open()?.told()))
    }

    fn phi<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_slice(py, self.open()?.phis()))
    }

    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_slice(py, self.open()?.held()))
    }

    fn values_told<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_slice(py, self.open()?.values()))
    }

    fn degree<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u16>>> {
        Ok(PyArray1::from_slice(py, self.open()?.degrees()))
    }

    fn outcomes(&self) -> PyResult<Vec<&'static str>> {
        Ok(self.open()?.outcomes().iter().map(|outcome| outcome_name(*outcome)).collect())
    }

    fn modes(&self) -> PyResult<Vec<&'static str>> {
        Ok(self.open()?.modes().iter().map(|mode: &Mode| mode.name()).collect())
    }

    fn laws<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        laws(py, &self.scenario, self.open()?.verdicts())
    }
}
