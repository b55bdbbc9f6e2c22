//! Values of several numbers: normal ones stay in the box, or in the hull, of those that normal robots started with, and each number
//! comes closer by itself.

use core::cmp::Ordering;
use std::sync::Arc;

use closeranks_core::num::sqrt;

use crate::consensus::orientation::{Point, orientation};
use crate::consensus::{Combine, Consensus};
use crate::frame::Frame;
use crate::law::Law;
use crate::monitors::agreement::Agreement;
use crate::monitors::heard::Met;
use crate::monitors::rule::Rule;

/// A safe point is rounded by less than this share of the size of the values.
const ROUNDING: f64 = 1e-9;

/// What is known of the start.
#[derive(Clone, Debug)]
pub(crate) struct Numbers {
    rule: Arc<Rule>,
    hull: bool,
    /// Interval of each number beyond the first.
    boxes: Vec<[f64; 2]>,
    /// How each of them comes closer.
    agreements: Vec<Agreement>,
    /// Corners of the hull of normal values, counterclockwise.
    corners: Vec<Point>,
}

/// A value that is where it must not be, or values that did not come closer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outside {
    pub(crate) law: Law,
    /// From 1; 0 for all.
    pub(crate) robot: usize,
    pub(crate) seen: f64,
    pub(crate) demanded: f64,
}

impl Numbers {
    /// For values of `consensus`.
    pub(crate) fn new(consensus: &Consensus, rule: &Arc<Rule>) -> Self {
        Self {
            rule: Arc::clone(rule),
            hull: consensus.combine == Combine::SafePoint,
            boxes: Vec::new(),
            agreements: Vec::new(),
            corners: Vec::new(),
        }
    }

    /// Looks at a round that came to `met`: the spread of each number beyond the first, and calls `outside` with all that is broken.
    pub(crate) fn watch<const D: usize>(
        &mut self,
        frame: &Frame<D>,
        malicious: &[bool],
        met: Met,
        outside: &mut dyn FnMut(Outside),
    ) -> Vec<f64> {
        let normal = || (0..malicious.len()).filter(|robot| !malicious[*robot]);
        let mut spreads = Vec::new();
        for (place, values) in frame.more_values.iter().enumerate() {
            let ends = normal().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], robot| {
                [low.min(values[robot]), high.max(values[robot])]
            });
            if self.boxes.len() <= place {
                self.boxes.push(ends);
                self.agreements.push(Agreement::new(&self.rule));
            }
            let [low, high] = self.boxes[place];
            for robot in normal().filter(|robot| !(low..=high).contains(&values[*robot])) {
                let demanded = if values[robot] < low { low } else { high };
                outside(Outside { law: Law::Interval, robot: robot + 1, seen: values[robot], demanded });
            }
            let (seen, magnitude) = ((ends[1] - ends[0]).max(0.0), low.abs().max(high.abs()));
            if let Some(demanded) = self.agreements[place].end_round(seen, magnitude, met)
                && seen > demanded
            {
                outside(Outside { law: Law::Agreement, robot: 0, seen, demanded });
            }
            spreads.push(seen);
        }
        if self.hull {
            self.watch_hull(frame, &mut normal(), outside);
        }
        spreads
    }

    /// What is seen is how far outside of the hull a value lies, and what is demanded how far rounding can take it.
    fn watch_hull<const D: usize>(
        &mut self,
        frame: &Frame<D>,
        normal: &mut dyn Iterator<Item = usize>,
        outside: &mut dyn FnMut(Outside),
    ) {
        let Some(second) = frame.more_values.first() else { return };
        let robots: Vec<usize> = normal.collect();
        let points: Vec<Point> = robots.iter().map(|robot| [frame.values[*robot], second[*robot]]).collect();
        if self.corners.is_empty() {
            self.corners = hull(&points);
        }
        let scale = self.corners.iter().flatten().fold(0.0_f64, |most, number| most.max(number.abs()));
        for (robot, point) in robots.into_iter().zip(&points) {
            let (seen, demanded) = (beyond(&self.corners, point), ROUNDING * scale);
            if seen > demanded {
                outside(Outside { law: Law::Interval, robot: robot + 1, seen, demanded });
            }
        }
    }
}

