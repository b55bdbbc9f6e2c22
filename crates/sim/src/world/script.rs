//! What a scenario says of its robots: the values that they begin with, and where they want to go.

use closeranks_core::num::Vector;

use crate::frame::Frame;
use crate::random::{Random, Stream};
use crate::scenario::desired::Desired;
use crate::scenario::{Scenario, Values};
use crate::world::outcome::RunError;
use crate::world::teams;

/// The first number of y_i(t₀), and the only one where values have one.
pub fn initial_values(scenario: &Scenario) -> Result<Vec<f64>, RunError> {
    initial_numbers(scenario).map(|mut numbers| numbers.swap_remove(0))
}

/// y_i(t₀), a list for each of its numbers; of several teams one team after another.
pub fn initial_numbers(scenario: &Scenario) -> Result<Vec<Vec<f64>>, RunError> {
    let each: Result<Vec<_>, RunError> = teams::each(scenario).map(|team| initial_numbers(&team)).collect();
    if let Some(all) = each?.into_iter().reduce(|all, team| {
        all.into_iter().zip(team).map(|(numbers, more)| [numbers, more].concat()).collect()
    }) {
        return Ok(all);
    }
    let (robots, dimension) = (scenario.team.robots, scenario.consensus.dimension.max(1));
    let found = |found: usize| {
        if found == usize::from(robots) { Ok(()) } else { Err(RunError::Values { found, robots }) }
    };
    match &scenario.values {
        Values::Listed(values) => found(values.len()).map(|()| vec![values.clone(); dimension]),
        Values::Points(points) => found(points.len()).map(|()| {
            let column = |d: usize| points.iter().map(|point| point.get(d).copied().unwrap_or(0.0)).collect();
            (0..dimension).map(column).collect()
        }),
        Values::Random { min, max } => {
            let mut random = Random::new(scenario.seed, Stream::Values);
            let mut column = || (0..robots).map(|_| random.uniform(*min, *max)).collect();
            Ok((0..dimension).map(|_| column()).collect())
        }
    }
}

/// The frame before the first tick of robots with these initial values.
pub(super) fn first_frame<const D: usize>(scenario: &Scenario, values: &[f64]) -> Result<Frame<D>, RunError> {
    let frame = Frame::new(scenario.positions()?, values.to_vec());
    Ok(Frame { cutting: scenario.obstacles.cutting().into(), ..frame })
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

/// Whoever is absent wants nothing.
pub(super) fn rest<const D: usize>(absent: &[bool], wishes_m_s: &mut [Vector<D>]) {
    for (wish, _) in wishes_m_s.iter_mut().zip(absent).filter(|(_, absent)| **absent) {
        *wish = [0.0; D];
    }
}
