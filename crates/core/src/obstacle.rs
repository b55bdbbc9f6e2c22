//! Still obstacles: discs, walls, and walls with a thickness, each a convex body around a segment.

use crate::num::{Vector, add_scaled, cut, dot, subtract};

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
}

impl<const D: usize> Obstacle<D> {
    /// A disc, in space a ball.
    #[must_use]
    pub fn disc(center_m: Vector<D>, radius_m: f64) -> Self {
        Self { from_m: center_m, to_m: center_m, radius_m }
    }

    /// A wall without thickness, in space a rod.
    #[must_use]
    pub fn wall(from_m: Vector<D>, to_m: Vector<D>) -> Self {
        Self { from_m, to_m, radius_m: 0.0 }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::length;

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
}
