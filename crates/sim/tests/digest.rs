//! A run is a pure function of scenario, seed and commit: a mixed scenario has a committed digest.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::composed::Share;
use closeranks_sim::attack::LevelAttack;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::start::Start;
use closeranks_sim::world::{Options, run};

/// Random start, wide enough that links break and form, an attack on levels and on values, the own share.
fn mixed() -> Scenario {
    Scenario {
        name: "mixed".into(),
        duration_s: 5.0,
        seed: 20_261_122,
        robots: 16,
        faults: 3,
        malicious: vec![2, 7, 11],
        share: Share::Own,
        start: Start::Random { half_side_m: 1.4, distance_min_m: 0.42 },
        level_attack: LevelAttack::Bias(1.5),
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
