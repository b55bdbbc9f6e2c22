//! Everything about one graph in one call.

use alloc::vec::Vec;
use core::ops::ControlFlow;

use crate::bounds;
use crate::connectivity;
use crate::decide::Robustness;
use crate::definition::Witness;
use crate::effort::{Effort, Meter, Progress};
use crate::graph::Graph;
use crate::verdict::{Certificate, Interval};

/// What is proved about the robustness of a graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Analysis {
    /// Number of nodes n.
    pub node_count: usize,
    /// Whether the edges have a direction.
    pub directed: bool,
    /// Least in-degree δ.
    pub degree_min: usize,
    /// Largest in-degree Δ.
    pub degree_max: usize,
    /// Least number of nodes whose removal leaves a pair of nodes without a path, n − 1 if there is none.
    pub connectivity: usize,
    /// Largest F that δ ≥ F + floor(n/2) gives with all nodes normal, `None` if not even F = 0.
    pub f_by_degree: Option<usize>,
    /// Largest r with r-robustness, `0 ..= ceil(n/2)`.
    pub r_max: Interval,
    /// Largest F with (F+1,F+1)-robustness, −1 if not even (1,1).
    pub f_max: Interval,
    /// For r = 1 ..= ceil(n/2), in this order: largest s in `0 ..= n` with (r,s)-robustness, and how that much is known.
    pub s_max: Vec<(Interval, Certificate)>,
    /// Against (r_max + 1)-robustness; `None` if r_max is not exact or there is one node only.
    pub witness_r: Option<Witness>,
    /// Against (F_max + 2, F_max + 2)-robustness; `None` if F_max is not exact or there is one node only.
    pub witness_f: Option<Witness>,
    /// Nodes that all questions took.
    pub nodes: u64,
}

impl Analysis {
    /// Whether every number is exact.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        let table = self.s_max.iter().map(|(interval, _)| *interval);
        table.chain([self.r_max, self.f_max]).all(|interval| interval.exactly().is_some())
    }

    /// The largest F that is proved against F-local adversaries: (2F+1)-robust. `None` if r_max ≥ 1 is not proved.
    ///
    /// No F above r_max − 1 is possible, and [`crate::local`] finds the exact one of small graphs.
    #[must_use]
    pub fn f_local_least(&self) -> Option<i32> {
        (self.r_max.least > 0).then(|| (self.r_max.least - 1) / 2)
    }
}

/// Computes r_max, then F_max, then the table of s_max, until `effort` is spent or `report` answers `Break`.
///
/// `report` is called every few thousand nodes. What was proved by then is kept, as intervals.
//= paper def:robustness
pub fn analyze(
    graph: &Graph,
    effort: &Effort,
    report: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Analysis {
    analyze_with(graph, effort, &mut Meter::new(effort.nodes, report))
}

/// Answers all questions within `meter`, which may have threads to lend. Of `effort` only the memory is used.
//= paper def:robustness
pub fn analyze_with(graph: &Graph, effort: &Effort, meter: &mut Meter<'_>) -> Analysis {
    let mut robustness = Robustness::new(graph, effort);
    robustness.r_max(meter);
    robustness.f_max(meter);
    for r in 1..=graph.node_count().div_ceil(2) {
        robustness.s_max(r, meter);
    }
    summary(graph, &mut robustness, meter)
}

/// Largest r and largest F only, without a limit: what a monitor asks at every step.
#[must_use]
pub fn largest(graph: &Graph) -> (Interval, Interval) {
    let mut go_on = |_: &Progress| ControlFlow::Continue(());
    let mut meter = Meter::new(u64::MAX, &mut go_on);
    let mut robustness = Robustness::new(graph, &Effort::UNLIMITED);
    (robustness.r_max(&mut meter), robustness.f_max(&mut meter))
}

fn summary(graph: &Graph, robustness: &mut Robustness<'_>, spent: &Meter<'_>) -> Analysis {
    let mut stop = |_: &Progress| ControlFlow::Break(());
    let mut nothing = Meter::new(0, &mut stop);
    let (r_max, f_max) = (robustness.r_max(&mut nothing), robustness.f_max(&mut nothing));
    let rows = 1..=graph.node_count().div_ceil(2);
    let s_max = rows.map(|r| (robustness.s_max(r, &mut nothing), robustness.certificate(r))).collect();
    let above = |value: Interval, by: i32| value.exactly().and_then(|value| usize::try_from(value + by).ok());
    Analysis {
        node_count: graph.node_count(),
        directed: graph.is_directed(),
        degree_min: graph.degree_min(),
        degree_max: graph.degree_max(),
        connectivity: connectivity::node_connectivity(graph),
        f_by_degree: bounds::f_by_degree(graph, graph.nodes()),
        r_max,
        f_max,
        s_max,
        witness_r: above(r_max, 1).and_then(|r| robustness.witness(r, 1)),
        witness_f: above(f_max, 2).and_then(|r| robustness.witness(r, r)),
        nodes: spent.nodes(),
    }
}
