//! Strong r-robustness with respect to leaders, and bootstrap percolation.
//!
//! A network whose leaders agree can pull everyone along, past malicious nodes, if no set of followers closes itself off.

use crate::graph::Graph;
use crate::graph::set::NodeSet;

/// The nodes that follow `leaders`: whoever hears r or more of them follows too, and so on.
///
/// ```text
/// A_0 = leaders,   A_{k+1} = A_k ∪ { v : |N(v) ∩ A_k| ≥ r }
/// ```
///
/// Bootstrap percolation with threshold r; O(n²) words of bits.
#[must_use]
pub fn followers(graph: &Graph, leaders: NodeSet, r: usize) -> NodeSet {
    let mut active = leaders.intersection(graph.nodes());
    loop {
        let idle = graph.nodes().difference(active);
        let woken = idle.iter().filter(|&node| graph.in_neighbors(node).intersection(active).len() >= r);
        let woken: NodeSet = woken.collect();
        if woken.is_empty() {
            return active;
        }
        active = active.union(woken);
    }
}

/// Whether `graph` is strongly r-robust with respect to `leaders`: every nonempty set of other nodes is r-reachable.
///
/// It holds exactly if all nodes follow. With no node but leaders it holds for every r.
//= paper reachability
#[must_use]
pub fn is_strongly_robust(graph: &Graph, leaders: NodeSet, r: usize) -> bool {
    closed_set(graph, leaders, r).is_none()
}

/// The largest nonempty set without leaders whose members all hear fewer than r nodes outside of it, if there is one.
//= paper reachability
#[must_use]
pub fn closed_set(graph: &Graph, leaders: NodeSet, r: usize) -> Option<NodeSet> {
    let rest = graph.nodes().difference(followers(graph, leaders, r));
    (!rest.is_empty()).then_some(rest)
}

/// Largest r, `0 ..= n`, such that `graph` is strongly r-robust with respect to `leaders`; `None` if all nodes are leaders.
///
/// W-MSR with leaders that agree withstands F-local malicious followers if it is 2F + 1 or more.
#[must_use]
pub fn strong_r_max(graph: &Graph, leaders: NodeSet) -> Option<usize> {
    if graph.nodes().is_subset(leaders) {
        return None;
    }
    (1..=graph.node_count()).take_while(|&r| is_strongly_robust(graph, leaders, r)).last().or(Some(0))
}
