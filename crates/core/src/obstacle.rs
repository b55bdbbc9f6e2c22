//! Still obstacles: discs, walls, and walls with a thickness, each a convex body around a segment.

use crate::num::{Vector, add_scaled, cut, dot, length, subtract};

/// A link whose straight way comes nearer to an obstacle than this, m, counts as cut: more than rounding, less than anybody can see.
const GRAZE_M: f64 = 1e-9;

/// All points within `radius_m` of the segment from `from_m` to `to_m`: a disc where the two are one point, a wall where the
/// radius is 0. In space they are balls and rods.
///
/// What is not convex is several of these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle<const D: usize> {
    /// One end, m.
    pub from_m: Vector<D>,
    /// The other end, m.
    pub to_m: Vector<D>,
    /// How far it reaches around the segment, m, at least 0.
    pub radius_m: f64,
    /// True if no message goes through it: robots whose straight way to each other meets it have no link. Positions are sensed
    /// through it all the same.
    pub cuts_links: bool,
}

impl<const D: usize> Obstacle<D> {
    /// A disc, in space a ball.
    #[must_use]
    pub fn disc(center_m: Vector<D>, radius_m: f64) -> Self {
        Self { from_m: center_m, to_m: center_m, radius_m, cuts_links: false }
    }

    /// A wall without thickness, in space a rod.
    #[must_use]
    pub fn wall(from_m: Vector<D>, to_m: Vector<D>) -> Self {
        Self { from_m, to_m, radius_m: 0.0, cuts_links: false }
    }

    /// Makes it an obstacle that cuts links.
    #[must_use]
    pub fn cutting(self) -> Self {
        Self { cuts_links: true, ..self }
    }

    /// From the nearest point of its segment to the nearest point of the straight way between `x` and `y`, m; 0 where the two meet.
    ///
    /// The nearest points are an end of one of the two and the point of the other that is nearest to it, or points inside of both. The
    /// latter is a crossing in the plane, and in space also two lines that pass each other.
    #[must_use]
    pub fn offset_between_m(&self, x: &Vector<D>, y: &Vector<D>) -> Vector<D> {
        let way = Self::wall(*x, *y);
        let back = |end: &Vector<D>| way.offset_m(end).map(|component| -component);
        let ends = [self.offset_m(x), self.offset_m(y), back(&self.from_m), back(&self.to_m)];
        ends.into_iter().chain(self.inside_m(&way)).fold([f64::INFINITY; D], shorter)
    }

    /// From the point of its line that is nearest to the line of `way` to the nearest point of that, m, if both lie inside of their
    /// segments and the lines are not parallel.
    fn inside_m(&self, way: &Self) -> Option<Vector<D>> {
        let (along, other) = (subtract(&self.to_m, &self.from_m), subtract(&way.to_m, &way.from_m));
        let from = subtract(&way.from_m, &self.from_m);
        let (a, b, c) = (dot(&along, &along), dot(&along, &other), dot(&other, &other));
        let (d, e) = (dot(&along, &from), dot(&other, &from));
        let area = a * c - b * b;
        let (share, other_share) = ((d * c - b * e) / area, (d * b - a * e) / area);
        let inside = |share: f64| (0.0..=1.0).contains(&share);
        let offset_m = add_scaled(&add_scaled(&from, other_share, &other), -share, &along);
        (area > 0.0 && inside(share) && inside(other_share)).then_some(offset_m)
    }

    /// True if it cuts the link between robots at `x` and `y`.
    //= theory sec:cut
    #[must_use]
    pub fn cuts(&self, x: &Vector<D>, y: &Vector<D>) -> bool {
        self.cuts_links && length(&self.offset_between_m(x, y)) <= self.radius_m + GRAZE_M
    }

    /// From the nearest point of the segment to `x`, m. Two places have offsets that differ by no more than the places do.
    #[must_use]
    pub fn offset_m(&self, x: &Vector<D>) -> Vector<D> {
        let (along, from) = (subtract(&self.to_m, &self.from_m), subtract(x, &self.from_m));
        let square = dot(&along, &along);
        let share = if square > 0.0 { cut(dot(&from, &along) / square, 0.0, 1.0) } else { 0.0 };
        add_scaled(&from, -share, &along)
    }
}

/// The shorter of two offsets. One that has no length is the shorter one, so that a place without numbers gives an offset without
/// numbers.
fn shorter<const D: usize>(one: Vector<D>, other: Vector<D>) -> Vector<D> {
    if length(&other) >= length(&one) { one } else { other }
}

