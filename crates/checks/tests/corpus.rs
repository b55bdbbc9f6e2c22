//! Every check on the saved corpus and on some thousands of mutations of it, the same in every run.

use std::fs;
use std::panic::catch_unwind;
use std::path::Path;

use seeded::Seeded;

#[path = "../../core/tests/seeded/mod.rs"]
mod seeded;

/// A check of `closeranks_checks`.
type Check = fn(&[u8]);

/// The files of `fuzz/corpus/<target>` in order of their names.
fn corpus(target: &str) -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target);
    let mut paths: Vec<_> =
        fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    assert!(paths.len() >= 5, "{} is no corpus", folder.display());
    paths.into_iter().map(|path| (path.display().to_string(), fs::read(path).expect("a file"))).collect()
}

/// The bytes are in the message: put them into a file of the corpus when the bug is gone.
fn hold(check: Check, bytes: &[u8], origin: &str) {
    assert!(catch_unwind(|| check(bytes)).is_ok(), "from {origin}: {}", bytes.escape_ascii());
}

fn replay(target: &str, check: Check, mutations: usize) {
    let files = corpus(target);
    for (name, bytes) in &files {
        hold(check, bytes, name);
    }
    let mut random = Seeded(1);
    for _ in 0..mutations {
        let (name, bytes) = &files[random.below(files.len())];
        let mut bytes = bytes.clone();
        for _ in 0..=random.below(4) {
            mutate(&mut bytes, &files[random.below(files.len())].1, &mut random);
        }
        hold(check, &bytes, name);
    }
}

/// One change as fuzzers make them; `donor` is another file of the corpus.
fn mutate(bytes: &mut Vec<u8>, donor: &[u8], random: &mut Seeded) {
    let byte = u8::try_from(random.below(256)).unwrap_or(0);
    let (place, length) = (random.below(bytes.len() + 1), 1 + random.below(8));
    let end = (place + length).min(bytes.len());
    match random.below(7) {
        0 => bytes.truncate(place),
        1 => drop(bytes.drain(place..end)),
        2 => bytes.insert(place, byte),
        3 => bytes[place..end].fill(byte),
        4 => bytes.extend_from_within(place..end),
        5 => {
            let start = random.below(donor.len() + 1);
            let piece = donor[start..(start + 4 * length).min(donor.len())].to_vec();
            drop(bytes.splice(place..place, piece));
        }
        _ => bytes[place..end].iter_mut().for_each(|old| *old ^= 1 << (byte & 7)),
    }
}

#[test]
fn any_bytes_are_a_message_or_an_error() {
    replay("message", closeranks_checks::message, 20_000);
}

#[test]
fn any_bytes_are_a_message_of_lists_or_an_error() {
    replay("link_message", closeranks_checks::link_message, 20_000);
}

#[test]
fn any_text_is_a_scenario_that_runs_or_an_error() {
    replay("scenario", closeranks_checks::scenario, 2_000);
}

#[test]
fn any_text_is_a_graph_that_can_be_rewritten_or_an_error() {
    replay("graph", closeranks_checks::graph, 2_000);
}

#[test]
fn any_calls_of_a_robot_give_a_safe_answer() {
    replay("robot", closeranks_checks::robot, 5_000);
}

#[cfg(feature = "recording")]
#[test]
fn any_bytes_are_a_recording_or_an_error() {
    replay("recording", closeranks_checks::recording, 5_000);
}
