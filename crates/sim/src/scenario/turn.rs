//! Wishes that are turned along an obstacle, so that a team passes it on one side.

use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};
use closeranks_core::obstacle::Obstacle;

/// So far ahead a robot looks along its wish, m.
const AHEAD_M: f64 = 1.0;
/// In steps of this part of it.
const STEPS: u32 = 20;
/// What a straight way must leave beside the clearance, m.
const ROOM_M: f64 = 0.02;

/// The wish of a robot at `x` (m), turned along the nearest obstacle that is in its way: around it on the side on which the `middle`
/// of those in sight lies, on the right if it lies straight ahead. The length of the wish stays. It is a wish and no more: nothing that
/// is promised rests on it.
pub(crate) fn turned<const D: usize>(
    wish: &Vector<D>,
    x: &Vector<D>,
    middle: &Vector<D>,
    obstacles: &[Obstacle<D>],
    keep_m: f64,
) -> Vector<D> {
    let speed = length(wish);
    if speed == 0.0 {
        return *wish;
    }
    let ahead = wish.map(|part| part / speed);
    let in_way = obstacles.iter().filter(|one| is_in_way(one, x, &ahead, keep_m + ROOM_M));
    let nearest = in_way.min_by(|one, other| gap_m(one, x).total_cmp(&gap_m(other, x)));
    let along = nearest.and_then(|one| around(one, x, &ahead, middle));
    along.map_or(*wish, |along| along.map(|part| part * speed))
}

/// How far `x` is from an obstacle, m; negative inside.
pub(crate) fn gap_m<const D: usize>(obstacle: &Obstacle<D>, x: &Vector<D>) -> f64 {
    length(&obstacle.offset_m(x)) - obstacle.radius_m
}

/// True if the straight way ahead comes nearer than `keep_m`, and does not lead away at once.
fn is_in_way<const D: usize>(one: &Obstacle<D>, x: &Vector<D>, ahead: &Vector<D>, keep_m: f64) -> bool {
    let near = gap_m(one, x) <= AHEAD_M + keep_m && dot(&one.offset_m(x), ahead) < 0.0;
    let at = |step: u32| add_scaled(x, AHEAD_M * f64::from(step) / f64::from(STEPS), ahead);
    near && (1..=STEPS).any(|step| gap_m(one, &at(step)) < keep_m)
}

/// The way along the surface. In the plane it leads around the obstacle with the clock or against it; in space to the side of the middle.
fn around<const D: usize>(
    one: &Obstacle<D>,
    x: &Vector<D>,
    ahead: &Vector<D>,
    middle: &Vector<D>,
) -> Option<Vector<D>> {
    let offset = one.offset_m(x);
    let normal = offset.map(|part| part / length(&offset));
    let center: Vector<D> = core::array::from_fn(|d| 0.5 * (one.from_m[d] + one.to_m[d]));
    let from_center = subtract(middle, &center);
    let tangent = if D == 2 {
        let right = dot(&quarter(ahead, -1.0), &from_center) >= 0.0;
        quarter(&normal, if right { 1.0 } else { -1.0 })
    } else {
        let side = add_scaled(&from_center, -dot(&from_center, ahead), ahead);
        let flat = add_scaled(&side, -dot(&side, &normal), &normal);
        flat.map(|part| part / length(&flat))
    };
    tangent.iter().all(|part| part.is_finite()).then_some(tangent)
}

/// A vector of the plane turned by a quarter: to the left for a sign of 1, to the right for −1.
fn quarter<const D: usize>(v: &Vector<D>, sign: f64) -> Vector<D> {
    core::array::from_fn(|d| match d {
        0 => -sign * v[1],
        1 => sign * v[0],
        _ => 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wish_is_turned_around_a_disc_on_the_side_of_the_middle() {
        let disc = [Obstacle::disc([1.0, 0.0], 0.5)];
        let turn = |x: [f64; 2], middle: [f64; 2]| turned(&[2.0, 0.0], &x, &middle, &disc, 0.1);
        assert_eq!(turn([0.3, 0.0], [-1.0, 0.2]), [0.0, 2.0], "the middle lies to the left");
        assert_eq!(turn([0.3, 0.0], [-1.0, -0.2]), [0.0, -2.0]);
        assert_eq!(turn([0.3, 0.0], [-1.0, 0.0]), [0.0, -2.0], "straight ahead: to the right");
        assert_eq!(turn([0.3, 0.7], [-1.0, 0.0]), [2.0, 0.0], "it is not in the way");
        assert_eq!(turn([1.7, 0.0], [-1.0, 0.0]), [2.0, 0.0], "it lies behind");
        assert_eq!(turned(&[0.0, 0.0], &[0.3, 0.0], &[0.0, 0.0], &disc, 0.1), [0.0, 0.0]);
    }

    #[test]
    fn in_space_it_is_turned_toward_the_middle() {
        let ball = [Obstacle::disc([1.0, 0.0, 0.0], 0.5)];
        let turn = turned(&[1.0, 0.0, 0.0], &[0.3, 0.0, 0.0], &[-1.0, 0.0, 0.4], &ball, 0.1);
        assert_eq!(turn, [0.0, 0.0, 1.0]);
    }
}
