//! Numbers between bounds whose weighted sums are between bounds too, sought in doubles.
//!
//! What is found only proposes: nothing follows from it before whole numbers say so (`proof.rs`). The method is the general simplex of
//! Dutertre and de Moura (2006): rows may be added at any time, and a row that cannot be mended names those that contradict it.

use alloc::vec;
use alloc::vec::Vec;

use super::parts::PAIRS;

/// A bound is met to within this.
const TOLERANCE: f64 = 1e-7;

/// A weight that is closer to 0 than this is none.
const PIVOT_LEAST: f64 = 1e-9;

/// Exchanges after which rows are taken in their order, so that they cannot go round for ever.
const EXCHANGES_FREE: u32 = 60;

/// Exchanges after which the question is left open.
const EXCHANGES_MOST: u32 = 200;

/// How a question came out.
#[derive(Clone, Debug)]
pub(super) enum Outcome {
    /// All bounds are met.
    Met,
    /// These rows, with multipliers, contradict each other and the bounds of the numbers themselves.
    Contradiction(Vec<(usize, f64)>),
    /// It took too long.
    Open,
}

/// The numbers come first, then the sum of each row that was added. Some of them are *bound*: they are sums of the others, the *free* ones.
#[derive(Clone, Debug)]
pub(super) struct Simplex {
    table: Vec<[f64; PAIRS]>,
    bound: Vec<usize>,
    free: [usize; PAIRS],
    values: Vec<f64>,
    lows: Vec<f64>,
    highs: Vec<f64>,
    /// Exchanges so far.
    pub(super) exchanges: u32,
}

impl Simplex {
    /// Numbers from 0 to those.
    pub(super) fn new(highs: [f64; PAIRS]) -> Self {
        let mut free = [0; PAIRS];
        for (place, number) in free.iter_mut().enumerate() {
            *number = place;
        }
        Self {
            table: Vec::new(),
            bound: Vec::new(),
            free,
            values: vec![0.0; PAIRS],
            lows: vec![0.0; PAIRS],
            highs: highs.to_vec(),
            exchanges: 0,
        }
    }

    /// Adds a row whose weighted sum lies between two bounds.
    pub(super) fn add(&mut self, weights: &[f64; PAIRS], low: f64, high: f64) {
        let mut row = [0.0; PAIRS];
        for (number, weight) in weights.iter().enumerate() {
            if let Some(place) = self.free.iter().position(|free| *free == number) {
                row[place] += weight;
            } else if let Some(place) = self.bound.iter().position(|bound| *bound == number) {
                add_times(&mut row, &self.table[place], *weight);
            }
        }
        let value = weights.iter().zip(&self.values).map(|(weight, value)| weight * value).sum();
        self.bound.push(self.values.len());
        self.table.push(row);
        self.values.push(value);
        self.lows.push(low);
        self.highs.push(high);
    }

    /// The numbers now.
    pub(super) fn point(&self) -> &[f64] {
        &self.values[..PAIRS]
    }

    /// Looks for numbers that meet all bounds.
    pub(super) fn solve(&mut self) -> Outcome {
        for step in 0..EXCHANGES_MOST {
            let in_order = step >= EXCHANGES_FREE;
            let Some((row, target)) = self.broken(in_order) else { return Outcome::Met };
            let rises = target > self.values[self.bound[row]];
            match self.entering(row, rises, in_order) {
                Some(column) => self.exchange(row, column, target),
                None => return Outcome::Contradiction(self.contradiction(row, rises)),
            }
        }
        Outcome::Open
    }

    /// A bound number that breaks a bound, and that bound: the one that breaks it most, or the first.
    fn broken(&self, in_order: bool) -> Option<(usize, f64)> {
        let gap = |number: usize| {
            let value = self.values[number];
            (self.lows[number] - value).max(value - self.highs[number])
        };
        let broken = (0..self.bound.len()).filter(|row| gap(self.bound[*row]) > TOLERANCE);
        let row = if in_order {
            broken.min_by_key(|row| self.bound[*row])
        } else {
            broken.max_by(|one, other| gap(self.bound[*one]).total_cmp(&gap(self.bound[*other])))
        }?;
        let number = self.bound[row];
        let is_low = self.values[number] < self.lows[number];
        Some((row, if is_low { self.lows[number] } else { self.highs[number] }))
    }

    /// A free number that can move the row the way that is wanted.
    fn entering(&self, row: usize, rises: bool, in_order: bool) -> Option<usize> {
        let able = (0..PAIRS).filter(|column| self.can_move(row, *column, rises));
        if in_order {
            return able.min_by_key(|column| self.free[*column]);
        }
        able.max_by(|one, other| self.table[row][*one].abs().total_cmp(&self.table[row][*other].abs()))
    }

