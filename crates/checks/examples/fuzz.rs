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
type Files = Vec<(String, Vec<u8>)>;

fn main() -> ExitCode {
    let Some((time, targets)) = arguments() else {
        eprintln!("a number of seconds and one or more targets are needed: fuzz 60 message graph graph_gml");
        return ExitCode::from(2);
    };
    for target in &targets {
        let Some((files, check)) = find(target) else {
            eprintln!(
                "no target is called `{target}`, allowed are message, link_message, robot, scenario, scenario_text, recording,"
            );
            eprintln!(
                "graph, graph_text, certificate_CLAIM with the claim of a certificate, such as certificate_robust_by_search,"
            );
            eprintln!("and graph_FORMAT with the name of a format, such as graph_gml or graph_counted_edges");
            return ExitCode::from(2);
        };
        if !spend(target, &files, &*check, time) {
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// The files that a target begins with, and what must hold.
fn find(target: &str) -> Option<(Files, Check)> {
    if let Some(claim) = target.strip_prefix("certificate_") {
        let files = of_claim(&claim.replace('_', "-"));
        return (!files.is_empty()).then_some((files, Box::new(closeranks_checks::certificate)));
    }
    let (folder, check) = of_folder(target)?;
    Some((corpus(folder), check))
}

/// The certificates of one claim.
fn of_claim(claim: &str) -> Files {
    let claims = |bytes: &[u8]| {
        String::from_utf8_lossy(bytes).lines().any(|line| line.split(' ').next() == Some(claim))
    };
    corpus("certificate").into_iter().filter(|(_, bytes)| claims(bytes)).collect()
}

/// The folder of a target in the corpus, and what must hold.
fn of_folder(target: &str) -> Option<(&'static str, Check)> {
    let (folder, check): (_, fn(&[u8])) = match target {
        "message" => ("message", closeranks_checks::message),
        "link_message" => ("link_message", closeranks_checks::link_message),
        "scenario" => ("scenario", closeranks_checks::scenario),
        "scenario_text" => ("scenario", closeranks_checks::scenario_text),
        "robot" => ("robot", closeranks_checks::robot),
        "graph" => ("graph", closeranks_checks::graph),
        "graph_text" => ("graph", closeranks_checks::graph_text),
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
