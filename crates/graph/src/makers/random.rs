//! Graphs by chance. One seed is one graph, on every machine; the generator is SplitMix64.

use alloc::vec::Vec;

use super::{MakerError, fixed, require};
use crate::generator::Generator;
use crate::graph::Graph;
use crate::graph::set::NodeSet;

/// Every edge is there with `probability`, `0.0 ..= 1.0`, independently of the others.
pub fn erdos_renyi(
    node_count: usize,
    probability: f64,
    directed: bool,
    seed: u64,
) -> Result<Graph, MakerError> {
    require((0.0..=1.0).contains(&probability), "probability", "from 0 to 1")?;
    let mut graph = Graph::empty(node_count, directed)?;
    let mut generator = Generator::new(seed);
    for from in 0..node_count {
        let first = if directed { 0 } else { from + 1 };
        for to in first..node_count {
            if from != to && generator.unit() < probability {
                graph.add_edge(from, to)?;
            }
        }
    }
    Ok(graph)
}

/// Undirected, every node of degree `degree` < n, n·degree even: a circulant after 20 random switches per edge.
///
/// A switch replaces edges a — b, c — d by a — d, c — b where that makes no loop and no double edge.
pub fn regular(node_count: usize, degree: usize, seed: u64) -> Result<Graph, MakerError> {
    require(degree < node_count.max(1), "degree", "below the number of nodes")?;
    require(
        node_count.is_multiple_of(2) || degree.is_multiple_of(2),
        "degree",
        "even if the number of nodes is odd",
    )?;
    let mut steps: Vec<usize> = (1..=degree / 2).collect();
    if !degree.is_multiple_of(2) {
        steps.push(node_count / 2);
    }
    let mut graph = fixed::circulant(node_count, &steps, false)?;
    let mut edges: Vec<(usize, usize)> = graph.edges().collect();
    let mut generator = Generator::new(seed);
    for _ in 0..20 * edges.len() {
        switch(&mut graph, &mut edges, &mut generator)?;
    }
    Ok(graph)
}

fn switch(
    graph: &mut Graph,
    edges: &mut [(usize, usize)],
    generator: &mut Generator,
) -> Result<(), MakerError> {
    let (one, other) = (generator.below(edges.len()), generator.below(edges.len()));
    let (a, b) = edges[one];
    let (c, d) = if generator.below(2) == 0 { edges[other] } else { (edges[other].1, edges[other].0) };
    let distinct = a != c && a != d && b != c && b != d;
    if distinct && !graph.has_edge(a, d) && !graph.has_edge(c, b) {
        graph.remove_edge(a, b);
        graph.remove_edge(c, d);
        graph.add_edge(a, d)?;
        graph.add_edge(c, b)?;
        (edges[one], edges[other]) = ((a, d), (c, b));
    }
    Ok(())
}

/// Points that are `radius` or less apart are joined, in any number of dimensions.
pub fn geometric<const D: usize>(points: &[[f64; D]], radius: f64) -> Result<Graph, MakerError> {
    require(radius >= 0.0, "radius", "0 or more")?;
    let mut graph = Graph::empty(points.len(), false)?;
    for (to, there) in points.iter().enumerate() {
        for (from, here) in points[..to].iter().enumerate() {
            let squares = here.iter().zip(there).map(|(h, t)| (h - t) * (h - t));
            if squares.sum::<f64>() <= radius * radius {
                graph.add_edge(from, to)?;
            }
        }
    }
    Ok(graph)
}

/// `count` points, uniform in the unit square.
#[must_use]
pub fn unit_square(count: usize, seed: u64) -> Vec<[f64; 2]> {
    let mut generator = Generator::new(seed);
    (0..count).map(|_| [generator.unit(), generator.unit()]).collect()
}

/// Points uniform in the unit square, joined if `radius` or less apart.
pub fn random_geometric(node_count: usize, radius: f64, seed: u64) -> Result<Graph, MakerError> {
    // Refused before the points are made.
    Graph::empty(node_count, false)?;
    geometric(&unit_square(node_count, seed), radius)
}

/// Starts as a complete graph of `start` nodes; each new node joins `links` ≤ `start` others, the likelier the higher their degree.
///
/// If the start is r-robust and `links` ≥ r, so is the graph.
pub fn preferential_attachment(
    node_count: usize,
    start: usize,
    links: usize,
    seed: u64,
) -> Result<Graph, MakerError> {
    require((1..=node_count).contains(&start), "start", "from 1 to the number of nodes")?;
    require(links <= start, "links", "at most the nodes at the start")?;
    let mut graph = Graph::empty(node_count, false)?;
    for greater in 1..start {
        for less in 0..greater {
            graph.add_edge(less, greater)?;
        }
    }
    let mut generator = Generator::new(seed);
    for newcomer in start..node_count {
        for old in chosen(&graph, newcomer, links, &mut generator).iter() {
            graph.add_edge(old, newcomer)?;
        }
    }
    Ok(graph)
}

/// `links` of the first `count` nodes, one after the other, each with a chance in proportion to its degree + 1.
fn chosen(graph: &Graph, count: usize, links: usize, generator: &mut Generator) -> NodeSet {
    let mut chosen = NodeSet::EMPTY;
    for _ in 0..links {
        let free = || NodeSet::first(count).difference(chosen).iter();
        let total: usize = free().map(|node| graph.in_degree(node) + 1).sum();
        let mut ticket = generator.below(total);
        let winner = free().find(|&node| {
            let weight = graph.in_degree(node) + 1;
            let wins = ticket < weight;
            ticket = ticket.saturating_sub(weight);
            wins
        });
        chosen = chosen.union(winner.into_iter().collect());
    }
    chosen
}
