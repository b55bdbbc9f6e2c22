//! What a robot is told once, at construction: checked here and constant from then on.

use crate::controller::budget::curvature::Curvature;
use crate::controller::budget::settings::{Budget, Form};
use crate::equations::barrier::required_degree;
use crate::equations::composition::Composed;
use crate::equations::link::LinkShape;
use crate::need::Need;
use crate::num::is_finite;
use crate::program::balls::reach::Reach;
use crate::settings::range::{Allowed, Field, ParamsError};
pub use crate::settings::{Controller, Settings};

/// Greatest number of robots in a team.
pub const ROBOTS_MAX: u16 = 10_000;
/// Greatest magnitude of any length, weight or speed: far outside use, far inside `f64`.
pub const MAGNITUDE_MAX: f64 = 1e6;

/// Checked settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Params<const D: usize> {
    settings: Settings<D>,
    link: LinkShape,
    composed: Composed,
    budget: Budget,
    reach: Reach<D>,
    sight_m2: f64,
    hold_s: f64,
}

impl<const D: usize> Settings<D> {
    fn check(&self) -> Result<(), ParamsError> {
        let positive = Allowed::LeftOpen(0.0, MAGNITUDE_MAX);
        let (n, radius) = (f64::from(self.robots), self.radius_m);
        let faults_max = f64::from(self.robots.saturating_sub(1) / 2);
        let period_s = self.level_period.as_secs_f64();
        let error = Allowed::Closed(0.0, MAGNITUDE_MAX);
        let checks = [
            (Field::Robots, n, Allowed::Closed(2.0, f64::from(ROBOTS_MAX))),
            (Field::Faults, f64::from(self.faults), Allowed::Closed(0.0, faults_max)),
            (Field::RadiusM, radius, positive),
            (Field::PositionErrorM, self.position_error_m, error),
            (Field::TrackingErrorM, self.tracking_error_m, error),
            (Field::DistanceMinM, self.distance_min_m, Allowed::Open(0.0, self.distance_limit())),
            (Field::Epsilon, self.epsilon(), Allowed::Open(0.0, 1.0 / (n - 1.0))),
            (Field::Q2, self.q2, positive),
            (Field::WR, self.w_r, positive),
            (Field::WC, self.w_c, positive),
            (Field::Alpha, self.alpha, positive),
            (Field::LevelPeriod, self.level_period.as_secs_f64(), positive),
            (Field::ValuePeriod, self.value_period.as_secs_f64(), positive),
            (Field::Gamma, self.gamma(), Allowed::LeftOpen(0.0, 1.0)),
            (Field::Rise, self.rise, Allowed::Closed(0.0, MAGNITUDE_MAX)),
            (Field::GammaC, self.gamma_c, Allowed::LeftOpen(0.0, 1.0)),
            (Field::HoldMax, self.hold_max().as_secs_f64(), Allowed::Closed(period_s, MAGNITUDE_MAX)),
            (Field::ToldMax, self.told_max.as_secs_f64(), positive),
            (Field::ClockError, self.clock_error.as_secs_f64(), Allowed::Closed(0.0, MAGNITUDE_MAX)),
        ];
        let failed = checks.into_iter().find(|(_, value, allowed)| !allowed.holds(*value));
        failed.map_or(Ok(()), |(field, value, allowed)| Err(ParamsError { field, value, allowed }))
    }

    /// Δ_d must be below R, and with `budget` below R − 2ρ − 4A: robots that are not linked have no row for their distance.
    fn distance_limit(&self) -> f64 {
        match self.controller {
            Controller::Composed => self.radius_m,
            Controller::Budget => self.radius_m - 2.0 * self.reach().longest_m() - 4.0 * self.margin().away_m,
        }
    }

    /// `T U_i`, T the longest that a velocity is held.
    fn reach(&self) -> Reach<D> {
        Reach::new(&self.input, self.hold_max().as_secs_f64())
    }

    fn budget(&self, link: LinkShape) -> Budget {
        let errors = self.margin();
        let link = LinkShape { radius_m: link.radius_m - 2.0 * errors.away_m, ..link };
        Budget {
            curvature: Curvature::new(link),
            need: Need::new(self.robots, self.faults, self.assume.keep()),
            faults: self.faults,
            distance_min_m: self.distance_min_m + 2.0 * errors.away_m,
            move_max_m: self.reach().longest_m(),
            gamma: self.gamma(),
            gain_slope: self.rise,
            gamma_c: self.gamma_c,
            trust: self.trust,
            assume: self.assume,
            form: Form::Level,
            errors,
        }
    }

