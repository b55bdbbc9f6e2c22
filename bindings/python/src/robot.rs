//! One robot: the filter alone.

use core::time::Duration;

use closeranks_core::controller::links::wire::bytes_max;
use closeranks_core::num::Vector;
use closeranks_core::robot as core_robot;
use closeranks_core::robot::error::{ObserveError, Observed};
use closeranks_core::robot::neighbor::Member;
use closeranks_core::{Instant, MESSAGE_BYTES, RobotId, Slot};
use closeranks_sim::engine::memory::Memory;
use closeranks_sim::scenario as sim;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors;
use crate::output::Output;
use crate::scenario::Scenario;

/// A robot with its memory.
struct Machine<const D: usize> {
    robot: core_robot::Robot<D, Vec<Slot<D>>>,
    memory: Memory<D>,
    /// The rank of each robot of the team, where there are ranks.
    ranks: Option<Vec<u16>>,
    /// Room for the bytes of a message.
    message: Vec<u8>,
}

/// A robot in the plane or in space.
#[expect(clippy::large_enum_variant, reason = "few, and long-lived")]
enum Any {
    Plane(Machine<2>),
    Space(Machine<3>),
}

/// Calls the same of whichever it is.
macro_rules! dispatch {
    ($of:expr, $machine:ident => $call:expr) => {
        match $of {
            Any::Plane($machine) => $call,
            Any::Space($machine) => $call,
        }
    };
}

/// One robot without a world: the native part of `closeranks.Robot`.
#[pyclass(module = "closeranks._native")]
pub(crate) struct Robot {
    any: Any,
}

impl<const D: usize> Machine<D> {
    fn new(scenario: &sim::Scenario, id: u16, value: f64, slots: usize) -> PyResult<Self> {
        let params = scenario.params::<D>().map_err(errors::robot)?;
        let ranks = scenario.ranks::<D>().map_err(errors::robot)?;
        let own = member(ranks.as_deref(), id);
        let robot = core_robot::Robot::new(params, own, value, vec![Slot::default(); slots]);
        let robot = robot.map_err(errors::robot)?;
        let message = vec![0; MESSAGE_BYTES.max(bytes_max(scenario.team.robots, D))];
        let memory = Memory::new(&params, slots).among(&scenario.obstacles.in_dimension());
        Ok(Self { robot, memory, ranks, message })
    }

    fn observe(&mut self, id: u16, position: &[f64]) -> PyResult<&'static str> {
        let other = member(self.ranks.as_deref(), id);
        said(id, self.robot.observe(other, vector(position)?))
    }

    fn observe_stranger(&mut self, id: u16, position: &[f64]) -> PyResult<&'static str> {
        said(id, self.robot.observe_stranger(RobotId(id), vector(position)?))
    }

    fn share<'py>(&mut self, py: Python<'py>) -> Option<Bound<'py, PyBytes>> {
        let message = self.robot.share(&mut self.memory.lend())?;
        let length = self.robot.encode(&message, &mut self.message)?;
        Some(PyBytes::new(py, &self.message[..length]))
    }

    fn tick(&mut self, py: Python<'_>, desired: &[f64]) -> PyResult<Output> {
        let desired = vector(desired)?;
        Ok(Output::new(py, &self.robot.tick(desired, &mut self.memory.lend())))
    }
}

/// What the robot says of another one that it observed.
fn said(id: u16, seen: Result<Observed, ObserveError>) -> PyResult<&'static str> {
    match seen {
        Ok(Observed::Neighbor) => Ok("neighbor"),
        Ok(Observed::Stranger) => Ok("stranger"),
        Ok(Observed::InView) => Ok("in view"),
        Ok(Observed::OutOfRange) => Ok("out of range"),
        Err(error) => Err(errors::robot(format!("{error} (robot {id})"))),
    }
}

/// A robot as the roster has it: with its rank, which is 0 where there are none.
fn member(ranks: Option<&[u16]>, id: u16) -> Member {
    let rank = ranks.and_then(|ranks| ranks.get(usize::from(id).checked_sub(1)?)).copied();
    Member { id: RobotId(id), rank: rank.unwrap_or(0) }
}

fn vector<const D: usize>(numbers: &[f64]) -> PyResult<Vector<D>> {
    let wrong = |_| errors::robot(format!("a vector of {} numbers, must have {D}", numbers.len()));
    numbers.try_into().map_err(wrong)
}

