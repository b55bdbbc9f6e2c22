//! What to run: plain data, checked.

pub mod desired;
mod scatter;
pub mod start;

use core::time::Duration;

use closeranks_core::controller::budget::knowledge::{Assume, Trust};
use closeranks_core::equations::composition::Share;
use closeranks_core::program::InputBox;
use closeranks_core::settings::params::{self, Params, Settings};
use closeranks_core::settings::range::ParamsError;

use crate::attack::Attack;
use crate::faults::Faults;
use crate::law::Law;
use crate::plant::Plant;
use crate::scenario::desired::Motion;
use crate::scenario::start::Start;

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
    pub share: Share,
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
    pub motion: Motion,
    /// What malicious robots do.
    pub attack: Attack,
    /// How robots follow their velocities.
    pub plant: Plant,
    /// What goes wrong.
    pub trouble: Faults,
    /// Laws that the run must not break.
    pub expect: Vec<Law>,
}

/// The filter between desired and applied velocity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Controller {
    /// The paper's (eq:split, seq:qp).
    Composed,
    /// Ours (METHOD.md section 3).
    Budget,
    /// None: the desired velocity, cut to the box. What the paper's robots would do unfiltered.
    None,
}

impl Controller {
    /// All, in the order of their names.
    pub const ALL: [Self; 3] = [Self::Budget, Self::Composed, Self::None];

    /// Its name in scenario files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Composed => "composed",
            Self::Budget => "budget",
            Self::None => "none",
        }
    }

    /// The controller of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|controller| controller.name() == name)
    }

    /// The laws that a scenario expects if it says nothing.
    #[must_use]
    pub fn usual(self) -> &'static [Law] {
        match self {
            Self::Budget => &Law::PROMISED,
            Self::Composed | Self::None => &Law::EXPECTED,
        }
    }

    /// The laws that sweeps hold it to where its assumptions hold. Without a filter nothing is promised, and all that may be
    /// expected counts wherever it is broken.
    #[must_use]
    pub fn promises(self) -> &'static [Law] {
        match self {
            Self::Budget => &Law::PROMISED,
            Self::Composed => &Law::COMPOSED,
            Self::None => &Law::EXPECTED,
        }
    }
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
        Self {
            name: "scenario".into(),
            duration_s: 10.0,
            seed: 1,
            dimension: 2,
            robots: settings.robots,
            faults: settings.faults,
            malicious: vec![1, 2],
            radius_m: settings.radius_m,
            epsilon: None,
            q2: settings.q2,
            controller: Controller::Composed,
            share: settings.share,
            w_r: settings.w_r,
            w_c: settings.w_c,
            alpha: settings.alpha,
            gamma: settings.gamma,
            rise: settings.rise,
            gamma_c: settings.gamma_c,
            trust: settings.trust,
            assume: settings.assume,
            distance_min_m: settings.distance_min_m,
            input_min_m_s: settings.input.min_m_s.to_vec(),
            input_max_m_s: settings.input.max_m_s.to_vec(),
            tau_1: settings.level_period,
            tau_2: settings.value_period,
            hold_max: settings.hold_max,
            told_max: settings.told_max,
            clock_error: settings.clock_error,
            position_error_m: settings.position_error_m,
            tracking_error_m: settings.tracking_error_m,
            start: Start::Inside,
            values: Values::Random { min: -500.0, max: 500.0 },
            motion: Motion::Paper,
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
        let usual = self.expect == self.controller.usual();
        let expect = if usual { controller.usual().to_vec() } else { self.expect };
        Self { controller, expect, ..self }
    }

    /// τ₁ in seconds.
    #[must_use]
    pub fn tick_s(&self) -> f64 {
        self.tau_1.as_secs_f64()
    }

    /// Which robots are malicious, by index from 0.
    #[must_use]
    pub fn malicious_mask(&self) -> Vec<bool> {
        (1..=self.robots).map(|robot| self.malicious.contains(&robot)).collect()
    }

    /// The robot's own parameters; an error names the field.
    pub fn params<const D: usize>(&self) -> Result<Params<D>, ParamsError> {
        let corner = |numbers: &[f64]| core::array::from_fn(|d| numbers.get(d).copied().unwrap_or(f64::NAN));
        Params::new(Settings {
            robots: self.robots,
            faults: self.faults,
            radius_m: self.radius_m,
            distance_min_m: self.distance_min_m,
            epsilon: self.epsilon,
            q2: self.q2,
            w_r: self.w_r,
            w_c: self.w_c,
            alpha: self.alpha,
            share: self.share,
            controller: match self.controller {
                Controller::Budget => params::Controller::Budget,
                Controller::Composed | Controller::None => params::Controller::Composed,
            },
            gamma: self.gamma,
            rise: self.rise,
            gamma_c: self.gamma_c,
            trust: self.trust,
            assume: self.assume,
            input: InputBox { min_m_s: corner(&self.input_min_m_s), max_m_s: corner(&self.input_max_m_s) },
            level_period: self.tau_1,
            value_period: self.tau_2,
            hold_max: self.hold_max,
            told_max: self.told_max,
            clock_error: self.clock_error,
            position_error_m: self.position_error_m,
            tracking_error_m: self.tracking_error_m,
        })
    }
}
