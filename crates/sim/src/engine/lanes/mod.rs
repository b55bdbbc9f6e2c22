//! Many worlds of one scenario side by side, a world a lane, with the bits of each alone.

pub(crate) mod composed;
pub(crate) mod held;
mod phi;

use closeranks_core::num::lane::{LANES, Lane};
use closeranks_core::settings::params::Params;

use crate::attack::liars::Liars;
use crate::engine::lanes::composed::ComposedLanes;
use crate::engine::lanes::held::HeldLanes;
use crate::frame::Frame;
use crate::monitors::glance::Glance;
use crate::scenario::Scenario;

/// A world in a lane, of whose `team` a tick is computed.
pub(crate) struct InLane<'a, const D: usize, Team> {
    pub(crate) frame: &'a mut Frame<D>,
    pub(crate) liars: &'a mut Liars,
    pub(crate) team: Team,
}

/// Computes up to [`LANES`] worlds whose scenarios differ in their seeds alone.
#[derive(Clone, Debug)]
pub(crate) enum Lanes<const D: usize> {
    /// Under `composed`.
    Composed(Box<ComposedLanes<D>>),
    /// Under `links`.
    Held(Box<HeldLanes<D>>),
}

impl<const D: usize> Lanes<D> {
    /// For teams of `scenario` with these `params`; `None` under a controller that is not computed so.
    pub(crate) fn new(scenario: &Scenario, params: &Params<D>) -> Option<Self> {
        if params.controller().tells_lists() {
            return HeldLanes::new(scenario, params).map(|lanes| Self::Held(Box::new(lanes)));
        }
        let lanes = ComposedLanes::new(params, scenario.malicious_mask())?;
        Some(Self::Composed(Box::new(lanes)))
    }

    /// True if worlds with these `params` are computed so, as far as that depends on them.
    pub(crate) fn are_for(params: &Params<D>) -> bool {
        let controller = params.controller();
        let held = controller.lists().and_then(|controller| controller.in_lanes());
        controller.in_lanes().is_some() || held.is_some()
    }

    /// What the last tick of a world came to for its whole team; none if its robots must be looked at.
    pub(crate) fn glance(&self, lane: usize) -> Option<Glance<'_>> {
        match self {
            Self::Composed(lanes) => lanes.glance(lane),
            Self::Held(lanes) => lanes.glance(lane),
        }
    }

    /// True if φ_i of a world are in its frame already, although its robots do not use them.
    pub(crate) fn knows_phi(&self, lane: usize) -> bool {
        matches!(self, Self::Held(lanes) if lanes.knows_phi(lane))
    }
}

/// A vector of every world, side by side. Lanes without a world have that of the first one.
#[inline]
fn in_lanes<'a, const D: usize, Team>(
    worlds: &[InLane<'a, D, Team>],
    of: impl Fn(&InLane<'a, D, Team>) -> [f64; D],
) -> [Lane; D] {
    let mut lanes = [[0.0; LANES]; D];
    for lane in 0..LANES {
        let vector = of(worlds.get(lane).unwrap_or(&worlds[0]));
        for d in 0..D {
            lanes[d][lane] = vector[d];
        }
    }
    lanes
}

/// Those before a robot, and the robot itself.
#[inline]
fn ends<T>(all: &mut [T], second: usize) -> (&mut [T], &mut T) {
    let (before, from_second) = all.split_at_mut(second);
    (before, &mut from_second[0])
}
