//! What robots report of their own state, against what is so.

use closeranks_core::robot::report::Mode;
use closeranks_core::settings::params::Params;

use crate::faults::{Clocks, Outages};
use crate::frame::Frame;
use crate::geometry::squared_distance;
use crate::monitors::rounding::level_rounding;
use crate::monitors::truth::Truth;
use crate::plant::Plant;
use crate::scenario::Scenario;

/// The rounding of a squared distance, as a fraction of it, is smaller than this.
const REFERENCE_ROUNDING: f64 = 1e-9;

/// Something that a robot reports and that is not so.
pub(crate) struct Untrue {
    /// What it reports, and what is so.
    pub(crate) seen: f64,
    /// See `seen`.
    pub(crate) demanded: f64,
}

/// Holds reports against the truth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reports {
    /// Robots sense exactly, and look at every tick.
    exact: bool,
    /// Robots tell lists: their level counts whom they count on, and is no sum of weights.
    lists: bool,
    /// What is stated of tracking is so, so that no robot is farther from its reference than `away_m`.
    steered: bool,
    away_m: f64,
}

impl Reports {
    /// For the robots of `scenario`.
    pub(crate) fn new<const D: usize>(scenario: &Scenario, params: &Params<D>) -> Self {
        let errors = params.kept().errors;
        let steady = scenario.faults.clocks == Clocks::default();
        Self {
            exact: steady && errors.offset_m == 0.0 && scenario.faults.sensing.is_right(),
            lists: params.controller().tells_lists(),
            steered: steady && errors.away_m > 0.0 && is_steered(scenario, params),
            away_m: errors.away_m,
        }
    }

    /// What robot `index` reports of its degree and of h, and where it counts itself while it calls its answer guaranteed, as far as one
    /// of them is not so. Of a robot that does not run nothing is asked.
    pub(crate) fn untrue<const D: usize>(
        &self,
        index: usize,
        frame: &Frame<D>,
        truth: &Truth,
    ) -> Option<Untrue> {
        if frame.down[index] {
            return None;
        }
        let (degree, neighbors) = (frame.degrees[index], truth.neighbors[index]);
        // Who reckons with a robot that left silently cannot know better.
        let exact = self.exact && !frame.assumptions.sensed_wrong[index];
        if exact && degree != neighbors {
            return Some(Untrue { seen: f64::from(degree), demanded: f64::from(neighbors) });
        }
        let (h, own) = (frame.h[index], truth.h_own[index]);
        let differs = (h - own).abs() > level_rounding(neighbors) || h.is_nan();
        if exact && !self.lists && differs {
            return Some(Untrue { seen: h, demanded: own });
        }
        let away_m2 = squared_distance(&frame.references_m[index], &frame.positions_m[index]);
        let strays = away_m2 > self.away_m * self.away_m * (1.0 + REFERENCE_ROUNDING);
        (self.steered && frame.modes[index] == Mode::Guaranteed && strays)
            .then_some(Untrue { seen: away_m2.sqrt(), demanded: self.away_m })
    }
}

/// True if bodies follow their velocities as well as is stated, robots stand still in ticks that they miss, and positions are sensed
/// as they are.
fn is_steered<const D: usize>(scenario: &Scenario, params: &Params<D>) -> bool {
    let speed_m_s = params.reach().longest_m() / params.hold_s();
    let follows = match scenario.plant {
        Plant::Single | Plant::Unicycle { .. } => true,
        Plant::Lag { lag_s } => lag_s * speed_m_s <= params.settings().errors.tracking_m,
        Plant::Double { .. } => {
            let needed_m = scenario.plant.tracking_error_m();
            needed_m.is_some_and(|needed_m| needed_m <= params.settings().errors.tracking_m)
        }
    };
    let Outages { goes_on, crash, .. } = scenario.faults.outages;
    follows && !goes_on && crash.is_none() && scenario.faults.sensing.is_right()
}
