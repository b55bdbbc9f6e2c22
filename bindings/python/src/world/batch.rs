//! Many worlds of one scenario, stepped together on all cores, and side by side on each where the engine can.

use closeranks_core::message::VALUE_MAX;
use closeranks_sim::scenario as sim;
use closeranks_sim::world::Options;
use closeranks_sim::world::any::{AnyGiven, AnyWorld};
use closeranks_sim::world::block::Block;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::errors;
use crate::run::laws;
use crate::scenario::Scenario;
use crate::world::numbers;

/// Worlds that differ in their seeds alone.
#[pyclass(module = "closeranks._native")]
pub(crate) struct Batch {
    scenario: sim::Scenario,
    /// The worlds in order of their seeds.
    blocks: Vec<Block>,
    /// None for one thread: the caller's, which need not wait for another one.
    pool: Option<ThreadPool>,
}

/// The part of an array that is about world `index` of `worlds`.
fn part(array: Option<&[f64]>, index: usize, worlds: usize) -> Option<&[f64]> {
    array.map(|array| {
        let size = array.len() / worlds.max(1);
        &array[index * size..(index + 1) * size]
    })
}

/// Refuses an array with a number that is not `good`, before any world is stepped.
fn check(
    name: &str,
    array: Option<&[f64]>,
    worlds: usize,
    robots: usize,
    good: fn(f64) -> bool,
) -> PyResult<()> {
    let Some(array) = array else { return Ok(()) };
    let Some(bad) = array.iter().position(|number| !good(*number)) else { return Ok(()) };
    let size = (array.len() / worlds.max(1)).max(1);
    let (world, robot) = (bad / size, bad % size / (size / robots.max(1)).max(1) + 1);
    Err(errors::refused(format!(
        "`{name}` of robot {robot} in world {world} is {:e}, which is not a finite number that can be told",
        array[bad]
    )))
}

impl Batch {
    fn worlds(&self) -> impl Iterator<Item = &AnyWorld> {
        self.blocks.iter().flat_map(Block::worlds)
    }

    /// What `of` says of every world, one after another.
    fn all<'py, T: numpy::Element + Copy>(
        &self,
        py: Python<'py>,
        of: impl Fn(&AnyWorld) -> &[T],
    ) -> Bound<'py, PyArray1<T>> {
        let flat: Vec<T> = self.worlds().flat_map(|world| of(world).iter().copied()).collect();
        PyArray1::from_vec(py, flat)
    }
}

#[pymethods]
impl Batch {
    /// A world for each seed; `jobs` threads, 0 for one a core.
    #[new]
    fn new(py: Python<'_>, scenario: &Scenario, seeds: Vec<u64>, jobs: usize) -> PyResult<Self> {
        let scenario = scenario.scenario.clone();
        let pool = (jobs != 1).then(|| ThreadPoolBuilder::new().num_threads(jobs).build());
        let pool = pool.transpose().map_err(errors::refused)?;
        let blocks = py.detach(|| Block::of_all(&scenario, &seeds, Options::default()));
        let mut blocks = blocks.map_err(errors::scenario)?;
        blocks.iter_mut().for_each(Block::prepare);
        Ok(Self { scenario, blocks, pool })
    }

    /// Computes `ticks` ticks of every world with what is given, flat, held for as long.
    fn step(
        &mut self,
        py: Python<'_>,
        desired: Option<PyReadonlyArray1<'_, f64>>,
        levels: Option<PyReadonlyArray1<'_, f64>>,
        values: Option<PyReadonlyArray1<'_, f64>>,
        ticks: u32,
    ) -> PyResult<()> {
        let (desired, levels, values) =
            (numbers(desired.as_ref())?, numbers(levels.as_ref())?, numbers(values.as_ref())?);
        let (count, robots) = (self.worlds().count(), usize::from(self.scenario.team.robots));
        check("desired", desired, count, robots, f64::is_finite)?;
        check("levels", levels, count, robots, f64::is_finite)?;
        check("values", values, count, robots, |value| value.abs() <= VALUE_MAX)?;
        let mut given = (0..count).map(|index| {
            let part = |array| part(array, index, count);
            AnyGiven { desired_m_s: part(desired), levels: part(levels), values: part(values) }
        });
        let pool = &self.pool;
        let mut parts: Vec<(&mut Block, Vec<AnyGiven<'_>>)> = (self.blocks.iter_mut())
            .map(|block| {
                let given = given.by_ref().take(block.worlds().len()).collect();
                (block, given)
            })
            .collect();
        let one =
            |(block, given): &mut (&mut Block, Vec<AnyGiven<'_>>)| block.advance(given.as_slice(), ticks);
        let done = py.detach(|| match pool {
            Some(pool) => pool.install(|| parts.par_iter_mut().try_for_each(one)),
            None => parts.iter_mut().try_for_each(one),
        });
        done.map_err(errors::refused)
    }

    #[getter]
    fn ticks_done(&self) -> u32 {
        self.worlds().next().map_or(0, AnyWorld::ticks_done)
    }

    #[getter]
    fn is_over(&self) -> bool {
        self.worlds().next().is_none_or(AnyWorld::is_over)
    }

    fn positions<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.all(py, AnyWorld::positions_m)
    }

    fn velocities<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.all(py, AnyWorld::velocities_m_s)
    }

    fn desired<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.all(py, AnyWorld::desired_m_s)
    }

    fn h<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.all(py, AnyWorld::h)
    }

    fn levels<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.all(py, AnyWorld::levels)
    }

    fn phi<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.all(py, AnyWorld::phis)
    }

    fn values<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.all(py, AnyWorld::held)
    }

    fn values_told<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.all(py, AnyWorld::values)
    }

    fn degree<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u16>> {
        self.all(py, AnyWorld::degrees)
    }

    /// What became of each law in a world.
    fn laws<'py>(&self, py: Python<'py>, world: usize) -> PyResult<Bound<'py, PyDict>> {
        let found =
            self.worlds().nth(world).ok_or_else(|| errors::refused(format!("there is no world {world}")))?;
        laws(py, &self.scenario, found.verdicts())
    }
}
