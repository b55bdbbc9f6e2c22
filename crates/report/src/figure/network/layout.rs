//! Where the nodes of a graph stand: as far apart as their paths are long, two sets aside.
//!
//! Stress majorisation (Gansner, Koren, North 2004): from circles, each node moves again and again to where its distances
//! to all others would like it. No chance and no order but that of the nodes: the same graph gives the same bits.

use closeranks_graph::graph::Graph;
use closeranks_graph::graph::set::NodeSet;

/// Rounds of moving every node once.
const ROUNDS: usize = 300;

/// So much further than their path is long are nodes of different sets apart.
const ASIDE: f64 = 1.6;

/// Positions of all nodes, in units of a link.
#[must_use]
pub(crate) fn positions(graph: &Graph, first: NodeSet, second: NodeSet) -> Vec<[f64; 2]> {
    let wanted = wanted(graph, first, second);
    let mut points = start(graph, first, second);
    for _ in 0..ROUNDS {
        for node in 0..points.len() {
            points[node] = moved(&points, &wanted[node], node);
        }
    }
    points
}

/// A circle for each set and one for the others, with a side of about a link between neighbours.
fn start(graph: &Graph, first: NodeSet, second: NodeSet) -> Vec<[f64; 2]> {
    let others = graph.nodes().difference(first.union(second));
    let mut points = vec![[0.0; 2]; graph.node_count()];
    for (set, middle) in [(first, -1.5), (others, 0.0), (second, 1.5)] {
        let turn = 2.0 * core::f64::consts::PI / real(set.len().max(1));
        let radius = if set.len() == 1 { 0.0 } else { 0.5 + 0.06 * real(set.len()) };
        for (place, node) in set.iter().enumerate() {
            let (sine, cosine) = libm::sincos(turn * (real(place) + 0.25));
            points[node] = [middle + radius * sine, radius * cosine];
        }
    }
    points
}

/// How far each node would like to be from each other one.
fn wanted(graph: &Graph, first: NodeSet, second: NodeSet) -> Vec<Vec<f64>> {
    let count = graph.node_count();
    let apart = |a: usize, b: usize| {
        (first.contains(a) && second.contains(b)) || (second.contains(a) && first.contains(b))
    };
    let row = |node: usize| {
        let steps = steps(graph, node);
        let far = steps.iter().flatten().max().map_or(1.0, |most| real(*most)) + 1.0;
        let distance = |other: usize| {
            let length = steps[other].map_or(far, real);
            if apart(node, other) { length + ASIDE } else { length }
        };
        (0..count).map(distance).collect()
    };
    (0..count).map(row).collect()
}

/// Links from `node` to every node, whatever their direction; `None` where no path leads.
fn steps(graph: &Graph, node: usize) -> Vec<Option<usize>> {
    let mut steps = vec![None; graph.node_count()];
    let mut reached: NodeSet = [node].into_iter().collect();
    let mut rim = reached;
    for step in 0.. {
        if rim.is_empty() {
            break;
        }
        let mut next = NodeSet::EMPTY;
        for member in rim.iter() {
            steps[member] = Some(step);
            next = next.union(graph.in_neighbors(member)).union(graph.out_neighbors(member));
        }
        rim = next.difference(reached);
        reached = reached.union(rim);
    }
    steps
}

/// The mean of where all others would like `node` to be, near ones counting most.
fn moved(points: &[[f64; 2]], wanted: &[f64], node: usize) -> [f64; 2] {
    let [x, y] = points[node];
    let (mut sum, mut weights) = ([0.0; 2], 0.0);
    for (other, point) in points.iter().enumerate().filter(|(other, _)| *other != node) {
        let weight = 1.0 / (wanted[other] * wanted[other]);
        let offset = [x - point[0], y - point[1]];
        let length = libm::sqrt(offset[0] * offset[0] + offset[1] * offset[1]).max(1e-6);
        for axis in [0, 1] {
            sum[axis] += weight * (point[axis] + offset[axis] * wanted[other] / length);
        }
        weights += weight;
    }
    if weights > 0.0 { sum.map(|total| total / weights) } else { [x, y] }
}

fn real(number: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "at most 128 nodes")]
    let real = number as f64;
    real
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sets_stand_apart() {
        let graph = closeranks_graph::makers::fixed::tight(10, 2).unwrap();
        let (first, second) = (NodeSet::first(5), graph.nodes().difference(NodeSet::first(5)));
        let points = positions(&graph, first, second);
        let right = first.iter().map(|node| points[node][0]).fold(f64::NEG_INFINITY, f64::max);
        let left = second.iter().map(|node| points[node][0]).fold(f64::INFINITY, f64::min);
        assert!(right + 0.5 < left, "{points:?}");
    }

    #[test]
    fn every_graph_has_finite_positions() {
        for seed in 0..40_u64 {
            let count = 1 + usize::try_from(seed).unwrap() * 127 / 39;
            let graph =
                closeranks_graph::makers::random::erdos_renyi(count, 0.05, seed.is_multiple_of(2), seed)
                    .unwrap();
            let points = positions(&graph, NodeSet::first(count / 3), NodeSet::EMPTY);
            assert!(points.iter().flatten().all(|coordinate| coordinate.abs() < 1e3), "{points:?}");
        }
    }
}
