//! Messages: true, and of help.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::process::Command;

/// Runs the words of `arguments` beside an empty scenario `a.toml` and gives what is said on standard error.
#[track_caller]
fn refused(arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.toml"), "duration_s = 0\n").unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_closeranks"));
    let output = command.current_dir(folder.path()).args(arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    String::from_utf8(output.stderr).unwrap()
}

/// A negative seed used to be an "unexpected argument", and the command line took seeds that a file does not take.
#[test]
fn seeds_have_one_range_everywhere() {
    let commands: [&[&str]; 5] = [
        &["run", "a.toml", "--seed"],
        &["compare", "a.toml", "--seed"],
        &["paper", "--seed"],
        &["sweep", "a.toml", "-o", "out", "--seed"],
        &["graph", "regular", "12", "5", "--seed"],
    ];
    for command in commands {
        for seed in ["-1", "9223372036854775808", "1.5", "x"] {
            let told = refused(&[command, &[seed]].concat());
            let expected = format!("invalid value '{seed}' for '--seed ");
            assert!(told.contains(&expected), "{told}");
            assert!(told.contains("allowed is a whole number, 0 to 9223372036854775807"), "{told}");
        }
    }
}

/// The name of a file used to reach the terminal as it was: it could change colours and move the cursor.
#[test]
fn control_characters_are_shown_as_escapes() {
    let told = refused(&["run", "\u{1b}[31mred.toml"]);
    assert!(told.starts_with("error: cannot read the scenario `\\u{1b}[31mred.toml`"), "{told:?}");
}
