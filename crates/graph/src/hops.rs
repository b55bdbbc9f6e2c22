//! Robustness with two hops: what a graph must be if robots pass on what they were told.
//!
//! Yuan and Ishii 2021 (arXiv 2201.03214), for two hops and F liars in all. With F ⊂ V the liars and S a set of nodes,
//!
//! ```text
//! Z^r_S = { i ∈ S : at least r paths of at most two edges lead from outside S to i, disjoint but for i, with no liar in their middle }
//! (r,s)-robust with two hops: for all sets of at most F liars and all disjoint nonempty S₁, S₂:
//!     Z^r_S₁ = S₁   or   Z^r_S₂ = S₂   or   |Z^r_S₁| + |Z^r_S₂| ≥ s
//! ```
//!
//! W-MSR over two hops withstands any F liars if and only if the graph is (F + 1, F + 1)-robust with two hops. A path of two edges is of use
//! only from a node that i does not hear, through a node of S that it hears: whom it hears outside of S it hears at first hand.
//! So the most disjoint paths are those nodes and a largest matching.

use alloc::vec;
use alloc::vec::Vec;

use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;

/// Graphs with more nodes are refused: all pairs of disjoint sets are looked at.
pub const NODES_MAX: usize = 14;

/// Two sets that never agree over two hops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HopWitness {
    /// F.
    pub f: usize,
    /// Those who pass on nothing that is true.
    pub liars: NodeSet,
    /// S₁.
    pub first: NodeSet,
    /// S₂.
    pub second: NodeSet,
}

/// How many disjoint paths of at most two edges lead to `node` from outside of `set`, to which it belongs, with no one of `liars` in the middle.
#[must_use]
pub fn paths(graph: &Graph, set: NodeSet, liars: NodeSet, node: usize) -> usize {
    let heard = graph.in_neighbors(node);
    let middles: Vec<usize> = heard.intersection(set).difference(liars).iter().collect();
    let direct = heard.difference(set);
    let sources = graph.nodes().difference(set).difference(heard);
    let mut taken: Vec<Option<usize>> = vec![None; graph.node_count()];
    let matched = middles.iter().filter(|middle| {
        let mut tried = NodeSet::EMPTY;
        augment(graph, **middle, sources, &mut taken, &mut tried)
    });
    direct.len() + matched.count()
}

/// Finds a source for `middle`, moving others to further ones where that helps.
fn augment(
    graph: &Graph,
    middle: usize,
    sources: NodeSet,
    taken: &mut [Option<usize>],
    tried: &mut NodeSet,
) -> bool {
    for source in graph.in_neighbors(middle).intersection(sources).iter() {
        if tried.contains(source) {
            continue;
        }
        tried.insert(source);
        let free = match taken[source] {
            None => true,
            Some(other) => augment(graph, other, sources, taken, tried),
        };
        if free {
            taken[source] = Some(middle);
            return true;
        }
    }
    false
}

/// Two sets against (F + 1, F + 1)-robustness with two hops, or `None` if there are none: exact. `Err` if `meter` says so, or if the graph has more
/// than [`NODES_MAX`] nodes.
pub fn witness(graph: &Graph, f: usize, meter: &mut Meter<'_>) -> Result<Option<HopWitness>, Stopped> {
    if graph.node_count() > NODES_MAX {
        return Err(Stopped);
    }
    let all = graph.nodes().bits();
    // More liars leave fewer paths, so that sets of exactly F are enough.
    let size = f.min(graph.node_count());
    for liars in (0..=all).map(NodeSet::from_bits).filter(|liars| liars.len() == size) {
        if let Some((first, second)) = sides(graph, f, liars, meter)? {
            return Ok(Some(HopWitness { f, liars, first, second }));
        }
    }
    Ok(None)
}

fn sides(
    graph: &Graph,
    f: usize,
    liars: NodeSet,
    meter: &mut Meter<'_>,
) -> Result<Option<(NodeSet, NodeSet)>, Stopped> {
    let all = graph.nodes().bits();
    let mut reached: Vec<usize> = Vec::new();
    for set in (0..=all).map(NodeSet::from_bits) {
        meter.spend(1)?;
        reached.push(set.iter().filter(|node| paths(graph, set, liars, *node) > f).count());
    }
    let holds_out = |set: u128| {
        let count = NodeSet::from_bits(set).len();
        let reached = usize::try_from(set).ok().and_then(|set| reached.get(set).copied()).unwrap_or(count);
        (set != 0 && reached < count && reached <= f).then_some(reached)
    };
    for first in 1..=all {
        let Some(one) = holds_out(first) else { continue };
        let rest = all & !first;
        let mut second = rest;
        while second > first {
            if holds_out(second).is_some_and(|other| one + other <= f) {
                return Ok(Some((NodeSet::from_bits(first), NodeSet::from_bits(second))));
            }
            second = (second - 1) & rest;
        }
        meter.spend(1)?;
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    extern crate std;

    use core::ops::ControlFlow;

    use super::*;
    use crate::definition;
    use crate::makers::fixed::{complete, ring};

    fn robust(graph: &Graph, f: usize) -> bool {
        let mut go = |_: &_| ControlFlow::Continue(());
        witness(graph, f, &mut Meter::new(u64::MAX, &mut go)) == Ok(None)
    }

    /// Over all graphs of five nodes: whatever is robust with one hop is with two, without liars both ask for a connected graph, and some graphs
    /// gain by the second hop.
    #[test]
    fn two_hops_ask_for_less() {
        let pairs: Vec<(usize, usize)> = (0..5).flat_map(|b| (0..b).map(move |a| (a, b))).collect();
        let mut gained = 0;
        for mask in 0_u32..1 << pairs.len() {
            let edges: Vec<_> = pairs
                .iter()
                .enumerate()
                .filter(|(place, _)| mask >> place & 1 == 1)
                .map(|(_, pair)| *pair)
                .collect();
            let graph = Graph::undirected(5, &edges).unwrap();
            let once = definition::is_robust(&graph, 2, 2);
            let twice = robust(&graph, 1);
            assert!(twice || !once, "{edges:?}");
            assert_eq!(robust(&graph, 0), definition::is_robust(&graph, 1, 1));
            gained += u32::from(twice && !once);
        }
        assert!(gained > 0);
    }

    #[test]
    fn rings_and_complete_graphs() {
        assert!(robust(&ring(5).unwrap(), 1) && !robust(&ring(8).unwrap(), 1));
        assert!(robust(&complete(5).unwrap(), 2) && !robust(&complete(4).unwrap(), 2));
        let big = complete(NODES_MAX + 1).unwrap();
        let mut go = |_: &_| ControlFlow::Continue(());
        assert_eq!(witness(&big, 1, &mut Meter::new(u64::MAX, &mut go)), Err(Stopped));
    }
}
