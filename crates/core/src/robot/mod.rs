//! One robot as a state machine without inputs or outputs of its own.

mod answer;
mod assurance;
pub mod error;
pub mod id;
mod lists;
pub mod memory;
pub mod missing;
pub mod neighbor;
pub mod report;
mod round;
pub mod scratch;
pub mod sized;
mod slots;

use crate::controller::View;
use crate::controller::links::peer::Ledger;
use crate::controller::links::protocol::Number;
use crate::message::{Message, MessageError, VALUE_MAX, VERSION};
use crate::num::{Vector, dot, is_finite, subtract};
use crate::robot::assurance::Assurance;
use crate::robot::error::{ObserveError, Observed, ReceiveError, RobotError, SenseError};
use crate::robot::neighbor::{Member, NO_LINK, RobotId, Slot, Told};
use crate::robot::report::{Mode, Output, Reason};
use crate::robot::scratch::Scratch;
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
/// the next (eq:connectivity). A robot that is not observed in a tick is not a neighbour, and what it told is forgotten. Under
/// `budget` it stays one as long as it must still be within R ([`missing`]).
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

    /// Begins a tick at `now` with the robot's own position x_i, m.
    pub fn sense(&mut self, now: Instant, position: Vector<D>) -> Result<(), SenseError> {
        (self.position, self.sensed_now) = (None, true);
        for slot in &mut self.slots.as_mut()[..self.count] {
            slot.seen_before = slot.sensed;
            slot.sensed = false;
            slot.unsensed_m = 0.0;
        }
        if now < self.now {
            return Err(SenseError::TimeFell);
        }
        self.now = now;
        if self.ledger.looked_at.is_none() && self.count == 0 {
            // Numbers of earlier lives are not above the time at which this one begins.
            self.ledger = Ledger::begin(self.ledger.numbers.last().max(Number(now.as_nanos())));
        }
        if !is_finite(&position) {
            return Err(SenseError::NotFinite);
        }
        let promises = self.params.controller().promises();
        let place = if promises { self.assurance.place(&self.params, now, position) } else { position };
        self.position = Some(place);
        Ok(())
    }

    /// Takes the sensed position of another robot, m.
    ///
    /// Under ranks `other` is a [`Member`], with the rank that the roster has; a number alone stands for rank 0.
    pub fn observe(
        &mut self,
        other: impl Into<Member>,
        position: Vector<D>,
    ) -> Result<Observed, ObserveError> {
        let Member { id, rank } = other.into();
        if id == self.id {
            return Err(ObserveError::OwnId);
        }
        let known = (1..=self.params.settings().team.robots).contains(&id.0);
        let without = if known { ObserveError::NoPosition } else { ObserveError::UnknownId };
        let own = self.position.ok_or(without)?;
        let offset_m = subtract(&own, &position);
        let distance_m2 = dot(&offset_m, &offset_m);
        let link = self.link_at(distance_m2);
        let far = link.is_none() && distance_m2 > self.params.sight_m2();
        if !known {
            return Err(if far { ObserveError::UnknownId } else { self.refuse(ObserveError::UnknownId) });
        }
        if !is_finite(&position) {
            return Err(self.refuse(ObserveError::NotFinite));
        }
        if far {
            self.lose(id, &offset_m);
            return Ok(Observed::OutOfRange);
        }
        let index = self.slot(id).map_err(|error| self.refuse(error))?;
        let slot = &mut self.slots.as_mut()[index];
        if slot.seen_before && self.params.controller().promises() {
            self.assurance.watch(&self.params, self.now, slot, &offset_m);
        }
        let differs = slot.sensed && (slot.position_m != position || slot.rank != rank);
        slot.rank = rank;
        (slot.sensed, slot.seen_before, slot.offset_m) = (true, false, offset_m);
        (slot.position_m, slot.sensed_at, slot.unsensed_m) = (position, self.now, 0.0);
        (slot.linked, slot.link) = (link.is_some(), link.unwrap_or(NO_LINK));
        if differs {
            self.overlook();
        }
        Ok(if link.is_some() { Observed::Neighbor } else { Observed::InView })
    }

    /// What to tell now: the level when τ₁ has passed, with the value when τ₂ has. A robot that is late for a round by more
    /// than a velocity may be held, as after a crash, waits for the next one, so that all have theirs at the same time.
    ///
    /// Forgets robots that were not observed in this tick, but for those that are missing ([`missing`]). `None` while nothing is due, the own position is unknown, or `scratch` is
    /// too short for the robot.
    //= paper eq:connectivity
    pub fn share(&mut self, scratch: &mut Scratch<'_, D>) -> Option<Message> {
        self.position.filter(|_| scratch.is_for(self.slots.as_ref().len()))?;
        self.reckon();
        self.settle();
        let level_due = self.level_timer.fires(self.now);
        let value_due = self.value_timer.fires_in_turn(self.now, self.params.settings().clock.hold_max());
        if level_due {
            let (controller, slots) = (self.params.controller(), &mut self.slots.as_mut()[..self.count]);
            controller.agree(
                Member { id: self.id, rank: self.rank },
                &mut self.ledger,
                slots,
                self.now,
                scratch,
            );
            self.level = self.params.controller().level(&self.view(), scratch);
            self.level_at = self.now;
            self.told_level = self.level;
        }
        if value_due {
            self.begin_round();
        }
        if !level_due && !value_due {
            return None;
        }
        let value = value_due.then_some(self.value);
        if self.params.controller().tells_lists() {
            self.ledger.head(self.now, value)?;
        }
        self.sequence = self.sequence.saturating_add(1);
        Message::new(self.sequence, self.level_at, self.told_level, value).ok()
    }

    /// Takes a message that arrived from `sender`. Under `links` messages are of another kind ([`receive_bytes`](Self::receive_bytes)).
    pub fn receive(&mut self, sender: RobotId, message: &Message) -> Result<(), ReceiveError> {
        if self.params.controller().tells_lists() {
            return Err(ReceiveError::Bytes(MessageError::Version(VERSION)));
        }
        let (now, stamp) = (self.now, message.stamp());
        let in_round = message.value().is_some() && self.in_round(stamp);
        let index = self.find(sender).ok_or(ReceiveError::NotNeighbor)?;
        let slot = &mut self.slots.as_mut()[index];
        if !slot.sensed && !slot.is_missing() {
            return Err(ReceiveError::NotNeighbor);
        }
        let sequence = message.sequence();
        if slot.told.is_some_and(|told| (stamp, sequence) <= (told.stamp, told.sequence)) {
            return Err(ReceiveError::Stale);
        }
        let earlier = slot.told.and_then(|told| told.value);
        let value = earlier.or(message.value().filter(|_| in_round));
        slot.told = Some(Told { sequence, stamp, level: message.level(), at: now, value });
        self.round_news |= value != earlier;
        Ok(())
    }

    /// Replaces the level that the robot holds and tells, until the next update.
    ///
    /// A robot that follows eq:connectivity never needs this. It is how the world makes a robot malicious in the sense
    /// of `misbeh`: by Assumption 1 such a robot uses its false `c_i` in its own row too. Ignored unless finite.
    pub fn restate(&mut self, level: f64) {
        if level.is_finite() {
            self.told_level = level;
        }
    }

    /// Ends the tick: the velocity closest to `desired` (m/s) that its controller allows, and W-MSR if a round is on.
    ///
    /// With a `scratch` that is too short for the robot it stands still and says so ([`Reason::Scratch`]).
    pub fn tick(&mut self, desired: Vector<D>, scratch: &mut Scratch<'_, D>) -> Output<D> {
        if !scratch.is_for(self.slots.as_ref().len()) {
            return self.stand(Mode::Degraded(Reason::Scratch), None);
        }
        let round = self.end_round(scratch.values);
        let sensed = core::mem::take(&mut self.sensed_now);
        let Some(position) = self.position.filter(|_| sensed) else {
            self.assurance.lose(self.now);
            let unknown = self.position.is_none();
            return self
                .stand(if unknown { Mode::Stopped } else { Mode::Degraded(Reason::NotSensed) }, round);
        };
        let (known, unshared) = (is_finite(&desired), self.now >= self.poll_at());
        let desired = if known { desired } else { [0.0; D] };
        if self.params.controller().reckons() {
            self.settle();
        }
        let decision = self.params.controller().alone(&self.view(), &desired, scratch);
        self.before = decision.velocity_m_s;
        self.ledger.wish_m_s = self.params.settings().limits.input.clip(&desired);
        self.assurance.doubt(self.now, decision.doubt);
        let mut report = self.report(Some(&decision), round);
        if !known {
            report.mode = Mode::Hold;
        } else if unshared {
            report.mode = Mode::Degraded(Reason::NotShared);
        }
        self.assurance.moved(self.now, position, decision.velocity_m_s);
        Output { velocity_m_s: decision.velocity_m_s, report }
    }

    /// What the controller is given in this tick.
    fn view(&self) -> View<'_, D> {
        View {
            id: self.id,
            rank: self.rank,
            now: self.now,
            told_level: self.told_level,
            before_m_s: self.before,
            ledger: &self.ledger,
            slots: self.neighbors(),
        }
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

    /// Whom the robot counts on, under `links`: neighbours that keep the link to it as it keeps the link to them.
    pub fn counted(&self) -> impl Iterator<Item = RobotId> + Clone {
        self.neighbors().iter().filter(|slot| slot.peer.is_counted()).map(|slot| slot.id)
    }
}
