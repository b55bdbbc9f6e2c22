//! How many robots are near each one, and who they are: for whoever still knows who they were in the tick before.
//!
//! To count takes a few instructions a candidate, no branch and no list. If all who were near a robot still are, and it has as many near it as
//! before, they are the same ones.

use closeranks_core::num::Vector;

use crate::geometry::grid::Grid;
use crate::geometry::squared_distance;

/// Teams up to this size are looked at without cells.
const FEW: usize = 128;
/// So many robots are looked at side by side.
const LANES: usize = 4;

/// A team, counted cell by cell.
#[derive(Clone, Debug, Default)]
pub(crate) struct Crowd {
    grid: Grid,
    /// Whether the grid is in use in this tick.
    sparse: bool,
    /// Where those are who may be near the robots that are being counted for, m, number after number.
    candidates_m: Vec<f64>,
    counts: Vec<u16>,
    radius_m2: f64,
}

impl Crowd {
    /// Splits robots at `positions_m` into cells, to look for who is within the radius; false if that would not help.
    pub(crate) fn split<const D: usize>(&mut self, positions_m: &[Vector<D>], radius_m: f64) -> bool {
        self.radius_m2 = radius_m * radius_m;
        self.sparse = positions_m.len() > FEW && self.grid.fill(positions_m, radius_m);
        self.sparse
    }

    /// True if robots are split into cells.
    pub(crate) fn is_sparse(&self) -> bool {
        self.sparse
    }

    /// Counts for each of the same robots the others within the radius.
    pub(crate) fn count<const D: usize>(&mut self, positions_m: &[Vector<D>]) {
        self.counts.clear();
        self.counts.resize(positions_m.len(), 0);
        let Self { grid, candidates_m, counts, radius_m2, .. } = self;
        if !self.sparse {
            fill(candidates_m, positions_m.iter());
            for (count, own_m) in counts.iter_mut().zip(positions_m) {
                *count = others_within(*radius_m2, own_m, candidates_m);
            }
            return;
        }
        let position_m = |robot: &u16| &positions_m[usize::from(*robot)];
        for cell in (0..grid.cells()).filter(|cell| !grid.inside(*cell).is_empty()) {
            fill(
                candidates_m,
                grid.beside(cell).flat_map(|places| grid.robots()[places].iter().map(position_m)),
            );
            for robot in &grid.robots()[grid.inside(cell)] {
                counts[usize::from(*robot)] = others_within(*radius_m2, position_m(robot), candidates_m);
            }
        }
    }

    /// How many others are within the radius of each robot.
    pub(crate) fn counts(&self) -> &[u16] {
        &self.counts
    }

    /// Those within the radius of one robot, in order of numbers.
    pub(crate) fn around<const D: usize>(
        &self,
        robot: usize,
        positions_m: &[Vector<D>],
        others: &mut Vec<u16>,
    ) {
        others.clear();
        let own = &positions_m[robot];
        let near = |other: usize| is_within(self.radius_m2, own, &positions_m[other]) && other != robot;
        if self.sparse {
            for block in self.grid.beside(self.grid.cell_of(robot)) {
                let robots = self.grid.robots()[block].iter().copied();
                others.extend(robots.filter(|other| near(usize::from(*other))));
            }
            others.sort_unstable();
        } else {
            others.extend(
                (0..=u16::MAX)
                    .zip(positions_m)
                    .map(|(other, _)| other)
                    .filter(|other| near(usize::from(*other))),
            );
        }
    }
}

/// Collects positions. Where there are too few for the last lanes, somebody who is near nobody stands in.
fn fill<'a, const D: usize>(candidates_m: &mut Vec<f64>, positions_m: impl Iterator<Item = &'a Vector<D>>) {
    candidates_m.clear();
    positions_m.for_each(|position_m| candidates_m.extend_from_slice(position_m));
    let lanes = (candidates_m.len() / D).next_multiple_of(LANES);
    candidates_m.resize(lanes * D, f64::INFINITY);
}

/// How many within the radius of a robot that is among them are others.
#[inline]
fn others_within<const D: usize>(radius_m2: f64, own_m: &Vector<D>, candidates_m: &[f64]) -> u16 {
    let mut count = 0_u64;
    for candidate_m in candidates_m.as_chunks::<D>().0 {
        count += u64::from(is_within(radius_m2, own_m, candidate_m));
    }
    u16::try_from(count.saturating_sub(1)).unwrap_or(u16::MAX)
}

#[inline]
fn is_within<const D: usize>(radius_m2: f64, own: &Vector<D>, other: &Vector<D>) -> bool {
    radius_m2 - squared_distance(other, own) >= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Random, Stream};

    fn check<const D: usize>(seed: u64, robots: usize, half_side_m: f64) -> bool {
        let mut random = Random::new(seed, Stream::Start);
        let mut place = || core::array::from_fn(|_| random.uniform(-half_side_m, half_side_m));
        let positions_m: Vec<Vector<D>> = (0..robots).map(|_| place()).collect();
        let (mut crowd, mut around) = (Crowd::default(), Vec::new());
        crowd.split(&positions_m, 1.0);
        crowd.count(&positions_m);
        for (robot, own) in positions_m.iter().enumerate() {
            let near = |other: &usize| squared_distance(own, &positions_m[*other]) <= 1.0;
            let expected: Vec<_> = (0..robots).filter(|other| *other != robot && near(other)).collect();
            crowd.around(robot, &positions_m, &mut around);
            assert!(around.iter().map(|other| usize::from(*other)).eq(expected.iter().copied()));
            assert_eq!(usize::from(crowd.counts()[robot]), expected.len(), "robot {robot}, seed {seed}");
        }
        crowd.sparse
    }

    #[test]
    fn cells_count_whom_looking_at_everybody_counts() {
        let mut sparse = 0;
        for seed in 0..4 {
            for half_side_m in [0.5, 1.9, 3.0, 20.0, 300.0] {
                sparse += usize::from(check::<2>(seed, 200, half_side_m));
                sparse += usize::from(check::<3>(seed, 200, half_side_m));
                assert!(!check::<2>(seed, 40, half_side_m));
            }
        }
        assert!(sparse >= 24, "{sparse}");
    }
}
