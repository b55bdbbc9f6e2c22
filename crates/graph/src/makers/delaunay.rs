//! Delaunay triangulations: who are neighbours of whom where everybody hears those next to it in every direction.
//!
//! Points have whole numbers as coordinates and all questions are answered in whole numbers, so one seed is one graph, everywhere.

use alloc::vec::Vec;

use super::mesh::{Mesh, Point};
use super::{MakerError, require};
use crate::generator::Generator;
use crate::network::{NETWORK_LIMIT, Network};

/// Points are in a square of so many steps a side.
const SIDE: usize = 1 << 20;

/// The Delaunay triangulation of points that are uniform in a square, numbered from left to right.
///
/// Of four points on one circle one of the two diagonals is there.
pub fn delaunay(node_count: usize, seed: u64) -> Result<Network, MakerError> {
    require((1..=NETWORK_LIMIT).contains(&node_count), "nodes", "1 to 4194304")?;
    let edges = Mesh::of(&points(node_count, seed)).edges();
    Ok(Network::new(node_count, false, &edges))
}

/// So many different points, from left to right.
fn points(count: usize, seed: u64) -> Vec<Point> {
    let mut generator = Generator::new(seed);
    let mut coordinate = || i64::try_from(generator.below(SIDE)).unwrap_or(0);
    let mut points: Vec<Point> = Vec::with_capacity(count);
    while points.len() < count {
        let missing = count - points.len();
        points.extend((0..missing).map(|_| [coordinate(), coordinate()]));
        points.sort_unstable();
        points.dedup();
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_network_of_triangles() {
        for (n, seed) in [(1, 1), (2, 1), (3, 1), (4, 2), (500, 3), (20_000, 4)] {
            let network = delaunay(n, seed).unwrap();
            assert_eq!(network.node_count(), n);
            if n > 2 {
                assert!((2 * n - 3..=3 * n - 6).contains(&network.edge_count()) || n == 3, "n = {n}");
            }
            assert_eq!(network, delaunay(n, seed).unwrap());
        }
        assert_eq!(delaunay(500, 3).unwrap().heard(0).len(), delaunay(500, 3).unwrap().heard(0).len());
        assert!(delaunay(0, 1).is_err());
    }
}
