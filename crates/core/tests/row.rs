//! The row of one robot: eq:split against the gradient of the global composition, and eq:phi_i against its print.
//!
//! Because ∂h_k/∂x_i = ∂a_ik/∂x_i, H_i is the gradient of φ (eq:composition) with respect to x_i whenever all levels are honest.
//! The row is that inequality divided by a power of two, which is read off `bound = −α φ_i · scale`.

use closeranks_core::equations::composition::{Composition, PhiSplit};
use closeranks_core::num::Vector;
use team::Team;

mod seeded;
mod team;

const STEP_M: f64 = 1e-4;
const CLUSTERS: u64 = 60;

//= paper eq:split type=test
//= paper eq:composition type=test
#[test]
fn with_honest_levels_the_row_is_the_gradient_of_the_global_composition() {
    for seed in 0..CLUSTERS {
        for share in [PhiSplit::Neighbors, PhiSplit::Own] {
            check_gradient(&Team::<2>::random(seed, share));
            check_gradient(&Team::<3>::random(seed, share));
        }
    }
}

//= paper eq:phi_i type=test
#[test]
fn phi_i_is_what_is_printed() {
    for seed in 0..CLUSTERS {
        for share in [PhiSplit::Neighbors, PhiSplit::Own] {
            check_phi(&mut Team::<2>::random(seed, share));
            check_phi(&mut Team::<3>::random(seed, share));
        }
    }
}

fn check_gradient<const D: usize>(team: &Team<D>) {
    for i in 0..team.count() {
        let row = unscaled(team, &team.composition(i));
        for (d, component) in row.into_iter().enumerate() {
            let slope = slope_of_phi(team, i, d);
            // fifth derivatives of the terms times STEP⁴, and the rounding of φ over STEP: both far below 1e-8 of the terms
            let terms = 2.0 - team.phi();
            assert!(
                (component - slope).abs() <= 1e-8 * terms,
                "robot {i}, axis {d}: {component} and {slope} in {:?}",
                team.positions
            );
        }
    }
}

/// H_i: the row times the power of two that its bound was divided by.
fn unscaled<const D: usize>(team: &Team<D>, composition: &Composition<D>) -> Vector<D> {
    let row = composition.row;
    let largest = row.normal.iter().fold(0.0, |most: f64, component| most.max(component.abs()));
    assert!((1.0..2.0).contains(&largest), "{row:?}");
    let scale = row.bound / (-team.composed.alpha * composition.phi);
    assert!(scale > 0.0 && scale.to_bits() << 12 == 0, "{scale} is no power of two");
    row.normal.map(|component| component / scale)
}

/// ∂φ/∂x_i along an axis, all levels following the positions: five points, error of order `STEP_M⁴`.
fn slope_of_phi<const D: usize>(team: &Team<D>, i: usize, axis: usize) -> f64 {
    let phi = |steps: f64| {
        let mut moved = team.clone();
        moved.positions[i][axis] += steps * STEP_M;
        moved.claims = moved.levels();
        moved.phi()
    };
    (8.0 * (phi(1.0) - phi(-1.0)) - (phi(2.0) - phi(-2.0))) / (12.0 * STEP_M)
}

/// With honest claims and with false ones.
fn check_phi<const D: usize>(team: &mut Team<D>) {
    for lie in [0.0, -2.5, 3.5, 20.0, -30.0] {
        team.claims[0] += lie;
        for i in 0..team.count() {
            let (phi, printed) = (team.composition(i).phi, printed(team, i));
            // φ_i is 1/n minus its terms; 14 additions, and exponentials of arguments below 100 known to 1e-16 each
            let terms = 1.0 - printed;
            assert!(
                (phi - printed).abs() <= 200.0 * f64::EPSILON * terms,
                "{phi} and {printed} of robot {i}"
            );
        }
    }
}

/// eq:phi_i, or the own share of docs/theory.
fn printed<const D: usize>(team: &Team<D>, i: usize) -> f64 {
    let own = team.told_term(i);
    let degrees = match team.composed.split {
        PhiSplit::Neighbors => {
            let others: f64 = team.neighbors(i).map(|k| team.told_term(k)).sum();
            (own + others) / (f64::from(team.composed.required) + 1.0)
        }
        PhiSplit::Own => own,
    };
    let collisions: f64 = team.neighbors(i).map(|j| team.collision_term(i, j)).sum();
    1.0 / f64::from(team.composed.robots) - degrees - collisions / 2.0
}
