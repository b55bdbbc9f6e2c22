//! Witnesses that hold for any number of hops, in graphs of any size.

use alloc::vec::Vec;

use super::{HopQuestion, HopWitness};
use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;

/// Sets of liars that are tried at most.
const CUTS_MAX: usize = 200_000;

/// A node that hears fewer than r others, against all others: for r of two or more nobody there is reached by two paths from a single node.
pub(super) fn lonely(graph: &Graph, question: HopQuestion) -> Option<HopWitness> {
    let node = (0..graph.node_count()).min_by_key(|node| graph.in_degree(*node))?;
    let alone = NodeSet::from_iter([node]);
    let rest = graph.nodes().difference(alone);
    let stuck = question.r >= 2 && question.s >= 1 && graph.in_degree(node) < question.r && !rest.is_empty();
    stuck.then_some(HopWitness { question, liars: NodeSet::EMPTY, first: alone, second: rest })
}

/// Fewer than r nodes, all of them liars, without which two sets hear nobody else: over any number of hops they hear these alone.
pub(super) fn cut(
    graph: &Graph,
    question: HopQuestion,
    meter: &mut Meter<'_>,
) -> Result<Option<HopWitness>, Stopped> {
    let size = question.liars.min(question.r.saturating_sub(1));
    if question.s == 0 {
        return Ok(None);
    }
    let mut chosen: Vec<usize> = (0..size).collect();
    for _ in 0..CUTS_MAX {
        meter.spend(1)?;
        let liars: NodeSet = chosen.iter().copied().collect();
        if let Some((first, second)) = apart(graph, liars) {
            return Ok(Some(HopWitness { question, liars, first, second }));
        }
        if !advance(&mut chosen, graph.node_count()) {
            break;
        }
    }
    Ok(None)
}

/// The next set of as many nodes; false after the last one.
pub(super) fn advance(chosen: &mut [usize], count: usize) -> bool {
    let size = chosen.len();
    let Some(place) = (0..size).rev().find(|place| chosen[*place] + size < count + place) else {
        return false;
    };
    chosen[place] += 1;
    for later in place + 1..size {
        chosen[later] = chosen[later - 1] + 1;
    }
    true
}

/// Two disjoint sets that hear nobody outside of them but `liars`.
fn apart(graph: &Graph, liars: NodeSet) -> Option<(NodeSet, NodeSet)> {
    let rest = graph.nodes().difference(liars);
    let mut closed: Vec<NodeSet> = Vec::new();
    for node in rest.iter() {
        let set = heard_at_all(graph, rest, node);
        if let Some(other) = closed.iter().find(|other| other.is_disjoint(set)) {
            return Some((*other, set));
        }
        closed.push(set);
    }
    None
}

/// Whom `node` hears within `rest`, directly or through others.
fn heard_at_all(graph: &Graph, rest: NodeSet, node: usize) -> NodeSet {
    let mut known = NodeSet::from_iter([node]);
    loop {
        let more = known.iter().fold(known, |all, node| all.union(graph.in_neighbors(node)));
        let more = more.intersection(rest);
        if more == known {
            return known;
        }
        known = more;
    }
}
