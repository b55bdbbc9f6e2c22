//! Which graphs the data set has, each with the arguments of `closeranks graph` that make it.

use closeranks_graph::graph::Graph;
use closeranks_graph::makers::{MakerError, fixed, random, symmetric};

/// A graph and how it is made.
pub(crate) struct Recipe {
    /// The arguments of `closeranks graph`.
    pub(crate) command: String,
    /// The graph.
    pub(crate) graph: Graph,
}

/// All graphs, in the order of the file.
pub(crate) fn recipes() -> Vec<Recipe> {
    let parts = [of_one_number(), of_two_numbers(), symmetric_ones(), by_chance()];
    parts.into_iter().flatten().map(|(command, graph)| Recipe { command, graph: graph.unwrap() }).collect()
}

type Made = (String, Result<Graph, MakerError>);

fn of_one_number() -> Vec<Made> {
    let mut made = Vec::new();
    for n in 3..=14 {
        made.push((format!("complete {n}"), fixed::complete(n)));
        made.push((format!("path {n}"), fixed::path(n)));
        made.push((format!("ring {n}"), fixed::ring(n)));
        made.push((format!("star {n}"), fixed::star(n)));
        if n > 3 {
            made.push((format!("wheel {n}"), fixed::wheel(n)));
        }
    }
    made.extend((1..=5).map(|dimension| (format!("hypercube {dimension}"), fixed::hypercube(dimension))));
    made.extend((1..=5).map(|f| (format!("elemental {f}"), fixed::elemental(f))));
    made.push(("petersen".to_owned(), fixed::petersen()));
    made
}

fn of_two_numbers() -> Vec<Made> {
    let mut made = Vec::new();
    for one in 2..=6 {
        for other in one..=8 {
            made.push((format!("bipartite {one} {other}"), fixed::bipartite(one, other)));
            made.push((format!("grid {one} {other}"), fixed::grid(one, other)));
        }
    }
    for n in [7, 9, 11, 14, 18, 22] {
        for reach in 1..n / 2 {
            made.push((format!("k-circulant {n} {reach}"), fixed::k_circulant(n, reach, false)));
        }
    }
    for n in [8, 10, 12, 16, 20, 24] {
        made.extend((1..n / 2).map(|f| (format!("tight {n} {f}"), fixed::tight(n, f))));
    }
    made
}

fn symmetric_ones() -> Vec<Made> {
    let mut made = Vec::new();
    for parts in 3..=6 {
        for size in 2..=6 {
            made.push((format!("multipartite {parts} {size}"), symmetric::multipartite(parts, size)));
        }
    }
    for rows in 3..=6 {
        for columns in rows..=6 {
            let command = format!("rook-complement {rows} {columns}");
            made.push((command, symmetric::rook_complement(rows, columns)));
        }
    }
    made.extend((5..=9).map(|points| (format!("kneser {points} 2"), symmetric::kneser(points, 2))));
    made.extend([5, 13, 17, 29, 37].map(|prime| (format!("paley {prime}"), symmetric::paley(prime))));
    made
}

fn by_chance() -> Vec<Made> {
    let mut made = Vec::new();
    for n in [8, 11, 14, 18, 22, 26] {
        for seed in 1..=3 {
            for chance in [0.3, 0.5, 0.8] {
                let command = format!("erdos-renyi {n} {chance} --seed {seed}");
                made.push((command, random::erdos_renyi(n, chance, false, seed)));
            }
            let degree = 2 * (n / 4);
            made.push((format!("regular {n} {degree} --seed {seed}"), random::regular(n, degree, seed)));
            let geometric = random::random_geometric(n, 0.55, seed);
            made.push((format!("geometric {n} 0.55 --seed {seed}"), geometric));
            if n < 20 {
                let command = format!("erdos-renyi {n} 0.6 --directed --seed {seed}");
                made.push((command, random::erdos_renyi(n, 0.6, true, seed)));
            }
        }
    }
    made
}
