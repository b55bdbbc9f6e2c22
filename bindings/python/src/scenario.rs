//! What to run.

use annotate_snippets::Renderer;
use closeranks_core::RobotId;
use closeranks_core::obstacle::Obstacle;
use closeranks_core::robot::neighbor::Member;
use closeranks_report::problems;
use closeranks_sim::parse::{self, Files};
use closeranks_sim::scenario::{self as sim, Controller};
use closeranks_sim::sweep::is_drawn;
use closeranks_sim::world::initial_values;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use crate::columns::rows;
use crate::{errors, paper, values};

/// A scenario that was read and checked, with its text.
#[pyclass(frozen, module = "closeranks._native")]
#[derive(Clone)]
pub(crate) struct Scenario {
    pub(crate) scenario: sim::Scenario,
    /// TOML that reads as this scenario.
    #[pyo3(get)]
    pub(crate) text: String,
}

/// The files that a scenario text names, each beside it.
#[pyfunction]
pub(crate) fn named(text: &str) -> Vec<String> {
    parse::named(text)
}

/// Names of all controllers, and what each is, in one line.
#[pyfunction]
pub(crate) fn controllers() -> Vec<(&'static str, &'static str)> {
    Controller::ALL.iter().map(|controller| (controller.name(), controller.row().about)).collect()
}

/// Reads `text`, which messages call `name`, with the texts of `files` beside it.
fn read(text: &str, name: &str, files: &Files) -> PyResult<Scenario> {
    match parse::scenario_with(text, files) {
        Ok(scenario) => Ok(Scenario { scenario, text: parse::inlined(text, files) }),
        Err(_) if is_drawn(text) => Err(errors::scenario(format!(
            "`{name}` draws values, so it is many scenarios: run them with `closeranks sweep`"
        ))),
        Err(wrong) => {
            let picture = problems::picture(&Renderer::plain(), name, text, &wrong);
            Err(errors::scenario(picture.trim_end()))
        }
    }
}

/// `table` with the fields of `over` in it; tables in it too, unless `over` has one of another kind.
fn merge(table: &mut toml::Table, over: toml::Table) {
    for (name, value) in over {
        match (table.get_mut(&name), value) {
            (Some(toml::Value::Table(old)), toml::Value::Table(new)) if is_alike(&name, old, &new) => {
                merge(old, new);
            }
            (_, value) => _ = table.insert(name, value),
        }
    }
}

/// True if fields of `old` still mean something beside those of `new`. Controllers keep their parameters side by side.
fn is_alike(name: &str, old: &toml::Table, new: &toml::Table) -> bool {
    name == "controller" || new.get("kind").is_none_or(|kind| old.get("kind") == Some(kind))
}

/// The rank of each robot of a team, where it has ranks.
fn ranks(team: &sim::Scenario) -> PyResult<Option<Vec<u16>>> {
    match team.dimension {
        2 => team.ranks::<2>().map_err(errors::scenario),
        _ => team.ranks::<3>().map_err(errors::scenario),
    }
}

/// How many robots that count for it each robot of a team must keep as neighbours.
fn needs<const D: usize>(team: &sim::Scenario) -> PyResult<Vec<u16>> {
    let Some(ranks) = ranks(team)? else {
        return Ok(vec![team.composition().required; usize::from(team.team.robots)]);
    };
    let params = team.params::<D>().map_err(errors::scenario)?;
    let need = |(rank, id)| params.need().need(Member { id: RobotId(id), rank });
    Ok(ranks.into_iter().zip(1..).map(need).collect())
}

#[pymethods]
impl Scenario {
    /// The scenario of a TOML text that messages call `name`; `files` has the texts of files beside it.
    #[staticmethod]
    #[pyo3(signature = (text, name, files))]
    fn from_toml(text: &str, name: &str, files: Vec<(String, Option<String>, String)>) -> PyResult<Self> {
        let file = |(name, text, why): (String, Option<String>, String)| (name, text.ok_or(why));
        read(text, name, &files.into_iter().map(file).collect())
    }

    /// One of the paper's.
    #[staticmethod]
    fn paper(attack: &str, start: &str) -> PyResult<Self> {
        let text = paper::text(attack, start).map_err(errors::scenario)?;
        read(text, &format!("{start}-{attack}"), &Files::default())
    }

    /// This scenario with other values for some fields.
    fn replace(&self, fields: &Bound<'_, PyDict>) -> PyResult<Self> {
        let over = values::table(fields)?;
        if over.is_empty() {
            return Ok(self.clone());
        }
        let mut table: toml::Table = self.text.parse().map_err(errors::scenario)?;
        merge(&mut table, over);
        read(&table.to_string(), "scenario", &Files::default())
    }

