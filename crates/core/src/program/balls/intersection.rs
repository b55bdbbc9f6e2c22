//! The point of several boundaries at once that is closest to a given one.

use crate::num::{Vector, add_scaled, dot, sqrt};
use crate::program::balls::flat::{Flat, PARALLEL, TOUCHING, onto_ball};
use crate::program::balls::row::Row;

/// Boundaries cross well from this square of the sine of their angle on.
const CROSSING: f64 = 1e-4;

/// The point closest to `point` among those where all of `rows` (at most D) hold with equality; `None` if there is none, or
/// if the boundaries are parallel. If several are equally close it is `None` too, but for two boundaries in the plane, where
/// it is one of the two points.
///
/// One Newton step removes most of the rounding.
pub(crate) fn closest_on<const D: usize>(rows: &[&Row<D>], point: &Vector<D>) -> Option<Vector<D>> {
    let mut closest = match rows {
        [row] => return closest_on_one(row, point),
        [one, other] if D == 2 => crossing(one, other, point)?,
        _ => closest_on_several(rows, point)?,
    };
    if !rows.iter().all(|row| row.holds(&closest)) {
        polish(rows, &mut closest);
    }
    for row in rows {
        straighten(row, &mut closest);
    }
    Some(closest)
}

/// [`closest_on`] for any number of boundaries in any dimension, without the Newton step.
///
/// Of the balls, the most curved stays; the difference of another and its multiple is a plane. The planes leave a flat of
/// `D − (count − 1)` dimensions, the ball a sphere in it.
fn closest_on_several<const D: usize>(rows: &[&Row<D>], point: &Vector<D>) -> Option<Vector<D>> {
    let mut sphere = *rows.first()?;
    for row in rows {
        if row.curvature() > sphere.curvature() {
            sphere = row;
        }
    }
    let mut flat = Flat::whole();
    for row in rows.iter().filter(|row| !core::ptr::eq(**row, sphere)) {
        let fraction = if sphere.curvature() > 0.0 { row.curvature() / sphere.curvature() } else { 0.0 };
        let normal = add_scaled(row.normal(), -fraction, sphere.normal());
        flat.cut(&normal, row.bound() - fraction * sphere.bound())?;
    }
    if sphere.curvature() > 0.0 {
        return flat.closest_on_sphere(sphere, point);
    }
    flat.cut(sphere.normal(), sphere.bound())?;
    Some(flat.closest(point))
}

/// [`closest_on`] for two boundaries in the plane, without the Newton step; it takes one root and no unit vectors.
///
/// The most curved boundary and the difference of the other and its multiple, a line `base + s t`, meet where
/// `A s² + B s + C = 0`. Of both, the point closer to `point` lies on its side of their middle.
fn crossing<const D: usize>(one: &Row<D>, other: &Row<D>, point: &Vector<D>) -> Option<Vector<D>> {
    let (ball, row) = if one.curvature() >= other.curvature() { (one, other) } else { (other, one) };
    let fraction = if ball.curvature() > 0.0 { row.curvature() / ball.curvature() } else { 0.0 };
    let normal = add_scaled(row.normal(), -fraction, ball.normal());
    let square = dot(&normal, &normal);
    let along: Vector<D> = core::array::from_fn(|d| if d == 0 { -normal[1] } else { normal[0] });
    let inverse = 1.0 / square;
    let base = normal.map(|component| component * ((row.bound() - fraction * ball.bound()) * inverse));
    let (a, b, c) = (ball.curvature() * square, dot(ball.normal(), &along), ball.value(&base) - ball.bound());
    let (own, lift) = (b * b, -4.0 * a * c);
    let parallel = a == 0.0 && own <= PARALLEL * square * dot(ball.normal(), ball.normal());
    if parallel || !(square > 0.0 && own + lift >= -TOUCHING * (own + lift.abs())) {
        return None;
    }
    let half = -0.5 * (b + sqrt((own + lift).max(0.0)).copysign(b)); // no cancellation: the roots are half/A and C/half
    let beyond = 2.0 * ball.curvature() * dot(point, &along) > -b;
    let step = match beyond == (half > 0.0) {
        true => half / a,
        false if half == 0.0 => 0.0,
        false => c / half,
    };
    Some(add_scaled(&base, step, &along))
}

/// [`closest_on`] for one boundary.
fn closest_on_one<const D: usize>(row: &Row<D>, point: &Vector<D>) -> Option<Vector<D>> {
    let mut closest = if row.curvature() > 0.0 {
        onto_ball(row.normal(), row.curvature(), row.bound(), point)?
    } else {
        step_onto(row, row.normal(), point)?
    };
    if !row.holds(&closest) {
        let gradient = row.gradient(&closest);
        closest = step_onto(row, &gradient, &closest).unwrap_or(closest);
    }
    straighten(row, &mut closest);
    Some(closest)
}

/// Where the boundary of `row` is, seen from `v` along its `gradient` there.
fn step_onto<const D: usize>(row: &Row<D>, gradient: &Vector<D>, v: &Vector<D>) -> Option<Vector<D>> {
    let square = dot(gradient, gradient);
    let step = (row.bound() - row.value(v)) / square;
    (square > 0.0).then(|| add_scaled(v, step, gradient))
}

