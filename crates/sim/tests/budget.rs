//! `budget` in whole runs: what it guarantees holds for lies, tick lengths and starts that break the paper's controller.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::settings::{BudgetSettings, Clock, LinkSettings, Team};
use closeranks_sim::scenario::Limits;
use core::time::Duration;

use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::settings::Trust;
use closeranks_core::program::Outcome;
use closeranks_sim::attack::LevelAttack;
use closeranks_sim::law::Law;
use closeranks_sim::scenario::start::Start;
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::{Options, Run, run};

fn budget() -> Scenario {
    Scenario { controller: Controller::Budget, duration_s: 5.0, ..Scenario::default() }
}

fn recorded(scenario: &Scenario) -> Run {
    run(scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap()
}

/// Degrees, distances, values and inputs are kept, h of normal robots stays at 0 or above beyond rounding, and no
/// program is without an answer.
#[track_caller]
fn kept(scenario: &Scenario) {
    let run = recorded(scenario);
    assert!(run.summary.start.inside, "{scenario:?}");
    for law in [Law::Degree, Law::Distance, Law::Interval, Law::Agreement, Law::Input, Law::Feasible] {
        assert_eq!(run.summary.broken(law), 0, "{law:?}: {:?}, {scenario:?}", run.summary.verdicts);
    }
    if scenario.budget.assume == Assume::Obedient {
        assert!(run.summary.extremes.h_min > -1e-9, "{} {scenario:?}", run.summary.extremes.h_min);
    }
    let outcomes = run.record.unwrap().outcome;
    assert!(!outcomes.contains(&Outcome::Infeasible));
}

#[test]
fn any_bias_is_survived() {
    for bias in [-1e6, -40.0, -10.0, -2.5, 0.0, 1.0, 3.5, 40.0, 1e6] {
        kept(&Scenario { attack: LevelAttack::Bias(bias).into(), ..budget() });
    }
}

#[test]
fn lies_that_change_with_time_are_survived() {
    let step = LevelAttack::Step { bias: -6.0, from_s: 2.0 };
    let sine = LevelAttack::Sine { amplitude: 10.0, period_s: 0.9 };
    let random = LevelAttack::Random { min: -20.0, max: 20.0 };
    for level_attack in [step, sine, random] {
        for q2 in [Some(0.1), Some(0.9), None] {
            kept(&Scenario {
                attack: level_attack.into(),
                budget: BudgetSettings { q2, ..budget().budget },
                ..budget()
            });
        }
    }
}

#[test]
fn long_ticks_are_survived() {
    for (tick_ms, q2) in
        [(20, None), (50, Some(0.1)), (50, None), (50, Some(48.0)), (100, None), (100, Some(0.3))]
    {
        let (tau_1, tau_2) = (Duration::from_millis(tick_ms), Duration::from_millis(100));
        kept(&Scenario {
            attack: LevelAttack::Bias(3.5).into(),
            clock: Clock { level_period: tau_1, value_period: tau_2, ..budget().clock },
            budget: BudgetSettings { q2, ..budget().budget },
            ..budget()
        });
    }
}

#[test]
fn every_trust_and_assumption_in_two_and_three_dimensions() {
    for trust in [Trust::Told, Trust::ToldOrSeen, Trust::Seen] {
        for assume in [Assume::Obedient, Assume::Free] {
            kept(&Scenario {
                attack: LevelAttack::Bias(6.0).into(),
                budget: BudgetSettings { trust, assume, ..budget().budget },
                ..budget()
            });
            let start = Start::Random { half_side_m: 0.8, distance_min_m: 0.45 };
            let corner = vec![1.5; 3];
            let low = vec![-1.5; 3];
            let cube = Scenario {
                dimension: 3,
                start,
                limits: Limits { input_max_m_s: corner, input_min_m_s: low, ..budget().limits.clone() },
                ..budget()
            };
            kept(&Scenario {
                attack: LevelAttack::Bias(-3.0).into(),
                budget: BudgetSettings { trust, assume, ..cube.budget },
                team: Team { robots: 12, ..cube.team },
                ..cube
            });
        }
    }
}

#[test]
fn random_starts_and_other_teams() {
    for seed in 0..12 {
        let start = Start::Random { half_side_m: 1.1, distance_min_m: 0.4 };
        kept(&Scenario { seed, start, attack: LevelAttack::Bias(9.0).into(), ..budget() });
        let start = Start::Random { half_side_m: 0.8, distance_min_m: 0.4 };
        kept(&Scenario { seed, start, malicious: vec![4], team: Team { robots: 6, faults: 1 }, ..budget() });
    }
}

/// The published start has two robots too close: they come apart, and from then on everything holds.
#[test]
fn a_start_outside_the_set_is_recovered_from() {
    let run = recorded(&Scenario { start: Start::Published, ..budget() });
    assert!(!run.summary.start.inside);
    let outcomes = run.record.unwrap().outcome;
    assert!(outcomes[..11].contains(&Outcome::Recovering));
    assert!(!outcomes[11 * 20..].contains(&Outcome::Recovering), "within 0.1 s");
    assert!(run.summary.extremes.safe_from.is_some_and(|tick| tick > 0 && tick < 20));
}

/// `composed` breaks under the same lie and tick, so what the runs above survive is something.
#[test]
fn the_papers_controller_does_not_survive_these() {
    let slow = Scenario {
        controller: Controller::Composed,
        clock: Clock { level_period: Duration::from_millis(50), ..budget().clock },
        link: LinkSettings { q2: 0.9, ..budget().link },
        ..budget()
    };
    let summary = recorded(&slow).summary;
    assert!(summary.broken(Law::Degree) + summary.broken(Law::Distance) > 0);
}

/// Two hours are more ticks of a microsecond than 32 bits count. Something that never was is longer ago than that.
#[test]
fn ages_of_more_ticks_than_32_bits_count() {
    let hour = Duration::from_hours(1);
    let [tau_1, tau_2] = [1, 10].map(Duration::from_micros);
    let slow = Scenario {
        duration_s: 3e-5,
        clock: Clock {
            level_period: tau_1,
            value_period: tau_2,
            told_max: hour,
            error: hour,
            ..budget().clock
        },
        ..budget()
    };
    let summary = recorded(&slow).summary;
    assert_eq!(
        (summary.covered_share, summary.violations(&slow).count()),
        (1.0, 0),
        "{:?}",
        summary.verdicts
    );
}
