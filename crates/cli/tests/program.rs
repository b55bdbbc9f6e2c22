//! The program as its user meets it: files, exit codes, messages, folders.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn closeranks(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_closeranks")).current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Runs `scenario`, which must be refused with `message` and without anything on standard output.
#[track_caller]
fn refused(scenario: &str, message: &str) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scenario.toml"), scenario).unwrap();
    let output = closeranks(folder.path(), &["run", "scenario.toml", "-o", "out"]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    assert_eq!(text(&output.stderr), message);
    assert!(output.stdout.is_empty() && !folder.path().join("out").exists());
}

#[test]
fn a_mistake_is_underlined_with_what_is_allowed() {
    refused(
        "[link]\nepsilon = 0.2\n",
        "error: `link.epsilon` is 0.2
 --> scenario.toml:2:11
  |
2 | epsilon = 0.2
  |           ^^^ allowed is more than 0 and less than 0.1 (below 1/(n-1), n = 11)
",
    );
    refused(
        "name = \"x\nseed = 2",
        "error: invalid basic string, expected `\"`
 --> scenario.toml:1:10
  |
1 | name = \"x
  |          ^
",
    );
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("bytes.toml"), [0xff, 0xfe]).unwrap();
    for file in ["missing.toml", ".", "bytes.toml"] {
        let output = closeranks(folder.path(), &["run", file]);
        assert_eq!(output.status.code(), Some(2));
        assert!(text(&output.stderr).contains(&format!("the scenario `{file}`")), "{}", text(&output.stderr));
    }
    assert_eq!(closeranks(folder.path(), &["run"]).status.code(), Some(2));
    assert_eq!(closeranks(folder.path(), &["fly"]).status.code(), Some(2));
}

#[test]
fn a_broken_law_that_was_expected_gives_exit_code_1() {
    let folder = tempfile::tempdir().unwrap();
    let run = |scenario: &str| {
        fs::write(folder.path().join("scenario.toml"), scenario).unwrap();
        closeranks(folder.path(), &["run", "scenario.toml"])
    };
    let broken = run("[controller]\nkind = \"none\"\n");
    assert_eq!(broken.status.code(), Some(1));
    let told = text(&broken.stdout);
    assert!(
        told.contains("degree: BROKEN: 14919 times, first at t = 1.300 s, robot 9: 6, demanded 7"),
        "{told}"
    );
    let expected = run("expect = [\"input\"]\n[controller]\nkind = \"none\"\n");
    assert_eq!(expected.status.code(), Some(0));
    assert!(text(&expected.stdout).contains("degree: broken, not expected to hold"));
}

#[test]
fn json_has_the_numbers_of_the_table() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("empty.toml"), "").unwrap();
    let output = closeranks(folder.path(), &["run", "empty.toml", "--json", "--seed", "5"]);
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["seed"], 5);
    assert_eq!(json["degree_min_normal"], 7);
    assert_eq!(json["laws"]["degree"]["broken"], 0);
    assert_eq!(json["ok"], true);
    assert!(output.stderr.is_empty());
}

#[test]
fn quiet_prints_nothing_and_the_folder_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("short.toml"), "duration_s = 0.5\n").unwrap();
    let run = || closeranks(folder.path(), &["run", "short.toml", "-q", "-o", "out"]);
    let output = run();
    assert!(output.status.success() && output.stdout.is_empty() && output.stderr.is_empty());
    let files = |name: &str| fs::read(folder.path().join("out").join(name)).unwrap();
    assert!(files("overview.png").starts_with(b"\x89PNG"));
    assert!(files("run.parquet").starts_with(b"PAR1") && files("run.parquet").ends_with(b"PAR1"));
    assert!(text(&files("report.html")).contains("</html>"));
    let before = files("run.parquet");
    assert!(run().status.success(), "a folder of ours is replaced");
    assert_eq!(before, files("run.parquet"), "the same scenario gives the same bytes");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing is left beside it");
}

#[test]
fn folders_of_others_are_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("short.toml"), "duration_s = 0\n").unwrap();
    fs::create_dir(folder.path().join("mine")).unwrap();
    fs::write(folder.path().join("mine/notes.txt"), "keep").unwrap();
    for target in ["mine", "short.toml", "short.toml/below", ".."] {
        let output = closeranks(folder.path(), &["run", "short.toml", "-o", target]);
        assert_eq!(output.status.code(), Some(2), "{target}");
        assert!(text(&output.stderr).contains(&format!("`{target}`")), "{}", text(&output.stderr));
    }
    assert_eq!(fs::read_to_string(folder.path().join("mine/notes.txt")).unwrap(), "keep");
    assert_eq!(fs::read_to_string(folder.path().join("short.toml")).unwrap(), "duration_s = 0\n");
}

