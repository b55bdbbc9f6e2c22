//! Both algorithms, the bounds and the analysis against the literal definition, on every small graph.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use closeranks_graph::graph::Graph;
use common::check;

#[test]
fn every_graph_of_up_to_5_nodes() {
    (1..=5).for_each(|count| every(count, false, 1));
}

/// `check` holds what degrees alone guarantee against the definition for every graph; here by hand, at its edge.
//= paper lem:rs_robust type=test
#[test]
fn degrees_alone_guarantee_robustness_and_not_more() {
    let ring = closeranks_graph::makers::fixed::ring(4).unwrap();
    assert_eq!(closeranks_graph::bounds::r_least(&ring), 1);
    assert!((1..=4).all(|s| closeranks_graph::definition::is_robust(&ring, 1, s)));
    assert!(!closeranks_graph::definition::is_robust(&ring, 2, 1));
}

#[test]
fn every_graph_of_6_nodes() {
    every(6, false, 1);
}

#[test]
fn every_digraph_of_up_to_4_nodes() {
    (1..=4).for_each(|count| every(count, true, 1));
}

#[test]
fn every_499th_digraph_of_5_nodes() {
    every(5, true, 499);
}

fn every(node_count: usize, directed: bool, stride: usize) {
    let all = (0..node_count).flat_map(|from| (0..node_count).map(move |to| (from, to)));
    let pairs: Vec<_> = all.filter(|&(from, to)| if directed { from != to } else { from < to }).collect();
    for code in (0..1_u64 << pairs.len()).step_by(stride) {
        let mut graph = Graph::empty(node_count, directed).unwrap();
        for (_, &(from, to)) in pairs.iter().enumerate().filter(|(bit, _)| code >> bit & 1 == 1) {
            graph.add_edge(from, to).unwrap();
        }
        check(&graph);
    }
}
