//! Lent threads change how long an answer takes, and nothing of it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use core::ops::ControlFlow;
use std::thread;

use closeranks_graph::analysis::{Analysis, analyze_with};
use closeranks_graph::decide::Robustness;
use closeranks_graph::effort::{Meter, Progress};
use closeranks_graph::graph::Graph;
use closeranks_graph::makers::{fixed, random, symmetric};
use closeranks_graph::verdict::Verdict;
use closeranks_graph::workers::{Piece, Workers};
use common::NO_TABLE;

struct Threads(usize);

impl Workers for Threads {
    fn count(&self) -> usize {
        self.0
    }

    fn run(&self, pieces: Vec<Piece<'_>>, look: &mut dyn FnMut()) {
        thread::scope(|scope| {
            for piece in pieces {
                scope.spawn(piece);
            }
            look();
        });
    }
}

fn analysis(graph: &Graph, nodes: u64, threads: usize) -> Analysis {
    let mut go_on = |_: &Progress| ControlFlow::Continue(());
    let threads = Threads(threads);
    let mut meter = Meter::new(nodes, &mut go_on).with_workers(&threads);
    analyze_with(graph, &NO_TABLE, &mut meter)
}

fn graphs() -> Vec<Graph> {
    vec![
        random::erdos_renyi(22, 0.8, false, 1).unwrap(),
        random::erdos_renyi(20, 0.6, true, 2).unwrap(),
        random::regular(22, 11, 3).unwrap(),
        symmetric::multipartite(4, 5).unwrap(),
        symmetric::paley(17).unwrap(),
        fixed::k_circulant(22, 5, false).unwrap(),
    ]
}

#[test]
fn every_number_of_threads_gives_the_same_answer_and_count() {
    for graph in graphs() {
        let alone = analysis(&graph, u64::MAX, 1);
        assert!(alone.is_exact());
        for threads in [2, 3, 7] {
            assert_eq!(analysis(&graph, u64::MAX, threads), alone, "{threads} threads, {graph:?}");
        }
    }
}

//= theory sec:guess type=test
#[test]
fn a_witness_that_is_guessed_is_the_same_for_every_number_of_threads() {
    let graph = random::erdos_renyi(30, 0.8, false, 1).unwrap();
    let decide = |threads: usize| {
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let threads = Threads(threads);
        let mut meter = Meter::new(u64::MAX, &mut go_on).with_workers(&threads);
        let verdict = Robustness::new(&graph, &NO_TABLE).decide(11, 11, &mut meter);
        (verdict, meter.nodes())
    };
    let (verdict, nodes) = decide(1);
    let Verdict::NotRobust(witness) = verdict else { panic!("{verdict:?}") };
    // Without guesses it takes 903,871 nodes.
    assert!(witness.holds(&graph) && nodes < 300_000, "{nodes}");
    assert_eq!(decide(3), (verdict, nodes));
}

/// A question that is long enough for the search over both sets, and where limits end it: before, while sizes are ruled out, and after.
//= theory sec:joint-search type=test
#[test]
fn both_sets_at_once_take_the_same_for_every_number_of_threads() {
    let graph = random::regular(30, 20, 1).unwrap();
    let decide = |nodes: u64, threads: usize| {
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let threads = Threads(threads);
        let mut meter = Meter::new(nodes, &mut go_on).with_workers(&threads);
        let verdict = Robustness::new(&graph, &NO_TABLE).decide(9, 9, &mut meter);
        (verdict, meter.nodes())
    };
    let (verdict, nodes) = decide(u64::MAX, 1);
    // A search of one set after the other takes more than a million.
    assert!(matches!(verdict, Verdict::Robust(_)) && nodes < 100_000, "{verdict:?}, {nodes}");
    assert_eq!(decide(u64::MAX, 3), (verdict, nodes));
    for limit in [18_000, 19_000, 25_000, 40_000] {
        assert_eq!(decide(limit, 1), (Verdict::Unknown, limit));
        assert_eq!(decide(limit, 3), (Verdict::Unknown, limit));
    }
}

#[test]
fn a_limit_on_the_count_ends_every_search_at_the_same_place() {
    for graph in graphs() {
        for nodes in [2_500, 4_000, 10_000] {
            let alone = analysis(&graph, nodes, 1);
            for threads in [2, 5] {
                assert_eq!(analysis(&graph, nodes, threads), alone, "{threads} threads, {nodes} nodes");
            }
        }
    }
}

#[test]
fn the_callback_stops_all_threads() {
    let graph = random::erdos_renyi(40, 0.8, false, 5).unwrap();
    let mut stop = |_: &Progress| ControlFlow::Break(());
    let threads = Threads(3);
    let mut meter = Meter::new(u64::MAX, &mut stop).with_workers(&threads);
    let analysis = analyze_with(&graph, &NO_TABLE, &mut meter);
    assert!(!analysis.is_exact() && analysis.nodes < 100_000, "{}", analysis.nodes);
}
