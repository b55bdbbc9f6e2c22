//! How many disjoint paths lead into a set.

use alloc::vec;
use alloc::vec::Vec;

use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;

/// Paths of at most `hops` edges, with nobody of `liars` in their middle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paths<'g> {
    pub(super) graph: &'g Graph,
    pub(super) hops: usize,
    pub(super) liars: NodeSet,
}

/// What is left while paths are packed: who may be at the end next to the node, who may be in between, and where paths may begin.
#[derive(Clone, Copy)]
struct Left {
    ends: NodeSet,
    between: NodeSet,
    sources: NodeSet,
}

impl Paths<'_> {
    /// Whether at least `wanted` paths lead to `node` from outside of `set`, to which it belongs, disjoint but for `node`.
    ///
    /// Whom a node hears outside of the set it hears at first hand, and a path can be cut short at the last node outside of the set and
    /// at the last one that `node` hears. So all other paths begin with a node outside that `node` does not hear, and pass through members
    /// that it does not hear to one that it does.
    pub(super) fn are_at_least(
        &self,
        wanted: usize,
        set: NodeSet,
        node: usize,
        meter: &mut Meter<'_>,
    ) -> Result<bool, Stopped> {
        let heard = self.graph.in_neighbors(node);
        let direct = heard.difference(set).len();
        let outside = self.graph.nodes().difference(set);
        let honest = set.difference(self.liars);
        let mut between = honest.difference(heard);
        between.remove(node);
        let left = Left { ends: heard.intersection(honest), between, sources: outside.difference(heard) };
        match wanted.checked_sub(direct) {
            None | Some(0) => Ok(true),
            Some(_) if self.hops < 2 => Ok(false),
            Some(more) if self.hops == 2 => Ok(self.matched(left) >= more),
            Some(more) => self.packs(more, left, meter),
        }
    }

    /// Over two hops the most disjoint paths are a largest matching of sources with the nodes at the end.
    fn matched(&self, left: Left) -> usize {
        let mut taken: Vec<Option<usize>> = vec![None; self.graph.node_count()];
        let matched = left.ends.iter().filter(|end| {
            let mut tried = NodeSet::EMPTY;
            self.augment(*end, left.sources, &mut taken, &mut tried)
        });
        matched.count()
    }

    /// Finds a source for `end`, moving others to further ones where that helps.
    fn augment(
        &self,
        end: usize,
        sources: NodeSet,
        taken: &mut [Option<usize>],
        tried: &mut NodeSet,
    ) -> bool {
        for source in self.graph.in_neighbors(end).intersection(sources).iter() {
            if tried.contains(source) {
                continue;
            }
            tried.insert(source);
            let free = taken[source].is_none_or(|other| self.augment(other, sources, taken, tried));
            if free {
                taken[source] = Some(end);
                return true;
            }
        }
        false
    }

    /// Whether `more` disjoint paths fit in what is left: for each node at the end every path, or none.
    fn packs(&self, more: usize, mut left: Left, meter: &mut Meter<'_>) -> Result<bool, Stopped> {
        if more == 0 {
            return Ok(true);
        }
        if left.ends.len().min(left.sources.len()) < more {
            return Ok(false);
        }
        let Some(end) = left.ends.iter().next() else { return Ok(false) };
        left.ends.remove(end);
        Ok(self.follows(end, self.hops - 1, more, left, meter)? || self.packs(more, left, meter)?)
    }

    /// Whether `more` paths fit of which one comes to `at` over at most `hops` more edges.
    fn follows(
        &self,
        at: usize,
        hops: usize,
        more: usize,
        left: Left,
        meter: &mut Meter<'_>,
    ) -> Result<bool, Stopped> {
        meter.spend(1)?;
        let heard = self.graph.in_neighbors(at);
        for source in heard.intersection(left.sources).iter() {
            let mut left = left;
            left.sources.remove(source);
            if self.packs(more - 1, left, meter)? {
                return Ok(true);
            }
        }
        if hops < 2 {
            return Ok(false);
        }
        for next in heard.intersection(left.between).iter() {
            let mut left = left;
            left.between.remove(next);
            if self.follows(next, hops - 1, more, left, meter)? {
                return Ok(true);
            }
        }
        Ok(false)
    }
}
