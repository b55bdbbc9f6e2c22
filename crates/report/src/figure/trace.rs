//! Lines with fewer points that look the same.

use std::collections::BTreeSet;

/// How far a point may be from the line that replaces it, in units of the page.
const TOLERANCE: f64 = 0.03;

/// Fewer points for the same picture. `points` are on the page, finite, ascending in x.
///
/// First, of all points in a column of width `column` the least and the greatest are kept, and both ends of the line:
/// every extreme survives. Then points are left out that are within 0.03 of a straight line between others.
#[must_use]
pub(crate) fn thin(points: &[[f64; 2]], column: f64) -> Vec<[f64; 2]> {
    let column_of = |point: &[f64; 2]| (point[0] / column).floor().to_bits();
    let mut kept = BTreeSet::new();
    let mut start = 0;
    for group in points.chunk_by(|a, b| column_of(a) == column_of(b)) {
        kept.insert(start + first_with(group, |new, old| new < old));
        kept.insert(start + first_with(group, |new, old| new > old));
        start += group.len();
    }
    kept.extend([0, points.len().saturating_sub(1)]);
    straighten(&kept.into_iter().filter_map(|index| points.get(index).copied()).collect::<Vec<_>>())
}

/// A line that holds each height until the next: only its corners.
pub(crate) fn steps(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for point in points {
        match corners.last() {
            Some(last) if last[1].to_bits() == point[1].to_bits() => {}
            Some(last) => corners.extend([[point[0], last[1]], *point]),
            None => corners.push(*point),
        }
    }
    corners.extend(points.last());
    corners
}

/// The first index whose y is `better` than all others.
fn first_with(group: &[[f64; 2]], better: impl Fn(f64, f64) -> bool) -> usize {
    (0..group.len()).fold(0, |best, index| if better(group[index][1], group[best][1]) { index } else { best })
}

/// Leaves out points near the line through those that stay: from each one kept, goes as far as some slope passes within
/// the tolerance of everything in between.
fn straighten(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let Some(mut anchor) = points.first().copied() else { return Vec::new() };
    let mut kept = vec![anchor];
    let mut slopes = [f64::NEG_INFINITY, f64::INFINITY];
    for (before, point) in points.iter().zip(points.iter().skip(1)) {
        if !between(slope(anchor, *point, 0.0), slopes) {
            kept.push(*before);
            anchor = *before;
            slopes = [f64::NEG_INFINITY, f64::INFINITY];
        }
        let passing = [slope(anchor, *point, -TOLERANCE), slope(anchor, *point, TOLERANCE)];
        slopes = [f64::max(slopes[0], passing[0]), f64::min(slopes[1], passing[1])];
    }
    kept.extend(points.get(1..).and_then(<[_]>::last));
    kept
}

/// Slope from `a` to `b` lifted by `lift`; infinite if one is above the other.
fn slope(a: [f64; 2], b: [f64; 2], lift: f64) -> f64 {
    (b[1] + lift - a[1]) / (b[0] - a[0])
}

fn between(slope: f64, [least, greatest]: [f64; 2]) -> bool {
    slope.is_finite() && least <= slope && slope <= greatest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_is_two_points() {
        let line: Vec<[f64; 2]> = (0..500_u32).map(|x| [f64::from(x) * 0.3, f64::from(x) * 0.1]).collect();
        assert_eq!(thin(&line, 0.5), [line[0], line[499]]);
        assert_eq!(thin(&line[..1], 0.5), [line[0]]);
        assert!(thin(&[], 0.5).is_empty());
    }

    #[test]
    fn spikes_survive_and_nothing_else_moves() {
        let at = |index: u32| {
            let x = f64::from(index) * 0.01;
            [x, if index % 700 == 3 { 100.0 } else { x * x / 40.0 }]
        };
        let line: Vec<[f64; 2]> = (0..5_000).map(at).collect();
        let thinned = thin(&line, 0.5);
        assert!(thinned.len() < 100, "{}", thinned.len());
        let spikes = |points: &[[f64; 2]]| points.iter().filter(|point| point[1] > 99.0).count();
        assert_eq!(spikes(&thinned), spikes(&line));
        assert!(thinned.iter().all(|point| line.contains(point)));
        assert!(
            line.iter().all(|point| (height(&thinned, point[0]) - point[1]).abs() < 2.0 || point[1] > 99.0)
        );
    }

    /// Height of the line at `x`, with spikes cut.
    fn height(points: &[[f64; 2]], x: f64) -> f64 {
        let smooth: Vec<[f64; 2]> = points.iter().copied().filter(|point| point[1] < 99.0).collect();
        let next = smooth.iter().position(|point| point[0] >= x).unwrap_or(smooth.len() - 1).max(1);
        let [a, b] = [smooth[next - 1], smooth[next]];
        a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])
    }
}
