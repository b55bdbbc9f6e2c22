//! A world of whichever dimension its scenario has: for bindings, and for whoever learns the dimension at run time.

use std::sync::Arc;

use closeranks_core::num::Vector;
use closeranks_core::program::Outcome;
use closeranks_core::robot::report::Mode;

use crate::engine::workers::Workers;
use crate::frame::Frame;
use crate::law::Verdicts;
use crate::monitors::glance::Glance;
use crate::monitors::robustness::Round;
use crate::output::record::Record;
use crate::output::snapshot::Snapshot;
use crate::scenario::Scenario;
use crate::world::given::{Given, GivenError};
use crate::world::teams::Teams;
use crate::world::{Options, Run, RunError, World};

/// A [`World`] in the plane or in space. Vectors of the team are flat: one robot after another, one number a dimension.
#[expect(clippy::large_enum_variant, reason = "there is one a run")]
pub enum AnyWorld {
    /// Two dimensions.
    Plane(World<2>),
    /// Three dimensions.
    Space(World<3>),
    /// Several teams in two dimensions.
    PlaneTeams(Teams<2>),
    /// Several teams in three dimensions.
    SpaceTeams(Teams<3>),
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
            AnyWorld::PlaneTeams($world) => $call,
            AnyWorld::SpaceTeams($world) => $call,
        }
    };
    // What worlds of a block do, in which there are no teams.
    ($of:expr, $world:ident => $call:expr, else $other:expr) => {
        match $of {
            AnyWorld::Plane($world) => $call,
            AnyWorld::Space($world) => $call,
            AnyWorld::PlaneTeams(_) | AnyWorld::SpaceTeams(_) => $other,
        }
    };
}

impl AnyWorld {
    /// The world of `scenario` before its first tick.
    pub fn new(scenario: &Scenario, options: Options) -> Result<Self, RunError> {
        match (scenario.dimension, scenario.teams.is_empty()) {
            (2, true) => Ok(Self::Plane(World::new(scenario, options)?)),
            (3, true) => Ok(Self::Space(World::new(scenario, options)?)),
            (2, false) => Ok(Self::PlaneTeams(Teams::new(scenario, options)?)),
            (3, false) => Ok(Self::SpaceTeams(Teams::new(scenario, options)?)),
            (other, _) => Err(RunError::Dimension(other)),
        }
    }

    /// As [`World::employ`].
    pub fn employ(&mut self, workers: Arc<dyn Workers>) {
        match self {
            Self::Plane(world) => world.employ(workers),
            Self::Space(world) => world.employ(workers),
            Self::PlaneTeams(teams) => teams.employ(&workers),
            Self::SpaceTeams(teams) => teams.employ(&workers),
        }
    }

    /// D.
    #[must_use]
    pub fn dimension(&self) -> usize {
        match self {
            Self::Plane(_) | Self::PlaneTeams(_) => 2,
            Self::Space(_) | Self::SpaceTeams(_) => 3,
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
            let given = given_to(world.frame().positions_m.len(), given)?;
            world.step_with(&given).map(|_| ())
        })
    }

    /// Whether what is `given` is refused.
    pub(crate) fn check(&self, given: &AnyGiven<'_>) -> Result<(), GivenError> {
        dispatch!(self, world => {
            let robots = world.frame().positions_m.len();
            given_to(robots, given).and_then(|given| checked(world.frame(), &given))
        })
    }

    /// The first part of a tick: robots move, and are asked for what is `given`, which was checked.
    pub(crate) fn begin_with(&mut self, given: &AnyGiven<'_>) -> Result<(), GivenError> {
        dispatch!(self, world => {
            let given = given_to(world.frame().positions_m.len(), given)?;
            world.begin();
            world.give(&given);
            world.ask();
        }, else {});
        Ok(())
    }

    /// The second part, for worlds that are computed alone.
    pub(crate) fn compute(&mut self) {
        dispatch!(self, world => world.compute(), else {});
    }

    /// The first part where nothing is given.
    pub(crate) fn begin(&mut self) {
        dispatch!(self, world => {
            world.begin();
            world.ask();
        }, else {});
    }

    /// Takes the tick that was computed into the summary.
    pub(crate) fn collect(&mut self) {
        dispatch!(self, world => {
            world.collector.watch(&world.scenario, &world.frame, &world.monitors);
        }, else {});
    }

    /// The third part, in which φ_i may be known, if need be from a `glance` at the tick.
    pub(crate) fn settle(&mut self, knows_phi: bool, glance: Option<&Glance<'_>>) {
        dispatch!(self, world => world.settle(knows_phi, glance), else {});
    }

    /// True if its team can be computed side by side with others.
    pub(crate) fn goes_in_lanes(&mut self) -> bool {
        dispatch!(self, world => world.goes_in_lanes(), else false)
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
        dispatch!(self, world => world.verdicts())
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

    /// As [`World::record_mut`].
    pub(crate) fn record_mut(&mut self) -> Option<&mut Record> {
        dispatch!(self, world => world.record_mut())
    }

    /// As [`World::has_many_rounds`].
    pub(crate) fn has_many_rounds(&self) -> bool {
        dispatch!(self, world => world.has_many_rounds())
    }

    /// As [`World::take_rounds`].
    pub(crate) fn take_rounds(&mut self) -> Vec<Round> {
        dispatch!(self, world => world.take_rounds())
    }

    /// Ends the run.
    #[must_use]
    pub fn finish(self) -> Run {
        dispatch!(self, world => world.finish())
    }
}

/// Whether what is given fits the robots of `frame`.
fn checked<const D: usize>(frame: &Frame<D>, given: &Given<'_, D>) -> Result<(), GivenError> {
    given.check(frame.positions_m.len())
}

/// What is given to a world of this dimension with so many robots.
fn given_to<'a, const D: usize>(robots: usize, given: &AnyGiven<'a>) -> Result<Given<'a, D>, GivenError> {
    let desired_m_s = match given.desired_m_s.map(<[f64]>::as_chunks::<D>) {
        Some((_, rest)) if !rest.is_empty() => {
            let found = given.desired_m_s.map_or(0, <[f64]>::len);
            return Err(GivenError::Length { array: "desired_m_s", found, robots: D * robots });
        }
        desired => desired.map(|(desired, _): (&[Vector<D>], _)| desired),
    };
    Ok(Given { desired_m_s, levels: given.levels, values: given.values })
}
