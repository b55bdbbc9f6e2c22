//! Algebraic connectivity kept by a barrier (Saulnier, Saldaña, Prorok, Pappas, Kumar 2017; Capelli and Sabattini 2020; Cavorsi et al.
//! 2022).
//!
//! With the weights a_ij of eq:adjacency, L = D − A and its second least eigenvalue λ₂:
//!
//! ```text
//! h = λ₂ − 4F − MARGIN,      ∂λ₂/∂x_i = Σ_j ∂a_ij/∂x_i (v_i − v_j)²      v the eigenvector of λ₂
//! ```
//!
//! A graph is at least ⌈λ₂/2⌉-robust (as these works use it), so λ₂ > 4F makes it (2F + 1)-robust, which W-MSR needs at most. Where λ₂ is
//! repeated it has no gradient; the mean of the equal eigenvalues has one, the mean of the above over an orthonormal
//! basis of their eigenvectors, and does not depend on the basis. The row is shared out evenly among all robots. Needs:
//! the positions of all robots, in every tick. Built from the description in the paper and in the abstracts.

use closeranks_core::equations::link::Link;
use closeranks_core::num::{Vector, add_scaled, subtract};

use crate::controllers::shared::barrier::{Barrier, Shares, pairs_in_range};
use crate::controllers::shared::eigen::eigen;
use crate::controllers::{Answer, TeamView, Velocities};

/// Room for what is lost between two ticks, in which λ₂ bends.
const MARGIN: f64 = 0.1;
/// Eigenvalues count as equal up to this fraction of the greatest one.
const EQUAL: f64 = 1e-9;

/// The controller.
#[derive(Clone, Debug, Default)]
pub struct Lambda2 {
    shares: Shares,
}

impl Velocities for Lambda2 {
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]) {
        self.shares.begin(view);
        if let Some(barrier) = barrier(view) {
            self.shares.keep(&barrier);
        }
        self.shares.answer(view, answers);
    }
}

/// `λ₂ − 4F` with its gradient for all robots; nothing for a robot alone.
fn barrier<const D: usize>(view: &TeamView<'_, D>) -> Option<Barrier<D>> {
    let links = links(view);
    let spectrum = eigen(laplacian(view.positions_m.len(), &links));
    let (second, greatest) = (spectrum.get(1)?.0, spectrum.last()?.0);
    let equal: Vec<&[f64]> = spectrum[1..]
        .iter()
        .filter(|(value, _)| *value <= second + EQUAL * greatest)
        .map(|(_, vector)| &vector[..])
        .collect();
    let least = 4.0 * f64::from(view.params.settings().team.faults) + MARGIN;
    Some(Barrier { h: second - least, gradients: gradients(view.positions_m.len(), &links, &equal) })
}

/// Every link with its weight and its gradient for the first robot.
fn links<const D: usize>(view: &TeamView<'_, D>) -> Vec<([usize; 2], f64, Vector<D>)> {
    let pairs = pairs_in_range(view).into_iter();
    pairs
        .filter_map(|pair @ [one, other]| {
            let offset_m = subtract(&view.positions_m[one], &view.positions_m[other]);
            let link: Link<f64> = view.params.link().link(&offset_m)?;
            Some((pair, link.weight, link.gradient(&offset_m)))
        })
        .collect()
}

fn laplacian<const D: usize>(robots: usize, links: &[([usize; 2], f64, Vector<D>)]) -> Vec<Vec<f64>> {
    let mut laplacian = vec![vec![0.0; robots]; robots];
    for ([one, other], weight, _) in links {
        laplacian[*one][*one] += weight;
        laplacian[*other][*other] += weight;
        laplacian[*one][*other] -= weight;
        laplacian[*other][*one] -= weight;
    }
    laplacian
}

/// The gradient of the mean of equal eigenvalues with these eigenvectors.
fn gradients<const D: usize>(
    robots: usize,
    links: &[([usize; 2], f64, Vector<D>)],
    vectors: &[&[f64]],
) -> Vec<(usize, Vector<D>)> {
    let mut sums = vec![[0.0; D]; robots];
    for ([one, other], _, gradient) in links {
        let squares = vectors.iter().map(|v| (v[*one] - v[*other]) * (v[*one] - v[*other]));
        #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
        let mean = squares.sum::<f64>() / vectors.len() as f64;
        sums[*one] = add_scaled(&sums[*one], mean, gradient);
        sums[*other] = add_scaled(&sums[*other], -mean, gradient);
    }
    sums.into_iter().enumerate().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controllers::Controller;
    use crate::controllers::shared::testing::{check_gradients, outward, places, watch};
    use crate::scenario::Scenario;
    use closeranks_core::num::length;

    #[test]
    fn the_gradient_is_that_of_the_eigenvalue() {
        check_gradients(&places(), |view| barrier(view).unwrap());
    }

    /// A square of four robots has λ₂ = λ₃. The sum of the two falls as fast as the gradient of their mean says.
    #[test]
    fn a_repeated_eigenvalue_has_the_gradient_of_the_mean() {
        let square = [[0.0, 0.0], [2.5, 0.0], [2.5, 2.5], [0.0, 2.5]];
        let scenario = outward(Controller::Lambda2);
        let params = scenario.params::<2>().unwrap();
        let at = |places: &[Vector<2>]| {
            let view = crate::controllers::shared::testing::view(&params, places);
            let spectrum = eigen(laplacian(4, &links(&view)));
            (0.5 * (spectrum[1].0 + spectrum[2].0), spectrum[2].0 - spectrum[1].0, barrier(&view).unwrap())
        };
        let (mean, gap, here) = at(&square);
        assert!(gap < 1e-12);
        let mut moved = square;
        moved[0][0] -= 1e-5;
        let slope = (at(&moved).0 - mean) / 1e-5;
        assert!(
            (slope + here.gradients[0].1[0]).abs() < 1e-3 && slope < 0.0,
            "{slope} {:?}",
            here.gradients[0]
        );
        assert!(
            here.gradients
                .iter()
                .all(|(_, gradient)| (length(gradient) - length(&here.gradients[0].1)).abs() < 1e-9)
        );
    }

    /// At 5 1/s. At the rate that the benchmark chose, 1 1/s, eigenvalues that meet cost it more in ticks than its margin covers.
    #[test]
    fn algebraic_connectivity_stays_above_four_times_the_faults() {
        let mut least = f64::INFINITY;
        let scenario = Scenario { tuning: [Some(5.0), None], ..outward(Controller::Lambda2) };
        let grown = watch(&scenario, |view| least = least.min(barrier(view).unwrap().h));
        assert!(least > -MARGIN, "{least}");
        assert!(grown > 1.05, "{grown}");
    }
}
