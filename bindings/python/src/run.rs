//! A finished run.

use std::fs::File;
use std::io::BufWriter;
use std::sync::OnceLock;

use closeranks_core::num::Vector;
use closeranks_report::numbers::{Program, law, numbers};
use closeranks_report::parquet::{Metadata, write};
use closeranks_report::sentences;
use closeranks_report::table::{lines_of, table, text};
use closeranks_sim::law::Verdicts;
use closeranks_sim::monitors::robustness::Round;
use closeranks_sim::output::record::{Record, outcome_name};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world;
use closeranks_sweep::PROGRAM;
use numpy::PyArray2;
use pyo3::exceptions::{PyIndexError, PyOSError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::{OUTCOMES, interleaved, outcome_number, rows, view};
use crate::{errors, values};

/// What is said where every tick is asked for.
const UNRECORDED: &str = "this run was not recorded, allowed is a run with record=True";

/// What a run left behind. It never changes, so arrays may look into it.
#[pyclass(frozen, module = "closeranks._native")]
pub(crate) struct Run {
    scenario: Scenario,
    #[pyo3(get)]
    text: String,
    run: world::Run,
    positions_m: OnceLock<Vec<f64>>,
    inputs_m_s: OnceLock<Vec<f64>>,
    outcomes: OnceLock<Vec<u8>>,
}

impl Run {
    /// What `run` of `scenario` came to.
    pub(crate) fn new(scenario: Scenario, text: String, run: world::Run) -> Self {
        let (positions_m, inputs_m_s, outcomes) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Self { scenario, text, run, positions_m, inputs_m_s, outcomes }
    }

    fn record(&self) -> PyResult<&Record> {
        let record = self.run.record.as_ref();
        record.ok_or_else(|| errors::refused(UNRECORDED))
    }

    fn metadata(&self) -> Metadata<'_> {
        let Program { version, commit } = PROGRAM;
        let weight = self.scenario.link_shape().map_or([f64::NAN; 2], |link| [link.q1, link.q2]);
        Metadata { scenario: &self.text, seed: self.scenario.seed, version, commit, weight }
    }

    fn vectors<'py>(
        slf: &Bound<'py, Self>,
        kept: &OnceLock<Vec<f64>>,
        columns: impl FnOnce(&Record) -> &[Vec<f64>],
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let record = slf.get().record()?;
        let flat = kept.get_or_init(|| interleaved(columns(record)));
        view(flat, record.dimension, slf.clone().into_any())
    }
}

