//! The simulated plant: bodies of all robots in real time, and the simulator's monitors beside them.
//!
//! Time is divided into ticks of τ₁. At the beginning of a tick every robot gets a look at where it and the robots in sight are at
//! that time. It has until the end of the tick to report a velocity, with which its body moves through the next step. A body whose
//! velocity does not come in time stands still, as a base does whose watchdog fires. So robots that are late, lost or dead are
//! part of the world, and what the theorem says of discrete time holds here for processes on a real clock.

use core::time::Duration;
use std::sync::Arc;

use closeranks_core::{Instant, Mode, Outcome, Params, RobotId};
use closeranks_sim::attack::{Attack, MotionAttack};

use closeranks_sim::faults::edges::Edges;
use closeranks_sim::frame::Frame;
use closeranks_sim::geometry::squared_distance;
use closeranks_sim::monitors::Monitors;
use closeranks_sim::output::snapshot::Snapshot;
use closeranks_sim::output::summary::{Collector, Summary};
use closeranks_sim::plant::Bodies;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{RunError, initial_values};

use crate::clock::next_round;
use crate::gate::{Gate, Reject};
use crate::identity::roster::Roster;
use crate::node::pilot::limits;
use crate::wire::envelope::Purpose;
use crate::wire::report::Report;
use crate::wire::sensed::Sensed;

/// The rounding of a position is smaller than this, m.
const STILL_M: f64 = 1e-9;

/// All bodies.
pub struct World<const D: usize> {
    scenario: Scenario,
    params: Params<D>,
    gate: Gate,
    roster: Arc<Roster>,
    frame: Frame<D>,
    bodies: Bodies<D>,
    edges: Edges<D>,
    monitors: Monitors<D>,
    collector: Collector,
    malicious: Vec<bool>,
    /// What each robot reported for this tick.
    reports: Vec<Option<Report<D>>>,
    /// The newest report of each robot, whenever that was.
    newest: Vec<Option<(Instant, Report<D>)>>,
    start: Instant,
    /// The number of this tick; `None` before the first.
    tick: Option<u32>,
    /// How many reports of normal robots did not come in time.
    late: u64,
}

impl<const D: usize> World<D> {
    /// The world of `scenario` for the robots of `roster`. Its first tick begins at `start`.
    pub fn new(scenario: &Scenario, roster: Arc<Roster>, start: Instant) -> Result<Self, RunError> {
        if scenario.dimension != D {
            return Err(RunError::Dimension(scenario.dimension));
        }
        let params = scenario.params::<D>()?;
        let frame =
            Frame { wants_phi: false, ..Frame::new(scenario.positions()?, initial_values(scenario)?) };
        let robots = frame.positions_m.len();
        Ok(Self {
            gate: Gate::new(Arc::clone(&roster), Purpose::Report, None, limits(&params)),
            roster,
            bodies: Bodies::new(scenario.plant, scenario.tick_s(), &frame.positions_m),
            edges: Edges::new(scenario, &params),
            monitors: Monitors::new(scenario, params),
            collector: Collector::default(),
            malicious: scenario.malicious_mask(),
            reports: vec![None; robots],
            newest: vec![None; robots],
            scenario: scenario.clone(),
            params,
            frame,
            start,
            tick: None,
            late: 0,
        })
    }

    /// When the tick that is on, or will be first, began.
    #[must_use]
    pub fn began(&self) -> Instant {
        self.start.after(self.period() * self.tick.unwrap_or(0))
    }

    /// Lets the first tick begin with the first round after `now`. Nothing changes once there was a tick.
    pub fn start_at(&mut self, now: Instant) {
        if self.tick.is_none() {
            self.start = next_round(now, self.params.settings().clock.value_period);
        }
    }

    /// When the next tick is to begin.
    #[must_use]
    pub fn next_begins(&self) -> Instant {
        self.tick.map_or(self.start, |_| self.began().after(self.period()))
    }

    /// τ₁.
    #[must_use]
    pub fn period(&self) -> Duration {
        self.params.settings().clock.level_period
    }

