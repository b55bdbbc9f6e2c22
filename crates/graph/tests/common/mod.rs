//! One graph, every algorithm, the literal definition.
#![allow(dead_code, reason = "each test file uses a part")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use core::ops::ControlFlow;

use closeranks_graph::analysis::{Analysis, analyze, largest};
use closeranks_graph::bounds;
use closeranks_graph::decide::Robustness;
use closeranks_graph::definition;
use closeranks_graph::effort::{Effort, Meter, Progress};
use closeranks_graph::graph::Graph;
use closeranks_graph::search;
use closeranks_graph::table;
use closeranks_graph::verdict::Verdict;

/// Branch and bound only.
pub(crate) const NO_TABLE: Effort = Effort { nodes: u64::MAX, table_bytes: 0 };

pub(crate) fn with_meter<T>(work: impl FnOnce(&mut Meter<'_>) -> T) -> T {
    let mut go_on = |_: &Progress| ControlFlow::Continue(());
    work(&mut Meter::new(u64::MAX, &mut go_on))
}

pub(crate) fn full_analysis(graph: &Graph, effort: &Effort) -> Analysis {
    analyze(graph, effort, &mut |_| ControlFlow::Continue(()))
}

/// s_max for r = 1 ..= ceil(n/2) + 1 by the definition, word for word.
pub(crate) fn literal_table(graph: &Graph) -> Vec<usize> {
    let count = graph.node_count();
    let s_max = |r| (1..=count).take_while(|&s| definition::is_robust(graph, r, s)).count();
    (1..=count.div_ceil(2) + 1).map(s_max).collect()
}

/// Every algorithm and bound against the definition.
pub(crate) fn check(graph: &Graph) {
    let literal = literal_table(graph);
    check_table(graph, &literal);
    check_search(graph, &literal);
    check_bounds(graph, &literal);
    check_analysis(graph, &literal);
}

fn check_table(graph: &Graph, literal: &[usize]) {
    with_meter(|meter| {
        for (index, &s_max) in literal.iter().enumerate() {
            let (found, witness) = table::s_max(graph, index + 1, 1 << 16, meter).unwrap();
            assert_eq!(found, s_max, "table at r = {}, {graph:?}", index + 1);
            assert_eq!(witness.is_none(), s_max == graph.node_count());
            assert!(witness.is_none_or(|w| w.holds(graph) && w.s == s_max + 1 && w.exempt.len() == s_max));
        }
        let (r_max, witness) = table::r_max(graph, 1 << 16, meter).unwrap();
        assert_eq!(r_max, largest_r(graph, literal), "table, {graph:?}");
        assert!(witness.is_none_or(|w| w.holds(graph)));
    });
}

fn check_search(graph: &Graph, literal: &[usize]) {
    let count = graph.node_count();
    with_meter(|meter| {
        for (index, &s_max) in literal.iter().enumerate() {
            for s in 0..=count + 1 {
                let witness = search::witness(graph, index + 1, s, meter).unwrap();
                let robust = s <= s_max || s_max == count;
                assert_eq!(witness.is_none(), robust, "search at ({}, {s}), {graph:?}", index + 1);
                assert!(witness.is_none_or(|w| w.holds(graph) && w.s == s));
            }
        }
    });
}

fn check_bounds(graph: &Graph, literal: &[usize]) {
    let count = graph.node_count();
    let r_max = largest_r(graph, literal);
    assert!(r_max <= bounds::r_most(graph), "{graph:?}");
    for r in 1..=bounds::r_least(graph).min(literal.len()) {
        assert_eq!(literal[r - 1], count, "degrees, {graph:?}");
    }
    for (index, &s_max) in literal.iter().enumerate() {
        let pair = bounds::content_pair(graph, index + 1);
        assert_eq!(pair.is_none(), s_max == count, "pairs at r = {}, {graph:?}", index + 1);
        assert!(pair.is_none_or(|w| w.holds(graph)));
    }
}

fn check_analysis(graph: &Graph, literal: &[usize]) {
    let analysis = full_analysis(graph, &NO_TABLE);
    assert!(analysis.is_exact());
    let s_max: Vec<_> = analysis.s_max.iter().map(|(s, _)| usize::try_from(s.least).unwrap()).collect();
    assert_eq!(s_max, literal[..literal.len() - 1], "{graph:?}");
    assert_eq!(usize::try_from(analysis.r_max.least), Ok(largest_r(graph, literal)), "{graph:?}");
    let f_max = literal.iter().enumerate().take_while(|&(index, &s)| s > index).count();
    let f_max = if graph.node_count() == 1 { 1 } else { f_max };
    assert_eq!(analysis.f_max.least + 1, i32::try_from(f_max).unwrap(), "{graph:?}");
    assert_eq!(largest(graph), (analysis.r_max, analysis.f_max));
    if graph.node_count() > 1 {
        assert!(analysis.witness_r.is_some_and(|w| w.holds(graph)), "{graph:?}");
        assert!(analysis.witness_f.is_some_and(|w| w.holds(graph)), "{graph:?}");
    }
    check_decisions(graph, literal);
}

/// Questions in an order that lets the answers help each other, or not.
fn check_decisions(graph: &Graph, literal: &[usize]) {
    let count = graph.node_count();
    let mut robustness = Robustness::new(graph, &NO_TABLE);
    with_meter(|meter| {
        for r in (1..=literal.len()).rev() {
            for s in [1, count, count / 2, r, count + 3] {
                let robust = s <= literal[r - 1] || literal[r - 1] == count;
                match robustness.decide(r, s, meter) {
                    Verdict::Robust(_) => assert!(robust, "({r}, {s}), {graph:?}"),
                    Verdict::NotRobust(w) => assert!(!robust && w.holds(graph) && (w.r, w.s) == (r, s)),
                    Verdict::Unknown => panic!("no effort was set"),
                }
            }
        }
    });
}

fn largest_r(graph: &Graph, literal: &[usize]) -> usize {
    if graph.node_count() == 1 { 1 } else { literal.iter().take_while(|&&s| s > 0).count() }
}
