//! Peeling: the largest set whose members can still be content.

use alloc::vec::Vec;

use super::count;
use crate::graph::Graph;
use crate::graph::word::Word;

/// The rows of a graph and what a content member needs at a given r.
pub(crate) struct Needs<W> {
    pub(crate) heard: Vec<W>,
    /// need(v) = d(v) − r + 1, of which at most 0 means always content.
    pub(crate) need: Vec<i32>,
}

impl<W: Word> Needs<W> {
    pub(crate) fn new(graph: &Graph, r: usize) -> Self {
        let nodes = 0..graph.node_count();
        Self {
            heard: nodes.clone().map(|node| W::from_bits(graph.in_neighbors(node).bits())).collect(),
            need: nodes.map(|node| count(graph.in_degree(node)) - count(r) + 1).collect(),
        }
    }

    pub(crate) fn heard_in(&self, node: usize, set: W) -> i32 {
        (self.heard[node] & set).count()
    }

    /// The members of `able` that can be content in some set within `allowed` that holds `exempt` and at most
    /// `spare` more exempt members. Every such set keeps its content members: the proof is by induction over the removals.
    pub(crate) fn peel(&self, allowed: W, mut able: W, exempt: W, spare: i32) -> W {
        loop {
            let before = able;
            for node in before.nodes() {
                let sure = able | exempt;
                let inside = self.heard_in(node, sure);
                let lack = self.need[node] - inside;
                if lack > 0 && (lack > spare || lack > self.heard_in(node, allowed.without(sure))) {
                    able = able.without(W::one(node));
                }
            }
            if able == before {
                return able;
            }
        }
    }

    /// The largest set within `set` all of whose members are content: core_r(`set`).
    pub(crate) fn core(&self, set: W) -> W {
        self.peel(set, set, W::NONE, 0)
    }

    /// Least need(v) over `set`; a content member has that many others beside it.
    pub(crate) fn least_need(&self, set: W) -> i32 {
        set.nodes().map(|node| self.need[node]).min().unwrap_or(0)
    }
}
