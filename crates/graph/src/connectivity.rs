//! Node connectivity: the older measure, for comparison.

use alloc::vec;
use alloc::vec::Vec;

use crate::graph::Graph;
use crate::graph::set::NodeSet;

/// Least number κ of nodes whose removal leaves some pair without a path; n − 1 for a complete graph.
///
/// Menger: the least, over ordered pairs (u, v) without an edge u → v, of the number of paths from u to v that share no
/// inner node. One of any κ + 1 nodes is outside of a least cut, so pairs with one of these suffice (Even 1975).
/// An r-robust undirected graph has connectivity of at least r; the converse is far from true.
#[must_use]
pub fn node_connectivity(graph: &Graph) -> usize {
    let count = graph.node_count();
    let told: Vec<NodeSet> = (0..count).map(|node| graph.out_neighbors(node)).collect();
    let mut least = count - 1;
    let mut one = 0;
    while one <= least && one < count {
        for other in (0..count).filter(|&other| other != one) {
            for (from, to) in [(one, other), (other, one)] {
                if !graph.has_edge(from, to) && (graph.is_directed() || from == one) {
                    least = least.min(disjoint_paths(graph, &told, from, to));
                }
            }
        }
        one += 1;
    }
    least
}

/// Number of paths `from` → `to` that share no inner node. There must be no edge between them.
fn disjoint_paths(graph: &Graph, told: &[NodeSet], from: usize, to: usize) -> usize {
    // Whoever hears the one and tells the other is a path of its own.
    let between = told[from].intersection(graph.in_neighbors(to));
    let mut network = Network::new(told, graph.nodes().difference(between));
    between.len() + core::iter::from_fn(|| network.augment(from, to).then_some(())).count()
}

/// Every node split in two, an entry and an exit, with one unit of flow between them: the arcs that can still take some.
struct Network {
    /// Exits that can be reached from the entry of each node.
    from_entry: Vec<NodeSet>,
    /// Entries that can be reached from the exit of each node.
    from_exit: Vec<NodeSet>,
}

/// From where each half of a node was reached.
struct Search {
    entry: Vec<usize>,
    exit: Vec<usize>,
}

impl Network {
    fn new(told: &[NodeSet], nodes: NodeSet) -> Self {
        Self {
            from_entry: (0..told.len()).map(|node| NodeSet::from_iter([node])).collect(),
            from_exit: told.iter().map(|row| row.intersection(nodes)).collect(),
        }
    }

    /// Sends one more unit, if there is a way.
    fn augment(&mut self, from: usize, to: usize) -> bool {
        let Some(reached) = self.search(from, to) else {
            return false;
        };
        let mut entry = to;
        loop {
            let exit = reached.entry[entry];
            self.from_exit[exit].remove(entry);
            self.from_entry[entry].insert(exit);
            if exit == from {
                return true;
            }
            entry = reached.exit[exit];
            self.from_entry[entry].remove(exit);
            self.from_exit[exit].insert(entry);
        }
    }

    fn search(&self, from: usize, to: usize) -> Option<Search> {
        let count = self.from_exit.len();
        let mut reached = Search { entry: vec![from; count], exit: vec![from; count] };
        let (mut new_entries, mut new_exits) = (NodeSet::EMPTY, NodeSet::from_iter([from]));
        let (mut entries, mut exits) = (new_entries, new_exits);
        while !new_exits.is_empty() && !entries.contains(to) {
            for exit in new_exits.iter() {
                let fresh = self.from_exit[exit].difference(entries);
                fresh.iter().for_each(|entry| reached.entry[entry] = exit);
                entries = entries.union(fresh);
                new_entries = new_entries.union(fresh);
            }
            new_exits = NodeSet::EMPTY;
            for entry in new_entries.iter() {
                let fresh = self.from_entry[entry].difference(exits);
                fresh.iter().for_each(|exit| reached.exit[exit] = entry);
                exits = exits.union(fresh);
                new_exits = new_exits.union(fresh);
            }
            new_entries = NodeSet::EMPTY;
        }
        entries.contains(to).then_some(reached)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::makers::random;

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

    #[test]
    fn as_many_as_must_be_removed() {
        for seed in 0..300_u64 {
            let graph = random::erdos_renyi(6, 0.6, seed.is_multiple_of(2), seed).unwrap();
            let cuts =
                (0..64).map(NodeSet::from_bits).filter(|cut| cut.len() <= 4 && !is_strong(&graph, *cut));
            let literal = cuts.map(NodeSet::len).min().unwrap_or(5);
            assert_eq!(node_connectivity(&graph), literal, "{graph:?}");
        }
    }

    /// Whether every node reaches every other one without `cut`.
    fn is_strong(graph: &Graph, cut: NodeSet) -> bool {
        let rest = graph.nodes().difference(cut);
        rest.iter().all(|start| {
            let mut seen = NodeSet::from_iter([start]);
            for _ in 0..6 {
                let hears = |node: &usize| !graph.in_neighbors(*node).is_disjoint(seen);
                seen = seen.union(rest.iter().filter(hears).collect());
            }
            seen == rest
        })
    }
}
