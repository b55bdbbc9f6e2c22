//! Graphs: who hears whom.

pub mod set;
pub(crate) mod word;

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use crate::graph::set::{NODE_LIMIT, NodeSet};

/// A graph on the nodes `0 .. n`, without loops and without double edges.
///
/// Stored as the sets N(v) of in-neighbours: a directed edge u → v means that v hears u.
/// In an undirected graph every edge is heard at both ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graph {
    heard: Vec<NodeSet>,
    directed: bool,
}

/// Why a graph or an edge is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GraphError {
    /// A graph needs at least one node.
    NoNodes,
    /// More nodes than [`NODE_LIMIT`].
    TooManyNodes {
        /// Number asked for.
        found: usize,
    },
    /// An edge names a node that is not there.
    NodeOutOfRange {
        /// The node named.
        node: usize,
        /// Number of nodes n; allowed are `0 .. n`.
        node_count: usize,
    },
    /// An edge from a node to itself.
    Loop {
        /// The node.
        node: usize,
    },
    /// The edge is there already.
    DoubleEdge {
        /// The node heard.
        from: usize,
        /// The node that hears.
        to: usize,
    },
}

impl fmt::Display for GraphError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NoNodes => write!(f, "a graph needs at least one node"),
            Self::TooManyNodes { found } => write!(f, "{found} nodes, at most {NODE_LIMIT} are allowed"),
            Self::NodeOutOfRange { node, node_count } => {
                write!(f, "node {node} is not one of 0 to {}", node_count.saturating_sub(1))
            }
            Self::Loop { node } => write!(f, "loop at node {node}"),
            Self::DoubleEdge { from, to } => write!(f, "edge {from} - {to} appears twice"),
        }
    }
}

impl core::error::Error for GraphError {}

impl Graph {
    /// The graph without edges on `node_count` nodes, `1 ..= NODE_LIMIT`.
    pub fn empty(node_count: usize, directed: bool) -> Result<Self, GraphError> {
        match node_count {
            0 => Err(GraphError::NoNodes),
            1..=NODE_LIMIT => Ok(Self { heard: vec![NodeSet::EMPTY; node_count], directed }),
            found => Err(GraphError::TooManyNodes { found }),
        }
    }

    /// The undirected graph with these edges, each given once, in either order.
    pub fn undirected(node_count: usize, edges: &[(usize, usize)]) -> Result<Self, GraphError> {
        Self::empty(node_count, false)?.with_edges(edges)
    }

    /// The directed graph with these edges; `(u, v)` means that v hears u.
    pub fn directed(node_count: usize, edges: &[(usize, usize)]) -> Result<Self, GraphError> {
        Self::empty(node_count, true)?.with_edges(edges)
    }

    fn with_edges(mut self, edges: &[(usize, usize)]) -> Result<Self, GraphError> {
        for &(from, to) in edges {
            self.add_edge(from, to)?;
        }
        Ok(self)
    }

    /// Adds the edge from → to (undirected: from — to).
    pub fn add_edge(&mut self, from: usize, to: usize) -> Result<(), GraphError> {
        let node_count = self.node_count();
        if let Some(node) = [from, to].into_iter().find(|&node| node >= node_count) {
            return Err(GraphError::NodeOutOfRange { node, node_count });
        }
        if from == to {
            return Err(GraphError::Loop { node: from });
        }
        if self.heard[to].contains(from) {
            return Err(GraphError::DoubleEdge { from, to });
        }
        self.heard[to].insert(from);
        if !self.directed {
            self.heard[from].insert(to);
        }
        Ok(())
    }

    /// Takes the edge out, if it is there.
    pub fn remove_edge(&mut self, from: usize, to: usize) {
        if from < self.node_count() && to < self.node_count() {
            self.heard[to].remove(from);
            if !self.directed {
                self.heard[from].remove(to);
            }
        }
    }

    /// Number of nodes n, `1 ..= NODE_LIMIT`.
    #[must_use]
    pub fn node_count(&self) -> usize {
        self.heard.len()
    }

    /// All nodes V.
    #[must_use]
    pub fn nodes(&self) -> NodeSet {
        NodeSet::first(self.node_count())
    }

