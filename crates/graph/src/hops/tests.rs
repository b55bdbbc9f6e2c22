//! Robustness over several hops against its definition, word for word, and on graphs that are known.

extern crate std;

use alloc::vec;
use alloc::vec::Vec;
use core::ops::ControlFlow;

use super::*;
use crate::definition;
use crate::makers::fixed::{complete, grid, path, petersen, ring};
use crate::makers::random::erdos_renyi;

fn with_meter<T>(work: impl FnOnce(&mut Meter<'_>) -> T) -> T {
    let mut go = |_: &_| ControlFlow::Continue(());
    work(&mut Meter::new(u64::MAX, &mut go))
}

fn robust(graph: &Graph, hops: usize, f: usize) -> bool {
    let question = HopQuestion::survives(hops, f);
    match with_meter(|meter| decide(graph, question, meter)).unwrap() {
        HopVerdict::Robust | HopVerdict::RobustWithOneHop => true,
        HopVerdict::NotRobust(witness) => {
            assert!(with_meter(|meter| witness.holds(graph, meter)).unwrap(), "{witness:?}, {graph:?}");
            false
        }
        HopVerdict::TooLarge => panic!("{graph:?}"),
    }
}

/// All paths of at most `hops` edges to `node` from outside of `set`, as sets of their nodes but for `node`, by walking backwards.
fn all_paths(graph: &Graph, hops: usize, set: NodeSet, liars: NodeSet, node: usize) -> Vec<NodeSet> {
    let mut found = Vec::new();
    let mut open = vec![(node, NodeSet::EMPTY, 0)];
    while let Some((at, behind, length)) = open.pop() {
        if length == hops || (at != node && liars.contains(at)) {
            continue;
        }
        for source in graph.in_neighbors(at).iter().filter(|next| *next != node && !behind.contains(*next)) {
            let mut nodes = behind;
            nodes.insert(source);
            if !set.contains(source) {
                found.push(nodes);
            }
            open.push((source, nodes, length + 1));
        }
    }
    found
}

fn most_disjoint(paths: &[NodeSet]) -> usize {
    let Some((first, rest)) = paths.split_first() else { return 0 };
    let apart: Vec<NodeSet> = rest.iter().copied().filter(|path| path.is_disjoint(*first)).collect();
    most_disjoint(rest).max(1 + most_disjoint(&apart))
}

/// The definition word for word.
fn robust_by_definition(graph: &Graph, question: HopQuestion) -> bool {
    let subsets = || (0..=graph.nodes().bits()).map(NodeSet::from_bits);
    subsets().filter(|liars| liars.len() <= question.liars).all(|liars| {
        let reached = |set: NodeSet| {
            let paths = |node: &usize| all_paths(graph, question.hops, set, liars, *node);
            set.iter().filter(|node| most_disjoint(&paths(node)) >= question.r).count()
        };
        let counts: Vec<usize> = subsets().map(reached).collect();
        let held = |one: usize, other: usize| {
            let sizes = [one, other].map(|set| set.count_ones() as usize);
            counts[one] == sizes[0] || counts[other] == sizes[1] || counts[one] + counts[other] >= question.s
        };
        (1..counts.len()).all(|one| (1..one).all(|other| one & other != 0 || held(one, other)))
    })
}

fn graphs_of(nodes: usize) -> impl Iterator<Item = Graph> {
    let pairs: Vec<(usize, usize)> = (0..nodes).flat_map(|b| (0..b).map(move |a| (a, b))).collect();
    (0_u32..1 << pairs.len()).map(move |mask| {
        let edges = pairs.iter().enumerate().filter(|(place, _)| mask >> place & 1 == 1);
        Graph::undirected(nodes, &edges.map(|(_, pair)| *pair).collect::<Vec<_>>()).unwrap()
    })
}

#[test]
fn every_graph_of_four_nodes_by_the_definition() {
    for graph in graphs_of(4) {
        for (hops, r, s, liars) in
            [(1, 1, 1, 1), (2, 1, 2, 1), (2, 2, 1, 1), (2, 2, 2, 1), (3, 2, 2, 1), (3, 2, 3, 2)]
        {
            let question = HopQuestion { hops, r, s, liars };
            let found = with_meter(|meter| decide(&graph, question, meter)).unwrap();
            let holds = matches!(found, HopVerdict::Robust | HopVerdict::RobustWithOneHop);
            assert_eq!(holds, robust_by_definition(&graph, question), "{question:?}, {graph:?}");
        }
    }
}

#[test]
fn graphs_and_digraphs_of_five_and_six_nodes_by_the_definition() {
    for seed in 0..60 {
        let chance = 0.3 + 0.01 * f64::from(u32::try_from(seed % 50).unwrap());
        let count = if seed % 10 == 0 { 6 } else { 5 };
        let graph = erdos_renyi(count, chance, seed % 3 == 0, seed).unwrap();
        for hops in 1..=4 {
            let question = HopQuestion::survives(hops, 1);
            assert_eq!(robust(&graph, hops, 1), robust_by_definition(&graph, question), "{hops}, {graph:?}");
        }
    }
}

/// Over all graphs of five nodes: whatever is robust with l hops is with l + 1, one hop is the plain definition, and some graphs gain by
/// every further hop.
#[test]
fn more_hops_ask_for_less() {
    let mut gained = [0; 2];
    for graph in graphs_of(5) {
        let holds = [1, 2, 3].map(|hops| robust(&graph, hops, 1));
        assert_eq!(holds[0], definition::is_robust(&graph, 2, 2));
        assert!(holds.is_sorted(), "{graph:?}");
        assert_eq!(robust(&graph, 2, 0), definition::is_robust(&graph, 1, 1));
        gained[0] += usize::from(holds[1] && !holds[0]);
        gained[1] += usize::from(holds[2] && !holds[1]);
    }
    assert!(gained[0] > 0, "{gained:?}");
}

/// In a ring of n nodes every set is an arc, and what is told from both ends of an arc of a nodes reaches its middle over ceil(a/2) hops
/// or more: the longer the ring, the more hops it needs.
#[test]
fn rings_and_complete_graphs() {
    assert!(robust(&ring(5).unwrap(), 2, 1) && !robust(&ring(8).unwrap(), 2, 1));
    let enough = |nodes: usize| (1..=8).find(|hops| robust(&ring(nodes).unwrap(), *hops, 1));
    let needed: Vec<Option<usize>> = (4..=9).map(enough).collect();
    assert!(needed.is_sorted(), "{needed:?}");
    assert!(needed.iter().all(Option::is_some), "{needed:?}");
    assert!(robust(&complete(5).unwrap(), 2, 2) && !robust(&complete(4).unwrap(), 2, 2));
}

#[test]
fn sizes_beyond_the_table_are_answered_where_it_is_quick() {
    assert!(robust(&complete(60).unwrap(), 3, 5));
    assert!(!robust(&path(60).unwrap(), 3, 1), "its ends hear one node each");
    assert!(!robust(&grid(8, 8).unwrap(), 6, 2), "two liars cut off a corner");
    assert!(robust(&petersen().unwrap(), 3, 1));
    let large = with_meter(|meter| decide(&ring(40).unwrap(), HopQuestion::survives(2, 1), meter));
    assert!(matches!(large, Ok(HopVerdict::NotRobust(_) | HopVerdict::TooLarge)));
    let mut stop = |_: &_| ControlFlow::Break(());
    let stopped = decide(&ring(12).unwrap(), HopQuestion::survives(3, 1), &mut Meter::new(9, &mut stop));
    assert_eq!(stopped, Err(Stopped));
}
