//! An intersection of planes, and the point of a ball's boundary in it that is closest to a given one.

use crate::num::{Vector, add_scaled, dot, sqrt, subtract};
use crate::program::balls::row::Row;

/// Planes count as parallel below this square of the sine of their angle.
pub(super) const PARALLEL: f64 = 1e-24;
/// Boundaries count as touching while the square of the radius they leave is negative by no more than this fraction.
pub(super) const TOUCHING: f64 = 1e-12;
/// An intersection of planes: `base` plus everything perpendicular to the first `count` of `axes`.
pub(super) struct Flat<const D: usize> {
    axes: [Vector<D>; D],
    count: usize,
    /// The point closest to 0.
    pub(super) base: Vector<D>,
}

impl<const D: usize> Flat<D> {
    pub(super) fn whole() -> Self {
        Self { axes: [[0.0; D]; D], count: 0, base: [0.0; D] }
    }

    /// Intersects with `normal·v = bound`.
    pub(super) fn cut(&mut self, normal: &Vector<D>, bound: f64) -> Option<()> {
        let rest = self.within(normal);
        let square = dot(&rest, &rest);
        if square.is_nan() || square <= PARALLEL * dot(normal, normal) {
            return None;
        }
        let length = sqrt(square);
        let axis = rest.map(|component| component / length);
        let missing = (bound - dot(normal, &self.base)) / dot(normal, &axis);
        self.base = add_scaled(&self.base, missing, &axis);
        *self.axes.get_mut(self.count)? = axis;
        self.count += 1;
        Some(())
    }

    /// The part of `a` along the flat; subtracted twice, so that what remains is perpendicular to its last digit.
    fn within(&self, a: &Vector<D>) -> Vector<D> {
        let mut rest = *a;
        for _ in 0..2 {
            for axis in &self.axes[..self.count] {
                rest = add_scaled(&rest, -dot(&rest, axis), axis);
            }
        }
        rest
    }

    pub(super) fn closest(&self, point: &Vector<D>) -> Vector<D> {
        let along = self.within(&subtract(point, &self.base));
        add_scaled(&self.base, 1.0, &along)
    }

    /// The point of the flat on the boundary of the ball `row` that is closest to `point`.
    pub(super) fn closest_on_sphere(&self, row: &Row<D>, point: &Vector<D>) -> Option<Vector<D>> {
        let bound = row.bound() - row.value(&self.base);
        let w = onto_ball(&self.within(row.normal()), row.curvature(), bound, &self.within(point))?;
        Some(add_scaled(&self.base, 1.0, &self.within(&w)))
    }
}

/// The point of the boundary of the ball `normal·v + curvature |v|² ≤ bound` that is closest to `point` p.
///
/// ```text
/// w = p − t G,   G = n + 2 c p,   t = 2 q(p) / (|G| (|G| + ρ)),   ρ² = |n|² + 4 c b,   q(p) = n·p + c|p|² − b
/// ```
///
/// No centre, so no loss for nearly flat balls.
#[inline]
pub(super) fn onto_ball<const D: usize>(
    normal: &Vector<D>,
    curvature: f64,
    bound: f64,
    point: &Vector<D>,
) -> Option<Vector<D>> {
    let (square, lift) = (dot(normal, normal), 4.0 * curvature * bound);
    if square + lift < -TOUCHING * (square + lift.abs()) {
        return None;
    }
    let (radius, steep) = (sqrt((square + lift).max(0.0)), add_scaled(normal, 2.0 * curvature, point));
    let length = sqrt(dot(&steep, &steep));
    if length.is_nan() || length <= 0.0 {
        return None;
    }
    let excess = dot(normal, point) + curvature * dot(point, point) - bound;
    Some(add_scaled(point, -2.0 * excess / (length * (length + radius)), &steep))
}
