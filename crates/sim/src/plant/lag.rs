//! The first-order lag: the velocity of a robot follows the one that it is given.

use closeranks_core::num::{Vector, add_scaled, exp, subtract};

/// Bodies that lag.
#[derive(Clone, Debug)]
pub struct Lag<const D: usize> {
    time_constant_s: f64,
    tick_s: f64,
    /// `exp(−T/lag)`: what a tick leaves of the difference between the two velocities.
    stays: f64,
    /// The velocity with which each robot really moves.
    moving_m_s: Vec<Vector<D>>,
    references_m: Vec<Vector<D>>,
}

impl<const D: usize> Lag<D> {
    /// Bodies at rest at `positions_m`; `None` if the lag is so short that a tick leaves nothing of it.
    #[must_use]
    pub fn new(time_constant_s: f64, tick_s: f64, positions_m: &[Vector<D>]) -> Option<Self> {
        let stays = exp(-tick_s / time_constant_s);
        (stays > 0.0).then(|| Self {
            time_constant_s,
            tick_s,
            stays,
            moving_m_s: vec![[0.0; D]; positions_m.len()],
            references_m: positions_m.to_vec(),
        })
    }

    /// Moves everybody by a tick, exactly.
    ///
    /// ```text
    /// ẇ = (u − w)/τ, so  x += T u + τ (1 − e^(−T/τ)) (w − u),   w = u + e^(−T/τ) (w − u)
    /// ```
    pub fn integrate(&mut self, positions_m: &mut [Vector<D>], velocities_m_s: &[Vector<D>]) {
        let bodies = positions_m.iter_mut().zip(&mut self.moving_m_s).zip(&mut self.references_m);
        for (((position, moving), reference), velocity) in bodies.zip(velocities_m_s) {
            let behind = subtract(moving, velocity);
            *position = add_scaled(position, self.tick_s, velocity);
            *position = add_scaled(position, self.time_constant_s * (1.0 - self.stays), &behind);
            *moving = add_scaled(velocity, self.stays, &behind);
            *reference = add_scaled(reference, self.tick_s, velocity);
        }
    }

    /// Puts the body of robot `index` at rest at `place_m`.
    pub(super) fn place(&mut self, index: usize, place_m: &Vector<D>) {
        (self.moving_m_s[index], self.references_m[index]) = ([0.0; D], *place_m);
    }

    /// The velocity with which each robot really moves, m/s.
    #[must_use]
    pub fn moving_m_s(&self) -> &[Vector<D>] {
        &self.moving_m_s
    }

    /// Where the velocities alone would have taken each robot, m.
    #[must_use]
    pub fn references_m(&self) -> &[Vector<D>] {
        &self.references_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Bodies, Plant};

    #[test]
    fn a_lag_is_at_most_its_time_constant_times_the_speed() {
        let mut positions = [[0.0, 0.0]];
        let mut bodies = Bodies::new(Plant::Lag { lag_s: 0.1 }, 0.005, &positions);
        for _ in 0..400 {
            bodies.integrate(&mut positions, &[[1.0, 0.0]]);
        }
        assert!((bodies.references_m(&positions)[0][0] - 2.0).abs() < 1e-12);
        assert!((bodies.away_m(&positions) - 0.1).abs() < 1e-8, "{}", bodies.away_m(&positions));
        for _ in 0..400 {
            bodies.integrate(&mut positions, &[[-1.0, 0.0]]);
            assert!(bodies.away_m(&positions) <= 0.1 + 1e-12);
        }
    }

    #[test]
    fn a_lag_that_no_tick_can_show_is_none() {
        assert!(Lag::new(1e-9, 0.005, &[[0.0; 2]]).is_none());
    }
}
