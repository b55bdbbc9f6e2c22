//! What a robot answers to calls and messages that it does not take. Nothing of the call is used then.

use core::fmt;

use crate::message::MessageError;
use crate::robot::scratch::Needs;

/// What [`Robot::observe`](crate::robot::Robot::observe) or
/// [`Robot::observe_stranger`](crate::robot::Robot::observe_stranger) made of a position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Observed {
    /// The other robot is within R: it is a neighbour.
    Neighbor,
    /// It is within R and of another team.
    Stranger,
    /// It is farther away than R as sensed, but perhaps not in truth. `budget` with stated errors reckons with it.
    InView,
    /// It is farther away than R.
    OutOfRange,
}

/// Why a robot cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RobotError {
    /// Scratch is too short; this much is needed.
    Scratch(Needs),
    /// The number of the robot is not one of its team.
    Id {
        /// The number that was given.
        id: u16,
        /// n.
        robots: u16,
    },
    /// The initial value is NaN or beyond ±[`VALUE_MAX`](crate::message::VALUE_MAX).
    Value,
}

/// Why own position or time were not taken; the robot is then [`Mode::Stopped`](crate::robot::report::Mode::Stopped) until the next good call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SenseError {
    /// A coordinate is NaN or infinite.
    NotFinite,
    /// `now` lies before the previous one.
    TimeFell,
}

/// Why an observation was not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObserveError {
    /// A coordinate is NaN or infinite.
    NotFinite,
    /// There is no own position to measure from.
    NoPosition,
    /// The number is that of the robot itself.
    OwnId,
    /// No robot of the team has that number: it is not one of 1 to n.
    UnknownId,
    /// A robot of another team has a number of the own one, 0 or one of 1 to n.
    Member,
    /// Every slot holds a neighbour sensed in this tick; the observation is dropped.
    Full,
}

/// Why a message was not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReceiveError {
    /// The sender is not among the neighbours observed in this tick.
    NotNeighbor,
    /// The message is not newer than the last one of that sender.
    Stale,
    /// These bytes are no message of this team.
    Bytes(MessageError),
}

impl fmt::Display for RobotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scratch(Needs { values, sightings, rows }) => write!(
                f,
                "scratch is too short, needed are {values} values, {sightings} sightings and {rows} rows"
            ),
            Self::Value => f.write_str("initial value is not a number of at most 1e300"),
            Self::Id { id, robots } => write!(f, "robot {id} is not one of 1 to {robots}"),
        }
    }
}

impl fmt::Display for SenseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "own position is not finite",
            Self::TimeFell => "time fell",
        })
    }
}

impl fmt::Display for ObserveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "observed position is not finite",
            Self::NoPosition => "own position is unknown",
            Self::OwnId => "observed itself",
            Self::UnknownId => "observed a robot that is not one of 1 to n",
            Self::Member => "a robot of another team has a number that is not above n",
            Self::Full => "no slot is left for another neighbour",
        })
    }
}

impl fmt::Display for ReceiveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotNeighbor => f.write_str("sender is not a neighbour"),
            Self::Stale => f.write_str("message is not newer than the last one"),
            Self::Bytes(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for RobotError {}
impl core::error::Error for SenseError {}
impl core::error::Error for ObserveError {}
impl core::error::Error for ReceiveError {}
