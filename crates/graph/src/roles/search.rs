//! The search: roots, then the node that is most pressing.

use alloc::vec::Vec;

use super::domains::{Domains, HONEST, INSIDE, Mask};
use super::refutation::{Choice, Refutation, Root};
use super::rules::{Rules, size};
use super::{Liars, Split};
use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::graph::word::Word;
use crate::search::{ALIKE, symmetry};

/// Tries for automorphisms after a long root, at most.
const TRIES: usize = 400;

/// One question about one graph.
pub(super) struct Search<W> {
    rules: Rules<W>,
    written: Option<Written>,
}

/// The choices so far, and how many more there may be.
struct Written {
    roots: Vec<Root>,
    left: usize,
}

impl<W: Word> Search<W> {
    /// With `choices_most` choices are written down.
    pub(super) fn new(rules: Rules<W>, choices_most: Option<usize>) -> Self {
        let written = choices_most.map(|left| Written { roots: Vec::new(), left });
        Self { rules, written }
    }

    /// What was written, if anything was to be.
    pub(super) fn refutation(self) -> Option<Refutation> {
        self.written.map(|written| Refutation { roots: written.roots })
    }

    /// Tries every node as an honest member of S₁, and afterwards of neither set: the sets may trade places.
    pub(super) fn all(&mut self, graph: &Graph, meter: &mut Meter<'_>) -> Result<Option<Split>, Stopped> {
        let mut open = Domains::all(self.rules.all());
        while let Some(now) = self.rules.conclude(open) {
            let Some(root) = self.root(&now) else { break };
            let one = W::one(root);
            self.write_root(root)?;
            let before = meter.nodes();
            if let Some(found) = self.extend(open.only(one, HONEST[0]), meter)? {
                return Ok(Some(found));
            }
            let long = self.written.is_none() && meter.nodes() - before >= ALIKE;
            let alike = if long { alike(graph, &now, root) } else { one };
            open = open.without(alike, HONEST[0] | HONEST[1]);
        }
        Ok(None)
    }

    /// The root without which the fewest others can be honest in a set.
    fn root(&self, now: &Domains<W>) -> Option<usize> {
        let rest = |node: &usize| {
            let without = self.rules.conclude(now.without(W::one(*node), HONEST[0] | HONEST[1]));
            without.map_or(0, |domains| size(domains.honest[0]))
        };
        now.honest[0].nodes().min_by_key(rest)
    }

    fn extend(&mut self, domains: Domains<W>, meter: &mut Meter<'_>) -> Result<Option<Split>, Stopped> {
        meter.spend(1)?;
        let Some(now) = self.rules.conclude(domains) else { return Ok(None) };
        let Some((node, roles)) = self.choice(&now) else { return Ok(Some(Self::found(&now))) };
        self.write(node, roles)?;
        let found = self.extend(now.only(W::one(node), roles), meter)?;
        if found.is_some() {
            return Ok(found);
        }
        self.extend(now.without(W::one(node), roles), meter)
    }

    /// The next node and the roles that it has first; `None` if each set is complete: nobody else need be in it, and whoever may be
    /// honest in neither is.
    fn choice(&self, now: &Domains<W>) -> Option<(usize, Mask)> {
        for side in 0..2 {
            if now.surely_honest(side).is_none() {
                return self.start(now, side).map(|node| (node, HONEST[side]));
            }
            if let Some(node) = self.lacking(now, side).and_then(|node| self.neighbor(now, side, node)) {
                return Some((node, INSIDE[side]));
            }
            let open = now.surely_inside(side) & now.honest[side] & now.liars[side];
            if let Some(node) = open.nodes().next() {
                return Some((node, HONEST[side]));
            }
        }
        // Whoever is left and cannot be honest in neither set is in one of them.
        let open = now.inside(0).without(now.neither | now.surely_liars()) & now.inside(1);
        open.nodes().next().map(|node| (node, INSIDE[0]))
    }

