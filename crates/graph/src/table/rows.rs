//! Neighbour counts of every subset of the first few nodes, from which the table is filled block by block.

use alloc::vec::Vec;

use crate::graph::Graph;

/// A block is the 2ᵏ subsets that differ in the first k nodes: with all n rows it stays in the second cache.
const BLOCK_BITS: usize = 12;

/// Not a member: larger than any count.
const ABSENT: u8 = u8::MAX;

/// For each node v and each subset L of the first k nodes, |N(v) ∩ L|, or [`ABSENT`] if v is one of them and not in L.
pub(crate) struct Rows<'a> {
    graph: &'a Graph,
    bits: usize,
    inside: Vec<Vec<u8>>,
    sizes: Vec<u8>,
}

impl<'a> Rows<'a> {
    pub(crate) fn new(graph: &'a Graph) -> Self {
        let bits = graph.node_count().min(BLOCK_BITS);
        let inside = (0..graph.node_count()).map(|node| inside_counts(graph, node, bits)).collect();
        Self { graph, bits, inside, sizes: subset_counts(u128::MAX, bits) }
    }

    pub(crate) fn block_len(&self) -> usize {
        1 << self.bits
    }

    /// |X^r_S| for the subsets S = `start` + L of a block, or `u8::MAX` where X^r_S = S (the empty set too).
    pub(crate) fn exempt_counts(&self, r: usize, start: usize, block: &mut [u8]) {
        block.fill(0);
        for node in self.members(start) {
            let outside = self.graph.in_degree(node) - self.heard_above(node, start);
            if let Some(most_inside) = outside.checked_sub(r) {
                count_at_most(block, &self.inside[node], byte(most_inside));
            }
        }
        let above = byte(start.count_ones() as usize);
        for (count, &size) in block.iter_mut().zip(&self.sizes) {
            *count = if *count == size + above { u8::MAX } else { *count };
        }
    }

    /// ρ(S) for the subsets S = `start` + L of a block, and `u8::MAX` for the empty set.
    pub(crate) fn reach(&self, start: usize, block: &mut [u8]) {
        block.fill(0);
        for node in self.members(start) {
            let outside = byte(self.graph.in_degree(node) - self.heard_above(node, start));
            for (reach, &inside) in block.iter_mut().zip(&self.inside[node]) {
                *reach = (*reach).max(outside.saturating_sub(inside));
            }
        }
        if start == 0 {
            block[0] = u8::MAX;
        }
    }

    /// Nodes that are members of some subset of the block.
    fn members(&self, start: usize) -> impl Iterator<Item = usize> {
        let bits = self.bits;
        (0..self.graph.node_count()).filter(move |&node| node < bits || start >> node & 1 == 1)
    }

    fn heard_above(&self, node: usize, start: usize) -> usize {
        (self.graph.in_neighbors(node).bits() & start as u128).count_ones() as usize
    }
}

fn count_at_most(block: &mut [u8], inside: &[u8], most: u8) {
    for (count, &inside) in block.iter_mut().zip(inside) {
        *count += u8::from(inside <= most);
    }
}

fn inside_counts(graph: &Graph, node: usize, bits: usize) -> Vec<u8> {
    let mut counts = subset_counts(graph.in_neighbors(node).bits(), bits);
    if node < bits {
        let absent = counts.iter_mut().enumerate().filter(|(subset, _)| subset >> node & 1 == 0);
        absent.for_each(|(_, count)| *count = ABSENT);
    }
    counts
}

/// |L ∩ row| for every subset L of the first `bits` nodes.
fn subset_counts(row: u128, bits: usize) -> Vec<u8> {
    (0..1_u128 << bits).map(|subset| byte((subset & row).count_ones() as usize)).collect()
}

/// Counts of nodes are at most 128.
fn byte(count: usize) -> u8 {
    u8::try_from(count).unwrap_or(u8::MAX)
}
