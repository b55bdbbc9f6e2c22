//! Rows whose terms `f64` cannot hold (eq:split): levels of any size, and clusters so far inside the radius that slopes vanish.
//!
//! The paper's H_i is then a sum of numbers like e^(10⁷) and e^(−10⁵). The crate carries their exponents along; here the same
//! sum is formed from logarithms, relative to its largest term. Either way the direction must come out, and a finite row.

use closeranks_core::equations::composition::{Composition, PhiSplit};
use closeranks_core::equations::link::LinkShape;
use closeranks_core::num::number::Number;
use closeranks_core::num::{Vector, dot, subtract};
use seeded::Seeded;
use team::Team;

mod seeded;
mod team;

/// Exponents saturate at this (`num::exponential::exp_scaled`).
const EXPONENT_LIMIT: f64 = 1e8;
/// Logarithms up to 10⁸ are known to 2⁻²⁷ each; a term multiplies four of them.
const ROUNDING: f64 = 4.0 / 134_217_728.0;

//= paper eq:split type=test
#[test]
fn the_direction_survives_any_level_and_any_cluster() {
    let (mut checked, mut rows) = (0, 0);
    for seed in 0..1_500 {
        let (plane, space) = (extreme::<2>(seed), extreme::<3>(seed));
        checked += (0..plane.count()).filter(|&i| check_row(&plane, i)).count();
        checked += (0..space.count()).filter(|&i| check_row(&space, i)).count();
        rows += plane.count() + space.count();
    }
    assert!(10 * checked > 9 * rows, "{checked} of {rows} rows have a direction");
}

/// R = 30 m and all robots within 0.5 m: e^(−q₂ s²) is about e^(−240 000), and E^c is made to vanish as well.
#[test]
fn a_cluster_far_inside_the_radius_has_a_row() {
    for seed in 0..100 {
        let mut team = Team::<3>::random(seed, PhiSplit::Own);
        team.shape = LinkShape { radius_m: 30.0, q1: 2.099, q2: 0.3 };
        team.composed.w_c = 1e8;
        for position in &mut team.positions {
            *position = position.map(|component| 0.32 + 0.02 * component);
        }
        team.positions[0] = [0.0; 3];
        team.claims = team.levels();
        let term = team.term(0, 1);
        assert!(term.link.slope.exponent < -340_000 && term.link.slope.value() == 0.0);
        assert!(f64::from_scaled(term.collision) == 0.0);
        assert!(check_row(&team, 0));
    }
}

/// A slope of e^(−720), 0 in `f64`, beside an Ê of e^(705): their product is the largest part of the row by far.
///
/// Found by the random test above: the plain sum took the slope for 0, found nothing amiss with what was left and gave
/// the direction of a neighbour that hardly matters. One liar and R = 10 m are enough.
#[test]
fn a_slope_that_vanishes_is_not_lost_beside_a_huge_term() {
    let mut team = Team::<2>::random(0, PhiSplit::Neighbors);
    team.shape = LinkShape { radius_m: 10.0, q1: 2.099, q2: 0.3 };
    (team.composed.w_r, team.composed.w_c, team.composed.required) = (15.0, 25.0, 7);
    team.positions = vec![[0.0, 0.0], [7.142, 0.0], [0.0, 9.9]];
    team.claims = vec![10.0, -40.0, 10.0];
    let normal = team.composition(0).row.normal;
    assert!(normal[0] >= 1.0 && normal[1].abs() < 1e-6, "towards the robot that claims −40, not {normal:?}");
    assert!(check_row(&team, 0));
}

