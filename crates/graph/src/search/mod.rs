//! Algorithm B: branch and bound over the smaller of the two sets.
//!
//! A member v of a set S is *content* if it hears at least need(v) = d(v) − r + 1 members; the others are exempt.
//! A graph is not (r,s)-robust iff two disjoint sets with at least one content member each have at most s − 1 exempt
//! members together. The search grows S₁, the set with no more exempt members than the other, and keeps for it what is certainly
//! in, what may still be in, and what may still be content (`side.rs`). Every conclusion drawn is monotone: it only
//! removes choices that no pair of sets makes, so an exhausted tree is a proof (docs/theory, `sec:cohesive`, `sec:bounds`,
//! `sec:search`). Beyond the usual branch and bound there are:
//!
//! * **Half the effort**: S₁ has at most (s − 1)/2 exempt members, S₂ then what is left. With s = 1 it has at most n/2
//!   members instead.
//! * **Size**: S₁ has at most n − |S₂| members, so a node that would be content only in a larger set is
//!   exempt, and a content node without room for a miss takes all further members from its neighbours.
//! * **One effort**: the least number of exempt members that the other set needs in what is left to it is not there
//!   for this one, and the other way round.
//! * **Symmetry**: if no pair of sets has a node content in S₁, none has its image under an automorphism there.
//! * **Late exemption**: a member is branched on as content or exempt only when nothing else is open.

mod grow;
pub(crate) mod ledger;
pub(crate) mod peel;
mod side;
pub mod symmetry;

use alloc::vec::Vec;
use core::cell::OnceCell;

use crate::definition::Witness;
use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::graph::word::Word;
use grow::Search;

/// A witness that `graph` is not (r,s)-robust, or `None` if it is, by exhaustive search and by nothing else.
///
/// [`crate::decide::Robustness`] asks the bounds first and uses the table too. r = 0, s = 0 and single nodes: `None`.
//= paper def:robustness
pub fn witness(graph: &Graph, r: usize, s: usize, meter: &mut Meter<'_>) -> Result<Option<Witness>, Stopped> {
    witness_with(graph, r, s, &Orbits::new(), meter)
}

/// Orbits of the nodes, computed at most once and only by a search that is long.
#[derive(Debug)]
pub(crate) struct Orbits {
    known: OnceCell<Vec<NodeSet>>,
    /// Nodes that a search visits before it looks for symmetries.
    patience: u64,
}

impl Orbits {
    pub(crate) fn new() -> Self {
        Self { known: OnceCell::new(), patience: 2000 }
    }

    /// The orbit of `root`, or as much as is known of it after a search of `nodes` nodes.
    fn of(&self, graph: &Graph, root: usize, nodes: u64) -> NodeSet {
        if nodes < self.patience {
            return NodeSet::from_iter([root]);
        }
        self.known.get_or_init(|| symmetry::orbits(graph))[root]
    }
}

/// As [`witness`]; `orbits` serve all questions about one graph.
pub(crate) fn witness_with(
    graph: &Graph,
    r: usize,
    s: usize,
    orbits: &Orbits,
    meter: &mut Meter<'_>,
) -> Result<Option<Witness>, Stopped> {
    if r == 0 || s == 0 || graph.node_count() < 2 {
        return Ok(None);
    }
    meter.ask(r, s);
    let sets = if graph.node_count() <= 64 {
        sets::<u64>(graph, r, s, orbits, meter)?
    } else {
        sets::<u128>(graph, r, s, orbits, meter)?
    };
    let witness = sets.map(|(first, second)| Witness::new(graph, r, s, first, second));
    debug_assert!(witness.is_none_or(|witness| witness.holds(graph)), "{witness:?}");
    Ok(witness)
}

fn sets<W: Word>(
    graph: &Graph,
    r: usize,
    s: usize,
    orbits: &Orbits,
    meter: &mut Meter<'_>,
) -> Result<Option<(NodeSet, NodeSet)>, Stopped> {
    let found = Search::<W>::new(graph, r, orbits, meter).pair(count(s) - 1)?;
    Ok(found.map(|(first, second)| (NodeSet::from_bits(first.bits()), NodeSet::from_bits(second.bits()))))
}

/// Counts of nodes are at most 128; larger r and s change nothing above that.
fn count(value: usize) -> i32 {
    i32::try_from(value).unwrap_or(i32::MAX / 4)
}

#[cfg(test)]
mod tests {
    use core::ops::ControlFlow;

    use super::*;
    use crate::definition;
    use crate::effort::Progress;
    use crate::makers::{fixed, random};

    fn agree(graph: &Graph) {
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let mut meter = Meter::new(u64::MAX, &mut go_on);
        let at_once = Orbits { known: OnceCell::new(), patience: 0 };
        for r in 1..=graph.node_count().div_ceil(2) + 1 {
            for s in 1..=graph.node_count() {
                let with = witness_with(graph, r, s, &at_once, &mut meter).unwrap();
                assert_eq!(with.is_none(), definition::is_robust(graph, r, s), "({r}, {s}), {graph:?}");
            }
        }
    }

    #[test]
    fn symmetry_hides_no_witness() {
        for code in 0..1_u32 << 10 {
            let pairs = (0..5).flat_map(|from| (from + 1..5).map(move |to| (from, to)));
            let chosen = pairs.enumerate().filter(|(bit, _)| code >> bit & 1 == 1).map(|(_, edge)| edge);
            agree(&Graph::undirected(5, &chosen.collect::<Vec<_>>()).unwrap());
        }
        for seed in 0..40 {
            agree(&random::erdos_renyi(4, 0.5, true, seed).unwrap());
            agree(&random::regular(8, 1 + usize::try_from(seed % 6).unwrap(), seed).unwrap());
        }
        for reach in 1..=4 {
            agree(&fixed::k_circulant(9, reach, true).unwrap());
            agree(&fixed::k_circulant(9, reach, false).unwrap());
            agree(&fixed::bipartite(reach, 8 - reach).unwrap());
        }
        for graph in
            [fixed::hypercube(3), fixed::wheel(8), fixed::grid(3, 3), fixed::elemental(2), fixed::tight(8, 2)]
        {
            agree(&graph.unwrap());
        }
    }
}