    /// Whether the edges have a direction.
    #[must_use]
    pub fn is_directed(&self) -> bool {
        self.directed
    }

    /// N(v), the nodes that `node` hears; empty if there is no such node.
    #[must_use]
    pub fn in_neighbors(&self, node: usize) -> NodeSet {
        self.heard.get(node).copied().unwrap_or_default()
    }

    /// The nodes that hear `node`. Undirected: the same as [`Graph::in_neighbors`].
    #[must_use]
    pub fn out_neighbors(&self, node: usize) -> NodeSet {
        (0..self.node_count()).filter(|&hearer| self.heard[hearer].contains(node)).collect()
    }

    /// d(v) = |N(v)|.
    #[must_use]
    pub fn in_degree(&self, node: usize) -> usize {
        self.in_neighbors(node).len()
    }

    /// Least in-degree δ of all nodes.
    #[must_use]
    pub fn degree_min(&self) -> usize {
        self.heard.iter().map(|row| row.len()).min().unwrap_or(0)
    }

    /// Largest in-degree Δ of all nodes.
    #[must_use]
    pub fn degree_max(&self) -> usize {
        self.heard.iter().map(|row| row.len()).max().unwrap_or(0)
    }

    /// Whether `to` hears `from`.
    #[must_use]
    pub fn has_edge(&self, from: usize, to: usize) -> bool {
        self.in_neighbors(to).contains(from)
    }

    /// Every edge once, ordered: `(from, to)` if directed, `(less, greater)` if not.
    pub fn edges(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let count = self.node_count();
        let pairs = (0..count).flat_map(move |from| (0..count).map(move |to| (from, to)));
        pairs.filter(|&(from, to)| (self.directed || from < to) && self.has_edge(from, to))
    }

    /// Number of edges, each counted once.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        let heard: usize = self.heard.iter().map(|row| row.len()).sum();
        if self.directed { heard } else { heard / 2 }
    }

    /// The subgraph on `nodes`, renumbered in order; `None` if that leaves no node.
    #[must_use]
    pub fn induced(&self, nodes: NodeSet) -> Option<Self> {
        let kept: Vec<usize> = nodes.intersection(self.nodes()).iter().collect();
        let row =
            |&node: &usize| (0..kept.len()).filter(|&index| self.heard[node].contains(kept[index])).collect();
        let heard: Vec<NodeSet> = kept.iter().map(row).collect();
        (!heard.is_empty()).then_some(Self { heard, directed: self.directed })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_undirected_edge_is_heard_at_both_ends() {
        let graph = Graph::undirected(3, &[(2, 0)]).unwrap();
        assert!(graph.has_edge(0, 2) && graph.has_edge(2, 0));
        assert!(graph.edges().eq([(0, 2)]));
        let graph = Graph::directed(3, &[(2, 0)]).unwrap();
        assert!(graph.has_edge(2, 0) && !graph.has_edge(0, 2));
        assert!(graph.edges().eq([(2, 0)]));
        assert!(graph.out_neighbors(2).iter().eq([0]));
    }

    #[test]
    fn what_is_not_a_graph_is_refused() {
        assert_eq!(Graph::empty(0, false), Err(GraphError::NoNodes));
        assert_eq!(Graph::empty(129, true), Err(GraphError::TooManyNodes { found: 129 }));
        assert_eq!(Graph::undirected(2, &[(1, 1)]), Err(GraphError::Loop { node: 1 }));
        let twice = GraphError::DoubleEdge { from: 1, to: 0 };
        assert_eq!(Graph::undirected(2, &[(0, 1), (1, 0)]), Err(twice));
        assert!(Graph::directed(2, &[(0, 1), (1, 0)]).is_ok());
        let far = GraphError::NodeOutOfRange { node: 2, node_count: 2 };
        assert_eq!(Graph::directed(2, &[(0, 2)]), Err(far));
    }

    #[test]
    fn the_induced_subgraph_keeps_the_edges_inside() {
        let path = Graph::undirected(4, &[(0, 1), (1, 2), (2, 3)]).unwrap();
        let inner = path.induced([1, 2, 3].into_iter().collect()).unwrap();
        assert!(inner.edges().eq([(0, 1), (1, 2)]));
        assert_eq!(path.induced(NodeSet::EMPTY), None);
    }
}
