//! The world: one tick after another, and a run as the loop over it.

pub mod any;
pub mod block;
mod door;
pub mod given;
mod lane;
mod outcome;
mod script;
pub mod teams;
pub mod together;

use std::sync::Arc;

use closeranks_core::num::Vector;
use closeranks_core::program::Outcome;
use closeranks_core::settings::params::Params;

use crate::attack::liars::Liars;
use crate::consensus::exchange::Exchange;
use crate::controllers::{Answer, Global, TeamView, Velocities};
use crate::engine;
pub use crate::engine::Engine;
use crate::engine::judge::Judge;
use crate::engine::phi::PaperPhi;
use crate::engine::robots::Robots;
use crate::engine::workers::{Alone, Workers};
use crate::frame::Frame;
use crate::law::Verdicts;
use crate::monitors::Monitors;
use crate::monitors::glance::Glance;
use crate::monitors::robustness::{Round, Watcher};
use crate::output::digest::Digest;
use crate::output::record::Record;
use crate::output::snapshot::Snapshot;
use crate::output::summary::{Collector, Summary};
use crate::plant::Bodies;
use crate::scenario::Scenario;
use crate::world::any::AnyWorld;
use crate::world::door::Door;
use crate::world::given::{Given, GivenError};
pub use crate::world::outcome::{Options, Run, RunError, TeamRun};
use crate::world::script::{first_frame, rest};
pub use crate::world::script::{initial_numbers, initial_values, want};

/// Runs `scenario` from the first tick to the last. `progress` is called before each tick with its number.
pub fn run(scenario: &Scenario, options: Options, progress: &mut dyn FnMut(u32)) -> Result<Run, RunError> {
    let mut world = AnyWorld::new(scenario, options)?;
    while !world.is_over() {
        progress(world.ticks_done());
        world.step();
    }
    Ok(world.finish())
}

/// A team in its world.
///
/// [`step`](Self::step) computes one tick; [`frame`](Self::frame) is what it came to. Robots move at the beginning of the next
/// step, so that positions and velocities of a frame belong together. A world can be stepped beyond the last tick of
/// its scenario.
///
/// ```
/// use closeranks_sim::scenario::Scenario;
/// use closeranks_sim::world::{Options, World};
///
/// let mut world = World::<2>::new(&Scenario::default(), Options::default())?;
/// for _ in 0..200 {
///     world.step();
/// }
/// assert!(world.frame().h.iter().all(|h| *h > 0.0));
/// # Ok::<(), closeranks_sim::world::RunError>(())
/// ```
pub struct World<const D: usize> {
    scenario: Scenario,
    params: Params<D>,
    robots: Box<dyn Robots<D>>,
    workers: Arc<dyn Workers>,
    exchange: Option<Exchange>,
    global: Option<Global>,
    answers: Vec<Answer<D>>,
    frame: Frame<D>,
    liars: Liars,
    bodies: Bodies<D>,
    door: Door<D>,
    judge: Judge,
    paper_phi: Option<PaperPhi>,
    monitors: Monitors<D>,
    collector: Collector,
    record: Option<Record>,
    digest: Option<Digest>,
    watcher: Option<Watcher>,
    /// Ticks computed yet.
    done: u32,
    /// Where robots were in the last tick, if the next one is prepared.
    prepared: Option<Vec<Vector<D>>>,
}

impl<const D: usize> World<D> {
    /// The world of `scenario`, which must be of `D` dimensions, before its first tick.
    pub fn new(scenario: &Scenario, options: Options) -> Result<Self, RunError> {
        if scenario.dimension != D {
            return Err(RunError::Dimension(scenario.dimension));
        }
        if !scenario.teams.is_empty() {
            return Err(RunError::Teams);
        }
        if let Some(why) = scenario.refuses_obstacles().or_else(|| scenario.refuses_cuts()) {
            return Err(RunError::Obstacles(why));
        }
        if let Some(why) = scenario.refuses_strangers() {
            return Err(RunError::Strangers(why));
        }
        let params = scenario.params::<D>()?;
        scenario.ranks::<D>()?;
        let values = initial_values(scenario)?;
        let wants_phi = scenario.controller.row().uses_phi || !options.without_phi;
        let mut frame = Frame { wants_phi, ..first_frame(scenario, &values)? };
        let door = Door::new(scenario, &params, &frame.positions_m);
        let bodies = Bodies::new(scenario.plant, scenario.tick_s(), &frame.positions_m);
        door.open(&mut frame);
        Ok(Self {
            bodies,
            door,
            params,
            robots: engine::robots(scenario, params, &frame, &values, options.engine)?,
            workers: Arc::new(Alone),
            exchange: Exchange::new(scenario, &initial_numbers(scenario)?),
            global: scenario.controller.global(&scenario.parameters()),
            answers: Vec::new(),
            liars: Liars::new(scenario),
            judge: Judge::new(scenario, &params),
            paper_phi: PaperPhi::new(scenario, &params).filter(|_| wants_phi),
            monitors: Monitors::new(scenario, params),
            collector: Collector::default(),
            record: options.record.then(|| Record::new(scenario, scenario.composition().required)),
            digest: options.digest.then(Digest::default),
            watcher: options.robustness.then(Watcher::default),
            scenario: scenario.clone(),
            frame,
            done: 0,
            prepared: None,
        })
    }

