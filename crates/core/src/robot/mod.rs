//! One robot as a state machine without inputs or outputs of its own.

mod assurance;
pub mod error;
pub mod neighbor;
pub mod report;
mod round;
mod slots;

use crate::controller::budget::knowledge::Sighting;
use crate::equations::composition::{Composition, Term};
use crate::equations::link::Link;
use crate::message::{Message, VALUE_MAX};
use crate::num::scaled::Scaled;
use crate::num::{Vector, dot, is_finite, subtract};
use crate::program::balls::row::Row;
use crate::program::box_row::closest;
use crate::robot::assurance::{Assurance, watches};
use crate::robot::error::{ObserveError, Observed, ReceiveError, RobotError, SenseError};
use crate::robot::neighbor::{NO_LINK, RobotId, Slot, Told};
use crate::robot::report::{Mode, Output};
use crate::settings::params::{Controller, Params};
use crate::time::{Instant, Timer};

/// A robot between its planner and its motion controller.
///
/// The owner calls, in every tick and in this order:
///
/// 1. [`sense`](Self::sense): the time and the robot's own position;
/// 2. [`observe`](Self::observe): the position of every robot it senses (trusted);
/// 3. [`share`](Self::share): what is to be told now, if anything is due;
/// 4. [`receive`](Self::receive): messages of neighbours (not trusted);
/// 5. [`tick`](Self::tick): desired velocity in, safe velocity out.
///
/// A level shared before the others' `receive` is used in the same tick (eq:continuous_a); one that comes later is
/// held until the next (eq:connectivity). `now` must never fall. A robot that is not observed in a tick is not a
/// neighbour and what it told is forgotten. Any order of calls with any numbers is safe: no panic, and every velocity
/// is finite and in its box. The answer does not depend on the order of `observe` or `receive`, unless
/// there are more neighbours than slots: then the first observed are kept.
#[derive(Debug)]
pub struct Robot<'memory, const D: usize> {
    pub(crate) params: Params<D>,
    pub(crate) id: RobotId,
    pub(crate) slots: &'memory mut [Slot<D>],
    pub(crate) values: &'memory mut [f64],
    pub(crate) sightings: &'memory mut [Sighting<D>],
    pub(crate) rows: &'memory mut [Row<D>],
    pub(crate) count: usize,
    /// Where to look first for the next slot.
    pub(crate) next: usize,
    pub(crate) now: Instant,
    position: Option<Vector<D>>,
    /// The last velocity under `budget`, m/s.
    pub(crate) before: Vector<D>,
    pub(crate) assurance: Assurance<D>,
    level_timer: Timer,
    value_timer: Timer,
    sequence: u32,
    /// c_i as sensed, and as told: the same for whoever follows eq:connectivity.
    pub(crate) level: f64,
    level_at: Instant,
    told_level: f64,
    pub(crate) value: f64,
    pub(crate) next_value: f64,
    /// When the consensus round began, and whether a value came since the last tick.
    pub(crate) round: Option<Instant>,
    pub(crate) round_news: bool,
}

