//! Networks of power grids that others publish: what docs/robustness.md says of them, exactly.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use closeranks_graph::formats::{Options, read};
use common::{NO_TABLE, full_analysis};

const IEEE: [(&str, usize, usize, i32); 3] = [
    (include_str!("../../../scenarios/networks/ieee-14-bus.edges"), 14, 20, 3),
    (include_str!("../../../scenarios/networks/ieee-30-bus.edges"), 30, 41, 2),
    (include_str!("../../../scenarios/networks/ieee-57-bus.edges"), 57, 78, 3),
];

#[test]
fn the_ieee_test_cases_are_answered_exactly() {
    for (text, buses, links, s_1) in IEEE {
        let graph = read(text, &Options::default()).unwrap().named.graph;
        assert_eq!((graph.node_count(), graph.edge_count()), (buses, links));
        let analysis = full_analysis(&graph, &NO_TABLE);
        assert_eq!((analysis.r_max.exactly(), analysis.f_max.exactly()), (Some(1), Some(0)), "{buses} buses");
        let s_max: Vec<_> = analysis.s_max.iter().map(|(s_max, _)| s_max.exactly().unwrap()).collect();
        assert!(s_max[0] == s_1 && s_max[1..].iter().all(|s| *s == 0), "{buses} buses: {s_max:?}");
        assert!(analysis.witness_r.unwrap().holds(&graph) && analysis.witness_f.unwrap().holds(&graph));
    }
}
