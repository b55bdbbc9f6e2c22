//! Smallest additions against trying every set of edges.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use core::ops::ControlFlow;

use closeranks_graph::additions::additions;
use closeranks_graph::decide::Robustness;
use closeranks_graph::definition;
use closeranks_graph::effort::{Effort, Meter, Progress};
use closeranks_graph::graph::Graph;
use closeranks_graph::makers::{fixed, random};
use closeranks_graph::verdict::Verdict;
use common::{NO_TABLE, with_meter};

#[test]
fn as_few_as_trying_all_sets_gives() {
    for seed in 0..150_u64 {
        let count = 4 + usize::try_from(seed % 2).unwrap();
        let directed = count == 4 && seed.is_multiple_of(4);
        let graph = random::erdos_renyi(count, 0.4, directed, seed).unwrap();
        for f in 0..=1 {
            let found =
                with_meter(|meter| additions(&graph, f + 1, f + 1, &NO_TABLE, meter)).unwrap().unwrap();
            assert!(found.is_smallest());
            assert_eq!(found.edges.len(), fewest(&graph, f + 1), "F = {f}, {graph:?}");
            assert!(definition::is_robust(&with(&graph, &found.edges), f + 1, f + 1));
        }
    }
}

#[test]
fn the_tight_family_needs_few() {
    let graph = fixed::tight(8, 1).unwrap();
    let found = with_meter(|meter| additions(&graph, 2, 2, &NO_TABLE, meter)).unwrap().unwrap();
    assert!(found.is_smallest());
    assert_eq!(found.edges.len(), 1);
    let path = fixed::path(7).unwrap();
    let found = with_meter(|meter| additions(&path, 1, 1, &NO_TABLE, meter)).unwrap().unwrap();
    assert_eq!((found.edges.len(), found.least), (0, 0));
    assert_eq!(with_meter(|meter| additions(&path, 5, 5, &NO_TABLE, meter)), Ok(None));
}

#[test]
fn greedy_additions_do_and_none_is_idle() {
    for seed in 0..30_u64 {
        let graph = random::erdos_renyi(11, 0.4, seed.is_multiple_of(2), seed).unwrap();
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let effort = Effort { nodes: 20_000, ..NO_TABLE };
        let mut meter = Meter::new(effort.nodes, &mut go_on);
        let found = additions(&graph, 3, 3, &effort, &mut meter).unwrap().unwrap();
        let enough = with(&graph, &found.edges);
        assert!(is_robust(&enough, 3));
        assert!(found.least <= found.edges.len());
        for &(from, to) in &found.edges {
            let mut without = enough.clone();
            without.remove_edge(from, to);
            assert!(!is_robust(&without, 3), "seed {seed}");
        }
    }
}

fn is_robust(graph: &Graph, both: usize) -> bool {
    let verdict = with_meter(|meter| Robustness::new(graph, &NO_TABLE).decide(both, both, meter));
    matches!(verdict, Verdict::Robust(_))
}

fn with(graph: &Graph, edges: &[(usize, usize)]) -> Graph {
    let mut graph = graph.clone();
    for &(from, to) in edges {
        graph.add_edge(from, to).unwrap();
    }
    graph
}

fn fewest(graph: &Graph, both: usize) -> usize {
    let nodes = 0..graph.node_count();
    let pairs = nodes.clone().flat_map(|from| nodes.clone().map(move |to| (from, to)));
    let missing = |&(from, to): &(usize, usize)| {
        from != to && (graph.is_directed() || from < to) && !graph.has_edge(from, to)
    };
    let missing: Vec<_> = pairs.filter(missing).collect();
    let sets = 0..1_u32 << missing.len();
    let chosen = |set: u32| -> Vec<_> {
        missing.iter().enumerate().filter(|(bit, _)| set >> bit & 1 == 1).map(|(_, &edge)| edge).collect()
    };
    let enough = sets.filter(|&set| definition::is_robust(&with(graph, &chosen(set)), both, both));
    enough.map(u32::count_ones).min().unwrap() as usize
}