/// True if something of `map` cuts the link between robots at `x` and `y`.
#[must_use]
pub fn is_cut<const D: usize>(map: &[Obstacle<D>], x: &Vector<D>, y: &Vector<D>) -> bool {
    map.iter().any(|obstacle| obstacle.cuts(x, y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_begin_at_the_nearest_point() {
        let wall = Obstacle::wall([0.0, 0.0], [2.0, 0.0]);
        assert_eq!(wall.offset_m(&[1.0, 0.5]), [0.0, 0.5]);
        assert_eq!(wall.offset_m(&[3.0, 0.5]), [1.0, 0.5]);
        assert_eq!(wall.offset_m(&[-1.0, -0.5]), [-1.0, -0.5]);
        assert_eq!(Obstacle::disc([1.0, 2.0, 3.0], 0.5).offset_m(&[1.0, 2.0, 5.0]), [0.0, 0.0, 2.0]);
    }

    //= theory eq:clear type=test
    #[test]
    fn offsets_of_two_places_differ_by_no_more_than_the_places() {
        let obstacles = [Obstacle::disc([0.3, -0.2], 0.4), Obstacle::wall([-1.0, 0.4], [1.2, -0.3])];
        let places = (0..400).map(|k| [0.37 * f64::from(k % 20) - 3.5, 0.41 * f64::from(k / 20) - 4.0]);
        for obstacle in obstacles {
            for x in places.clone() {
                for y in places.clone() {
                    let differ_m = length(&subtract(&obstacle.offset_m(&x), &obstacle.offset_m(&y)));
                    assert!(differ_m <= length(&subtract(&x, &y)) + 1e-12);
                }
            }
        }
    }

    /// Every case with an answer by hand: an end, the inside, a crossing, parallel ways, a point, and lines that pass in space.
    //= theory sec:cut type=test
    #[test]
    fn offsets_to_a_way_by_hand() {
        let wall = Obstacle::wall([0.0, 0.0], [4.0, 0.0]);
        assert_eq!(wall.offset_between_m(&[1.0, 2.0], &[3.0, 5.0]), [0.0, 2.0]);
        assert_eq!(wall.offset_between_m(&[-3.0, -4.0], &[-3.0, 4.0]), [-3.0, 0.0]);
        assert_eq!(wall.offset_between_m(&[7.0, 4.0], &[9.0, 4.0]), [3.0, 4.0]);
        assert_eq!(wall.offset_between_m(&[2.0, -1.0], &[2.0, 3.0]), [0.0, 0.0]);
        assert_eq!(wall.offset_between_m(&[1.0, 0.5], &[3.0, 0.5]), [0.0, 0.5]);
        assert_eq!(wall.offset_between_m(&[1.0, 0.0], &[9.0, 0.0]), [0.0, 0.0]);
        assert_eq!(wall.offset_between_m(&[5.0, 1.0], &[5.0, 1.0]), [1.0, 1.0]);
        let disc = Obstacle::disc([1.0, 1.0], 0.5);
        assert_eq!(disc.offset_between_m(&[-4.0, 3.0], &[6.0, 3.0]), [0.0, 2.0]);
        let rod = Obstacle::wall([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        assert_eq!(rod.offset_between_m(&[0.25, -3.0, 2.0], &[0.25, 5.0, 2.0]), [0.0, 0.0, 2.0]);
    }

    //= theory sec:cut type=test
    #[test]
    fn links_are_cut_where_their_way_meets_what_cuts_them() {
        let wall = Obstacle::wall([0.0, 0.0], [4.0, 0.0]);
        assert!(!wall.cuts(&[2.0, -1.0], &[2.0, 3.0]), "this one lets messages through");
        let [wall, disc] = [wall, Obstacle::disc([0.0, 3.0], 0.5)].map(Obstacle::cutting);
        assert!(wall.cuts(&[2.0, -1.0], &[2.0, 3.0]) && !wall.cuts(&[-0.001, -1.0], &[-0.001, 3.0]));
        assert!(disc.cuts(&[-2.0, 3.49], &[2.0, 3.49]) && !disc.cuts(&[-2.0, 3.51], &[2.0, 3.51]));
        let map = [wall, disc];
        assert!(is_cut(&map, &[2.0, -1.0], &[2.0, 3.0]) && !is_cut(&map, &[2.0, 1.0], &[3.0, 3.0]));
        assert!(!wall.cuts(&[f64::NAN, 0.0], &[2.0, 3.0]), "nobody is there");
    }

    /// The plane through the nearest point of the segment has the segment on one side and the way on the other.
    //= theory thm:cut type=test
    #[test]
    fn what_the_offset_points_from_and_what_it_points_to_lie_on_two_sides() {
        let number = |k: u32, by: f64| (f64::from(k) * by) % 5.0 - 2.5;
        let mut apart = 0;
        for k in 0..4_000 {
            let [x, y] = [[number(k, 0.37), number(k, 1.91)], [number(k, 2.3), number(k, 0.71)]];
            let wall = Obstacle::wall([number(k, 3.1), number(k, 0.57)], [number(k, 1.3), number(k, 2.9)]);
            let offset_m = wall.offset_between_m(&x, &y);
            let low_m =
                [wall.from_m, wall.to_m].map(|end| dot(&offset_m, &end)).into_iter().fold(-1e9, f64::max);
            let high_m = dot(&offset_m, &x).min(dot(&offset_m, &y));
            let square_m2 = dot(&offset_m, &offset_m);
            assert!((high_m - low_m - square_m2).abs() < 1e-10, "{k}: {high_m} {low_m} {square_m2}");
            apart += u32::from(square_m2 > 1e-12);
        }
        assert!((1_000..3_990).contains(&apart), "{apart}");
    }
}
