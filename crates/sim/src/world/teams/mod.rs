//! Several teams in one space: a world for each, in step. Robots of a team see those of others and keep their distance; links, degrees and
//! values are those of each team alone.

mod join;
mod together;

use core::ops::Range;
use std::sync::Arc;

use closeranks_core::num::Vector;

use crate::attack::MotionAttack;
use crate::engine::workers::Workers;
use crate::frame::{Frame, Strangers};
use crate::law::Verdicts;
use crate::monitors::carry::between::Between;
use crate::monitors::robustness::{ROUNDS_MAX, Round, thin};
use crate::monitors::truth::Truth;
use crate::output::digest::Digest;
use crate::output::record::Record;
use crate::output::snapshot::Snapshot;
use crate::scenario::Scenario;
use crate::transport::Bytes;
use crate::world::given::{Given, GivenError};
use crate::world::{Options, Run, RunError, TeamRun, World};

/// The teams of a scenario in their space. Robots are numbered through, one team after another.
pub struct Teams<const D: usize> {
    scenario: Scenario,
    worlds: Vec<World<D>>,
    /// The robots of each team.
    places: Vec<Range<usize>>,
    /// What each robot of each team told in the last tick.
    told: Vec<Vec<Option<Bytes>>>,
    /// All teams in one frame, their true state, and F′ of each robot.
    frame: Frame<D>,
    truth: Truth,
    required: Vec<u16>,
    between: Between<D>,
    verdicts: Verdicts,
    record: Option<Record>,
    digest: Option<Digest>,
    rounds: Vec<Round>,
    team_rounds: Vec<Vec<Round>>,
    /// Where robots were in the last tick, if the next one is prepared.
    prepared: Option<Vec<Vector<D>>>,
}

/// The seed of one of several teams, counted from 0, in a run with `seed`. The first has that of the run.
#[must_use]
pub(crate) fn seed_of(seed: u64, team: u64) -> u64 {
    (seed ^ team.wrapping_mul(0x9e37_79b9_7f4a_7c15)) >> u32::from(team > 0)
}

/// Each of several teams as a scenario of its own, with its seed.
pub(crate) fn each(scenario: &Scenario) -> impl Iterator<Item = Scenario> {
    let alone =
        |(team, number): (&Scenario, u64)| Scenario { seed: seed_of(scenario.seed, number), ..team.clone() };
    scenario.teams.iter().zip(0..).map(alone)
}

impl<const D: usize> Teams<D> {
    /// The teams of `scenario`, which must be of `D` dimensions, before their first tick.
    pub fn new(scenario: &Scenario, options: Options) -> Result<Self, RunError> {
        let alone = Options { record: false, digest: false, ..options };
        let worlds: Result<Vec<World<D>>, RunError> =
            each(scenario).map(|team| World::new(&team, alone)).collect();
        let worlds = worlds?;
        let places = ranges(worlds.iter().map(|world| world.frame.positions_m.len()));
        let frame = join::frame(worlds.iter().map(|world| &world.frame));
        let params = worlds.first().ok_or(RunError::Teams)?.params;
        let teams: Vec<usize> =
            places.iter().enumerate().flat_map(|(team, place)| place.clone().map(move |_| team)).collect();
        let gamma_c = worlds.iter().map(|world| world.params.kept().gamma_c).fold(0.0, f64::max);
        let free = scenario.teams.iter().any(moves_freely);
        let of = |world: &World<D>| vec![world.monitors.required_degree(); world.frame.positions_m.len()];
        let required: Vec<u16> = worlds.iter().flat_map(of).collect();
        let least = required.iter().copied().min().unwrap_or(0);
        let mut all = Self {
            between: Between::new(scenario, params, teams, gamma_c, free),
            told: vec![Vec::new(); worlds.len()],
            team_rounds: vec![Vec::new(); worlds.len()],
            record: options.record.then(|| Record::new(scenario, least)),
            digest: options.digest.then(Digest::default),
            scenario: scenario.clone(),
            truth: Truth::default(),
            verdicts: Verdicts::default(),
            rounds: Vec::new(),
            prepared: None,
            worlds,
            places,
            frame,
            required,
        };
        (0..all.worlds.len()).for_each(|team| all.introduce(team));
        Ok(all)
    }

