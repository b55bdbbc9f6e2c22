//! Bounds that need no search: from degrees, and from pairs of nodes.

use crate::definition::Witness;
use crate::graph::Graph;
use crate::graph::set::NodeSet;

/// Largest r that the least degree δ alone guarantees, for every s; 0 if it guarantees nothing.
///
/// ```text
/// δ ≥ floor(n/2) − 1  ⟹  (δ − floor(n/2) + 1, s)-robust for all s = 1 ..= n
/// ```
///
/// Also for directed graphs, with in-degrees.
//= paper lem:rs_robust
#[must_use]
pub fn r_least(graph: &Graph) -> usize {
    (graph.degree_min() + 1).saturating_sub(graph.node_count() / 2)
}

/// No graph of `graph`'s degrees is r-robust for a larger r: min(ceil(n/2), max(δ, 1)).
///
/// A node of least degree against all others, or one half against the other, is a witness.
//= paper def:robustness
#[must_use]
pub fn r_most(graph: &Graph) -> usize {
    graph.node_count().div_ceil(2).min(graph.degree_min().max(1))
}

/// Largest F that the least degree of the `normal` nodes guarantees resilient consensus for; `None` if not even F = 0.
///
/// ```text
/// F = max { F ≥ 0 : d(v) ≥ F + floor(n/2) for all normal v,  |N(v) \ normal| ≤ F for all normal v }
/// ```
///
/// Holds for F-total and for F-local malicious nodes that tell all their hearers the same, and for
/// networks that change in time if it holds at every step. The graph need not be (F+1,F+1)-robust.
/// The proof is that of docs/theory, `thm:contraction`. With all nodes normal only the degrees count.
//= paper thm:rs_robust
//= theory thm:contraction
#[must_use]
pub fn f_by_degree(graph: &Graph, normal: NodeSet) -> Option<usize> {
    let normal = normal.intersection(graph.nodes());
    let least = normal.iter().map(|node| graph.in_degree(node)).min()?;
    let f = least.checked_sub(graph.node_count() / 2)?;
    let malicious = |node: usize| graph.in_neighbors(node).difference(normal).len();
    normal.iter().all(|node| malicious(node) <= f).then_some(f)
}

/// Largest F as above, but for malicious nodes that tell each hearer something else (Byzantine).
///
/// ```text
/// F = max { F ≥ |V \ normal| : |N(v) ∩ normal| ≥ F + floor((n − |V \ normal|)/2) for all normal v }
/// ```
///
/// The proof is that of docs/theory, `thm:two-faced`. `None` if no F is guaranteed.
//= paper thm:rs_robust
//= theory thm:two-faced
#[must_use]
pub fn f_by_degree_byzantine(graph: &Graph, normal: NodeSet) -> Option<usize> {
    let normal = normal.intersection(graph.nodes());
    let least = normal.iter().map(|node| graph.in_neighbors(node).intersection(normal).len()).min()?;
    let f = least.checked_sub(normal.len() / 2)?;
    (f >= graph.node_count() - normal.len()).then_some(f)
}

/// Two disjoint sets with a content member each, at a given r; `None` if there are none and the graph is (r,s)-robust for all s.
///
/// Sets {v} ∪ A and {w} ∪ B with A ⊆ N(v), B ⊆ N(w), |A| = need(v), |B| = need(w) exist iff (Hall)
///
/// ```text
/// |N(v) \ {w}| ≥ need(v),  |N(w) \ {v}| ≥ need(w),  |(N(v) ∪ N(w)) \ {v, w}| ≥ need(v) + need(w)
/// ```
///
/// where need(v) = max(0, d(v) − r + 1). So whether a graph is (r,n)-robust takes O(n²), and s_max(r) is n or at most n − 2.
//= paper def:robustness
#[must_use]
pub fn content_pair(graph: &Graph, r: usize) -> Option<Witness> {
    if r == 0 {
        return None;
    }
    let count = graph.node_count();
    let mut pairs = (0..count).flat_map(|v| (v + 1..count).map(move |w| (v, w)));
    let (first, second) = pairs.find_map(|(v, w)| disjoint_sets(graph, r, v, w))?;
    let witness = Witness::new(graph, r, count, first, second);
    debug_assert!(witness.holds(graph), "{witness:?}");
    Some(witness)
}

fn disjoint_sets(graph: &Graph, r: usize, v: usize, w: usize) -> Option<(NodeSet, NodeSet)> {
    let need = |node: usize| (graph.in_degree(node) + 1).saturating_sub(r);
    let pair: NodeSet = [v, w].into_iter().collect();
    let near_v = graph.in_neighbors(v).difference(pair);
    let near_w = graph.in_neighbors(w).difference(pair);
    let enough = near_v.len() >= need(v) && near_w.len() >= need(w);
    if !enough || near_v.union(near_w).len() < need(v) + need(w) {
        return None;
    }
    // Own neighbours first, so that what both could use is left to the other.
    let for_v = take(near_v.difference(near_w), near_v.intersection(near_w), need(v));
    let free = near_w.difference(for_v);
    let for_w = take(free, NodeSet::EMPTY, need(w));
    let with = |mut set: NodeSet, node: usize| {
        set.insert(node);
        set
    };
    Some((with(for_v, v), with(for_w, w)))
}

fn take(before: NodeSet, after: NodeSet, count: usize) -> NodeSet {
    before.iter().chain(after.iter()).take(count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    //= theory thm:contraction type=test
    //= theory thm:two-faced type=test
    #[test]
    fn the_paper_asks_seven_neighbors_of_eleven_robots() {
        let mut graph = Graph::empty(11, false).unwrap();
        for node in 0..11 {
            for step in 1..=4 {
                graph.add_edge(node, (node + step) % 11).unwrap();
            }
        }
        assert_eq!(f_by_degree(&graph, graph.nodes()), Some(3));
        assert_eq!(r_least(&graph), 4);
        let mut normal = graph.nodes();
        normal.remove(0);
        assert_eq!(f_by_degree(&graph, normal), Some(3));
        assert_eq!(f_by_degree_byzantine(&graph, normal), Some(2));
    }

    #[test]
    fn a_normal_node_among_too_many_malicious_ones_is_not_promised_anything() {
        let graph = Graph::undirected(3, &[(0, 1), (0, 2), (1, 2)]).unwrap();
        assert_eq!(f_by_degree(&graph, graph.nodes()), Some(1));
        assert_eq!(f_by_degree(&graph, NodeSet::first(1)), None);
        assert_eq!(f_by_degree(&graph, NodeSet::EMPTY), None);
    }
}
