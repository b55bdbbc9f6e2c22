//! All subsets at once, for one set of liars after another.

use alloc::vec::Vec;

use super::paths::Paths;
use super::quick::advance;
use super::{HopQuestion, HopWitness};
use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;

/// Stands for sets that are in no witness: the empty one, those that are all reached, those with too many reached members.
const NEVER: u8 = u8::MAX;

/// Two sets against the question, or `None` if there are none: exact, for graphs of at most [`super::NODES_MAX`] nodes.
///
/// With z(S) = |Z^r_S| and g(C) = min { z(S) : S nonempty, S ⊆ C, Z^r_S ≠ S }, the graph is (r,s)-robust for one set of liars
/// exactly if g(C) + g(V \ C) ≥ s for all C.
pub(super) fn witness(
    graph: &Graph,
    question: HopQuestion,
    meter: &mut Meter<'_>,
) -> Result<Option<HopWitness>, Stopped> {
    // More liars leave fewer paths, so that sets of exactly f are enough.
    let mut chosen: Vec<usize> = (0..question.liars.min(graph.node_count())).collect();
    loop {
        let liars = chosen.iter().copied().collect();
        let reached = reached(graph, question, liars, meter)?;
        if let Some((first, second)) = sides(graph.node_count(), question.s, &reached, meter)? {
            return Ok(Some(HopWitness { question, liars, first, second }));
        }
        if !advance(&mut chosen, graph.node_count()) {
            return Ok(None);
        }
    }
}

/// z(S) for every S, or [`NEVER`].
fn reached(
    graph: &Graph,
    question: HopQuestion,
    liars: NodeSet,
    meter: &mut Meter<'_>,
) -> Result<Vec<u8>, Stopped> {
    let paths = Paths { graph, hops: question.hops, liars };
    let mut table = Vec::with_capacity(1 << graph.node_count());
    for bits in 0..1_u128 << graph.node_count() {
        meter.spend(1)?;
        let set = NodeSet::from_bits(bits);
        let mut count = 0;
        for node in set.iter() {
            if count >= question.s {
                break;
            }
            count += usize::from(paths.are_at_least(question.r, set, node, meter)?);
        }
        let never = count >= question.s || count == set.len();
        table.push(if never { NEVER } else { u8::try_from(count).unwrap_or(NEVER) });
    }
    Ok(table)
}

/// Two disjoint sets with fewer than s reached members together.
fn sides(
    count: usize,
    s: usize,
    reached: &[u8],
    meter: &mut Meter<'_>,
) -> Result<Option<(NodeSet, NodeSet)>, Stopped> {
    let mut least = reached.to_vec();
    for node in 0..count {
        meter.spend(1 + (least.len() >> 8) as u64)?;
        let bit = 1 << node;
        for set in (0..least.len()).filter(|set| set & bit != 0) {
            least[set] = least[set].min(least[set ^ bit]);
        }
    }
    let all = least.len() - 1;
    let fits = |side: &usize| {
        let both = [least[*side], least[all ^ side]];
        !both.contains(&NEVER) && usize::from(both[0]) + usize::from(both[1]) < s
    };
    let Some(side) = (0..least.len()).find(fits) else { return Ok(None) };
    let within = |side: usize| {
        let mut subsets = (1..=side).filter(|set| set & !side == 0);
        subsets.find(|set| reached[*set] == least[side]).unwrap_or(0)
    };
    let set = |bits: usize| NodeSet::from_bits(bits as u128);
    Ok(Some((set(within(side)), set(within(all ^ side)))))
}
