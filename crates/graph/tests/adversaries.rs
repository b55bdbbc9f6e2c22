//! Leaders, F-local adversaries, degrees: each against its definition.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use closeranks_graph::analysis::largest;
use closeranks_graph::connectivity::node_connectivity;
use closeranks_graph::decide::Robustness;
use closeranks_graph::definition::{is_reachable, is_robust};
use closeranks_graph::effort::Effort;
use closeranks_graph::graph::Graph;
use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::leaders::{closed_set, followers, is_strongly_robust, strong_r_max};
use closeranks_graph::local;
use closeranks_graph::makers::random;
use closeranks_graph::roles::{self, Liars, Question};
use common::with_meter;

fn sample(seed: u64, count: usize) -> Graph {
    let chance = 0.2 + 0.07 * f64::from(u32::try_from(seed % 11).unwrap());
    random::erdos_renyi(count, chance, seed.is_multiple_of(2), seed).unwrap()
}

fn subsets(set: NodeSet) -> impl Iterator<Item = NodeSet> {
    (0..=set.bits()).map(NodeSet::from_bits).filter(move |subset| subset.is_subset(set))
}

#[test]
fn strong_robustness_is_what_every_set_of_followers_says() {
    for seed in 0..600_u64 {
        let graph = sample(seed, 7);
        let leaders = NodeSet::from_bits(u128::from(seed * 37 % 128));
        let rest = graph.nodes().difference(leaders);
        for r in 0..=5 {
            let literal =
                subsets(rest).filter(|set| !set.is_empty()).all(|set| is_reachable(&graph, set, r, 1));
            assert_eq!(is_strongly_robust(&graph, leaders, r), literal, "r = {r}, {leaders:?}, {graph:?}");
            if let Some(closed) = closed_set(&graph, leaders, r) {
                assert!(!is_reachable(&graph, closed, r, 1) && closed.is_disjoint(leaders));
                assert_eq!(closed.union(followers(&graph, leaders, r)), graph.nodes());
            }
        }
        match strong_r_max(&graph, leaders) {
            None => assert!(rest.is_empty()),
            Some(r) => {
                assert!(
                    is_strongly_robust(&graph, leaders, r) && !is_strongly_robust(&graph, leaders, r + 1)
                );
            }
        }
    }
}

#[test]
fn local_resilience_is_what_every_triple_of_sets_says() {
    for seed in 0..80_u64 {
        let graph = sample(seed, 5);
        for f in 0..=2 {
            let all = graph.nodes();
            let literal = subsets(all).any(|malicious| {
                subsets(all).any(|first| {
                    let rest = all.difference(first);
                    subsets(rest)
                        .any(|second| local::LocalWitness { f, malicious, first, second }.holds(&graph))
                })
            });
            let found = with_meter(|meter| local::witness(&graph, f, meter)).unwrap();
            assert_eq!(found.is_some(), literal, "F = {f}, {graph:?}");
            assert!(found.is_none_or(|witness| witness.holds(&graph)));
        }
    }
}

/// Whether liars split the graph, by trying every set of them and every half.
fn is_split(graph: &Graph, f: usize) -> bool {
    let all = graph.nodes();
    let stays = |half: NodeSet, malicious: NodeSet| {
        let mut honest = half.difference(malicious);
        loop {
            let set = honest.union(half.intersection(malicious));
            let content = |node: &usize| graph.in_neighbors(*node).difference(set).len() <= f;
            let left: NodeSet = honest.iter().filter(content).collect();
            if left == honest {
                return !honest.is_empty();
            }
            honest = left;
        }
    };
    let mut local = subsets(all).filter(|malicious| local::is_local(graph, *malicious, f));
    local.any(|malicious| {
        subsets(all).any(|half| stays(half, malicious) && stays(all.difference(half), malicious))
    })
}

/// The search against all sets, and what it writes down where there is no split.
fn search_is_right(graph: &Graph, f: usize) {
    let found = with_meter(|meter| local::witness(graph, f, meter)).unwrap();
    assert_eq!(found.is_some(), is_split(graph, f), "F = {f}, {graph:?}");
    assert!(found.is_none_or(|witness| witness.holds(graph)));
    let question = Question { r: f + 1, liars: Liars::Local };
    let refutation = with_meter(|meter| roles::refutation(graph, question, 1 << 20, meter)).unwrap();
    assert_eq!(refutation.is_none(), found.is_some());
    assert!(refutation.is_none_or(|refutation| refutation.check(graph, question) == Ok(())));
}

