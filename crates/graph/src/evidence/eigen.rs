//! Evidence by eigenvalues: two triangles of whole numbers prove bounds of them, and the bounds say how large sets must be.

use alloc::vec::Vec;

use super::{Claim, Refused};
use crate::graph::Graph;
use crate::network::Network;
use crate::spectrum::{Bounds, SCALE};

/// How many steps the weight t of exempt members takes from 0 to 1.
const STEPS: usize = 16;

/// The claim that the network is (r,s)-robust, with what proves it by eigenvalues; `None` if they do not.
#[must_use]
pub fn of_eigenvalues(network: &Network, r: usize, s: usize) -> Option<Claim> {
    let graph = network.graph().ok()?;
    let s = s.min(graph.node_count());
    let bounds = Bounds::new(&graph)?;
    robust(network, r, s, &bounds).ok()?;
    Some(Claim::Eigenvalues { r, s, bounds })
}

//= theory sec:spectrum
pub(super) fn robust(network: &Network, r: usize, s: usize, bounds: &Bounds) -> Result<(), Refused> {
    if r == 0 || s == 0 {
        return Err(Refused::Zero);
    }
    let graph = network.graph().map_err(|_| Refused::Large { nodes: network.node_count() })?;
    let both = |node: usize| graph.in_neighbors(node).iter().all(|other| graph.has_edge(node, other));
    if !(0..graph.node_count()).all(both) || !bounds.prove(&graph) {
        return Err(Refused::Eigenvalues);
    }
    let question = Question::new(&graph, r, bounds);
    let least: Vec<usize> = (0..s.min(graph.node_count() + 1)).map(|exempt| question.least(exempt)).collect();
    let fits = |first: usize| {
        let mut seconds = 0..least.len().min(s - first);
        seconds.any(|second| least[first] + least[second] <= graph.node_count())
    };
    if (0..least.len()).any(fits) { Err(Refused::Room) } else { Ok(()) }
}

/// All numbers of one question; the bounds are numbers of 1/`SCALE`.
struct Question {
    nodes: i128,
    r: i128,
    ends: [i128; 2],
    degree_most: i128,
}

impl Question {
    fn new(graph: &Graph, r: usize, bounds: &Bounds) -> Self {
        let whole = |number: usize| i128::try_from(number).unwrap_or(i128::MAX);
        Self {
            nodes: whole(graph.node_count()),
            // Nobody hears more than all others, and this keeps every product small.
            r: whole(r.min(graph.node_count() + 1)),
            ends: bounds.ends.map(i128::from),
            degree_most: whole(graph.degree_max()),
        }
    }

    /// The fewest members of a set with a content one and `exempt` others, as far as the inequality says; more than n if there is none.
    fn least(&self, exempt: usize) -> usize {
        let nodes = usize::try_from(self.nodes).unwrap_or(0);
        let mut contents = 1..=nodes.saturating_sub(exempt);
        let is_possible = |content: &usize| (0..=STEPS).all(|t| self.allows(*content, exempt, t));
        contents.find(is_possible).unwrap_or(nodes.saturating_sub(exempt) + 1) + exempt
    }

    /// The inequality of `sec:spectrum` for t / `STEPS`, times 256 `SCALE`, with x times the largest degree for the sum of the x largest.
    fn allows(&self, content: usize, exempt: usize, t: usize) -> bool {
        let [a, x, t] = [content, exempt, t].map(|number| i128::try_from(number).unwrap_or(0));
        let (n, p, [low, high]) = (self.nodes, i128::from(SCALE), self.ends);
        let leaves = (p * n * x * self.degree_most).min(high * x * (n - x));
        let spread = 256 * a * (n - a) - 32 * t * a * x + t * t * x * (n - x);
        let inside = 256 * (self.r - 1) * a + (256 - 32 * t).max(0) * a * x;
        low * spread <= p * n * inside + t * t * leaves
    }
}
