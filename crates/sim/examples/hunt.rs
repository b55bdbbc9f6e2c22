//! Draws runs of a sweep under `budget` until one violates a law: `hunt FILE RUNS SEED [LAW]`.
//!
//! Says `found LAW RUN TICK`, or `nothing RUNS`. `tests/oracle.rs` lets it loose on broken controllers.

use std::process::ExitCode;

use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::sweep::Plan;
use closeranks_sim::world::{Options, run};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, runs, seed, rest @ ..] = arguments.as_slice() else { return usage() };
    let (Ok(runs), Ok(seed)) = (runs.parse(), seed.parse()) else { return usage() };
    let Ok(text) = std::fs::read_to_string(file) else { return usage() };
    let plan = match Plan::read(&text) {
        Ok(plan) => plan.under(Controller::Budget),
        Err(problems) => {
            eprintln!("{problems:?}");
            return ExitCode::from(2);
        }
    };
    let law = rest.first().map(String::as_str);
    let found = (0..runs).find_map(|number| {
        let drawn = plan.draw(seed, number).ok()?;
        drawn.scenarios.iter().find_map(|(scenario, _)| violation(scenario, law)).map(|found| (number, found))
    });
    match found {
        Some((number, (law, tick))) => say(&format!("found {law} {number} {tick}")),
        None => say(&format!("nothing {runs}")),
    }
    ExitCode::SUCCESS
}

/// The first violated law, of all or of the one that is sought, and its tick.
fn violation(scenario: &Scenario, sought: Option<&str>) -> Option<(&'static str, u32)> {
    let run = run(scenario, Options::default(), &mut |_| ()).ok()?;
    let mut violations = run.summary.violations(scenario);
    let verdict = violations.find(|verdict| sought.is_none_or(|law| law == verdict.law.name()))?;
    Some((verdict.law.name(), verdict.first?.tick))
}

fn usage() -> ExitCode {
    eprintln!("usage: hunt FILE RUNS SEED [LAW]");
    ExitCode::from(2)
}

#[expect(clippy::print_stdout, reason = "an example may speak")]
fn say(line: &str) {
    println!("{line}");
}