impl<'memory, const D: usize> Robot<'memory, D> {
    /// A robot with initial value `y_i(t₀)`, due to share at once.
    ///
    /// `slots` bounds how many neighbours it can have; `values` is scratch of at least the same length.
    pub fn new(
        params: Params<D>,
        id: RobotId,
        value: f64,
        slots: &'memory mut [Slot<D>],
        values: &'memory mut [f64],
    ) -> Result<Self, RobotError> {
        if values.len() < slots.len() {
            return Err(RobotError::Memory);
        }
        if !(-VALUE_MAX..=VALUE_MAX).contains(&value) {
            return Err(RobotError::Value);
        }
        Ok(Self {
            params,
            id,
            slots,
            values,
            sightings: &mut [],
            rows: &mut [],
            count: 0,
            next: 0,
            now: Instant::START,
            position: None,
            before: [0.0; D],
            assurance: Assurance::NEW,
            level_timer: Timer::new(Instant::START, params.settings().level_period),
            value_timer: Timer::new(Instant::START, params.settings().value_period),
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

    /// Lends what [`Controller::Budget`] needs besides: as many `sightings` as slots, and `2·D + 2·N + 1` `rows` for N of
    /// them, with errors of positions `2·D + 2ᴰ (2·N + 1)`. It needs 3·N `values`; with free liars it needs
    /// N and is faster with N². With too little memory the robot stands still.
    #[must_use]
    pub fn with_budget_memory(
        mut self,
        sightings: &'memory mut [Sighting<D>],
        rows: &'memory mut [Row<D>],
    ) -> Self {
        (self.sightings, self.rows) = (sightings, rows);
        self
    }

    /// Begins anew with `value`, as after a restart: neighbours, what they told and everything else is forgotten, but for
    /// the clock, which must not fall.
    pub fn restart(&mut self, value: f64) -> Result<(), RobotError> {
        if !(-VALUE_MAX..=VALUE_MAX).contains(&value) {
            return Err(RobotError::Value);
        }
        (self.count, self.position, self.sequence) = (0, None, 0);
        (self.assurance, self.before) = (Assurance::NEW, [0.0; D]);
        (self.round, self.round_news) = (None, false);
        (self.level, self.told_level, self.value, self.next_value) = (0.0, 0.0, value, value);
        Ok(())
    }

    /// Begins a tick at `now` with the robot's own position x_i, m.
    pub fn sense(&mut self, now: Instant, position: Vector<D>) -> Result<(), SenseError> {
        self.position = None;
        for slot in &mut self.slots[..self.count] {
            slot.seen_before = slot.sensed;
            slot.sensed = false;
        }
        if now < self.now {
            return Err(SenseError::TimeFell);
        }
        self.now = now;
        if !is_finite(&position) {
            return Err(SenseError::NotFinite);
        }
        let watches = watches(&self.params);
        let place = if watches { self.assurance.place(&self.params, now, position) } else { position };
        self.position = Some(place);
        Ok(())
    }

    /// Takes the sensed position of another robot, m.
    pub fn observe(&mut self, id: RobotId, position: Vector<D>) -> Result<Observed, ObserveError> {
        let own = self.position.ok_or(ObserveError::NoPosition)?;
        if id == self.id {
            return Err(ObserveError::OwnId);
        }
        if !is_finite(&position) {
            return Err(ObserveError::NotFinite);
        }
        let offset_m = subtract(&own, &position);
        let distance_m2 = dot(&offset_m, &offset_m);
        let link = self.link_at(distance_m2);
        if link.is_none() && distance_m2 > self.params.sight_m2() {
            self.lose(id);
            return Ok(Observed::OutOfRange);
        }
        let index = self.slot(id)?;
        let slot = &mut self.slots[index];
        if slot.seen_before && watches(&self.params) {
            self.assurance.watch(&self.params, self.now, slot, &offset_m);
        }
        (slot.sensed, slot.seen_before, slot.offset_m) = (true, false, offset_m);
        slot.position_m = position;
        (slot.linked, slot.link) = (link.is_some(), link.unwrap_or(NO_LINK));
        Ok(if slot.linked { Observed::Neighbor } else { Observed::InView })
    }

    /// What to tell now: the level when τ₁ has passed, with the value when τ₂ has. A robot that is late for a round by more
    /// than a velocity may be held, as after a crash, waits for the next one, so that all have theirs at the same time.
    ///
    /// Forgets robots that were not observed in this tick. `None` while nothing is due or the own position is unknown.
    //= paper eq:connectivity
    pub fn share(&mut self) -> Option<Message> {
        self.position?;
        self.forget_unsensed();
        let level_due = self.level_timer.fires(self.now);
        let value_due = self.value_timer.fires_in_turn(self.now, self.params.settings().hold_max());
        if level_due {
            self.level = self.own_level();
            self.level_at = self.now;
            self.told_level = self.level;
        }
        if value_due {
            self.begin_round();
        }
        if !level_due && !value_due {
            return None;
        }
        self.sequence = self.sequence.saturating_add(1);
        Message::new(self.sequence, self.level_at, self.told_level, value_due.then_some(self.value)).ok()
    }

    /// Takes a message that arrived from `sender`.
    pub fn receive(&mut self, sender: RobotId, message: &Message) -> Result<(), ReceiveError> {
        let (now, stamp) = (self.now, message.stamp());
        let in_round = message.value().is_some() && self.in_round(stamp);
        let index = self.find(sender).ok_or(ReceiveError::NotNeighbor)?;
        let slot = &mut self.slots[index];
        if !slot.sensed {
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

    /// Ends the tick: the velocity closest to `desired` (m/s) that satisfies the robot's row, and W-MSR if a round is on.
    pub fn tick(&mut self, desired: Vector<D>) -> Output<D> {
        let round = self.end_round();
        let Some(position) = self.position else {
            self.assurance.lose(self.now);
            return self.stopped(round);
        };
        let known = is_finite(&desired);
        let desired = if known { desired } else { [0.0; D] };
        let (velocity_m_s, outcome, phi) = match self.params.settings().controller {
            Controller::Composed => {
                let Composition { row, phi } = self.composition();
                let solution = closest(&desired, &row, &self.params.settings().input);
                (solution.velocity_m_s, solution.outcome, Some(phi))
            }
            Controller::Budget => {
                let (velocity_m_s, outcome) = self.budget_velocity(&desired);
                (velocity_m_s, outcome, None)
            }
        };
        let mut report = self.report(phi, outcome, round);
        if !known {
            report.mode = Mode::Hold;
        }
        self.assurance.moved(self.now, position, velocity_m_s);
        Output { velocity_m_s, report }
    }

    /// When the next share is due.
    #[must_use]
    pub fn poll_at(&self) -> Instant {
        self.level_timer.due().min(self.value_timer.due())
    }

    /// Where it counts itself in this tick, m: where it sensed itself, or with a tracking error where its moves have taken it
    /// since it last had to begin anew. `None` without a usable position.
    #[must_use]
    pub fn reference(&self) -> Option<Vector<D>> {
        self.position
    }

    /// True if it had to begin anew in this tick: it is not where its last move should have taken it, or was not called in
    /// time. Only under `budget`.
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

    /// c_i as told: differs from the sensed level only after [`restate`](Self::restate).
    #[must_use]
    pub fn told_level(&self) -> f64 {
        self.told_level
    }

    /// φ_i (eq:phi_i) of what the robot senses and was told, whatever the controller. Under `budget` nothing depends on it,
    /// so that it is not computed unless somebody asks.
    #[must_use]
    pub fn phi(&self) -> f64 {
        if self.position.is_none() {
            return self.composition().phi;
        }
        let levels = self.linked().filter_map(|slot| slot.told.map(|told| told.level));
        let distances_m2 = self.linked().map(|slot| dot(&slot.offset_m, &slot.offset_m));
        self.params.composed().phi(self.told_level, levels, distances_m2)
    }

    /// The neighbours in order of their number.
    #[must_use]
    pub fn neighbors(&self) -> &[Slot<D>] {
        &self.slots[..self.count]
    }

    pub(crate) fn sensed(&self) -> impl Iterator<Item = &Slot<D>> + Clone {
        self.neighbors().iter().filter(|slot| slot.sensed)
    }

    /// Those of them within R as sensed: all of them unless there is a margin.
    pub(crate) fn linked(&self) -> impl Iterator<Item = &Slot<D>> + Clone {
        self.sensed().filter(|slot| slot.linked)
    }

    /// Only the row of `composed` needs slopes that `f64` takes for 0.
    fn link_at(&self, distance_m2: f64) -> Option<Link> {
        let shape = self.params.link();
        match self.params.settings().controller {
            Controller::Composed => shape.link_at(distance_m2),
            Controller::Budget => shape.link_at::<f64>(distance_m2).map(Link::from),
        }
    }

    /// Without a position nobody is a neighbour, and the robot itself counts for nothing.
    fn composition(&self) -> Composition<D> {
        let composed = self.params.composed();
        if self.position.is_none() {
            return composed.compose(Scaled::ZERO, core::iter::empty::<Term<D>>());
        }
        let own = composed.degree_term(self.told_level);
        composed.compose(own, self.linked().map(|slot| slot.term(composed)))
    }
}
