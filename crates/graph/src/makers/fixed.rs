//! Graphs without chance.

use super::{MakerError, require};
use crate::graph::Graph;
use crate::graph::set::NODE_LIMIT;

/// All nodes joined: r_max = ceil(n/2), F_max = ceil(n/2) − 1.
pub fn complete(node_count: usize) -> Result<Graph, MakerError> {
    joined(node_count, |_, _| true)
}

/// Nodes in a row.
pub fn path(node_count: usize) -> Result<Graph, MakerError> {
    joined(node_count, |less, greater| greater == less + 1)
}

/// Nodes in a circle, three or more.
pub fn ring(node_count: usize) -> Result<Graph, MakerError> {
    require(node_count >= 3, "node_count", "3 or more for a ring")?;
    circulant(node_count, &[1], false)
}

/// Node i is heard by i + s (mod n) for each s of `steps`; undirected: they hear each other.
///
/// Steps are from 1 to n − 1, undirected to floor(n/2), each once.
pub fn circulant(node_count: usize, steps: &[usize], directed: bool) -> Result<Graph, MakerError> {
    let mut graph = Graph::empty(node_count, directed)?;
    let most = if directed { node_count - 1 } else { node_count / 2 };
    require(
        steps.iter().all(|&step| (1..=most).contains(&step)),
        "steps",
        "from 1 to n - 1, undirected n/2",
    )?;
    for node in 0..node_count {
        for step in steps {
            let other = (node + step) % node_count;
            // The step n/2 meets every edge from both ends.
            if directed || 2 * step != node_count || node < other {
                graph.add_edge(node, other)?;
            }
        }
    }
    Ok(graph)
}

/// The circulant with steps 1 ..= `reach`.
pub fn k_circulant(node_count: usize, reach: usize, directed: bool) -> Result<Graph, MakerError> {
    require(reach < NODE_LIMIT, "reach", "below the number of nodes")?;
    let steps: alloc::vec::Vec<usize> = (1..=reach).collect();
    circulant(node_count, &steps, directed)
}

/// Node 0 joined to all others, which form a ring. Four nodes or more.
pub fn wheel(node_count: usize) -> Result<Graph, MakerError> {
    require(node_count >= 4, "node_count", "4 or more for a wheel")?;
    joined(node_count, |less, greater| {
        less == 0 || greater == less + 1 || (less == 1 && greater + 1 == node_count)
    })
}

/// Node 0 joined to all others.
pub fn star(node_count: usize) -> Result<Graph, MakerError> {
    joined(node_count, |less, _| less == 0)
}

/// The first `left` nodes joined to each of the `right` others.
pub fn bipartite(left: usize, right: usize) -> Result<Graph, MakerError> {
    joined(left.saturating_add(right), |less, greater| less < left && greater >= left)
}

/// Rows and columns, row by row; neighbours up, down, left and right.
pub fn grid(rows: usize, columns: usize) -> Result<Graph, MakerError> {
    joined(rows.saturating_mul(columns), |less, greater| {
        greater == less + columns || (greater == less + 1 && greater % columns != 0)
    })
}

/// Corners of a cube of `dimension` 0 ..= 7; neighbours differ in one bit.
pub fn hypercube(dimension: usize) -> Result<Graph, MakerError> {
    require(dimension <= 7, "dimension", "7 or less")?;
    joined(1 << dimension, |less, greater| (less ^ greater).is_power_of_two())
}

/// The Petersen graph: 0 to 4 a ring, 5 to 9 a pentagram, spokes between. 1-robust although 3-connected.
pub fn petersen() -> Result<Graph, MakerError> {
    joined(10, |less, greater| match (less < 5, greater < 5) {
        (true, true) => matches!(greater - less, 1 | 4),
        (false, false) => matches!(greater - less, 2 | 3),
        _ => greater == less + 5,
    })
}

/// n = 4F + 1 nodes of which 2F are joined to all and the others form a path: (2F+1)-robust, on as few nodes as can be.
pub fn elemental(f: usize) -> Result<Graph, MakerError> {
    require(f <= NODE_LIMIT / 4, "f", "31 or less")?;
    joined(4 * f + 1, |less, greater| less < 2 * f || greater == less + 1)
}

/// Two complete graphs of floor(n/2) and ceil(n/2) nodes; node i of the first is joined to F nodes of the second from i on.
///
/// All degrees are at least F' − 1 = F + floor(n/2) − 1, and W-MSR(F) is stuck with the halves at different values, so
/// [`crate::bounds::f_by_degree`] cannot be improved. 0 ≤ F ≤ floor((n−1)/2). See docs/theory, `sec:tight`.
//= paper thm:rs_robust
//= theory sec:tight
pub fn tight(node_count: usize, f: usize) -> Result<Graph, MakerError> {
    require(node_count >= 2, "node_count", "2 or more")?;
    require(f <= (node_count - 1) / 2, "f", "floor((n - 1)/2) or less")?;
    let (first, second) = (node_count / 2, node_count.div_ceil(2));
    joined(node_count, |less, greater| {
        let across = less < first && greater >= first;
        !across || (greater - first + second - less) % second < f
    })
}

/// The graph in which `less < greater` are joined where `is_edge(less, greater)`.
pub(super) fn joined(node_count: usize, is_edge: impl Fn(usize, usize) -> bool) -> Result<Graph, MakerError> {
    let mut graph = Graph::empty(node_count, false)?;
    for greater in 1..node_count {
        for less in (0..greater).filter(|&less| is_edge(less, greater)) {
            graph.add_edge(less, greater)?;
        }
    }
    Ok(graph)
}
