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

/// Eleven processes, two liars with two faces, a bad network, a kill with a return, a router that restarts, and garbage.
const CHAOS: &str = "name = 'chaos'\nduration_s = 12.0\n[team]\nrobots = 11\nfaults = 2\nmalicious = [1, 2]\n\
    [controller]\nkind = 'budget'\n[clock]\ntau_1_s = 0.2\ntau_2_s = 0.8\ntold_max_s = 2.0\n\
    [attack]\nlevel = { kind = 'faces', min = -20.0, max = 20.0 }\nvalue = { kind = 'faces', min = -500.0, max = 500.0 }\n\
    [network]\nloss = 0.3\ndelay_max_s = 0.2\nduplicate = 0.1\n\
    [fleet]\nrestart_router_s = [7.0]\ngarbage_per_s = 50.0\n\
    [[fleet.kill]]\nrobot = 4\nat_s = 3.0\nback_s = 5.0\n";

#[test]
fn a_fleet_holds_among_liars_losses_kills_and_garbage() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("chaos.toml"), CHAOS).unwrap();
    let output = node(folder.path(), &["fleet", "chaos.toml", "--json", "--out", "kept"]);
    let (said, wrong) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{said}\n{wrong}");
    let verdict: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!(verdict["violations"].as_array().map(Vec::len), Some(0));
    assert_eq!((verdict["died"].as_u64(), verdict["ticks"].as_u64()), (Some(0), Some(59)));
    assert!(verdict["injected"].as_u64().unwrap() > 0);
    // Who has two faces is caught, whatever the timing: every message of both is told in ten versions.
    assert_eq!(verdict["two_faced"], serde_json::json!([1, 2]), "{said}");
    for liar in [1, 2] {
        let proofs = (3..=11).map(|robot| format!("kept/proofs/robot_{robot}/robot-{liar}.proof"));
        let proof = proofs.into_iter().find(|path| folder.path().join(path).exists()).unwrap();
        let output = node(folder.path(), &["verify-proof", &proof, "--roster", "kept/roster.toml"]);
        assert_eq!(output.status.code(), Some(0));
        assert!(text(&output.stdout).starts_with(&format!("robot {liar} (robot_{liar}) signed two")));
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
