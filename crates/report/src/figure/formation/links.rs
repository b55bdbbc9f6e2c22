//! Who is linked with whom.

use closeranks_core::num::{Vector, dot, subtract};
use closeranks_sim::output::record::Record;

/// Two robots within the radius of each other, by index from 0, `first < second`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Link {
    /// One.
    pub(crate) first: usize,
    /// The other.
    pub(crate) second: usize,
    /// At least one of them is malicious.
    pub(crate) malicious: bool,
}

/// Position of robot `index` at `tick`, m; missing axes are 0, missing rows not a number.
#[must_use]
pub(crate) fn position(record: &Record, tick: usize, index: usize) -> Vector<3> {
    let row = record.row(tick, index);
    core::array::from_fn(|axis| {
        record.positions_m.get(axis).map_or(0.0, |column| column.get(row).copied().unwrap_or(f64::NAN))
    })
}

/// The links of `tick`, in the order of their numbers.
#[must_use]
pub(crate) fn links(record: &Record, radius_m: f64, tick: usize) -> Vec<Link> {
    let robots = usize::from(record.robots);
    let positions: Vec<Vector<3>> = (0..robots).map(|index| position(record, tick, index)).collect();
    links_between(&positions, &record.malicious, radius_m)
}

/// All pairs with `R² − ‖x_i − x_j‖² ≥ 0`, in the order of their numbers.
///
/// Computed as [`closeranks_core::equations::link::LinkShape::link`] does, so that every robot has as many as its recorded degree.
//= paper eq:adjacency
#[must_use]
pub(crate) fn links_between(positions_m: &[Vector<3>], malicious: &[bool], radius_m: f64) -> Vec<Link> {
    let is_malicious = |index: usize| malicious.get(index).copied().unwrap_or(false);
    let mut links = Vec::new();
    for first in 0..positions_m.len() {
        for second in first + 1..positions_m.len() {
            let offset_m = subtract(&positions_m[first], &positions_m[second]);
            if radius_m * radius_m - dot(&offset_m, &offset_m) >= 0.0 {
                links.push(Link { first, second, malicious: is_malicious(first) || is_malicious(second) });
            }
        }
    }
    links
}
