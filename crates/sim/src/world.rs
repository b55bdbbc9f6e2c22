//! The run: scenario in, record and summary out.

use closeranks_core::controller::AnyController;
use closeranks_core::robot::error::RobotError;
use closeranks_core::settings::params::Params;
use closeranks_core::settings::range::ParamsError;

use crate::attack::liars::Liars;
use crate::engine::fleet::Fleet;
use crate::engine::judge::Judge;
use crate::engine::robots::Robots;
use crate::engine::team::Team;
use crate::frame::Frame;
use crate::monitors::Monitors;
use crate::monitors::robustness::{Round, Watcher};
use crate::output::record::Record;
use crate::output::summary::{Collector, Summary};
use crate::plant::Bodies;
use crate::random::{Random, Stream};
use crate::scenario::desired::Desired;
use crate::scenario::start::StartError;
use crate::scenario::{Controller, Scenario, Values};

/// How robots are computed; both give the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Engine {
    /// All at once ([`crate::engine::team`], for `budget` [`crate::engine::allies`]); `budget` with free liars, with margins for errors or far
    /// from the origin, and any world that is not perfect, run one by one all the same.
    #[default]
    Team,
    /// One by one, with every message as bytes ([`crate::engine::fleet`]).
    Robots,
}

/// What a run is to produce besides its summary.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Keep every tick.
    pub record: bool,
    /// Search the network of every consensus round for its exact robustness.
    pub robustness: bool,
    /// Leave φ and φ_i out where the controller does not use them: their extremes are then infinite, and their laws are not
    /// looked at.
    pub without_phi: bool,
    /// How robots are computed.
    pub engine: Engine,
}

/// A finished run.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Every tick, if it was asked for.
    pub record: Option<Record>,
    /// Exact robustness of every consensus round, if it was asked for and the team is small enough.
    pub rounds: Vec<Round>,
    /// The table's row.
    pub summary: Summary,
}

/// Why a scenario could not be run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// A parameter is outside its range.
    #[error(transparent)]
    Params(#[from] ParamsError),
    /// There is no start.
    #[error(transparent)]
    Start(#[from] StartError),
    /// A robot could not be made.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// Neither 2 nor 3.
    #[error("dimension is {0}, allowed is 2 or 3")]
    Dimension(usize),
    /// Initial values and robots differ in number.
    #[error("{found} initial values for {robots} robots")]
    Values {
        /// How many.
        found: usize,
        /// n.
        robots: u16,
    },
}

/// Runs `scenario` from the first tick to the last. `progress` is called before each tick with its number.
pub fn run(scenario: &Scenario, options: Options, progress: &mut dyn FnMut(u32)) -> Result<Run, RunError> {
    match scenario.dimension {
        2 => run_in::<2>(scenario, options, progress),
        3 => run_in::<3>(scenario, options, progress),
        other => Err(RunError::Dimension(other)),
    }
}

fn run_in<const D: usize>(
    scenario: &Scenario,
    options: Options,
    progress: &mut dyn FnMut(u32),
) -> Result<Run, RunError> {
    let params = scenario.params::<D>()?;
    let values = initial_values(scenario)?;
    let frame = Frame::new(scenario.positions()?, values.clone());
    let world = World::new(scenario, params, frame, options);
    let mut robots = robots(scenario, params, &world.frame, &values, options.engine)?;
    Ok(world.run(robots.as_mut(), progress))
}

/// What computes the robots of a run: all at once where the world is perfect and the controller can, else one by one.
fn robots<const D: usize>(
    scenario: &Scenario,
    params: Params<D>,
    frame: &Frame<D>,
    values: &[f64],
    engine: Engine,
) -> Result<Box<dyn Robots<D>>, RunError> {
    let together = engine == Engine::Team && scenario.is_plain();
    Ok(match *params.controller() {
        AnyController::Composed(composed) if together => {
            Box::new(Team::new(scenario, params, composed, values))
        }
        AnyController::None(none) if together => Box::new(Team::new(scenario, params, none, values)),
        AnyController::Budget(budget)
            if together && budget.budget.is_plain() && is_near(scenario, &params, frame) =>
        {
            Box::new(Team::new(scenario, params, budget, values))
        }
        _ => Box::new(Fleet::new(scenario, params, values)?),
    })
}

/// Positions are rounded to far less than what a robot takes for a jump as long as they are nearer to 0 than this, m.
const NEAR_M: f64 = 1e5;

/// True if rounding never looks to a robot like a jump.
fn is_near<const D: usize>(scenario: &Scenario, params: &Params<D>, frame: &Frame<D>) -> bool {
    let way_m = f64::from(scenario.ticks()) * params.reach().longest_m();
    frame.positions_m.iter().flatten().all(|x| x.abs() + way_m < NEAR_M)
}

/// y_i(t₀).
pub fn initial_values(scenario: &Scenario) -> Result<Vec<f64>, RunError> {
    match &scenario.values {
        Values::Listed(values) if values.len() == usize::from(scenario.robots) => Ok(values.clone()),
        Values::Listed(values) => Err(RunError::Values { found: values.len(), robots: scenario.robots }),
        Values::Random { min, max } => {
            let mut random = Random::new(scenario.seed, Stream::Values);
            Ok((0..scenario.robots).map(|_| random.uniform(*min, *max)).collect())
        }
    }
}

struct World<'a, const D: usize> {
    scenario: &'a Scenario,
    malicious: Vec<bool>,
    frame: Frame<D>,
    liars: Liars,
    bodies: Bodies<D>,
    judge: Judge,
    monitors: Monitors<D>,
    collector: Collector,
    record: Option<Record>,
    watcher: Option<Watcher>,
}

