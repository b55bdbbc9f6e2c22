//! Pairs of robots within a radius, found once for both ends.

use closeranks_core::num::Vector;

use crate::geometry::squared_distance;

/// Teams up to this size are looked at pair by pair.
const FEW: usize = 128;
/// So many candidates are sorted after most of them are left out, more of them before.
const SOME: usize = 96;
/// A grid of fewer cells than this per axis does not help.
const CELLS_MIN: f64 = 4.0;
/// Cells per axis are never more than this: memory stays in bounds however wide the team is.
const CELLS_MAX: f64 = 64.0;

/// Finds, robot by robot, those of lower numbers that are near.
#[derive(Clone, Debug, Default)]
pub(crate) struct Near {
    grid: Grid,
    /// Whether the grid is in use in this tick.
    sparse: bool,
    /// With a grid, robots of lower numbers that may be near.
    candidates: Vec<u16>,
    found: Found,
}

/// Robots that are near, and their squared distances, m².
#[derive(Clone, Debug, Default)]
struct Found {
    firsts: Vec<u16>,
    distances_m2: Vec<f64>,
}

/// Robots by the cell in which they stand.
#[derive(Clone, Debug, Default)]
struct Grid {
    cells: [usize; 3],
    low_m: [f64; 3],
    side_m: [f64; 3],
    /// Where the robots of each cell begin in `robots`.
    starts: Vec<u32>,
    robots: Vec<u16>,
    cell_of: Vec<u32>,
}

impl Near {
    /// Gets ready for robots at `positions_m`; true if a grid of cells is in use.
    pub(crate) fn look<const D: usize>(&mut self, positions_m: &[Vector<D>], radius_m: f64) -> bool {
        self.sparse = positions_m.len() > FEW && self.grid.fill(positions_m, radius_m);
        self.sparse
    }

    /// Robots before `second` within the radius, in order, and their squared distances, m².
    #[inline]
    pub(crate) fn before<const D: usize>(
        &mut self,
        second: usize,
        positions_m: &[Vector<D>],
        radius_m: f64,
    ) -> (&[u16], &[f64]) {
        let own = &positions_m[second];
        if self.sparse {
            self.grid.around(second, &mut self.candidates);
            let Self { candidates, found, .. } = self;
            let some = candidates.len() <= SOME;
            if !some {
                candidates.sort_unstable();
            }
            let near = candidates.iter().map(|first| (*first, &positions_m[usize::from(*first)]));
            let kept = found.take(candidates.len(), near, own, radius_m);
            if some {
                found.sort(kept);
            }
            found.first(kept)
        } else {
            let kept = self.found.take(second, (0..).zip(&positions_m[..second]), own, radius_m);
            self.found.first(kept)
        }
    }
}

impl Found {
    /// Keeps of at most `count` robots those within the radius of `own`, and says how many they are.
    #[inline]
    fn take<'a, const D: usize>(
        &mut self,
        count: usize,
        robots: impl Iterator<Item = (u16, &'a Vector<D>)>,
        own: &Vector<D>,
        radius_m: f64,
    ) -> usize {
        if self.firsts.len() < count {
            self.firsts.resize(count, 0);
            self.distances_m2.resize(count, 0.0);
        }
        let (firsts, distances_m2) = (&mut self.firsts[..count], &mut self.distances_m2[..count]);
        let (mut kept, radius_m2) = (0, radius_m * radius_m);
        for (first, position_m) in robots {
            let distance_m2 = squared_distance(position_m, own);
            (firsts[kept], distances_m2[kept]) = (first, distance_m2);
            // Where a robot is out of range, the next one takes its place.
            kept += usize::from(radius_m2 - distance_m2 >= 0.0);
        }
        kept
    }

    /// Puts the first few that were kept in order: most of the candidates are gone by then.
    fn sort(&mut self, kept: usize) {
        let (firsts, distances_m2) = (&mut self.firsts[..kept], &mut self.distances_m2[..kept]);
        for next in 1..kept {
            let mut place = next;
            while place > 0 && firsts[place - 1] > firsts[place] {
                firsts.swap(place - 1, place);
                distances_m2.swap(place - 1, place);
                place -= 1;
            }
        }
    }

    /// The first so many.
    fn first(&self, kept: usize) -> (&[u16], &[f64]) {
        (&self.firsts[..kept], &self.distances_m2[..kept])
    }
}

