//! Both algorithms against the literal definition on every small graph.
use core::ops::ControlFlow;
use closeranks_graph::budget::Meter;
use closeranks_graph::graph::Graph;
use closeranks_graph::{decide, definition, table};

fn pairs(n: usize, directed: bool) -> Vec<(usize, usize)> {
    let all = (0..n).flat_map(|u| (0..n).map(move |v| (u, v)));
    all.filter(|&(u, v)| if directed { u != v } else { u < v }).collect()
}

fn check(graph: &Graph) {
    let n = graph.node_count();
    let mut go_on = |_: &_| ControlFlow::Continue(());
    let mut meter = Meter::new(u64::MAX, &mut go_on);
    let mut r_max = 0;
    for r in 1..=n.div_ceil(2) + 1 {
        let literal = (1..=n).take_while(|&s| definition::is_robust(graph, r, s)).last().unwrap_or(0);
        let (found, _) = table::s_max(graph, r, 1 << 12, &mut meter).unwrap();
        assert_eq!(found, literal, "table, r = {r}, {graph:?}");
        for s in 1..=n + 1 {
            let witness = decide::witness(graph, r, s, &mut meter).unwrap();
            assert_eq!(witness.is_none(), s <= literal || literal == n, "search, ({r},{s}), {graph:?}");
        }
        if literal > 0 && r <= n.div_ceil(2) {
            r_max = r;
        }
    }
    assert_eq!(table::r_max(graph, 1 << 12, &mut meter).unwrap().0, r_max);
}

fn check_all(n: usize, directed: bool) {
    let pairs = pairs(n, directed);
    for code in 0..1_u64 << pairs.len() {
        let edges: Vec<_> = pairs.iter().enumerate().filter(|(k, _)| code >> k & 1 == 1).map(|(_, &e)| e).collect();
        let graph = if directed { Graph::directed(n, &edges) } else { Graph::undirected(n, &edges) };
        check(&graph.unwrap());
    }
}

#[test]
fn graphs() {
    (1..=5).for_each(|n| check_all(n, false));
}
#[test]
fn digraphs() {
    (1..=4).for_each(|n| check_all(n, true));
}