    /// The first honest member of a set.
    fn start(&self, now: &Domains<W>, side: usize) -> Option<usize> {
        let near = |node: &usize| size(self.rules.heard[*node] & now.honest[side]);
        now.honest[side].nodes().max_by_key(near)
    }

    /// An honest member that does not yet hear enough members: the one with the fewest ways out.
    fn lacking(&self, now: &Domains<W>, side: usize) -> Option<usize> {
        let members = now.surely_inside(side);
        let outside = |node: &usize| size(self.rules.heard[*node].without(members));
        let closed = |node: &usize| size(self.rules.heard[*node].without(now.inside(side)));
        let lacks = now.surely_honest(side).nodes().filter(|node| outside(node) >= self.rules.question.r);
        lacks.max_by_key(|node| (closed(node), core::cmp::Reverse(*node)))
    }

    /// Whom of those that it hears to take next.
    fn neighbor(&self, now: &Domains<W>, side: usize, node: usize) -> Option<usize> {
        let members = now.surely_inside(side);
        let open = self.rules.heard[node] & now.inside(side).without(members);
        let score = |other: &usize| {
            let heard = self.rules.heard[*other];
            4 * (heard & members).count() - (heard & now.inside(side)).count()
        };
        open.nodes().max_by_key(score)
    }

    fn found(now: &Domains<W>) -> Split {
        let liars = now.surely_liars();
        let first = now.surely_honest(0) | (liars & now.liars[0]);
        let second = now.surely_honest(1) | liars.without(first);
        let as_set = |set: W| NodeSet::from_bits(set.bits());
        Split { liars: as_set(liars), first: as_set(first), second: as_set(second) }
    }

    fn write_root(&mut self, node: usize) -> Result<(), Stopped> {
        let Some(written) = &mut self.written else { return Ok(()) };
        written.spend()?;
        written.roots.push(Root { node: number(node), choices: Vec::new() });
        Ok(())
    }

    fn write(&mut self, node: usize, roles: Mask) -> Result<(), Stopped> {
        let Some(written) = &mut self.written else { return Ok(()) };
        written.spend()?;
        if let Some(root) = written.roots.last_mut() {
            root.choices.push(Choice { node: number(node), roles });
        }
        Ok(())
    }
}

impl Written {
    fn spend(&mut self) -> Result<(), Stopped> {
        self.left = self.left.checked_sub(1).ok_or(Stopped)?;
        Ok(())
    }
}

/// Nodes are fewer than 128.
fn number(node: usize) -> u32 {
    u32::try_from(node).unwrap_or(u32::MAX)
}

/// All nodes to which automorphisms take the root that keep what is known.
//= theory sec:symmetry
fn alike<W: Word>(graph: &Graph, now: &Domains<W>, root: usize) -> W {
    let colors: Vec<usize> = (0..graph.node_count()).map(|node| usize::from(now.of(node))).collect();
    W::from_bits(symmetry::orbit(graph, &colors, root, TRIES).bits())
}

impl Split {
    /// Whether the claim is true of `graph`, word for word.
    #[must_use]
    pub fn holds(&self, graph: &Graph, question: super::Question) -> bool {
        let stays = |set: NodeSet| {
            let honest = set.difference(self.liars);
            let outside = |node: usize| graph.in_neighbors(node).difference(set).len();
            !honest.is_empty() && honest.iter().all(|node| outside(node) < question.r)
        };
        let few = match question.liars {
            Liars::Total { s } => self.liars.len() < s,
            Liars::Local => {
                let honest = graph.nodes().difference(self.liars);
                let heard = |node: usize| graph.in_neighbors(node).intersection(self.liars).len();
                honest.iter().all(|node| heard(node) < question.r)
            }
        };
        let inside = self.first.union(self.second).union(self.liars).is_subset(graph.nodes());
        inside && self.first.is_disjoint(self.second) && stays(self.first) && stays(self.second) && few
    }
}
