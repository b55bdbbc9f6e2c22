//! The paper's constraint eq:cbf_constraint before it is split: one row for the velocities of all robots at once.
//!
//! ```text
//! φ = 1 − Σ_i exp(−w_r h_i) − Σ_{i<j} exp(−w_c h^col_ij)
//! Σ_i ∂φ/∂x_i · u_i ≥ −α φ,      u_i in the box,      Σ_i |u_i − u_{i,des}|² least
//! ```
//!
//! This is what the split of eq:split approximates: a robot that has nothing to give is helped by those that have. Needs: the
//! positions and the desired velocities of all robots, and that all do as they are told. One row and a box have their closest point
//! in closed form up to a search for one multiplier, which ends after as many steps as there are components.

use closeranks_core::equations::composition::{Composed, PhiSplit};
use closeranks_core::equations::link::Link;
use closeranks_core::num::{Vector, add_scaled, dot, subtract};
use closeranks_core::program::{InputBox, Outcome};
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::settings::ComposedSettings;

use crate::controllers::shared::barrier::{Barrier, pairs_in_range};
use crate::controllers::{Answer, TeamView, Velocities};

/// The controller with the weights of the composition.
#[derive(Clone, Copy, Debug)]
pub struct CentralComposed {
    weights: ComposedSettings,
}

impl CentralComposed {
    /// For these weights; how φ would be split does not matter.
    #[must_use]
    pub fn new(weights: ComposedSettings) -> Self {
        Self { weights }
    }

    fn composed<const D: usize>(&self, view: &TeamView<'_, D>) -> Composed {
        let ComposedSettings { w_r, w_c, alpha, .. } = self.weights;
        let settings = view.params.settings();
        Composed {
            split: PhiSplit::Own,
            w_r,
            w_c,
            alpha,
            robots: settings.team.robots,
            required: view.params.need().need(RobotId(1)),
            distance_min_m: settings.limits.distance_min_m,
        }
    }
}

impl Velocities for CentralComposed {
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]) {
        let composed = self.composed(view);
        let phi = phi(&composed, view);
        let input = &view.params.settings().limits.input;
        closest(&phi, -composed.alpha * phi.h, view.desired_m_s, input, answers);
    }
}

/// φ with its gradient.
//= paper eq:composition
fn phi<const D: usize>(composed: &Composed, view: &TeamView<'_, D>) -> Barrier<D> {
    let robots = view.positions_m.len();
    let (mut links, mut levels) = (Vec::new(), vec![0.0; robots]);
    for [one, other] in pairs_in_range(view) {
        let offset_m = subtract(&view.positions_m[one], &view.positions_m[other]);
        let Some(link): Option<Link<f64>> = view.params.link().link(&offset_m) else { continue };
        levels[one] += link.weight;
        levels[other] += link.weight;
        links.push(([one, other], offset_m, link.slope));
    }
    let degrees: Vec<f64> = levels.iter().map(|level| composed.degree_term(*level)).collect();
    let mut phi = Barrier { h: 1.0, gradients: (0..robots).map(|robot| (robot, [0.0; D])).collect() };
    for ([one, other], offset_m, slope) in links {
        let collision: f64 = composed.collision_term(dot(&offset_m, &offset_m));
        let pull = composed.coefficient(degrees[one], degrees[other], slope, collision);
        phi.h -= collision;
        for (robot, sign) in [(one, pull), (other, -pull)] {
            phi.gradients[robot].1 = add_scaled(&phi.gradients[robot].1, sign, &offset_m);
        }
    }
    phi.h -= degrees.iter().sum::<f64>();
    phi
}

/// The velocities closest to `desired` in the box with `Σ gradient·u ≥ bound`. If none are, those with the largest sum.
fn closest<const D: usize>(
    barrier: &Barrier<D>,
    bound: f64,
    desired: &[Vector<D>],
    input: &InputBox<D>,
    answers: &mut [Answer<D>],
) {
    let at = |answers: &mut [Answer<D>], multiplier: f64| {
        let (mut sum, mut slope) = (0.0, 0.0);
        for ((robot, gradient), answer) in barrier.gradients.iter().zip(answers) {
            let wanted = add_scaled(&desired[*robot], multiplier, gradient);
            answer.velocity_m_s = input.clip(&wanted);
            sum += dot(gradient, &answer.velocity_m_s);
            let rises = |d: usize| {
                if gradient[d] > 0.0 { wanted[d] < input.max_m_s[d] } else { wanted[d] > input.min_m_s[d] }
            };
            slope += (0..D).filter(|d| rises(*d)).map(|d| gradient[d] * gradient[d]).sum::<f64>();
        }
        (sum, slope)
    };
    // The sum is concave in the multiplier and made of straight pieces, so that no step goes too far.
    let (mut multiplier, mut outcome) = (0.0, Outcome::Free);
    for _ in 0..=2 * D * desired.len() {
        let (sum, slope) = at(answers, multiplier);
        let missing = bound - sum;
        if missing <= f64::EPSILON * (bound.abs() + sum.abs()) {
            break;
        }
        outcome = if slope > 0.0 { Outcome::Active } else { Outcome::Infeasible };
        if outcome == Outcome::Infeasible {
            break;
        }
        multiplier += missing / slope;
    }
    for answer in answers {
        answer.outcome = outcome;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controllers::Controller;
    use crate::controllers::shared::testing::{check_gradients, outward, places, watch};

    fn composed(view: &TeamView<'_, 2>) -> Composed {
        CentralComposed::new(outward(Controller::CentralComposed).composed).composed(view)
    }

    #[test]
    fn the_gradient_is_that_of_phi() {
        let places: Vec<Vector<2>> = places().iter().map(|x| x.map(|x| 0.7 * x)).collect();
        check_gradients(&places, |view| {
            phi(&Composed { w_r: 0.3, w_c: 0.5, required: 2, ..composed(view) }, view)
        });
    }

    #[test]
    fn the_closest_point_of_one_row_and_a_box() {
        let input = InputBox::of([-1.0; 2], [1.0; 2]);
        let barrier = Barrier { h: 0.0, gradients: vec![(0, [1.0, 0.0]), (1, [2.0, 0.0])] };
        let mut answers = [Answer { velocity_m_s: [0.0; 2], outcome: Outcome::Free }; 2];
        let mut solve = |bound: f64| {
            closest(&barrier, bound, &[[0.0, 0.5], [0.0, -3.0]], &input, &mut answers);
            (answers.map(|answer| answer.velocity_m_s), answers[0].outcome)
        };
        assert_eq!(solve(-1.0), ([[0.0, 0.5], [0.0, -1.0]], Outcome::Free));
        assert_eq!(solve(1.25), ([[0.25, 0.5], [0.5, -1.0]], Outcome::Active));
        let ([[x, y], other], outcome) = solve(2.75);
        assert!((x - 0.75).abs() < 1e-15 && y == 0.5, "{x} {y}");
        assert_eq!((other, outcome), ([1.0, -1.0], Outcome::Active));
        assert_eq!(solve(4.0), ([[1.0, 0.5], [1.0, -1.0]], Outcome::Infeasible));
    }

    #[test]
    fn phi_does_not_become_negative_once_it_is_not() {
        let mut began = false;
        let grown = watch(&outward(Controller::CentralComposed), |view| {
            let phi = phi(&composed(view), view).h;
            assert!(!began || phi > -1e-3, "{phi}");
            began |= phi >= 0.0;
        });
        assert!(began && grown > 1.05, "{grown}");
    }
}
