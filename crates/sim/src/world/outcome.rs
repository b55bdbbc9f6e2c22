//! What a run is asked for, what it comes to, and why there may be none.

use closeranks_core::robot::error::RobotError;
use closeranks_core::settings::params::ParamsError;

use crate::engine::Engine;
use crate::monitors::robustness::Round;
use crate::output::record::Record;
use crate::output::summary::Summary;
use crate::scenario::ranks::RanksError;
use crate::scenario::start::StartError;

/// What a run is to produce besides its summary.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is asked for on its own")]
pub struct Options {
    /// Keep every tick.
    pub record: bool,
    /// Know the digest of the run.
    pub digest: bool,
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
    /// The digest of every tick, if it was asked for.
    pub digest: Option<u64>,
    /// Exact robustness of every consensus round, if it was asked for and the team is small enough; of a run with more than
    /// [`ROUNDS_MAX`](crate::monitors::robustness::ROUNDS_MAX) rounds, those that
    /// [`thin`](crate::monitors::robustness::thin) keeps.
    pub rounds: Vec<Round>,
    /// The table's row; of several teams what they came to together.
    pub summary: Summary,
    /// What each of several teams came to by itself; empty for a single one.
    pub teams: Vec<TeamRun>,
}

/// What one of several teams came to by itself.
#[derive(Clone, Debug, PartialEq)]
pub struct TeamRun {
    /// Its row of the table.
    pub summary: Summary,
    /// Robustness of its own network in every consensus round, as in [`Run::rounds`].
    pub rounds: Vec<Round>,
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
    /// There are no ranks.
    #[error(transparent)]
    Ranks(#[from] RanksError),
    /// A robot could not be made.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The controller does not know of obstacles.
    #[error("there are obstacles {0}")]
    Obstacles(String),
    /// The controller does not know of robots of other teams.
    #[error("there are robots of other teams {0}")]
    Strangers(String),
    /// Several teams where only one can be.
    #[error("the scenario has several teams ([[teams]]), allowed here is one")]
    Teams,
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
