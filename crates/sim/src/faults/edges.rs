//! What stands between a robot and the world, apart from the network: its clock, its sensors and its power.

use closeranks_core::num::Vector;
use closeranks_core::settings::params::Params;

use crate::faults::clocks::Shown;
use crate::faults::outages::Downtime;
use crate::faults::sensing::Senses;
use crate::faults::sight::Sight;
use crate::frame::Presence;
use crate::scenario::Scenario;

/// The clocks, sensors and outages of a run.
#[derive(Clone, Debug)]
pub struct Edges<const D: usize> {
    /// The robots' own clocks.
    pub clocks: Shown,
    /// What robots sense of positions.
    pub senses: Senses<D>,
    /// Whom they sense.
    pub sight: Sight<D>,
    /// Which robots are down.
    pub downtime: Downtime,
}

impl<const D: usize> Edges<D> {
    /// The clocks, sensors and outages of `scenario`, whose robots have these `params`.
    #[must_use]
    pub fn new(scenario: &Scenario, params: &Params<D>) -> Self {
        let (faults, seed, robots) = (&scenario.faults, scenario.seed, scenario.team.robots);
        Self {
            clocks: Shown::new(faults.clocks, seed, robots, scenario.clock.level_period),
            sight: Sight::new(scenario, params),
            senses: Senses::new(faults.sensing, seed, robots),
            downtime: Downtime::new(faults.outages, seed, robots),
        }
    }

    /// Begins `tick` at `time_s` with everybody who is there at `positions_m`.
    pub fn begin_tick(&mut self, tick: u32, time_s: f64, positions_m: &[Vector<D>], presence: &Presence) {
        self.sight.begin_tick(tick, time_s);
        self.downtime.begin_tick(time_s, presence);
        self.senses.begin_tick(time_s, positions_m);
    }
}
