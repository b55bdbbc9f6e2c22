//! Which nodes look alike: orbits under the automorphisms of a graph.
//!
//! What holds of one node of an orbit holds of all, so the search tries one root of each.

use alloc::vec;
use alloc::vec::Vec;

use crate::graph::Graph;
use crate::graph::set::NodeSet;

/// Pairs of nodes that are told apart from all others, over all searches for automorphisms, before they are given up.
const TRIES: usize = 400;

/// The orbit of every node, as far as explicit automorphisms were found.
///
/// Each pair of nodes in one set is joined by automorphisms that were checked edge by edge. The search is bounded, so that
/// for unusual graphs a set may be a part of the true orbit. O(n³ log n) for most graphs.
#[must_use]
pub fn orbits(graph: &Graph) -> Vec<NodeSet> {
    let nodes = 0..graph.node_count();
    let mut orbits: Vec<NodeSet> = nodes.clone().map(|node| NodeSet::from_iter([node])).collect();
    let same = vec![0; graph.node_count()];
    let Some((classes, _)) = refine(graph, same.clone(), same) else {
        return orbits;
    };
    let mut tries = TRIES;
    for node in nodes {
        // One try with the least alike node that is not joined yet with it, per orbit.
        let leads = (0..node)
            .filter(|&lead| classes[lead] == classes[node] && orbits[lead].iter().next() == Some(lead));
        for lead in leads.collect::<Vec<_>>() {
            if orbits[lead].contains(node) {
                break;
            }
            if let Some(image) = automorphism(graph, &classes, (lead, node), &mut tries) {
                join(&mut orbits, &image);
                break;
            }
        }
    }
    orbits
}

/// All nodes that automorphisms take `node` to which keep the colour of every node, as far as they were found with `tries` tries.
///
/// What cannot be done with `node` while what is known is told by colours cannot be done with any of these.
#[must_use]
pub fn orbit(graph: &Graph, colors: &[usize], node: usize, mut tries: usize) -> NodeSet {
    let mut orbit = NodeSet::from_iter([node]);
    let Some((classes, _)) = refine(graph, colors.to_vec(), colors.to_vec()) else {
        return orbit;
    };
    let mut images: Vec<Vec<usize>> = Vec::new();
    for other in 0..graph.node_count() {
        if classes[other] != classes[node] || orbit.contains(other) {
            continue;
        }
        if let Some(image) = automorphism(graph, &classes, (node, other), &mut tries) {
            images.push(image);
            orbit = closed(orbit, &images);
        }
    }
    orbit
}

/// What `images` make of `set`, again and again.
fn closed(mut set: NodeSet, images: &[Vec<usize>]) -> NodeSet {
    loop {
        let moved = images.iter().flat_map(|image| set.iter().map(|node| image[node])).collect();
        let more = set.union(moved);
        if more == set {
            return set;
        }
        set = more;
    }
}

/// For each node those that it may trade places with alone: they hear the same others and tell the same others.
#[must_use]
pub fn twins(graph: &Graph) -> Vec<NodeSet> {
    let nodes = 0..graph.node_count();
    let told: Vec<NodeSet> = nodes.clone().map(|node| graph.out_neighbors(node)).collect();
    let others = |set: NodeSet, pair: NodeSet| set.difference(pair);
    let alike = |one: usize, other: usize| {
        let pair = NodeSet::from_iter([one, other]);
        let both = graph.has_edge(one, other) == graph.has_edge(other, one);
        let heard = [one, other].map(|node| others(graph.in_neighbors(node), pair));
        let told = [one, other].map(|node| others(told[node], pair));
        both && heard[0] == heard[1] && told[0] == told[1]
    };
    nodes.clone().map(|one| nodes.clone().filter(|other| alike(one, *other)).collect()).collect()
}

fn join(orbits: &mut [NodeSet], image: &[usize]) {
    for (node, &target) in image.iter().enumerate() {
        let joined = orbits[node].union(orbits[target]);
        for member in joined.iter() {
            orbits[member] = joined;
        }
    }
}

/// An automorphism that takes one node of `pair` to the other: the image of every node.
fn automorphism(
    graph: &Graph,
    classes: &[usize],
    pair: (usize, usize),
    tries: &mut usize,
) -> Option<Vec<usize>> {
    // Twins trade places, and complete or bipartite graphs need nothing else.
    let mut image: Vec<usize> = (0..graph.node_count()).collect();
    image.swap(pair.0, pair.1);
    if keeps_edges(graph, &image) {
        return Some(image);
    }
    extend(graph, classes.to_vec(), classes.to_vec(), pair, tries)
}

/// Extends a pair of colourings, of the graph and of its image, in which `from` and `to` are now told apart from all others.
fn extend(
    graph: &Graph,
    mut here: Vec<usize>,
    mut there: Vec<usize>,
    (from, to): (usize, usize),
    tries: &mut usize,
) -> Option<Vec<usize>> {
    *tries = tries.checked_sub(1)?;
    let fresh = graph.node_count();
    (here[from], there[to]) = (fresh, fresh);
    let (here, there) = refine(graph, here, there)?;
    let twice = |node: &usize| here.iter().filter(|&&class| class == here[*node]).count() > 1;
    let nodes = 0..graph.node_count();
    let Some(next) = nodes.clone().find(twice) else {
        let image = |&class: &usize| there.iter().position(|&other| other == class);
        let image: Vec<usize> = here.iter().map(image).collect::<Option<_>>()?;
        return keeps_edges(graph, &image).then_some(image);
    };
    let alike: Vec<usize> = nodes.filter(|&other| there[other] == here[next]).collect();
    alike.into_iter().find_map(|other| extend(graph, here.clone(), there.clone(), (next, other), tries))
}

