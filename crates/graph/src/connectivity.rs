//! Node connectivity: the older measure, for comparison.

use alloc::collections::VecDeque;
use alloc::vec;
use alloc::vec::Vec;

use crate::graph::Graph;

/// Least number of nodes whose removal leaves some pair without a path; n − 1 for a complete graph.
///
/// Menger: the least, over ordered pairs (u, v) without an edge u → v, of the number of paths from u to v that share no
/// inner node. One augmenting path search per path and pair: O(n² κ m), some milliseconds for n = 30.
/// An r-robust graph has connectivity of at least r; the converse is far from true.
#[must_use]
pub fn node_connectivity(graph: &Graph) -> usize {
    let count = graph.node_count();
    let mut least = count - 1;
    for from in 0..count {
        for to in (0..count).filter(|&to| to != from && (graph.is_directed() || from < to)) {
            if !graph.has_edge(from, to) {
                least = least.min(disjoint_paths(graph, from, to, least));
            }
        }
    }
    least
}

/// Number of paths `from` → `to` that share no inner node, counted up to `most`. There must be no edge between them.
fn disjoint_paths(graph: &Graph, from: usize, to: usize, most: usize) -> usize {
    let mut network = Network::new(graph);
    (0..most).take_while(|_| network.augment(from, to)).count()
}

/// Every node v split in two: 2v takes in, 2v + 1 gives out, with one unit between them.
struct Network {
    /// Which arcs have capacity left, as lists of ends.
    open: Vec<Vec<usize>>,
}

impl Network {
    fn new(graph: &Graph) -> Self {
        let count = graph.node_count();
        let mut open = vec![Vec::new(); 2 * count];
        for node in 0..count {
            open[2 * node].push(2 * node + 1);
            open[2 * node + 1].extend(graph.out_neighbors(node).iter().map(|hearer| 2 * hearer));
        }
        Self { open }
    }

    /// Sends one more unit from → to, if there is a way.
    fn augment(&mut self, from: usize, to: usize) -> bool {
        let (source, sink) = (2 * from + 1, 2 * to);
        let Some(reached_from) = self.search(source, sink) else {
            return false;
        };
        let mut end = sink;
        while end != source {
            let start = reached_from[end];
            self.open[start].retain(|&arc| arc != end);
            self.open[end].push(start);
            end = start;
        }
        true
    }

    fn search(&self, source: usize, sink: usize) -> Option<Vec<usize>> {
        let unseen = usize::MAX;
        let mut reached_from = vec![unseen; self.open.len()];
        reached_from[source] = source;
        let mut queue = VecDeque::from([source]);
        while let Some(start) = queue.pop_front() {
            for &end in &self.open[start] {
                if reached_from[end] == unseen {
                    reached_from[end] = start;
                    queue.push_back(end);
                }
            }
        }
        (reached_from[sink] != unseen).then_some(reached_from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_connectivities() {
        let ring = Graph::undirected(5, &[(0, 1), (1, 2), (2, 3), (3, 4), (4, 0)]).unwrap();
        assert_eq!(node_connectivity(&ring), 2);
        let round = Graph::directed(3, &[(0, 1), (1, 2), (2, 0)]).unwrap();
        assert_eq!(node_connectivity(&round), 1);
        assert_eq!(node_connectivity(&Graph::empty(3, false).unwrap()), 0);
        assert_eq!(node_connectivity(&Graph::undirected(2, &[(0, 1)]).unwrap()), 1);
        assert_eq!(node_connectivity(&Graph::empty(1, false).unwrap()), 0);
    }
}
