//! What the eigenvalues of a graph say about its robustness, in whole numbers.
//!
//! The links that leave a set are many if the second eigenvalue of the Laplacian is large. So a set whose members hear few others
//! must itself be large, and two such sets may not fit into one graph (docs/theory, `sec:spectrum`). This settles symmetric
//! graphs that a search cannot, and it tells the search how large its sets are.

mod definite;
mod sizes;

use alloc::vec::Vec;

use crate::graph::Graph;
use definite::{factor, is_semidefinite};
pub use sizes::Sizes;

/// Eigenvalues are bounded to 1/`SCALE`.
pub(crate) const SCALE: i64 = 1 << 16;

/// Bounds of the eigenvalues of the Laplacian L of an undirected graph, apart from the 0 that belongs to equal numbers.
///
/// ```text
/// λ P ≤ L ≤ Λ P,   with P = I − J/n and J all ones
/// ```
//= theory sec:spectrum
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spectrum {
    /// λ times `SCALE`.
    least: i64,
    /// Λ times `SCALE`.
    most: i64,
}

impl Spectrum {
    /// The best bounds that can be proved in steps of 1/65536; `None` if edges have a direction. O(n³).
    #[must_use]
    pub fn new(graph: &Graph) -> Option<Self> {
        let count = i64::try_from(graph.node_count()).ok()?;
        if graph.is_directed() {
            return None;
        }
        let laplacian = laplacian(graph);
        // On equal numbers the added ones leave 2n − λ ≥ n, so only the rest decides.
        let above = |least: i64| is_semidefinite(&combined(&laplacian, SCALE, -least, 2 * SCALE));
        let below = |most: i64| is_semidefinite(&combined(&laplacian, -SCALE, most, 0));
        // 0 ≤ λ and Λ ≤ n hold for every graph.
        let least = bisect(0, count * SCALE, above);
        let most = count * SCALE - bisect(0, count * SCALE, |less| below(count * SCALE - less));
        Some(Self { least, most })
    }

    /// λ and Λ, each as a whole number of 1/65536.
    #[must_use]
    pub fn bounds(self) -> (i64, i64) {
        (self.least, self.most)
    }
}

/// A triangle of whole numbers for each bound of a [`Spectrum`], from which others can check it: [`Bounds::prove`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// λ and Λ, each as a whole number of 1/65536.
    pub ends: [i64; 2],
    /// For each the rows of T, from the first on, each up to the diagonal.
    pub triangles: [Vec<Vec<i64>>; 2],
}

impl Bounds {
    /// The triangles for the bounds of an undirected graph.
    #[must_use]
    pub fn new(graph: &Graph) -> Option<Self> {
        let (least, most) = Spectrum::new(graph)?.bounds();
        let laplacian = laplacian(graph);
        let rows = |matrix: Vec<Vec<i64>>| -> Option<Vec<Vec<i64>>> {
            let cut = |(row, entries): (usize, &Vec<i128>)| {
                entries[..=row].iter().map(|entry| i64::try_from(*entry).ok()).collect()
            };
            factor(&matrix)?.iter().enumerate().map(cut).collect()
        };
        let low = rows(combined(&laplacian, SCALE, -least, 2 * SCALE))?;
        let high = rows(combined(&laplacian, -SCALE, most, 0))?;
        Some(Self { ends: [least, most], triangles: [low, high] })
    }

    /// Whether the triangles prove the bounds for an undirected graph of up to 128 nodes: of 2^48 M less T Tᵀ no entry of the diagonal is less
    /// than the sum of the absolute values of its row.
    //= theory sec:spectrum
    #[must_use]
    pub fn prove(&self, graph: &Graph) -> bool {
        let [least, most] = self.ends;
        if !(0..=END_MOST).contains(&least) || !(0..=END_MOST).contains(&most) {
            return false;
        }
        let laplacian = laplacian(graph);
        let low = combined(&laplacian, SCALE, -least, 2 * SCALE);
        let high = combined(&laplacian, -SCALE, most, 0);
        outweighs(&low, &self.triangles[0]) && outweighs(&high, &self.triangles[1])
    }
}

/// No bound is larger; of 128 nodes none need be.
const END_MOST: i64 = 1 << 30;

/// No entry of a triangle is larger, so that no sum overflows.
const ENTRY_MOST: u64 = 1 << 41;

