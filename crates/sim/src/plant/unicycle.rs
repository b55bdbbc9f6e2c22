//! The unicycle, steered by a point ahead of its axle: it drives along its heading and turns, and the point goes where it is told.

use closeranks_core::num::{Vector, add_scaled, dot, exp, length};

/// Bodies with a heading. What the world calls the position of a robot is its look-ahead point.
///
/// ```text
/// p' = v e,   e' = ω e⊥,   x = p + l e:    x' = v e + l ω e⊥ = u   with   v = e.u,   ω = (e⊥.u)/l
/// ```
#[derive(Clone, Debug)]
pub struct Unicycle<const D: usize> {
    tick_s: f64,
    look_ahead_m: f64,
    /// e of each robot, of length 1.
    headings: Vec<Vector<D>>,
}

impl<const D: usize> Unicycle<D> {
    /// So many bodies that look along the first axis, with the point `look_ahead_m` ahead.
    #[must_use]
    pub fn new(look_ahead_m: f64, tick_s: f64, robots: usize) -> Self {
        Self { tick_s, look_ahead_m, headings: vec![first_axis(); robots] }
    }

    /// Moves everybody by a tick, exactly: points go as those of a single integrator, and with ψ the angle from the velocity to the
    /// heading
    ///
    /// ```text
    /// ψ' = −(|u|/l) sin ψ,   so   tan(ψ/2) falls as e^(−|u| t/l)
    /// ```
    //= theory sec:unicycle
    pub fn integrate(&mut self, positions_m: &mut [Vector<D>], velocities_m_s: &[Vector<D>]) {
        let bodies = positions_m.iter_mut().zip(&mut self.headings);
        for ((position, heading), velocity) in bodies.zip(velocities_m_s) {
            *position = add_scaled(position, self.tick_s, velocity);
            *heading = turned(heading, velocity, self.tick_s / self.look_ahead_m);
        }
    }

    /// Lets robot `index` look along the first axis, as at the start.
    pub(super) fn place(&mut self, index: usize) {
        self.headings[index] = first_axis();
    }

    /// The heading of each robot, of length 1.
    #[must_use]
    pub fn headings(&self) -> &[Vector<D>] {
        &self.headings
    }

    /// Where the axles are, m, when the points are at `positions_m`.
    #[must_use]
    pub fn axles_m(&self, positions_m: &[Vector<D>]) -> Vec<Vector<D>> {
        let pairs = positions_m.iter().zip(&self.headings);
        pairs.map(|(point, heading)| add_scaled(point, -self.look_ahead_m, heading)).collect()
    }
}

fn first_axis<const D: usize>() -> Vector<D> {
    core::array::from_fn(|d| if d == 0 { 1.0 } else { 0.0 })
}

/// The heading after the point went with `velocity` for so long that it went `velocity · per_length` look-ahead lengths.
fn turned<const D: usize>(heading: &Vector<D>, velocity: &Vector<D>, per_length: f64) -> Vector<D> {
    let speed = length(velocity);
    if speed == 0.0 {
        return *heading;
    }
    let along = velocity.map(|component| component / speed);
    let cosine = dot(heading, &along).clamp(-1.0, 1.0);
    let across = add_scaled(heading, -cosine, &along);
    let sine = length(&across);
    if sine == 0.0 {
        // Straight ahead, or straight back, which a body does without turning.
        return *heading;
    }
    let half = sine / (1.0 + cosine) * exp(-speed * per_length);
    let (cosine, sine_now) = ((1.0 - half * half) / (1.0 + half * half), 2.0 * half / (1.0 + half * half));
    let next = add_scaled(&along.map(|component| cosine * component), sine_now / sine, &across);
    let norm = length(&next);
    if norm > 0.0 && norm.is_finite() { next.map(|component| component / norm) } else { along }
}

#[cfg(test)]
mod tests {
    use closeranks_core::num::subtract;

    use super::*;

    /// Against many small steps of the equation itself.
    //= theory sec:unicycle type=test
    #[test]
    fn a_tick_is_what_many_small_ones_are() {
        let (look_ahead_m, tick_s) = (0.1, 0.05);
        for velocity in [[0.7, 0.4], [-1.0, 0.001], [0.0, -1.5], [1.0, 0.0], [-1.0, 0.0]] {
            let mut positions = [[0.3, -0.2]];
            let mut bodies = Unicycle::new(look_ahead_m, tick_s, 1);
            let (mut axle, mut heading) = (bodies.axles_m(&positions)[0], [1.0, 0.0]);
            bodies.integrate(&mut positions, &[velocity]);
            let steps = 200_000;
            let step_s = tick_s / f64::from(steps);
            for _ in 0..steps {
                let normal = [-heading[1], heading[0]];
                let (drive, turn) = (dot(&heading, &velocity), dot(&normal, &velocity) / look_ahead_m);
                axle = add_scaled(&axle, step_s * drive, &heading);
                heading = add_scaled(&heading, step_s * turn, &normal);
                let norm = length(&heading);
                heading = heading.map(|component| component / norm);
            }
            assert!(length(&subtract(&axle, &bodies.axles_m(&positions)[0])) < 1e-6, "{velocity:?}");
            assert!(length(&subtract(&heading, &bodies.headings()[0])) < 1e-5, "{velocity:?}");
        }
    }

    #[test]
    fn headings_keep_their_length_and_end_along_the_velocity() {
        let mut positions = [[0.0, 0.0]];
        let mut bodies = Unicycle::new(0.05, 0.05, 1);
        for velocity in [[-1e-9, 1e-9], [-1.5, 1.5], [1e-300, 1e-300], [0.0, 0.0], [-1.5, 1.5]] {
            for _ in 0..50 {
                bodies.integrate(&mut positions, &[velocity]);
                assert!((length(&bodies.headings()[0]) - 1.0).abs() < 1e-12);
            }
        }
        let half = 0.5_f64.sqrt();
        assert!(length(&subtract(&bodies.headings()[0], &[-half, half])) < 1e-9);
    }
}
