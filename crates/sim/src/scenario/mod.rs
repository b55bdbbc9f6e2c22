//! What to run, as plain data that was checked.

pub mod absences;
mod derived;
pub mod desired;
pub(crate) mod inline;
pub mod liars;
pub mod obstacles;
pub mod ranks;
pub mod route;
mod scatter;

pub mod start;
pub(crate) mod turn;

use closeranks_core::num::Vector;
use closeranks_core::settings::{
    self, BudgetSettings, Clock, ComposedSettings, Errors, LinkSettings, LinksSettings, Team,
};

use crate::attack::Attack;
pub use crate::consensus::{Consensus, Rule};
use crate::controllers::Amid;
pub use crate::controllers::Controller;
use crate::faults::Faults;
use crate::law::Law;
use crate::plant::Plant;
use crate::scenario::absences::Absence;
use crate::scenario::desired::Desired;
use crate::scenario::obstacles::Obstacles;
use crate::scenario::ranks::Ranking;
use crate::scenario::start::{Start, StartError};

/// One run, complete. [`crate::parse::scenario`] makes it from TOML and checks every field.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Name for tables and files.
    pub name: String,
    /// Length of the run, s.
    pub duration_s: f64,
    /// Seed of every random draw.
    pub seed: u64,
    /// 2 or 3.
    pub dimension: usize,
    /// Who is in the team: n and F.
    pub team: Team,
    /// Ranks, which tell who counts for whom; without them everybody counts for everybody.
    pub ranks: Option<Ranking>,
    /// Malicious robots by number, from 1, ascending.
    pub malicious: Vec<u16>,
    /// When robots of the roster are not in the plane, by robot and time.
    pub absences: Vec<Absence>,
    /// What a link is.
    pub link: LinkSettings,
    /// What no controller may exceed.
    pub limits: Limits,
    /// Which controller stands between desired and applied velocity.
    pub controller: Controller,
    /// Parameters of `composed`. They are there for every controller: the same scenario can be run under another one, and φ
    /// of any run can be recorded.
    pub composed: ComposedSettings,
    /// Parameters of `budget`.
    pub budget: BudgetSettings,
    /// Parameters of `links`.
    pub links: LinksSettings,
    /// Controllers of others: α of their barriers, 1/s, and the horizon of `orca`, s, if they are not to be those of the table.
    pub tuning: [Option<f64>; 2],
    /// When things happen, and how old they may be: the tick τ₁, its multiple τ₂, and ages.
    pub clock: Clock,
    /// Stated bounds of errors.
    pub errors: Errors,
    /// Where robots start.
    pub start: Start,
    /// By how much all of the start is moved, m, one number a dimension; empty where it is not.
    pub start_at_m: Vec<f64>,
    /// How values are updated.
    pub consensus: Consensus,
    /// y_i(t₀).
    pub values: Values,
    /// What stands in the way.
    pub obstacles: Obstacles,
    /// Where robots want to go.
    pub desired: Desired,
    /// What malicious robots do.
    pub attack: Attack,
    /// How robots follow their velocities.
    pub plant: Plant,
    /// What goes wrong.
    pub faults: Faults,
    /// Laws that the run must not break.
    pub expect: Vec<Law>,
    /// Several teams in one space, each as a scenario of its own; empty for a single team. Team, malicious robots and start are then those of
    /// all teams together, one team after another.
    pub teams: Vec<Self>,
    /// How many robots of other teams are in the same space, for one of several teams.
    pub strangers: u16,
}

/// Initial values y_i(t₀).
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Each robot's value is drawn evenly from the interval.
    Random {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
    },
    /// The value of each robot is listed.
    Listed(Vec<f64>),
    /// The numbers of the value of each robot are listed.
    Points(Vec<Vec<f64>>),
}

/// What no controller may exceed, in a number of dimensions that is known when the scenario is read.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// Δ_d, m.
    pub distance_min_m: f64,
    /// Lower corner of U_i, m/s, one number a dimension.
    pub input_min_m_s: Vec<f64>,
    /// Upper corner of U_i, m/s.
    pub input_max_m_s: Vec<f64>,
    /// Greatest speed, m/s; infinite for the box alone.
    pub speed_max_m_s: f64,
    /// How near a robot may come to an obstacle, m.
    pub clearance_m: f64,
}

impl Default for Limits {
    fn default() -> Self {
        let settings::Limits { distance_min_m, input, clearance_m } = settings::Limits::<2>::default();
        Self {
            distance_min_m,
            input_min_m_s: input.min_m_s.to_vec(),
            input_max_m_s: input.max_m_s.to_vec(),
            speed_max_m_s: input.speed_max_m_s,
            clearance_m,
        }
    }
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            name: "scenario".into(),
            duration_s: 10.0,
            seed: 1,
            dimension: 2,
            team: Team::default(),
            ranks: None,
            malicious: vec![1, 2],
            absences: Vec::new(),
            link: LinkSettings::default(),
            limits: Limits::default(),
            controller: Controller::Composed,
            composed: ComposedSettings::default(),
            budget: BudgetSettings::default(),
            links: LinksSettings::default(),
            tuning: [None; 2],
            clock: Clock::default(),
            errors: Errors::default(),
            start: Start::Inside,
            start_at_m: Vec::new(),
            consensus: Consensus::default(),
            values: Values::Random { min: -500.0, max: 500.0 },
            obstacles: Obstacles::default(),
            desired: Desired::Paper,
            attack: Attack::default(),
            plant: Plant::Single,
            faults: Faults::default(),
            expect: Law::EXPECTED.to_vec(),
            teams: Vec::new(),
            strangers: 0,
        }
    }
}