/// Sets the coordinate along the axis of a side of the box, where it is known to the last digit.
fn straighten<const D: usize>(row: &Row<D>, v: &mut Vector<D>) {
    if let Some(axis) = row.axis() {
        v[axis] = row.bound() / row.normal()[axis];
    }
}

/// Makes one Newton step onto all boundaries at once, the shortest there is; it makes none if they touch.
fn polish<const D: usize>(rows: &[&Row<D>], v: &mut Vector<D>) {
    if let &[one, other] = rows
        && let Some(step) = step_onto_both(one, other, v)
    {
        *v = add_scaled(v, 1.0, &step);
        return;
    }
    let mut step = Flat::whole();
    for row in rows {
        let gradient = row.gradient(v);
        if step.cut(&gradient, row.bound() - row.value(v)).is_none() {
            return;
        }
    }
    *v = add_scaled(v, 1.0, &step.base);
}

/// The step of [`polish`] for two boundaries that are far from parallel, without roots.
fn step_onto_both<const D: usize>(one: &Row<D>, other: &Row<D>, v: &Vector<D>) -> Option<Vector<D>> {
    let [a, b] = [one, other].map(|row| row.gradient(v));
    let [missing_a, missing_b] = [one, other].map(|row| row.bound() - row.value(v));
    let (aa, ab, bb) = (dot(&a, &a), dot(&a, &b), dot(&b, &b));
    let square = aa * bb - ab * ab;
    let inverse = 1.0 / square;
    let along_a = (bb * missing_a - ab * missing_b) * inverse;
    let along_b = (aa * missing_b - ab * missing_a) * inverse;
    let step = add_scaled(&a.map(|component| along_a * component), along_b, &b);
    (square > CROSSING * aa * bb).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::subtract;

    fn near(a: Option<Vector<3>>, b: Vector<3>) -> bool {
        a.is_some_and(|a| (0..3).all(|d| (a[d] - b[d]).abs() < 1e-15))
    }

    #[test]
    fn one_two_and_three_boundaries_by_hand() {
        let ball = Row::new([0.0; 3], 1.0, 4.0);
        let floor = Row::new([0.0, 0.0, 1.0], 0.0, 0.0);
        let wall = Row::new([2.0, 0.0, 0.0], 0.0, 2.0);
        let p = [0.0, 3.0, 5.0];
        assert!(near(closest_on(&[&floor], &p), [0.0, 3.0, 0.0]));
        assert!(near(closest_on(&[&ball, &floor], &p), [0.0, 2.0, 0.0]));
        assert!(near(closest_on(&[&ball, &floor, &wall], &p), [1.0, libm::sqrt(3.0), 0.0]));
        let moved = Row::new([-2.0, 0.0, 0.0], 1.0, 3.0);
        assert!(near(
            closest_on(&[&ball, &moved], &p).map(|v| [v[0], v[1] * v[1] + v[2] * v[2], 0.0]),
            [0.5, 3.75, 0.0]
        ));
    }

    /// Of two boundaries in the plane both ways find the same point, as sharply as their angle allows, or none.
    #[test]
    fn both_ways_to_a_crossing_agree() {
        let number = |seed: u32| f64::from(seed.wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 23) - 1.0;
        let mut met = 0;
        for seed in (0..40_000).step_by(9) {
            let curvature = |k| number(k).max(0.0) * if seed % 4 == 0 { 0.0 } else { 1.0 };
            let row = |k| Row::new([number(k), number(k + 1)], curvature(k + 2), number(k + 3).max(0.0));
            let (one, other, point) = (row(seed), row(seed + 4), [number(seed + 8), number(seed + 9)]);
            let pair = (crossing(&one, &other, &point), closest_on_several(&[&one, &other], &point));
            match pair {
                (Some(a), Some(b)) => {
                    met += 1;
                    let [along_a, along_b] = [&one, &other].map(|row| row.gradient(&a));
                    let square = |v: &Vector<2>| dot(v, v);
                    let sine = (along_a[0] * along_b[1] - along_a[1] * along_b[0]).abs()
                        / sqrt(square(&along_a) * square(&along_b));
                    let size = 1.0 + sqrt(square(&a));
                    assert!(
                        sqrt(square(&subtract(&a, &b))) * sine.min(1.0) <= 1e-13 * size * size,
                        "{pair:?}"
                    );
                }
                (None, None) => {}
                _ => panic!("{pair:?} of {one:?} and {other:?}"),
            }
        }
        assert!(met > 1000, "{met} pairs met");
    }

    #[test]
    fn no_point_or_no_single_one() {
        let ball = Row::new([0.0; 3], 1.0, 4.0);
        let beyond = Row::new([1.0, 0.0, 0.0], 0.0, 3.0);
        assert_eq!(closest_on(&[&ball, &beyond], &[0.0, 1.0, 0.0]), None);
        assert_eq!(closest_on(&[&ball], &[0.0; 3]), None);
        assert_eq!(closest_on(&[&beyond, &beyond.clone()], &[0.0; 3]), None);
        assert_eq!(closest_on(&[&ball, &ball.clone()], &[1.0; 3]), None);
        assert_eq!(closest_on::<3>(&[], &[1.0; 3]), None);
    }
}
