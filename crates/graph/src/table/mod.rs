//! Algorithm A: the least number of exempt nodes over all subsets, by a table of 2ⁿ bytes.
//!
//! ```text
//! g_r(C)   = min { |X^r_S| : ∅ ≠ S ⊆ C, X^r_S ≠ S }        (∞ if there is none)
//! s_max(r) = min(n, min_C g_r(C) + g_r(V \ C))
//! m(C)     = min { ρ(S) : ∅ ≠ S ⊆ C },  ρ(S) = max_{v ∈ S} |N(v) \ S|
//! r_max    = min_C max(m(C), m(V \ C))
//! ```
//!
//! A pair that violates the definition lies in some bipartition, and the least sets of a bipartition are such a pair.
//! O(n 2ⁿ) bytewise operations in blocks that stay in the cache. See docs/theory, `sec:table`.

mod rows;

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use crate::definition::Witness;
use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::table::rows::Rows;

/// The table counts in bytes and indexes with 32 bits: no graph above this size, whatever the memory.
pub const TABLE_NODE_LIMIT: usize = 30;

/// Stands for ∞: no such subset.
const NONE: u8 = u8::MAX;

/// So many subsets take about as long as one node of the search tree.
const SUBSETS_PER_NODE: u64 = 256;

/// Why the table gives no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TableError {
    /// The table needs 2ⁿ bytes and may not have them.
    Memory {
        /// Bytes needed; `u64::MAX` if the graph is above [`TABLE_NODE_LIMIT`].
        needed: u64,
        /// Bytes allowed.
        allowed: u64,
    },
    /// The effort is spent, or the callback said stop.
    Stopped,
}

impl From<Stopped> for TableError {
    fn from(_: Stopped) -> Self {
        Self::Stopped
    }
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Memory { needed, allowed } => {
                write!(f, "the table of subsets needs {needed} bytes, {allowed} are allowed")
            }
            Self::Stopped => write!(f, "stopped before the answer"),
        }
    }
}

impl core::error::Error for TableError {}

/// Bytes that the table takes for a graph of `node_count` nodes, 2ⁿ; `u64::MAX` above [`TABLE_NODE_LIMIT`].
#[must_use]
pub fn bytes(node_count: usize) -> u64 {
    if node_count > TABLE_NODE_LIMIT { u64::MAX } else { 1 << node_count }
}

/// Cost of one table in nodes of the search tree, for [`Meter`].
pub(crate) fn cost(node_count: usize) -> u64 {
    bytes(node_count) / SUBSETS_PER_NODE
}

/// Largest s, `0 ..= n`, such that `graph` is (r,s)-robust, and a witness against s + 1 if s < n.
///
/// The witness has the fewest exempt nodes that any has: s of them. Memory 2ⁿ bytes, at most `allowed`.
/// A graph of one node is (r,1)-robust for every r.
//= paper def:robustness
pub fn s_max(
    graph: &Graph,
    r: usize,
    allowed: u64,
    meter: &mut Meter<'_>,
) -> Result<(usize, Option<Witness>), TableError> {
    meter.ask(r, graph.node_count());
    let fill = |rows: &Rows<'_>, high: usize, block: &mut [u8]| rows.exempt_counts(r, high, block);
    let table = build(graph, allowed, meter, &fill)?;
    let Some((least, side)) = best_bipartition(&table, u8::saturating_add) else {
        return Ok((graph.node_count(), None));
    };
    let s = usize::from(least);
    let (first, second) = minimisers(&table, graph, side);
    let witness = Witness::new(graph, r, s + 1, first, second);
    debug_assert!(witness.holds(graph), "{witness:?}");
    Ok((s, Some(witness)))
}