/// Seconds as a time of the core.
fn instant(seconds: f64) -> PyResult<Instant> {
    let wrong = |_| errors::robot(format!("now_s is {seconds}, allowed is a time from 0 on that is finite"));
    let since = Duration::try_from_secs_f64(seconds).map_err(wrong)?;
    Ok(Instant::START.after(since))
}

#[pymethods]
impl Robot {
    #[new]
    #[pyo3(signature = (scenario, id, value, slots, team))]
    fn new(scenario: &Scenario, id: u16, value: f64, slots: usize, team: Option<usize>) -> PyResult<Self> {
        let whole = &scenario.scenario;
        let own = team.and_then(|team| whole.teams.get(team)).unwrap_or(whole);
        let any = match own.dimension {
            2 => Any::Plane(Machine::new(own, id, value, slots)?),
            _ => Any::Space(Machine::new(own, id, value, slots)?),
        };
        Ok(Self { any })
    }

    fn restart(&mut self, value: f64) -> PyResult<()> {
        dispatch!(&mut self.any, machine => machine.robot.restart(value)).map_err(errors::robot)
    }

    fn sense(&mut self, now_s: f64, position: Vec<f64>) -> PyResult<()> {
        let now = instant(now_s)?;
        dispatch!(&mut self.any, machine => machine.robot.sense(now, vector(&position)?))
            .map_err(errors::robot)
    }

    fn observe(&mut self, id: u16, position: Vec<f64>) -> PyResult<&'static str> {
        dispatch!(&mut self.any, machine => machine.observe(id, &position))
    }

    fn observe_stranger(&mut self, id: u16, position: Vec<f64>) -> PyResult<&'static str> {
        dispatch!(&mut self.any, machine => machine.observe_stranger(id, &position))
    }

    fn dismiss(&mut self, id: u16) {
        dispatch!(&mut self.any, machine => machine.robot.dismiss(RobotId(id)));
    }

    fn observe_all(
        &mut self,
        ids: PyReadonlyArray1<'_, i64>,
        positions: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<()> {
        let (ids, positions) = (ids.as_array(), positions.as_array());
        if ids.len() != positions.nrows() {
            let (found, robots) = (positions.nrows(), ids.len());
            return Err(errors::robot(format!("{found} positions for {robots} robots")));
        }
        for (id, position) in ids.iter().zip(positions.rows()) {
            let id = u16::try_from(*id).unwrap_or(0);
            let position = position.to_vec();
            dispatch!(&mut self.any, machine => machine.observe(id, &position))?;
        }
        Ok(())
    }

    fn share<'py>(&mut self, py: Python<'py>) -> Option<Bound<'py, PyBytes>> {
        dispatch!(&mut self.any, machine => machine.share(py))
    }

    fn receive(&mut self, sender: u16, message: &[u8]) -> PyResult<()> {
        let taken =
            dispatch!(&mut self.any, machine => machine.robot.receive_bytes(RobotId(sender), message));
        taken.map_err(|error| errors::message(format!("{error} (robot {sender})")))
    }

    fn restate(&mut self, level: f64) {
        dispatch!(&mut self.any, machine => machine.robot.restate(level));
    }

    fn tick(&mut self, py: Python<'_>, desired: Vec<f64>) -> PyResult<Output> {
        dispatch!(&mut self.any, machine => machine.tick(py, &desired))
    }

    #[getter]
    fn id(&self) -> u16 {
        dispatch!(&self.any, machine => machine.robot.id().0)
    }

    #[getter]
    fn value(&self) -> f64 {
        dispatch!(&self.any, machine => machine.robot.value())
    }

    #[getter]
    fn told_level(&self) -> f64 {
        dispatch!(&self.any, machine => machine.robot.told_level())
    }

    #[getter]
    fn poll_at_s(&self) -> f64 {
        let due = dispatch!(&self.any, machine => machine.robot.poll_at());
        Duration::from_nanos(due.as_nanos()).as_secs_f64()
    }

    #[getter]
    fn neighbors(&self) -> Vec<u16> {
        dispatch!(&self.any, machine => machine.robot.neighbors().iter().map(|slot| slot.id().0).collect())
    }

    #[getter]
    fn strangers(&self) -> Vec<u16> {
        dispatch!(&self.any, machine => machine.robot.strangers().iter().map(|slot| slot.id().0).collect())
    }

    #[getter]
    fn discarded(&self) -> Vec<u16> {
        dispatch!(&self.any, machine => {
            let discarded = machine.robot.neighbors().iter().filter(|slot| slot.discarded());
            discarded.map(|slot| slot.id().0).collect()
        })
    }
}
