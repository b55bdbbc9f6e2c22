//! The single integrator: a robot moves with the velocity that it is given.

use closeranks_core::num::{Vector, add_scaled};

/// Bodies without a state of their own.
#[derive(Clone, Copy, Debug)]
pub struct Single {
    tick_s: f64,
}

impl Single {
    /// For steps of `tick_s`.
    #[must_use]
    pub fn new(tick_s: f64) -> Self {
        Self { tick_s }
    }

    /// Moves everybody by a tick: `x_i += T u_i` (eq:dynamics with the input held).
    //= paper eq:dynamics
    pub fn integrate<const D: usize>(&self, positions_m: &mut [Vector<D>], velocities_m_s: &[Vector<D>]) {
        for (position, velocity) in positions_m.iter_mut().zip(velocities_m_s) {
            *position = add_scaled(position, self.tick_s, velocity);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    //= paper eq:dynamics type=test
    #[test]
    fn robots_move_as_their_input_says() {
        let mut positions = [[1.0, 2.0], [0.0, 0.0]];
        Single::new(0.5).integrate(&mut positions, &[[0.5, -1.0], [0.0, 0.25]]);
        assert_eq!(positions, [[1.25, 1.5], [0.0, 0.125]]);
    }
}
