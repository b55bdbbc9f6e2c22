//! Files beside scenarios, and recordings of others, as their user meets them.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

fn closeranks(folder: &Path, arguments: &str) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_closeranks"));
    let program = program.current_dir(folder).args(arguments.split_whitespace());
    program.stdin(Stdio::null()).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[track_caller]
fn refused(folder: &Path, arguments: &str, message: &str) {
    let output = closeranks(folder, arguments);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains(message), "{said}");
}

const SCENARIO: &str = "duration_s = 0.5\n[motion]\nkind = \"velocities\"\nfile = \"motion.csv\"\n";

/// What is written can be run again without the file.
#[test]
fn motion_comes_from_a_file_and_goes_into_the_results() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("a.toml"), SCENARIO).unwrap();
    refused(here, "run a.toml", "`motion.file` is motion.csv: cannot read the file `motion.csv`");
    fs::write(here.join("motion.csv"), "robot,time_s,vx_m_s,vy_m_s\n1,0,0.2,0\n2,0.1,fast,0\n").unwrap();
    let message = "`motion.file` is motion.csv, line 3: vx_m_s = fast";
    refused(here, "run a.toml", message);
    fs::write(here.join("motion.csv"), "robot,time_s,vx_m_s,vy_m_s\n1,0,0.2,0\n2,0.1,0,0.1\n").unwrap();
    let run = closeranks(here, "run a.toml -q -o out");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    fs::copy(here.join("out/scenario.toml"), here.join("b.toml")).unwrap();
    fs::remove_file(here.join("motion.csv")).unwrap();
    let again = closeranks(here, "run b.toml -q -o again");
    assert_eq!(again.status.code(), Some(0), "{}", text(&again.stderr));
    let file = |name: &str| fs::read(here.join(name)).unwrap();
    assert!(file("out/run.parquet") == file("again/run.parquet"));
    assert_eq!(closeranks(here, "check out/run.parquet").status.code(), Some(0));
}

#[test]
fn sweeps_have_files_too() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("s.toml"), format!("{SCENARIO}[link]\nq2 = {{ draw = [0.2, 0.4] }}\n")).unwrap();
    fs::write(here.join("motion.csv"), "robot,time_s,vx_m_s,vy_m_s\n1,0,0.2,0\n").unwrap();
    let sweep = closeranks(here, "sweep s.toml --runs 3 -o out -q");
    assert_ne!(sweep.status.code(), Some(2), "{}", text(&sweep.stderr));
    let printed = text(&closeranks(here, "run s.toml --draw 1 --print").stdout);
    assert!(printed.contains("velocities = [[1, 0.0, 0.2, 0.0]]"), "{printed}");
    fs::write(here.join("motion.csv"), "robot,time_s,vx_m_s,vy_m_s\n1,0,0.3,0\n").unwrap();
    refused(here, "sweep s.toml --runs 3 -o out", "holds another sweep");
}

#[test]
fn an_empty_pipe_is_no_scenario_and_an_empty_file_is_one() {
    let folder = tempfile::tempdir().unwrap();
    refused(folder.path(), "run -", "the scenario `standard input` is an empty pipe");
    fs::write(folder.path().join("a.toml"), "").unwrap();
    assert_eq!(closeranks(folder.path(), "run a.toml -q").status.code(), Some(0));
}

/// A recording that needs several parts is whole, and nothing of its making is left.
#[test]
fn long_runs_are_recorded_in_parts() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = "duration_s = 150.0\n[team]\nrobots = 9\nfaults = 0\n[controller]\nkind = \"none\"\n\
        [motion]\nkind = \"hold\"\n";
    fs::write(folder.path().join("a.toml"), scenario).unwrap();
    let run = closeranks(folder.path(), "run a.toml -q -o out");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let check = closeranks(folder.path(), "check out/run.parquet --every 1000 --json");
    let found: Value = serde_json::from_slice(&check.stdout).unwrap();
    assert_eq!(found["rounds"].as_array().unwrap().len(), 31);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

/// `recordings/make.py` wrote these with pandas and polars.
#[test]
fn recordings_of_others_are_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings");
    let files = ["pandas.csv", "polars.csv", "pandas.parquet", "pandas-small.parquet", "polars.parquet"];
    for file in files.into_iter().chain(["polars-names.parquet"]) {
        let output = closeranks(&folder, &format!("check {file} --radius 1.5 --F 1 --json"));
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(output.status.code(), Some(1), "{file}: not always");
        assert_eq!((&found["n"], &found["rounds_survived"]), (&4.into(), &4.into()), "{file}");
        assert_eq!(
            (&found["degree_least"], &found["rounds"][5]["time_s"]),
            (&0.into(), &2.5.into()),
            "{file}"
        );
    }
    let hole = "the recording `hole.parquet` cannot be read: column `x_m`, row 17 is null";
    refused(&folder, "check hole.parquet --radius 1.5", hole);
    refused(
        &folder,
        "check pandas.csv",
        "does not say how far robots hear each other: allowed is with --radius",
    );
}
