//! Random starts by a generator that cannot hang.

use std::collections::BTreeMap;

use closeranks_core::num::Vector;

use crate::geometry::squared_distance;
use crate::random::{Random, Stream};

/// How often a place is drawn for one robot before the box counts as full.
pub(crate) const TRIES: u32 = 10_000;

/// How often places are drawn for a whole team, per robot, so that the generator ends within seconds for any team and box.
const TRIES_MEAN: u32 = 100;

/// Robots drawn evenly from the cube `[−half, half]^D`, m, each at least `distance_min_m` from the others. If the next
/// one finds no place, the error is how many robots did.
pub(crate) fn scatter<const D: usize>(
    robots: u16,
    seed: u64,
    half: f64,
    distance_min_m: f64,
) -> Result<Vec<Vector<D>>, usize> {
    let mut random = Random::new(seed, Stream::Start);
    let mut crowd = Crowd { side_m: distance_min_m, cells: BTreeMap::new() };
    let mut placed: Vec<Vector<D>> = Vec::new();
    let mut left = TRIES + TRIES_MEAN * u32::from(robots);
    for _ in 0..robots {
        let draws = (0..TRIES.min(left)).map(|_| core::array::from_fn(|_| random.uniform(-half, half)));
        let Some((failed, place)) = draws.enumerate().find(|(_, place)| crowd.has_room(place)) else {
            return Err(placed.len());
        };
        left = left.saturating_sub(u32::try_from(failed).unwrap_or(u32::MAX).saturating_add(1));
        crowd.add(&place);
        placed.push(place);
    }
    Ok(placed)
}

/// Robots by cells of a grid, so that a draw is held against its neighbourhood only.
struct Crowd<const D: usize> {
    side_m: f64,
    cells: BTreeMap<[i64; D], Vec<Vector<D>>>,
}

impl<const D: usize> Crowd<D> {
    fn cell(&self, place: &Vector<D>) -> [i64; D] {
        #[expect(clippy::cast_possible_truncation, reason = "saturates far outside any box")]
        place.map(|component| (component / self.side_m).floor() as i64)
    }

    fn add(&mut self, place: &Vector<D>) {
        self.cells.entry(self.cell(place)).or_default().push(*place);
    }

    /// True when nobody stands closer than a side; such a robot would be in this cell or one beside it.
    #[expect(clippy::cast_possible_truncation, reason = "D is 2 or 3")]
    fn has_room(&self, place: &Vector<D>) -> bool {
        let centre = self.cell(place);
        let beside = (0..3_i64.pow(D as u32)).map(|code| {
            core::array::from_fn(|d| centre[d].saturating_add(code / 3_i64.pow(d as u32) % 3 - 1))
        });
        let near = beside.filter_map(|cell: [i64; D]| self.cells.get(&cell)).flatten();
        near.into_iter().all(|other| squared_distance(place, other) >= self.side_m * self.side_m)
    }
}
