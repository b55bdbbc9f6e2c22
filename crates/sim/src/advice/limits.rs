//! The fastest speed and the longest tick: as far as the checks of the settings go.

use core::time::Duration;

use closeranks_core::settings::range::MAGNITUDE_MAX;

use super::halving::last;
use super::question::Question;

/// How fast robots may go, and for how long. `None` if nothing is slow or short enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The fastest speed along an axis for this tick, m/s, with a box of inputs of the same shape, and a disc.
    pub speed_m_s: Option<f64>,
    /// The longest tick for this speed, s, with the same time between it and `hold_max_s`.
    pub tick_s: Option<f64>,
}

/// The shortest and the longest tick of which files know, s.
const TICKS_S: [f64; 2] = [1e-6, 3_600.0];

/// The limits for a question of any dimension.
#[must_use]
pub fn limits(question: &Question) -> Limits {
    match question.scenario.dimension {
        3 => of_dimension::<3>(question),
        _ => of_dimension::<2>(question),
    }
}

pub(super) fn of_dimension<const D: usize>(question: &Question) -> Limits {
    let is_allowed = |asked: &Question| asked.settled().params::<D>().is_ok();
    Limits {
        speed_m_s: last(0.0, MAGNITUDE_MAX, |speed_m_s| is_allowed(&question.at_speed(speed_m_s))),
        tick_s: last(TICKS_S[0], TICKS_S[1], |tick_s| is_allowed(&at_tick(question, tick_s))),
    }
}

/// The same question for another tick.
fn at_tick(question: &Question, tick_s: f64) -> Question {
    let mut asked = question.clone();
    let clock = &mut asked.scenario.clock;
    let tick = Duration::try_from_secs_f64(tick_s).unwrap_or(Duration::MAX);
    let jitter = clock.hold_max.map(|hold| hold.saturating_sub(clock.level_period));
    clock.hold_max = jitter.map(|jitter| tick.saturating_add(jitter).min(Duration::from_hours(1)));
    clock.level_period = tick;
    asked
}
