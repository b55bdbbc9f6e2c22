//! Whether settings are what they may be.

use crate::num::is_finite;
use crate::settings::field::{Field, TABLE};
use crate::settings::range::{Allowed, MAGNITUDE_MAX};
use crate::settings::{Settings, Team};

/// A setting outside what is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParamsError {
    /// Which number it is about.
    pub field: Field,
    /// What the number is (in s for periods).
    pub value: f64,
    /// What it may be.
    pub allowed: Allowed,
}

impl<const D: usize> Settings<D> {
    /// Checks every setting; the first that is outside its range is the error.
    pub(crate) fn check(self) -> Result<(), ParamsError> {
        self.check_input()?;
        self.check_numbers()?;
        self.check_ranks()
    }

    fn check_numbers(mut self) -> Result<(), ParamsError> {
        let limit_m = self.distance_limit();
        let parts = self.parts(limit_m);
        for row in &TABLE {
            let Some(value) = (row.get)(&parts) else { continue };
            let allowed = row.allowed(&parts);
            if !allowed.holds(value) {
                return Err(ParamsError { field: row.field, value, allowed });
            }
        }
        Ok(())
    }

    /// What Δ_d must be below: R, or R − 2ρ − 4A where robots that are not linked have no row for their distance.
    fn distance_limit(&self) -> f64 {
        if !self.controller.traits().ignores_unlinked {
            return self.link.radius_m;
        }
        self.link.radius_m - 2.0 * self.reach().longest_m() - 4.0 * self.error_bounds().away_m
    }

    /// m is at least 2F + 1; n where the controller knows of no ranks.
    fn check_ranks(&self) -> Result<(), ParamsError> {
        let Some(ranks) = self.ranks else { return Ok(()) };
        let (core, Team { robots, faults }) = (f64::from(ranks.core), self.team);
        let ranked = self.controller.traits().knows_ranks;
        let least = if ranked { f64::from(faults) * 2.0 + 1.0 } else { f64::from(robots) };
        let allowed = Allowed::Closed(least, f64::from(robots));
        if allowed.holds(core) {
            Ok(())
        } else {
            Err(ParamsError { field: Field::Core, value: core, allowed })
        }
    }

    fn check_input(&self) -> Result<(), ParamsError> {
        let low = Allowed::Closed(-MAGNITUDE_MAX, 0.0);
        let high = Allowed::Closed(0.0, MAGNITUDE_MAX);
        let input = &self.limits.input;
        for (field, corner, allowed) in
            [(Field::InputMinMS, input.min_m_s, low), (Field::InputMaxMS, input.max_m_s, high)]
        {
            if let Some(&value) = corner.iter().find(|&&value| !allowed.holds(value)) {
                return Err(ParamsError { field, value, allowed });
            }
        }
        debug_assert!(is_finite(&input.min_m_s) && is_finite(&input.max_m_s));
        Ok(())
    }
}

impl core::fmt::Display for ParamsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{} is {}, allowed is {}", self.field.name(), self.value, self.allowed)?;
        let why = self.field.why();
        if why.is_empty() { Ok(()) } else { write!(f, " ({why})") }
    }
}

impl core::error::Error for ParamsError {}

#[cfg(test)]
mod tests {
    extern crate std;

    use core::time::Duration;

    use super::*;
    use crate::controller::assume::Assume;
    use crate::need::{Listen, Ranks};
    use crate::settings::range::ROBOTS_MAX;
    use crate::settings::{BudgetSettings, ComposedSettings, Controller, LinksSettings};

    type Change = fn(&mut Settings<2>);

    fn composed(settings: &mut Settings<2>, change: impl FnOnce(&mut ComposedSettings)) {
        if let Controller::Composed(composed) = &mut settings.controller {
            change(composed);
        }
    }

    fn budget(settings: &mut Settings<2>, change: impl FnOnce(&mut BudgetSettings)) {
        let mut parameters = BudgetSettings::default();
        change(&mut parameters);
        settings.controller = Controller::Budget(parameters);
    }

    #[test]
    fn each_setting_is_refused_outside_its_range() {
        let wrong: [(Field, Change); 24] = [
            (Field::Robots, |s| s.team.robots = 1),
            (Field::Robots, |s| s.team.robots = ROBOTS_MAX + 1),
            (Field::Faults, |s| s.team.faults = 6),
            (Field::RadiusM, |s| s.link.radius_m = f64::NAN),
            (Field::DistanceMinM, |s| s.limits.distance_min_m = 3.0),
            (Field::Epsilon, |s| s.link.epsilon = Some(0.1)),
            (Field::Epsilon, |s| s.link.epsilon = Some(0.0)),
            (Field::Q2, |s| s.link.q2 = 0.0),
            (Field::WR, |s| composed(s, |composed| composed.w_r = -1.0)),
            (Field::WC, |s| composed(s, |composed| composed.w_c = f64::INFINITY)),
            (Field::Alpha, |s| composed(s, |composed| composed.alpha = 2e6)),
            (Field::Gamma, |s| budget(s, |budget| budget.gamma = Some(0.0))),
            (Field::GammaC, |s| budget(s, |budget| budget.gamma_c = Some(1.1))),
            (Field::OwnQ2, |s| budget(s, |budget| budget.q2 = Some(0.0))),
            (Field::OwnEpsilon, |s| budget(s, |budget| budget.epsilon = Some(0.0))),
            (Field::OwnEpsilon, |s| budget(s, |budget| budget.epsilon = Some(2.0 / 6.0))),
            (Field::OwnEpsilon, |s| {
                budget(s, |budget| (budget.epsilon, budget.assume) = (Some(2.0 / 5.0), Assume::Free));
            }),
            (Field::DistanceMinM, |s| {
                budget(s, |_| ());
                s.limits.distance_min_m = 2.98;
            }),
            (Field::InputMinMS, |s| s.limits.input.min_m_s[1] = 0.1),
            (Field::InputMaxMS, |s| s.limits.input.max_m_s[0] = f64::NAN),
            (Field::LevelPeriod, |s| s.clock.level_period = Duration::ZERO),
            (Field::Core, |s| {
                s.controller = Controller::Links(LinksSettings::default());
                s.ranks = Some(Ranks { core: 4, listen: Listen::All });
            }),
            (Field::Core, |s| {
                s.controller = Controller::Links(LinksSettings::default());
                s.ranks = Some(Ranks { core: 12, listen: Listen::All });
            }),
            (Field::Core, |s| s.ranks = Some(Ranks { core: 7, listen: Listen::All })),
        ];
        for (field, change) in wrong {
            let mut settings = Settings::default();
            change(&mut settings);
            assert_eq!(settings.check().unwrap_err().field, field);
        }
    }

    #[test]
    fn an_error_names_the_field_of_a_file_and_what_is_allowed() {
        let mut settings = Settings::<2>::default();
        settings.team.faults = 6;
        let error = settings.check().unwrap_err();
        assert_eq!(std::format!("{error}"), "team.faults is 6, allowed is 0 to 5 (2F + 1 <= n)");
    }
}
