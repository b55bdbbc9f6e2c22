//! The oracle bites: controllers with one line broken are caught by the campaign, each by the law that is there for it.
//!
//! Every mutant is the real source with a line replaced, built beside the target folder, and let run on
//! `scenarios/campaign.toml` (`examples/hunt.rs`). A line that is no longer there fails the test, so that mutants keep up
//! with the code.
//!
//! It takes minutes, because it builds some twenty programs, each from what it shares with the one before. By itself:
//!
//! ```sh
//! cargo test -p closeranks-sim --test oracle -- --nocapture                        # says who is found when
//! MUTANT="near rows" cargo test -p closeranks-sim --test oracle -- --nocapture     # some of them
//! ```
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod mutants;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use mutants::cuts::CUTS as WHERE_LINKS_ARE_CUT;
use mutants::obstacles::OBSTACLES as AMONG_OBSTACLES;
use mutants::presence::PRESENCE as COMING_AND_GOING;
use mutants::teams::TEAMS as BESIDE_OTHERS;
use mutants::{MUTANTS, Mutant};

/// Runs that a mutant may survive.
const RUNS: &str = "2000";
/// Runs of the controller as it is, in which there must be nothing; `ci.sh` makes many more. Mutants are found sooner, as a rule.
const INTACT: &str = "500";
const SEED: &str = "7";
/// So many programs are built at a time, as most of a build of one changed line waits for one thread. At least two: the
/// controller as it is has a campaign in each.
const LANES: usize = 2;
/// Where mutants are hunted; those of ranks in teams that have ranks, those of obstacles among obstacles, those of cuts where obstacles cut
/// links, those of robots that come and go where they do, and those of several teams where there are several.
const CAMPAIGN: &str = "campaign.toml";
const RANKED: &str = "campaign-ranks.toml";
const OBSTACLES: &str = "campaign-obstacles.toml";
const CUTS: &str = "campaign-cuts.toml";
const PRESENCE: &str = "campaign-presence.toml";
const TEAMS: &str = "campaign-teams.toml";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The three crates that a run needs, in a workspace of their own, untouched files untouched. Programs are to be there
/// soon, not to be fast: in many units, so that what a line does not change is not built again.
fn copy(to: &Path) {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let line = |key: &str| format!("{key} = [\"crates/core\", \"crates/graph\", \"crates/sim\"]");
    let own = |text: &str| match text.split_once(" = ") {
        Some((key @ ("members" | "default-members"), _)) => line(key),
        Some((key @ ("debug" | "lto"), _)) => format!("{key} = false"),
        Some((key @ "codegen-units", _)) => format!("{key} = 256"),
        _ => text.to_owned(),
    };
    let manifest = manifest.lines().map(own).collect::<Vec<_>>().join("\n");
    put(&to.join("Cargo.toml"), manifest.as_bytes());
    put(&to.join("Cargo.lock"), &fs::read(root().join("Cargo.lock")).unwrap());
    for name in ["core", "graph", "sim"] {
        let folder = Path::new("crates").join(name);
        let manifest = fs::read_to_string(root().join(&folder).join("Cargo.toml")).unwrap();
        put(&to.join(&folder).join("Cargo.toml"), without_tests(&manifest).as_bytes());
        for part in ["src", "examples"] {
            copy_folder(&root().join(&folder).join(part), &to.join(&folder).join(part));
        }
    }
}

