//! A run is a pure function of scenario, seed and commit: a mixed scenario has a committed digest.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use core::time::Duration;

use closeranks_core::controller::assume::Assume;
use closeranks_core::equations::composition::PhiSplit;
use closeranks_core::need::Listen;
use closeranks_core::settings::{BudgetSettings, Clock, ComposedSettings, LinkSettings, LinksSettings, Team};
use closeranks_sim::attack::{LevelAttack, MotionAttack};
use closeranks_sim::faults::{Faults, Network};
use closeranks_sim::scenario::ranks::{How, Ranking};
use closeranks_sim::scenario::start::Start;
use closeranks_sim::scenario::{Controller, Limits, Scenario};
use closeranks_sim::world::{Options, run};

/// A scenario with a random start, wide enough that links break and form, with attacks on levels and on values, and with the
/// split `own`.
fn mixed() -> Scenario {
    Scenario {
        name: "mixed".into(),
        duration_s: 5.0,
        seed: 20_261_122,
        malicious: vec![2, 7, 11],
        start: Start::Random { half_side_m: 1.4, distance_min_m: 0.42 },
        attack: LevelAttack::Bias(1.5).into(),
        team: Team { robots: 16, faults: 3 },
        composed: ComposedSettings { phi_split: PhiSplit::Own, ..ComposedSettings::default() },
        ..Scenario::default()
    }
}

fn digest(scenario: &Scenario) -> u64 {
    run(scenario, Options { record: true, ..Options::default() }, &mut |_| ())
        .unwrap()
        .record
        .unwrap()
        .digest()
}

/// If this changes, every recorded run changes: say so in CHANGELOG.md, with the reason.
#[test]
fn the_mixed_run_has_the_committed_digest() {
    assert_eq!(format!("{:016x}", digest(&mixed())), "3fc43a887b78c84c");
}

/// Many short runs of `budget` for one digest, with all kinds of assumptions, dimensions, ticks, teams, lies and
/// starts.
fn budgets() -> Vec<Scenario> {
    let plain = Scenario { controller: Controller::Budget, duration_s: 2.0, ..Scenario::default() };
    let mut runs = Vec::new();
    for assume in [Assume::Obedient, Assume::Free] {
        for (bias, tick_ms, q2) in [(3.5, 5, 0.3), (-2.5, 5, 0.1), (0.0, 50, 0.3), (1e6, 100, 0.9)] {
            let (level_attack, tau_1) = (LevelAttack::Bias(bias), Duration::from_millis(tick_ms));
            runs.push(Scenario {
                attack: level_attack.into(),
                budget: BudgetSettings { assume, q2: (q2 != 0.3).then_some(q2), ..plain.budget },
                clock: Clock { level_period: tau_1, ..plain.clock },
                link: LinkSettings { q2, ..plain.link },
                ..plain.clone()
            });
        }
        let cube = Scenario {
            dimension: 3,
            start: Start::Random { half_side_m: 0.8, distance_min_m: 0.45 },
            team: Team { robots: 12, ..plain.team },
            limits: Limits {
                input_min_m_s: vec![-1.5; 3],
                input_max_m_s: vec![1.5; 3],
                ..plain.limits.clone()
            },
            ..plain.clone()
        };
        runs.push(Scenario {
            attack: LevelAttack::Bias(-3.0).into(),
            budget: BudgetSettings { assume, ..cube.budget },
            ..cube
        });
    }
    runs.push(Scenario { start: Start::Published, duration_s: 10.0, ..plain.clone() });
    runs.push(Scenario { controller: Controller::Budget, ..mixed() });
    runs.push(Scenario { link: LinkSettings { radius_m: 30.0, q2: 0.9, ..plain.link }, ..plain.clone() });
    let random = LevelAttack::Random { min: -20.0, max: 20.0 };
    runs.push(Scenario {
        attack: random.into(),
        duration_s: 10.0,
        composed: ComposedSettings { phi_split: PhiSplit::Own, ..plain.composed },
        ..plain
    });
    runs
}

/// If this changes, every recorded run of our own controller changes: say so in CHANGELOG.md, with the reason.
#[test]
fn runs_of_budget_have_the_committed_digest() {
    let digests = budgets().iter().map(digest).fold(0, |all: u64, one| all.rotate_left(7) ^ one);
    assert_eq!(format!("{digests:016x}"), "b3377cd2ca25a1f2");
}

/// Short runs of `links`: at once and one by one, with liars that move as they like, with ranks.
fn links() -> Vec<Scenario> {
    let plain = Scenario { controller: Controller::Links, duration_s: 2.0, ..Scenario::default() };
    let lossy = Faults { network: Network { loss: 0.2, ..Network::default() }, ..Faults::default() };
    let free = LinksSettings { assume: Assume::Free, ..plain.links };
    let ranks = Ranking { how: How::Own { core: 7 }, listen: Listen::All };
    vec![
        plain.clone(),
        Scenario { faults: lossy, ..plain.clone() },
        Scenario { links: free, attack: MotionAttack::Flee.into(), ..plain.clone() },
        Scenario {
            ranks: Some(ranks),
            start: Start::Hexagon { spacing_m: 0.6 },
            team: Team { robots: 20, ..plain.team },
            ..plain
        },
    ]
}

/// If this changes, every recorded run of `links` changes: say so in CHANGELOG.md, with the reason.
#[test]
fn runs_of_links_have_the_committed_digest() {
    let digests = links().iter().map(digest).fold(0, |all: u64, one| all.rotate_left(7) ^ one);
    assert_eq!(format!("{digests:016x}"), "0aecb7b4d56ba015");
}

#[test]
fn the_run_without_a_controller_has_the_committed_digest() {
    let none = Scenario { controller: Controller::None, ..mixed() };
    assert_eq!(format!("{:016x}", digest(&none)), "9f8580a027ba10c0");
}

#[test]
fn one_thread_or_many_give_the_same_bits() {
    let alone = digest(&mixed());
    let scenario = mixed();
    std::thread::scope(|scope| {
        let runs: Vec<_> = (0..4).map(|_| scope.spawn(|| digest(&scenario))).collect();
        for run in runs {
            assert_eq!(run.join().unwrap(), alone);
        }
    });
}

#[test]
fn another_seed_is_another_run() {
    assert_ne!(digest(&mixed()), digest(&Scenario { seed: 1, ..mixed() }));
}
