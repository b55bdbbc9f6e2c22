//! What a robot knows of its neighbours' levels: true bounds, and claims that cannot do harm.

use budget_team::{Team, id};
use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::knowledge::{Claim, KnownMargin, Sighting};
use closeranks_core::controller::budget::settings::{Budget, Form, Trust};
use closeranks_core::num::{dot, is_finite, length, subtract};
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

/// Bounds of the level of a neighbour, from positions alone.
#[derive(Clone, Copy, Debug)]
struct Interval {
    low: f64,
    high: f64,
    degree: f64,
}

/// The interval from the formulas, with so many numbers as scratch; `None` if these are too few, or a sighting is not finite.
fn interval(
    budget: &Budget,
    (own, index): (RobotId, usize),
    sightings: &[Sighting<2>],
    scratch: usize,
) -> Option<Interval> {
    let mut scratch = vec![0.0; scratch];
    let mut survey = budget.survey(own, sightings, &mut scratch)?;
    let seen = budget.seen(index, sightings, &mut survey)?;
    let high = budget.high(&seen, length(&sightings[index].offset_m));
    Some(Interval { low: seen.low, high, degree: seen.degree })
}

fn known(
    budget: &Budget,
    (own, index): (RobotId, usize),
    sightings: &[Sighting<2>],
    scratch: usize,
) -> Option<KnownMargin> {
    let mut scratch = vec![0.0; scratch];
    let mut survey = budget.survey(own, sightings, &mut scratch)?;
    let seen = budget.seen(index, sightings, &mut survey)?;
    Some(budget.known(&seen, length(&sightings[index].offset_m)))
}

fn with_claim(sightings: &[Sighting<2>], level: f64, age_ticks: u32) -> Vec<Sighting<2>> {
    let claim = Some(Claim { level, age_ticks });
    sightings.iter().map(|sighting| Sighting { claim, ..*sighting }).collect()
}

/// For every robot i and neighbour k: the interval of k contains its true level.
//= theory eq:interval type=test
#[test]
fn the_true_level_and_degree_are_in_the_interval() {
    for assume in [Assume::Obedient, Assume::Free] {
        let (mut inside, mut exact) = (0, 0);
        for team in teams(assume) {
            let required = f64::from(team.need());
            for i in 0..team.count() {
                let (seen, sightings) = (team.neighbors(i), team.sightings(i));
                for (index, &k) in seen.iter().enumerate() {
                    let interval =
                        interval(&team.budget, (id(i), index), &sightings, SCRATCH).expect("finite");
                    let level = team.h(&team.positions, k) + required;
                    let degree = u32::try_from(team.neighbors(k).len()).map_or(0.0, f64::from);
                    assert!(
                        interval.low <= level + ROUNDING && level <= interval.high + ROUNDING,
                        "{interval:?}"
                    );
                    assert!(degree <= interval.degree, "{degree} of {interval:?}");
                    inside += 1;
                    exact += usize::from(seen.len() + 1 == team.count() && interval.low == interval.high);
                }
            }
        }
        assert!(exact > inside / 10 && exact < inside, "{exact} of {inside} see everybody");
    }
}

/// Honest claims of today are taken as they are, those of a liar never beyond the interval, whatever their age.
//= theory thm:any-claim type=test
//= theory eq:known type=test
#[test]
fn a_claim_moves_the_budget_inside_the_interval_only() {
    let claims = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308, -1e308, 0.0, 9.0, 20.0];
    for (case, team) in teams(Assume::Obedient).enumerate() {
        let budget = Budget { trust: Trust::ToldOrSeen, ..team.budget };
        let required = f64::from(team.need());
        let sightings = team.sightings(0);
        for (index, &k) in team.neighbors(0).iter().enumerate() {
            let interval = interval(&budget, (id(0), index), &sightings, SCRATCH).expect("finite");
            let (low, high) = ((interval.low - required).max(0.0), (interval.high - required).max(0.0));
            let told = |level, age| {
                let sightings = with_claim(&sightings, level, age);
                known(&budget, (id(0), index), &sightings, SCRATCH).expect("finite").budget
            };
            for age in [0, 1, 7, u32::MAX] {
                let known = told(claims[case % claims.len()], age);
                assert!((low..=high).contains(&known), "{known} outside {low} to {high}");
            }
            let h = team.h(&team.positions, k);
            assert!((told(h + required, 0) - h.max(0.0)).abs() <= ROUNDING, "the honest claim {h}");
            assert!(told(h + required, 3) <= h.max(0.0) + ROUNDING, "an old claim");
        }
    }
}

//= theory eq:known type=test
#[test]
fn trust_decides_what_counts() {
    let team = teams(Assume::Obedient)
        .find(|team| team.sightings(0).len() + 1 < team.count())
        .expect("a partial view");
    let sightings = team.sightings(0);
    let interval = interval(&team.budget, (id(0), 0), &sightings, SCRATCH).expect("finite");
    let known = |trust, sightings: &[Sighting<2>]| {
        let budget = Budget { trust, gamma: 0.25, gain_slope: 0.0, ..team.budget };
        known(&budget, (id(0), 0), sightings, SCRATCH).expect("finite").budget
    };
    let required = team.need();
    let floor = (interval.low - f64::from(required)).max(0.0);
    assert_eq!(known(Trust::Seen, &with_claim(&sightings, 1e9, 0)), floor);
    assert_eq!(known(Trust::Told, &with_claim(&sightings, -1e9, 0)), 0.0);
    assert_eq!(known(Trust::ToldOrSeen, &with_claim(&sightings, -1e9, 0)), floor);
    let silent: Vec<_> = sightings.iter().map(|sighting| Sighting { claim: None, ..*sighting }).collect();
    assert_eq!(known(Trust::Told, &silent), 0.0);
    let spare = 0.25 * (interval.high - f64::from(required));
    let aged = known(Trust::Told, &with_claim(&sightings, f64::from(required) + spare, 2));
    assert!((aged - spare * 0.75 * 0.75).abs() < ROUNDING, "two ticks of silence");
}

/// The trimmed sum leaves out the F largest, of robots out of sight too.
//= theory thm:free type=test
#[test]
fn trimmed_bounds_are_the_extremes_over_robots_out_of_sight() {
    for team in teams(Assume::Free) {
        let faults = usize::from(team.budget.faults);
        for i in 0..team.count() {
            let (seen, sightings) = (team.neighbors(i), team.sightings(i));
            for (index, &k) in seen.iter().enumerate() {
                let interval = interval(&team.budget, (id(i), index), &sightings, SCRATCH).expect("finite");
                let most = weight(&team, (team.radius_m() - distance(&team, i, k)).max(0.0));
                let mut weights: Vec<f64> = seen
                    .iter()
                    .chain([&i])
                    .filter(|&&p| p != k)
                    .map(|&p| weight(&team, distance(&team, k, p)))
                    .collect();
                let low = trimmed(&mut weights, faults);
                weights.resize(team.count() - 1, most);
                let high = trimmed(&mut weights, faults);
                assert!((interval.low - low).abs() < ROUNDING && (interval.high - high).abs() < ROUNDING);
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
        let sightings: Vec<Sighting<2>> = (0..6)
            .map(|j| {
                let offset_m = [number(), number()];
                Sighting::new(id(j), offset_m, Some(Claim { level: number(), age_ticks: 3 }))
            })
            .collect();
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