    /// This scenario under another controller, with what it expects.
    fn under(&self, controller: &str) -> PyResult<Self> {
        let other = Controller::named(controller).ok_or_else(|| {
            let names: Vec<&str> = Controller::ALL.iter().map(|controller| controller.name()).collect();
            let allowed = names.join(", ");
            errors::scenario(format!("no controller is called \"{controller}\", allowed are {allowed}"))
        })?;
        let scenario = self.scenario.clone().under(other);
        let mut table: toml::Table = self.text.parse().map_err(errors::scenario)?;
        let kind = toml::Table::from_iter([("kind".to_owned(), controller.into())]);
        merge(&mut table, toml::Table::from_iter([("controller".to_owned(), kind.into())]));
        if table.contains_key("expect") {
            let laws = scenario.expect.iter().map(|law| toml::Value::String(law.name().to_owned()));
            table.insert("expect".to_owned(), toml::Value::Array(laws.collect()));
        }
        read(&table.to_string(), "scenario", &Files::default())
    }

    /// The fields of the text, as dicts, lists and numbers.
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let table: toml::Table = self.text.parse().map_err(errors::scenario)?;
        values::from_toml(py, &toml::Value::Table(table))
    }

    /// Where robots start, (n, D), m.
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let flat = match self.scenario.dimension {
            2 => self.scenario.positions::<2>().map_err(errors::scenario)?.into_flattened(),
            _ => self.scenario.positions::<3>().map_err(errors::scenario)?.into_flattened(),
        };
        rows(py, flat, self.scenario.dimension)
    }

    /// Both ends of each obstacle and how far it reaches around them, (k, 2 D + 1), m.
    fn obstacles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let dimension = self.scenario.dimension;
        let row = |one: &Obstacle<3>| {
            let ends = one.from_m[..dimension].iter().chain(&one.to_m[..dimension]).copied();
            ends.chain([one.radius_m]).collect::<Vec<f64>>()
        };
        rows(py, self.scenario.obstacles.list.iter().flat_map(row).collect(), 2 * dimension + 1)
    }

    /// y_i(t_0), (n,).
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_vec(py, initial_values(&self.scenario).map_err(errors::scenario)?))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.scenario.name
    }

    #[getter]
    fn seed(&self) -> u64 {
        self.scenario.seed
    }

    #[getter]
    fn robots(&self) -> u16 {
        self.scenario.team.robots
    }

    #[getter]
    fn faults(&self) -> u16 {
        self.scenario.team.faults
    }

    #[getter]
    fn malicious(&self) -> Vec<u16> {
        self.scenario.malicious.clone()
    }

    /// Of each of several teams its name, n, F and F'; none of one team alone.
    fn teams(&self) -> Vec<(String, u16, u16, u16)> {
        let of = |team: &sim::Scenario| {
            (team.name.clone(), team.team.robots, team.team.faults, team.composition().required)
        };
        self.scenario.teams.iter().map(of).collect()
    }

    /// The rank of each robot, if there are ranks.
    fn ranks(&self) -> PyResult<Option<Vec<u16>>> {
        let each: PyResult<Vec<_>> = self.scenario.each_team().iter().map(ranks).collect();
        Ok(each?.into_iter().collect::<Option<Vec<_>>>().map(|each| each.concat()))
    }

    /// How many neighbours each robot must keep.
    fn required_degrees(&self) -> PyResult<Vec<u16>> {
        let each = self.scenario.each_team().iter();
        let each: PyResult<Vec<_>> = match self.scenario.dimension {
            2 => each.map(needs::<2>).collect(),
            _ => each.map(needs::<3>).collect(),
        };
        Ok(each?.concat())
    }

    #[getter]
    fn dimension(&self) -> usize {
        self.scenario.dimension
    }

    #[getter]
    fn duration_s(&self) -> f64 {
        self.scenario.duration_s
    }

    #[getter]
    fn ticks(&self) -> u32 {
        self.scenario.ticks()
    }

    #[getter]
    fn tick_s(&self) -> f64 {
        self.scenario.tick_s()
    }

    #[getter]
    fn ticks_per_round(&self) -> u32 {
        self.scenario.ticks_per_round()
    }

    #[getter]
    fn controller(&self) -> &'static str {
        self.scenario.controller.name()
    }

    #[getter]
    fn radius_m(&self) -> f64 {
        self.scenario.link.radius_m
    }

    #[getter]
    fn distance_min_m(&self) -> f64 {
        self.scenario.limits.distance_min_m
    }

    #[getter]
    fn speed_max_m_s(&self) -> Vec<f64> {
        self.scenario.limits.input_max_m_s.clone()
    }

    #[getter]
    fn required_degree(&self) -> u16 {
        let each = self.scenario.each_team().iter();
        each.map(|team| team.composition().required).min().unwrap_or(0)
    }

    #[getter]
    fn expect(&self) -> Vec<&'static str> {
        self.scenario.expect.iter().map(|law| law.name()).collect()
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| other.get().scenario == self.scenario)
    }

    fn __repr__<'py>(&self, py: Python<'py>) -> Bound<'py, PyString> {
        PyString::new(py, &self.text)
    }
}