/// True if the row had a direction to compare, false if there was none or the terms cancel.
fn check_row<const D: usize>(team: &Team<D>, i: usize) -> bool {
    let Composition { row, phi } = team.composition(i);
    assert!(phi.is_finite() && row.bound.is_finite(), "{phi}, {row:?}");
    assert!(phi <= 1.0 / f64::from(team.composed.robots));
    let largest = row.normal.iter().fold(0.0, |most: f64, component| most.max(component.abs()));
    let axes: Vec<Vec<(f64, f64)>> = (0..D).map(|d| logarithms(team, i, d)).collect();
    let top = axes.iter().flatten().fold(f64::NEG_INFINITY, |top: f64, &(_, log)| top.max(log));
    if top == f64::NEG_INFINITY {
        assert_eq!(largest.to_bits(), 0, "no terms, no row");
        return false;
    }
    let sum = |terms: &[(f64, f64)], signed: bool| -> f64 {
        terms.iter().map(|&(sign, log)| if signed { sign } else { 1.0 } * libm::exp(log - top)).sum()
    };
    let expected: Vector<D> = core::array::from_fn(|d| sum(&axes[d], true));
    let size = axes.iter().map(|terms| sum(terms, false)).fold(0.0, f64::max);
    let length = expected.iter().fold(0.0, |most: f64, component| most.max(component.abs()));
    if length < 1e3 * ROUNDING * size {
        return false;
    }
    assert!((1.0..2.0).contains(&largest), "{row:?}");
    for d in 0..D {
        let error = (row.normal[d] / largest - expected[d] / length).abs();
        assert!(
            error <= 4.0 * ROUNDING * size / length,
            "axis {d}: {row:?}, {expected:?}, {:?}",
            team.claims
        );
    }
    true
}

/// Sign and logarithm of every term of H_i along one axis.
fn logarithms<const D: usize>(team: &Team<D>, i: usize, axis: usize) -> Vec<(f64, f64)> {
    let (shape, composed) = (team.shape, team.composed);
    let limited = |exponent: f64| exponent.clamp(-EXPONENT_LIMIT, EXPONENT_LIMIT);
    let told = |k: usize| limited(-composed.w_r * (team.claims[k] - f64::from(composed.required)));
    let mut terms = Vec::new();
    for j in team.neighbors(i) {
        let offset = subtract(&team.positions[i], &team.positions[j]);
        let (sign, part) = (offset[axis].signum(), libm::log(offset[axis].abs()));
        let square = dot(&offset, &offset);
        let slack = shape.radius_m * shape.radius_m - square;
        let exponent = limited(-shape.q2 * slack * slack);
        let steepness =
            libm::log(4.0 * shape.q1 * shape.q2 * slack) - 2.0 * libm::log(1.0 + libm::exp(exponent));
        let pull = libm::log(composed.w_r) + exponent + steepness + part;
        let barrier = square - composed.distance_min_m * composed.distance_min_m;
        let push = libm::log(2.0 * composed.w_c) + limited(-composed.w_c * barrier) + part;
        terms.extend([(-sign, pull + told(i)), (-sign, pull + told(j)), (sign, push)]);
    }
    terms
}

/// A team with another radius, another size and claims of every magnitude.
fn extreme<const D: usize>(seed: u64) -> Team<D> {
    let mut random = Seeded(seed ^ 0xfeed);
    let share = if random.below(2) == 0 { PhiSplit::Neighbors } else { PhiSplit::Own };
    let mut team = Team::<D>::random(seed, share);
    team.shape.radius_m = [3.0, 7.0, 10.0, 30.0][random.below(4)];
    team.composed.w_r = [1.0, 15.0][random.below(2)];
    team.composed.w_c = [1.0, 25.0, 1e4][random.below(3)];
    let size = [1.0, 0.2 * team.shape.radius_m][random.below(2)];
    for position in &mut team.positions {
        *position = position.map(|component| size * component);
    }
    team.claims = team.levels();
    for claim in &mut team.claims {
        let honest = *claim;
        let lies = [-1e6, 1e6, 1e300, -1e300, 0.0, -37.0, -1e9, random.between(-41.0, -30.0)];
        *claim = if random.below(2) == 0 { honest } else { lies[random.below(lies.len())] };
    }
    team
}
