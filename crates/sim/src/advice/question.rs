//! What is asked: a scenario, with numbers set by their names in files, a speed and a lag.

use closeranks_core::controller::assume::Assume;
use closeranks_core::program::InputBox;
use closeranks_core::program::balls::reach::Reach;
use closeranks_core::settings::field::{Field, Row, TABLE};
use closeranks_core::settings::range::{Allowed, MAGNITUDE_MAX};

use super::ASSUMPTIONS;
use crate::controllers::Controller;
use crate::parse::common::{DELAY, NOT_NEGATIVE};
use crate::plant::Plant;
use crate::scenario::Scenario;

/// A team about which advice is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// Team, link, limits, clock and stated errors. Its controller counts as `budget`.
    pub scenario: Scenario,
    /// Time constant of how bodies follow velocities, s. If it is given, the tracking error is this times the greatest speed,
    /// whatever the scenario states.
    pub lag_s: Option<f64>,
}

/// The row of a number by its name in files.
fn row(name: &str) -> Option<&'static Row> {
    TABLE.iter().find(|row| row.name == name)
}

/// What a number may be, by its name in files; of the two that files do not have, `speed` and `lag`, too.
#[must_use]
pub fn allowed(name: &str) -> Option<Allowed> {
    match name {
        "speed" => Some(NOT_NEGATIVE),
        "lag" => Some(DELAY),
        _ => row(name).map(|row| row.range),
    }
}

impl Question {
    /// About this scenario as it stands.
    #[must_use]
    pub fn new(scenario: Scenario) -> Self {
        Self { scenario, lag_s: None }
    }

    /// Sets a number by its name in files, `speed` (per axis, m/s, in place of a limit in any direction) or `lag` (s). Other names change
    /// nothing. With another n, F is what it was or as many as n allows.
    pub fn set(&mut self, name: &str, value: f64) {
        match name {
            "speed" => self.set_speed(value),
            "lag" => self.lag_s = Some(value),
            _ => {
                if let Some(row) = row(name) {
                    (row.set)(&mut self.scenario.parts(), value);
                }
                if name == Field::Robots.name() {
                    let team = &mut self.scenario.team;
                    team.faults = team.faults.min(team.robots.saturating_sub(1) / 2);
                }
            }
        }
    }

    /// Sets what is assumed of malicious robots, by its name in files.
    pub fn set_assume(&mut self, name: &str) {
        if let Some((_, assume)) = ASSUMPTIONS.iter().find(|(known, _)| *known == name) {
            self.scenario.budget.assume = *assume;
        }
    }

    /// Sets the number of dimensions, 2 or 3. In another one than before, the greatest speed is the same along every axis.
    pub fn set_dimension(&mut self, dimension: usize) {
        let speed_m_s = self.axis_speed_m_s();
        if self.scenario.dimension != dimension {
            self.scenario.dimension = dimension;
            let disc_m_s = self.scenario.limits.speed_max_m_s;
            self.set_speed(speed_m_s);
            self.scenario.limits.speed_max_m_s = disc_m_s;
        }
    }

    /// The same speed along every axis, both ways, and no other limit.
    fn set_speed(&mut self, speed_m_s: f64) {
        let dimension = self.scenario.dimension;
        self.scenario.limits.speed_max_m_s = f64::INFINITY;
        self.scenario.limits.input_min_m_s = vec![-speed_m_s; dimension];
        self.scenario.limits.input_max_m_s = vec![speed_m_s; dimension];
    }

    /// The greatest speed along an axis, m/s.
    #[must_use]
    pub fn axis_speed_m_s(&self) -> f64 {
        let limits = &self.scenario.limits;
        let all = limits.input_min_m_s.iter().chain(&limits.input_max_m_s);
        all.fold(0.0, |most: f64, speed| most.max(speed.abs())).min(limits.speed_max_m_s)
    }

    /// The same question for inputs of the same shape, box and disc, with this greatest speed along an axis, m/s.
    pub(super) fn at_speed(&self, speed_m_s: f64) -> Self {
        let (mut asked, now_m_s) = (self.clone(), self.axis_speed_m_s());
        if now_m_s > 0.0 {
            let scaled = |speeds: &mut Vec<f64>| {
                for speed in speeds {
                    *speed = (*speed / now_m_s * speed_m_s).clamp(-MAGNITUDE_MAX, MAGNITUDE_MAX);
                }
            };
            scaled(&mut asked.scenario.limits.input_min_m_s);
            scaled(&mut asked.scenario.limits.input_max_m_s);
            let disc_m_s = asked.scenario.limits.speed_max_m_s / now_m_s * speed_m_s;
            // A box without any speed needs no disc, which must have some.
            if disc_m_s.is_finite() && disc_m_s > 0.0 {
                asked.scenario.limits.speed_max_m_s = disc_m_s.min(MAGNITUDE_MAX);
            }
        } else {
            asked.set_speed(speed_m_s);
        }
        asked
    }

    /// The same question under another assumption about malicious robots.
    pub(super) fn under(&self, assume: Assume) -> Self {
        let mut asked = self.clone();
        asked.scenario.budget.assume = assume;
        asked
    }

    /// The greatest speed in any direction, m/s.
    #[must_use]
    pub fn speed_m_s(&self) -> f64 {
        match self.scenario.dimension {
            3 => self.reach_m::<3>(1.0),
            _ => self.reach_m::<2>(1.0),
        }
    }

    /// ρ, m: the longest move while a velocity may be held.
    #[must_use]
    pub fn move_max_m(&self) -> f64 {
        let hold_s = self.scenario.clock.hold_max().as_secs_f64();
        match self.scenario.dimension {
            3 => self.reach_m::<3>(hold_s),
            _ => self.reach_m::<2>(hold_s),
        }
    }

    /// How far a robot gets in so many seconds, m.
    fn reach_m<const D: usize>(&self, time_s: f64) -> f64 {
        let limits = &self.scenario.limits;
        let corner = |numbers: &[f64]| core::array::from_fn(|d| numbers.get(d).copied().unwrap_or(0.0));
        let (min_m_s, max_m_s) = (corner(&limits.input_min_m_s), corner(&limits.input_max_m_s));
        let input = InputBox::of(min_m_s, max_m_s).within(limits.speed_max_m_s);
        Reach::<D>::new(&input, time_s).longest_m()
    }

    /// The tracking error that is enough for the bodies of the scenario, m, if they lag and start from rest.
    #[must_use]
    pub fn tracking_needed_m(&self) -> Option<f64> {
        match self.scenario.plant {
            Plant::Lag { lag_s } => Some(lag_s * self.speed_m_s()),
            Plant::Double { .. } => self.scenario.plant.tracking_error_m(),
            Plant::Single | Plant::Unicycle { .. } => None,
        }
    }

    /// The scenario under `budget`, with the tracking error that follows from the lag.
    #[must_use]
    pub fn settled(&self) -> Scenario {
        let mut scenario = self.scenario.clone().under(Controller::Budget);
        if let Some(lag_s) = self.lag_s {
            scenario.errors.tracking_m = lag_s * self.speed_m_s();
        }
        scenario
    }
}
