//! What a robot can check about the assumptions of the theorem while it runs.

use core::time::Duration;

use crate::num::{Vector, add_scaled, dot, length, subtract};
use crate::robot::neighbor::Slot;
use crate::robot::report::Reason;
use crate::settings::params::Params;
use crate::time::Instant;

/// How much a position and a clock may be rounded in one tick, as fractions. Deviations up to these are no reason to
/// complain.
const ROUNDING: f64 = 1e-9;
const CLOCK: f64 = 0.01;

/// Where the robot should be, and since when it cannot promise anything.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Assurance<const D: usize> {
    /// The time of the last tick, the reference in it, and the velocity since.
    last: Option<(Instant, Vector<D>, Vector<D>)>,
    /// True if the reference of this tick is not the last one plus its move.
    pub(crate) anew: bool,
    /// True if this tick came in time after the last one.
    in_time: bool,
    /// The last time an assumption was seen broken, and which.
    broken: Option<(Instant, Reason)>,
    /// What speaks against the state of this tick. It is `Uncertain` only if the theorem carries no earlier certain state on.
    doubt: Option<Reason>,
}

impl<const D: usize> Assurance<D> {
    pub(crate) const NEW: Self =
        Self { last: None, anew: true, in_time: false, broken: None, doubt: Some(Reason::Uncertain) };

    /// Where the robot counts itself: where it senses itself, or with a tracking error where its moves have taken it.
    ///
    /// Notes when it is not where it should be, or was not called in time. It then begins anew from where it is.
    pub(crate) fn place(&mut self, params: &Params<D>, now: Instant, sensed: Vector<D>) -> Vector<D> {
        (self.anew, self.in_time) = (true, false);
        let errors = params.kept().errors;
        let Some((then, position, velocity)) = self.last else { return sensed };
        let (elapsed, hold_max) = (now.since(then), params.settings().clock.hold_max());
        let expected = add_scaled(&position, elapsed.min(hold_max).as_secs_f64(), &velocity);
        let late = elapsed > hold_max;
        self.in_time = !late;
        if late {
            self.broken = Some((now, Reason::Late));
        }
        // Where a velocity is held for exactly a period, a robot that is late has stopped at a known place.
        if late && (hold_max != params.settings().clock.level_period || errors.away_m == 0.0) {
            return sensed;
        }
        let span_m = params.reach().longest_m() + length(&sensed);
        let blur_m = ROUNDING * span_m + CLOCK * length(&subtract(&expected, &position));
        let away_m = length(&subtract(&sensed, &expected));
        // Against a known reference one sensed position is wrong; without references two are.
        let most_m = if errors.away_m > 0.0 { errors.sensed_m() } else { errors.offset_m };
        if away_m.is_nan() || away_m > most_m + blur_m {
            self.broken = Some((now, Reason::Moved));
            return sensed;
        }
        self.anew = false;
        if errors.away_m > 0.0 { expected } else { sensed }
    }

    /// Notes a neighbour that went farther since the last tick than it can.
    pub(crate) fn watch(&mut self, params: &Params<D>, now: Instant, slot: &Slot<D>, offset_m: &Vector<D>) {
        if !self.in_time || !params.controller().is_obeyed() {
            return;
        }
        let way_m = subtract(offset_m, &slot.offset_m);
        let most_m = (2.0 * params.reach().longest_m() + 2.0 * params.kept().errors.offset_m) * (1.0 + CLOCK);
        if dot(&way_m, &way_m) <= most_m * most_m {
            return;
        }
        if length(&way_m) > most_m + ROUNDING * length(&slot.position_m) {
            self.broken = Some((now, Reason::Moved));
        }
    }

    /// Notes that an assumption was seen broken.
    pub(crate) fn note(&mut self, now: Instant, reason: Reason) {
        self.broken = Some((now, reason));
    }

    /// Notes what the rows of this tick say about its state. What is only uncertain does not count while the theorem carries
    /// the last certain state on.
    pub(crate) fn doubt(&mut self, now: Instant, doubt: Option<Reason>) {
        let carried = self.doubt.is_none() && self.broken.is_none_or(|(then, _)| then != now);
        self.doubt = doubt.filter(|reason| *reason != Reason::Uncertain || !carried);
    }

    /// Ends a tick in which the robot counted itself at `position` and moves with `velocity`.
    pub(crate) fn moved(&mut self, now: Instant, position: Vector<D>, velocity: Vector<D>) {
        self.last = Some((now, position, velocity));
    }

    /// Forgets where the robot was, because there is no position.
    pub(crate) fn lose(&mut self, now: Instant) {
        if self.last.take().is_some() {
            self.broken = Some((now, Reason::Late));
        }
    }

    /// Why nothing is guaranteed now; `None` if nothing speaks against it.
    pub(crate) fn reason(&self, now: Instant, told_max: Duration) -> Option<Reason> {
        let recent = self.broken.filter(|(then, _)| now.is_within(told_max, *then));
        let recent = recent.map(|(_, reason)| reason);
        match self.doubt {
            Some(Reason::Uncertain) => recent.or(self.doubt),
            doubt => doubt.or(recent),
        }
    }
}
