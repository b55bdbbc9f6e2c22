//! h of the robots of a start, as each of them has it in its first tick.

use closeranks_core::controller::budget::knowledge::Sighting;
use closeranks_core::equations::barrier::degree_barrier;
use closeranks_core::num::{Vector, subtract};
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::settings::params::Params;

/// Computes h, with memory for one robot at a time.
#[derive(Debug)]
pub(super) struct Levels<'a, const D: usize> {
    params: &'a Params<D>,
    sightings: Vec<Sighting<D>>,
    scratch: Vec<f64>,
}

impl<'a, const D: usize> Levels<'a, D> {
    /// `None` under a controller that keeps no level for certain.
    pub(super) fn new(params: &'a Params<D>) -> Option<Self> {
        params.controller().certain_level(RobotId(1).into(), &[], &mut [])?;
        Some(Self { params, sightings: Vec::new(), scratch: Vec::new() })
    }

    /// h of the robot with this index, certain with the stated errors.
    pub(super) fn h(&mut self, positions_m: &[Vector<D>], index: usize) -> f64 {
        let own = positions_m[index];
        self.sightings.clear();
        let others = (1_u16..).zip(positions_m).filter(|(id, _)| usize::from(*id) != index + 1);
        let sighting = |(id, place): (u16, &Vector<D>)| Sighting::new(RobotId(id), subtract(&own, place));
        self.sightings.extend(others.map(sighting));
        self.scratch.resize(self.sightings.len(), 0.0);
        let id = RobotId(u16::try_from(index + 1).unwrap_or(u16::MAX));
        let level = self.params.controller().certain_level(id.into(), &self.sightings, &mut self.scratch);
        degree_barrier(level.unwrap_or(f64::NEG_INFINITY), self.params.need().need(id))
    }

    /// The index of the robot with the least h, and that h.
    pub(super) fn least(&mut self, positions_m: &[Vector<D>]) -> (usize, f64) {
        let mut least = (0, f64::INFINITY);
        // The last robots of a patch stand at its rim.
        for index in (0..positions_m.len()).rev() {
            let h = self.h(positions_m, index);
            if h < least.1 {
                least = (index, h);
            }
        }
        least
    }
}

/// h of a robot if all `robots` stood at one point: no start has more. −∞ under a controller that keeps no level for certain.
pub(super) fn most<const D: usize>(params: &Params<D>) -> f64 {
    let robots = usize::from(params.settings().team.robots);
    Levels::new(params).map_or(f64::NEG_INFINITY, |mut levels| levels.h(&vec![[0.0; D]; robots], 0))
}