#[test]
fn controllers_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("slow.toml"), "duration_s = 4\n[clock]\ntau_1_s = 0.05\n[link]\nq2 = 0.9\n")
        .unwrap();
    let compare = |more: &[&str]| closeranks(folder.path(), &[&["compare", "slow.toml"], more].concat());
    let output = compare(&["--controllers", "budget,composed,none", "-o", "out"]);
    assert_eq!(output.status.code(), Some(1), "a law that is expected is broken under composed");
    let told = text(&output.stdout);
    assert!(
        told.lines().nth(3).unwrap().starts_with("budget  ")
            && told.lines().nth(5).unwrap().starts_with("none  ")
    );
    let table: Vec<&str> = told.lines().take_while(|line| !line.starts_with("robots, measured")).collect();
    assert!(table.len() < 30 && table.iter().all(|line| line.chars().count() <= 80), "{told}");
    assert!(told.contains("senses and messages"), "{told}");
    for file in ["formations.png", "formations.svg", "series.png", "comparison.svg", "report.html"] {
        assert!(folder.path().join("out").join(file).is_file(), "{file}");
    }
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(page.contains("needs to know") && !page.contains("robot-step"), "times are in no file");
    let json: serde_json::Value = serde_json::from_slice(&compare(&["--json"]).stdout).unwrap();
    let budget = &json["runs"][1];
    assert_eq!((&budget["controller"], &budget["needs_to_know"]), (&"budget".into(), &"senses".into()));
    assert!(budget["robot_step_us"].as_f64().unwrap() > 0.0);
    let broken = |run: usize, law: &str| json["runs"][run]["laws"][law]["broken"].as_u64().unwrap();
    assert!(broken(0, "degree") + broken(0, "distance") > 0, "composed does not survive slow ticks");
    assert_eq!(broken(1, "degree") + broken(1, "distance"), 0, "budget does");
    for wrong in ["budget,budget", "brakes"] {
        let output = compare(&["--controllers", wrong]);
        assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
        // Every controller of the table is offered, in whatever order and however many there are.
        let told = text(&output.stderr);
        let names = ["composed", "budget", "none"];
        assert!(names.into_iter().all(|name| told.contains(name)), "{told}");
    }
}

#[test]
fn where_one_controller_cannot_run_a_scenario_those_are_named_that_can() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = "duration_s = 0.1\n[controller]\nkind = \"links\"\n[obstacles]\ncuts_links = \"all\"\ndiscs = [[9.0, 9.0, 0.5]]\n";
    fs::write(folder.path().join("cut.toml"), scenario).unwrap();
    let compare = |names: &str| closeranks(folder.path(), &["compare", "cut.toml", "--controllers", names]);
    let output = compare("composed,links");
    let told = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.ends_with("; `--controllers` can name links, none\n"), "{told}");
    assert_eq!(compare("links,none").status.code(), Some(0), "what is named can be run");
}

#[test]
fn the_paper_in_one_command() {
    let folder = tempfile::tempdir().unwrap();
    let output = closeranks(folder.path(), &["paper"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let told = text(&output.stdout);
    assert_eq!(told.matches("  holds  ").count(), 11 + 13, "{told}");
    assert_eq!(told.matches("  does not hold here  ").count(), 5 + 3, "{told}");
    for start in ["published", "inside"] {
        for file in ["figure1.svg", "figure1.png", "figure2.svg", "figure2.png"] {
            assert!(folder.path().join(format!("closeranks-out/{start}-{file}")).is_file());
        }
        for scenario in ["nominal", "understating", "overstating"] {
            assert!(folder.path().join(format!("closeranks-out/{start}-{scenario}.parquet")).is_file());
        }
    }
    assert!(folder.path().join("closeranks-out/report.html").is_file());
}

#[test]
fn every_scenario_that_we_ship_runs_as_its_file_says() {
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut count = 0;
    for entry in fs::read_dir(&scenarios).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let file = path.to_str().unwrap();
            // A file with draws is many scenarios: its first run.
            let name = path.file_stem().and_then(|stem| stem.to_str()).unwrap();
            let more: &[&str] = match name {
                "campaign" | "campaign-bodies" | "campaign-many-teams" | "campaign-obstacles" | "starts" => {
                    &["--draw", "0"]
                }
                // In their first runs robots leave whom others needed, or an assumption is broken, and a law with it.
                "campaign-cuts" | "campaign-presence" | "campaign-teams" => &["--draw", "3"],
                // In its run 0 an assumption is broken, and a law with it.
                "campaign-ranks" => &["--draw", "1"],
                // Ten thousand robots for a minute are too much here, and two thousand with faults.
                "swarm" | "campaign-swarm" => continue,
                _ => &[],
            };
            let output = closeranks(&scenarios, &[&["run", file, "--quiet"], more].concat());
            assert_eq!(output.status.code(), Some(0), "{}: {}", path.display(), text(&output.stderr));
            count += 1;
        }
    }
    assert!(count >= 10);
}
