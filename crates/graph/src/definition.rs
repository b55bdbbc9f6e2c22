//! The definitions, word for word: the oracle of every algorithm of this crate.

use crate::graph::Graph;
use crate::graph::set::NodeSet;

/// X^r_S, the members of `set` that hear at least `r` nodes outside of it.
///
/// ```text
/// X^r_S = { i ∈ S : |N_i \ S| ≥ r }
/// ```
//= paper reachability
#[must_use]
pub fn exempt(graph: &Graph, set: NodeSet, r: usize) -> NodeSet {
    set.iter().filter(|&node| graph.in_neighbors(node).difference(set).len() >= r).collect()
}

/// Whether `set` is (r,s)-reachable: not empty and |X^r_S| ≥ s.
//= paper reachability
#[must_use]
pub fn is_reachable(graph: &Graph, set: NodeSet, r: usize, s: usize) -> bool {
    !set.is_empty() && exempt(graph, set, r).len() >= s
}

/// Whether `graph` is (r,s)-robust, by trying every pair of disjoint nonempty sets.
///
/// About 3ⁿ/2 pairs: for n up to 14 or so.
//= paper def:robustness
#[must_use]
pub fn is_robust(graph: &Graph, r: usize, s: usize) -> bool {
    counterexample(graph, r, s).is_none()
}

/// The first pair of sets that violates all three conditions of the definition, by trying every pair.
///
/// About 3ⁿ/2 pairs: for n up to 14 or so.
//= paper def:robustness
#[must_use]
pub fn counterexample(graph: &Graph, r: usize, s: usize) -> Option<Witness> {
    let all = graph.nodes();
    nonempty_subsets(all).find_map(|first| {
        let rest = all.difference(first);
        let mut pairs = nonempty_subsets(rest).filter(|&second| first < second);
        let second = pairs.find(|&second| Witness::new(graph, r, s, first, second).holds(graph))?;
        Some(Witness::new(graph, r, s, first, second))
    })
}

fn nonempty_subsets(set: NodeSet) -> impl Iterator<Item = NodeSet> {
    let all = set.bits();
    let mut subset = all;
    core::iter::from_fn(move || {
        (subset != 0).then(|| {
            let current = NodeSet::from_bits(subset);
            subset = (subset - 1) & all;
            current
        })
    })
}

/// Two sets that show that a graph is not (r,s)-robust.
///
/// Both are nonempty and disjoint, neither is filled by its exempt nodes, and together they have at most s − 1 of them.
/// If the exempt nodes are malicious and every other member keeps its value, the two sets never agree.
//= paper def:robustness
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Witness {
    /// The r of (r,s).
    pub r: usize,
    /// The s of (r,s).
    pub s: usize,
    /// S₁.
    pub first: NodeSet,
    /// S₂.
    pub second: NodeSet,
    /// X^r_S₁ ∪ X^r_S₂, the members that hear r nodes or more outside of their set.
    pub exempt: NodeSet,
}

impl Witness {
    /// The claim that `first` and `second` violate (r,s)-robustness. Not checked: see [`Witness::holds`].
    #[must_use]
    pub fn new(graph: &Graph, r: usize, s: usize, first: NodeSet, second: NodeSet) -> Self {
        let exempt = exempt(graph, first, r).union(exempt(graph, second, r));
        Self { r, s, first, second, exempt }
    }

    /// Whether the claim is true of `graph`, by the three conditions of the definition.
    //= paper def:robustness
    #[must_use]
    pub fn holds(&self, graph: &Graph) -> bool {
        let x1 = exempt(graph, self.first, self.r);
        let x2 = exempt(graph, self.second, self.r);
        let sets = !self.first.is_empty() && !self.second.is_empty();
        let inside = self.first.union(self.second).is_subset(graph.nodes());
        let disjoint = self.first.is_disjoint(self.second) && self.exempt == x1.union(x2);
        let full = x1 == self.first || x2 == self.second;
        sets && inside && disjoint && !full && x1.len() + x2.len() < self.s
    }

    /// ρ = the most nodes that a member of either set hears outside of its own set.
    ///
    /// With no exempt nodes the witness shows that the graph is not (ρ+1)-robust, and ρ + 1 ≤ r.
    #[must_use]
    pub fn reach(&self, graph: &Graph) -> usize {
        let reach = |set: NodeSet| set.iter().map(move |node| graph.in_neighbors(node).difference(set).len());
        reach(self.first).chain(reach(self.second)).max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_robots_that_hear_each_other_are_1_robust_only() {
        let pair = Graph::undirected(2, &[(0, 1)]).unwrap();
        assert!(is_robust(&pair, 1, 1) && is_robust(&pair, 1, 2));
        let witness = counterexample(&pair, 2, 1).unwrap();
        assert!(witness.holds(&pair));
        assert_eq!(witness.reach(&pair), 1);
    }

    //= paper reachability type=test
    #[test]
    fn ends_of_a_path_reach_out_once_and_its_middle_twice() {
        let path = Graph::undirected(3, &[(0, 1), (1, 2)]).unwrap();
        let (ends, middle) = (NodeSet::from_bits(0b101), NodeSet::from_bits(0b010));
        assert!(is_reachable(&path, ends, 1, 2) && !is_reachable(&path, ends, 2, 1));
        assert!(is_reachable(&path, middle, 2, 1) && !is_reachable(&path, middle, 2, 2));
        assert!(
            !is_reachable(&path, NodeSet::from_bits(0), 0, 0),
            "the empty set is no set of the definition"
        );
    }

    #[test]
    fn a_false_witness_does_not_hold() {
        let pair = Graph::undirected(2, &[(0, 1)]).unwrap();
        let one = NodeSet::first(1);
        assert!(!Witness::new(&pair, 2, 1, one, one).holds(&pair));
        assert!(!Witness::new(&pair, 1, 2, one, NodeSet::from_bits(2)).holds(&pair));
        assert!(!Witness::new(&pair, 2, 1, one, NodeSet::from_bits(4)).holds(&pair));
    }
}
