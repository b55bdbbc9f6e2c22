//! Robustness of graphs.

use core::ops::ControlFlow;
use core::time::Duration;
use std::time::Instant;

use closeranks_graph::analysis::{self, Analysis};
use closeranks_graph::decide::Robustness;
use closeranks_graph::definition::Witness;
use closeranks_graph::effort::{Effort, Meter, Progress};
use closeranks_graph::graph::Graph;
use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::verdict::{Interval, Verdict};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors;

/// How often Python is asked whether to go on.
const LOOK: Duration = Duration::from_millis(50);

/// Stops a search at the time limit, or when Python says so.
struct Watch {
    start: Instant,
    looked: Instant,
    limit: Option<Duration>,
    look: Option<Py<PyAny>>,
    stopped: Option<PyErr>,
}

impl Watch {
    fn new(limit_s: Option<f64>, look: Option<Py<PyAny>>) -> PyResult<Self> {
        #[expect(
            clippy::disallowed_methods,
            reason = "the time limit decides how much is proved, never what"
        )]
        let start = Instant::now();
        let limit = limit_s.map(Duration::try_from_secs_f64).transpose().map_err(|_| {
            let found = limit_s.unwrap_or_default();
            errors::graph(format!("limit_s is {found}, allowed is a time from 0 on, or None"))
        })?;
        Ok(Self { start, looked: start, limit, look, stopped: None })
    }

    fn go_on(&mut self, progress: &Progress) -> ControlFlow<()> {
        if self.limit.is_some_and(|limit| self.start.elapsed() >= limit) {
            return ControlFlow::Break(());
        }
        if self.looked.elapsed() < LOOK {
            return ControlFlow::Continue(());
        }
        self.looked += self.looked.elapsed();
        let asked = Python::attach(|py| {
            py.check_signals()?;
            let look =
                self.look.as_ref().map(|look| look.call1(py, (progress.r, progress.s, progress.nodes)));
            look.transpose()
        });
        match asked {
            Ok(_) => ControlFlow::Continue(()),
            Err(error) => {
                self.stopped = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    fn finish(self) -> PyResult<()> {
        self.stopped.map_or(Ok(()), Err)
    }
}

fn graph(nodes: usize, edges: &[(usize, usize)], directed: bool) -> PyResult<Graph> {
    let graph = if directed { Graph::directed(nodes, edges) } else { Graph::undirected(nodes, edges) };
    graph.map_err(errors::graph)
}

fn members(set: NodeSet) -> Vec<usize> {
    set.iter().collect()
}

fn ends(interval: Interval) -> (i32, i32) {
    (interval.least, interval.most)
}

fn witness<'py>(py: Python<'py>, found: Option<&Witness>) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(found) = found else { return Ok(None) };
    let dict = PyDict::new(py);
    dict.set_item("r", found.r)?;
    dict.set_item("s", found.s)?;
    for (name, set) in [("first", found.first), ("second", found.second), ("exempt", found.exempt)] {
        dict.set_item(name, members(set))?;
    }
    Ok(Some(dict))
}

/// Everything about one graph.
#[pyfunction]
#[pyo3(signature = (nodes, edges, directed, limit_s, look))]
pub(crate) fn analyze(
    py: Python<'_>,
    nodes: usize,
    edges: Vec<(usize, usize)>,
    directed: bool,
    limit_s: Option<f64>,
    look: Option<Py<PyAny>>,
) -> PyResult<Bound<'_, PyDict>> {
    let graph = graph(nodes, &edges, directed)?;
    let mut watch = Watch::new(limit_s, look)?;
    let found =
        py.detach(|| analysis::analyze(&graph, &Effort::UNLIMITED, &mut |progress| watch.go_on(progress)));
    watch.finish()?;
    told(py, &found)
}

fn told<'py>(py: Python<'py>, found: &Analysis) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("n", found.node_count)?;
    dict.set_item("directed", found.directed)?;
    dict.set_item("degree_min", found.degree_min)?;
    dict.set_item("degree_max", found.degree_max)?;
    dict.set_item("connectivity", found.connectivity)?;
    dict.set_item("f_by_degree", found.f_by_degree)?;
    dict.set_item("r_max", ends(found.r_max))?;
    dict.set_item("f_max", ends(found.f_max))?;
    let rows = found.s_max.iter().map(|(s_max, certificate)| (ends(*s_max), certificate.to_string()));
    dict.set_item("s_max", rows.collect::<Vec<_>>())?;
    dict.set_item("witness_r", witness(py, found.witness_r.as_ref())?)?;
    dict.set_item("witness_f", witness(py, found.witness_f.as_ref())?)?;
    dict.set_item("nodes", found.nodes)?;
    dict.set_item("exact", found.is_exact())?;
    Ok(dict)
}

/// Is the graph (r, s)-robust? True, False or None, the certificate, the witness.
#[pyfunction]
#[pyo3(signature = (nodes, edges, directed, r, s, limit_s, look))]
#[expect(clippy::type_complexity, reason = "a row")]
#[expect(clippy::too_many_arguments, reason = "called from one place in Python")]
pub(crate) fn decide(
    py: Python<'_>,
    nodes: usize,
    edges: Vec<(usize, usize)>,
    directed: bool,
    r: usize,
    s: usize,
    limit_s: Option<f64>,
    look: Option<Py<PyAny>>,
) -> PyResult<(Option<bool>, Option<String>, Option<Bound<'_, PyDict>>)> {
    let graph = graph(nodes, &edges, directed)?;
    let mut watch = Watch::new(limit_s, look)?;
    let verdict = py.detach(|| {
        let mut go_on = |progress: &Progress| watch.go_on(progress);
        let mut meter = Meter::new(u64::MAX, &mut go_on);
        Robustness::new(&graph, &Effort::UNLIMITED).decide(r, s, &mut meter)
    });
    watch.finish()?;
    Ok(match verdict {
        Verdict::Robust(certificate) => (Some(true), Some(certificate.to_string()), None),
        Verdict::NotRobust(found) => (Some(false), None, witness(py, Some(&found))?),
        Verdict::Unknown => (None, None, None),
    })
}
