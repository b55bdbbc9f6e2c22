//! Who is linked with whom, for whoever draws it.

use closeranks_core::num::{Vector, dot, subtract};
use closeranks_core::obstacle::{Obstacle, is_cut};

/// Two robots within the radius of each other, by index from 0, `first < second`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Link {
    /// One.
    pub first: usize,
    /// The other.
    pub second: usize,
    /// At least one of them is malicious.
    pub malicious: bool,
}

/// All pairs with `R² − ‖x_i − x_j‖² ≥ 0` whose link nothing of `map` cuts, in the order of their numbers.
///
/// Computed as [`closeranks_core::equations::link::LinkShape::link`] does, so that every robot has as many as its recorded degree.
//= paper eq:adjacency
#[must_use]
pub fn links_between(
    positions_m: &[Vector<3>],
    malicious: &[bool],
    radius_m: f64,
    map: &[Obstacle<3>],
) -> Vec<Link> {
    let is_malicious = |index: usize| malicious.get(index).copied().unwrap_or(false);
    let mut links = Vec::new();
    for first in 0..positions_m.len() {
        for second in first + 1..positions_m.len() {
            let offset_m = subtract(&positions_m[first], &positions_m[second]);
            let in_range = radius_m * radius_m - dot(&offset_m, &offset_m) >= 0.0;
            if in_range && !is_cut(map, &positions_m[first], &positions_m[second]) {
                links.push(Link { first, second, malicious: is_malicious(first) || is_malicious(second) });
            }
        }
    }
    links
}