/// Whether in 2^48 M − T Tᵀ each entry of the diagonal is at least the sum of the absolute values of the others of its row.
fn outweighs(matrix: &[Vec<i64>], triangle: &[Vec<i64>]) -> bool {
    let count = matrix.len();
    let is_small = |entry: &i64| entry.unsigned_abs() <= ENTRY_MOST;
    let is_row = |row: &Vec<i64>| row.len() <= count && row.iter().all(is_small);
    if triangle.len() != count || !triangle.iter().all(is_row) {
        return false;
    }
    let entry = |row: usize, column: usize| {
        let pairs = triangle[row].iter().zip(&triangle[column]);
        let square: i128 = pairs.map(|(one, other)| i128::from(*one) * i128::from(*other)).sum();
        (i128::from(matrix[row][column]) << 48) - square
    };
    (0..count).all(|row| {
        let others = (0..count).filter(|column| *column != row);
        entry(row, row) >= others.map(|column| entry(row, column).abs()).sum()
    })
}

/// The largest whole number of `low ..= high` for which `holds` was seen to hold, if it holds up to some number; `low` is not asked.
fn bisect(mut low: i64, mut high: i64, holds: impl Fn(i64) -> bool) -> i64 {
    while low < high {
        let middle = low + (high - low + 1) / 2;
        if holds(middle) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    low
}

/// Degrees on the diagonal, −1 for each edge.
fn laplacian(graph: &Graph) -> Vec<Vec<i64>> {
    let nodes = 0..graph.node_count();
    let entry = |row: usize, column: usize| {
        let degree = i64::try_from(graph.in_degree(row)).unwrap_or(0);
        if row == column { degree } else { -i64::from(graph.has_edge(row, column)) }
    };
    nodes.clone().map(|row| nodes.clone().map(|column| entry(row, column)).collect()).collect()
}

/// `times` L + `identity` I + `ones` J.
fn combined(laplacian: &[Vec<i64>], times: i64, identity: i64, ones: i64) -> Vec<Vec<i64>> {
    let row = |(at, row): (usize, &Vec<i64>)| {
        let entry =
            |(column, entry): (usize, &i64)| times * entry + ones + if column == at { identity } else { 0 };
        row.iter().enumerate().map(entry).collect()
    };
    laplacian.iter().enumerate().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::makers::{fixed, random, symmetric};

    fn near(graph: &Graph, least: f64, most: f64) {
        let found = Spectrum::new(graph).unwrap();
        let of = |value: f64| value * 65536.0;
        #[expect(clippy::cast_precision_loss, reason = "less than 2^23")]
        let (low, high) = (found.least as f64, found.most as f64);
        assert!(low <= of(least) && low > of(least) - 3.0, "{low} {}", of(least));
        assert!(high >= of(most) && high < of(most) + 3.0, "{high} {}", of(most));
    }

    //= theory sec:spectrum type=test
    #[test]
    fn eigenvalues_that_are_known() {
        near(&fixed::petersen().unwrap(), 2.0, 5.0);
        near(&fixed::hypercube(4).unwrap(), 2.0, 8.0);
        near(&fixed::bipartite(4, 6).unwrap(), 4.0, 10.0);
        near(&fixed::ring(6).unwrap(), 1.0, 4.0);
        near(&symmetric::rook_complement(6, 6).unwrap(), 24.0, 30.0);
        near(&symmetric::kneser(9, 2).unwrap(), 20.0, 27.0);
        let root = 41_f64.sqrt() / 2.0;
        near(&symmetric::paley(41).unwrap(), 20.5 - root, 20.5 + root);
        near(&fixed::complete(7).unwrap(), 7.0, 7.0);
        near(&Graph::empty(5, false).unwrap(), 0.0, 0.0);
        near(&random::erdos_renyi(128, 1.0, false, 1).unwrap(), 128.0, 128.0);
        assert_eq!(Spectrum::new(&Graph::empty(5, true).unwrap()), None);
    }

    #[test]
    fn every_vector_lies_between_the_bounds() {
        let form = |laplacian: &[Vec<i64>], vector: &[i64]| -> i64 {
            let times = |row: &Vec<i64>| row.iter().zip(vector).map(|(a, b)| a * b).sum::<i64>();
            laplacian.iter().map(times).zip(vector).map(|(a, b)| a * b).sum()
        };
        for seed in 0..20 {
            let graph = random::erdos_renyi(9, 0.6, false, seed).unwrap();
            let found = Spectrum::new(&graph).unwrap();
            for code in 0_i64..1 << 9 {
                let vector: Vec<i64> = (0..9).map(|bit| (code >> bit & 1) * (1 + bit % 3)).collect();
                let sum: i64 = vector.iter().sum();
                let square: i64 = vector.iter().map(|value| value * value).sum();
                let form = 9 * SCALE * form(&laplacian(&graph), &vector);
                assert!(found.least * (9 * square - sum * sum) <= form, "{seed} {code}");
                assert!(found.most * (9 * square - sum * sum) >= form, "{seed} {code}");
            }
        }
    }
}