/// The manifest of a crate without what only its tests and benches need.
fn without_tests(manifest: &str) -> String {
    let mut keep = true;
    let lines = manifest.lines().filter(|line| {
        if line.starts_with('[') {
            keep = !matches!(*line, "[dev-dependencies]" | "[[bench]]" | "[[test]]");
        }
        keep
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn copy_folder(from: &Path, to: &Path) {
    let Ok(entries) = fs::read_dir(from) else { return };
    forget_missing(from, to);
    for entry in entries {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() { copy_folder(&path, &target) } else { put(&target, &fs::read(&path).unwrap()) }
    }
}

/// Removes from an older copy what is no longer there, or has become a folder or a file.
fn forget_missing(from: &Path, to: &Path) {
    let Ok(entries) = fs::read_dir(to) else { return };
    for copied in entries.map(|entry| entry.unwrap().path()) {
        let source = from.join(copied.file_name().unwrap());
        match copied.is_dir() {
            true if !source.is_dir() => fs::remove_dir_all(&copied).unwrap(),
            false if !source.is_file() => fs::remove_file(&copied).unwrap(),
            _ => {}
        }
    }
}

/// Writes what is not there yet, so that nothing is built twice.
fn put(path: &Path, bytes: &[u8]) {
    if fs::read(path).is_ok_and(|there| there == bytes) {
        return;
    }
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, bytes).unwrap();
}

/// Builds the program that stands in `workspace` and hunts for violations of `law`.
fn hunt(workspace: &Path, campaign: &str, runs: &str, law: &str) -> String {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let out = Command::new(cargo)
        .args(["run", "--release", "--quiet", "--offline", "-p", "closeranks-sim", "--example", "hunt", "--"])
        .arg(root().join("scenarios").join(campaign).canonicalize().unwrap())
        .args([runs, SEED])
        .args((!law.is_empty()).then_some(law))
        .env("CARGO_TARGET_DIR", workspace.join("target"))
        .env("CARGO_INCREMENTAL", "1")
        .current_dir(workspace)
        .output()
        .unwrap();
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    String::from_utf8(out.stdout).unwrap().trim().to_owned()
}

/// Hunts in a program with the lines of `mutant`, and puts the lines back; true if the law caught it.
fn caught(workspace: &Path, mutant: &Mutant) -> bool {
    let Mutant { name, law, lines } = mutant;
    for (file, line, broken) in *lines {
        let path = workspace.join("crates").join(file);
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(text.matches(line).count(), 1, "{name}: `{line}` in {file}");
        put(&path, text.replace(line, broken).as_bytes());
    }
    let campaign = match name.split_once(": ") {
        Some(("ranks", _)) => RANKED,
        Some(("obstacles", _)) => OBSTACLES,
        Some(("cuts", _)) => CUTS,
        Some(("presence", _)) => PRESENCE,
        Some(("teams", _)) => TEAMS,
        _ => CAMPAIGN,
    };
    let found = hunt(workspace, campaign, RUNS, law);
    eprintln!("{name}: {found}");
    copy(workspace);
    found.starts_with("found")
}

/// Hunts for every `LANES`th of the mutants, beside the other lanes, and gives those that were not caught.
fn lane(lane: usize, mutants: &[&Mutant]) -> Vec<String> {
    let workspace = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("oracle-{lane}"));
    copy(&workspace);
    let campaign = [CAMPAIGN, RANKED][lane % 2];
    assert_eq!(
        hunt(&workspace, campaign, INTACT, ""),
        format!("nothing {INTACT}"),
        "the controller as it is"
    );
    let mine = mutants.iter().skip(lane).step_by(LANES);
    let missed = mine.filter(|mutant| !caught(&workspace, mutant));
    missed.map(|mutant| format!("{} ({})", mutant.name, mutant.law)).collect()
}

#[test]
fn every_broken_controller_is_caught_by_its_law() {
    let only = std::env::var("MUTANT").unwrap_or_default();
    let all = MUTANTS
        .iter()
        .chain(&AMONG_OBSTACLES)
        .chain(&COMING_AND_GOING)
        .chain(&BESIDE_OTHERS)
        .chain(&WHERE_LINKS_ARE_CUT);
    let chosen: Vec<&Mutant> = all.filter(|mutant| mutant.name.contains(&only)).collect();
    assert!(!chosen.is_empty(), "no mutant's name contains MUTANT={only}");
    let missed: Vec<String> = thread::scope(|scope| {
        let lanes: Vec<_> = (0..LANES)
            .map(|number| {
                scope.spawn({
                    let chosen = &chosen;
                    move || lane(number, chosen)
                })
            })
            .collect();
        lanes.into_iter().flat_map(|lane| lane.join().unwrap()).collect()
    });
    assert!(missed.is_empty(), "not caught: {missed:?}");
}
