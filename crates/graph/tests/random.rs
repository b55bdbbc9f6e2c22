//! Thousands of seeded random graphs: the algorithms against the definition, and where that is too slow against each other.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use core::ops::ControlFlow;

use closeranks_graph::analysis::{analyze, largest};
use closeranks_graph::bounds;
use closeranks_graph::decide::Robustness;
use closeranks_graph::effort::Effort;
use closeranks_graph::graph::Graph;
use closeranks_graph::makers::{fixed, random};
use closeranks_graph::search;
use closeranks_graph::table;
use closeranks_graph::verdict::{Proved, Verdict};
use common::{NO_TABLE, check, full_analysis, with_meter};

#[test]
fn graphs_of_7_and_8_nodes_by_the_definition() {
    for seed in 0..3000_u64 {
        check(&random::erdos_renyi(7, chance(seed), seed.is_multiple_of(2), seed).unwrap());
    }
    for seed in 0..600_u64 {
        check(&random::erdos_renyi(8, chance(seed), seed.is_multiple_of(2), seed).unwrap());
    }
}

#[test]
fn graphs_of_9_to_14_nodes_one_algorithm_against_the_other() {
    for seed in 0..1500_u64 {
        let count = 9 + usize::try_from(seed % 6).unwrap();
        agree(&random::erdos_renyi(count, chance(seed), seed.is_multiple_of(2), seed).unwrap());
    }
}

#[test]
fn geometric_and_regular_graphs_one_algorithm_against_the_other() {
    for seed in 0..100_u64 {
        agree(&random::random_geometric(13, 0.3 + 0.1 * chance(seed), seed).unwrap());
        agree(&random::regular(12, 3 + usize::try_from(seed % 8).unwrap(), seed).unwrap());
        agree(&random::preferential_attachment(13, 5, 3, seed).unwrap());
    }
}

#[test]
fn larger_graphs_one_algorithm_against_the_other() {
    for seed in 0..8_u64 {
        agree(&random::erdos_renyi(18, chance(seed), seed.is_multiple_of(2), seed).unwrap());
    }
}

#[test]
fn more_than_64_nodes() {
    assert_eq!(exact(&fixed::complete(128).unwrap()), (64, 63));
    assert_eq!(exact(&fixed::ring(100).unwrap()), (1, 0));
    assert_eq!(exact(&fixed::star(128).unwrap()), (1, 0));
    assert_eq!(exact(&fixed::elemental(31).unwrap()), (63, 31));
    assert_eq!(exact(&random::preferential_attachment(70, 9, 5, 3).unwrap()).0, 5);
}

#[test]
fn what_a_small_budget_proves_is_true() {
    for seed in 0..40_u64 {
        let graph = random::erdos_renyi(16, 0.7, false, seed).unwrap();
        let exact = full_analysis(&graph, &NO_TABLE);
        for nodes in [0, 3, 30, 300, 3000] {
            let effort = Effort { nodes, table_bytes: 0 };
            let part = analyze(&graph, &effort, &mut |_| ControlFlow::Continue(()));
            assert!(part.nodes <= nodes);
            let pairs = part.s_max.iter().zip(&exact.s_max).map(|(p, e)| (p.0, e.0));
            for (known, true_value) in pairs.chain([(part.r_max, exact.r_max), (part.f_max, exact.f_max)]) {
                let value = true_value.exactly().unwrap();
                assert!(known.least <= value && value <= known.most, "seed {seed}, {nodes} nodes");
                match known.proved() {
                    Proved::Exactly(found) => assert_eq!(found, value),
                    Proved::AtLeast(least) => assert!(least <= value && 0 < least),
                    Proved::AtMost(most) => assert!(most >= value),
                }
            }
        }
    }
}

#[test]
fn a_short_search_has_a_lower_end_too() {
    for seed in 0..4 {
        let graph = random::erdos_renyi(44, 0.8, false, seed).unwrap();
        let effort = Effort { nodes: 60_000, table_bytes: 0 };
        let part = analyze(&graph, &effort, &mut |_| ControlFlow::Continue(()));
        let by_degree = i32::try_from(bounds::r_least(&graph)).unwrap();
        assert!(part.r_max.least > by_degree && part.r_max.least >= 10, "{:?}", part.r_max);
        assert!(part.f_max.least >= (part.r_max.least - 1) / 2);
    }
}

#[test]
fn r_and_s_beyond_all_bounds_are_answered() {
    let graph = fixed::complete(5).unwrap();
    let mut robustness = Robustness::new(&graph, &NO_TABLE);
    for (r, s) in [(1000, 1), (usize::MAX, usize::MAX), (4, 2)] {
        match with_meter(|meter| robustness.decide(r, s, meter)) {
            Verdict::NotRobust(witness) => assert!(witness.holds(&graph) && witness.r == r && witness.s == s),
            other => panic!("{other:?}"),
        }
        assert!(with_meter(|meter| search::witness(&graph, r, s, meter)).unwrap().is_some());
    }
    let robust = with_meter(|meter| robustness.decide(3, usize::MAX, meter));
    assert!(matches!(robust, Verdict::Robust(_)));
}

#[test]
fn the_callback_stops_the_work() {
    let graph = random::erdos_renyi(40, 0.8, false, 5).unwrap();
    let mut calls = 0;
    let analysis = analyze(&graph, &NO_TABLE, &mut |progress| {
        calls += 1;
        if progress.nodes > 20_000 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(!analysis.is_exact() && analysis.nodes < 30_000);
    assert!((4..10).contains(&calls), "{calls} calls");
}

#[test]
fn a_table_that_is_too_large_is_refused() {
    let graph = fixed::complete(128).unwrap();
    let refused = with_meter(|meter| table::r_max(&graph, u64::MAX - 1, meter));
    assert!(matches!(refused, Err(table::TableError::Memory { needed: u64::MAX, .. })));
    let graph = fixed::complete(20).unwrap();
    let refused = with_meter(|meter| table::s_max(&graph, 3, 1000, meter));
    assert_eq!(refused, Err(table::TableError::Memory { needed: 1 << 20, allowed: 1000 }));
}

/// Branch and bound alone, with the table's help, and the table alone.
fn agree(graph: &Graph) {
    let search = full_analysis(graph, &NO_TABLE);
    let both = full_analysis(graph, &Effort::UNLIMITED);
    let values = |analysis: &closeranks_graph::analysis::Analysis| {
        let s_max: Vec<_> = analysis.s_max.iter().map(|(s, _)| s.exactly().unwrap()).collect();
        (analysis.r_max.exactly().unwrap(), analysis.f_max.exactly().unwrap(), s_max)
    };
    assert_eq!(values(&search), values(&both), "{graph:?}");
    let table = with_meter(|meter| table::s_max_table(graph, 1 << 18, meter)).unwrap();
    let table: Vec<_> = table.into_iter().map(|s| i32::try_from(s).unwrap()).collect();
    assert_eq!(values(&search).2, table, "{graph:?}");
}

fn exact(graph: &Graph) -> (i32, i32) {
    let (r_max, f_max) = largest(graph);
    (r_max.exactly().unwrap(), f_max.exactly().unwrap())
}

/// From 0.1 to 0.95.
fn chance(seed: u64) -> f64 {
    0.1 + 0.05 * f64::from(u32::try_from(seed % 18).unwrap())
}
