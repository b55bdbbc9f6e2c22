//! A time box of trying, and `fuzz/executions.txt`, which counts what was tried. Programs alone use it: it needs a clock.

use core::time::Duration;
use std::path::PathBuf;
use std::time::Instant;
use std::{env, fs, panic};

use crate::mutated::mutated;
use crate::seeded::Seeded;

/// How many executions there are between two looks at the clock.
const BLOCK: u64 = 256;

/// The seconds and the targets that a command line names.
pub(crate) fn arguments() -> Option<(Duration, Vec<String>)> {
    let mut arguments = env::args().skip(1);
    let seconds = arguments.next()?.parse().ok().map(Duration::from_secs)?;
    let targets: Vec<String> = arguments.collect();
    (!targets.is_empty()).then_some((seconds, targets))
}

/// Checks changed copies of `files` for this time, and counts them; false, and the bytes on the terminal, if one fails. The random
/// numbers of a run begin with the executions so far, so no run repeats another one.
#[expect(
    clippy::disallowed_methods,
    reason = "a time box needs a clock; what is tried does not depend on it"
)]
pub(crate) fn spend(
    target: &str,
    files: &[(String, Vec<u8>)],
    check: &dyn Fn(&[u8]),
    time: Duration,
) -> bool {
    let before = executions(target);
    let mut random = Seeded(before ^ 0x636c_6f73_6572_616e);
    let (start, mut done) = (Instant::now(), 0);
    while start.elapsed() < time {
        for _ in 0..BLOCK {
            let (origin, bytes) = mutated(files, &mut random);
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
