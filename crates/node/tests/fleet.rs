//! The program as its user runs it: a short fleet with everything that can go wrong, and bad input.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn node(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_closeranks-node")).args(arguments).current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Eleven processes, two liars of which one has a face for everybody, a bad network, a kill with a return, a router that restarts, and garbage.
const CHAOS: &str = include_str!("../../../scenarios/chaos.toml");

#[test]
fn a_fleet_holds_among_liars_losses_kills_and_garbage() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("chaos.toml"), CHAOS).unwrap();
    let output =
        node(folder.path(), &["fleet", "chaos.toml", "--json", "--out", "kept", "--record", "chaos.mcap"]);
    let (said, wrong) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{said}\n{wrong}");
    let verdict: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!(verdict["violations"].as_array().map(Vec::len), Some(0));
    assert_eq!((verdict["died"].as_u64(), verdict["ticks"].as_u64()), (Some(0), Some(59)));
    assert!(verdict["injected"].as_u64().unwrap() > 0);
    // Who has two faces is caught, whatever the timing: every message of it is told in ten versions. Who tells all the same is not.
    assert_eq!(verdict["two_faced"], serde_json::json!([1]), "{said}");
    let proofs = (3..=11).map(|robot| format!("kept/proofs/robot_{robot}/robot-1.proof"));
    let proof = proofs.into_iter().find(|path| folder.path().join(path).exists()).unwrap();
    let output = node(folder.path(), &["verify-proof", &proof, "--roster", "kept/roster.toml"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(text(&output.stdout).starts_with("robot 1 (robot_1) signed two"));
    // Memory is flat: 16 MB are far more than a run may add to what a process begins with.
    let [begin, end] = [0, 1].map(|place| verdict["memory_kb"][place].as_u64().unwrap());
    assert!(end < begin + 16_000, "{said}");
    let recorded = closeranks_mcap::read(&fs::read(folder.path().join("chaos.mcap")).unwrap()).unwrap();
    assert_eq!((recorded.robots, recorded.ticks.len()), (11, 60));
    let again = node(folder.path(), &["fleet", "chaos.toml", "--record", "chaos.mcap"]);
    assert!(text(&again.stderr).contains("--record is chaos.mcap, allowed is a new file"));
}

/// What `closeranks view --live` reads: the scenario, and a line a tick.
#[test]
fn a_fleet_tells_its_moments_while_it_runs() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = "duration_s = 2.0\n[team]\nrobots = 4\nfaults = 0\nmalicious = []\n[start]\nkind = 'hexagon'\n\
        [controller]\nkind = 'links'\n[clock]\ntau_1_s = 0.2\ntau_2_s = 0.8\n";
    fs::write(folder.path().join("small.toml"), scenario).unwrap();
    let output = node(folder.path(), &["fleet", "small.toml", "--moments"]);
    let wrong = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{wrong}");
    assert!(wrong.contains("it held"));
    let said = text(&output.stdout);
    let lines: Vec<serde_json::Value> =
        said.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((lines[0]["scenario"].as_str(), lines.len()), (Some(scenario), 11));
    for (tick, line) in lines[1..].iter().enumerate() {
        assert_eq!(line["tick"].as_u64(), u64::try_from(tick).ok());
        for column in closeranks_mcap::history::COLUMNS {
            assert_eq!(line[column].as_array().map(Vec::len), Some(4), "{column}");
        }
    }
}

#[test]
fn a_roster_is_made_completed_signed_and_shown() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("team.toml"), "[team]\nrobots = 2\nfaults = 0\n[controller]\nkind = 'budget'\n")
        .unwrap();
    let good = |arguments: &[&str]| {
        let output = node(at, arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", text(&output.stderr));
        text(&output.stdout)
    };
    let bad = |arguments: &[&str]| {
        let output = node(at, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        text(&output.stderr)
    };
    good(&["roster", "new", "team", "--parameters", "team.toml"]);
    assert!(bad(&["roster", "new", "team", "--parameters", "team.toml"]).contains("is there already"));
    good(&["roster", "add", "team", "robot_1"]);
    assert!(bad(&["roster", "sign", "team"]).contains("the roster has 1 robots, `team.robots` says 2"));
    let public = good(&["key", "own.key"]);
    good(&["roster", "add", "team", "robot_2", "--key", public.trim()]);
    good(&["roster", "add", "team", "plant"]);
    assert!(good(&["roster", "show", "team/roster.toml"]).contains("NOT GOOD: the roster is not signed"));
    good(&["roster", "sign", "team"]);
    let shown = good(&["roster", "show", "team/roster.toml"]);
    assert!(shown.contains("signature fits") && shown.contains("robot   2 robot_2"));
    let secret = fs::read_to_string(at.join("own.key")).unwrap();
    let secret = secret.trim().rsplit(' ').next().unwrap();
    assert!(!shown.contains(secret), "a private key is never shown");
}

#[test]
fn bad_input_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let bad = |arguments: &[&str]| {
        let output = node(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        text(&output.stderr)
    };
    assert!(bad(&["run", "--config", "none.toml"]).contains("none.toml: No such file"));
    fs::write(folder.path().join("f.toml"), "[fleet]\nkil = 3\n").unwrap();
    assert!(bad(&["fleet", "f.toml"]).contains("f.toml:2: unknown field `kil`"));
    assert!(
        bad(&["fleet", "f.toml", "--duration", "0"]).contains("--duration is 0, allowed is 0.1 to 86400 s")
    );
    fs::write(folder.path().join("junk"), "junk").unwrap();
    assert!(bad(&["verify-proof", "junk", "--roster", "none.toml"]).contains("none.toml"));
}
