//! One robot as a state machine without inputs or outputs of its own.

mod assurance;
pub mod error;
pub mod memory;
pub mod missing;
pub mod neighbor;
pub mod report;
mod round;
pub mod scratch;
mod sense;
pub mod sized;
mod slots;
mod talk;
mod tick;

use crate::controller::links::peer::Ledger;
use crate::controller::links::protocol::Number;
use crate::message::VALUE_MAX;
use crate::num::Vector;
use crate::robot::assurance::Assurance;
use crate::robot::error::RobotError;
use crate::robot::neighbor::{Member, RobotId, Slot};
use crate::settings::params::Params;
use crate::time::{Instant, Timer};

/// Where a robot keeps its neighbours: an array, a vector, a slice that is lent to it.
pub trait Slots<const D: usize>: AsRef<[Slot<D>]> + AsMut<[Slot<D>]> {}

impl<const D: usize, S: AsRef<[Slot<D>]> + AsMut<[Slot<D>]>> Slots<D> for S {}

/// A robot between its planner and its motion controller.
///
/// The owner calls, in every tick and in this order:
///
/// 1. [`sense`](Self::sense): the time and the robot's own position;
/// 2. [`observe`](Self::observe): the position of every robot it senses (trusted);
/// 3. [`share`](Self::share): what is to be told now, if anything is due;
/// 4. [`receive`](Self::receive): messages of neighbours (not trusted), with the number of who sent them;
/// 5. [`tick`](Self::tick): desired velocity in, safe velocity out.
///
/// A level shared before the others' `receive` is used in the same tick (eq:continuous_a). One that comes later is held until
/// the next (eq:connectivity). Under `budget` robots tell no levels: what is shared is the value, in consensus rounds. A robot that
/// is not observed in a tick is not a neighbour, and what it told is forgotten. Under `budget` it stays one as long as it must
/// still be within R ([`missing`]).
///
/// *Time.* `now` is the robot's own clock, which must never fall. Nothing is read between two calls of `tick`, so the velocity of
/// the first is held until the second: for `hold_max` at most, as [`Clock`](crate::settings::Clock) says.
///
/// *Frame.* All positions given to one robot are in m and in one frame that stands still in the world. Velocities are along the axes
/// of that frame. The robot uses differences of positions within a tick, and how far it went itself since the last one. Nothing
/// that it tells has a direction, so every robot may have a frame of its own, with another origin and other axes. If a frame drifts,
/// as odometry does, the drift is an error of the own position and belongs in [`Errors`](crate::settings::Errors).
///
/// *Misuse.* Any order of calls with any numbers is safe: there is no panic, and every velocity is finite and in its box. What
/// can be noticed is said:
///
/// | what was done | what is said |
/// | --- | --- |
/// | a number that is not one of 1 to n, or the own number, is observed | [`ObserveError::UnknownId`], [`ObserveError::OwnId`] |
/// | a robot is made with such a number | [`RobotError::Id`] |
/// | a message comes from such a number, or from one that was not observed | [`ReceiveError::NotNeighbor`] |
/// | more neighbours are observed than there are slots | [`ObserveError::Full`]; those observed first are kept. [`Reason::Overlooked`], under `budget` |
/// | an observation is refused, or two of one robot differ | [`Reason::Overlooked`], under `budget`; of two the last counts |
/// | a position or a time is not usable | [`SenseError`], [`ObserveError::NotFinite`], then [`Mode::Stopped`] |
/// | `tick` without `sense` | [`Reason::NotSensed`]; the robot stands still |
/// | `tick` without `share` when something was due | [`Reason::NotShared`] |
/// | `tick` later than `hold_max` after the last one | [`Reason::Late`], under `budget` |
/// | scratch that is too short | [`RobotError::Scratch`], [`Reason::Scratch`]; the robot stands still |
///
/// Numbers from 1 to n without the own one are n − 1, so there can be no more neighbours. The answer does not depend on the order
/// of `observe` or `receive`, unless there are more neighbours than slots.
///
/// [`Mode::Stopped`]: report::Mode::Stopped
/// [`ObserveError::Full`]: error::ObserveError::Full
/// [`ObserveError::NotFinite`]: error::ObserveError::NotFinite
/// [`ObserveError::OwnId`]: error::ObserveError::OwnId
/// [`ObserveError::UnknownId`]: error::ObserveError::UnknownId
/// [`Reason::Late`]: report::Reason::Late
/// [`Reason::NotSensed`]: report::Reason::NotSensed
/// [`Reason::NotShared`]: report::Reason::NotShared
/// [`Reason::Overlooked`]: report::Reason::Overlooked
/// [`Reason::Scratch`]: report::Reason::Scratch
/// [`ReceiveError::NotNeighbor`]: error::ReceiveError::NotNeighbor
/// [`SenseError`]: error::SenseError
#[derive(Debug)]
pub struct Robot<const D: usize, S> {
    pub(crate) params: Params<D>,
    pub(crate) id: RobotId,
    pub(crate) rank: u16,
    pub(crate) slots: S,
    pub(crate) count: usize,
    /// The slot to look at first when one is looked for.
    pub(crate) next: usize,
    pub(crate) now: Instant,
    pub(crate) position: Option<Vector<D>>,
    /// Whether `sense` was called since the last tick.
    sensed_now: bool,
    /// The velocity that was last decided on, m/s.
    pub(crate) before: Vector<D>,
    pub(crate) assurance: Assurance<D>,
    /// What it holds of its own messages, under `links`.
    pub(crate) ledger: Ledger<D>,
    level_timer: Timer,
    value_timer: Timer,
    sequence: u32,
    /// c_i as sensed. `told_level` is c_i as told, which is the same for a robot that follows eq:connectivity.
    pub(crate) level: f64,
    level_at: Instant,
    told_level: f64,
    pub(crate) value: f64,
    pub(crate) next_value: f64,
    /// When the consensus round began, and whether a value came since the last tick.
    pub(crate) round: Option<Instant>,
    pub(crate) round_news: bool,
}

