//! A world of whichever dimension its scenario has: for bindings, and for whoever learns the dimension at run time.

use std::sync::Arc;

use closeranks_core::num::Vector;
use closeranks_core::program::Outcome;
use closeranks_core::robot::report::Mode;

use crate::engine::workers::Workers;
use crate::law::Verdicts;
use crate::monitors::glance::Glance;
use crate::output::snapshot::Snapshot;
use crate::scenario::Scenario;
use crate::world::given::{Given, GivenError};
use crate::world::{Options, Run, RunError, World};

/// A [`World`] in the plane or in space. Vectors of the team are flat: one robot after another, one number a dimension.
#[expect(clippy::large_enum_variant, reason = "there is one a run")]
pub enum AnyWorld {
    /// Two dimensions.
    Plane(World<2>),
    /// Three dimensions.
    Space(World<3>),
}

/// What is given from outside for a tick, as in [`Given`], with flat vectors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AnyGiven<'a> {
    /// u_{i,des}, m/s, n times D numbers.
    pub desired_m_s: Option<&'a [f64]>,
    /// What malicious robots tell of their level.
    pub levels: Option<&'a [f64]>,
    /// What malicious robots tell of their value in a round.
    pub values: Option<&'a [f64]>,
}

/// Calls the same method of whichever world it is.
macro_rules! dispatch {
    ($of:expr, $world:ident => $call:expr) => {
        match $of {
            AnyWorld::Plane($world) => $call,
            AnyWorld::Space($world) => $call,
        }
    };
}

impl AnyWorld {
    /// The world of `scenario` before its first tick.
    pub fn new(scenario: &Scenario, options: Options) -> Result<Self, RunError> {
        match scenario.dimension {
            2 => Ok(Self::Plane(World::new(scenario, options)?)),
            3 => Ok(Self::Space(World::new(scenario, options)?)),
            other => Err(RunError::Dimension(other)),
        }
    }

    /// As [`World::employ`].
    pub fn employ(&mut self, workers: Arc<dyn Workers>) {
        dispatch!(self, world => world.employ(workers));
    }

    /// D.
    #[must_use]
    pub fn dimension(&self) -> usize {
        match self {
            Self::Plane(_) => 2,
            Self::Space(_) => 3,
        }
    }

    /// How many ticks were computed.
    #[must_use]
    pub fn ticks_done(&self) -> u32 {
        dispatch!(self, world => world.ticks_done())
    }

    /// True once the last tick of the scenario was computed.
    #[must_use]
    pub fn is_over(&self) -> bool {
        dispatch!(self, world => world.is_over())
    }

    /// Moves robots to where the next tick finds them, as [`World::prepare`] does.
    pub fn prepare(&mut self) {
        dispatch!(self, world => {
            world.prepare();
        });
    }

    /// Computes the next tick.
    pub fn step(&mut self) {
        dispatch!(self, world => {
            world.step();
        });
    }

    /// Computes the next tick with what is `given` from outside; refused as [`World::step_with`] does.
    pub fn step_with(&mut self, given: &AnyGiven<'_>) -> Result<(), GivenError> {
        dispatch!(self, world => {
            let given = given_to(world, given)?;
            world.step_with(&given).map(|_| ())
        })
    }

    /// Whether what is `given` is refused.
    pub(crate) fn check(&self, given: &AnyGiven<'_>) -> Result<(), GivenError> {
        dispatch!(self, world => given_to(world, given)?.check(world.frame().positions_m.len()))
    }

    /// The first part of a tick: robots move, and are asked for what is `given`, which was checked.
    pub(crate) fn begin_with(&mut self, given: &AnyGiven<'_>) -> Result<(), GivenError> {
        dispatch!(self, world => {
            let given = given_to(world, given)?;
            world.begin();
            world.give(&given);
            world.ask();
        });
        Ok(())
    }

    /// The second part, for worlds that are computed alone.
    pub(crate) fn compute(&mut self) {
        dispatch!(self, world => world.compute());
    }

    /// The first part where nothing is given.
    pub(crate) fn begin(&mut self) {
        dispatch!(self, world => {
            world.begin();
            world.ask();
        });
    }

    /// Takes the tick that was computed into the summary.
    pub(crate) fn collect(&mut self) {
        dispatch!(self, world => world.collect());
    }