    /// Lends whoever computes a large team from now on. No bit of the run depends on it.
    pub fn employ(&mut self, workers: Arc<dyn Workers>) {
        self.workers = workers;
    }

    /// How many ticks were computed.
    #[must_use]
    pub fn ticks_done(&self) -> u32 {
        self.done
    }

    /// True once the last tick of the scenario was computed.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.done > self.scenario.ticks()
    }

    /// What the last tick came to; before the first one, where robots start.
    #[must_use]
    pub fn frame(&self) -> &Frame<D> {
        &self.frame
    }

    /// The last tick as whoever watches the run sees it; none before the first one.
    #[must_use]
    pub fn snapshot(&self) -> Option<Snapshot<'_>> {
        let tick = self.done.checked_sub(1)?;
        Some(self.monitors.snapshot(tick, self.scenario.tick_s(), &self.frame))
    }

    /// Where the bodies are, m: the axles of unicycles, whose positions are the points ahead of them.
    #[must_use]
    pub fn axles_m(&self) -> Vec<Vector<D>> {
        self.bodies.axles_m(&self.frame.positions_m)
    }

    /// What is run.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// What became of the laws, and least and greatest values, up to the last tick.
    #[must_use]
    pub fn monitors(&self) -> &Monitors<D> {
        &self.monitors
    }

    /// What became of the laws up to the last tick.
    #[must_use]
    pub fn verdicts(&self) -> &Verdicts {
        self.monitors.verdicts()
    }

    /// Moves robots to where the next tick finds them and asks where they want to go, for whoever gives velocities that depend on
    /// that. Positions and desired velocities of the frame then belong to the tick that the next step computes; everything else
    /// is still of the last one. A second call changes nothing, and the step gives the bits that it gives without.
    pub fn prepare(&mut self) -> &Frame<D> {
        if self.prepared.is_none() {
            let last_m = self.frame.positions_m.clone();
            self.begin();
            self.prepared = Some(last_m);
        }
        &self.frame
    }

    /// Computes the next tick.
    pub fn step(&mut self) -> &Frame<D> {
        self.begin();
        self.end()
    }

    /// Computes the next tick with what is `given` from outside instead of what the scenario says; refused if an array has another
    /// length than the team, or a number is not finite.
    pub fn step_with(&mut self, given: &Given<'_, D>) -> Result<&Frame<D>, GivenError> {
        given.check(self.frame.positions_m.len())?;
        self.begin();
        self.give(given);
        Ok(self.end())
    }

    /// Takes what is given in place of what the scenario says.
    fn give(&mut self, given: &Given<'_, D>) {
        if let Some(desired_m_s) = given.desired_m_s {
            self.frame.desired_m_s.copy_from_slice(desired_m_s);
        }
        self.liars.give(given.levels, given.values);
    }

    /// Moves everybody to the next tick and asks where they want to go.
    fn begin(&mut self) {
        if self.prepared.take().is_some() {
            return;
        }
        self.integrate();
        self.enter();
    }

    /// Moves bodies to the next tick.
    fn integrate(&mut self) {
        if self.done > 0 {
            self.bodies.integrate(&mut self.frame.positions_m, &self.frame.velocities_m_s);
        }
    }

    /// Lets robots come and leave, and asks everybody where they want to go.
    fn enter(&mut self) {
        self.door.begin_tick(self.done, &mut self.frame, &mut self.bodies);
        want(&self.scenario, self.done, &mut self.frame);
        self.liars.give(None, None);
    }

    fn end(&mut self) -> &Frame<D> {
        self.ask();
        self.compute();
        self.settle(false, None);
        self.note();
        &self.frame
    }

    /// Keeps of a tick what was asked for.
    fn note(&mut self) {
        let tick = self.done.saturating_sub(1);
        self.collector.watch(&self.scenario, &self.frame, &self.monitors);
        if let Some(record) = &mut self.record {
            let (tick_s, required) = (self.scenario.tick_s(), record.required_degree);
            record.push(&Snapshot::new(tick, tick_s, required, &self.frame, self.monitors.truth()));
        }
        self.watch_round(tick);
    }

    /// Lets all robots decide.
    fn compute(&mut self) {
        self.frame.collisions = None;
        self.robots.step(&mut self.frame, &mut self.liars, self.workers.as_ref());
    }

    /// What comes of it for the world: the rest of the frame, of which φ_i may be known, and the laws, if need be from a `glance` at
    /// the tick.
    fn settle(&mut self, knows_phi: bool, glance: Option<&Glance<'_>>) {
        self.judge(knows_phi);
        self.watch(glance);
    }

    /// The rest of the frame but for the laws.
    fn judge(&mut self, knows_phi: bool) {
        if let Some(exchange) = &mut self.exchange {
            exchange.step(self.done, &mut self.frame, self.robots.as_ref(), self.liars.given_values());
        }
        for (outcome, answer) in self.frame.outcomes.iter_mut().zip(&self.answers) {
            *outcome = answer.outcome;
        }
        if let Some(phi) = self.paper_phi.as_mut().filter(|_| !knows_phi) {
            let edges = self.robots.edges();
            phi.fill(&mut self.frame, |robot| edges.is_some_and(|edges| edges.downtime.down(robot)));
        }
        self.judge.judge(&mut self.frame, self.robots.as_ref(), &self.bodies);
    }

    /// Looks at the laws, and ends the tick.
    fn watch(&mut self, glance: Option<&Glance<'_>>) {
        self.monitors.watch_with(self.done, &self.frame, glance);
        let liars = self.monitors.malicious().iter().enumerate().filter(|(_, lies)| **lies);
        for (index, _) in liars {
            [self.frame.one_level[index], self.frame.one_value[index]] = self.liars.tells_alike(index);
        }
        if let Some(digest) = &mut self.digest {
            digest.watch(&self.frame);
        }
        self.done = self.done.saturating_add(1);
    }

    /// What robots are asked for: what they want, or what a controller with global state makes of it.
    fn ask(&mut self) {
        let Frame { desired_m_s, asked_m_s, positions_m, velocities_m_s, presence, .. } = &mut self.frame;
        rest(&presence.absent, desired_m_s);
        asked_m_s.copy_from_slice(desired_m_s);
        let reaches_m = [self.scenario.link.radius_m, self.scenario.limits.clearance_m];
        self.scenario.obstacles.turn(positions_m, reaches_m, asked_m_s);
        rest(&presence.absent, asked_m_s);
        let Some(global) = &mut self.global else { return };
        let nothing = Answer { velocity_m_s: [0.0; D], outcome: Outcome::Free };
        self.answers.resize(positions_m.len(), nothing);
        global.velocities(
            &TeamView {
                params: &self.params,
                positions_m,
                velocities_m_s,
                desired_m_s,
                tuning: self.scenario.tuning(),
            },
            &mut self.answers,
        );
        for (asked, answer) in asked_m_s.iter_mut().zip(&self.answers) {
            *asked = answer.velocity_m_s;
        }
    }

    /// The digest of every tick so far, if it was asked for.
    #[must_use]
    pub fn digest(&self) -> Option<u64> {
        self.digest.map(Digest::value)
    }

    /// What was recorded, if anything was asked for.
    pub(crate) fn record_mut(&mut self) -> Option<&mut Record> {
        self.record.as_mut()
    }

    /// Whether there are so many rounds that whoever wants each of them should take them.
    pub(crate) fn has_many_rounds(&self) -> bool {
        self.watcher.as_ref().is_some_and(Watcher::is_full)
    }

    /// Hands over the rounds since they were last taken, if they were asked for.
    pub(crate) fn take_rounds(&mut self) -> Vec<Round> {
        self.watcher.as_mut().map(Watcher::take).unwrap_or_default()
    }

    fn watch_round(&mut self, tick: u32) {
        if let Some(watcher) = &mut self.watcher
            && tick.is_multiple_of(self.scenario.ticks_per_round())
        {
            watcher.watch(tick, &self.frame, self.scenario.link.radius_m, self.monitors.malicious());
        }
    }

    /// Ends the run: the record, if one was asked for, and the row of the table. A tick that was only prepared is no part of it.
    #[must_use]
    pub fn finish(mut self) -> Run {
        if let Some(last_m) = self.prepared.take() {
            self.frame.positions_m = last_m;
        }
        let attendance = self.door.attendance();
        let summary = self.collector.finish(&self.scenario, &self.frame, &self.monitors);
        let summary = Summary { attendance, ..summary };
        let rounds = self.watcher.map(Watcher::finish).unwrap_or_default();
        Run {
            record: self.record,
            digest: self.digest.map(Digest::value),
            rounds,
            summary,
            teams: Vec::new(),
        }
    }
}
