//! The double integrator with limited acceleration: it follows its velocities by a lag that its limit allows.

use closeranks_core::num::Vector;

use crate::plant::lag::Lag;

/// The lag of bodies that accelerate by at most `acceleration_max_m_s2` and are asked for at most `speed_max_m_s`.
///
/// ```text
/// w' = (u − w)/τ with |u|, |w| <= U:   |w'| <= 2U/τ = a   for   τ = 2U/a
/// ```
//= theory sec:double
#[must_use]
pub fn lag_s(acceleration_max_m_s2: f64, speed_max_m_s: f64) -> f64 {
    2.0 * speed_max_m_s / acceleration_max_m_s2
}

/// How far such bodies are at most from where their velocities would have taken them, m: `τ U = 2U²/a`.
//= theory sec:double
#[must_use]
pub fn tracking_error_m(acceleration_max_m_s2: f64, speed_max_m_s: f64) -> f64 {
    lag_s(acceleration_max_m_s2, speed_max_m_s) * speed_max_m_s
}

/// Bodies at rest at `positions_m`; `None` if a tick leaves nothing of so short a lag.
#[must_use]
pub fn bodies<const D: usize>(lag_s: f64, tick_s: f64, positions_m: &[Vector<D>]) -> Option<Lag<D>> {
    Lag::new(lag_s, tick_s, positions_m)
}

#[cfg(test)]
mod tests {
    use closeranks_core::num::{length, subtract};

    use super::*;
    use crate::random::{Random, Stream};

    /// Velocities that jump as they like, from corner to corner too: neither bound is ever passed, and both are met.
    //= theory sec:double type=test
    #[test]
    fn acceleration_and_error_stay_within_their_bounds_and_meet_them() {
        let (most_m_s2, speed_m_s, tick_s) = (3.0, 0.4, 0.02);
        let mut random = Random::new(1, Stream::Plant);
        let mut positions = [[0.0, 0.0]];
        let Some(mut bodies) = bodies(lag_s(most_m_s2, speed_m_s), tick_s, &positions) else {
            unreachable!("the lag is longer than a tick")
        };
        let (mut fastest, mut farthest) = (0.0_f64, 0.0_f64);
        for tick in 0..20_000_u32 {
            let side = if (tick / 400).is_multiple_of(2) { speed_m_s } else { -speed_m_s };
            let asked = match tick % 7_000 {
                0..4_000 => [side, 0.0],
                _ => [random.uniform(-0.28, 0.28), random.uniform(-0.28, 0.28)],
            };
            let before = bodies.moving_m_s()[0];
            // The acceleration is greatest at the beginning of a tick.
            fastest = fastest.max(length(&subtract(&asked, &before)) / lag_s(most_m_s2, speed_m_s));
            bodies.integrate(&mut positions, &[asked]);
            farthest = farthest.max(length(&subtract(&positions[0], &bodies.references_m()[0])));
        }
        let bound_m = tracking_error_m(most_m_s2, speed_m_s);
        assert!(fastest <= most_m_s2 * (1.0 + 1e-9) && fastest > 0.99 * most_m_s2, "{fastest}");
        assert!(farthest <= bound_m * (1.0 + 1e-9) && farthest > 0.99 * bound_m, "{farthest} {bound_m}");
    }
}