    /// The third part, if need be from a `glance` at the tick.
    pub(crate) fn settle(&mut self, glance: Option<&Glance>) {
        dispatch!(self, world => world.settle(glance));
    }

    /// True if its team can be computed side by side with others.
    pub(crate) fn goes_in_lanes(&mut self) -> bool {
        dispatch!(self, world => world.in_lane().is_some())
    }

    /// The world, if it is in the plane.
    pub(crate) fn plane(&mut self) -> Option<&mut World<2>> {
        if let Self::Plane(world) = self { Some(world) } else { None }
    }

    /// The world, if it is in space.
    pub(crate) fn space(&mut self) -> Option<&mut World<3>> {
        if let Self::Space(world) = self { Some(world) } else { None }
    }

    /// As [`World::digest`].
    #[must_use]
    pub fn digest(&self) -> Option<u64> {
        dispatch!(self, world => world.digest())
    }

    /// The last tick as whoever watches the run sees it; none before the first one.
    #[must_use]
    pub fn snapshot(&self) -> Option<Snapshot<'_>> {
        dispatch!(self, world => world.snapshot())
    }

    /// What became of the laws up to the last tick.
    #[must_use]
    pub fn verdicts(&self) -> &Verdicts {
        dispatch!(self, world => world.monitors().verdicts())
    }

    /// u_{i,des}, m/s, flat.
    #[must_use]
    pub fn desired_m_s(&self) -> &[f64] {
        dispatch!(self, world => world.frame().desired_m_s.as_flattened())
    }

    /// x_i, m, flat.
    #[must_use]
    pub fn positions_m(&self) -> &[f64] {
        dispatch!(self, world => world.frame().positions_m.as_flattened())
    }

    /// u_i, m/s, flat: held from the last tick on.
    #[must_use]
    pub fn velocities_m_s(&self) -> &[f64] {
        dispatch!(self, world => world.frame().velocities_m_s.as_flattened())
    }

    /// h_i as the robot's controller has it.
    #[must_use]
    pub fn h(&self) -> &[f64] {
        dispatch!(self, world => &world.frame().h)
    }

    /// True c_i.
    #[must_use]
    pub fn levels(&self) -> &[f64] {
        dispatch!(self, world => &world.frame().levels)
    }

    /// c_i as told.
    #[must_use]
    pub fn told(&self) -> &[f64] {
        dispatch!(self, world => &world.frame().told)
    }

    /// φ_i; NaN of a robot that is down, and of all if nobody wants to know it.
    #[must_use]
    pub fn phis(&self) -> &[f64] {
        dispatch!(self, world => &world.frame().phis)
    }

    /// What the program of each robot found.
    #[must_use]
    pub fn outcomes(&self) -> &[Outcome] {
        dispatch!(self, world => &world.frame().outcomes)
    }

    /// What each robot says its answer is worth.
    #[must_use]
    pub fn modes(&self) -> &[Mode] {
        dispatch!(self, world => &world.frame().modes)
    }

    /// δ_i.
    #[must_use]
    pub fn degrees(&self) -> &[u16] {
        dispatch!(self, world => &world.frame().degrees)
    }

    /// y_i as each robot holds it, malicious or not.
    #[must_use]
    pub fn held(&self) -> &[f64] {
        dispatch!(self, world => &world.frame().held)
    }

    /// y_i; of malicious robots what they tell, if they tell all the same.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        dispatch!(self, world => &world.frame().values)
    }

    /// Ends the run.
    #[must_use]
    pub fn finish(self) -> Run {
        dispatch!(self, world => world.finish())
    }
}

/// What is given to a world of this dimension.
fn given_to<'a, const D: usize>(world: &World<D>, given: &AnyGiven<'a>) -> Result<Given<'a, D>, GivenError> {
    let robots = world.frame().positions_m.len();
    let desired_m_s = match given.desired_m_s.map(<[f64]>::as_chunks::<D>) {
        Some((_, rest)) if !rest.is_empty() => {
            let found = given.desired_m_s.map_or(0, <[f64]>::len);
            return Err(GivenError::Length { array: "desired_m_s", found, robots: D * robots });
        }
        desired => desired.map(|(desired, _): (&[Vector<D>], _)| desired),
    };
    Ok(Given { desired_m_s, levels: given.levels, values: given.values })
}
