//! `--record FILE.mcap` as its user meets it: what it refuses, what it replaces, and what lies where. What is in the files is compared by
//! readers of others (`./ci.sh recordings`).
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn closeranks(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_closeranks"));
    command.current_dir(folder).args(arguments.split(' ')).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// A folder with two short scenarios.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.toml"), "duration_s = 0.05\n").unwrap();
    fs::write(folder.path().join("b.toml"), "duration_s = 0.05\nseed = 5\n").unwrap();
    folder
}

#[track_caller]
fn written(folder: &Path, arguments: &str) -> String {
    let output = closeranks(folder, arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

#[track_caller]
fn refused(folder: &Path, arguments: &str, message: &str) {
    let output = closeranks(folder, arguments);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains(message), "{said}");
}

/// Whole files of MCAP begin and end with the same eight bytes.
#[track_caller]
fn is_whole(file: &Path) {
    let bytes = fs::read(file).unwrap();
    assert!(bytes.starts_with(b"\x89MCAP0\r\n") && bytes.ends_with(b"\x89MCAP0\r\n"), "{}", file.display());
}

#[test]
fn the_same_run_gives_the_same_bytes_and_another_does_not() {
    let folder = folder();
    let here = folder.path();
    assert!(written(here, "run a.toml --record new/a.mcap").contains("recorded in new/a.mcap"));
    let first = fs::read(here.join("new/a.mcap")).unwrap();
    is_whole(&here.join("new/a.mcap"));
    written(here, "run a.toml -q --record new/a.mcap");
    assert!(first == fs::read(here.join("new/a.mcap")).unwrap());
    written(here, "run a.toml -q --record other.mcap -o out");
    assert!(first == fs::read(here.join("other.mcap")).unwrap(), "what else is written changes nothing");
    written(here, "run a.toml -q --seed 5 --record five.mcap");
    assert!(first != fs::read(here.join("five.mcap")).unwrap());
    let left = fs::read_dir(here)
        .unwrap()
        .filter(|entry| entry.as_ref().unwrap().file_name().to_str().unwrap().starts_with(".closeranks"));
    assert_eq!(left.count(), 0, "nothing is left beside");
}

#[test]
fn what_cannot_be_a_recording_is_refused_before_the_run() {
    let folder = folder();
    let here = folder.path();
    for name in ["a.bag", "a", "a.MCAP", "a.mcap.txt"] {
        let message = format!("`{name}` cannot be a recording: allowed is a name that ends in .mcap");
        refused(here, &format!("run a.toml --record {name}"), &message);
    }
    fs::create_dir(here.join("folder.mcap")).unwrap();
    refused(here, "run a.toml --record folder.mcap", "`folder.mcap` is no file");
    refused(here, "run a.toml --record a.toml/x.mcap", "cannot write `a.toml/x.mcap`");
    fs::write(
        here.join("big.toml"),
        "duration_s = 0\n[team]\nrobots = 201\n[start]\nkind = \"random\"\nhalf_side_m = 20.0\n",
    )
    .unwrap();
    let message = "`team.robots` is 201, allowed with --record is at most 200";
    refused(here, "run big.toml --record big.mcap", message);
    assert!(!here.join("big.mcap").exists());
}

#[test]
fn nothing_of_others_is_replaced() {
    let folder = folder();
    let here = folder.path();
    for theirs in
        [&b""[..], b"mine", b"\x89MCAP0\r\n", b"\x89MCAP0\r\n\x01\x08\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"]
    {
        fs::write(here.join("x.mcap"), theirs).unwrap();
        refused(here, "run a.toml --record x.mcap", "`x.mcap` is there and closeranks did not write it");
        refused(here, "run a.toml --record x.mcap --overwrite", "closeranks did not write it");
        assert_eq!(fs::read(here.join("x.mcap")).unwrap(), theirs);
    }
    written(here, "run a.toml -q --record a.mcap");
    let ours = fs::read(here.join("a.mcap")).unwrap();
    refused(here, "run b.toml --record a.mcap", "a.toml` wrote; allowed is a new name, or --overwrite");
    assert!(ours == fs::read(here.join("a.mcap")).unwrap());
    written(here, "run b.toml -q --record a.mcap --overwrite");
    assert!(ours != fs::read(here.join("a.mcap")).unwrap());
}

#[cfg(unix)]
#[test]
fn links_lead_to_the_file_that_is_replaced() {
    let folder = folder();
    let here = folder.path();
    std::os::unix::fs::symlink("nowhere.mcap", here.join("dangling.mcap")).unwrap();
    refused(here, "run a.toml --record dangling.mcap", "`dangling.mcap` is a link to what is not there");
    written(here, "run a.toml -q --record a.mcap");
    std::os::unix::fs::symlink("a.mcap", here.join("link.mcap")).unwrap();
    written(here, "run a.toml -q --record link.mcap");
    assert!(here.join("link.mcap").is_symlink());
    is_whole(&here.join("a.mcap"));
}

#[test]
fn commands_with_several_runs_record_each() {
    let folder = folder();
    let here = folder.path();
    let said = written(here, "compare a.toml --controllers budget,none --record c.mcap");
    assert!(said.contains("recorded in c-budget.mcap, c-none.mcap"), "{said}");
    is_whole(&here.join("c-budget.mcap"));
    is_whole(&here.join("c-none.mcap"));
    fs::write(here.join("d-none.mcap"), "mine").unwrap();
    refused(here, "compare a.toml --controllers budget,none --record d.mcap", "`d-none.mcap` is there");
    assert!(!here.join("d-budget.mcap").exists(), "all are looked at before one is begun");
    fs::write(here.join("p-inside-nominal.mcap"), "mine").unwrap();
    refused(here, "paper -o out --record p.mcap", "`p-inside-nominal.mcap` is there");
    assert!(!here.join("p-published-nominal.mcap").exists());
}
