//! Everything that can go wrong, under `budget`: nothing is broken where its assumptions hold.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_sim::output::summary::Summary;
use closeranks_sim::parse;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Options, run};

/// What is wrong, and whether the assumptions of the theorem hold all the same.
const FAULTS: [(&str, bool); 27] = [
    ("network = { loss = 0.9 }", true),
    ("network = { loss = 1.0 }", true),
    ("network = { burst_begin = 0.05, burst_end = 0.1 }", true),
    ("network = { delay_min_s = 0.0, delay_max_s = 0.08 }", true),
    ("network = { delay_min_s = 0.02, delay_max_s = 0.3, duplicate = 0.5 }", true),
    ("network = { deaf = 0.5 }", true),
    ("network = { partition = { first = 5, from_s = 0.5, to_s = 1.5 } }", true),
    ("clocks = { offset_max_s = 0.05 }\nclock = { error_s = 0.05 }\nnetwork = { delay_max_s = 0.05 }", true),
    ("clocks = { offset_max_s = 0.05 }\nnetwork = { delay_max_s = 0.05 }", false),
    ("clocks = { drift_max = 0.01 }\nclock = { error_s = 0.06, hold_max_s = 0.0055 }", true),
    ("sensing = { noise_m = 0.01 }\ncontroller = { kind = \"budget\", position_error_m = 0.01 }", true),
    ("sensing = { noise_m = 0.03 }\ncontroller = { kind = \"budget\", position_error_m = 0.01 }", false),
    ("sensing = { frozen = { robot = 3, from_s = 0.5, to_s = 1.0 } }", false),
    ("sensing = { jump = { robot = 5, from_s = 0.5, to_s = 1.0, by_m = 0.5 } }", false),
    ("plant = { crash = { robot = 4, from_s = 0.5, to_s = 1.2 } }", true),
    ("plant = { crash = { robot = 4, from_s = 0.5, to_s = 1.2 }, memory = \"forgets\" }", true),
    ("plant = { missed = 0.1 }", true),
    ("plant = { missed = 0.1, when_missed = \"goes-on\" }", false),
    ("plant = { lag_s = 0.02 }\ncontroller = { kind = \"budget\", tracking_error_m = 0.043 }", true),
    ("plant = { lag_s = 0.02 }", false),
    ("attack = { level = { kind = \"ramp\", rate_per_s = 3.0 } }", true),
    ("attack = { level = { kind = \"faces\" }, value = { kind = \"split\" } }", true),
    ("attack = { level = { kind = \"garbage\" }, value = { kind = \"faces\" } }", true),
    ("attack = { level = { kind = \"replay\", age_s = 1.0 }, value = { kind = \"sway\" } }", true),
    ("attack = { level = { kind = \"silent\" }, value = { kind = \"extreme\" } }", true),
    ("attack = { motion = \"flee\" }\ncontroller = { kind = \"budget\", assume = \"free\" }", true),
    ("attack = { motion = \"wander\" }\ncontroller = { kind = \"budget\" }", false),
];

fn scenario(fault: &str, seed: u64) -> Scenario {
    let kind = if fault.contains("controller") { "" } else { "controller = { kind = \"budget\" }\n" };
    parse::scenario(&format!("duration_s = 3.0\nseed = {seed}\n{kind}{fault}\n")).unwrap()
}

fn summary(scenario: &Scenario) -> Summary {
    run(scenario, Options::default(), &mut |_| ()).unwrap().summary
}

#[test]
fn nothing_is_broken_where_the_assumptions_hold() {
    for (fault, covered) in FAULTS {
        for seed in 0..3 {
            let scenario = scenario(fault, seed);
            let summary = summary(&scenario);
            assert_eq!(
                summary.violations(&scenario).count(),
                0,
                "{fault}, seed {seed}: {:#?}",
                summary.verdicts
            );
            if covered {
                let broken: u64 = summary.failures(&scenario).map(|verdict| verdict.count).sum();
                assert_eq!(broken, 0, "{fault}, seed {seed}: {:#?}", summary.verdicts);
            }
            eprintln!(
                "{fault}: gyration {:.3}, guaranteed {:.3}, recovery {:.3} s, raw {}",
                summary.gyration_m,
                summary.guaranteed_share,
                summary.recovery_s,
                summary.failures(&scenario).map(|v| v.count).sum::<u64>()
            );
        }
    }
}
