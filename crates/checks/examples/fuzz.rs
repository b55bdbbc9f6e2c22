//! Looks for bytes that break a promise, for as long as one has, and counts what was tried in `fuzz/executions.txt`.
//!
//! ```text
//! cargo run --release -p closeranks-checks --example fuzz -- 60 message link_message
//! ```
//!
//! The time in seconds is for each target. The random numbers of a run begin with the executions so far, so no run repeats
//! another one. Unlike cargo-fuzz it does not see which code was reached; it needs no nightly toolchain and is fast.

#![allow(clippy::print_stdout, reason = "a program for a terminal")]

use core::time::Duration;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;
use std::{env, fs, panic};

use mutated::{corpus, mutated};
use seeded::Seeded;

#[path = "../tests/mutated/mod.rs"]
mod mutated;
#[path = "../../core/tests/seeded/mod.rs"]
mod seeded;

/// How many executions there are between two looks at the clock.
const BLOCK: u64 = 256;

type Check = Box<dyn Fn(&[u8])>;

fn main() -> ExitCode {
    let mut arguments = env::args().skip(1);
    let seconds = arguments.next().and_then(|text| text.parse().ok()).map(Duration::from_secs);
    let targets: Vec<String> = arguments.collect();
    let (Some(time), false) = (seconds, targets.is_empty()) else {
        eprintln!("a number of seconds and one or more targets are needed: fuzz 60 message graph graph_gml");
        return ExitCode::from(2);
    };
    for target in &targets {
        let Some((folder, check)) = find(target) else {
            eprintln!(
                "no target is called `{target}`, allowed are message, link_message, scenario, robot, graph, recording"
            );
            eprintln!("and graph_FORMAT with the name of a format, such as graph_gml or graph_counted_edges");
            return ExitCode::from(2);
        };
        if !spend(target, folder, &check, time) {
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// The folder of a target in the corpus, and what must hold.
fn find(target: &str) -> Option<(&'static str, Check)> {
    let (folder, check): (_, fn(&[u8])) = match target {
        "message" => ("message", closeranks_checks::message),
        "link_message" => ("link_message", closeranks_checks::link_message),
        "scenario" => ("scenario", closeranks_checks::scenario),
        "robot" => ("robot", closeranks_checks::robot),
        "graph" => ("graph", closeranks_checks::graph),
        #[cfg(feature = "recording")]
        "recording" => ("recording", closeranks_checks::recording),
        _ => {
            let format = target.strip_prefix("graph_")?.replace('_', "-");
            closeranks_graph::formats::Format::from_name(&format)?;
            return Some(("graph", Box::new(move |bytes| closeranks_checks::graph_as(&format, bytes))));
        }
    };
    Some((folder, Box::new(check)))
}

/// Tries mutations for `time` and adds their number to the table. False if one of them broke the promise.
fn spend(target: &str, folder: &str, check: &Check, time: Duration) -> bool {
    let (files, before) = (corpus(folder), executions(target));
    let mut random = Seeded(before ^ 0x636c_6f73_6572_616e);
    #[expect(
        clippy::disallowed_methods,
        reason = "a time box needs a clock; what is tried does not depend on it"
    )]
    let start = Instant::now();
    let mut done = 0;
    while start.elapsed() < time {
        for _ in 0..BLOCK {
            let (origin, bytes) = mutated(&files, &mut random);
            if panic::catch_unwind(panic::AssertUnwindSafe(|| check(&bytes))).is_err() {
                eprintln!("{target} failed, from {}: {}", files[origin].0, bytes.escape_ascii());
                return false;
            }
        }
        done += BLOCK;
    }
    record(target, before + done);
    println!("{target}: {done} executions, {} in all", before + done);
    true
}

fn table() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/executions.txt")
}

/// The rows of the table: a target and its executions so far.
fn rows() -> Vec<(String, u64)> {
    let text = fs::read_to_string(table()).unwrap_or_default();
    let rows = text.lines().filter_map(|line| line.split_once(' '));
    rows.map(|(target, count)| (target.to_string(), count.trim().parse().expect("a number of executions")))
        .collect()
}

fn executions(target: &str) -> u64 {
    rows().iter().find(|row| row.0 == target).map_or(0, |row| row.1)
}

/// The table is read again here, so that runs of different targets at the same time do not undo each other's rows.
fn record(target: &str, count: u64) {
    let mut rows = rows();
    rows.retain(|row| row.0 != target);
    rows.push((target.to_string(), count));
    rows.sort();
    let lines = rows.iter().map(|(target, count)| format!("{target} {count}\n"));
    fs::write(table(), lines.collect::<String>()).expect("fuzz/executions.txt can be written");
}
