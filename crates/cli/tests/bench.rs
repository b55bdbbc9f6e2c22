//! `closeranks bench`, as its user runs it.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::process::{Command, Output};

use serde_json::Value;

fn bench(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_closeranks")).arg("bench").args(arguments).output().unwrap()
}

/// Scores are the same on every machine and for every number of threads, and who breaks something gets nothing for it.
#[test]
fn scores_are_the_same_in_every_run_and_breaking_something_does_not_pay() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let arguments = ["--controllers", "links,none", "--runs", "1", "--json"];
    let first = bench(&[&arguments[..], &["-o", out.to_str().unwrap()]].concat());
    assert!(first.status.success(), "{}", String::from_utf8_lossy(&first.stderr));
    let numbers: Value = serde_json::from_slice(&first.stdout).unwrap();
    assert_eq!(numbers["bench"], 2);
    for case in ["task", "slow", "lossy", "faces", "noise", "lag", "crowd"] {
        let [links, none] = ["links", "none"].map(|name| &numbers["controllers"][name][case]);
        assert!(links["width_m"].as_f64().unwrap() > 1.5 && links["kept"] == 1, "{case}: {links}");
        assert!(none["width_m"].as_f64().unwrap() == 0.0 && none["kept"] == 0, "{case}: {none}");
    }
    let agreed = |rule: &str| numbers["rules"][rule]["extreme"]["agreed"].as_u64().unwrap();
    assert_eq!([agreed("w-msr"), agreed("linear")], [1, 0]);
    let again = Command::new(env!("CARGO_BIN_EXE_closeranks"))
        .env("RAYON_NUM_THREADS", "1")
        .arg("bench")
        .args(arguments)
        .output()
        .unwrap();
    assert_eq!(first.stdout, again.stdout);
    assert_eq!(fs::read(out.join("bench.json")).unwrap(), first.stdout);
    assert!(fs::read(out.join("bench.parquet")).unwrap().starts_with(b"PAR1"));
}

#[test]
fn a_controller_that_is_not_there_is_refused_with_the_choices() {
    let refused = bench(&["--controllers", "brakes"]);
    let said = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2));
    assert!(said.contains("brakes") && said.contains("fixed-topology"), "{said}");
    assert_eq!(bench(&["--runs", "0"]).status.code(), Some(2));
}
