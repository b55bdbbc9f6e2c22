//! Every number of the settings: its name in files, what it is, what it may be. One row each.

pub use crate::settings::parts::Parts;

use crate::controller::budget::weight::Q2_MAX;
use crate::settings::epsilon_of;
use crate::settings::parts::{budget, composed, conditions, links, time, weight, whole};
use crate::settings::range::{Allowed, MAGNITUDE_MAX, ROBOTS_MAX};

/// The name of a number in an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the table says what each is")]
pub enum Field {
    Robots,
    Faults,
    RadiusM,
    Epsilon,
    Q2,
    WR,
    WC,
    Alpha,
    OwnQ2,
    OwnEpsilon,
    Gamma,
    GammaC,
    HeldGamma,
    HeldGammaC,
    HorizonS,
    DistanceMinM,
    ClearanceM,
    SpeedMaxMS,
    PositionErrorM,
    TrackingErrorM,
    LevelPeriod,
    ValuePeriod,
    HoldMax,
    ToldMax,
    ClockError,
    InputMinMS,
    InputMaxMS,
    Core,
}

/// A number of the settings.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Which number it is.
    pub field: Field,
    /// Its name in files, with the table it stands in.
    pub name: &'static str,
    /// What it is, with its unit.
    pub about: &'static str,
    /// What it is now, s for times; `None` if the controller has no such number.
    pub get: fn(&Parts<'_>) -> Option<f64>,
    /// Sets it. A number that is not of the kind of the field is rounded to that kind.
    pub set: fn(&mut Parts<'_>, f64),
    /// What it may be, whatever the others are.
    pub range: Allowed,
    /// What it may be given the others, if they leave less.
    pub limit: Option<Limit>,
    /// Why it may be only that, if it has a limit.
    pub why: &'static str,
}

/// What a number may be, given the others.
pub type Limit = fn(&Parts<'_>) -> Allowed;

const POSITIVE: Allowed = Allowed::LeftOpen(0.0, MAGNITUDE_MAX);
const NOT_NEGATIVE: Allowed = Allowed::Closed(0.0, MAGNITUDE_MAX);
const FRACTION: Allowed = Allowed::LeftOpen(0.0, 1.0);
const TEAM_MAX: f64 = ROBOTS_MAX as f64;
/// 1/m⁴: links of a millimetre are as steep as they are short.
const STEEPNESS: Allowed = Allowed::LeftOpen(0.0, 1e15);
/// A time between two events, s.
const SECONDS: Allowed = Allowed::Closed(1e-6, 3_600.0);

/// All numbers, in the order in which they are checked.
pub const TABLE: [Row; 25] = [
    Row {
        field: Field::Robots,
        name: "team.robots",
        about: "n",
        get: |of| Some(f64::from(of.team.robots)),
        set: |of, to| of.team.robots = whole(to),
        range: Allowed::Closed(2.0, TEAM_MAX),
        limit: None,
        why: "",
    },
    Row {
        field: Field::Faults,
        name: "team.faults",
        about: "F, how many robots may be malicious",
        get: |of| Some(f64::from(of.team.faults)),
        set: |of, to| of.team.faults = whole(to),
        range: Allowed::Closed(0.0, TEAM_MAX),
        limit: Some(|of| Allowed::Closed(0.0, f64::from(of.team.robots.saturating_sub(1) / 2))),
        why: "2F + 1 <= n",
    },
    Row {
        field: Field::RadiusM,
        name: "link.radius_m",
        about: "R, how far a link reaches, m",
        get: |of| Some(of.link.radius_m),
        set: |of, to| of.link.radius_m = to,
        range: POSITIVE,
        limit: None,
        why: "",
    },
    Row {
        field: Field::PositionErrorM,
        name: "controller.position_error_m",
        about: "budget: bound of the error of every sensed position, own and others', m",
        get: |of| Some(of.errors.position_m),
        set: |of, to| of.errors.position_m = to,
        range: NOT_NEGATIVE,
        limit: None,
        why: "",
    },
    Row {
        field: Field::TrackingErrorM,
        name: "controller.tracking_error_m",
        about: "budget: bound of how far a robot is from where its velocities would have taken it, m",
        get: |of| Some(of.errors.tracking_m),
        set: |of, to| of.errors.tracking_m = to,
        range: NOT_NEGATIVE,
        limit: None,
        why: "",
    },
    Row {
        field: Field::DistanceMinM,
        name: "controller.distance_min_m",
        about: "Delta_d, how near two robots may come, m",
        get: |of| Some(*of.distance_min_m),
        set: |of, to| *of.distance_min_m = to,
        range: POSITIVE,
        limit: Some(|of| Allowed::Open(0.0, of.distance_limit_m)),
        why: "below link.radius_m",
    },
    Row {
        field: Field::ClearanceM,
        name: "obstacles.clearance_m",
        about: "how near a robot may come to an obstacle, m",
        get: |of| Some(*of.clearance_m),
        set: |of, to| *of.clearance_m = to,
        range: NOT_NEGATIVE,
        limit: None,
        why: "",
    },
    Row {
        field: Field::SpeedMaxMS,
        name: "controller.speed_max_m_s",
        about: "greatest speed, whatever its direction, m/s; by default only the box limits it",
        get: |of| (*of.speed_max_m_s != f64::INFINITY).then_some(*of.speed_max_m_s),
        set: |of, to| *of.speed_max_m_s = to,
        range: POSITIVE,
        limit: None,
        why: "",
    },
    Row {
        field: Field::Epsilon,
        name: "link.epsilon",
        about: "of q1 = 2 + epsilon; by default 1/(n-1) - 0.001",
        get: |of| Some(of.link.epsilon.unwrap_or(epsilon_of(of.team.robots))),
        set: |of, to| of.link.epsilon = Some(to),
        range: Allowed::Open(-1.0, 1.0),
        limit: Some(|of| Allowed::Open(0.0, 1.0 / (f64::from(of.team.robots) - 1.0))),
        why: "below 1/(n-1)",
    },
    Row {
        field: Field::Q2,
        name: "link.q2",
        about: "steepness of the weight, 1/m^4",
        get: |of| Some(of.link.q2),
        set: |of, to| of.link.q2 = to,
        range: STEEPNESS,
        limit: None,
        why: "",
    },
    Row {
        field: Field::WR,
        name: "controller.w_r",
        about: "composed: weight of degrees",
        get: |of| of.composed.as_ref().map(|composed| composed.w_r),
        set: |of, to| composed(of, |composed| composed.w_r = to),
        range: POSITIVE,
        limit: None,
        why: "",
    },
    Row {
        field: Field::WC,
        name: "controller.w_c",
        about: "composed: weight of collisions, 1/m^2",
        get: |of| of.composed.as_ref().map(|composed| composed.w_c),
        set: |of, to| composed(of, |composed| composed.w_c = to),
        range: POSITIVE,
        limit: None,
        why: "",
    },
    Row {
        field: Field::Alpha,
        name: "controller.alpha",
        about: "composed: alpha(s) = alpha s, 1/s",
        get: |of| of.composed.as_ref().map(|composed| composed.alpha),
        set: |of, to| composed(of, |composed| composed.alpha = to),
        range: POSITIVE,
        limit: None,
        why: "",
    },
    Row {
        field: Field::LevelPeriod,
        name: "clock.tau_1_s",
        about: "robots move, and tell what they tell of their motion, at this period, s",
        get: |of| Some(of.clock.level_period.as_secs_f64()),
        set: |of, to| of.clock.level_period = time(to),
        range: SECONDS,
        limit: None,
        why: "",
    },
    Row {
        field: Field::ValuePeriod,
        name: "clock.tau_2_s",
        about: "values are shared and updated at this period, s",
        get: |of| Some(of.clock.value_period.as_secs_f64()),
        set: |of, to| of.clock.value_period = time(to),
        range: SECONDS,
        limit: None,
        why: "",
    },
    Row {
        field: Field::OwnQ2,
        name: "controller.q2",
        about: "budget: steepness of its own weight, 1/m^4; by default chosen for the task",
        get: |of| Some(weight(of)?.q2),
        set: |of, to| budget(of, |budget| budget.q2 = Some(to)),
        range: Allowed::LeftOpen(0.0, Q2_MAX),
        limit: None,
        why: "",
    },
    Row {
        field: Field::OwnEpsilon,
        name: "controller.epsilon",
        about: "budget: of q1 = 2 + epsilon of its own weight; by default a hair below 2/(need - 1)",
        get: |of| Some(weight(of)?.epsilon),
        set: |of, to| budget(of, |budget| budget.epsilon = Some(to)),
        range: Allowed::Open(-3.0, 3.0),
        limit: Some(|of| Allowed::Open(0.0, conditions(of).map_or(2.0, |of| of.epsilon_limit()))),
        why: "below 2/(need - 1)",
    },
    Row {
        field: Field::Gamma,
        name: "controller.gamma",
        about: "budget: fraction of h that may be lost in a tick; by default chosen for the task",
        get: |of| Some(weight(of)?.gamma),
        set: |of, to| budget(of, |budget| budget.gamma = Some(to)),
        range: FRACTION,
        limit: None,
        why: "",
    },
    Row {
        field: Field::GammaC,
        name: "controller.gamma_c",
        about: "budget: fraction of distance^2 - distance_min^2 that may be lost in a tick; by default 1 - exp(-45 tau_1)",
        get: |of| Some(weight(of)?.gamma_c),
        set: |of, to| budget(of, |budget| budget.gamma_c = Some(to)),
        range: FRACTION,
        limit: None,
        why: "",
    },
    Row {
        field: Field::HeldGamma,
        name: "links.gamma",
        about: "links: fraction of R^2 - distance^2 that may be lost in a tick; by default 1 - exp(-8 tau_1)",
        get: |of| of.links.as_ref().map(|links| links.gamma(of.clock.level_period)),
        set: |of, to| links(of, |links| links.gamma = Some(to)),
        range: FRACTION,
        limit: None,
        why: "",
    },
    Row {
        field: Field::HeldGammaC,
        name: "links.gamma_c",
        about: "links: fraction of distance^2 - distance_min^2 that may be lost in a tick; by default 1 - exp(-45 tau_1)",
        get: |of| of.links.as_ref().map(|links| links.gamma_c(of.clock.level_period)),
        set: |of, to| links(of, |links| links.gamma_c = Some(to)),
        range: FRACTION,
        limit: None,
        why: "",
    },
    Row {
        field: Field::HorizonS,
        name: "links.horizon_s",
        about: "links: robots release each other by where they would be after so long, s",
        get: |of| of.links.as_ref().map(|links| links.horizon_s),
        set: |of, to| links(of, |links| links.horizon_s = to),
        range: SECONDS,
        limit: None,
        why: "",
    },
    Row {
        field: Field::HoldMax,
        name: "clock.hold_max_s",
        about: "budget: how long a velocity may be held, s; by default tau_1_s",
        get: |of| Some(of.clock.hold_max().as_secs_f64()),
        set: |of, to| of.clock.hold_max = Some(time(to)),
        range: SECONDS,
        limit: Some(|of| Allowed::Closed(of.clock.level_period.as_secs_f64(), 3_600.0)),
        why: "at least clock.tau_1_s",
    },
    Row {
        field: Field::ToldMax,
        name: "clock.told_max_s",
        about: "budget, links: for so long a robot promises nothing after it saw an assumption broken; links: what was told longer ago counts as not told, s",
        get: |of| Some(of.clock.told_max.as_secs_f64()),
        set: |of, to| of.clock.told_max = time(to),
        range: SECONDS,
        limit: None,
        why: "",
    },
    Row {
        field: Field::ClockError,
        name: "clock.error_s",
        about: "bound of the difference of any two clocks, by which values are counted in a round, s",
        get: |of| Some(of.clock.error.as_secs_f64()),
        set: |of, to| of.clock.error = time(to),
        range: Allowed::Closed(0.0, 3_600.0),
        limit: None,
        why: "",
    },
];

impl Row {
    /// What it may be among the others, or without them if it has no limit.
    #[must_use]
    pub fn allowed(&self, of: &Parts<'_>) -> Allowed {
        self.limit.map_or(self.range, |limit| limit(of))
    }

    /// The table that it stands in, and its key there.
    #[must_use]
    pub fn place(&self) -> (&'static str, &'static str) {
        self.name.split_once('.').unwrap_or(("", self.name))
    }
}

impl Field {
    /// Its row; `None` for the corners of the input box and for ranks, which are no numbers in files.
    #[must_use]
    pub fn row(self) -> Option<&'static Row> {
        TABLE.iter().find(|row| row.field == self)
    }

    /// Its name in files, with the table it stands in.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::InputMinMS => "controller.input_min_m_s",
            Self::InputMaxMS => "controller.input_max_m_s",
            Self::Core => "team.ranks",
            _ => self.row().map_or("", |row| row.name),
        }
    }

    /// Why it may be only what it may be, if the range depends on something else.
    #[must_use]
    pub fn why(self) -> &'static str {
        match self {
            Self::InputMinMS | Self::InputMaxMS => "the box must contain 0",
            Self::Core => "2F + 1 <= core <= n, and all are core under a controller without ranks",
            _ => self.row().map_or("", |row| row.why),
        }
    }
}
