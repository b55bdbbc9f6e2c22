//! What a robot says about one tick.

use core::time::Duration;

use crate::num::Vector;
use crate::program::Outcome;

/// Velocity and everything a caller should look at before using it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Output<const D: usize> {
    /// u_i, m/s, always finite and inside U_i.
    pub velocity_m_s: Vector<D>,
    /// How the velocity came about.
    pub report: Report,
}

/// State of one robot after a tick, from what it knows itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// δ_i, the number of neighbours sensed within R, whatever errors are stated.
    pub degree: u16,
    /// δ_i less what must be there; negative when the condition of thm:rs_robust does not hold here.
    pub degree_margin: i32,
    /// c_i as sensed at the last update, before any restatement.
    pub level: f64,
    /// h_i = c_i − F′ (eq:h_i). Under `budget` with free liars it is T_i − θ; with stated errors, or while a neighbour is
    /// missing, it is the least that it can be.
    pub h: f64,
    /// φ_i (eq:phi_i) if the answer depends on it: under `composed`. It may be negative while all is well
    /// (docs/theory, sec:phi).
    pub phi: Option<f64>,
    /// What the program found.
    pub outcome: Outcome,
    /// What the answer is worth.
    pub mode: Mode,
    /// How many neighbours have told no level yet, where levels are told; `composed` leaves their terms out.
    pub untold: u16,
    /// Time since the oldest of the neighbours' last messages was received.
    pub told_age_max: Duration,
    /// The consensus round of this tick, if one was on.
    pub round: Option<RoundReport>,
}

/// A consensus round as a robot saw it; [`Slot::discarded`](crate::robot::neighbor::Slot::discarded) says whose values went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundReport {
    /// How many values of neighbours were kept.
    pub kept: u16,
    /// How many were discarded because they were among the F largest or smallest.
    pub discarded: u16,
    /// How many neighbours told no value in this round.
    pub silent: u16,
}

/// What a robot can promise for its answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Every assumption of `budget` that a robot can check holds (docs/theory, thm:sensed). It cannot check that all robots
    /// have the same settings, that every robot near the rim of its range is sensed, and more (docs/budget.md). `composed` never says so: its
    /// theorem needs continuous time.
    Guaranteed,
    /// The answer is used, but an assumption does not hold.
    Degraded(Reason),
    /// There is no usable desired velocity: the answer is the one closest to standing still.
    Hold,
    /// There is no usable own position: the answer is 0.
    Stopped,
}

/// Why an answer is not guaranteed. Of several reasons the gravest is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// There are fewer than F′ neighbours (θ under [`Assume::Free`](crate::controller::assume::Assume::Free)).
    Degree,
    /// The program had no solution.
    Infeasible,
    /// `composed`: φ_i < 0, outside Z_i (thm:cbf-qp). `budget`: h_i < 0, or another robot too close.
    OutsideSafeSet,
    /// `budget` and `links`: an obstacle is nearer than it may be, and the robot goes away from it.
    Obstacle,
    /// More time than a velocity may be held has passed since the last tick. It is said for
    /// [`told_max`](crate::settings::Clock::told_max) more.
    Late,
    /// The robot, or under [`Assume::Obedient`](crate::controller::assume::Assume::Obedient) a neighbour, is not where the
    /// stated errors and the input box allow it to be: sensing or tracking is worse than stated. It is said for as long.
    Moved,
    /// A robot within R may be overlooked. An observation was refused or found no slot, two of one robot differed, or a
    /// neighbour is missing for so long that it may have left ([`missing`](crate::robot::missing)). It is said for as long.
    Overlooked,
    /// `budget` with stated errors or while a neighbour is missing: h_i or a distance is not certain to be safe, and was not since the start or since the
    /// last broken assumption.
    Uncertain,
    /// A neighbour has told no level.
    Untold,
    /// `links`: the robot counts on fewer neighbours than it must.
    Uncounted,
    /// There is no controller: the desired velocity is only cut to its box.
    Unfiltered,
    /// `tick` was called again without `sense`: the robot stands still, because it does not know where it is by now.
    NotSensed,
    /// Something was due to be told in this tick and `share` was not called. The level in this report, and whatever others know
    /// of it, is old, and no consensus round can begin.
    NotShared,
    /// The scratch handed to the call is too short for the robot; it stands still.
    Scratch,
    /// thm:cbf-qp needs continuous time and a constant bias; a robot that ticks cannot have the first.
    ContinuousTime,
}

impl Mode {
    /// The word for it in tables and files: what is guaranteed, or why it is not.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Guaranteed => "guaranteed",
            Self::Hold => "hold",
            Self::Stopped => "stopped",
            Self::Degraded(reason) => reason.name(),
        }
    }
}

impl Reason {
    /// The words for it in tables and files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Degree => "degree",
            Self::Infeasible => "infeasible",
            Self::OutsideSafeSet => "outside safe set",
            Self::Obstacle => "near obstacle",
            Self::Late => "late",
            Self::Moved => "moved",
            Self::Overlooked => "overlooked",
            Self::Uncertain => "uncertain",
            Self::Untold => "untold",
            Self::Uncounted => "uncounted",
            Self::Unfiltered => "unfiltered",
            Self::NotSensed => "not sensed",
            Self::NotShared => "not shared",
            Self::Scratch => "scratch",
            Self::ContinuousTime => "continuous time",
        }
    }
}

pub(crate) fn small(count: usize) -> u16 {
    u16::try_from(count).unwrap_or(u16::MAX)
}