impl Scenario {
    /// Number of steps of τ₁ in the run; the record has one row more.
    #[must_use]
    pub fn ticks(&self) -> u32 {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturates, and is checked in parse"
        )]
        let ticks = (self.duration_s / self.clock.level_period.as_secs_f64()).round() as u32;
        ticks
    }

    /// Ticks between consensus rounds, at least 1.
    #[must_use]
    pub fn ticks_per_round(&self) -> u32 {
        let ratio = self.clock.value_period.as_nanos() / self.clock.level_period.as_nanos().max(1);
        u32::try_from(ratio).unwrap_or(u32::MAX).max(1)
    }

    /// True when nothing goes wrong and every liar tells all the same, so that robots may be computed at once.
    ///
    /// Bodies that do not follow their velocities make no difference to robots that know nothing but what they sense in a tick.
    /// A robot whose controller guarantees something compares where it senses itself with where its last velocity should have
    /// taken it, and promises nothing where the two differ; only single robots keep that account.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        let followed = self.plant.follows() || !self.controller.row().guarantees;
        let alone = self.absences.is_empty() && self.strangers == 0;
        self.faults.is_none() && alone && self.attack.is_plain() && followed && !self.obstacles.cut_links()
    }

    /// This scenario under another controller. If it expects what is usual for its own controller, it then expects what is
    /// usual for the other one.
    #[must_use]
    pub fn under(self, controller: Controller) -> Self {
        let usual = self.usual(self.controller);
        let expect = if self.expect == usual { self.usual(controller) } else { self.expect };
        let teams = self.teams.into_iter().map(|team| team.under(controller)).collect();
        Self { controller, expect, teams, ..self }
    }

    /// The laws that a run under `controller` is expected to keep if the scenario names none.
    pub(crate) fn usual(&self, controller: Controller) -> Vec<Law> {
        let row = controller.row();
        let kept = |law: &Law| *law != Law::Clear && law.is_kept_by(&self.consensus);
        let clear = Some(Law::Clear).filter(|_| !self.obstacles.list.is_empty() && row.amid == Amid::Avoids);
        row.expects.iter().copied().filter(kept).chain(clear).collect()
    }

    /// Why the controller is not run among the obstacles of the scenario, if it is not.
    #[must_use]
    pub fn refuses_obstacles(&self) -> Option<String> {
        let refuses = !self.controller.row().runs_among_obstacles() && !self.obstacles.list.is_empty();
        refuses
            .then(|| format!("under controller \"{}\", which does not know of any", self.controller.name()))
    }

    /// Why the controller is not run where obstacles cut links, if it is not.
    #[must_use]
    pub fn refuses_cuts(&self) -> Option<String> {
        let refuses = !self.controller.row().runs_among_cuts() && self.obstacles.cut_links();
        let name = self.controller.name();
        refuses.then(|| {
            format!("under controller \"{name}\", which has no row that keeps a link from being cut")
        })
    }

    /// Why the controller is not run among robots of other teams, if it is not.
    #[must_use]
    pub fn refuses_strangers(&self) -> Option<String> {
        let refuses = !self.controller.row().runs_among_strangers() && self.strangers > 0;
        refuses.then(|| {
            format!(
                "under controller \"{}\", which has no row for robots of other teams",
                self.controller.name()
            )
        })
    }

    /// τ₁ in seconds.
    #[must_use]
    pub fn tick_s(&self) -> f64 {
        self.clock.level_period.as_secs_f64()
    }

    /// Where the robots start, m.
    pub fn positions<const D: usize>(&self) -> Result<Vec<Vector<D>>, StartError> {
        let mut positions_m = self.start.positions::<D>(self.team.robots, self.seed)?;
        for (coordinate, by_m) in positions_m.iter_mut().flat_map(|x| x.iter_mut().zip(&self.start_at_m)) {
            *coordinate += by_m;
        }
        Ok(positions_m)
    }

    /// Each team: of one alone the scenario itself.
    #[must_use]
    pub fn each_team(&self) -> &[Self] {
        if self.teams.is_empty() { core::slice::from_ref(self) } else { &self.teams }
    }

    /// Which of several teams robot `index` is of, both counted from 0; 0 where there is one team.
    #[must_use]
    pub fn team_of(&self, index: usize) -> usize {
        let mut robots = 0;
        let is_of = |team: &Self| {
            robots += usize::from(team.team.robots);
            index < robots
        };
        self.teams.iter().position(is_of).unwrap_or(0)
    }

    /// Which robots are malicious, by index from 0.
    #[must_use]
    pub fn malicious_mask(&self) -> Vec<bool> {
        (1..=self.team.robots).map(|robot| self.malicious.contains(&robot)).collect()
    }
}
