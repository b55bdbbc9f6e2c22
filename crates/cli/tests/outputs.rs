//! What is written where: nothing of others is lost, nothing half-written stays, and a failed write is an error.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn closeranks(folder: &Path, arguments: &str) -> Output {
    command(folder, arguments).output().unwrap()
}

fn command(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_closeranks"));
    command.current_dir(folder).args(arguments.split(' '));
    command
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// A folder with two scenarios of no length, `a.toml` and `b.toml`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a", "b"] {
        fs::write(folder.path().join(format!("{name}.toml")), format!("name = \"{name}\"\nduration_s = 0\n"))
            .unwrap();
    }
    folder
}

#[track_caller]
fn written(folder: &Path, arguments: &str) {
    let output = closeranks(folder, arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
}

#[track_caller]
fn refused(folder: &Path, arguments: &str, message: &str) {
    let output = closeranks(folder, arguments);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains(message), "{}", text(&output.stderr));
}

/// A table that went to a full disk used to end with exit code 0.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_and_a_closed_pipe_is_not() {
    let folder = folder();
    for arguments in ["run a.toml", "run a.toml --json", "graph ring 9", "--help", "run --help", "--version"]
    {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = command(folder.path(), arguments).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        let told = text(&output.stderr);
        assert!(told.starts_with("error: cannot write to standard output: "), "{arguments}: {told}");
        let mut child =
            command(folder.path(), arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()), "{arguments}");
    }
}

/// `run b.toml -o out` used to replace what `run a.toml -o out` had written.
#[test]
fn only_the_same_command_replaces_its_output() {
    let folder = folder();
    let here = folder.path();
    for _ in 0..2 {
        written(here, "run a.toml -o out -q");
    }
    written(here, "run ./a.toml -q --output out");
    for other in ["run b.toml -o out", "run a.toml --seed 2 -o out", "compare a.toml -o out"] {
        refused(here, other, "`out` holds what `closeranks run ");
        refused(here, other, "allowed is a new name, or --overwrite to replace it");
    }
    let page = |word: &str| fs::read_to_string(here.join("out/report.html")).unwrap().contains(word);
    assert!(page("name = &quot;a&quot;"));
    written(here, "run b.toml -o out -q --overwrite");
    assert!(page("name = &quot;b&quot;"));
    fs::write(here.join("out/notes.txt"), "keep").unwrap();
    refused(here, "run b.toml -o out --overwrite", "`out` holds `notes.txt`, which closeranks did not write");
    fs::create_dir(here.join("old")).unwrap();
    fs::write(here.join("old/.closeranks"), "report.html").unwrap();
    refused(here, "run b.toml -o old", "`old` holds what an earlier version of closeranks wrote");
}

/// Folders of a killed run used to stay for ever, and between two renames the results of the run before were away.
#[test]
fn what_a_killed_run_left_is_cleaned_up_by_the_next() {
    let folder = folder();
    let here = folder.path();
    written(here, "run a.toml -o out -q");
    let before = fs::read(here.join("out/run.parquet")).unwrap();
    // As a kill would leave it: one folder half written, the old one moved away, the new one not yet in place.
    fs::create_dir(here.join(".closeranks-new-AbCd12-out")).unwrap();
    fs::write(here.join(".closeranks-new-AbCd12-out/report.html"), "half").unwrap();
    fs::create_dir(here.join(".closeranks-old-x1Y2z3-out")).unwrap();
    fs::rename(here.join("out"), here.join(".closeranks-old-x1Y2z3-out/folder")).unwrap();
    fs::create_dir(here.join(".closeranks-new-AbCd12-other-out")).unwrap();
    refused(here, "run b.toml -o out", "`out` holds what `closeranks run ");
    assert_eq!(fs::read(here.join("out/run.parquet")).unwrap(), before, "what was there is back");
    written(here, "run a.toml -o out -q");
    let mut names: Vec<_> =
        fs::read_dir(here).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(
        names,
        [".closeranks-new-AbCd12-other-out", "a.toml", "b.toml", "out"],
        "that of another target stays"
    );
}

/// `-o results/today/a` used to be refused as if `results/today` were a file.
#[test]
fn folders_above_are_made() {
    let folder = folder();
    written(folder.path(), "run a.toml -q -o results/today/a");
    assert!(folder.path().join("results/today/a/report.html").is_file());
    written(folder.path(), "sweep a.toml --runs 1 -q -o sweeps/today/a");
    refused(folder.path(), "run a.toml -o a.toml/below", "cannot be an output folder: `a.toml` is a file");
    refused(folder.path(), "run a.toml -o a.toml", "`a.toml` is a file, not a folder");
}

/// Where nothing can be written, a long run used to end with that message instead of beginning with it.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_written_is_refused_before_the_run() {
    let folder = folder();
    let output = closeranks(folder.path(), "run a.toml -o /proc/none/a");
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    assert!(text(&output.stderr).starts_with("error: cannot write to the folder `/proc`: "));
}

/// A link to a folder used to be called "not a folder".
#[cfg(unix)]
#[test]
fn links_are_followed() {
    let folder = folder();
    let here = folder.path();
    let link = |to: &str, name: &str| std::os::unix::fs::symlink(to, here.join(name)).unwrap();
    fs::create_dir(here.join("disk")).unwrap();
    link("disk", "out");
    for _ in 0..2 {
        written(here, "run a.toml -q -o out");
    }
    assert!(here.join("out").is_symlink() && here.join("disk/report.html").is_file());
    link("nowhere", "dangling");
    link("a.toml", "file");
    refused(
        here,
        "run a.toml -o dangling",
        "`dangling` is a link to `nowhere`, which is not there, not a folder",
    );
    refused(here, "run a.toml -o file", "`file` is a link to the file `a.toml`, not a folder");
}

/// `compare` used to exit with 0 whatever it printed as BROKEN.
#[test]
fn compare_fails_when_a_law_that_was_expected_is_broken() {
    let folder = tempfile::tempdir().unwrap();
    let compare = |file: &str| {
        fs::write(folder.path().join("a.toml"), file).unwrap();
        closeranks(folder.path(), "compare a.toml --controllers budget,none")
    };
    let broken = compare("duration_s = 2\n");
    assert!(text(&broken.stdout).contains("degree: BROKEN"));
    assert_eq!(broken.status.code(), Some(1));
    let expected = compare("duration_s = 2\nexpect = [\"input\"]\n");
    assert!(!text(&expected.stdout).contains("BROKEN"), "{}", text(&expected.stdout));
    assert_eq!(expected.status.code(), Some(0));
}

/// `time_s` used to be simulated time in one place and wall time in another.
#[test]
fn simulated_and_wall_time_have_names_of_their_own() {
    let folder = folder();
    let output = closeranks(folder.path(), "run a.toml --json");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(json["time_s"].is_null() && json["wall_time_s"].as_f64().unwrap() > 0.0);
    assert_eq!(json["duration_s"], 0.0);
}
