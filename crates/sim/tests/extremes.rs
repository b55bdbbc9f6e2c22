//! Whatever a scenario may hold, a run ends with finite inputs in their box, and both engines agree on every bit.

use closeranks_core::settings::{Clock, ComposedSettings, LinkSettings, Team};
use closeranks_sim::scenario::Limits;
use core::time::Duration;

use closeranks_core::equations::composition::PhiSplit;
use closeranks_core::settings::range::MAGNITUDE_MAX;
use closeranks_sim::attack::{Attack, LevelAttack, ValueAttack};
use closeranks_sim::law::Law;
use closeranks_sim::random::{Random, Stream};
use closeranks_sim::scenario::start::Start;
use closeranks_sim::scenario::{Scenario, Values};
use closeranks_sim::world::{Engine, Options, run};

/// One of `choices`.
fn pick(random: &mut Random, choices: &[f64]) -> f64 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "small"
    )]
    let index = random.uniform(0.0, choices.len() as f64) as usize;
    choices[index]
}

fn extreme(seed: u64) -> Scenario {
    let mut random = Random::new(seed, Stream::Start);
    let mut sized = |choices: &[f64]| pick(&mut random, choices);
    let huge = &[1e-6, 1e-3, 1.0, 30.0, 1e3, MAGNITUDE_MAX];
    let radius_m = sized(huge);
    let scale = sized(&[1e-6, 1e-2, 0.3, 1.0, 1e3, 1e6 / radius_m]).min(1e6 / radius_m) * radius_m;
    let positions =
        (0..7).map(|robot| vec![scale * sized(&[-1.0, -0.4, 0.0, 0.3, 1.0]), scale * f64::from(robot) / 7.0]);
    Scenario {
        duration_s: 0.05,
        seed,
        start: Start::Listed(positions.collect()),
        attack: Attack {
            level: LevelAttack::Bias(sized(&[-1e6, -40.0, -1.0, 0.0, 3.0, 1e6])),
            value: ValueAttack::Random { min: -1e6, max: 1e6 },
            ..Attack::default()
        },
        values: Values::Random { min: -1e6, max: 1e6 },
        team: Team { robots: 7, faults: 2 },
        link: LinkSettings { radius_m, q2: sized(huge), ..LinkSettings::default() },
        composed: ComposedSettings {
            w_r: sized(huge),
            w_c: sized(huge),
            alpha: sized(huge),
            phi_split: if sized(&[0.0, 1.0]) > 0.5 { PhiSplit::Own } else { PhiSplit::Neighbors },
        },
        limits: Limits {
            distance_min_m: radius_m * sized(&[1e-9, 0.1, 0.999]),
            input_min_m_s: vec![-sized(huge), -sized(&[0.0, 1.0, 1e6])],
            input_max_m_s: vec![sized(&[0.0, 1.0, 1e6]), sized(huge)],
            ..Limits::default()
        },
        clock: Clock {
            level_period: Duration::from_millis(5),
            value_period: Duration::from_millis(10),
            ..Clock::default()
        },
        ..Scenario::default()
    }
}

#[test]
fn any_scenario_runs_to_its_end() {
    for seed in 0..400 {
        let scenario = extreme(seed);
        let [team, robots] = [Engine::Team, Engine::Robots].map(|engine| {
            run(&scenario, Options { record: true, engine, ..Options::default() }, &mut |_| ()).unwrap()
        });
        let record = team.record.as_ref().unwrap();
        assert_eq!(team.summary.broken(Law::Input), 0, "seed {seed}: {scenario:?}");
        assert_eq!(team.summary.broken(Law::Interval), 0, "seed {seed}");
        let numbers = record.positions_m.iter().chain(&record.inputs_m_s).chain([
            &record.h,
            &record.phi,
            &record.value,
        ]);
        assert!(numbers.flatten().all(|number| number.is_finite()), "seed {seed}: {scenario:?}");
        assert_eq!(record.digest(), robots.record.unwrap().digest(), "seed {seed}: {scenario:?}");
    }
}

#[test]
fn the_largest_crowd_is_refused_within_seconds() {
    let crowd = Scenario {
        start: Start::Random { half_side_m: 30.0, distance_min_m: 0.6 },
        team: Team { robots: 10_000, ..Team::default() },
        ..Scenario::default()
    };
    assert!(crowd.positions::<2>().is_err());
}
