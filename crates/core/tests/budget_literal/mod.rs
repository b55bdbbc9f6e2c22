//! What a robot knows of a neighbour, from the formulas alone: one neighbour at a time, one weight at a time.

use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::knowledge::{KnownMargin, Sighting};
use closeranks_core::controller::budget::settings::{Budget, Trust};
use closeranks_core::equations::link::Link;
use closeranks_core::num::{Vector, is_finite, length, subtract};
use closeranks_core::robot::neighbor::RobotId;

/// Bounds of the level of a neighbour, and of how many neighbours it has.
struct Interval {
    low: f64,
    high: f64,
    degree_max: f64,
}

/// The level of robot `own`, or its trimmed level.
pub(crate) fn level<const D: usize>(budget: &Budget, own: RobotId, sightings: &[Sighting<D>]) -> f64 {
    let weights = sightings.iter().map(|sighting| counted(budget, own, sighting.id, &sighting.offset_m));
    total(budget, weights.collect(), 0.0, 0)
}

/// b_ij and δ⁺_ij of `sightings[index]`.
pub(crate) fn known<const D: usize>(
    budget: &Budget,
    own: RobotId,
    index: usize,
    sightings: &[Sighting<D>],
) -> KnownMargin {
    let Interval { low, high, degree_max } = interval(budget, own, index, sightings);
    let Sighting { id, claim, .. } = sightings[index];
    let need = f64::from(budget.need.need(id));
    let claim = claim.filter(|claim| budget.trust != Trust::Seen && (claim.level - need).is_finite());
    let claimed = claim.map_or(0.0, |claim| {
        let spare = (claim.level - need).max(0.0);
        if claim.age_ticks == 0 { spare } else { budget.decayed(spare, claim.age_ticks) }
    });
    let (seen, most) = (low - need, high - need);
    let told = if claimed > most { most } else { claimed };
    let believed = match budget.trust {
        Trust::Told => told,
        Trust::ToldOrSeen => told.max(seen),
        Trust::Seen => seen,
    };
    KnownMargin { budget: believed.max(0.0), degree_max }
}

fn interval<const D: usize>(
    budget: &Budget,
    own: RobotId,
    index: usize,
    sightings: &[Sighting<D>],
) -> Interval {
    let Sighting { id, offset_m, position_m, .. } = sightings[index];
    let mut others: Vec<(RobotId, Vector<D>)> =
        sightings.iter().map(|other| (other.id, subtract(&other.position_m, &position_m))).collect();
    others[index] = (own, offset_m);
    // The sum is in order of numbers, with the robot itself among the others.
    others.sort_by_key(|(other, _)| other.0);
    let weights: Vec<f64> =
        others.iter().map(|(other, offset)| counted(budget, id, *other, offset)).collect();
    let in_sight = sightings.iter().filter(|other| is_finite(&other.offset_m)).count();
    let unseen = usize::from(budget.need.robots()).saturating_sub(in_sight + 1);
    let degree = unseen + weights.iter().filter(|weight| **weight >= 0.0).count();
    let error_m = budget.errors.offset_m;
    let nearest_m = (budget.curvature.link().radius_m - length(&offset_m) - error_m).max(0.0);
    let blur = 2.0 * error_m * budget.curvature.fall_max();
    let low = total(budget, weights.clone(), 0.0, 0);
    let more = total(budget, weights, weight(budget, nearest_m).max(0.0), unseen);
    let high = if error_m > 0.0 { count(degree) * blur } else { 0.0 } + if unseen == 0 { low } else { more };
    Interval { low, high, degree_max: count(degree.max(1)) }
}

/// The least weight of a link as `robot` counts it; −1 where there is none for certain.
fn counted<const D: usize>(budget: &Budget, robot: RobotId, other: RobotId, offset: &Vector<D>) -> f64 {
    if !budget.need.counts(robot, other) {
        return -1.0;
    }
    let error_m = budget.errors.offset_m;
    if error_m == 0.0 {
        let link: Option<Link<f64>> = budget.curvature.link().link(offset);
        return link.map_or(-1.0, |link| link.weight);
    }
    let (distance_m, radius_m) = (length(offset), budget.curvature.link().radius_m);
    if distance_m <= radius_m + error_m { weight(budget, distance_m + error_m).max(0.0) } else { -1.0 }
}

/// The weight of a link; −1 without one.
fn weight(budget: &Budget, distance_m: f64) -> f64 {
    budget.curvature.link().link_at::<f64>(distance_m * distance_m).map_or(-1.0, |link| link.weight)
}

/// Sum of the positive weights and of `copies` more, under `Free` without the F largest.
fn total(budget: &Budget, mut weights: Vec<f64>, extra: f64, mut copies: usize) -> f64 {
    if budget.assume == Assume::Free {
        weights.sort_by(f64::total_cmp);
        for _ in 0..budget.faults {
            match weights.last() {
                Some(largest) if copies == 0 || *largest >= extra => {
                    weights.pop();
                }
                _ => copies = copies.saturating_sub(1),
            }
        }
    }
    weights.iter().fold(0.0, |sum, weight| sum + weight.max(0.0)) + count(copies) * extra
}

pub(crate) fn count(number: usize) -> f64 {
    u32::try_from(number).map_or(f64::MAX, f64::from)
}
