//! Shards of a sweep: what is open in their folders, which one a task of an array is, and all of them put together.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

/// Small runs of both controllers.
const FILE: &str = "duration_s = 0.2\n[sweep]\ncontrollers = [\"composed\", \"budget\"]\n[team]\nrobots = { draw = [4, 6] }\n\
    faults = { draw = [0, 2] }\n";

fn folder(file: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("many.toml"), file).unwrap();
    folder
}

fn closeranks(folder: &Path, words: &str) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_closeranks"));
    program.current_dir(folder).args(words.split(' ')).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Runs a sweep of many.toml into `out`, with the words of `more`.
#[track_caller]
fn swept(folder: &Path, out: &str, more: &str) -> String {
    let output = closeranks(folder, &format!("sweep many.toml -o {out} {more}"));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

#[track_caller]
fn refused(output: &Output, message: &str) {
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains(message), "{}", text(&output.stderr));
}

#[test]
fn shards_are_merged_to_the_bytes_of_the_whole() {
    let folder = folder(FILE);
    swept(folder.path(), "whole", "--runs 300 -q");
    let at = |name: &str| folder.path().join(name);
    for index in 1..=3 {
        swept(folder.path(), &format!("part{index}"), &format!("--runs 300 --shard {index}/3 -q"));
    }
    let merge = |words: &str| closeranks(folder.path(), &format!("sweep merge {words}"));
    refused(
        &merge("part1 part3 -o out"),
        "1 of 3 shards are not finished: 2; allowed is the folders of all shards",
    );
    refused(&merge("part1 part2 part1 -o out"), "`part1` and `part1` are both shard 1/3");
    assert!(!at("out").exists());
    let merged = merge("part3 part1 part2 -o out");
    assert_eq!(merged.status.code(), Some(0), "{}", text(&merged.stderr));
    assert!(text(&merged.stdout).starts_with("300 runs, seed 1; "), "{}", text(&merged.stdout));
    for name in ["runs.parquet", "laws.svg", "gyration.svg"] {
        assert_eq!(
            fs::read(at("out").join(name)).unwrap(),
            fs::read(at("whole").join(name)).unwrap(),
            "{name}"
        );
    }
    assert!(swept(folder.path(), "out", "--runs 300").starts_with("this sweep was finished before in out\n"));
    // Rows that are not those of the shard are found, whatever the file says about itself.
    let rows = |part: u64| at(&format!("part{part}")).join(format!("runs-{part}-of-3.parquet"));
    fs::copy(rows(1), rows(2)).unwrap();
    refused(&merge("part1 part2 part3 -o again"), "1 of 3 shards are not finished: 2");
    fs::write(rows(2), b"PAR1").unwrap();
    refused(&merge("part1 part2 part3 -o again"), "1 of 3 shards are not finished: 2");
    refused(&merge("part1 many.toml -o again"), "`many.toml` holds no sweep");
}

#[test]
fn the_status_of_folders_says_what_to_submit_again() {
    let folder = folder(FILE);
    let status = |words: &str| closeranks(folder.path(), &format!("sweep --status {words}"));
    for index in [1, 4] {
        swept(folder.path(), &format!("part{index}"), &format!("--runs 100 --shard {index}/6 -q"));
    }
    swept(folder.path(), "part2", "--runs 100 --shard 2/6 -q");
    fs::remove_file(folder.path().join("part2/runs-2-of-6.parquet")).unwrap();
    let said = status("part1 part2 part4");
    assert_eq!(said.status.code(), Some(1), "{}", text(&said.stderr));
    let words = text(&said.stdout);
    assert!(words.ends_with("2 of 6 shards are finished\nopen: 2-3,5-6\n"), "{words}");
    let line = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.lines().any(|found| line(found) == "part2 2/6 17 0 of 17 open"), "{words}");
    let lock = File::open(folder.path().join("part2/sweep.lock")).unwrap();
    lock.lock().unwrap();
    let words = text(&status("part1 part2 part4").stdout);
    assert!(words.ends_with("at work: 2\nopen: 3,5-6\n"), "{words}");
    drop(lock);
    let json: Value = serde_json::from_slice(&status("part1 part4 --json").stdout).unwrap();
    assert_eq!(json["open"], serde_json::json!([2, 3, 5, 6]));
    assert_eq!(json["folders"][1]["is"], "finished");
    refused(&status("part1 nowhere"), "`nowhere` holds no sweep");
    refused(&status("part1 part1"), "are both shard 1/6");
    refused(&closeranks(folder.path(), "sweep many.toml --status part1"), "cannot be used with");
    refused(&closeranks(folder.path(), "sweep"), "required arguments were not provided");
    refused(&closeranks(folder.path(), "sweep many.toml"), "--output <DIR>");
}

/// The variables that the scheduler sets decide; nothing else of the command does.
#[test]
fn the_shard_of_an_array_is_what_the_scheduler_says() {
    let folder = folder(FILE);
    let task = |variables: &[(&str, &str)]| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_closeranks"));
        program.current_dir(folder.path()).args([
            "sweep",
            "many.toml",
            "--runs",
            "9",
            "--shard",
            "auto",
            "-q",
        ]);
        program.args(["-o", "task"]).envs(variables.iter().copied()).output().unwrap()
    };
    refused(&task(&[]), "this is no task of an array");
    refused(&task(&[("AWS_BATCH_JOB_ARRAY_INDEX", "3")]), "CLOSERANKS_SHARDS to the number of tasks");
    let done = task(&[("AWS_BATCH_JOB_ARRAY_INDEX", "3"), ("AWS_BATCH_JOB_ARRAY_SIZE", "4")]);
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    assert!(folder.path().join("task/runs-4-of-4.parquet").is_file());
}
