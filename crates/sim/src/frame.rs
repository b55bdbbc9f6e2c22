//! One tick of all robots, as it is watched, recorded and integrated.

use closeranks_core::num::Vector;
use closeranks_core::program::Outcome;
use closeranks_core::robot::report::{Mode, Reason};

/// State of every robot in one tick; index 0 is robot 1.
///
/// A robot that is down in this tick (crashed, or missing it) has stopped, has no φ_i and is free; its degree, levels, h, value
/// and what it heard are those of the last tick in which it ran.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a fact of its own about the tick")]
pub struct Frame<const D: usize> {
    /// x_i, m.
    pub positions_m: Vec<Vector<D>>,
    /// u_{i,des}, m/s.
    pub desired_m_s: Vec<Vector<D>>,
    /// u_i, m/s, held from this tick on.
    pub velocities_m_s: Vec<Vector<D>>,
    /// δ_i.
    pub degrees: Vec<u16>,
    /// True c_i.
    pub levels: Vec<f64>,
    /// c_i as told.
    pub told: Vec<f64>,
    /// h_i as the robot's controller has it: c_i − F′, or T_i − θ under `budget` with free liars.
    pub spares: Vec<f64>,
    /// φ_i; NaN where nobody wants to know it, and of a robot that is down.
    pub phis: Vec<f64>,
    /// Whether φ and φ_i are wanted though the controller does not use them.
    pub wants_phi: bool,
    /// y_i; of malicious robots what they tell.
    pub values: Vec<f64>,
    /// What the program found.
    pub outcomes: Vec<Outcome>,
    /// What each robot says its answer is worth.
    pub modes: Vec<Mode>,
    /// Values that each robot used in the last round, and how many of them were those of normal robots.
    pub heard: Vec<[u16; 2]>,
    /// What the theorem is about, m: where velocities have taken each robot if a tracking error is stated, else its position.
    pub references_m: Vec<Vector<D>>,
    /// Robots that sensed some position with a larger error than is stated.
    pub sensed_wrong: Vec<bool>,
    /// True if in this tick some assumption of `budget` did not hold, whether or not a robot could know.
    pub broken: bool,
    /// True if in this tick some reference is not the last one plus its move: what held before says nothing about it.
    pub renewed: bool,
    /// True if in this tick some normal robot did not run, or began anew.
    pub unsteady: bool,
    /// Number of links, each counted once.
    pub links: u32,
}

impl<const D: usize> Frame<D> {
    /// A frame for robots at `positions_m` with initial `values`.
    #[must_use]
    pub fn new(positions_m: Vec<Vector<D>>, values: Vec<f64>) -> Self {
        let robots = positions_m.len();
        Self {
            references_m: positions_m.clone(),
            positions_m,
            desired_m_s: vec![[0.0; D]; robots],
            velocities_m_s: vec![[0.0; D]; robots],
            degrees: vec![0; robots],
            levels: vec![0.0; robots],
            told: vec![0.0; robots],
            spares: vec![0.0; robots],
            phis: vec![f64::NAN; robots],
            wants_phi: true,
            values,
            outcomes: vec![Outcome::Free; robots],
            modes: vec![Mode::Degraded(Reason::ContinuousTime); robots],
            heard: vec![[0; 2]; robots],
            sensed_wrong: vec![false; robots],
            broken: false,
            renewed: false,
            unsteady: false,
            links: 0,
        }
    }

    /// Forward Euler over `step_s`: `x_i += T u_i` (eq:dynamics with the input held).
    //= paper eq:dynamics
    pub fn integrate(&mut self, step_s: f64) {
        for (position, velocity) in self.positions_m.iter_mut().zip(&self.velocities_m_s) {
            *position = closeranks_core::num::add_scaled(position, step_s, velocity);
        }
        self.references_m.clone_from(&self.positions_m);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    //= paper eq:dynamics type=test
    #[test]
    fn robots_move_as_their_input_says() {
        let mut frame = Frame::new(vec![[1.0, 2.0], [0.0, 0.0]], vec![0.0, 0.0]);
        frame.velocities_m_s = vec![[0.5, -1.0], [0.0, 0.25]];
        frame.integrate(0.5);
        assert_eq!(frame.positions_m, [[1.25, 1.5], [0.0, 0.125]]);
    }
}
