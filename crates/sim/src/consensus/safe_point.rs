//! A point of the plane that is safe from any F of the points told: it lies in the hull of whichever are left when F are taken away
//! (Mendes, Herlihy, Vaidya, Garg 2015; Abbas, Shabbir, Li, Koutsoukos 2022; built from their abstracts).
//!
//! ```text
//! safe region = ∩ hull(Q) over all Q ⊆ P with |P| − F points = ∩ of all closed half-planes that hold at least |P| − F points
//! ```
//!
//! It is not empty if there are at least 3F + 1 points (Helly). If not all points lie on one line, half-planes whose edge passes two
//! points are enough: another one can be moved until its edge meets a point, and then turned about that to both sides until it meets
//! a second; what both of these hold in common lies in it. Who lies on which side is decided exactly ([`orientation`]), the
//! corners of the region are rounded.

use core::cmp::Ordering;

use super::orientation::{Point, orientation};

/// Beyond this a coordinate is as good as at it; only lies are.
const FAR: f64 = 1e12;
/// Corners are rounded by less than this share of the size of the region that they bound.
const ROUNDING: f64 = 1e-12;

/// A point in the safe region of `points`, of which any `faults` may be lies: the mean of its corners; `None` if the region is empty.
#[must_use]
pub fn safe_point(points: &[Point], faults: usize) -> Option<Point> {
    let cut = |number: f64| number.clamp(-FAR, FAR);
    let points: Vec<Point> = points.iter().map(|point| point.map(cut)).collect();
    if points.is_empty() || points.len() <= faults {
        return None;
    }
    if is_line(&points) {
        return on_line(points, faults);
    }
    let corners = region(&points, faults)?;
    let middle = mean(&corners);
    let close = |point: &&Point| distance(point, &middle) <= 1e3 * ROUNDING * scale(&points);
    // A region without an inside is often one of the points.
    let exact = points.iter().find(|point| close(point) && depth(&points, point) > faults);
    Some(exact.copied().unwrap_or(middle))
}

/// How few points a closed half-plane can hold that holds `at`.
#[must_use]
pub fn depth(points: &[Point], at: &Point) -> usize {
    let here = points.iter().filter(|point| *point == at).count();
    let others: Vec<&Point> = points.iter().filter(|point| *point != at).collect();
    let least = others.iter().map(|first| {
        let [mut left, mut right, mut ahead, mut behind] = [0; 4];
        for point in &others {
            match orientation(at, first, point) {
                Ordering::Greater => left += 1,
                Ordering::Less => right += 1,
                Ordering::Equal if is_ahead(at, first, point) => ahead += 1,
                Ordering::Equal => behind += 1,
            }
        }
        // The edge passes `first`; turned a little, it leaves those ahead on one side and those behind on the other.
        [left, right].map(|side: usize| side + ahead.min(behind)).into_iter().min().unwrap_or(0)
    });
    here + least.min().unwrap_or(0)
}

fn is_ahead(at: &Point, first: &Point, point: &Point) -> bool {
    let along =
        |d: usize| (first[d] > at[d]) == (point[d] > at[d]) && (first[d] < at[d]) == (point[d] < at[d]);
    along(0) && along(1)
}

fn is_line(points: &[Point]) -> bool {
    let first = points[0];
    let Some(second) = points.iter().find(|point| **point != first) else { return true };
    points.iter().all(|point| orientation(&first, second, point) == Ordering::Equal)
}

/// On a line the region is what is left without the F first and the F last.
fn on_line(mut points: Vec<Point>, faults: usize) -> Option<Point> {
    points.sort_by(|one, other| one[0].total_cmp(&other[0]).then(one[1].total_cmp(&other[1])));
    let (low, high) = (points.get(faults)?, points.get(points.len().checked_sub(faults + 1)?)?);
    (points.len() > 2 * faults).then(|| mean(&[*low, *high]))
}

/// The corners of the safe region.
fn region(points: &[Point], faults: usize) -> Option<Vec<Point>> {
    let bound = |d: usize, pick: fn(f64, f64) -> f64| points.iter().map(|point| point[d]).reduce(pick);
    let [low, high] = [f64::min, f64::max].map(|pick| [0, 1].map(|d| bound(d, pick).unwrap_or(0.0)));
    let mut corners = vec![low, [high[0], low[1]], high, [low[0], high[1]]];
    let slack = ROUNDING * scale(points);
    for (from, a) in points.iter().enumerate() {
        for b in points[..from].iter().chain(&points[from + 1..]).filter(|b| *b != a) {
            let right = points.iter().filter(|point| orientation(a, b, point) == Ordering::Less).count();
            if right <= faults {
                corners = clip(&corners, a, b, slack);
            }
        }
    }
    (!corners.is_empty()).then_some(corners)
}

