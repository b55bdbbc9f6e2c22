//! What each stated error costs: reach of links, room between robots, and h.

use closeranks_core::settings::params::{Params, ParamsError};

use super::level::Levels;
use super::patch::{Spacings, start};
use super::question::Question;
use crate::scenario::Scenario;

/// What is left where some errors are stated.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// Which error is stated.
    pub error: Stated,
    /// The number that is stated, m or s; 0 where it is none or all of them.
    pub stated: f64,
    /// How far links of references reach, m.
    pub link_m: f64,
    /// How far apart references are kept, m.
    pub apart_m: f64,
    /// ρ, the longest move for which rows are made, m.
    pub move_max_m: f64,
    /// The least h of a robot at the spacing that was asked about.
    pub h: f64,
    /// By how much that is less than with nothing stated.
    pub h_lost: f64,
    /// The spacings of a patch.
    pub spacings: Spacings,
}

/// An error that is stated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stated {
    /// None.
    Nothing,
    /// `position_error_m`.
    Position,
    /// `tracking_error_m`, which may follow from a lag.
    Tracking,
    /// `hold_max_s` beyond the tick.
    Hold,
    /// All of them together.
    All,
}

/// Stated errors: none, each that is stated by itself, all; at this spacing, m.
pub(super) fn costs<const D: usize>(question: &Question, spacing_m: f64) -> Result<Vec<Cost>, ParamsError> {
    let all = question.settled();
    let mut exact = all.clone();
    (exact.errors, exact.clock.hold_max) = Default::default();
    let none = Cost::new::<D>(Stated::Nothing, 0.0, &exact, spacing_m)?;
    let h = none.h;
    let mut costs = vec![none];
    for (error, stated, scenario) in alone(&all, &exact).into_iter().filter(|(_, stated, _)| *stated > 0.0) {
        costs.push(Cost::new::<D>(error, stated, &scenario, spacing_m)?);
    }
    if costs.len() > 2 {
        costs.push(Cost::new::<D>(Stated::All, 0.0, &all, spacing_m)?);
    }
    for cost in &mut costs {
        cost.h_lost = h - cost.h;
    }
    Ok(costs)
}

/// Each error with how much of it is stated, and the scenario in which it alone is.
fn alone(all: &Scenario, exact: &Scenario) -> [(Stated, f64, Scenario); 3] {
    let with = |change: fn(&mut Scenario, &Scenario)| {
        let mut scenario = exact.clone();
        change(&mut scenario, all);
        scenario
    };
    let jitter = all.clock.hold_max().saturating_sub(all.clock.level_period);
    [
        (
            Stated::Position,
            all.errors.position_m,
            with(|one, all| one.errors.position_m = all.errors.position_m),
        ),
        (
            Stated::Tracking,
            all.errors.tracking_m,
            with(|one, all| one.errors.tracking_m = all.errors.tracking_m),
        ),
        (Stated::Hold, jitter.as_secs_f64(), with(|one, all| one.clock.hold_max = all.clock.hold_max)),
    ]
}

impl Cost {
    fn new<const D: usize>(
        error: Stated,
        stated: f64,
        scenario: &Scenario,
        spacing_m: f64,
    ) -> Result<Self, ParamsError> {
        let params = scenario.params::<D>()?;
        let kept = params.kept();
        Ok(Self {
            error,
            stated,
            link_m: kept.link.radius_m,
            apart_m: kept.distance_min_m,
            move_max_m: params.reach().longest_m(),
            h: h_at(&params, spacing_m),
            h_lost: 0.0,
            spacings: Spacings::new(&params),
        })
    }
}

/// The least h of a patch of this spacing.
fn h_at<const D: usize>(params: &Params<D>, spacing_m: f64) -> f64 {
    let robots = params.settings().team.robots;
    let positions_m = start(robots, spacing_m, D).positions::<D>(robots, 0).unwrap_or_default();
    Levels::new(params).map_or(f64::NEG_INFINITY, |mut levels| levels.least(&positions_m).1)
}
