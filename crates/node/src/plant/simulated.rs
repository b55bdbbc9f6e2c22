//! A robot in the simulated plant of another process: signed looks come over the network, and velocities go back in the
//! robot's reports, so that [`PlantPort::drive`] has nothing to do.

use std::sync::Arc;

use closeranks_core::{Instant, Params, RobotId};

use crate::gate::{Gate, Reject};
use crate::identity::roster::Roster;
use crate::node::pilot::limits;
use crate::plant::PlantPort;
use crate::wire::envelope::Purpose;
use crate::wire::sensed::Sensed;

/// What came from the plant.
pub struct Simulated<const D: usize> {
    gate: Gate,
    newest: Option<Sensed<D>>,
}

impl<const D: usize> Simulated<D> {
    /// For robot `id` of this roster.
    #[must_use]
    pub fn new(roster: Arc<Roster>, id: RobotId, params: &Params<D>) -> Self {
        Self { gate: Gate::new(roster, Purpose::Sensed, Some(id), limits(params)), newest: None }
    }
}

impl<const D: usize> PlantPort<D> for Simulated<D> {
    fn arrived(&mut self, now: Instant, _from: RobotId, bytes: &[u8]) {
        let Ok(envelope) = self.gate.take(now, bytes) else { return };
        match Sensed::parse(envelope.payload) {
            Some(sensed) => self.newest = Some(sensed),
            None => self.gate.reject(envelope.id, Reject::Payload),
        }
    }

    fn sensed(&mut self, _now: Instant) -> Option<Sensed<D>> {
        self.newest.take()
    }

    fn next_at(&self) -> Option<Instant> {
        None
    }

    fn drive(&mut self, _now: Instant, _velocity_m_s: &[f64; D]) {}
}