    /// Begins the next tick and gives each robot its look, in the order of their numbers.
    pub fn begin_tick(&mut self) -> Vec<Sensed<D>> {
        if self.tick.is_some() {
            self.bodies.integrate(&mut self.frame.positions_m, &self.frame.velocities_m_s);
        }
        self.tick = Some(self.tick.map_or(0, |tick| tick.saturating_add(1)));
        self.reports.fill(None);
        let time_s = f64::from(self.tick.unwrap_or(0)) * self.scenario.tick_s();
        self.edges.begin_tick(self.tick(), time_s, &self.frame.positions_m, &self.frame.presence);
        (0..self.frame.positions_m.len()).map(|observer| self.look(observer)).collect()
    }

    fn look(&mut self, observer: usize) -> Sensed<D> {
        let at = self.began();
        let radius_m = self.params.link().radius_m;
        let sight_m2 = self.params.sight_m2().max(radius_m * radius_m);
        let positions_m = &self.frame.positions_m;
        let Edges { senses, sight, .. } = &mut self.edges;
        let own = &positions_m[observer];
        let own_m = senses.sense(observer, observer, own);
        let mut others = Vec::new();
        for (index, position_m) in positions_m.iter().enumerate() {
            let within = squared_distance(own, position_m) <= sight_m2;
            if index != observer && sight.senses((observer, own), index, within) {
                let sensed = senses.sense(observer, index, position_m);
                sight.note((observer, index), position_m, &sensed);
                others.push((id(index), sensed));
            }
        }
        Sensed { at, own_m, others }
    }

    /// Takes the bytes of a report that arrived at `now`; it counts for this tick if it was made of its look.
    pub fn take(&mut self, now: Instant, bytes: &[u8]) -> Result<RobotId, Reject> {
        let envelope = self.gate.take(now, bytes)?;
        let id = envelope.id;
        let Some(report) = Report::<D>::parse(envelope.payload) else {
            self.gate.reject(id, Reject::Payload);
            return Err(Reject::Payload);
        };
        let index = usize::from(id.0) - 1;
        if self.tick.is_some() && report.at == self.began() {
            self.reports[index] = Some(report.clone());
        }
        self.newest[index] = Some((now, report));
        Ok(id)
    }

    /// True if every robot has reported at some time.
    #[must_use]
    pub fn all_are_there(&self) -> bool {
        self.newest.iter().all(Option::is_some)
    }

    /// True if every robot has reported for this tick.
    #[must_use]
    pub fn all_have_reported(&self) -> bool {
        self.reports.iter().all(Option::is_some)
    }

    /// Ends the tick and looks at it. Bodies move by what was reported in time when the next one begins, so that positions and velocities
    /// of a frame belong together.
    pub fn end_tick(&mut self) {
        let tick = self.tick.unwrap_or(0);
        if tick.is_multiple_of(self.scenario.ticks_per_round()) {
            self.frame.heard.fill([0; 2]);
            self.frame.listened.fill([0; 2]);
        }
        for index in 0..self.reports.len() {
            self.fill(index);
        }
        self.judge();
        self.monitors.watch(tick, &self.frame);
        self.collector.watch(&self.scenario, &self.frame, &self.monitors);
    }

