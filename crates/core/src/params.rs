//! What a robot is told once, at construction: checked here and constant from then on.

use core::time::Duration;

use crate::allowed::{Allowed, Field, ParamsError};
use crate::barrier::required_degree;
use crate::budget::curvature::Curvature;
use crate::budget::knowledge::{Assume, Trust};
use crate::budget::reach::Reach;
use crate::budget::settings::{Budget, Form, share_of_rate};
use crate::composed::{Composed, Share};
use crate::link::LinkShape;
use crate::math::is_finite;
use crate::program::InputBox;

/// Greatest number of robots in a team.
pub const ROBOTS_MAX: u16 = 10_000;
/// Greatest magnitude of any length, weight or speed: far outside use, far inside `f64`.
pub const MAGNITUDE_MAX: f64 = 1e6;

/// Which controller a robot runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Controller {
    /// The paper's, as printed ([`crate::composed`]).
    Composed,
    /// Ours ([`crate::budget`]): a guarantee in discrete time, for any lie and any loss of told levels.
    Budget,
}

/// Everything the paper leaves as a parameter, unchecked. `Default` holds the paper's values and, where it prints
/// none, ours (METHOD.md section 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings<const D: usize> {
    /// n, 2 to [`ROBOTS_MAX`].
    pub robots: u16,
    /// F, with 2F + 1 ≤ n.
    pub faults: u16,
    /// R, m.
    pub radius_m: f64,
    /// Δ_d, m, less than R.
    pub distance_min_m: f64,
    /// ε of q₁ = 2 + ε, with 0 < ε < 1/(n−1); `None` for 1/(n−1) − 0.001, and half of 1/(n−1) where that is not positive.
    pub epsilon: Option<f64>,
    /// q₂, 1/m⁴.
    pub q2: f64,
    /// w_r.
    pub w_r: f64,
    /// w_c, 1/m².
    pub w_c: f64,
    /// α(s) = alpha·s, 1/s.
    pub alpha: f64,
    /// Which φ_i.
    pub share: Share,
    /// Which controller.
    pub controller: Controller,
    /// γ of `budget`: the share of h_k that may be lost in a tick, in (0, 1]; `None` for a rate of 2/s, which lets robots
    /// get farther than METHOD.md's 0.2 a tick ([`share_of_rate`]).
    pub gamma: Option<f64>,
    /// γ_c of `budget`: the share of D − Δ_d² that may be lost in a tick, in (0, 1].
    pub gamma_c: f64,
    /// What `budget` believes of levels.
    pub trust: Trust,
    /// What `budget` assumes of malicious robots.
    pub assume: Assume,
    /// U_i.
    pub input: InputBox<D>,
    /// τ₁: how often the level is shared.
    pub level_period: Duration,
    /// τ₂: how often the value is shared and updated.
    pub value_period: Duration,
}

/// Checked settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Params<const D: usize> {
    settings: Settings<D>,
    link: LinkShape,
    composed: Composed,
    budget: Budget,
    reach: Reach<D>,
}

impl<const D: usize> Default for Settings<D> {
    fn default() -> Self {
        Self {
            robots: 11,
            faults: 2,
            radius_m: 3.0,
            distance_min_m: 0.3,
            epsilon: None,
            q2: 0.3,
            w_r: 15.0,
            w_c: 25.0,
            alpha: 0.1,
            share: Share::Neighbours,
            controller: Controller::Composed,
            gamma: None,
            gamma_c: 0.2,
            trust: Trust::ToldOrSeen,
            assume: Assume::Obedient,
            input: InputBox { min_m_s: [-1.5; D], max_m_s: [1.5; D] },
            level_period: Duration::from_millis(5),
            value_period: Duration::from_millis(100),
        }
    }
}

impl<const D: usize> Settings<D> {
    /// ε: the one given, or the default for this n.
    #[must_use]
    pub fn epsilon(&self) -> f64 {
        let limit = 1.0 / (f64::from(self.robots) - 1.0);
        self.epsilon.unwrap_or(if limit > 0.001 { limit - 0.001 } else { limit / 2.0 })
    }

    /// γ: the one given, or the share of a rate of 2/s for this tick.
    #[must_use]
    pub fn gamma(&self) -> f64 {
        self.gamma.unwrap_or_else(|| share_of_rate(2.0, self.level_period.as_secs_f64()))
    }

    fn check(&self) -> Result<(), ParamsError> {
        let positive = Allowed::LeftOpen(0.0, MAGNITUDE_MAX);
        let (n, radius) = (f64::from(self.robots), self.radius_m);
        let faults_max = f64::from(self.robots.saturating_sub(1) / 2);
        let checks = [
            (Field::Robots, n, Allowed::Closed(2.0, f64::from(ROBOTS_MAX))),
            (Field::Faults, f64::from(self.faults), Allowed::Closed(0.0, faults_max)),
            (Field::RadiusM, radius, positive),
            (Field::DistanceMinM, self.distance_min_m, Allowed::Open(0.0, self.distance_limit())),
            (Field::Epsilon, self.epsilon(), Allowed::Open(0.0, 1.0 / (n - 1.0))),
            (Field::Q2, self.q2, positive),
            (Field::WR, self.w_r, positive),
            (Field::WC, self.w_c, positive),
            (Field::Alpha, self.alpha, positive),
            (Field::LevelPeriod, self.level_period.as_secs_f64(), positive),
            (Field::ValuePeriod, self.value_period.as_secs_f64(), positive),
            (Field::Gamma, self.gamma(), Allowed::LeftOpen(0.0, 1.0)),
            (Field::GammaC, self.gamma_c, Allowed::LeftOpen(0.0, 1.0)),
        ];
        let failed = checks.into_iter().find(|(_, value, allowed)| !allowed.holds(*value));
        failed.map_or(Ok(()), |(field, value, allowed)| Err(ParamsError { field, value, allowed }))
    }

    /// Δ_d must be below R, and with `budget` below R − 2ρ: robots that are not linked have no row for their distance.
    fn distance_limit(&self) -> f64 {
        match self.controller {
            Controller::Composed => self.radius_m,
            Controller::Budget => self.radius_m - 2.0 * self.reach().longest_m(),
        }
    }

    /// `T U_i`, T = τ₁.
    fn reach(&self) -> Reach<D> {
        Reach::new(&self.input, self.level_period.as_secs_f64())
    }

    fn budget(&self, link: LinkShape) -> Budget {
        Budget {
            curvature: Curvature::new(link),
            robots: self.robots,
            faults: self.faults,
            distance_min_m: self.distance_min_m,
            move_max_m: self.reach().longest_m(),
            gamma: self.gamma(),
            gamma_c: self.gamma_c,
            trust: self.trust,
            assume: self.assume,
            form: Form::Level,
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
        Ok(Self { settings, link, composed, budget: settings.budget(link), reach: settings.reach() })
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

    /// F′.
    #[must_use]
    pub fn required_degree(&self) -> u16 {
        self.composed.required
    }
}

#[cfg(test)]
mod tests {
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