/// All graphs of five nodes, and all directed ones of four.
//= theory sec:local type=test
#[test]
fn the_search_for_local_liars_is_right_on_all_small_graphs() {
    for (nodes, directed) in [(5, false), (4, true)] {
        let pairs: Vec<(usize, usize)> = (0..nodes)
            .flat_map(|from| (0..nodes).map(move |to| (from, to)))
            .filter(|(from, to)| if directed { from != to } else { from < to })
            .collect();
        for code in 0..1_u32 << pairs.len() {
            let mut graph = Graph::empty(nodes, directed).unwrap();
            for (_, (from, to)) in pairs.iter().enumerate().filter(|(bit, _)| code >> bit & 1 == 1) {
                graph.add_edge(*from, *to).unwrap();
            }
            (0..=2).for_each(|f| search_is_right(&graph, f));
        }
    }
}

#[test]
fn the_search_for_local_liars_is_right_on_graphs_by_chance() {
    for seed in 0..150 {
        (0..=3).for_each(|f| search_is_right(&sample(seed, 8), f));
    }
}

/// Fewer than s liars in all: a split is a witness against (r,s)-robustness.
//= theory sec:roles type=test
#[test]
fn roles_say_what_the_definition_says() {
    for seed in 0..150 {
        let graph = sample(seed, 7);
        for (r, s) in (1..=4).flat_map(|r| (1..=5).map(move |s| (r, s))) {
            let question = Question { r, liars: Liars::Total { s } };
            let found = with_meter(|meter| roles::split(&graph, question, meter)).unwrap();
            assert_eq!(found.is_none(), is_robust(&graph, r, s), "({r},{s}), {graph:?}");
            assert!(found.is_none_or(|split| split.holds(&graph, question)));
            let refutation = with_meter(|meter| roles::refutation(&graph, question, 1 << 20, meter)).unwrap();
            assert_eq!(refutation.is_none(), found.is_some());
            assert!(refutation.is_none_or(|refutation| refutation.check(&graph, question) == Ok(())));
        }
    }
}

#[test]
fn local_resilience_lies_between_r_and_f_total() {
    for seed in 0..120_u64 {
        let graph = sample(seed, 8);
        let mut robustness = Robustness::new(&graph, &Effort::UNLIMITED);
        let (local, witness) = with_meter(|meter| local::f_max(&mut robustness, meter));
        let local = local.exactly().unwrap();
        assert!(
            witness.is_none_or(|witness| witness.holds(&graph) && i32::try_from(witness.f) == Ok(local + 1))
        );
        assert!(local < 0 || !is_split(&graph, usize::try_from(local).unwrap()), "{graph:?}");
        assert!(is_split(&graph, usize::try_from(local + 1).unwrap()), "{graph:?}");
        let (r_max, f_max) = largest(&graph);
        let (r_max, f_max) = (r_max.exactly().unwrap(), f_max.exactly().unwrap());
        assert!(local <= f_max && f_max < r_max.max(1), "{graph:?}");
        assert!(r_max == 0 || local >= (r_max - 1) / 2, "{graph:?}");
        assert!(
            i32::try_from(node_connectivity(&graph)).unwrap() >= r_max || graph.is_directed(),
            "{graph:?}"
        );
    }
}

//= paper ftotal type=test
#[test]
fn local_sets_are_counted_by_their_hearers() {
    let graph = Graph::directed(4, &[(0, 3), (1, 3), (2, 1)]).unwrap();
    let malicious: NodeSet = [0, 1].into_iter().collect();
    assert_eq!(local::local_least(&graph, malicious), 2);
    assert!(local::is_local(&graph, malicious, 2) && !local::is_local(&graph, malicious, 1));
    assert!(local::is_total(malicious, 2) && !local::is_total(malicious, 1));
    assert_eq!(local::local_least(&graph, graph.nodes()), 0);
}
