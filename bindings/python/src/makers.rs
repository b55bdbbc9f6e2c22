//! Graphs by name.

use closeranks_graph::graph::Graph;
use closeranks_graph::makers::{MakerError, delaunay, fixed, large, minimal, random, symmetric};
use closeranks_graph::network::Network;
use pyo3::prelude::*;

use crate::errors;

/// The numbers of a maker: whole ones, one that is not, and what they say of direction and chance.
struct Numbers {
    whole: Vec<usize>,
    real: f64,
    directed: bool,
    seed: u64,
}

/// Nodes, whether edges have a direction, edges.
type Made = (usize, bool, Vec<(usize, usize)>);

/// The graph that is called `name`.
#[pyfunction]
#[pyo3(signature = (name, whole, real, directed, seed))]
pub(crate) fn make(name: &str, whole: Vec<usize>, real: f64, directed: bool, seed: u64) -> PyResult<Made> {
    let made = made(name, &Numbers { whole, real, directed, seed });
    let graph = made.ok_or_else(|| errors::graph(format!("no graph is called \"{name}\"")))?;
    let graph = graph.map_err(errors::graph)?;
    let edges = graph.edges().map(|(from, to)| (from as usize, to as usize));
    Ok((graph.node_count(), graph.is_directed(), edges.collect()))
}

/// The network of a maker without a limit, or the graph of one with it.
fn made(name: &str, numbers: &Numbers) -> Option<Result<Network, MakerError>> {
    let Numbers { whole, seed, .. } = numbers;
    Some(match (name, &whole[..]) {
        ("ranked", [n, f]) => large::ranked(*n, *f, *seed),
        ("triangular", [rows, columns]) => large::triangular(*rows, *columns),
        ("delaunay", [n]) => delaunay::delaunay(*n, *seed),
        _ => return small(name, numbers).map(|graph| graph.map(|graph| Network::from(&graph))),
    })
}

fn small(name: &str, numbers: &Numbers) -> Option<Result<Graph, MakerError>> {
    let Numbers { whole, real, directed, seed } = numbers;
    Some(match (name, &whole[..]) {
        ("complete", [n]) => fixed::complete(*n),
        ("path", [n]) => fixed::path(*n),
        ("ring", [n]) => fixed::ring(*n),
        ("circulant", [n, steps @ ..]) => fixed::circulant(*n, steps, *directed),
        ("k_circulant", [n, reach]) => fixed::k_circulant(*n, *reach, *directed),
        ("wheel", [n]) => fixed::wheel(*n),
        ("star", [n]) => fixed::star(*n),
        ("bipartite", [left, right]) => fixed::bipartite(*left, *right),
        ("grid", [rows, columns]) => fixed::grid(*rows, *columns),
        ("hypercube", [dimension]) => fixed::hypercube(*dimension),
        ("petersen", []) => fixed::petersen(),
        ("elemental", [f]) => fixed::elemental(*f),
        ("tight", [n, f]) => fixed::tight(*n, *f),
        ("erdos_renyi", [n]) => random::erdos_renyi(*n, *real, *directed, *seed),
        ("regular", [n, degree]) => random::regular(*n, *degree, *seed),
        ("geometric", [n]) => random::random_geometric(*n, *real, *seed),
        ("preferential", [n, start, links]) => random::preferential_attachment(*n, *start, *links, *seed),
        ("multipartite", [parts, size]) => symmetric::multipartite(*parts, *size),
        ("rook_complement", [rows, columns]) => symmetric::rook_complement(*rows, *columns),
        ("kneser", [points, chosen]) => symmetric::kneser(*points, *chosen),
        ("paley", [prime]) => symmetric::paley(*prime),
        ("merg", [n]) => minimal::merg(*n),
        ("merg_f", [n]) => minimal::merg_f(*n),
        _ => return None,
    })
}