#[pymethods]
impl Run {
    /// x_i, (T n, D), m.
    fn positions<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        Self::vectors(slf, &slf.get().positions_m, |record| &record.positions_m)
    }

    /// u_i, (T n, D), m/s.
    fn velocities<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        Self::vectors(slf, &slf.get().inputs_m_s, |record| &record.inputs_m_s)
    }

    /// A column of numbers, (T, n).
    fn numbers<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let record = slf.get().record()?;
        let column = match name {
            "level" => &record.level,
            "told" => &record.told,
            "h" => &record.h,
            "phi" => &record.phi,
            "value" => &record.value,
            "value_told" => &record.value_told,
            "degree_sensed" => &record.degree_sensed,
            "level_sensed" => &record.level_sensed,
            _ => return Err(errors::refused(format!("no column is called \"{name}\""))),
        };
        view(column, usize::from(record.robots), slf.clone().into_any())
    }

    /// The second number of y_i and those after it, as held or as `told`: (T, n) each.
    fn more_values<'py>(slf: &Bound<'py, Self>, told: bool) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        let record = slf.get().record()?;
        let columns = if told { &record.more_values_told } else { &record.more_values };
        let one = |column: &Vec<f64>| view(column, usize::from(record.robots), slf.clone().into_any());
        columns.iter().map(one).collect()
    }

    /// delta_i, (T, n).
    fn degree<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<u16>>> {
        let record = slf.get().record()?;
        view(&record.degree, usize::from(record.robots), slf.clone().into_any())
    }

    /// What programs found, (T, n), by number.
    fn outcome<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<u8>>> {
        let record = slf.get().record()?;
        let numbers = slf
            .get()
            .outcomes
            .get_or_init(|| record.outcome.iter().map(|outcome| outcome_number(*outcome)).collect());
        view(numbers, usize::from(record.robots), slf.clone().into_any())
    }

    /// Names of outcomes, in the order of their numbers.
    #[staticmethod]
    fn outcome_names() -> [&'static str; 4] {
        OUTCOMES.map(outcome_name)
    }

    /// Pairs of robots that are linked at a tick, by index, and the weights of their links.
    fn edges<'py>(&self, py: Python<'py>, tick: usize) -> PyResult<(Bound<'py, PyArray2<i64>>, Vec<f64>)> {
        let record = self.record()?;
        if tick > record.last_tick() {
            let last = record.last_tick();
            return Err(PyIndexError::new_err(format!("tick {tick} is not one of 0 to {last}")));
        }
        let (pairs, weights) = match record.dimension {
            2 => links(&self.scenario, &points::<2>(record, tick))?,
            _ => links(&self.scenario, &points::<3>(record, tick))?,
        };
        Ok((rows(py, pairs, 2)?, weights))
    }

    /// What it came to, as the command line gives it with `--json`.
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let numbers = numbers(&self.scenario, &self.run, PROGRAM);
        values::from_json(py, &serde_json::Value::Object(numbers))
    }

    /// Names of the expected laws that were broken.
    fn failures(&self) -> Vec<&'static str> {
        self.run.summary.failures(&self.scenario).map(|verdict| verdict.law.name()).collect()
    }

    /// What became of each law.
    fn laws<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        laws(py, &self.scenario, &self.run.summary.verdicts)
    }

    /// The table and the laws, as the command line prints them.
    fn report(&self) -> String {
        let summary = &self.run.summary;
        let rows = text(&table(&lines_of(&self.scenario, &self.run, None)));
        let start = sentences::start(&self.scenario, summary);
        let notes: String =
            sentences::notes(&self.scenario, summary).into_iter().map(|note| note + "\n").collect();
        format!("{rows}\n{start}\n{notes}{}", sentences::laws(&self.scenario, summary))
    }

    /// Exact robustness of every consensus round: tick, r_max, F_max (least and most), least degree, spread.
    #[expect(clippy::type_complexity, reason = "a row")]
    fn rounds(&self) -> Vec<(u32, (i32, i32), (i32, i32), u16, f64)> {
        let row = |round: &Round| {
            let (r, f) = (round.r_max, round.f_max);
            (round.tick, (r.least, r.most), (f.least, f.most), round.degree_min, round.spread)
        };
        self.run.rounds.iter().map(row).collect()
    }

    /// The digest that the command line prints.
    fn digest(&self) -> PyResult<String> {
        let digest = self.run.digest.ok_or_else(|| errors::refused(UNRECORDED))?;
        Ok(format!("{digest:016x}"))
    }

    /// Writes every tick as the command line does.
    fn write_parquet(&self, py: Python<'_>, path: &str) -> PyResult<()> {
        let record = self.record()?;
        let (metadata, path) = (self.metadata(), path.to_owned());
        py.detach(|| {
            let file = File::create(&path).map_err(|error| format!("cannot write `{path}`: {error}"))?;
            write(record, &metadata, BufWriter::new(file)).map_err(|error| format!("{error}: `{path}`"))
        })
        .map_err(PyOSError::new_err)
    }
}

/// What became of each law.
pub(crate) fn laws<'py>(
    py: Python<'py>,
    scenario: &Scenario,
    verdicts: &Verdicts,
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for verdict in verdicts {
        dict.set_item(verdict.law.name(), values::from_json(py, &law(scenario, verdict))?)?;
    }
    Ok(dict)
}

fn points<const D: usize>(record: &Record, tick: usize) -> Vec<Vector<D>> {
    let robots = usize::from(record.robots);
    let point = |index| core::array::from_fn(|d| record.positions_m[d][record.row(tick, index)]);
    (0..robots).map(point).collect()
}

/// Linked pairs, flat, and the weight of each. Robots of different teams have no links.
fn links<const D: usize>(scenario: &Scenario, points: &[Vector<D>]) -> PyResult<(Vec<i64>, Vec<f64>)> {
    let (mut pairs, mut weights, mut first) = (Vec::new(), Vec::new(), 0);
    for team in scenario.each_team() {
        let params = team.params::<D>().map_err(errors::scenario)?;
        let end = first + usize::from(team.team.robots);
        for (one, other) in (first..end).flat_map(|other| (first..other).map(move |one| (one, other))) {
            let offset = core::array::from_fn(|d| points[one][d] - points[other][d]);
            if let Some(link) = params.link().link::<D, f64>(&offset) {
                pairs.extend([one, other].map(|index| i64::try_from(index).unwrap_or(i64::MAX)));
                weights.push(link.weight);
            }
        }
        first = end;
    }
    Ok((pairs, weights))
}
