//! What the table of controllers says of each, and what a controller with global state is given and answers.

use closeranks_core::num::Vector;
use closeranks_core::program::Outcome;
use closeranks_core::settings::params::Params;
use closeranks_core::settings::{self, BudgetSettings, ComposedSettings, LinksSettings};

use crate::controllers::Global;
use crate::law::Law;

/// What a controller with global state is given in a tick.
#[derive(Clone, Copy, Debug)]
pub struct TeamView<'a, const D: usize> {
    /// Parameters of the team; their controller is none.
    pub params: &'a Params<D>,
    /// x_i, m.
    pub positions_m: &'a [Vector<D>],
    /// Velocities of the tick before, m/s; 0 at first.
    pub velocities_m_s: &'a [Vector<D>],
    /// u_{i,des}, m/s.
    pub desired_m_s: &'a [Vector<D>],
    /// How hard barriers are kept, and how far ahead is looked.
    pub tuning: Tuning,
}

/// The two numbers that controllers of others leave to whoever uses them. Those of the table were chosen by a rule
/// (docs/comparison.md).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning {
    /// α of barriers, 1/s.
    pub rate_1_s: f64,
    /// `orca`: τ, s; collisions later than this are not avoided yet.
    pub horizon_s: f64,
}

impl Tuning {
    /// A rate; the horizon is the usual one.
    #[must_use]
    pub const fn rate(rate_1_s: f64) -> Self {
        Self { rate_1_s, ..Self::USUAL }
    }

    /// A horizon; the rate is the usual one.
    #[must_use]
    pub const fn horizon(horizon_s: f64) -> Self {
        Self { horizon_s, ..Self::USUAL }
    }

    /// What controllers have that use neither.
    pub const USUAL: Self = Self { rate_1_s: 5.0, horizon_s: 2.0 };
}

/// What such a controller answers for one robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer<const D: usize> {
    /// What the robot is asked for, m/s. It is cut to the input box.
    pub velocity_m_s: Vector<D>,
    /// How it came about.
    pub outcome: Outcome,
}

/// A controller with global state.
pub trait Velocities {
    /// Fills `answers`, one a robot, in order of their numbers.
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]);
}

/// How much a controller needs to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Knows {
    /// What a robot senses and hears itself.
    Local,
    /// The state of the whole team.
    Global,
}

/// When a start is inside the safe set of a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// Every φ_i is not negative at some time (thm:cbf-qp).
    Shares,
    /// Every h_i of a normal robot is not negative, and no two robots are closer than Δ_d.
    Margins,
    /// Every normal robot has as many neighbours as it must count on, and no two robots are closer than Δ_d.
    Degrees,
}

/// Which violations of what a controller promises count against it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// Those in which everything held that the promise rests on.
    Covered,
    /// All: nothing is promised, so nothing excuses.
    All,
}

/// What a controller does among obstacles, those that cut links among them, or among robots of other teams.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Amid {
    /// It keeps clear of them.
    Avoids,
    /// It takes no notice of them, as it takes none of robots.
    Ignores,
    /// It is not run there.
    Refuses,
}

/// Parameters of all controllers that have any. They are there whichever controller is run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Parameters of `composed`.
    pub composed: ComposedSettings,
    /// Parameters of `budget`.
    pub budget: BudgetSettings,
    /// Parameters of `links`.
    pub links: LinksSettings,
}

/// How a controller is made.
#[derive(Clone, Copy, Debug)]
pub enum Make {
    /// Every robot runs it.
    Local(fn(&Parameters) -> settings::Controller),
    /// It is made for the whole team.
    Global(fn(&Parameters) -> Global),
}

/// What is to be known of a controller.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Its name in scenario files.
    pub name: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
    /// How much it needs to know.
    pub knows: Knows,
    /// What that is, in a few words.
    pub needs: &'static str,
    /// What a scenario uses that names nothing else.
    pub tuning: Tuning,
    /// Whether it guarantees in discrete time what it promises. Robots then watch what that rests on: their clocks, and
    /// whether they are where their moves should have taken them.
    pub guarantees: bool,
    /// Whether ranks may tell who counts for whom.
    pub ranks: bool,
    /// Whether φ_i is part of its decisions.
    pub uses_phi: bool,
    /// What it does among obstacles.
    pub amid: Amid,
    /// What it does among robots of other teams.
    pub strangers: Amid,
    /// What it does among obstacles that cut links.
    pub cuts: Amid,
    /// The laws that sweeps hold it to.
    pub promises: &'static [Law],
    /// Which violations of them count.
    pub counted: Counted,
    /// The laws that a scenario expects if it says nothing.
    pub expects: &'static [Law],
    /// When a start is inside its safe set.
    pub inside: Inside,
    /// How it is made.
    pub make: Make,
}

impl Row {
    /// True if it asks nothing of robots that are absent: it does not look at all of the roster.
    #[must_use]
    pub fn runs_with_absent(&self) -> bool {
        self.knows == Knows::Local
    }

    /// True if it can be run where there are obstacles.
    #[must_use]
    pub fn runs_among_obstacles(&self) -> bool {
        self.amid != Amid::Refuses
    }

    /// True if it can be run where obstacles cut links.
    #[must_use]
    pub fn runs_among_cuts(&self) -> bool {
        self.cuts != Amid::Refuses
    }

    /// True if it can be run where there are robots of other teams.
    #[must_use]
    pub fn runs_among_strangers(&self) -> bool {
        self.strangers != Amid::Refuses
    }
}

/// The row of a controller of others that looks at the whole team. It is held to what holds whatever the velocities are: what
/// its source claims of links and distances holds in continuous time, and is measured, not promised.
pub(crate) const fn of_others(
    name: &'static str,
    about: &'static str,
    needs: &'static str,
    tuning: Tuning,
    make: fn(&Parameters) -> Global,
) -> Row {
    Row {
        name,
        about,
        knows: Knows::Global,
        needs,
        tuning,
        guarantees: false,
        ranks: false,
        uses_phi: false,
        amid: Amid::Refuses,
        strangers: Amid::Refuses,
        cuts: Amid::Refuses,
        promises: &[Law::Interval, Law::Input],
        counted: Counted::Covered,
        expects: &[Law::Interval, Law::Input],
        inside: Inside::Margins,
        make: Make::Global(make),
    }
}
