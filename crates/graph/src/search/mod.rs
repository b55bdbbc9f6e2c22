//! Algorithm B: branch and bound over the smaller of the two sets.
//!
//! A member v of a set S is *content* if it hears at least need(v) = d(v) − r + 1 members; the others are exempt.
//! A graph is not (r,s)-robust iff two disjoint sets with at least one content member each have at most s − 1 exempt
//! members together. The search grows S₁, the set with no more nodes than the other, and keeps for it what is certainly
//! in, what may still be in, and what may still be content (`side.rs`). Every conclusion drawn is monotone: it only
//! removes choices that no pair of sets makes, so an exhausted tree is a proof. Sources: `ROBUSTNESS.md` sections 1
//! and 3. New here:
//!
//! * **Size**: S₁ has at most min(n/2, n − |S₂|, |S₂|) members, so a node that would be content only in a larger set is
//!   exempt, and a content node without room for a miss takes all further members from its neighbours.
//! * **One budget**: the least number of exempt members that the other set needs in what is left to it is not there
//!   for this one, and the other way round.
//! * **Late exemption**: a member is branched on as content or exempt only when nothing else is open.

mod grow;
pub(crate) mod peel;
mod side;

use crate::budget::{Meter, Stopped};
use crate::definition::Witness;
use crate::graph::Graph;
use crate::set::NodeSet;
use crate::word::Word;
use grow::Search;

/// A witness that `graph` is not (r,s)-robust, or `None` if it is, by exhaustive search and by nothing else.
///
/// [`crate::decide::Robustness`] asks the bounds first and uses the table too. r = 0, s = 0 and single nodes: `None`.
//= paper def:robustness
pub fn witness(graph: &Graph, r: usize, s: usize, meter: &mut Meter<'_>) -> Result<Option<Witness>, Stopped> {
    if r == 0 || s == 0 || graph.node_count() < 2 {
        return Ok(None);
    }
    meter.ask(r, s);
    let sets = if graph.node_count() <= 64 {
        sets::<u64>(graph, r, s, meter)?
    } else {
        sets::<u128>(graph, r, s, meter)?
    };
    let witness = sets.map(|(first, second)| Witness::new(graph, r, s, first, second));
    debug_assert!(witness.is_none_or(|witness| witness.holds(graph)), "{witness:?}");
    Ok(witness)
}

fn sets<W: Word>(
    graph: &Graph,
    r: usize,
    s: usize,
    meter: &mut Meter<'_>,
) -> Result<Option<(NodeSet, NodeSet)>, Stopped> {
    let found = Search::<W>::new(graph, r, meter).pair(count(s) - 1)?;
    Ok(found.map(|(first, second)| (NodeSet::from_bits(first.bits()), NodeSet::from_bits(second.bits()))))
}

/// Counts of nodes are at most 128; larger r and s change nothing above that.
fn count(value: usize) -> i32 {
    i32::try_from(value).unwrap_or(i32::MAX / 4)
}
