//! `closeranks sweep` as its user meets it: rows that depend on nothing but their number, kills, shards, folders.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output};

use closeranks_report::sweep::file::read;
use closeranks_report::sweep::rows::Rows;
use serde_json::Value;

const FILE: &str = "duration_s = 0.2\n[sweep]\ncontrollers = [\"composed\", \"budget\"]\n[team]\nrobots = { draw = [4, 6] }\n\
    faults = { draw = [0, 2] }\n[clock]\ntau_1_s = { choose = [0.02, 0.1] }\n[attack]\nlevel = { choose = [{ kind = \"none\" }, \
    { kind = \"bias\", bias = { draw = [-4.0, 4.0] } }] }\n";

/// Robots that nobody holds together.
const BROKEN: &str =
    "duration_s = 1.5\n[controller]\nkind = \"none\"\n[link]\nq2 = { draw = [0.29, 0.31] }\n";

fn folder(file: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("many.toml"), file).unwrap();
    folder
}

fn closeranks(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_closeranks")).current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Runs a sweep of many.toml into `out`, with the words of `more`.
fn sweep(folder: &Path, out: &str, more: &str) -> Output {
    let mut arguments = vec!["sweep", "many.toml", "-o", out];
    arguments.extend(more.split_whitespace());
    closeranks(folder, &arguments)
}

#[track_caller]
fn swept(folder: &Path, out: &str, more: &str) -> String {
    let output = sweep(folder, out, more);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

#[track_caller]
fn refused(output: &Output, message: &str) {
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains(message), "{}", text(&output.stderr));
}

fn rows(file: &Path) -> Rows {
    let mut all: Option<Rows> = None;
    let mut add = |rows: Rows| match &mut all {
        Some(all) => assert!(all.append(rows)),
        none => *none = Some(rows),
    };
    read(File::open(file).unwrap(), &[], &mut add).unwrap();
    all.unwrap()
}

#[test]
fn threads_and_the_length_of_a_sweep_change_no_row() {
    let folder = folder(FILE);
    swept(folder.path(), "one", "--runs 12 --jobs 1 -q");
    swept(folder.path(), "two", "--runs 12 --jobs 2 -q");
    swept(folder.path(), "long", "--runs 20 -q");
    let bytes = |out: &str| fs::read(folder.path().join(out).join("runs.parquet")).unwrap();
    assert_eq!(bytes("one"), bytes("two"));
    let [short, long] = ["one", "long"].map(|out| rows(&folder.path().join(out).join("runs.parquet")));
    assert_eq!((short.count(), long.count()), (24, 40));
    for name in ["seed", "run", "broken_shares", "redraws"] {
        assert_eq!(short.whole(name), &long.whole(name)[..24], "{name}");
    }
    for name in ["gyration_m", "team.robots", "attack.level.bias", "h_min"] {
        assert_eq!(short.number(name), &long.number(name)[..24], "{name}");
    }
    let order: Vec<_> = short.whole("run").iter().zip(short.text("controller")).collect();
    assert!(order.is_sorted() && order[0].1.as_deref() == Some("budget"));
    assert_ne!(short.whole("seed"), rows(&seeded(folder.path())).whole("seed"), "another seed, other runs");
}

fn seeded(folder: &Path) -> std::path::PathBuf {
    swept(folder, "seeded", "--runs 12 --seed 2 -q");
    folder.join("seeded/runs.parquet")
}

#[test]
fn shards_are_the_whole() {
    let folder = folder(FILE);
    swept(folder.path(), "whole", "--runs 10 -q");
    let whole = rows(&folder.path().join("whole/runs.parquet"));
    let mut merged = Vec::new();
    for index in 1..=3 {
        let out = format!("part{index}");
        swept(folder.path(), &out, &format!("--runs 10 --shard {index}/3 -q"));
        let shard = rows(&folder.path().join(format!("{out}/runs-{index}-of-3.parquet")));
        merged.extend(lines(&shard));
    }
    merged.sort();
    let mut all = lines(&whole);
    all.sort();
    assert_eq!(merged, all);
    refused(&sweep(folder.path(), "x", "--shard 4/3"), "allowed is I/M with 1 <= I <= M");
}

/// Each row as a text of all its cells.
fn lines(rows: &Rows) -> Vec<String> {
    let cell = |name: &str, row: usize| {
        let whole = rows.whole(name).get(row).map(|cell| format!("{cell:?}"));
        let number = rows.number(name).get(row).map(|cell| format!("{cell:?}"));
        whole.or(number).unwrap_or_else(|| format!("{:?}", rows.text(name)[row]))
    };
    let line = |row| rows.heads().iter().map(|head| cell(&head.name, row)).collect::<Vec<_>>().join(" ");
    (0..rows.count()).map(line).collect()
}

#[test]
fn a_killed_sweep_goes_on_and_loses_and_doubles_nothing() {
    let folder = folder(FILE);
    let at = |name: &str| folder.path().join("out").join(name);
    swept(folder.path(), "out", "--runs 9 -q");
    let whole = fs::read(at("runs.parquet")).unwrap();
    // As a kill would leave it: some blocks, one of them half written.
    fs::remove_file(at("runs.parquet")).unwrap();
    let part = part_of(folder.path());
    fs::write(at("part-0000004.parquet"), &part).unwrap();
    fs::write(at(".closeranks-half"), &part[..part.len() / 2]).unwrap();
    swept(folder.path(), "out", "--runs 9 -q");
    assert_eq!(fs::read(at("runs.parquet")).unwrap(), whole);
    assert!(!at(".closeranks-half").exists() && !at("part-0000004.parquet").exists());
    assert!(swept(folder.path(), "out", "--runs 9").starts_with("this sweep was finished before in out\n"));
}

/// As above, by a real kill, whenever it comes.
#[test]
fn a_sweep_that_is_killed_for_good_ends_with_the_same_bytes() {
    let folder = folder(FILE);
    let arguments = ["sweep", "many.toml", "--runs", "2000", "--jobs", "2", "-q"];
    let mut program = Command::new(env!("CARGO_BIN_EXE_closeranks"));
    let mut child =
        program.current_dir(folder.path()).args(arguments).args(["-o", "killed"]).spawn().unwrap();
    let begun = || folder.path().join("killed/part-0000001.parquet").exists();
    while !begun() && child.try_wait().unwrap().is_none() {
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!folder.path().join("killed/runs.parquet").exists(), "it was killed before it had finished");
    for out in ["killed", "whole"] {
        swept(folder.path(), out, "--runs 2000 -q");
    }
    let bytes = |out: &str| fs::read(folder.path().join(out).join("runs.parquet")).unwrap();
    assert_eq!(bytes("killed"), bytes("whole"));
}

/// The block of run 4 in a sweep of 9: the only run of a shard has the same columns.
fn part_of(folder: &Path) -> Vec<u8> {
    swept(folder, "fifth", "--runs 9 --shard 5/9 -q");
    fs::read(folder.join("fifth/runs-5-of-9.parquet")).unwrap()
}

/// A damaged block used to be found when all others had been run, and the message asked to remove it by hand.
#[test]
fn blocks_that_are_broken_or_of_other_runs_are_run_again() {
    let folder = folder(FILE);
    let at = |name: &str| folder.path().join("out").join(name);
    swept(folder.path(), "out", "--runs 9 -q");
    let whole = fs::read(at("runs.parquet")).unwrap();
    for (index, bytes) in [b"PAR1 and no more".to_vec(), part_of(folder.path())].into_iter().enumerate() {
        fs::remove_file(at("runs.parquet")).unwrap();
        fs::write(at("part-0000003.parquet"), bytes).unwrap();
        let output = sweep(folder.path(), "out", "--runs 9");
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let note = "note: `out/part-0000003.parquet` was damaged; its runs are run again\n";
        assert_eq!(text(&output.stderr), note, "{index}");
        assert_eq!(fs::read(at("runs.parquet")).unwrap(), whole);
    }
}

#[test]
fn folders_of_other_sweeps_of_others_and_in_use_are_left_alone() {
    let folder = folder(FILE);
    swept(folder.path(), "out", "--runs 2 -q");
    refused(&sweep(folder.path(), "out", "--runs 3"), "holds another sweep: its `runs` is 2, not 3");
    refused(&sweep(folder.path(), "out", "--runs 2 --seed 9"), "its `seed` is 1, not 9");
    refused(&closeranks(folder.path(), &["paper", "-o", "out"]), "`out` holds a sweep");
    swept(folder.path(), "longer", "--runs 3 -q");
    let at = |name: &str| folder.path().join("out").join(name);
    let [rows, manifest] = ["runs.parquet", "sweep.json"].map(|name| fs::read(at(name)).unwrap());
    fs::copy(folder.path().join("longer/runs.parquet"), at("runs.parquet")).unwrap();
    refused(&sweep(folder.path(), "out", "--runs 2"), "runs.parquet` is of another sweep; remove it");
    fs::write(at("runs.parquet"), rows).unwrap();
    fs::write(at("sweep.json"), [0xff]).unwrap();
    refused(&sweep(folder.path(), "out", "--runs 2"), "holds another sweep: it cannot be read");
    fs::write(at("sweep.json"), manifest).unwrap();
    fs::write(folder.path().join("out/notes.txt"), "keep").unwrap();
    refused(&sweep(folder.path(), "out", "--runs 2"), "`out` holds `notes.txt`, which no sweep wrote");
    fs::remove_file(folder.path().join("out/notes.txt")).unwrap();
    let lock = File::open(folder.path().join("out/sweep.lock")).unwrap();
    lock.lock().unwrap();
    refused(&sweep(folder.path(), "out", "--runs 2"), "another closeranks is at work in `out`");
    lock.unlock().unwrap();
    fs::write(folder.path().join("many.toml"), FILE.replace("[4, 6]", "[4, 7]")).unwrap();
    refused(
        &sweep(folder.path(), "out", "--runs 2"),
        "line 5 of its file is `robots = { draw = [4, 6] }`, not",
    );
    for target in ["many.toml", "many.toml/below", ".."] {
        refused(&sweep(folder.path(), target, "--runs 2"), &format!("`{target}`"));
    }
}

#[test]
fn one_command_repeats_a_run() {
    let folder = folder(FILE);
    swept(folder.path(), "out", "--runs 6 --seed 3 -q");
    let rows = rows(&folder.path().join("out/runs.parquet"));
    let repeat = |more: &[&str]| {
        closeranks(folder.path(), &[&["run", "many.toml", "--draw", "5", "--sweep-seed", "3"], more].concat())
    };
    for (row, controller) in [(10, "budget"), (11, "composed")] {
        let json: Value =
            serde_json::from_slice(&repeat(&["--controller", controller, "--json"]).stdout).unwrap();
        assert_eq!(json["seed"].as_i64(), rows.whole("seed")[row]);
        assert_eq!(json["gyration_m"].as_f64(), rows.number("gyration_m")[row]);
        let phi_negative = json["phi_negative"].as_i64().filter(|_| controller == "composed");
        assert_eq!(rows.whole("broken_shares")[row], phi_negative, "phi is left out under budget");
    }
    fs::write(folder.path().join("plain.toml"), repeat(&["--print", "--controller", "composed"]).stdout)
        .unwrap();
    let plain = closeranks(folder.path(), &["run", "plain.toml", "--json"]);
    let json: Value = serde_json::from_slice(&plain.stdout).unwrap();
    assert_eq!(json["gyration_m"].as_f64(), rows.number("gyration_m")[11]);
    refused(
        &closeranks(folder.path(), &["run", "many.toml"]),
        "closeranks run many.toml --draw K --sweep-seed S",
    );
    refused(&closeranks(folder.path(), &["compare", "many.toml"]), "draws values");
}

/// Also under a controller that would have been drawn otherwise, had it been alone.
#[test]
fn any_controller_repeats_the_draws_of_the_sweep() {
    let folder = folder(
        "duration_s = 0.1\n[start]\nkind = \"random\"\n[team]\nrobots = 6\nfaults = 0\n[controller]\n\
         kind = { choose = [\"budget\", \"none\"] }\ndistance_min_m = { draw = [2.96, 2.999] }\n",
    );
    swept(folder.path(), "out", "--runs 12 -q");
    let rows = rows(&folder.path().join("out/runs.parquet"));
    let mut others = 0;
    for run in 0..12 {
        let repeat = |controller: &str| {
            let command = format!("run many.toml --draw {run} --controller {controller} --json");
            closeranks(folder.path(), &command.split(' ').collect::<Vec<_>>())
        };
        let drawn = rows.text("controller")[run].clone().unwrap();
        let json: Value = serde_json::from_slice(&repeat(&drawn).stdout).unwrap();
        assert_eq!(json["seed"].as_i64(), rows.whole("seed")[run], "run {run}");
        let other = repeat(if drawn == "none" { "budget" } else { "none" });
        if other.status.code() == Some(2) {
            refused(&other, &format!("run {run} of many.toml under budget"));
            continue;
        }
        let json: Value = serde_json::from_slice(&other.stdout).unwrap();
        assert_eq!(json["seed"].as_i64(), rows.whole("seed")[run]);
        others += 1;
    }
    assert!(others > 0, "some can be run under the other controller");
}

#[test]
fn json_counts_violations_and_says_how_to_repeat_them() {
    let folder = folder(BROKEN);
    let output = sweep(folder.path(), "out", "--runs 4 --json");
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&json["runs"], &json["seed"]), (&4.into(), &1.into()));
    let none = &json["controllers"]["none"];
    assert_eq!((&none["runs"], &none["violations"], &none["upper_95"]), (&4.into(), &4.into(), &1.0.into()));
    assert_eq!(none["by_invariant"]["degree"], 4);
    assert_eq!(none["by_invariant"].as_object().unwrap().len(), 5);
    assert_eq!(none["by_invariant"]["input"], 0);
    let told = |law: &str| none["broken_at_all"].get(law).is_some();
    assert_eq!(
        ["spare", "shares", "decay", "mode"].map(told),
        [true, false, false, false],
        "phi is nobody's business here"
    );
    assert!(none["gyration_m"].as_f64().unwrap() > 0.5);
    let first = &json["first_violations"][0];
    let command = first["command"].as_str().unwrap();
    assert_eq!(command, "closeranks run many.toml --draw 0 --sweep-seed 1 --controller none");
    let repeated = closeranks(folder.path(), &command.split(' ').skip(1).collect::<Vec<_>>());
    assert_eq!(repeated.status.code(), Some(1));
    assert!(text(&repeated.stdout).contains("degree: BROKEN"), "{}", text(&repeated.stdout));
    for page in ["report.html", "laws.png", "laws.svg", "gyration.png", "gyration.svg"] {
        assert!(folder.path().join("out").join(page).is_file(), "{page}");
    }
}

#[test]
fn the_exit_code_is_about_budget_where_there_is_one() {
    let folder =
        folder(&BROKEN.replace("duration_s", "sweep = { controllers = [\"budget\", \"none\"] }\nduration_s"));
    let told = swept(folder.path(), "out", "--runs 2");
    assert!(told.contains("\nbudget         2           0      0 %"), "{told}");
    assert!(told.contains("closeranks run many.toml --draw 0 --sweep-seed 1 --controller none"), "{told}");
}

#[test]
fn what_cannot_be_drawn_is_shown_at_its_place_before_anything_is_written() {
    let folder = folder("[team]\nrobots = 4\nfaults = { draw = [2, 3] }\n");
    let output = sweep(folder.path(), "out", "--runs 4");
    refused(&output, "3 | faults = { draw = [2, 3] }\n  |          ^^^^^^^^^^^^^^^^^ allowed is");
    refused(&output, "note: none of 1000 draws of run 0 can be run");
    fs::write(folder.path().join("many.toml"), "[team]\nrobots = { draw = [9, 4] }\n").unwrap();
    refused(&sweep(folder.path(), "out", ""), "error: `team.robots.draw` is [9, 4]\n --> many.toml:2:19");
    assert!(!folder.path().join("out").exists());
}
