//! Robots by the cell in which they stand: whoever is within a radius of a robot is in its cell or beside it.

use core::ops::Range;

use closeranks_core::num::Vector;

/// A grid of fewer cells than this per axis does not help.
const CELLS_MIN: f64 = 4.0;
/// Cells per axis are never more than this: memory stays in bounds however wide the team is.
const CELLS_MAX: f64 = 64.0;

/// Robots by the cell in which they stand.
#[derive(Clone, Debug, Default)]
pub(super) struct Grid {
    cells: [usize; 3],
    low_m: [f64; 3],
    side_m: [f64; 3],
    /// Where the robots of each cell begin in `robots`.
    starts: Vec<u32>,
    robots: Vec<u16>,
    cell_of: Vec<u32>,
}

impl Grid {
    /// Sorts robots into cells whose sides are at least the radius; false if that would not help.
    pub(super) fn fill<const D: usize>(&mut self, positions_m: &[Vector<D>], radius_m: f64) -> bool {
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

    /// How many cells there are.
    pub(super) fn cells(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// All robots in order of cells, those of each cell in order of numbers.
    pub(super) fn robots(&self) -> &[u16] {
        &self.robots
    }

    /// The cell of a robot.
    pub(super) fn cell_of(&self, robot: usize) -> usize {
        self.cell_of[robot] as usize
    }

    /// Where the robots of a cell are in [`robots`](Self::robots).
    pub(super) fn inside(&self, cell: usize) -> Range<usize> {
        self.starts[cell] as usize..self.starts[cell + 1] as usize
    }

    /// Where those of a cell and of the cells beside it are.
    #[inline]
    pub(super) fn beside(&self, cell: usize) -> impl Iterator<Item = Range<usize>> {
        let (mut rest, mut ranges) = (cell, [[0; 2]; 3]);
        for (range, count) in ranges.iter_mut().zip(self.cells) {
            let place = rest % count;
            *range = [place.saturating_sub(1), (place + 1).min(count - 1)];
            rest /= count;
        }
        let [x, y, z] = ranges;
        (z[0]..=z[1]).flat_map(move |k| {
            (y[0]..=y[1]).map(move |j| {
                let line = (k * self.cells[1] + j) * self.cells[0];
                self.starts[line + x[0]] as usize..self.starts[line + x[1] + 1] as usize
            })
        })
    }
}

fn whole(number: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is cut")]
    let whole = number as usize;
    whole
}
