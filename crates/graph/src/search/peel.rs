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
    /// The nodes with a need of at most 0, 1, 2 and so on.
    within: Vec<W>,
    /// Who hears each node; nothing in searches that are short.
    pub(crate) told: Vec<W>,
}

impl<W: Word> Needs<W> {
    pub(crate) fn new(graph: &Graph, r: usize) -> Self {
        let nodes = 0..graph.node_count();
        Self {
            heard: nodes.clone().map(|node| W::from_bits(graph.in_neighbors(node).bits())).collect(),
            need: nodes.map(|node| count(graph.in_degree(node)) - count(r) + 1).collect(),
            within: Vec::new(),
            told: Vec::new(),
        }
    }

    /// With what only long searches are worth.
    pub(crate) fn thorough(graph: &Graph, r: usize) -> Self {
        let plain = Self::new(graph, r);
        let nodes = || 0..graph.node_count();
        let within = |most: usize| {
            let few = nodes().filter(|node| plain.need[*node] <= count(most));
            few.fold(W::NONE, |all, node| all | W::one(node))
        };
        let within = nodes().map(within).collect();
        let told = nodes().map(|node| W::from_bits(graph.out_neighbors(node).bits())).collect();
        Self { within, told, ..plain }
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

    /// The fewest members of a set whose content members, at least one, are in `among`, and of which at most `exempt` are exempt; more than
    /// there are nodes if there is none.
    ///
    /// A content member has need(v) others beside it, so a set of m members has at least m − `exempt` with a need below m.
    //= theory sec:search
    pub(crate) fn least_size(&self, among: W, exempt: i32) -> i32 {
        if self.within.is_empty() {
            return among.nodes().map(|node| self.need[node]).min().unwrap_or(0).max(0) + 1;
        }
        let enough = |&(size, few): &(i32, &W)| (among & *few).count() >= (size - exempt).max(1);
        (1..).zip(&self.within).find(enough).map_or(i32::MAX, |(size, _)| size)
    }
}
