//! Graphs of many symmetries.

use alloc::vec::Vec;

use super::fixed::joined;
use super::{MakerError, require};
use crate::graph::Graph;
use crate::graph::set::NODE_LIMIT;

/// `parts` parts of `size` nodes; nodes of different parts are joined.
pub fn multipartite(parts: usize, size: usize) -> Result<Graph, MakerError> {
    require(size > 0, "size", "1 or more")?;
    joined(parts.saturating_mul(size), |one, other| one / size != other / size)
}

/// Fields of a board of rows and columns; neither those of one row nor those of one column are joined, but all others.
pub fn rook_complement(rows: usize, columns: usize) -> Result<Graph, MakerError> {
    require(columns > 0, "columns", "1 or more")?;
    joined(rows.saturating_mul(columns), |one, other| {
        one / columns != other / columns && one % columns != other % columns
    })
}

/// All sets of `chosen` out of `points` points; disjoint ones are joined. The Petersen graph is that of 5 and 2.
pub fn kneser(points: usize, chosen: usize) -> Result<Graph, MakerError> {
    require(points <= 20, "points", "20 or less")?;
    let sets = (0_u32..1 << points).filter(|set| set.count_ones() as usize == chosen);
    let sets: Vec<u32> = sets.take(NODE_LIMIT + 1).collect();
    joined(sets.len(), |one, other| sets[one] & sets[other] == 0)
}

/// Numbers below a prime q of the form 4k + 1, joined if they differ by a square: degree (q − 1)/2.
pub fn paley(prime: usize) -> Result<Graph, MakerError> {
    let is_prime = prime >= 2 && (2..prime.min(NODE_LIMIT)).all(|divisor| !prime.is_multiple_of(divisor));
    require(is_prime && prime % 4 == 1 && prime <= NODE_LIMIT, "prime", "a prime 4k + 1 up to 113")?;
    let squares: Vec<usize> = (1..prime).map(|number| number * number % prime).collect();
    joined(prime, |one, other| squares.contains(&(other - one)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::makers::fixed;

    #[test]
    fn degrees_and_sizes() {
        let of = |graph: Graph| (graph.node_count(), graph.degree_min(), graph.degree_max());
        assert_eq!(of(multipartite(5, 6).unwrap()), (30, 24, 24));
        assert_eq!(of(rook_complement(4, 5).unwrap()), (20, 12, 12));
        assert_eq!(of(kneser(7, 2).unwrap()), (21, 10, 10));
        assert_eq!(of(kneser(5, 2).unwrap()), of(fixed::petersen().unwrap()));
        assert_eq!(of(paley(13).unwrap()), (13, 6, 6));
        assert!(paley(11).is_err() && paley(9).is_err() && paley(1 << 40).is_err());
        assert!(kneser(21, 2).is_err() && kneser(20, 10).is_err() && multipartite(usize::MAX, 2).is_err());
    }
}