    /// Lends whoever computes a large team from now on.
    pub fn employ(&mut self, workers: &Arc<dyn Workers>) {
        self.worlds.iter_mut().for_each(|world| world.employ(Arc::clone(workers)));
    }

    /// How many ticks were computed.
    #[must_use]
    pub fn ticks_done(&self) -> u32 {
        self.worlds.first().map_or(0, World::ticks_done)
    }

    /// True once the last tick of the scenario was computed.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.worlds.iter().all(World::is_over)
    }

    /// What the last tick came to, of all teams.
    #[must_use]
    pub fn frame(&self) -> &Frame<D> {
        &self.frame
    }

    /// What became of the laws up to the last tick, of each team by itself and of robots of different teams.
    #[must_use]
    pub fn verdicts(&self) -> &Verdicts {
        &self.verdicts
    }

    /// The last tick as whoever watches the run sees it; none before the first one.
    #[must_use]
    pub fn snapshot(&self) -> Option<Snapshot<'_>> {
        let tick = self.ticks_done().checked_sub(1)?;
        let least = self.required.iter().copied().min().unwrap_or(0);
        let now = Snapshot::new(tick, self.scenario.tick_s(), least, &self.frame, &self.truth);
        Some(now.of_teams(&self.required))
    }

    /// As [`World::prepare`].
    pub fn prepare(&mut self) -> &Frame<D> {
        if self.prepared.is_none() {
            let last_m = self.frame.positions_m.clone();
            self.begin();
            self.prepared = Some(last_m);
            self.join();
        }
        &self.frame
    }

    /// Computes the next tick.
    pub fn step(&mut self) -> &Frame<D> {
        self.begin();
        self.end();
        &self.frame
    }

    /// As [`World::step_with`]; arrays have one entry for each robot of all teams.
    pub fn step_with(&mut self, given: &Given<'_, D>) -> Result<&Frame<D>, GivenError> {
        self.check(given)?;
        self.begin();
        for (world, place) in self.worlds.iter_mut().zip(&self.places) {
            world.give(&Given {
                desired_m_s: given.desired_m_s.map(|all| &all[place.clone()]),
                levels: given.levels.map(|all| &all[place.clone()]),
                values: given.values.map(|all| &all[place.clone()]),
            });
        }
        self.end();
        Ok(&self.frame)
    }

    /// Whether what is `given` is refused.
    pub(crate) fn check(&self, given: &Given<'_, D>) -> Result<(), GivenError> {
        given.check(self.frame.positions_m.len())
    }

    /// Moves everybody to the next tick. Whoever comes meets those of other teams where they are by now.
    fn begin(&mut self) {
        if self.prepared.take().is_some() {
            return;
        }
        self.worlds.iter_mut().for_each(World::integrate);
        for team in 0..self.worlds.len() {
            self.introduce(team);
            self.worlds[team].enter();
        }
        (0..self.worlds.len()).for_each(|team| self.introduce(team));
    }

    fn end(&mut self) {
        let tick = self.ticks_done();
        for world in &mut self.worlds {
            world.ask();
            world.compute();
        }
        for (told, world) in self.told.iter_mut().zip(&mut self.worlds) {
            *told = world.robots.told();
        }
        self.worlds.iter_mut().for_each(|world| world.judge(false));
        (0..self.worlds.len()).for_each(|team| self.introduce(team));
        for world in &mut self.worlds {
            world.watch(None);
            world.note();
        }
        self.join();
        self.between.watch(tick, &self.frame);
        self.verdicts = together::verdicts(
            &self.worlds.iter().map(World::verdicts).zip(&self.places),
            self.between.verdicts(),
        );
        if let Some(digest) = &mut self.digest {
            digest.watch(&self.frame);
        }
        self.record();
        self.take_all_rounds();
    }

    /// Shows a team where the robots of all others are, and what they told.
    fn introduce(&mut self, team: usize) {
        let mut strangers = core::mem::take(&mut self.worlds[team].frame.strangers);
        let Strangers { positions_m, references_m, disobedient, dismissed, told } = &mut strangers;
        positions_m.clear();
        references_m.clear();
        disobedient.clear();
        dismissed.clear();
        told.clear();
        for (other, world) in self.worlds.iter().enumerate().filter(|(other, _)| *other != team) {
            positions_m.extend_from_slice(&world.frame.positions_m);
            references_m.extend_from_slice(&world.frame.references_m);
            let free = moves_freely(&world.scenario);
            disobedient.extend(world.monitors.malicious().iter().map(|malicious| free && *malicious));
            dismissed.extend_from_slice(&world.frame.presence.dismissed);
            told.extend_from_slice(&self.told[other]);
        }
        self.worlds[team].frame.strangers = strangers;
    }

    /// Puts what each team knows of the tick together.
    fn join(&mut self) {
        self.frame = join::frame(self.worlds.iter().map(|world| &world.frame));
        self.truth = join::truth(self.worlds.iter().map(|world| world.monitors.truth()));
    }

    fn record(&mut self) {
        let Some(mut record) = self.record.take() else { return };
        if let Some(now) = self.snapshot() {
            record.push(&now);
        }
        self.record = Some(record);
    }

    /// Of each round the least of all teams.
    fn take_all_rounds(&mut self) {
        let taken: Vec<Vec<Round>> = self.worlds.iter_mut().map(World::take_rounds).collect();
        self.rounds.extend(together::rounds(&taken));
        for (rounds, taken) in self.team_rounds.iter_mut().zip(taken) {
            rounds.extend(taken);
            if rounds.len() > ROUNDS_MAX {
                thin(rounds);
            }
        }
        if self.rounds.len() > ROUNDS_MAX {
            thin(&mut self.rounds);
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

    /// As [`World::has_many_rounds`].
    pub(crate) fn has_many_rounds(&self) -> bool {
        self.rounds.len() >= ROUNDS_MAX / 2
    }

    /// As [`World::take_rounds`].
    pub(crate) fn take_rounds(&mut self) -> Vec<Round> {
        core::mem::take(&mut self.rounds)
    }

    /// Ends the run: what the teams came to together, and each by itself.
    #[must_use]
    pub fn finish(mut self) -> Run {
        if let Some(last_m) = self.prepared.take() {
            for (world, place) in self.worlds.iter_mut().zip(&self.places) {
                world.frame.positions_m.copy_from_slice(&last_m[place.clone()]);
            }
            self.frame.positions_m = last_m;
        }
        let least_m = closeranks_core::num::sqrt(self.between.least_m2());
        let summaries = self.worlds.into_iter().map(|world| world.finish().summary);
        let teams: Vec<TeamRun> =
            summaries.zip(self.team_rounds).map(|(summary, rounds)| TeamRun { summary, rounds }).collect();
        let summary =
            together::summary(&self.scenario, &teams, &self.places, &self.frame, least_m, &self.verdicts);
        Run {
            record: self.record,
            digest: self.digest.map(Digest::value),
            rounds: self.rounds,
            summary,
            teams,
        }
    }
}

/// True if the malicious robots of a team move as they like.
fn moves_freely(team: &Scenario) -> bool {
    team.attack.motion != MotionAttack::Obedient
}

/// Where the robots of teams of so many are, one team after another.
fn ranges(robots: impl Iterator<Item = usize>) -> Vec<Range<usize>> {
    let next = robots.scan(0, |next, robots| {
        let first = core::mem::replace(next, *next + robots);
        Some(first..*next)
    });
    next.collect()
}
