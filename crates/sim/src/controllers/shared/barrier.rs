//! Barriers of others as functions of all positions, and how a team shares them out.
//!
//! A barrier is a function h of positions that must not become negative. In continuous time it does not if
//!
//! ```text
//! Σ_i ∂h/∂x_i · u_i ≥ −α h
//! ```
//!
//! A barrier of m robots is shared out evenly: each of them takes `∂h/∂x_i · u_i ≥ −α h/m`, and the sum is the line above. Where h
//! is negative each robot has to raise it, as far as the input box lets it.

use closeranks_core::equations::link::Link;
use closeranks_core::num::{Vector, add_scaled, dot, subtract};

use crate::controllers::shared::half_spaces::HalfSpaces;
use crate::controllers::{Answer, TeamView};

/// A function h of positions, with its gradient for each robot that it is about.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::controllers) struct Barrier<const D: usize> {
    pub(in crate::controllers) h: f64,
    pub(in crate::controllers) gradients: Vec<(usize, Vector<D>)>,
}

impl<const D: usize> Barrier<D> {
    /// Two robots are not too close: `h = Δ² − Δ_d²`, m².
    pub(in crate::controllers) fn apart(view: &TeamView<'_, D>, [one, other]: [usize; 2]) -> Self {
        let least_m = view.params.settings().limits.distance_min_m;
        let offset_m = subtract(&view.positions_m[one], &view.positions_m[other]);
        let gradients = vec![(one, offset_m.map(|x| 2.0 * x)), (other, offset_m.map(|x| -2.0 * x))];
        Self { h: dot(&offset_m, &offset_m) - least_m * least_m, gradients }
    }

    /// Two robots are neighbours: `h = R² − Δ² − 4ρ²/(αT)`, m².
    ///
    /// A tick of T in which both go their longest way ρ takes up to 4ρ² more from R² − Δ² than the row says, and the row
    /// gives αT h back, so that the last term is all that can be lost: R² − Δ² itself stays positive in sampled time.
    pub(in crate::controllers) fn linked(view: &TeamView<'_, D>, [one, other]: [usize; 2]) -> Self {
        let radius_m = view.params.link().radius_m;
        let offset_m = subtract(&view.positions_m[one], &view.positions_m[other]);
        let gradients = vec![(one, offset_m.map(|x| -2.0 * x)), (other, offset_m.map(|x| 2.0 * x))];
        Self { h: radius_m * radius_m - dot(&offset_m, &offset_m) - sampling_m2(view), gradients }
    }

    /// `robot` has enough neighbours among `others`: `h = Σ_j a_ij − need` with the paper's weights.
    pub(in crate::controllers) fn degree(
        view: &TeamView<'_, D>,
        robot: usize,
        others: impl Iterator<Item = usize>,
        need: f64,
    ) -> Self {
        let mut barrier = Self { h: -need, gradients: vec![(robot, [0.0; D])] };
        for other in others.filter(|other| *other != robot) {
            let offset_m = subtract(&view.positions_m[robot], &view.positions_m[other]);
            let link: Option<Link<f64>> = view.params.link().link(&offset_m);
            if let Some(link) = link {
                let gradient = link.gradient(&offset_m);
                barrier.h += link.weight;
                barrier.gradients[0].1 = add_scaled(&barrier.gradients[0].1, 1.0, &gradient);
                barrier.gradients.push((other, gradient.map(|x| -x)));
            }
        }
        barrier
    }
}

/// What bounds the velocities of a whole team, a set of half-spaces for each robot.
#[derive(Clone, Debug, Default)]
pub(in crate::controllers) struct Shares {
    robots: Vec<HalfSpaces>,
    /// α, 1/s.
    rate_1_s: f64,
}

impl Shares {
    /// Begins a tick: nothing is bounded but that all pairs in range stay apart.
    pub(in crate::controllers) fn begin<const D: usize>(&mut self, view: &TeamView<'_, D>) {
        self.rate_1_s = view.tuning.rate_1_s;
        self.robots.resize_with(view.positions_m.len(), HalfSpaces::default);
        self.robots.iter_mut().for_each(HalfSpaces::clear);
        for pair in pairs_in_range(view) {
            let apart = Barrier::apart(view, pair);
            for (robot, gradient) in &apart.gradients {
                self.robots[*robot].push_first(gradient, -0.5 * self.rate_1_s * apart.h);
            }
        }
    }

    /// Shares a barrier out evenly.
    pub(in crate::controllers) fn keep<const D: usize>(&mut self, barrier: &Barrier<D>) {
        self.keep_at(barrier, barrier.h);
    }

    /// The same with another value than h in the bound.
    pub(in crate::controllers) fn keep_at<const D: usize>(&mut self, barrier: &Barrier<D>, value: f64) {
        #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
        let robots = barrier.gradients.len() as f64;
        for (robot, gradient) in &barrier.gradients {
            self.robots[*robot].push(gradient, -self.rate_1_s * value / robots);
        }
    }

    /// The velocities closest to the desired ones.
    pub(in crate::controllers) fn answer<const D: usize>(
        &self,
        view: &TeamView<'_, D>,
        answers: &mut [Answer<D>],
    ) {
        let input = &view.params.settings().limits.input;
        for (robot, answer) in answers.iter_mut().enumerate() {
            *answer = self.robots[robot].closest(&view.desired_m_s[robot], &[0.0; D], input);
        }
    }
}

/// What a pair may lose of R² − Δ² because velocities are held for a tick, m².
fn sampling_m2<const D: usize>(view: &TeamView<'_, D>) -> f64 {
    let (move_m, hold_s) = (view.params.reach().longest_m(), view.params.hold_s());
    4.0 * move_m * move_m / (view.tuning.rate_1_s * hold_s).min(1.0)
}

/// All pairs of different robots in range of each other, the lower number first.
pub(in crate::controllers) fn pairs_in_range<const D: usize>(view: &TeamView<'_, D>) -> Vec<[usize; 2]> {
    let (robots, radius_m) = (view.positions_m.len(), view.params.link().radius_m);
    let pairs = (0..robots).flat_map(|one| (one + 1..robots).map(move |other| [one, other]));
    pairs
        .filter(|[one, other]| {
            let offset_m = subtract(&view.positions_m[*one], &view.positions_m[*other]);
            dot(&offset_m, &offset_m) <= radius_m * radius_m
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controllers::shared::testing::{check_gradients, places};

    #[test]
    fn gradients_are_those_of_the_values() {
        let places = places();
        check_gradients(&places, |view| Barrier::apart(view, [2, 7]));
        check_gradients(&places, |view| Barrier::linked(view, [4, 1]));
        check_gradients(&places, |view| Barrier::degree(view, 3, 0..11, 7.0));
    }
}
