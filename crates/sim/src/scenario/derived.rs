//! What follows from a scenario for robots and engines: ranks, the settings of a robot, and all their numbers.

use closeranks_core::equations::composition::Composed;
use closeranks_core::equations::link::{Link, LinkShape};
use closeranks_core::need::{Keep, Need, Ranks};
use closeranks_core::num::sqrt;
use closeranks_core::program::InputBox;
use closeranks_core::robot::neighbor::{Member, RobotId};
use closeranks_core::settings::field::Parts;
use closeranks_core::settings::params::{Params, ParamsError, Settings};
use closeranks_core::settings::{self, ComposedSettings};

use crate::controllers::{Parameters, Tuning};
use crate::scenario::ranks::{Keeps, Ranking, RanksError};
use crate::scenario::{Limits, Scenario};

impl Scenario {
    /// The ranks, if the controller has any use for them: others count everybody.
    #[must_use]
    pub fn ranking(&self) -> Option<&Ranking> {
        self.ranks.as_ref().filter(|_| self.controller.row().ranks)
    }

    /// The rank of each robot, listed or chosen from the start; `None` without ranks.
    pub fn ranks<const D: usize>(&self) -> Result<Option<Vec<u16>>, RanksError> {
        let Some(ranking) = self.ranking() else { return Ok(None) };
        let Ok(params) = self.params::<D>() else { return Ok(None) };
        let keep = |rank| usize::from(params.controller().keep(Member { id: RobotId(0), rank }));
        let (core, above) = (keep(0), keep(1));
        let Ok(positions_m) = self.positions::<D>() else { return Ok(None) };
        ranking.choose(&positions_m, counted_within_m(&params), Keeps { core, above }).map(Some)
    }

    /// What each robot is told of ranks.
    fn core_of_ranks(&self) -> Option<Ranks> {
        self.ranking().map(|ranks| Ranks { core: ranks.core(), listen: ranks.listen })
    }

    /// The robot's own parameters; an error names the field.
    pub fn params<const D: usize>(&self) -> Result<Params<D>, ParamsError> {
        let corner = |numbers: &[f64]| core::array::from_fn(|d| numbers.get(d).copied().unwrap_or(f64::NAN));
        let Limits { distance_min_m, input_min_m_s, input_max_m_s, speed_max_m_s, clearance_m } =
            &self.limits;
        let input = InputBox::of(corner(input_min_m_s), corner(input_max_m_s)).within(*speed_max_m_s);
        Params::new(Settings {
            team: self.team,
            link: self.link,
            limits: settings::Limits { distance_min_m: *distance_min_m, input, clearance_m: *clearance_m },
            controller: self.controller.settings(&self.parameters()),
            clock: self.clock,
            errors: self.errors,
            ranks: self.core_of_ranks(),
            consensus: self.consensus.rule.of_robots().unwrap_or_default(),
        })
    }

    /// The shape that the controller gives to links. Levels and h of a run are about it; φ is about that of `link`.
    pub fn link_shape(&self) -> Result<LinkShape, ParamsError> {
        match self.dimension {
            3 => self.params::<3>().map(|params| *params.link()),
            _ => self.params::<2>().map(|params| *params.link()),
        }
    }

    /// Parameters of all controllers.
    pub(crate) fn parameters(&self) -> Parameters {
        Parameters { composed: self.composed, budget: self.budget, links: self.links }
    }

    /// The numbers that controllers of others use: what the scenario says, or else what the table does.
    pub(crate) fn tuning(&self) -> Tuning {
        let Tuning { rate_1_s, horizon_s } = self.controller.row().tuning;
        let [rate, horizon] = self.tuning;
        Tuning { rate_1_s: rate.unwrap_or(rate_1_s), horizon_s: horizon.unwrap_or(horizon_s) }
    }

    /// Every number of the settings, for the table of [`settings::field`], whatever the controller.
    pub(crate) fn parts(&mut self) -> Parts<'_> {
        let (move_max_m, ranks) = (self.move_max_m(), self.core_of_ranks());
        Parts {
            team: &mut self.team,
            ranks,
            link: &mut self.link,
            distance_min_m: &mut self.limits.distance_min_m,
            clearance_m: &mut self.limits.clearance_m,
            speed_max_m_s: &mut self.limits.speed_max_m_s,
            composed: Some(&mut self.composed),
            budget: Some(&mut self.budget),
            links: Some(&mut self.links),
            clock: &mut self.clock,
            errors: &mut self.errors,
            distance_limit_m: f64::INFINITY,
            move_max_m,
        }
    }

    /// ρ, the longest move of a robot in a tick, m.
    fn move_max_m(&self) -> f64 {
        self.clock.hold_max().as_secs_f64() * self.speed_max_m_s()
    }

    /// The greatest speed that a robot can be asked for, m/s.
    pub(crate) fn speed_max_m_s(&self) -> f64 {
        let Limits { input_min_m_s, input_max_m_s, .. } = &self.limits;
        let corner = input_min_m_s.iter().zip(input_max_m_s).map(|(low, high)| low.abs().max(high.abs()));
        sqrt(corner.fold(0.0, |sum, speed| sum + speed * speed)).min(self.limits.speed_max_m_s)
    }

    /// How far from obstacles robots must start, m: so far as they are kept, and what stated errors cost.
    #[must_use]
    pub(crate) fn start_clearance_m<const D: usize>(&self) -> f64 {
        let away_m = self.params::<D>().map_or(0.0, |params| params.kept().errors.away_m);
        let unknown_m = if away_m > 0.0 { self.errors.position_m } else { 0.0 };
        self.limits.clearance_m + away_m + unknown_m
    }

    /// The paper's composition, for whoever wants to know φ and φ_i, whatever the controller.
    #[must_use]
    pub fn composition(&self) -> Composed {
        let ComposedSettings { phi_split, w_r, w_c, alpha } = self.composed;
        let (robots, distance_min_m) = (self.team.robots, self.limits.distance_min_m);
        let required = Need::new(robots, self.team.faults, Keep::Neighbors).need(RobotId(1));
        Composed { split: phi_split, w_r, w_c, alpha, robots, required, distance_min_m }
    }
}

/// Up to this distance, m, a neighbour counts in full: R, or where weights are added up, as far as they are at least 1.
fn counted_within_m<const D: usize>(params: &Params<D>) -> f64 {
    let shape = params.link();
    if params.controller().tells_lists() {
        return shape.radius_m;
    }
    let (mut within_m, mut beyond_m) = (0.0, shape.radius_m);
    for _ in 0..HALVINGS {
        let middle_m = 0.5 * (within_m + beyond_m);
        let link: Option<Link<f64>> = shape.link_at(middle_m * middle_m);
        if link.is_some_and(|link| link.weight >= 1.0) {
            within_m = middle_m;
        } else {
            beyond_m = middle_m;
        }
    }
    within_m
}

/// So often an interval of lengths is halved: after that it is as short as rounding.
const HALVINGS: u32 = 50;