impl<'a, const D: usize> World<'a, D> {
    fn new(scenario: &'a Scenario, params: Params<D>, frame: Frame<D>, options: Options) -> Self {
        let wants_phi = !(options.without_phi && scenario.controller == Controller::Budget);
        let required = scenario.composed().required;
        Self {
            scenario,
            malicious: scenario.malicious_mask(),
            bodies: Bodies::new(scenario.plant, scenario.tick_s(), &frame.positions_m),
            frame: Frame { wants_phi, ..frame },
            liars: Liars::new(scenario),
            judge: Judge::new(scenario, &params),
            monitors: Monitors::new(scenario, params),
            collector: Collector::default(),
            record: options.record.then(|| Record::new(scenario, required)),
            watcher: options.robustness.then(Watcher::default),
        }
    }

    fn run(mut self, robots: &mut dyn Robots<D>, progress: &mut dyn FnMut(u32)) -> Run {
        let last = self.scenario.ticks();
        for tick in 0..=last {
            progress(tick);
            want(self.scenario, tick, &mut self.frame);
            robots.step(&mut self.frame, &mut self.liars);
            self.judge.judge(tick, &mut self.frame, robots, &self.bodies);
            self.monitors.watch(tick, &self.frame);
            self.collector.watch(self.scenario, &self.frame, &self.monitors);
            if let Some(record) = &mut self.record {
                record.push(&self.frame);
            }
            self.watch_round(tick);
            if tick < last {
                self.bodies.integrate(&mut self.frame.positions_m, &self.frame.velocities_m_s);
            }
        }
        let summary = self.collector.finish(self.scenario, &self.frame, &self.monitors);
        Run { record: self.record, rounds: self.watcher.map(Watcher::finish).unwrap_or_default(), summary }
    }

    fn watch_round(&mut self, tick: u32) {
        if let Some(watcher) = &mut self.watcher
            && tick.is_multiple_of(self.scenario.ticks_per_round())
        {
            watcher.watch(tick, &self.frame, self.scenario.radius_m, &self.malicious);
        }
    }
}

/// Fills the desired velocities of `tick`.
pub fn want<const D: usize>(scenario: &Scenario, tick: u32, frame: &mut Frame<D>) {
    let time_s = f64::from(tick) * scenario.tick_s();
    for (index, (desired, position)) in frame.desired_m_s.iter_mut().zip(&frame.positions_m).enumerate() {
        let number = u16::try_from(index + 1).unwrap_or(u16::MAX);
        *desired = match scenario.desired {
            Desired::Wander => Desired::wandering(scenario.seed, number, time_s),
            motion => motion.desired(number, scenario.robots, position),
        };
    }
}
