//! Draws runs of a sweep under the controllers that guarantee something until one violates a law: `hunt FILE RUNS SEED [LAW]`.
//!
//! Says `found LAW RUN TICK`, or `nothing RUNS`, the same on any number of cores. `tests/oracle.rs` lets it loose on broken
//! controllers.

use core::sync::atomic::{AtomicU64, Ordering};
use std::panic::resume_unwind;
use std::process::ExitCode;
use std::thread;

use closeranks_sim::scenario::Scenario;
use closeranks_sim::sweep::Plan;
use closeranks_sim::world::{Options, run};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, runs, seed, rest @ ..] = arguments.as_slice() else { return usage() };
    let (Ok(runs), Ok(seed)) = (runs.parse(), seed.parse()) else { return usage() };
    let Ok(text) = std::fs::read_to_string(file) else { return usage() };
    let plan = match Plan::read(&text) {
        Ok(plan) => plan,
        Err(problems) => {
            eprintln!("{problems:?}");
            return ExitCode::from(2);
        }
    };
    let law = rest.first().map(String::as_str);
    match first(runs, |number| {
        let drawn = plan.draw(seed, number).unwrap_or_else(|problems| panic!("run {number}: {problems:?}"));
        let mut ours = drawn.scenarios.iter().filter(|(scenario, _)| scenario.controller.row().guarantees);
        ours.find_map(|(scenario, _)| violation(scenario, law))
    }) {
        Some((number, (law, tick))) => say(&format!("found {law} {number} {tick}")),
        None => say(&format!("nothing {runs}")),
    }
    ExitCode::SUCCESS
}

/// The first of `runs` in which something is found. Every core takes the next that is left, until one before it was a find.
fn first<T: Send>(runs: u64, find: impl Fn(u64) -> Option<T> + Sync) -> Option<(u64, T)> {
    let (next, end) = (AtomicU64::new(0), AtomicU64::new(runs));
    let work = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= end.load(Ordering::Relaxed) {
                return None;
            }
            if let Some(found) = find(number) {
                end.fetch_min(number, Ordering::Relaxed);
                return Some((number, found));
            }
        }
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        let finds = workers
            .into_iter()
            .filter_map(|worker| worker.join().unwrap_or_else(|panic| resume_unwind(panic)));
        finds.min_by_key(|(number, _)| *number)
    })
}

/// The first violated law, of all or of the one that is sought, and its tick.
fn violation(scenario: &Scenario, sought: Option<&str>) -> Option<(&'static str, u32)> {
    let run = run(scenario, Options::default(), &mut |_| ()).unwrap_or_else(|error| panic!("{error}"));
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