fn keeps_edges(graph: &Graph, image: &[usize]) -> bool {
    let moved =
        |node: usize| -> NodeSet { graph.in_neighbors(node).iter().map(|heard| image[heard]).collect() };
    image.iter().enumerate().all(|(node, &target)| graph.in_neighbors(target) == moved(node))
}

/// Tells nodes apart by the classes of those they hear and tell, until nothing changes, in both colourings with the same names.
/// `None` if the two come out different.
fn refine(graph: &Graph, mut here: Vec<usize>, mut there: Vec<usize>) -> Option<(Vec<usize>, Vec<usize>)> {
    let mut count = 0;
    loop {
        let (signs, others) = (signatures(graph, &here), signatures(graph, &there));
        let mut names = signs.clone();
        names.sort_unstable();
        let mut matching = others.clone();
        matching.sort_unstable();
        if names != matching {
            return None;
        }
        names.dedup();
        let name = |sign: &Signature| names.binary_search(sign).unwrap_or(0);
        here = signs.iter().map(name).collect();
        there = others.iter().map(name).collect();
        if names.len() == count {
            return Some((here, there));
        }
        count = names.len();
    }
}

/// The class of a node, then those of the nodes it hears, then those of the nodes it tells.
type Signature = (usize, Vec<usize>, Vec<usize>);

fn signatures(graph: &Graph, classes: &[usize]) -> Vec<Signature> {
    let sorted = |set: NodeSet| {
        let mut seen: Vec<usize> = set.iter().map(|node| classes[node]).collect();
        seen.sort_unstable();
        seen
    };
    let told = |node: usize| if graph.is_directed() { sorted(graph.out_neighbors(node)) } else { Vec::new() };
    let signature = |node: usize| (classes[node], sorted(graph.in_neighbors(node)), told(node));
    (0..graph.node_count()).map(signature).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::makers::fixed;

    fn sizes(graph: &Graph) -> Vec<usize> {
        orbits(graph).into_iter().map(NodeSet::len).collect()
    }

    #[test]
    fn orbits_that_keep_colors() {
        let of = |graph: &Graph, colors: &[usize], node| orbit(graph, colors, node, 400).len();
        let petersen = fixed::petersen().unwrap();
        assert_eq!(of(&petersen, &[0; 10], 3), 10);
        // With node 0 fixed its three neighbours look alike, and so do the six others.
        let mut colors = [0; 10];
        colors[0] = 1;
        assert_eq!([0, 1, 2].map(|node| of(&petersen, &colors, node)), [1, 3, 6]);
        assert_eq!(of(&fixed::path(5).unwrap(), &[0, 0, 0, 0, 1], 0), 1);
        assert_eq!(of(&petersen, &[0; 10], 0), 10);
        assert_eq!(orbit(&petersen, &[0; 10], 0, 0).len(), 1, "no tries, no automorphism");
    }

    #[test]
    fn twins_trade_places() {
        let sizes = |graph: &Graph| twins(graph).into_iter().map(NodeSet::len).collect::<Vec<_>>();
        assert_eq!(sizes(&fixed::complete(4).unwrap()), [4; 4]);
        assert_eq!(sizes(&fixed::bipartite(2, 3).unwrap()), [2, 2, 3, 3, 3]);
        assert_eq!(sizes(&fixed::star(4).unwrap()), [1, 3, 3, 3]);
        assert_eq!(sizes(&fixed::petersen().unwrap()), [1; 10]);
        // Both hear node 0, but only one of them tells it anything.
        assert_eq!(sizes(&Graph::directed(3, &[(0, 1), (0, 2), (1, 0)]).unwrap()), [1; 3]);
        assert_eq!(sizes(&Graph::directed(2, &[(0, 1)]).unwrap()), [1; 2]);
    }

    #[test]
    fn orbits_of_known_graphs() {
        assert_eq!(sizes(&fixed::petersen().unwrap()), [10; 10]);
        assert_eq!(sizes(&fixed::hypercube(5).unwrap()), [32; 32]);
        assert_eq!(sizes(&fixed::k_circulant(13, 3, true).unwrap()), [13; 13]);
        assert_eq!(sizes(&fixed::bipartite(2, 3).unwrap()), [2, 2, 3, 3, 3]);
        assert_eq!(sizes(&fixed::path(5).unwrap()), [2, 2, 1, 2, 2]);
        assert_eq!(sizes(&fixed::wheel(6).unwrap()), [1, 5, 5, 5, 5, 5]);
        assert_eq!(sizes(&Graph::directed(3, &[(0, 1), (1, 2)]).unwrap()), [1, 1, 1]);
        // Two triangles and a ring of six look alike to their neighbours, but are not.
        let mut rings = Graph::empty(12, false).unwrap();
        for (from, to) in [(0, 1), (1, 2), (0, 2), (3, 4), (4, 5), (3, 5)] {
            rings.add_edge(from, to).unwrap();
        }
        for step in 0..6 {
            rings.add_edge(6 + step, 6 + (step + 1) % 6).unwrap();
        }
        assert_eq!(sizes(&rings), [6; 12]);
        assert!(!orbits(&rings)[0].contains(6));
    }
}