impl Grid {
    /// Sorts robots into cells whose sides are at least the radius; false if that would not help.
    fn fill<const D: usize>(&mut self, positions_m: &[Vector<D>], radius_m: f64) -> bool {
        (self.cells, self.low_m, self.side_m) = ([1; 3], [0.0; 3], [1.0; 3]);
        let mut helps = false;
        for d in 0..D.min(3) {
            let along = || positions_m.iter().map(|position| position[d]);
            let (low, high) =
                (along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max));
            // A hair more than the radius, so that rounding puts no near robot two cells away.
            let count = ((high - low) / (radius_m * (1.0 + 1e-9))).floor().min(CELLS_MAX);
            helps |= count >= CELLS_MIN;
            if count >= 2.0 {
                (self.cells[d], self.low_m[d], self.side_m[d]) = (whole(count), low, (high - low) / count);
            }
        }
        if helps {
            self.sort(positions_m);
        }
        helps
    }

    fn sort<const D: usize>(&mut self, positions_m: &[Vector<D>]) {
        let cells: usize = self.cells.iter().product();
        self.starts.clear();
        self.starts.resize(cells + 1, 0);
        self.cell_of.clear();
        for position in positions_m {
            let mut cell = 0;
            for d in (0..D.min(3)).rev() {
                cell = cell * self.cells[d] + self.place(position[d], d);
            }
            self.starts[cell + 1] += 1;
            self.cell_of.push(u32::try_from(cell).unwrap_or(u32::MAX));
        }
        for cell in 0..cells {
            self.starts[cell + 1] += self.starts[cell];
        }
        self.robots.resize(positions_m.len(), 0);
        for robot in (0..positions_m.len()).rev() {
            let end = &mut self.starts[self.cell_of[robot] as usize + 1];
            *end -= 1;
            self.robots[*end as usize] = u16::try_from(robot).unwrap_or(u16::MAX);
        }
        // Each entry is now where its cell begins, one place too far to the right.
        self.starts.rotate_left(1);
        self.starts[cells] = u32::try_from(positions_m.len()).unwrap_or(u32::MAX);
    }

    fn place(&self, along: f64, d: usize) -> usize {
        whole((along - self.low_m[d]) / self.side_m[d]).min(self.cells[d] - 1)
    }

    /// Robots of lower numbers than `robot` in its cell and those beside it, in order of cells.
    fn around(&self, robot: usize, candidates: &mut Vec<u16>) {
        candidates.clear();
        let mut cell = self.cell_of[robot] as usize;
        let mut ranges = [[0; 2]; 3];
        for (range, count) in ranges.iter_mut().zip(self.cells) {
            let place = cell % count;
            *range = [place.saturating_sub(1), (place + 1).min(count - 1)];
            cell /= count;
        }
        let [x, y, z] = ranges;
        for k in z[0]..=z[1] {
            for j in y[0]..=y[1] {
                let line = (k * self.cells[1] + j) * self.cells[0];
                let (from, to) = (self.starts[line + x[0]], self.starts[line + x[1] + 1]);
                let robots = self.robots[from as usize..to as usize].iter();
                candidates.extend(robots.filter(|other| usize::from(**other) < robot));
            }
        }
    }
}

pub(crate) fn small(index: usize) -> u16 {
    u16::try_from(index).unwrap_or(u16::MAX)
}

fn whole(number: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is cut")]
    let whole = number as usize;
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Random, Stream};

    fn check<const D: usize>(seed: u64, robots: usize, half_side_m: f64) -> bool {
        let mut random = Random::new(seed, Stream::Start);
        let mut place = || core::array::from_fn(|_| random.uniform(-half_side_m, half_side_m));
        let positions_m: Vec<Vector<D>> = (0..robots).map(|_| place()).collect();
        let mut near = Near::default();
        near.look(&positions_m, 1.0);
        for second in 0..robots {
            let (firsts, distances_m2) = near.before(second, &positions_m, 1.0);
            let firsts = firsts.iter().map(|first| usize::from(*first));
            let found: Vec<_> = firsts.zip(distances_m2.iter().copied()).collect();
            let all = positions_m[..second].iter().map(|other| squared_distance(other, &positions_m[second]));
            let within: Vec<_> = all.enumerate().filter(|(_, distance_m2)| *distance_m2 <= 1.0).collect();
            assert_eq!(found, within, "robot {second} of {robots}, seed {seed}");
        }
        near.sparse
    }

    #[test]
    fn cells_find_what_looking_at_every_pair_finds() {
        let mut sparse = 0;
        for seed in 0..6 {
            for half_side_m in [0.5, 1.9, 3.0, 20.0, 300.0] {
                sparse += usize::from(check::<2>(seed, 200, half_side_m));
                sparse += usize::from(check::<3>(seed, 200, half_side_m));
                assert!(!check::<2>(seed, 40, half_side_m));
            }
        }
        assert!(sparse >= 36, "{sparse}");
    }
}
