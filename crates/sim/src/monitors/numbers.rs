//! Values of several numbers: normal ones stay in the box, or in the hull, of those that normal robots started with.

use core::cmp::Ordering;

use closeranks_core::num::sqrt;

use crate::consensus::orientation::{Point, orientation};
use crate::consensus::{Combine, Consensus};
use crate::frame::Frame;

/// A safe point is rounded by less than this share of the size of the values.
const ROUNDING: f64 = 1e-9;

/// What is known of the start.
#[derive(Clone, Debug, Default)]
pub(crate) struct Numbers {
    hull: bool,
    /// Interval of each number beyond the first.
    boxes: Vec<[f64; 2]>,
    /// Corners of the hull of normal values, counterclockwise.
    corners: Vec<Point>,
}

/// A value that is where it must not be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outside {
    pub(crate) robot: usize,
    pub(crate) seen: f64,
    pub(crate) demanded: f64,
}

impl Numbers {
    /// For values of `consensus`.
    pub(crate) fn new(consensus: &Consensus) -> Self {
        Self { hull: consensus.combine == Combine::SafePoint, ..Self::default() }
    }

    /// Looks at a round: the largest spread of a number beyond the first, and calls `outside` with every value outside.
    pub(crate) fn watch<const D: usize>(
        &mut self,
        frame: &Frame<D>,
        malicious: &[bool],
        outside: &mut dyn FnMut(Outside),
    ) -> f64 {
        let normal = || (0..malicious.len()).filter(|robot| !malicious[*robot]);
        let mut spread = 0.0_f64;
        for (place, values) in frame.more_values.iter().enumerate() {
            let ends = normal().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], robot| {
                [low.min(values[robot]), high.max(values[robot])]
            });
            if self.boxes.len() <= place {
                self.boxes.push(ends);
            }
            let [low, high] = self.boxes[place];
            for robot in normal().filter(|robot| !(low..=high).contains(&values[*robot])) {
                let demanded = if values[robot] < low { low } else { high };
                outside(Outside { robot, seen: values[robot], demanded });
            }
            spread = spread.max(ends[1] - ends[0]);
        }
        if self.hull {
            self.watch_hull(frame, &mut normal(), outside);
        }
        spread
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
                outside(Outside { robot, seen, demanded });
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
