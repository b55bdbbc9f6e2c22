//! What a robot knows of its neighbours' levels and degrees: true bounds, from positions alone.

use budget_team::{Team, id};
use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::knowledge::{KnownMargin, Seen, Sighting};
use closeranks_core::controller::budget::settings::{Budget, Form};
use closeranks_core::num::{dot, is_finite, subtract};
use closeranks_core::robot::neighbor::RobotId;
use seeded::Seeded;

mod budget_team;
mod seeded;

/// Enough numbers for all pairs of a dozen robots.
const SCRATCH: usize = 144;
/// More than the rounding of a sum of at most a dozen weights near 1.
const ROUNDING: f64 = 1e-13;

fn teams(assume: Assume) -> impl Iterator<Item = Team<2>> {
    (0..300).filter_map(move |seed| Team::random(seed, assume, Form::Link))
}

/// What is seen, with so many numbers as scratch; `None` if these are too few, or a sighting is not finite.
fn seen(
    budget: &Budget,
    (own, index): (RobotId, usize),
    sightings: &[Sighting<2>],
    scratch: usize,
) -> Option<Seen> {
    let mut scratch = vec![0.0; scratch];
    let mut survey = budget.survey(own, sightings, &mut scratch)?;
    budget.seen(index, sightings, &mut survey)
}

fn known(
    budget: &Budget,
    (own, index): (RobotId, usize),
    sightings: &[Sighting<2>],
    scratch: usize,
) -> Option<KnownMargin> {
    Some(budget.known(&seen(budget, (own, index), sightings, scratch)?))
}

/// For every robot i and neighbour k: k has at least the level and at most the degree that i reckons with. So i never counts on
/// more than h_k⁺, whatever is told to it, and who sees everybody counts on all of it.
//= theory eq:known type=test
//= theory thm:sensed type=test
#[test]
fn nobody_counts_on_more_than_there_is() {
    for assume in [Assume::Obedient, Assume::Free] {
        let (mut inside, mut exact) = (0, 0);
        for team in teams(assume) {
            let required = f64::from(team.need());
            for i in 0..team.count() {
                let (near, sightings) = (team.neighbors(i), team.sightings(i));
                for (index, &k) in near.iter().enumerate() {
                    let place = (id(i), index);
                    let Seen { low, degree, .. } =
                        seen(&team.budget, place, &sightings, SCRATCH).expect("finite");
                    let h = team.h(&team.positions, k);
                    let neighbors = u32::try_from(team.neighbors(k).len()).map_or(0.0, f64::from);
                    assert!(low <= h + required + ROUNDING && neighbors <= degree, "{low} {degree}");
                    let known = known(&team.budget, place, &sightings, SCRATCH).expect("finite");
                    assert!(known.budget <= h.max(0.0) + ROUNDING, "{known:?} of {h}");
                    assert!((known.budget - (low - required).max(0.0)).abs() <= ROUNDING);
                    let whole = near.len() + 1 == team.count();
                    assert!(!whole || (known.budget - h.max(0.0)).abs() <= ROUNDING, "{known:?} of {h}");
                    inside += 1;
                    exact += usize::from(whole);
                }
            }
        }
        assert!(exact > inside / 10 && exact < inside, "{exact} of {inside} see everybody");
    }
}

/// The trimmed sum leaves out the F largest.
//= theory thm:free type=test
#[test]
fn the_trimmed_level_is_the_least_over_robots_out_of_sight() {
    for team in teams(Assume::Free) {
        let faults = usize::from(team.budget.faults);
        for i in 0..team.count() {
            let (near, sightings) = (team.neighbors(i), team.sightings(i));
            for (index, &k) in near.iter().enumerate() {
                let seen = seen(&team.budget, (id(i), index), &sightings, SCRATCH).expect("finite");
                let mut weights: Vec<f64> = near
                    .iter()
                    .chain([&i])
                    .filter(|&&p| p != k)
                    .map(|&p| weight(&team, distance(&team, k, p)))
                    .collect();
                assert!((seen.low - trimmed(&mut weights, faults)).abs() < ROUNDING);
            }
        }
    }
}

fn weight(team: &Team<2>, distance_m: f64) -> f64 {
    let link = team.budget.curvature.link().link_at::<f64>(distance_m * distance_m);
    link.map_or(0.0, |link| link.weight)
}

fn distance(team: &Team<2>, i: usize, k: usize) -> f64 {
    let offset = subtract(&team.positions[i], &team.positions[k]);
    libm::sqrt(dot(&offset, &offset))
}

fn trimmed(weights: &mut [f64], faults: usize) -> f64 {
    weights.sort_by(f64::total_cmp);
    weights[..weights.len().saturating_sub(faults)].iter().sum()
}

#[test]
fn any_sightings_are_safe() {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, 1e-320, 0.0];
    let team = teams(Assume::Free).next().expect("a team");
    for seed in 0..500 {
        let mut random = Seeded(seed);
        let mut number = || odd.get(random.below(30)).copied().unwrap_or(random.between(-3.0, 3.0));
        let sightings: Vec<Sighting<2>> =
            (0..6).map(|j| Sighting::new(id(j), [number(), number()])).collect();
        for index in 0..8 {
            let all = sightings.iter().all(|sighting| is_finite(&sighting.offset_m));
            let found = known(&team.budget, (id(6), index), &sightings, SCRATCH);
            assert_eq!(found.is_some(), all && index < 6, "{sightings:?}");
            if let Some(known) = found {
                assert!(known.budget >= 0.0 && known.budget < 20.0 && known.degree_max >= 1.0, "{known:?}");
            }
            assert_eq!(known(&team.budget, (id(6), index), &sightings, 5), None, "too little scratch");
        }
    }
}
