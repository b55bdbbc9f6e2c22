//! What all parts of a search share: the graph, what its nodes need, and which of them look alike.

use alloc::vec::Vec;

use super::peel::Needs;
use super::symmetry;
use crate::graph::Graph;
use crate::graph::word::Word;
use crate::spectrum::{Sizes, Spectrum};

/// Tries for automorphisms that keep what is known, at most.
const TRIES: usize = 400;

/// One question (r, ·) about one graph.
pub(super) struct Board<'g, W> {
    pub(super) graph: &'g Graph,
    pub(super) needs: Needs<W>,
    /// How large sets must be, by eigenvalues.
    pub(super) sizes: Option<Sizes>,
    symmetry: Option<Symmetry<W>>,
}

/// Whom a node may trade places with, and how long a search must have been before more symmetries are looked for.
struct Symmetry<W> {
    twins: Vec<W>,
    patience: u64,
}

impl<'g, W: Word> Board<'g, W> {
    /// Of no symmetry.
    pub(super) fn plain(graph: &'g Graph, r: usize) -> Self {
        Self { graph, needs: Needs::new(graph, r), sizes: None, symmetry: None }
    }

    /// With twins, with eigenvalues, and after searches of `patience` nodes with whatever symmetry is found.
    pub(super) fn informed(graph: &'g Graph, r: usize, spectrum: Option<Spectrum>, patience: u64) -> Self {
        let sizes = spectrum.map(|spectrum| Sizes::new(graph, spectrum, r));
        let twins = symmetry::twins(graph).into_iter().map(|set| W::from_bits(set.bits())).collect();
        let needs = Needs::thorough(graph, r);
        Self { graph, needs, sizes, symmetry: Some(Symmetry { twins, patience }) }
    }

    /// The node and all found to which automorphisms take it that keep everything that is known, which the colours of nodes tell.
    ///
    /// If no sets are a witness with `node` taken, none are with one of these taken, by the same automorphism. The search without
    /// `node` has cost `spent` nodes, and looking for automorphisms costs less.
    //= theory sec:symmetry
    pub(super) fn alike(&self, color: &dyn Fn(usize) -> usize, node: usize, spent: u64) -> W {
        let one = W::one(node);
        let Some(Symmetry { twins, patience }) = &self.symmetry else { return one };
        if spent >= *patience {
            let colors: Vec<usize> = (0..self.graph.node_count()).map(color).collect();
            let tries = usize::try_from(spent / 32).unwrap_or(TRIES).min(TRIES).max(1);
            return W::from_bits(symmetry::orbit(self.graph, &colors, node, tries).bits());
        }
        let alike = twins[node].nodes().filter(|other| color(*other) == color(node));
        alike.map(W::one).fold(one, |all, other| all | other)
    }
}
