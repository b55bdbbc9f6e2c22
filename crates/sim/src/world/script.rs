//! What a scenario says of its robots: the values that they begin with, and where they want to go.

use crate::frame::Frame;
use crate::random::{Random, Stream};
use crate::scenario::desired::Desired;
use crate::scenario::{Scenario, Values};
use crate::world::outcome::RunError;

/// y_i(t₀).
pub fn initial_values(scenario: &Scenario) -> Result<Vec<f64>, RunError> {
    match &scenario.values {
        Values::Listed(values) if values.len() == usize::from(scenario.team.robots) => Ok(values.clone()),
        Values::Listed(values) => Err(RunError::Values { found: values.len(), robots: scenario.team.robots }),
        Values::Random { min, max } => {
            let mut random = Random::new(scenario.seed, Stream::Values);
            Ok((0..scenario.team.robots).map(|_| random.uniform(*min, *max)).collect())
        }
    }
}

/// Fills the desired velocities of `tick`.
pub fn want<const D: usize>(scenario: &Scenario, tick: u32, frame: &mut Frame<D>) {
    let time_s = f64::from(tick) * scenario.tick_s();
    for (index, (desired, position)) in frame.desired_m_s.iter_mut().zip(&frame.positions_m).enumerate() {
        let number = u16::try_from(index + 1).unwrap_or(u16::MAX);
        *desired = match &scenario.desired {
            Desired::Wander => Desired::wandering(scenario.seed, number, time_s),
            Desired::Listed(route) => {
                route.velocity(index, time_s, scenario.tick_s(), position).unwrap_or([0.0; D])
            }
            motion => motion.desired(number, scenario.team.robots, position),
        };
    }
}
