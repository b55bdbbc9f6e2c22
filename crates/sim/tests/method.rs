//! What docs/theory/paper.md says does not hold as printed, shown in whole runs. The other sections are about single robots,
//! sums and networks: `crates/core/tests/split.rs` and `consensus.rs`.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::settings::{Clock, ComposedSettings, LinkSettings};
use core::time::Duration;

use closeranks_sim::attack::{LevelAttack, ValueAttack};
use closeranks_sim::law::Law;
use closeranks_sim::output::summary::Summary;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::start::Start;
use closeranks_sim::world::{Options, run};

const ATTACKS: [LevelAttack; 3] = [LevelAttack::None, LevelAttack::Bias(-2.5), LevelAttack::Bias(3.5)];

fn summary(scenario: &Scenario) -> Summary {
    run(scenario, Options::default(), &mut |_| ()).unwrap().summary
}

/// docs/theory, sec:phi: φ_i falls below 0 with no attack, no new link and nearly continuous time, while every h_i stays positive.
//= paper thm:cbf-qp type=test
//= theory sec:phi type=test
#[test]
fn phi_i_is_not_protected() {
    let scenario = Scenario {
        duration_s: 1.5,
        malicious: Vec::new(),
        attack: ValueAttack::None.into(),
        clock: Clock { level_period: Duration::from_micros(200), ..Clock::default() },
        composed: ComposedSettings { alpha: 1.0, ..ComposedSettings::default() },
        link: LinkSettings { q2: 0.1, ..LinkSettings::default() },
        ..Scenario::default()
    };
    let run = run(&scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap();
    let record = run.record.unwrap();
    assert!(run.summary.start.phi_min > 0.08, "every phi_i begins far inside: {}", run.summary.start.phi_min);
    let first = record.phi.iter().position(|phi| *phi < -0.01).expect("some phi_i falls below -0.01");
    let until = &record.degree[..=first];
    assert!(until.iter().all(|degree| *degree == 10), "no link has formed or broken so far");
    assert!(record.h[..=first].iter().all(|h| *h > 0.0), "while every robot keeps its degree");
}

/// docs/theory, sec:phi, end: then programs become infeasible, which lem:equivalence rules out.
//= paper lem:equivalence type=test
//= theory sec:phi type=test
#[test]
fn programs_become_infeasible_without_any_attack() {
    let scenario = Scenario {
        duration_s: 3.0,
        malicious: Vec::new(),
        attack: ValueAttack::None.into(),
        clock: Clock { level_period: Duration::from_millis(1), ..Clock::default() },
        composed: ComposedSettings { alpha: 10.0, ..ComposedSettings::default() },
        link: LinkSettings { q2: 0.1, ..LinkSettings::default() },
        ..Scenario::default()
    };
    let summary = summary(&scenario);
    assert!(summary.start.inside);
    assert!(summary.broken(Law::Feasible) > 0, "programs without a solution");
}

/// docs/theory, sec:start: the published start is outside the safe set in every scenario; it comes inside by itself.
//= theory sec:start type=test
#[test]
fn the_published_start_is_outside_the_safe_set() {
    for attack in ATTACKS {
        let summary =
            summary(&Scenario { start: Start::Published, attack: attack.into(), ..Scenario::default() });
        assert!(!summary.start.inside);
        assert!(summary.start.distance_min_m < 0.3);
        assert!(summary.extremes.inside_from.is_some_and(|tick| tick > 0));
        assert!(summary.extremes.safe_from.is_some_and(|tick| tick > 0));
    }
}

/// docs/theory, sec:start: `inside` is inside in all three scenarios, for every steepness that is likely to be tried.
//= paper eq:phi_i type=test
//= theory sec:start type=test
#[test]
fn our_start_is_inside_the_safe_set() {
    for q2 in [0.1, 0.3, 0.9] {
        for level_attack in ATTACKS {
            let scenario = Scenario {
                attack: level_attack.into(),
                duration_s: 0.0,
                link: LinkSettings { q2, ..LinkSettings::default() },
                ..Scenario::default()
            };
            let summary = summary(&scenario);
            assert!(summary.start.phi_min > 0.0, "q2 = {q2}, {level_attack:?}: {}", summary.start.phi_min);
            assert!(summary.start.degree_min >= 7);
        }
    }
}

/// docs/theory, sec:start: the paper's three effects, together, from `inside`.
//= paper sec:sim type=test
#[test]
fn the_papers_three_effects_show_from_our_start() {
    let [nominal, under, over] =
        ATTACKS.map(|level_attack| summary(&Scenario { attack: level_attack.into(), ..Scenario::default() }));
    assert!(under.gyration_m < nominal.gyration_m && nominal.gyration_m < over.gyration_m);
    assert!(
        under.liar_distance_m < nominal.liar_distance_m && nominal.liar_distance_m < over.liar_distance_m
    );
    assert_eq!([nominal.malicious_below, under.malicious_below, over.malicious_below], [0, 0, 1]);
    for summary in [nominal, under, over] {
        for law in [Law::Degree, Law::Distance, Law::Interval, Law::Agreement, Law::Input, Law::Feasible] {
            assert_eq!(summary.broken(law), 0, "{law:?}");
        }
        assert!(summary.broken(Law::Shares) > 0, "docs/theory, sec:phi, in the paper's own runs");
    }
}

/// docs/theory, sec:wide-attacks: a lie that begins later, or swings, breaks what a constant one does not.
//= theory sec:wide-attacks type=test
#[test]
fn wider_lies_break_the_papers_controller() {
    let step = LevelAttack::Step { bias: -4.0, from_s: 2.0 };
    let crowded = summary(&Scenario {
        attack: step.into(),
        link: LinkSettings { q2: 0.1, ..LinkSettings::default() },
        composed: ComposedSettings { alpha: 1.0, ..ComposedSettings::default() },
        ..Scenario::default()
    });
    assert!(
        crowded.start.inside && crowded.extremes.distance_min_m < 0.1,
        "{}",
        crowded.extremes.distance_min_m
    );
    let sine = LevelAttack::Sine { amplitude: 5.0, period_s: 0.9 };
    let torn = summary(&Scenario {
        attack: sine.into(),
        link: LinkSettings { q2: 0.1, ..LinkSettings::default() },
        composed: ComposedSettings { alpha: 1.0, ..ComposedSettings::default() },
        ..Scenario::default()
    });
    assert!(torn.extremes.h_min < 0.0 || torn.extremes.distance_min_m < 0.1, "{:?}", torn.extremes);
}

/// The global φ of the true levels, which does hold in the nominal run, decays no faster than e^(−αt) from there on.
//= paper eq:composition type=test
#[test]
fn the_global_composition_is_kept_in_the_nominal_run() {
    let summary = summary(&Scenario::default());
    assert_eq!(summary.broken(Law::Composition), 0);
    assert!(summary.extremes.phi_global_min > 0.0);
}
