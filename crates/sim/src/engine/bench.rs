//! What computing a part of a team takes, and what comes of it.

use closeranks_core::num::Vector;
use closeranks_core::obstacle::Obstacle;
use closeranks_core::program::Outcome;
use closeranks_core::robot::report::Mode;
use closeranks_core::settings::params::Params;

use crate::engine::marks::Marks;
use crate::engine::memory::Memory;
use crate::frame::Frame;

/// Memory of whoever computes a part of the team.
#[derive(Clone, Debug)]
pub(crate) struct Bench<const D: usize> {
    pub(crate) memory: Memory<D>,
    pub(crate) marks: Marks,
}

/// What became of a robot in a tick.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Decided<const D: usize> {
    pub(crate) velocity_m_s: Vector<D>,
    pub(crate) outcome: Outcome,
    pub(crate) mode: Mode,
    pub(crate) phi: Option<f64>,
}

impl<const D: usize> Bench<D> {
    /// For a team of so many robots among obstacles.
    pub(crate) fn new(params: &Params<D>, robots: usize, map: &[Obstacle<D>]) -> Self {
        Self { memory: Memory::new(params, robots).among(map), marks: Marks::default() }
    }
}

impl<const D: usize> Decided<D> {
    /// Of a robot that stands still.
    pub(crate) const NOTHING: Self =
        Self { velocity_m_s: [0.0; D], outcome: Outcome::Free, mode: Mode::Stopped, phi: None };

    /// Writes it where it belongs.
    #[inline]
    pub(crate) fn write(&self, robot: usize, frame: &mut Frame<D>) {
        frame.velocities_m_s[robot] = self.velocity_m_s;
        (frame.outcomes[robot], frame.modes[robot]) = (self.outcome, self.mode);
        if let Some(phi) = self.phi {
            frame.phis[robot] = phi;
        }
    }
}
