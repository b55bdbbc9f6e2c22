//! How radii of gyration are distributed, counted in bins.

use std::collections::BTreeMap;

use super::rows::Rows;
use super::tally::Tally;

/// Bins of a distribution: finer than a figure shows.
const BINS: usize = 512;

/// Counts of the radii of gyration of each controller in equal bins over one range.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    range_m: [f64; 2],
    counts: BTreeMap<String, Vec<u64>>,
}

impl Spread {
    /// Empty bins over the range that `tally` has seen.
    #[must_use]
    pub fn new(tally: &Tally) -> Self {
        let ranges = tally.controllers.values().filter_map(|share| share.gyration_m);
        let range_m = ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([0.0, 1.0]);
        let counts = tally.controllers.keys().map(|name| (name.clone(), vec![0; BINS])).collect();
        Self { range_m, counts }
    }

    /// The columns that [`Spread::add`] needs.
    pub const COLUMNS: [&'static str; 2] = ["controller", "gyration_m"];

    /// Counts rows.
    pub fn add(&mut self, rows: &Rows) {
        for (name, gyration) in rows.text("controller").iter().zip(rows.number("gyration_m")) {
            let (Some(name), Some(gyration)) = (name, gyration) else { continue };
            let bin = self.bin(*gyration);
            if let Some(count) = self.counts.get_mut(name).and_then(|counts| counts.get_mut(bin)) {
                *count += 1;
            }
        }
    }

    fn bin(&self, gyration_m: f64) -> usize {
        let [min, max] = self.range_m;
        #[expect(clippy::cast_precision_loss, reason = "a few hundred bins")]
        let part = (gyration_m - min) / (max - min) * BINS as f64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates; NaN is 0")]
        let bin = part as usize;
        bin.min(BINS - 1)
    }

    /// From the least to the greatest of all, m.
    #[must_use]
    pub fn range_m(&self) -> [f64; 2] {
        self.range_m
    }

    /// Share of runs at or below each radius: corners of a line for each controller.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "sweeps are far below 2^53 runs")]
    pub fn curves(&self) -> Vec<(&str, Vec<[f64; 2]>)> {
        let [min, max] = self.range_m;
        let curve = |counts: &Vec<u64>| {
            let total = counts.iter().sum::<u64>().max(1) as f64;
            let mut sum = 0;
            let ends = counts.iter().enumerate().map(|(bin, count)| {
                sum += count;
                [min + (max - min) * (bin + 1) as f64 / BINS as f64, sum as f64 / total]
            });
            [[min, 0.0]].into_iter().chain(ends.collect::<Vec<_>>()).collect()
        };
        self.counts.iter().map(|(name, counts)| (name.as_str(), curve(counts))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::rows::{Cell, Head, Kind};
    use super::*;

    #[test]
    fn curves_rise_from_nothing_to_all() {
        let share = crate::sweep::tally::Share { gyration_m: Some([1.0, 3.0]), ..Default::default() };
        let mut tally = Tally::default();
        tally.controllers.insert("budget".to_owned(), share);
        let mut spread = Spread::new(&tally);
        let mut rows =
            Rows::empty(&[Head::new("controller", Kind::Text), Head::new("gyration_m", Kind::Number)]);
        for gyration in [1.0, 1.9, 3.0, 3.0] {
            rows.push(vec![Some(Cell::Text("budget".into())), Some(Cell::Number(gyration))]);
        }
        spread.add(&rows);
        let curves = spread.curves();
        let at = |radius: f64| curves[0].1.iter().rev().find(|point| point[0] <= radius).unwrap()[1];
        assert_eq!([at(1.0), at(1.5), at(2.5), at(3.0)], [0.0, 0.25, 0.5, 1.0]);
        assert_eq!(spread.range_m(), [1.0, 3.0]);
    }
}
