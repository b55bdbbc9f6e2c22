//! What is said of sizes and links is true of every graph, and of every two sets that refute its robustness.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::ControlFlow;

use super::parts::{Counts, PAIRS, PARTS, pair, rooms};
use super::proof::Proof;
use super::rules::{Facts, Rule};
use super::*;
use crate::definition::exempt;
use crate::effort::Progress;
use crate::generator::Generator;
use crate::graph::set::NodeSet;
use crate::makers::{fixed, random, symmetric};

/// Five parts of the nodes, each node with the number of its part.
type Parted = Vec<usize>;

fn counts_of(parted: &Parted) -> Counts {
    core::array::from_fn(|part| parted.iter().filter(|of| **of == part).count() as i128)
}

fn links_of(graph: &Graph, parted: &Parted) -> [i128; PAIRS] {
    let mut links = [0; PAIRS];
    for one in 0..graph.node_count() {
        for other in (0..one).filter(|other| graph.has_edge(one, *other)) {
            links[pair(parted[one], parted[other])] += 1;
        }
    }
    links
}

fn holds(facts: &Facts, rule: Rule, counts: &Counts, links: &[i128; PAIRS]) -> bool {
    let row = facts.row(rule, counts);
    let sum: i128 = row.weights.iter().zip(links).map(|(weight, count)| weight * count).sum();
    row.low.is_none_or(|low| low <= sum) && row.high.is_none_or(|high| sum <= high)
}

fn vector(generator: &mut Generator, most: usize) -> [i32; PARTS] {
    core::array::from_fn(|_| {
        let entry = |value: usize| i32::try_from(value).unwrap();
        entry(generator.below(2 * most + 1)) - entry(most)
    })
}

fn rule(facts: &Facts, generator: &mut Generator) -> Rule {
    let plain = facts.plain_rules();
    match generator.below(4) {
        0 => Rule::Least(vector(generator, 9)),
        1 => Rule::Most(vector(generator, 9)),
        2 if facts.strong.is_some() => Rule::Whole(vector(generator, 2), vector(generator, 3)),
        _ => plain[generator.below(plain.len())],
    }
}

fn graphs() -> Vec<Graph> {
    let mut graphs = vec![
        fixed::k_circulant(5, 1, false).unwrap(),
        symmetric::multipartite(3, 2).unwrap(),
        symmetric::rook_complement(3, 3).unwrap(),
        symmetric::paley(5).unwrap(),
        fixed::hypercube(3).unwrap(),
        fixed::wheel(7).unwrap(),
        fixed::complete(6).unwrap(),
    ];
    for seed in 0..4 {
        graphs.push(random::erdos_renyi(7, 0.6, false, seed).unwrap());
        graphs.push(random::regular(8, 3 + usize::try_from(seed % 3).unwrap(), seed).unwrap());
    }
    graphs
}

/// Any two disjoint sets with a content member each that cannot be made larger, parted.
fn witnesses(graph: &Graph, r: usize) -> Vec<Parted> {
    let count = graph.node_count();
    let codes = 0..3_usize.pow(u32::try_from(count).unwrap());
    let places =
        codes.map(|code| (0..count).map(move |node| code / 3_usize.pow(u32::try_from(node).unwrap()) % 3));
    places.filter_map(|places| parted(graph, r, &places.collect::<Vec<_>>())).collect()
}

fn parted(graph: &Graph, r: usize, places: &[usize]) -> Option<Parted> {
    let set = |place: usize| -> NodeSet { (0..places.len()).filter(|node| places[*node] == place).collect() };
    let sets = [set(0), set(1)];
    let exempts = sets.map(|set| exempt(graph, set, r));
    let outside = |node: usize, set: NodeSet| graph.in_neighbors(node).difference(set).len();
    let fits = |node: usize| sets.iter().any(|set| outside(node, *set) < r);
    let is_witness = (0..2).all(|set| exempts[set].len() < sets[set].len()) && !set(2).iter().any(fits);
    let part = |(node, place): (usize, &usize)| match place {
        2 => 4,
        set => 2 * set + usize::from(exempts[*set].contains(node)),
    };
    is_witness.then(|| places.iter().enumerate().map(part).collect())
}

fn left(graph: &Graph, r: usize, exempt: i32) -> Vec<Quadruple> {
    let mut go_on = |_: &Progress| ControlFlow::Continue(());
    let mut meter = Meter::new(u64::MAX, &mut go_on);
    let spectrum = Spectrum::new(graph).unwrap();
    quadruples(graph, spectrum, r, exempt, u64::MAX, &mut meter).unwrap().unwrap()
}

//= theory sec:joint-sizes type=test
#[test]
fn no_sizes_that_occur_are_ruled_out() {
    let mut ruled_out = 0;
    for graph in graphs() {
        let count = i32::try_from(graph.node_count()).unwrap();
        for r in 1..=graph.node_count() / 2 + 1 {
            let left = left(&graph, r, count);
            let sizes = Sizes::new(&graph, Spectrum::new(&graph).unwrap(), r);
            ruled_out += all(&graph, &sizes, count).count() - left.len();
            for parted in witnesses(&graph, r) {
                let [a1, x1, a2, x2, _] = counts_of(&parted).map(|count| i32::try_from(count).unwrap());
                if (x1, a1) <= (x2, a2) {
                    let quadruple = Quadruple { content: [a1, a2], exempt: [x1, x2] };
                    assert!(left.contains(&quadruple), "r = {r}, {quadruple:?}, {graph:?}");
                }
            }
        }
    }
    assert!(ruled_out > 2000, "{ruled_out} ruled out");
}

