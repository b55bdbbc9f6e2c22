//! How many members a set must have, by eigenvalues.

use alloc::vec::Vec;

use super::{SCALE, Spectrum};
use crate::graph::Graph;

/// How many steps the weight t of exempt members takes from 0 to 1.
const STEPS: i64 = 16;

/// For one r and each number of exempt members: the fewest members of a set that has a content one.
///
/// Let a set have a content members, each of which hears fewer than r nodes outside, and x others. For each t from 0 to 1
///
/// ```text
/// λ (a (n − a) − 2 t a x + t² x (n − x)) ≤ n ((r − 1) a + max(0, 1 − 2t) a x + t² min(D_x, Λ x (n − x)/n))
/// ```
///
/// with D_x the sum of the x largest degrees.
//= theory sec:spectrum
#[derive(Clone, Debug)]
pub struct Sizes {
    nodes: usize,
    /// For x = 0 ..= n − 1 exempt members; `usize::MAX` if there is no such set.
    least: Vec<usize>,
    /// The least of these up to each x.
    within: Vec<usize>,
}

impl Sizes {
    /// For sets whose content members hear fewer than `r` ≥ 1 nodes outside.
    #[must_use]
    pub fn new(graph: &Graph, spectrum: Spectrum, r: usize) -> Self {
        let question = Question::new(graph, spectrum, r);
        let least: Vec<usize> = (0..graph.node_count()).map(|exempt| question.least(exempt)).collect();
        let mut within = least.clone();
        for exempt in 1..within.len() {
            within[exempt] = within[exempt].min(within[exempt - 1]);
        }
        Self { nodes: graph.node_count(), least, within }
    }

    /// The fewest members of a set with a content one and exactly `exempt` others; `usize::MAX` if there is none.
    #[must_use]
    pub fn least(&self, exempt: usize) -> usize {
        self.least.get(exempt).copied().unwrap_or(usize::MAX)
    }

    /// The fewest members of a set with a content one and at most `exempt` others; `usize::MAX` if there is none.
    #[must_use]
    pub fn least_within(&self, exempt: usize) -> usize {
        self.within.get(exempt).or(self.within.last()).copied().unwrap_or(usize::MAX)
    }

    /// The graph is (r,s)-robust for all s up to this: two sets with fewer exempt members do not fit into it.
    //= theory sec:spectrum
    #[must_use]
    pub fn s_least(&self) -> usize {
        let fits = |exempt: usize| {
            let sizes =
                (0..=exempt).map(|first| self.least(first).saturating_add(self.least(exempt - first)));
            sizes.min().is_some_and(|size| size <= self.nodes)
        };
        (0..self.nodes).find(|&exempt| fits(exempt)).unwrap_or(self.nodes)
    }
}

/// All numbers of one question.
struct Question {
    nodes: i64,
    r: i64,
    least: i64,
    most: i64,
    /// The sum of the largest degrees, by how many.
    degrees: Vec<i64>,
    need_least: i64,
}

impl Question {
    fn new(graph: &Graph, spectrum: Spectrum, r: usize) -> Self {
        let whole = |count: usize| i64::try_from(count).unwrap_or(i64::from(u8::MAX));
        let mut sorted: Vec<i64> = (0..graph.node_count()).map(|node| whole(graph.in_degree(node))).collect();
        sorted.sort_unstable_by(|one, other| other.cmp(one));
        let r = whole(r.min(graph.node_count() + 1));
        let need_least = sorted.last().map_or(0, |degree| degree - r + 1);
        let sum = |count: usize| sorted[..count].iter().sum();
        Self {
            nodes: whole(graph.node_count()),
            r,
            least: spectrum.least,
            most: spectrum.most,
            degrees: (0..=graph.node_count()).map(sum).collect(),
            need_least,
        }
    }

    fn least(&self, exempt: usize) -> usize {
        let others = i64::try_from(exempt).unwrap_or(self.nodes);
        let sizes = 1..=self.nodes - others;
        let leave = self.links_leaving(exempt, others);
        let mut allowed = sizes.filter(|content| content + others > self.need_least);
        let content = allowed.find(|&content| (0..=STEPS).all(|t| self.allows(content, others, leave, t)));
        content.map_or(usize::MAX, |content| usize::try_from(content + others).unwrap_or(usize::MAX))
    }

    /// The most links that can lead from the exempt members to others.
    fn links_leaving(&self, exempt: usize, others: i64) -> i64 {
        self.degrees[exempt].min(self.most * others * (self.nodes - others) / (self.nodes * SCALE))
    }

    /// The inequality for t / `STEPS`, times `STEPS`² and `SCALE`.
    fn allows(&self, a: i64, x: i64, leave: i64, t: i64) -> bool {
        let n = self.nodes;
        let spread = STEPS * STEPS * a * (n - a) - 2 * t * STEPS * a * x + t * t * x * (n - x);
        let inside = (STEPS * STEPS - 2 * t * STEPS).max(0) * a * x;
        self.least * spread <= SCALE * n * (STEPS * STEPS * (self.r - 1) * a + inside + t * t * leave)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::definition::exempt;
    use crate::graph::set::NodeSet;
    use crate::makers::{fixed, random, symmetric};

    /// Every set of the graph is as large as it must be.
    fn holds(graph: &Graph) {
        let spectrum = Spectrum::new(graph).unwrap();
        for r in 1..=graph.node_count() / 2 + 2 {
            let sizes = Sizes::new(graph, spectrum, r);
            for code in 1..1_u128 << graph.node_count() {
                let set = NodeSet::from_bits(code);
                let exempt = exempt(graph, set, r).len();
                let fits = exempt == set.len()
                    || (sizes.least(exempt) <= set.len() && sizes.least_within(exempt) <= set.len());
                assert!(fits, "r = {r}, {set:?}, {graph:?}");
            }
        }
    }

    //= theory sec:spectrum type=test
    #[test]
    fn no_set_is_smaller_than_the_eigenvalues_say() {
        for seed in 0..30 {
            holds(&random::erdos_renyi(9, 0.7, false, seed).unwrap());
            holds(&random::regular(8, 2 + usize::try_from(seed % 5).unwrap(), seed).unwrap());
        }
        for reach in 1..=4 {
            holds(&fixed::k_circulant(9, reach, false).unwrap());
            holds(&fixed::bipartite(reach, 9 - reach).unwrap());
        }
        holds(&fixed::petersen().unwrap());
        holds(&fixed::hypercube(3).unwrap());
        holds(&symmetric::rook_complement(3, 4).unwrap());
        holds(&symmetric::multipartite(3, 3).unwrap());
    }

    #[test]
    fn symmetric_graphs_are_settled() {
        let of = |graph: Graph, r| Sizes::new(&graph, Spectrum::new(&graph).unwrap(), r).s_least();
        assert!(of(symmetric::rook_complement(6, 6).unwrap(), 12) >= 12);
        assert!(of(symmetric::kneser(9, 2).unwrap(), 10) >= 10);
        assert!(of(symmetric::paley(41).unwrap(), 9) >= 9);
        assert_eq!(of(fixed::path(4).unwrap(), 2), 0);
    }
}