/// Corners of the convex hull, counterclockwise (monotone chains).
fn hull(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|one, other| one[0].total_cmp(&other[0]).then(one[1].total_cmp(&other[1])));
    sorted.dedup();
    let chain = |points: &mut dyn Iterator<Item = &Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., before, last] = &chain[..]
                && orientation(before, last, point) != Ordering::Greater
            {
                chain.pop();
            }
            chain.push(*point);
        }
        chain.pop();
        chain
    };
    let mut corners = chain(&mut sorted.iter());
    corners.extend(chain(&mut sorted.iter().rev()));
    if corners.is_empty() { sorted } else { corners }
}

/// How far `point` lies outside of the hull with these corners; 0 inside.
fn beyond(corners: &[Point], point: &Point) -> f64 {
    let edges = || corners.iter().zip(corners.iter().cycle().skip(1));
    if corners.len() > 2 && edges().all(|(a, b)| orientation(a, b, point) != Ordering::Less) {
        return 0.0;
    }
    edges().map(|(a, b)| away(a, b, point)).fold(f64::INFINITY, f64::min)
}

/// Distance of `point` from the segment between `a` and `b`.
fn away(a: &Point, b: &Point, point: &Point) -> f64 {
    let (way, to) = ([b[0] - a[0], b[1] - a[1]], [point[0] - a[0], point[1] - a[1]]);
    let length2 = way[0] * way[0] + way[1] * way[1];
    let share =
        if length2 > 0.0 { ((way[0] * to[0] + way[1] * to[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
    let [x, y] = [0, 1].map(|d| to[d] - share * way[d]);
    sqrt(x * x + y * y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    /// Enough was heard, the first number is not looked at here, and the second stays as far apart as it was.
    #[test]
    fn a_second_number_that_does_not_come_closer_is_noticed() {
        let scenario = Scenario::default();
        let rule = Arc::new(Rule::new(&scenario, &scenario.params::<2>().unwrap()));
        let mut numbers = Numbers::new(&scenario.consensus, &rule);
        let mut frame = Frame::<2>::new(vec![[0.0; 2]; 3], vec![0.0; 3]);
        let mut broken = |second: [f64; 3], suffices: bool| {
            frame.more_values = vec![second.to_vec()];
            let (met, mut laws) = (Met { suffices, is_void: false, most_heard: 7 }, Vec::new());
            numbers.watch(&frame, &[false, false, true], met, &mut |outside| laws.push(outside.law));
            laws
        };
        assert_eq!(broken([0.0, 10.0, 99.0], true), []);
        assert_eq!(broken([4.0, 6.0, 99.0], true), []);
        assert_eq!(broken([4.0, 6.0, -99.0], true), [Law::Agreement]);
        assert_eq!(broken([3.0, 7.0, 0.0], false), [], "too little was heard in this round");
        assert_eq!(broken([2.0, 8.0, 0.0], true), [Law::Agreement]);
    }

    #[test]
    fn distances_from_a_hull() {
        let square = hull(&[[0.0, 0.0], [1.0, 1.0], [0.5, 0.5], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
        assert_eq!(square.len(), 4);
        assert_eq!(beyond(&square, &[0.5, 1.0]), 0.0);
        assert_eq!(beyond(&square, &[0.5, 3.0]), 2.0);
        assert_eq!(beyond(&square, &[4.0, 5.0]), 5.0);
        let line = hull(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]);
        assert_eq!((beyond(&line, &[1.0, 1.0]), beyond(&line, &[2.0, 3.0])), (0.0, 1.0));
        assert_eq!(beyond(&hull(&[[1.0, 1.0]]), &[4.0, 5.0]), 5.0);
    }
}
