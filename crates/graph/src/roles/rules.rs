//! What follows from the roles that nodes may have. `proofs/roles.v` has the same rules, with proofs.

use alloc::vec::Vec;

use super::domains::{Domains, INSIDE};
use super::{Liars, Question};
use crate::graph::Graph;
use crate::graph::word::Word;

/// A graph and what is asked of it.
pub(super) struct Rules<W> {
    /// Whom each node hears.
    pub(super) heard: Vec<W>,
    pub(super) question: Question,
    all: W,
}

/// What a pass has seen that concerns others than the node that it looks at.
struct Forced<W> {
    /// Who must be in a set if it may be.
    inside: [W; 2],
    /// Who cannot be a liar.
    honest: W,
}

impl<W: Word> Rules<W> {
    pub(super) fn new(graph: &Graph, question: Question) -> Self {
        let heard = (0..graph.node_count()).map(|node| W::from_bits(graph.in_neighbors(node).bits()));
        Self { heard: heard.collect(), question, all: W::from_bits(graph.nodes().bits()) }
    }

    /// All nodes.
    pub(super) fn all(&self) -> W {
        self.all
    }

    /// What is left after all conclusions; `None` if no split is.
    pub(super) fn conclude(&self, mut domains: Domains<W>) -> Option<Domains<W>> {
        loop {
            let next = self.pass(&domains);
            if next.some() != self.all || next.honest.iter().any(|set| set.is_none()) {
                return None;
            }
            if next == domains {
                return Some(domains);
            }
            domains = next;
        }
    }

    /// Every rule once for every node, all from the same `now`.
    fn pass(&self, now: &Domains<W>) -> Domains<W> {
        let sure = self.all.without(now.may_be_honest());
        let mut forced = Forced { inside: [W::NONE; 2], honest: W::NONE };
        if let Liars::Total { s } = self.question.liars {
            let count = size(sure);
            if count >= s {
                return Domains::none();
            }
            if count + 1 >= s {
                forced.honest = self.all.without(sure);
            }
        }
        let mut next = *now;
        for (node, heard) in self.heard.iter().enumerate() {
            self.look(now, sure, (W::one(node), *heard), &mut next, &mut forced);
        }
        for side in 0..2 {
            next = next.only(forced.inside[side], INSIDE[side]);
            next.liars[side] = next.liars[side].without(forced.honest);
        }
        next
    }

    /// What follows from whom one node hears.
    fn look(
        &self,
        now: &Domains<W>,
        sure: W,
        (one, heard): (W, W),
        next: &mut Domains<W>,
        forced: &mut Forced<W>,
    ) {
        let r = self.question.r;
        let liars = size(heard & sure);
        let spare = match self.question.liars {
            Liars::Total { s } => s.saturating_sub(1 + size(sure)),
            Liars::Local => r.saturating_sub(1 + liars),
        };
        for side in 0..2 {
            let outside = size(heard.without(now.inside(side)));
            let not_honest = size(heard.without(now.honest[side] | (sure & now.liars[side])));
            if outside >= r || not_honest >= r.saturating_add(spare) {
                next.honest[side] = next.honest[side].without(one);
            }
            if outside + 1 >= r && one.is_within(now.surely_honest(side)) {
                forced.inside[side] = forced.inside[side] | (heard & now.inside(side));
            }
        }
        if self.question.liars == Liars::Local {
            if liars >= r {
                next.honest = next.honest.map(|set| set.without(one));
                next.neither = next.neither.without(one);
            }
            if liars + 1 >= r && one.is_within(self.all.without(now.may_lie())) {
                forced.honest = forced.honest | heard.without(sure);
            }
        }
    }
}

/// How many nodes a set has.
pub(super) fn size<W: Word>(set: W) -> usize {
    usize::try_from(set.count()).unwrap_or(0)
}
