//! The team computed at once and robots one by one, with every message as bytes, give the same bits.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::composed::Share;
use closeranks_sim::attack::{LevelAttack, ValueAttack};
use closeranks_sim::record::Record;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::start::Start;
use closeranks_sim::world::{Engine, Options, run};

fn record(scenario: &Scenario, engine: Engine) -> Record {
    run(scenario, Options { record: true, engine, ..Options::default() }, &mut |_| ())
        .unwrap()
        .record
        .unwrap()
}

#[track_caller]
fn same_bits(scenario: &Scenario) {
    let (team, robots) = (record(scenario, Engine::Team), record(scenario, Engine::Robots));
    assert_eq!(team.digest(), robots.digest(), "{}", scenario.name);
    assert_eq!(team, robots, "{}", scenario.name);
}

fn short(name: &str) -> Scenario {
    Scenario { name: name.into(), duration_s: 2.0, ..Scenario::default() }
}

#[test]
fn the_papers_attacks_from_both_starts() {
    for start in [Start::Inside, Start::Published] {
        for attack in [LevelAttack::None, LevelAttack::Bias(-2.5), LevelAttack::Bias(3.5)] {
            same_bits(&Scenario { start: start.clone(), level_attack: attack, ..short("paper") });
        }
    }
}

#[test]
fn the_own_share_three_dimensions_and_no_value_attack() {
    let space = Start::Random { half_side_m: 0.9, distance_min_m: 0.4 };
    let cube = Scenario {
        dimension: 3,
        robots: 12,
        start: space,
        input_min_m_s: vec![-1.5; 3],
        input_max_m_s: vec![1.5; 3],
        value_attack: ValueAttack::None,
        ..short("cube")
    };
    same_bits(&cube);
    same_bits(&Scenario { share: Share::Own, ..cube });
    same_bits(&Scenario { share: Share::Own, level_attack: LevelAttack::Bias(3.5), ..short("own") });
}

/// Lies so wild that plain exponentials overflow, and clusters in which slopes vanish below what `f64` holds.
#[test]
fn levels_and_radii_beyond_the_range_of_f64() {
    for bias in [-60.0, -20.0, -16.0, 60.0, 900_000.0, -900_000.0] {
        same_bits(&Scenario { level_attack: LevelAttack::Bias(bias), ..short("wild") });
        same_bits(&Scenario {
            level_attack: LevelAttack::Bias(bias),
            radius_m: 9.0,
            ..short("wild and wide")
        });
    }
    same_bits(&Scenario { radius_m: 30.0, q2: 0.9, ..short("cluster") });
}

#[test]
fn attacks_that_change_with_time() {
    let step = LevelAttack::Step { bias: -4.0, from_s: 1.0 };
    let sine = LevelAttack::Sine { amplitude: 5.0, period_s: 0.9 };
    let random = LevelAttack::Random { min: -20.0, max: 20.0 };
    for level_attack in [step, sine, random] {
        same_bits(&Scenario { level_attack, ..short("in time") });
    }
}

#[test]
fn teams_of_other_sizes_and_no_liars() {
    for (robots, faults) in [(2, 0), (3, 1), (5, 0), (30, 4)] {
        let start = Start::Hexagon { spacing_m: 0.5 };
        let malicious = (1..=faults).collect();
        same_bits(&Scenario { robots, faults, malicious, start, ..short("size") });
    }
}