    fn fill(&mut self, index: usize) {
        let (frame, malicious) = (&mut self.frame, &self.malicious);
        frame.down[index] = self.reports[index].is_none();
        let Some(report) = &self.reports[index] else {
            frame.velocities_m_s[index] = [0.0; D];
            frame.modes[index] = Mode::Stopped;
            frame.outcomes[index] = Outcome::Free;
            // It may have decided all the same, and counted on others than before: nothing is held against what is not known.
            frame.counted[index].clear();
            self.late += u64::from(!malicious[index]);
            return;
        };
        let input = self.params.settings().limits.input;
        // A base does not move faster than it can, whatever a liar asks of it.
        let velocity = report.velocity_m_s;
        frame.velocities_m_s[index] = if malicious[index] { input.clip(&velocity) } else { velocity };
        frame.desired_m_s[index] = report.desired_m_s;
        frame.asked_m_s[index] = report.desired_m_s;
        frame.degrees[index] = report.degree;
        frame.levels[index] = report.level;
        frame.told[index] = report.told;
        frame.h[index] = report.h;
        frame.values[index] = report.value;
        frame.held[index] = report.held;
        frame.counted[index] = report.counted.iter().map(|id| id.0).collect();
        frame.rows[index] = report.rows.iter().map(|id| id.0).collect();
        let Attack { level, value, .. } = &self.scenario.attack;
        frame.one_level[index] = !malicious[index] || level.is_alike_for_all();
        frame.one_value[index] = frame.one_level[index] && (!malicious[index] || value.is_alike_for_all());
        frame.outcomes[index] = report.outcome;
        // The law of modes knows only robots that want something, or stand.
        frame.modes[index] = if report.mode == Mode::Hold { Mode::Stopped } else { report.mode };
        if !report.heard.is_empty() {
            let lies = |id: &RobotId| malicious.get(usize::from(id.0).wrapping_sub(1)) == Some(&true);
            let (own, need) = (self.roster.member(id(index)), self.params.need());
            let counts = |other: &&RobotId| need.counts(own, self.roster.member(**other));
            let (all, counted) = (&report.heard, report.heard.iter().filter(counts));
            let small = |count: usize| u16::try_from(count).unwrap_or(u16::MAX);
            frame.heard[index] =
                [small(counted.clone().count()), small(counted.filter(|other| !lies(other)).count())];
            frame.listened[index] = [small(all.len()), small(all.iter().filter(|other| lies(other)).count())];
        }
    }

    /// Which assumptions hold, as only the world can know.
    fn judge(&mut self) {
        let settings = self.params.settings();
        let away_m = self.params.kept().errors.away_m;
        let frame = &mut self.frame;
        let normal_missing =
            self.reports.iter().zip(&self.malicious).any(|(report, liar)| report.is_none() && !liar);
        frame.assumptions.unsteady = normal_missing;
        frame.assumptions.renewed = false;
        for (index, wrong) in frame.assumptions.sensed_wrong.iter_mut().enumerate() {
            let error_m = self.edges.senses.error_m(index);
            *wrong = error_m > settings.errors.position_m + STILL_M || self.edges.sight.overlooks(index);
        }
        for (index, unsensed) in frame.assumptions.unsensed.iter_mut().enumerate() {
            *unsensed = self.edges.sight.misses(index);
        }
        frame.references_m.clone_from(&frame.positions_m);
        let mut away = false;
        if away_m > 0.0 {
            for (index, report) in self.reports.iter().enumerate() {
                frame.assumptions.renewed |= report.as_ref().is_none_or(|report| report.began_anew);
                let Some(report) = report.as_ref().filter(|_| !self.malicious[index]) else { continue };
                frame.references_m[index] = report.reference_m;
                let away_m2 = squared_distance(&report.reference_m, &frame.positions_m[index]);
                away |= away_m2 > away_m * away_m + STILL_M;
            }
        }
        let obedient = self.params.controller().is_obeyed();
        let disobeyed = obedient
            && self.scenario.attack.motion != MotionAttack::Obedient
            && !self.scenario.malicious.is_empty();
        frame.assumptions.broken =
            disobeyed || away || frame.assumptions.renewed || frame.assumptions.sensed_wrong.contains(&true);
    }

    /// The state after the last tick.
    #[must_use]
    pub fn frame(&self) -> &Frame<D> {
        &self.frame
    }

    /// The tick that ended as whoever watches the run sees it.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot<'_> {
        self.monitors.snapshot(self.tick(), self.scenario.tick_s(), &self.frame)
    }

    /// The number of the tick that is on.
    #[must_use]
    pub fn tick(&self) -> u32 {
        self.tick.unwrap_or(0)
    }

    /// The newest report of each robot, and when it came.
    #[must_use]
    pub fn reports(&self) -> &[Option<(Instant, Report<D>)>] {
        &self.newest
    }

    /// How many reports of normal robots did not come in time.
    #[must_use]
    pub fn late(&self) -> u64 {
        self.late
    }

    /// The laws as they stand.
    #[must_use]
    pub fn monitors(&self) -> &Monitors<D> {
        &self.monitors
    }

    /// What it came to.
    #[must_use]
    pub fn finish(self) -> Summary {
        self.collector.finish(&self.scenario, &self.frame, &self.monitors)
    }
}

fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap_or(u16::MAX))
}