/// Whatever multipliers somebody proposes: of the numbers of links that two sets have nothing is refuted.
#[test]
fn no_multipliers_refute_what_is_there() {
    let mut generator = Generator::new(3);
    for graph in graphs() {
        let facts = Facts::new(&graph, Spectrum::new(&graph).unwrap(), 2);
        for parted in witnesses(&graph, 2).iter().step_by(7) {
            let (counts, links) = (counts_of(parted), links_of(&graph, parted));
            assert!(links.iter().zip(rooms(&counts)).all(|(count, room)| *count <= room));
            for _ in 0..20 {
                let rules: Vec<Rule> = (0..3).map(|_| rule(&facts, &mut generator)).collect();
                for rule in &rules {
                    assert!(holds(&facts, *rule, &counts, &links), "{rule:?}, {parted:?}, {graph:?}");
                }
                let times = || i128::try_from(generator.below(41)).unwrap() - 20;
                let multipliers = rules.iter().copied().zip(core::iter::repeat_with(times)).collect();
                assert!(!Proof { multipliers }.refutes(&facts, &counts), "{rules:?}, {parted:?}, {graph:?}");
            }
        }
    }
}

/// What holds of any five parts, whether or not they come from two sets.
#[test]
fn degrees_eigenvalues_and_whole_numbers_are_right_of_all_parts() {
    let mut generator = Generator::new(4);
    for graph in graphs() {
        let facts = Facts::new(&graph, Spectrum::new(&graph).unwrap(), 2);
        for _ in 0..2000 {
            let parted: Parted = (0..graph.node_count()).map(|_| generator.below(PARTS)).collect();
            let rule = rule(&facts, &mut generator);
            let of_sets = matches!(rule, Rule::Content(_) | Rule::Exempt(_) | Rule::Rest(_));
            let (counts, links) = (counts_of(&parted), links_of(&graph, &parted));
            assert!(of_sets || holds(&facts, rule, &counts, &links), "{rule:?}, {parted:?}, {graph:?}");
        }
    }
}

#[test]
fn too_large_numbers_prove_nothing() {
    let graph = symmetric::kneser(10, 2).unwrap();
    let facts = Facts::new(&graph, Spectrum::new(&graph).unwrap(), 14);
    let counts = [20, 0, 20, 0, 5];
    let refutes = |times: i128| {
        Proof { multipliers: vec![(Rule::Content(0), times), (Rule::Least([1024, 0, 0, 0, 0]), -1)] }
            .refutes(&facts, &counts)
    };
    // 20 nodes that hear 13 others each have 260 links outwards; by the eigenvalues they have 250 or more.
    assert!(!refutes(1) && !refutes(i128::MAX) && !refutes(i128::MIN));
}

/// Of all quadruples those that are large enough by themselves, those that are left if whole numbers are not asked, and those that are left;
/// and the work of the last, in nodes of the search tree.
fn numbers(graph: &Graph, r: usize, exempt: i32) -> ([usize; 3], u64) {
    let spectrum = Spectrum::new(graph).unwrap();
    let sizes = Sizes::new(graph, spectrum, r);
    let facts = Facts::new(graph, spectrum, r);
    let count = |facts: Facts| {
        let mut sieve = Sieve::new(facts);
        let left = all(graph, &sizes, exempt).filter(|quadruple| !sieve.rules_out(quadruple)).count();
        (left, sieve.nodes)
    };
    let (without, _) = count(Facts { strong: None, ..facts.clone() });
    let (left, nodes) = count(facts);
    ([all(graph, &sizes, exempt).count(), without, left], nodes)
}

/// The numbers of docs/robustness-performance.md.
#[test]
fn most_sizes_of_symmetric_graphs_are_ruled_out() {
    let kneser = |points| symmetric::kneser(points, 2).unwrap();
    assert_eq!(numbers(&kneser(10), 14, 13), ([24, 12, 9], 1904));
    assert_eq!(numbers(&symmetric::rook_complement(7, 7).unwrap(), 18, 17), ([51, 28, 21], 3691));
    assert_eq!(numbers(&kneser(11), 18, 17), ([93, 42, 34], 8771));
    let paley = symmetric::paley(53).unwrap();
    assert_eq!(numbers(&paley, 13, 0), ([2, 2, 2], 64));
    assert_eq!(numbers(&paley, 12, 11), ([1, 0, 0], 26));
    for (nodes, degree, r, left) in [
        (30, 20, 9, ([27, 22, 22], 1553)),
        (32, 22, 10, ([29, 24, 24], 1772)),
        (34, 22, 10, ([208, 196, 196], 14945)),
    ] {
        let graph = random::regular(nodes, degree, 1).unwrap();
        assert_eq!(numbers(&graph, r, i32::try_from(r).unwrap() - 1), left, "{nodes}");
    }
    let half = random::regular(36, 18, 1).unwrap();
    assert_eq!(numbers(&half, 8, 7), ([337, 329, 329], 38209));
    let dense = random::erdos_renyi(42, 0.8, false, 1).unwrap();
    assert_eq!(numbers(&dense, 15, 14), ([468, 253, 253], 19513));
}
