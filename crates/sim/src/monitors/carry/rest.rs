//! How far robots move, against how far they wish to: nobody is towed.

use std::sync::Arc;

use closeranks_core::controller::Kept;
use closeranks_core::controller::errors::ErrorBounds;
use closeranks_core::equations::link::Link;
use closeranks_core::num::{Vector, add_scaled, length, sqrt, subtract};
use closeranks_core::settings::params::Params;

use crate::frame::Frame;
use crate::law::{Law, Verdicts, Violation};
use crate::monitors::carry::clear::Clear;
use crate::monitors::rounding::level_rounding;
use crate::monitors::rule::Rule;
use crate::monitors::truth::{ROUNDING, Truth};
use crate::scenario::Scenario;

/// A program finds its closest point up to this fraction of a move.
const MOVE_ROUNDING: f64 = 1e-6;

/// Watches the moves of normal robots under `budget`.
///
/// What a robot is allowed to do contains standing still and is convex. So the closest point to a desired move is never longer
/// than that move. A robot lengthens its desired move only to mend its own h_i and its own distances, each by a length that
/// follows from the true positions:
///
/// ```text
/// |v_i| ≤ |w_i| + min(h_i⁻/|∂h_i/∂x_i|, ρ) + Σ_j min((Δ_d − Δ_ij)⁺/2, ρ) + Σ_K min((m − d_iK)⁺, ρ)
/// ```
///
/// For a robot that wishes to rest and lacks nothing this says that it does not move at all, whatever others do or tell. With
/// stated errors a robot may believe that it lacks something where little is left: then each term that may be there counts ρ.
#[derive(Clone, Debug)]
pub(crate) struct RestWatch<const D: usize> {
    params: Params<D>,
    malicious: Vec<bool>,
    rule: Arc<Rule>,
    /// How much less than it is h may seem to be, and how much smaller a distance, m; 0 where robots sense exactly.
    blur: f64,
    blur_m: f64,
}

impl<const D: usize> RestWatch<D> {
    /// For the robots of `scenario`, who count for each other by `rule`.
    pub(crate) fn new(scenario: &Scenario, params: Params<D>, rule: &Arc<Rule>) -> Self {
        let Kept { errors: ErrorBounds { offset_m, .. }, fall_max, .. } = *params.kept();
        Self {
            malicious: scenario.malicious_mask(),
            blur: 4.0 * offset_m * fall_max * f64::from(scenario.team.robots),
            blur_m: 2.0 * offset_m,
            rule: Arc::clone(rule),
            params,
        }
    }

    /// Looks at one tick.
    //= theory sec:recovery
    //= theory sec:clear-recovery
    pub(crate) fn watch(
        &self,
        tick: u32,
        frame: &Frame<D>,
        truth: &Truth,
        clear: &Clear<D>,
        verdicts: &mut Verdicts,
    ) {
        let hold_s = self.params.hold_s();
        for (robot, index) in (1_u16..).zip(0..frame.velocities_m_s.len()) {
            if self.malicious[index] || frame.down[index] {
                continue;
            }
            let moved_m = hold_s * length(&frame.velocities_m_s[index]);
            let wished_m = hold_s * length(&frame.asked_m_s[index]);
            if moved_m <= wished_m * (1.0 + MOVE_ROUNDING) {
                continue;
            }
            let clear_m = clear.demand_m(index, frame, self.params.reach().longest_m());
            let demand_m = self.demand_m(index, frame, truth) + clear_m;
            let most_m = (wished_m + demand_m) * (1.0 + MOVE_ROUNDING);
            if moved_m > most_m {
                let at =
                    Violation { tick, robots: [robot, 0], seen: moved_m / hold_s, demanded: most_m / hold_s };
                verdicts.broke(Law::Untowed, at, self.covers(index, frame));
            }
        }
    }

    /// True if the robot knows its own state as well as is stated. Whatever others do or tell makes no difference.
    fn covers(&self, robot: usize, frame: &Frame<D>) -> bool {
        let assumptions = &frame.assumptions;
        !assumptions.sensed_wrong[robot] && (self.blur_m == 0.0 || !assumptions.broken)
    }

