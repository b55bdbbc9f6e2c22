//! Where a robot is and how it moves, as a trait, and what implements it.

pub mod pace;
pub mod replay;
pub mod ros;
pub mod simulated;
pub mod world;

use closeranks_core::{Instant, RobotId};

use crate::wire::sensed::Sensed;

/// What a robot is built into. The loop of a node asks it what was sensed and tells it the velocity.
pub trait PlantPort<const D: usize> {
    /// Takes bytes about robot `from` that arrived from the plant at `now`, if it is one that sends any.
    fn arrived(&mut self, now: Instant, from: RobotId, bytes: &[u8]);

    /// The newest that was sensed and not given out yet, at `now`; `None` if there is nothing new.
    fn sensed(&mut self, now: Instant) -> Option<Sensed<D>>;

    /// When something will be sensed that no arrival announces; `None` if arrivals announce all.
    fn next_at(&self) -> Option<Instant>;

    /// Moves with this velocity, m/s, until the next call. It is called in every tick, and with 0 before the robot stops.
    fn drive(&mut self, now: Instant, velocity_m_s: &[f64; D]);
}

/// The plant of a robot that is not connected to one.
pub struct Nowhere;

impl<const D: usize> PlantPort<D> for Nowhere {
    fn arrived(&mut self, _now: Instant, _from: RobotId, _bytes: &[u8]) {}

    fn sensed(&mut self, _now: Instant) -> Option<Sensed<D>> {
        None
    }

    fn next_at(&self) -> Option<Instant> {
        None
    }

    fn drive(&mut self, _now: Instant, _velocity_m_s: &[f64; D]) {}
}
