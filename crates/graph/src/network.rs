//! Graphs of any size: who hears whom, in lists.

use alloc::vec;
use alloc::vec::Vec;

use crate::graph::{Graph, GraphError};

/// Largest number of nodes of a network.
pub const NETWORK_LIMIT: usize = 1 << 22;

/// A graph on the nodes `0 .. n` without loops and double edges, as a list of the nodes that each node hears.
///
/// It takes four bytes a node and four an edge and direction. A [`Graph`] is for exact search, which ends far below.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Network {
    /// Where the nodes that each node hears begin in `heard`, and one past the last.
    starts: Vec<u32>,
    heard: Vec<u32>,
    directed: bool,
}

impl Network {
    /// The network in which v hears u for every pair `(u, v)`. Pairs that are there twice, loops and pairs with nodes from `node_count` on
    /// are left out. Unless it is `directed`, u hears v too.
    #[must_use]
    pub fn new(node_count: usize, directed: bool, pairs: &[(u32, u32)]) -> Self {
        let back = |&(from, to): &(u32, u32)| (!directed).then_some((to, from));
        let heard = pairs.iter().flat_map(|pair| [Some(*pair), back(pair)]).flatten().collect();
        Self::of_heard(node_count, directed, heard)
    }

    /// As [`Network::new`], of pairs that are there in both directions if it is not `directed`.
    pub(crate) fn of_heard(node_count: usize, directed: bool, mut pairs: Vec<(u32, u32)>) -> Self {
        let node_count = node_count.min(NETWORK_LIMIT);
        let inside = |node: u32| (node as usize) < node_count;
        pairs.retain(|&(from, to)| from != to && inside(from) && inside(to));
        let mut starts = starts(node_count, &pairs);
        let mut heard = vec![0; pairs.len()];
        for &(from, to) in &pairs {
            let place = &mut starts[to as usize];
            heard[*place as usize] = from;
            *place += 1;
        }
        drop(pairs);
        // Each start has moved to its end, which is the start of the next; what is there twice is closed up.
        let (mut begin, mut kept) = (0, 0);
        for place in starts.iter_mut().take(node_count) {
            let end = *place as usize;
            heard[begin..end].sort_unstable();
            *place = small(kept);
            for index in begin..end {
                if index == begin || heard[index] != heard[index - 1] {
                    heard[kept] = heard[index];
                    kept += 1;
                }
            }
            begin = end;
        }
        starts[node_count] = small(kept);
        heard.truncate(kept);
        heard.shrink_to_fit();
        Self { starts, heard, directed }
    }

    /// Number of nodes n.
    #[must_use]
    pub fn node_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether the edges have a direction.
    #[must_use]
    pub fn is_directed(&self) -> bool {
        self.directed
    }

    /// The nodes that `node` hears, in order; none if there is no such node.
    #[must_use]
    pub fn heard(&self, node: usize) -> &[u32] {
        match self.starts.get(node..node.saturating_add(2)) {
            Some(&[from, to]) => &self.heard[from as usize..to as usize],
            _ => &[],
        }
    }

    /// Whether `to` hears `from`.
    #[must_use]
    pub fn has_edge(&self, from: u32, to: usize) -> bool {
        self.heard(to).binary_search(&from).is_ok()
    }

    /// How many nodes each node hears.
    pub fn degrees(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        self.starts.windows(2).map(|ends| (ends[1] - ends[0]) as usize)
    }

    /// Number of edges, each counted once.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        if self.directed { self.heard.len() } else { self.heard.len() / 2 }
    }

    /// Every edge once, `(from, to)` if directed, `(less, greater)` if not, in the order of `to`.
    pub fn edges(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        let all = (0_u32..).zip(0..self.node_count());
        let pairs = all.flat_map(|(to, node)| self.heard(node).iter().map(move |from| (*from, to)));
        pairs.filter(|&(from, to)| self.directed || from < to)
    }

    /// The network in which every edge is turned round.
    #[must_use]
    pub fn transposed(&self) -> Self {
        if !self.directed {
            return self.clone();
        }
        let turned: Vec<(u32, u32)> = self.edges().map(|(from, to)| (to, from)).collect();
        Self::new(self.node_count(), true, &turned)
    }

    /// Makes it a graph for exact search, if it is small enough.
    pub fn graph(&self) -> Result<Graph, GraphError> {
        let mut graph = Graph::empty(self.node_count(), self.directed)?;
        for (from, to) in self.edges() {
            graph.add_edge(from as usize, to as usize)?;
        }
        Ok(graph)
    }
}

/// Where the nodes that each node hears begin, if they are put one after the other, and one past the last.
fn starts(node_count: usize, pairs: &[(u32, u32)]) -> Vec<u32> {
    let mut starts = vec![0; node_count + 1];
    for &(_, to) in pairs {
        starts[to as usize + 1] += 1;
    }
    for node in 0..node_count {
        starts[node + 1] += starts[node];
    }
    starts
}

fn small(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

impl From<&Graph> for Network {
    fn from(graph: &Graph) -> Self {
        let pairs: Vec<(u32, u32)> = graph.edges().map(|(from, to)| (small(from), small(to))).collect();
        Self::new(graph.node_count(), graph.is_directed(), &pairs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::makers::random::erdos_renyi;

    #[test]
    fn a_network_is_the_graph_it_came_from() {
        for seed in 0..40 {
            let graph = erdos_renyi(12, 0.3, seed % 2 == 0, seed).unwrap();
            let network = Network::from(&graph);
            assert_eq!(network.graph().unwrap(), graph);
            assert_eq!(network.edge_count(), graph.edge_count());
            assert!(network.degrees().eq((0..12).map(|node| graph.in_degree(node))));
            let back = network.transposed();
            for (from, to) in (0..12_u8).flat_map(|from| (0..12_u8).map(move |to| (from, to))) {
                let turned = back.has_edge(u32::from(to), usize::from(from));
                assert_eq!(turned, graph.has_edge(usize::from(from), usize::from(to)));
            }
        }
    }

    #[test]
    fn what_cannot_be_an_edge_is_left_out() {
        let network = Network::new(3, false, &[(0, 1), (1, 0), (2, 2), (1, 3)]);
        assert_eq!((network.edge_count(), network.heard(0), network.heard(2)), (1, &[1][..], &[][..]));
        assert!(network.heard(9).is_empty() && network.graph().is_ok());
        assert!(Network::new(129, false, &[]).graph().is_err());
    }
}
