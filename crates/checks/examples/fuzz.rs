//! Looks for bytes that break a promise, for as long as one has, and counts what was tried in `fuzz/executions.txt`.
//!
//! ```text
//! cargo run --release -p closeranks-checks --example fuzz -- 60 message link_message
//! ```
//!
//! The time in seconds is for each target. The random numbers of a run begin with the executions so far, so no run repeats
//! another one. Unlike cargo-fuzz it does not see which code was reached; it needs no nightly toolchain and is fast.

#![allow(clippy::print_stdout, reason = "a program for a terminal")]

use std::process::ExitCode;

use mutated::corpus;
use spend::{arguments, spend};

#[path = "../tests/mutated/mod.rs"]
mod mutated;
#[path = "../../core/tests/seeded/mod.rs"]
mod seeded;
#[path = "../tests/mutated/spend.rs"]
mod spend;

type Check = Box<dyn Fn(&[u8])>;

fn main() -> ExitCode {
    let Some((time, targets)) = arguments() else {
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
        if !spend(target, &corpus(folder), &*check, time) {
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
