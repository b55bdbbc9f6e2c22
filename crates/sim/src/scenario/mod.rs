//! What to run: plain data, checked.

pub mod desired;
mod scatter;
pub mod start;

use core::time::Duration;

use closeranks_core::controller::budget::knowledge::{Assume, Trust};
use closeranks_core::equations::barrier::required_degree;
use closeranks_core::equations::composition::{Composed, PhiSplit};
use closeranks_core::num::Vector;
use closeranks_core::program::InputBox;
use closeranks_core::settings::params::{Params, Settings};
use closeranks_core::settings::range::ParamsError;
use closeranks_core::settings::{
    BudgetSettings, Clock, ComposedSettings, Errors, Limits, LinkSettings, Team,
};

use crate::attack::Attack;
pub use crate::controllers::Controller;
use crate::faults::Faults;
use crate::law::Law;
use crate::plant::Plant;
use crate::scenario::desired::Desired;
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
    /// n.
    pub robots: u16,
    /// F.
    pub faults: u16,
    /// Malicious robots by number, from 1, ascending.
    pub malicious: Vec<u16>,
    /// R, m.
    pub radius_m: f64,
    /// ε, or the default for n.
    pub epsilon: Option<f64>,
    /// q₂, 1/m⁴.
    pub q2: f64,
    /// Which filter stands between desired and applied velocity.
    pub controller: Controller,
    /// Which φ_i of `composed`.
    pub share: PhiSplit,
    /// w_r.
    pub w_r: f64,
    /// w_c, 1/m².
    pub w_c: f64,
    /// α(s) = alpha·s, 1/s.
    pub alpha: f64,
    /// γ of `budget`, or the share of a rate of 2/s.
    pub gamma: Option<f64>,
    /// κ of `budget`: by how much the share rises with h.
    pub rise: f64,
    /// γ_c of `budget`.
    pub gamma_c: f64,
    /// What `budget` believes of levels.
    pub trust: Trust,
    /// What `budget` assumes of malicious robots.
    pub assume: Assume,
    /// Δ_d, m.
    pub distance_min_m: f64,
    /// Lower corner of U_i, m/s, one number a dimension.
    pub input_min_m_s: Vec<f64>,
    /// Upper corner of U_i, m/s.
    pub input_max_m_s: Vec<f64>,
    /// τ₁, the tick.
    pub tau_1: Duration,
    /// τ₂, a multiple of τ₁.
    pub tau_2: Duration,
    /// How long a velocity may be held, or τ₁.
    pub hold_max: Option<Duration>,
    /// How old a told level may be.
    pub told_max: Duration,
    /// Stated bound of the difference of clocks.
    pub clock_error: Duration,
    /// Stated bound of the error of sensed positions, m.
    pub position_error_m: f64,
    /// Stated bound of how far robots are from where their velocities take them, m.
    pub tracking_error_m: f64,
    /// Where robots start.
    pub start: Start,
    /// y_i(t₀).
    pub values: Values,
    /// Where robots want to go.
    pub desired: Desired,
    /// What malicious robots do.
    pub attack: Attack,
    /// How robots follow their velocities.
    pub plant: Plant,
    /// What goes wrong.
    pub trouble: Faults,
    /// Laws that the run must not break.
    pub expect: Vec<Law>,
}

/// Initial values y_i(t₀).
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Drawn evenly from the interval for each robot.
    Random {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
    },
    /// One for each robot.
    Listed(Vec<f64>),
}

