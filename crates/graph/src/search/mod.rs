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
//! * **Symmetry**: if no pair of sets has a node taken at a place of the tree, none has one taken there to which an automorphism takes the
//!   node that keeps all that is known at this place (`board.rs`). Nodes with the same neighbours are seen at once, others after long
//!   searches.
//! * **Pieces**: what is long is cut into pieces, which threads that a caller lends may take at once (`pieces.rs`). The answer is that of
//!   the first piece that has one.
//! * **Late exemption**: a member is branched on as content or exempt only when nothing else is open.

mod board;
mod grow;
pub(crate) mod ledger;
pub(crate) mod peel;
mod pieces;
mod side;
pub mod symmetry;

use crate::definition::Witness;
use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::graph::word::Word;
use board::Board;
use grow::{Room, Search};

/// A witness that `graph` is not (r,s)-robust, or `None` if it is, by exhaustive search and by nothing else.
///
/// [`crate::decide::Robustness`] asks the bounds first and uses the table too. r = 0, s = 0 and single nodes: `None`.
//= paper def:robustness
pub fn witness(graph: &Graph, r: usize, s: usize, meter: &mut Meter<'_>) -> Result<Option<Witness>, Stopped> {
    witness_with(graph, r, s, Patience::DEFAULT, meter)
}

/// How long a search is before it is begun again with symmetry and in pieces, and how long the search of one node before its like
/// are looked for. Nodes of the tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patience {
    plain: u64,
    alike: u64,
}

impl Patience {
    pub(crate) const DEFAULT: Self = Self { plain: 2000, alike: 2000 };
}

/// As [`witness`], with a patience of its own.
pub(crate) fn witness_with(
    graph: &Graph,
    r: usize,
    s: usize,
    patience: Patience,
    meter: &mut Meter<'_>,
) -> Result<Option<Witness>, Stopped> {
    if r == 0 || s == 0 || graph.node_count() < 2 {
        return Ok(None);
    }
    meter.ask(r, s);
    let sets = if graph.node_count() <= 64 {
        sets::<u64>(graph, r, s, patience, meter)?
    } else {
        sets::<u128>(graph, r, s, patience, meter)?
    };
    let witness = sets.map(|(first, second)| Witness::new(graph, r, s, first, second));
    debug_assert!(witness.is_none_or(|witness| witness.holds(graph)), "{witness:?}");
    Ok(witness)
}

fn sets<W: Word + Send + Sync>(
    graph: &Graph,
    r: usize,
    s: usize,
    patience: Patience,
    meter: &mut Meter<'_>,
) -> Result<Option<(NodeSet, NodeSet)>, Stopped> {
    // Two disjoint sets: S₁ is sought with no more exempt members than S₂, so with half of them or fewer; and if none may be exempt,
    // with no more members, so with n/2 or fewer.
    let effort = count(s) - 1;
    let field = W::from_bits(graph.nodes().bits());
    let room = Room { effort, own: effort / 2, other: 0, field, pair: true };
    let board = Board::plain(graph, r);
    let short = meter.within(patience.plain, |meter| Search { board: &board, meter }.roots(room))?;
    let found = match short {
        Some(found) => found,
        None => pieces::search(&Board::with_symmetry(graph, r, patience.alike), room, meter)?,
    };
    Ok(found.map(|(first, second)| (NodeSet::from_bits(first.bits()), NodeSet::from_bits(second.bits()))))
}

/// Counts of nodes are at most 128; larger r and s change nothing above that.
fn count(value: usize) -> i32 {
    i32::try_from(value).unwrap_or(i32::MAX / 4)
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;
    use core::ops::ControlFlow;

    use super::*;
    use crate::definition;
    use crate::effort::Progress;
    use crate::makers::{fixed, random, symmetric};

    fn agree(graph: &Graph) {
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let mut meter = Meter::new(u64::MAX, &mut go_on);
        let at_once = Patience { plain: 0, alike: 0 };
        for r in 1..=graph.node_count().div_ceil(2) + 1 {
            for s in 1..=graph.node_count() {
                let with = witness_with(graph, r, s, at_once, &mut meter).unwrap();
                assert_eq!(with.is_none(), definition::is_robust(graph, r, s), "({r}, {s}), {graph:?}");
            }
        }
    }

    //= theory sec:symmetry type=test
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
            agree(&symmetric::multipartite(reach, 8 / reach).unwrap());
        }
        for graph in
            [fixed::hypercube(3), fixed::wheel(8), fixed::grid(3, 3), fixed::elemental(2), fixed::tight(8, 2)]
        {
            agree(&graph.unwrap());
        }
    }
}