    fn check_input(&self) -> Result<(), ParamsError> {
        let low = Allowed::Closed(-MAGNITUDE_MAX, 0.0);
        let high = Allowed::Closed(0.0, MAGNITUDE_MAX);
        for (field, corner, allowed) in
            [(Field::InputMinMS, self.input.min_m_s, low), (Field::InputMaxMS, self.input.max_m_s, high)]
        {
            if let Some(&value) = corner.iter().find(|&&value| !allowed.holds(value)) {
                return Err(ParamsError { field, value, allowed });
            }
        }
        debug_assert!(is_finite(&self.input.min_m_s) && is_finite(&self.input.max_m_s));
        Ok(())
    }
}

impl<const D: usize> Params<D> {
    /// Checks every setting; the first that is outside its range is the error.
    pub fn new(settings: Settings<D>) -> Result<Self, ParamsError> {
        settings.check_input()?;
        settings.check()?;
        let link = LinkShape { radius_m: settings.radius_m, q1: 2.0 + settings.epsilon(), q2: settings.q2 };
        let composed = Composed {
            share: settings.share,
            w_r: settings.w_r,
            w_c: settings.w_c,
            alpha: settings.alpha,
            robots: settings.robots,
            required: required_degree(settings.robots, settings.faults),
            distance_min_m: settings.distance_min_m,
        };
        let (budget, reach) = (settings.budget(link), settings.reach());
        let sight_m = budget.curvature.link().radius_m + budget.errors.offset_m;
        let hold_s = settings.hold_max().as_secs_f64();
        Ok(Self { settings, link, composed, budget, reach, sight_m2: sight_m * sight_m, hold_s })
    }

    /// The settings as they were given.
    #[must_use]
    pub fn settings(&self) -> &Settings<D> {
        &self.settings
    }

    /// Shape of the links.
    #[must_use]
    pub fn link(&self) -> &LinkShape {
        &self.link
    }

    /// The paper's controller.
    #[must_use]
    pub fn composed(&self) -> &Composed {
        &self.composed
    }

    /// Our controller.
    #[must_use]
    pub fn budget(&self) -> &Budget {
        &self.budget
    }

    /// The displacements of one tick, `T U_i`.
    #[must_use]
    pub fn reach(&self) -> &Reach<D> {
        &self.reach
    }

    /// Square of the distance up to which sensed robots matter, m²: R, and the margin of `budget`.
    #[must_use]
    pub fn sight_m2(&self) -> f64 {
        self.sight_m2
    }

    /// How long a velocity may be held, s.
    #[must_use]
    pub fn hold_s(&self) -> f64 {
        self.hold_s
    }

    /// F′.
    #[must_use]
    pub fn required_degree(&self) -> u16 {
        self.composed.required
    }
}

#[cfg(test)]
mod tests {
    use core::time::Duration;

    use super::*;

    type Change = fn(&mut Settings<2>);

    #[test]
    fn the_defaults_are_the_papers() {
        let params = Params::<2>::new(Settings::default()).unwrap();
        assert_eq!(params.required_degree(), 7);
        assert!((params.link().q1 - 2.099).abs() < 1e-12);
        Params::<3>::new(Settings::default()).unwrap();
    }

    #[test]
    fn each_setting_is_refused_outside_its_range() {
        let wrong: [(Field, Change); 17] = [
            (Field::Robots, |s| s.robots = 1),
            (Field::Robots, |s| s.robots = ROBOTS_MAX + 1),
            (Field::Faults, |s| s.faults = 6),
            (Field::RadiusM, |s| s.radius_m = f64::NAN),
            (Field::DistanceMinM, |s| s.distance_min_m = 3.0),
            (Field::Epsilon, |s| s.epsilon = Some(0.1)),
            (Field::Epsilon, |s| s.epsilon = Some(0.0)),
            (Field::Q2, |s| s.q2 = 0.0),
            (Field::WR, |s| s.w_r = -1.0),
            (Field::WC, |s| s.w_c = f64::INFINITY),
            (Field::Alpha, |s| s.alpha = 2e6),
            (Field::Gamma, |s| s.gamma = Some(0.0)),
            (Field::GammaC, |s| s.gamma_c = 1.1),
            (Field::DistanceMinM, |s| (s.controller, s.distance_min_m) = (Controller::Budget, 2.98)),
            (Field::InputMinMS, |s| s.input.min_m_s[1] = 0.1),
            (Field::InputMaxMS, |s| s.input.max_m_s[0] = f64::NAN),
            (Field::LevelPeriod, |s| s.level_period = Duration::ZERO),
        ];
        for (field, change) in wrong {
            let mut settings = Settings::default();
            change(&mut settings);
            assert_eq!(Params::new(settings).unwrap_err().field, field);
        }
    }

    #[test]
    fn the_largest_team_has_an_epsilon() {
        let settings = Settings::<2> { robots: ROBOTS_MAX, ..Settings::default() };
        Params::new(settings).unwrap();
    }
}