/// Largest r such that `graph` is r-robust, and a witness against r + 1. Memory 2ⁿ bytes, at most `allowed`.
///
/// A graph of one node has no two disjoint sets and counts as 1-robust, without a witness.
//= paper def:robustness
pub fn r_max(
    graph: &Graph,
    allowed: u64,
    meter: &mut Meter<'_>,
) -> Result<(usize, Option<Witness>), TableError> {
    let fill = |rows: &Rows<'_>, high: usize, block: &mut [u8]| rows.reach(high, block);
    let table = build(graph, allowed, meter, &fill)?;
    let Some((least, side)) = best_bipartition(&table, u8::max) else {
        return Ok((1, None));
    };
    let r = usize::from(least);
    let (first, second) = minimisers(&table, graph, side);
    let witness = Witness::new(graph, r + 1, 1, first, second);
    debug_assert!(witness.holds(graph), "{witness:?}");
    Ok((r, Some(witness)))
}

type Fill<'f> = &'f dyn Fn(&Rows<'_>, usize, &mut [u8]);

fn build(graph: &Graph, allowed: u64, meter: &mut Meter<'_>, fill: Fill<'_>) -> Result<Vec<u8>, TableError> {
    let needed = bytes(graph.node_count());
    if needed > allowed {
        return Err(TableError::Memory { needed, allowed });
    }
    let length = usize::try_from(needed).map_err(|_| TableError::Memory { needed, allowed })?;
    let mut table = Vec::new();
    table.try_reserve_exact(length).map_err(|_| TableError::Memory { needed, allowed })?;
    table.resize(length, NONE);
    let rows = Rows::new(graph);
    fill_minima(&rows, 0, &mut table, meter, fill)?;
    Ok(table)
}

/// Fills `table`, whose first entry is the subset `start`, and takes minima over subsets inside of it.
fn fill_minima(
    rows: &Rows<'_>,
    start: usize,
    table: &mut [u8],
    meter: &mut Meter<'_>,
    fill: Fill<'_>,
) -> Result<(), Stopped> {
    if table.len() == rows.block_len() {
        meter.spend((table.len() as u64).div_ceil(SUBSETS_PER_NODE))?;
        fill(rows, start, table);
        minima_in_block(table);
        return Ok(());
    }
    let half = table.len() / 2;
    let (without, with) = table.split_at_mut(half);
    fill_minima(rows, start, without, meter, fill)?;
    fill_minima(rows, start + half, with, meter, fill)?;
    minima_between(without, with);
    Ok(())
}

fn minima_in_block(block: &mut [u8]) {
    let mut stride = 1;
    while stride < block.len() {
        for pair in block.chunks_exact_mut(2 * stride) {
            let (without, with) = pair.split_at_mut(stride);
            minima_between(without, with);
        }
        stride *= 2;
    }
}

fn minima_between(without: &[u8], with: &mut [u8]) {
    for (above, &below) in with.iter_mut().zip(without) {
        *above = (*above).min(below);
    }
}

/// The least value over all bipartitions and the side without the last node; `None` if every value is ∞.
fn best_bipartition(table: &[u8], join: impl Fn(u8, u8) -> u8) -> Option<(u8, usize)> {
    let (low, high) = table.split_at(table.len() / 2);
    let joined = || low.iter().zip(high.iter().rev()).map(|(&one, &other)| join(one, other));
    let least = joined().min()?;
    let side = joined().position(|value| value == least)?;
    (least != NONE).then_some((least, side))
}

fn minimisers(table: &[u8], graph: &Graph, side: usize) -> (NodeSet, NodeSet) {
    (minimiser(table, graph, side), minimiser(table, graph, table.len() - 1 - side))
}

/// The subset where the minimum of `set` is taken: what is left when no node can go without raising it.
fn minimiser(table: &[u8], graph: &Graph, set: usize) -> NodeSet {
    let mut left = set;
    for node in 0..graph.node_count() {
        let without = left & !(1 << node);
        if table[without] == table[set] {
            left = without;
        }
    }
    NodeSet::from_bits(left as u128)
}

/// Largest s for every r = 1 ..= ceil(n/2), one table each. See [`s_max`].
pub fn s_max_table(graph: &Graph, allowed: u64, meter: &mut Meter<'_>) -> Result<Vec<usize>, TableError> {
    let r_count = graph.node_count().div_ceil(2);
    let mut found = vec![0; r_count];
    for (index, entry) in found.iter_mut().enumerate() {
        *entry = s_max(graph, index + 1, allowed, meter)?.0;
        if *entry == 0 {
            break;
        }
    }
    Ok(found)
}
