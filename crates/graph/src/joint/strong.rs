//! Strongly regular graphs: how many others two nodes both hear depends only on whether they hear each other.

use super::parts::{Counts, PAIRS, PARTS, Row, pair, pairs};
use crate::graph::Graph;

/// A² = d I + a A + b (J − I − A): what two nodes that hear each other, or do not, both hear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Strong {
    degree: i128,
    linked: i128,
    apart: i128,
}

impl Strong {
    /// The three numbers, or `None` if two nodes of a kind have different ones. Edges have no direction.
    pub(super) fn new(graph: &Graph) -> Option<Self> {
        let (mut linked, mut apart) = (None, None);
        let degree = graph.in_degree(0);
        for one in 0..graph.node_count() {
            for other in 0..one {
                let both = graph.in_neighbors(one).intersection(graph.in_neighbors(other)).len();
                let kind = if graph.has_edge(one, other) { &mut linked } else { &mut apart };
                if *kind.get_or_insert(both) != both {
                    return None;
                }
            }
            if graph.in_degree(one) != degree {
                return None;
            }
        }
        let [degree, linked, apart] =
            [degree, linked.unwrap_or(0), apart.unwrap_or(0)].map(|count| i128::try_from(count).unwrap_or(0));
        Some(Self { degree, linked, apart })
    }

    /// With t(v) what v hears, weighted by the vector, and k the number `below` of its part, Σ (t − k)(t − k − 1) ≥ 0.
    //= theory sec:joint-sizes
    pub(super) fn row(&self, vector: &[i32; PARTS], below: &[i32; PARTS], counts: &Counts) -> Row {
        let [vector, below] = [vector, below].map(|numbers| numbers.map(i128::from));
        let mut weights = [0; PAIRS];
        for (one, other) in pairs() {
            let squares = 2 * vector[one] * vector[other] * (self.linked - self.apart);
            let heard = (2 * below[one] + 1) * vector[other] + (2 * below[other] + 1) * vector[one];
            weights[pair(one, other)] = squares - heard;
        }
        let sum = |of: &dyn Fn(usize) -> i128| (0..PARTS).map(|part| of(part) * counts[part]).sum::<i128>();
        let all = sum(&|part| vector[part]);
        let squares = sum(&|part| vector[part] * vector[part]);
        let products = sum(&|part| below[part] * (below[part] + 1));
        let known = self.apart * all * all + (self.degree - self.apart) * squares + products;
        Row { weights, low: Some(-known), high: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::makers::{fixed, symmetric};

    #[test]
    fn strongly_regular_graphs_are_seen() {
        let of = |graph: Graph| Strong::new(&graph).map(|it| [it.degree, it.linked, it.apart]);
        assert_eq!(of(fixed::petersen().unwrap()), Some([3, 0, 1]));
        assert_eq!(of(symmetric::kneser(10, 2).unwrap()), Some([28, 15, 21]));
        assert_eq!(of(symmetric::rook_complement(7, 7).unwrap()), Some([36, 25, 30]));
        assert_eq!(of(fixed::ring(6).unwrap()), None);
        assert_eq!(of(fixed::path(3).unwrap()), None);
    }
}