/// What of a convex region lies to the left of the way from `a` to `b`, or no more than `slack` beside it.
fn clip(corners: &[Point], a: &Point, b: &Point, slack: f64) -> Vec<Point> {
    let (way, length) = ([b[0] - a[0], b[1] - a[1]], distance(a, b));
    let side = |p: &Point| (way[0] * (p[1] - a[1]) - way[1] * (p[0] - a[0])) / length;
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (place, corner) in corners.iter().enumerate() {
        let before = &corners[(place + corners.len() - 1) % corners.len()];
        let (was, is) = (side(before), side(corner));
        if (was >= -slack) != (is >= -slack) {
            let share = (was / (was - is)).clamp(0.0, 1.0);
            kept.push([0, 1].map(|d| before[d] + share * (corner[d] - before[d])));
        }
        if is >= -slack {
            kept.push(*corner);
        }
    }
    kept
}

fn scale(points: &[Point]) -> f64 {
    points.iter().flatten().fold(0.0, |most: f64, number| most.max(number.abs()))
}

fn distance(one: &Point, other: &Point) -> f64 {
    let [x, y] = [one[0] - other[0], one[1] - other[1]];
    closeranks_core::num::sqrt(x * x + y * y)
}

#[expect(clippy::cast_precision_loss, reason = "a handful of corners")]
fn mean(points: &[Point]) -> Point {
    let count = points.len().max(1) as f64;
    [0, 1].map(|d| points.iter().fold(0.0, |sum, point| sum + point[d] / count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Random, Stream};

    /// By how much `at` lies outside of the hull of `points`, at least: over all lines through two of them.
    fn outside(points: &[Point], at: &Point) -> f64 {
        let mut most: f64 = if is_line(points) { on_line_outside(points, at) } else { 0.0 };
        for a in points {
            for b in points.iter().filter(|b| *b != a) {
                if points.iter().all(|point| orientation(a, b, point) != Ordering::Less) {
                    let cross = (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]);
                    most = most.max(-cross / distance(a, b));
                }
            }
        }
        most
    }

    fn on_line_outside(points: &[Point], at: &Point) -> f64 {
        let far = |pick: fn(f64, f64) -> f64, d: usize| {
            points.iter().map(|point| point[d]).reduce(pick).unwrap_or(0.0)
        };
        [0, 1]
            .map(|d| (far(f64::min, d) - at[d]).max(at[d] - far(f64::max, d)))
            .into_iter()
            .fold(0.0, f64::max)
    }

    /// Calls `look` with every choice of all but `without` of `points`.
    fn subsets(points: &[Point], without: usize, look: &mut dyn FnMut(&[Point])) {
        for mask in 0_u32..1 << points.len() {
            if mask.count_ones() as usize == points.len() - without {
                let chosen = points.iter().enumerate().filter(|(place, _)| mask >> place & 1 == 1);
                look(&chosen.map(|(_, point)| *point).collect::<Vec<_>>());
            }
        }
    }

    /// Word for word: it lies in the hull of whichever are left. Drawn points, points of a small grid (many on lines, many equal), and lies far away.
    #[test]
    fn whoever_is_taken_away_it_lies_in_the_hull_of_the_rest() {
        let mut random = Random::new(1, Stream::Start);
        for case in 0..600 {
            let faults = 1 + case % 2;
            let count = 3 * faults + 1 + case % 4;
            let mut draw = || match case % 3 {
                0 => random.uniform(-5.0, 5.0),
                1 => random.uniform(-2.0, 3.0).floor(),
                _ => random.uniform(-1.0, 1.0) * if random.uniform(0.0, 1.0) < 0.2 { 1e300 } else { 1.0 },
            };
            let points: Vec<Point> = (0..count).map(|_| [draw(), draw()]).collect();
            let safe = safe_point(&points, faults).unwrap_or([f64::NAN; 2]);
            let cut: Vec<Point> = points.iter().map(|point| point.map(|x| x.clamp(-FAR, FAR))).collect();
            let slack = 1e-9 * scale(&cut);
            subsets(&cut, faults, &mut |rest| {
                assert!(outside(rest, &safe) <= slack, "{points:?} {safe:?} {rest:?}");
            });
        }
    }

    /// A liar cannot drag it out of the hull of the honest, and coordinates one by one can: three honest robots on a slope.
    #[test]
    fn the_box_is_larger_than_the_hull() {
        let honest = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
        let mut told = honest.to_vec();
        told.push([2.0, 0.0]);
        let safe = safe_point(&told, 1).unwrap_or([f64::NAN; 2]);
        assert_eq!(safe, [1.0, 1.0]);
        assert_eq!(depth(&told, &safe), 2);
    }

    #[test]
    fn too_few_points_have_none() {
        let corner = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(safe_point(&corner, 1), None);
        assert_eq!(safe_point(&[], 0), None);
        assert_eq!(safe_point(&[[1.0, 2.0]], 1), None);
        assert_eq!(safe_point(&[[1.0, 2.0]], 0), Some([1.0, 2.0]));
        assert_eq!(safe_point(&[[0.0, 0.0], [1.0, 1.0], [5.0, 5.0]], 1), Some([1.0, 1.0]));
    }
}
