//! Adversaries that are few in every neighbourhood (F-local) instead of few in all (F-total).

use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::roles::{self, Liars, Question, Split};

/// Whether `malicious` is an F-total set: at most F nodes.
//= paper ftotal
#[must_use]
pub fn is_total(malicious: NodeSet, f: usize) -> bool {
    malicious.len() <= f
}

/// Whether `malicious` is an F-local set: every other node hears at most F of them.
#[must_use]
pub fn is_local(graph: &Graph, malicious: NodeSet, f: usize) -> bool {
    local_least(graph, malicious) <= f
}

/// Least F for which `malicious` is F-local: the most malicious nodes that a normal node hears.
#[must_use]
pub fn local_least(graph: &Graph, malicious: NodeSet) -> usize {
    let normal = graph.nodes().difference(malicious);
    normal.iter().map(|node| graph.in_neighbors(node).intersection(malicious).len()).max().unwrap_or(0)
}

/// Two sets that never agree under an F-local attack.
///
/// Every normal member of either set hears at most F nodes outside of its own set, and both have a normal member:
/// W-MSR(F) removes all that it hears from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LocalWitness {
    /// F.
    pub f: usize,
    /// The malicious nodes D, an F-local set. Those in S₁ or S₂ keep that set's value.
    pub malicious: NodeSet,
    /// S₁.
    pub first: NodeSet,
    /// S₂.
    pub second: NodeSet,
}

impl LocalWitness {
    /// Whether the claim is true of `graph`, word for word.
    #[must_use]
    pub fn holds(&self, graph: &Graph) -> bool {
        let stays = |set: NodeSet| {
            let normal = set.difference(self.malicious);
            let heard = |node: usize| graph.in_neighbors(node).difference(set).len();
            !normal.is_empty() && normal.iter().all(|node| heard(node) <= self.f)
        };
        let inside = self.first.union(self.second).union(self.malicious).is_subset(graph.nodes());
        let sets = inside && self.first.is_disjoint(self.second) && stays(self.first) && stays(self.second);
        sets && is_local(graph, self.malicious, self.f)
    }
}

/// A witness against resilience to F-local malicious nodes, or `None` if there is none, by a search over the roles of all nodes.
///
/// One place of the search counts as one node of `meter`. `None` is implied by (2F+1)-robustness and implies (F+1,F+1)-robustness,
/// since F-total sets are F-local.
//= theory sec:local
pub fn witness(graph: &Graph, f: usize, meter: &mut Meter<'_>) -> Result<Option<LocalWitness>, Stopped> {
    let question = Question { r: f.saturating_add(1), liars: Liars::Local };
    let found = roles::split(graph, question, meter)?;
    Ok(found.map(|Split { liars, first, second }| {
        let witness = LocalWitness { f, malicious: liars, first, second };
        debug_assert!(witness.holds(graph), "{witness:?}");
        witness
    }))
}

/// Largest F such that W-MSR(F) withstands every F-local set of malicious nodes, −1 if it fails without any.
///
/// Exact, by [`witness`] for F = 0, 1, …: at least floor((r_max − 1)/2) and at most F_max.
pub fn f_max(graph: &Graph, meter: &mut Meter<'_>) -> Result<i32, Stopped> {
    let mut f = -1;
    for asked in 0..graph.node_count().div_ceil(2) {
        if witness(graph, asked, meter)?.is_some() {
            break;
        }
        f += 1;
    }
    Ok(f)
}