    /// What mending its own h and its own distances takes at most, m.
    fn demand_m(&self, robot: usize, frame: &Frame<D>, truth: &Truth) -> f64 {
        let most_m = self.params.reach().longest_m();
        let missing = level_rounding(truth.neighbors[robot]) + self.blur - truth.h_own[robot];
        let mut demand_m = match self.gradient(robot, frame) {
            _ if missing <= 0.0 => 0.0,
            _ if self.blur > 0.0 => most_m,
            gradient => (missing / length(&gradient)).min(most_m),
        };
        let least_m = self.params.kept().distance_min_m * (1.0 + ROUNDING) + self.blur_m;
        let places_m2 = truth.pairs.references_m2();
        let short_m = |pair_m2: f64| {
            let near = pair_m2 < least_m * least_m;
            if near { (0.5 * (least_m - sqrt(pair_m2)) + self.blur_m).min(most_m) } else { 0.0 }
        };
        truth.pairs.each(|place, ends| {
            if ends.contains(&robot) {
                demand_m += short_m(places_m2[place]);
            }
        });
        let strangers = truth.strangers.iter().filter(|stranger| stranger.robot == robot);
        strangers.fold(demand_m, |demand_m, stranger| demand_m + short_m(stranger.distance_m2))
    }

    /// ∂h_i/∂x_i of the sum of all weights, 1/m, as robots have it.
    fn gradient(&self, robot: usize, frame: &Frame<D>) -> Vector<D> {
        let own = &frame.positions_m[robot];
        let offsets = frame.positions_m.iter().enumerate().filter(|(other, _)| {
            *other != robot && self.rule.counts(robot, *other) && !frame.presence.absent[*other]
        });
        offsets.fold([0.0; D], |sum, (_, other)| {
            let offset_m = subtract(own, other);
            let link: Option<Link<f64>> = self.params.link().link(&offset_m);
            link.map_or(sum, |link| add_scaled(&sum, 1.0, &link.gradient(&offset_m)))
        })
    }
}

#[cfg(test)]
mod tests {
    use closeranks_core::settings::Team;

    use super::*;
    use crate::scenario::Controller;

    /// Robots in a row, 0.5 m apart, of which the first moves with this speed although all wish to rest.
    fn broken(team: Team, speed_m_s: f64) -> u64 {
        let scenario =
            Scenario { controller: Controller::Budget, team, malicious: vec![], ..Scenario::default() };
        let params = scenario.params::<2>().unwrap();
        let places = (0..team.robots).map(|k| [0.5 * f64::from(k), 0.0]).collect();
        let mut frame = Frame::new(places, vec![0.0; usize::from(team.robots)]);
        frame.velocities_m_s[0] = [speed_m_s, 0.0];
        let (mut truth, mut verdicts) = (Truth::default(), Verdicts::default());
        let rule = Arc::new(Rule::new(&scenario, &params));
        truth.look(&params, &rule, &scenario.malicious_mask(), &frame, false);
        let clear = Clear::new(&scenario, params);
        RestWatch::new(&scenario, params, &rule).watch(7, &frame, &truth, &clear, &mut verdicts);
        assert_eq!(verdicts.of(Law::Untowed).count, verdicts.of(Law::Untowed).covered);
        verdicts.of(Law::Untowed).count
    }

    //= theory sec:recovery type=test
    #[test]
    fn who_lacks_nothing_and_wishes_to_rest_does_not_move_at_all() {
        let (safe, wide) = (Team { robots: 4, faults: 0 }, Team { robots: 9, faults: 4 });
        assert_eq!([0.0, 1e-9, 0.1].map(|speed| broken(safe, speed)), [0, 1, 1]);
        assert_eq!(
            [0.1, 1.0, 2.2].map(|speed| broken(wide, speed)),
            [0, 0, 1],
            "who lacks neighbours may come"
        );
    }
}