impl<const D: usize, S: Slots<D>> Robot<D, S> {
    /// A robot with initial value `y_i(t₀)`, due to share at once. `slots` bound how many neighbours it can have.
    ///
    /// A value that is NaN or beyond ±[`VALUE_MAX`] is refused, and so is a number that is not one of 1 to n.
    ///
    /// Under ranks `own` is a [`Member`]; a number alone stands for rank 0.
    pub fn new(params: Params<D>, own: impl Into<Member>, value: f64, slots: S) -> Result<Self, RobotError> {
        if !(-VALUE_MAX..=VALUE_MAX).contains(&value) {
            return Err(RobotError::Value);
        }
        let Member { id, rank } = own.into();
        let (clock, team) = (params.settings().clock, params.settings().team);
        if !(1..=team.robots).contains(&id.0) {
            return Err(RobotError::Id { id: id.0, robots: team.robots });
        }
        Ok(Self {
            params,
            id,
            rank,
            slots,
            count: 0,
            next: 0,
            now: Instant::START,
            position: None,
            sensed_now: false,
            before: [0.0; D],
            assurance: Assurance::NEW,
            ledger: Ledger::begin(Number::NONE),
            level_timer: Timer::new(Instant::START, clock.level_period),
            value_timer: Timer::new(Instant::START, clock.value_period),
            sequence: 0,
            level: 0.0,
            level_at: Instant::START,
            told_level: 0.0,
            value,
            next_value: value,
            round: None,
            round_news: false,
        })
    }

    /// Begins anew with `value`, as after a restart. Neighbours, what they told and everything else are forgotten, except the
    /// time, which must not fall.
    pub fn restart(&mut self, value: f64) -> Result<(), RobotError> {
        if !(-VALUE_MAX..=VALUE_MAX).contains(&value) {
            return Err(RobotError::Value);
        }
        (self.count, self.position, self.sequence) = (0, None, 0);
        (self.assurance, self.before) = (Assurance::NEW, [0.0; D]);
        self.ledger = Ledger::begin(self.ledger.numbers.last());
        (self.round, self.round_news) = (None, false);
        (self.level, self.told_level, self.value, self.next_value) = (0.0, 0.0, value, value);
        Ok(())
    }

    /// When the next share is due.
    #[must_use]
    pub fn poll_at(&self) -> Instant {
        self.level_timer.due().min(self.value_timer.due())
    }

    /// Where the robot counts itself in this tick, m: where it sensed itself, or with a tracking error where its moves have
    /// taken it since it last had to begin anew. `None` without a usable position.
    #[must_use]
    pub fn reference(&self) -> Option<Vector<D>> {
        self.position
    }

    /// True if the robot had to begin anew in this tick: it is not where its last move should have taken it, or was not
    /// called in time. Only `budget` keeps this account.
    #[must_use]
    pub fn began_anew(&self) -> bool {
        self.assurance.anew
    }

    /// The robot's number.
    #[must_use]
    pub fn id(&self) -> RobotId {
        self.id
    }

    /// y_i, held since the last round began.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.value
    }

    /// c_i as told. It differs from the sensed level only after [`restate`](Self::restate).
    #[must_use]
    pub fn told_level(&self) -> f64 {
        self.told_level
    }
}