impl Default for Scenario {
    fn default() -> Self {
        let settings = Settings::<2>::default();
        let (composed, budget) = (ComposedSettings::default(), BudgetSettings::default());
        Self {
            name: "scenario".into(),
            duration_s: 10.0,
            seed: 1,
            dimension: 2,
            robots: settings.team.robots,
            faults: settings.team.faults,
            malicious: vec![1, 2],
            radius_m: settings.link.radius_m,
            epsilon: None,
            q2: settings.link.q2,
            controller: Controller::Composed,
            share: composed.phi_split,
            w_r: composed.w_r,
            w_c: composed.w_c,
            alpha: composed.alpha,
            gamma: budget.gamma,
            rise: budget.gain_slope,
            gamma_c: budget.gamma_c,
            trust: budget.trust,
            assume: budget.assume,
            distance_min_m: settings.limits.distance_min_m,
            input_min_m_s: settings.limits.input.min_m_s.to_vec(),
            input_max_m_s: settings.limits.input.max_m_s.to_vec(),
            tau_1: settings.clock.level_period,
            tau_2: settings.clock.value_period,
            hold_max: settings.clock.hold_max,
            told_max: settings.clock.told_max,
            clock_error: settings.clock.error,
            position_error_m: settings.errors.position_m,
            tracking_error_m: settings.errors.tracking_m,
            start: Start::Inside,
            values: Values::Random { min: -500.0, max: 500.0 },
            desired: Desired::Paper,
            attack: Attack::default(),
            plant: Plant::Single,
            trouble: Faults::default(),
            expect: Law::EXPECTED.to_vec(),
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
        let ticks = (self.duration_s / self.tau_1.as_secs_f64()).round() as u32;
        ticks
    }

    /// Ticks between consensus rounds, at least 1.
    #[must_use]
    pub fn ticks_per_round(&self) -> u32 {
        let ratio = self.tau_2.as_nanos() / self.tau_1.as_nanos().max(1);
        u32::try_from(ratio).unwrap_or(u32::MAX).max(1)
    }

    /// True when nothing goes wrong and every liar tells all the same, so that robots may be computed at once.
    ///
    /// Bodies that do not follow their velocities make no difference to `composed` and `none`, which know nothing but what
    /// they sense in a tick. A robot of `budget` compares where it senses itself with where its last velocity should have
    /// taken it and promises nothing where the two differ; only single robots keep that account.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        let followed = self.plant == Plant::Single || self.controller != Controller::Budget;
        self.trouble.is_none() && self.attack.is_plain() && followed
    }

    /// The same under another controller, with what is usually expected of it unless the scenario expects something else.
    #[must_use]
    pub fn under(self, controller: Controller) -> Self {
        let usual = self.expect == self.controller.row().expects;
        let expect = if usual { controller.row().expects.to_vec() } else { self.expect };
        Self { controller, expect, ..self }
    }

    /// τ₁ in seconds.
    #[must_use]
    pub fn tick_s(&self) -> f64 {
        self.tau_1.as_secs_f64()
    }

    /// Where the robots start, m.
    pub fn positions<const D: usize>(&self) -> Result<Vec<Vector<D>>, StartError> {
        self.start.positions(self.robots, self.seed)
    }

    /// Which robots are malicious, by index from 0.
    #[must_use]
    pub fn malicious_mask(&self) -> Vec<bool> {
        (1..=self.robots).map(|robot| self.malicious.contains(&robot)).collect()
    }

    /// The robot's own parameters; an error names the field.
    pub fn params<const D: usize>(&self) -> Result<Params<D>, ParamsError> {
        let corner = |numbers: &[f64]| core::array::from_fn(|d| numbers.get(d).copied().unwrap_or(f64::NAN));
        let input = InputBox { min_m_s: corner(&self.input_min_m_s), max_m_s: corner(&self.input_max_m_s) };
        Params::new(Settings {
            team: Team { robots: self.robots, faults: self.faults },
            link: LinkSettings { radius_m: self.radius_m, epsilon: self.epsilon, q2: self.q2 },
            limits: Limits { distance_min_m: self.distance_min_m, input },
            controller: self.controller.settings(self),
            clock: Clock {
                level_period: self.tau_1,
                value_period: self.tau_2,
                hold_max: self.hold_max,
                told_max: self.told_max,
                error: self.clock_error,
            },
            errors: Errors { position_m: self.position_error_m, tracking_m: self.tracking_error_m },
        })
    }

    pub(crate) fn composed_settings(&self) -> ComposedSettings {
        ComposedSettings { phi_split: self.share, w_r: self.w_r, w_c: self.w_c, alpha: self.alpha }
    }

    pub(crate) fn budget_settings(&self) -> BudgetSettings {
        BudgetSettings {
            gamma: self.gamma,
            gain_slope: self.rise,
            gamma_c: self.gamma_c,
            trust: self.trust,
            assume: self.assume,
        }
    }

    /// The paper's composition, for whoever wants to know φ and φ_i, whatever the controller.
    #[must_use]
    pub fn composed(&self) -> Composed {
        let of = self.composed_settings();
        Composed {
            split: of.phi_split,
            w_r: of.w_r,
            w_c: of.w_c,
            alpha: of.alpha,
            robots: self.robots,
            required: required_degree(self.robots, self.faults),
            distance_min_m: self.distance_min_m,
        }
    }
}