    fn can_move(&self, row: usize, column: usize, rises: bool) -> bool {
        let (weight, number) = (self.table[row][column], self.free[column]);
        if weight.abs() < PIVOT_LEAST {
            return false;
        }
        if (weight > 0.0) == rises {
            self.values[number] < self.highs[number]
        } else {
            self.values[number] > self.lows[number]
        }
    }

    /// Makes a bound number free, with the value `target`, and a free one bound.
    fn exchange(&mut self, row: usize, column: usize, target: f64) {
        self.exchanges += 1;
        let (leaving, entering) = (self.bound[row], self.free[column]);
        let pivot = self.table[row][column];
        let step = (target - self.values[leaving]) / pivot;
        for (place, number) in self.bound.iter().enumerate().filter(|(place, _)| *place != row) {
            self.values[*number] += self.table[place][column] * step;
        }
        self.values[leaving] = target;
        self.values[entering] += step;
        let mut fresh = self.table[row].map(|weight| -weight / pivot);
        fresh[column] = 1.0 / pivot;
        for (_, other) in self.table.iter_mut().enumerate().filter(|(place, _)| *place != row) {
            let times = core::mem::replace(&mut other[column], 0.0);
            add_times(other, &fresh, times);
        }
        self.table[row] = fresh;
        (self.bound[row], self.free[column]) = (entering, leaving);
    }

    /// The row and those that hold it back.
    fn contradiction(&self, row: usize, rises: bool) -> Vec<(usize, f64)> {
        let sign = if rises { 1.0 } else { -1.0 };
        let own = (self.bound[row], -sign);
        let others = self.free.iter().zip(self.table[row]).map(|(number, weight)| (*number, sign * weight));
        let rows = others.chain([own]).filter(|(number, weight)| *number >= PAIRS && *weight != 0.0);
        rows.map(|(number, weight)| (number - PAIRS, weight)).collect()
    }
}

/// A whole number as a double, the nearest one.
#[expect(clippy::cast_precision_loss, reason = "what comes of it is a proposal")]
pub(super) fn float(value: i128) -> f64 {
    value as f64
}

fn add_times(row: &mut [f64; PAIRS], other: &[f64; PAIRS], times: f64) {
    for (sum, weight) in row.iter_mut().zip(other) {
        *sum += times * weight;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(entries: &[(usize, f64)]) -> [f64; PAIRS] {
        let mut row = [0.0; PAIRS];
        for (place, weight) in entries {
            row[*place] = *weight;
        }
        row
    }

    #[test]
    fn bounds_that_can_be_met_are_met() {
        let mut simplex = Simplex::new([10.0; PAIRS]);
        simplex.add(&row(&[(0, 1.0), (1, 1.0)]), 7.0, 8.0);
        simplex.add(&row(&[(0, 1.0), (1, -1.0)]), 2.0, f64::INFINITY);
        assert!(matches!(simplex.solve(), Outcome::Met));
        simplex.add(&row(&[(1, 1.0), (2, -3.0)]), f64::NEG_INFINITY, -20.0);
        assert!(matches!(simplex.solve(), Outcome::Met));
        let point = simplex.point();
        assert!((7.0..=8.0).contains(&(point[0] + point[1])) && point[0] - point[1] >= 2.0 - 1e-6);
        assert!(point[1] - 3.0 * point[2] <= -20.0 + 1e-6 && point.iter().all(|value| *value >= -1e-6));
    }

    #[test]
    fn a_contradiction_names_its_rows() {
        let mut simplex = Simplex::new([10.0; PAIRS]);
        simplex.add(&row(&[(3, 1.0)]), f64::NEG_INFINITY, 100.0);
        simplex.add(&row(&[(0, 1.0), (1, 1.0)]), f64::NEG_INFINITY, 3.0);
        simplex.add(&row(&[(0, 1.0), (1, 2.0)]), 7.0, f64::INFINITY);
        let Outcome::Contradiction(rows) = simplex.solve() else { panic!("3 + 3 < 7") };
        // Twice the one less the other leaves the first number, which is not negative.
        assert!(rows.iter().all(|(row, _)| *row > 0) && rows.len() == 2, "{rows:?}");
        let of = |row: usize| rows.iter().find(|(at, _)| *at == row).unwrap().1;
        assert!((of(1) / of(2) + 2.0).abs() < 1e-9, "{rows:?}");
    }
}
