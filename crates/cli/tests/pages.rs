//! Pages and tables of the program: what they show is what was run, and what they link to is there.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn closeranks(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_closeranks"));
    command.current_dir(folder).args(arguments.split(' ')).output().unwrap()
}

/// Runs the words of `arguments` beside `a.toml`, and gives the folder and what was said.
#[track_caller]
fn ran(scenario: &str, arguments: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.toml"), scenario).unwrap();
    let output = closeranks(folder.path(), arguments);
    assert!(output.status.code() < Some(2), "{}", String::from_utf8_lossy(&output.stderr));
    (folder, String::from_utf8(output.stdout).unwrap())
}

/// The page in `out`, after a look that every file it links to is there, and that it links to every file.
#[track_caller]
fn page(folder: &Path) -> String {
    let page = fs::read_to_string(folder.join("out/report.html")).unwrap();
    let links = page.split("<a href=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let mut links: Vec<&str> = links.filter(|link| !link.starts_with('#')).collect();
    links.sort_unstable();
    let files = fs::read_dir(folder.join("out")).unwrap().map(|entry| entry.unwrap().file_name());
    let files = files.map(|name| name.into_string().unwrap());
    let is_result = |name: &String| name != "report.html" && name != "sweep.lock" && !name.starts_with('.');
    let mut files: Vec<String> = files.filter(is_result).collect();
    files.sort();
    assert_eq!(links, files, "links and files");
    page
}

/// The page of `run --seed 7` used to show the file's seed, a paragraph a line, and linked to nothing.
#[test]
fn a_page_has_the_scenario_as_it_was_run_and_links_to_its_data() {
    let (folder, _) = ran("seed = 1\nduration_s = 0.5\n", "run a.toml --seed 7 --controller budget -o out");
    let page = page(folder.path());
    assert!(
        page.contains("<code>seed = 7\nduration_s = 0.5\n\n[controller]\nkind = &quot;budget&quot;\n</code>")
    );
    assert!(page.contains("</span> held</strong> <b>degree</b>: neighbours of a normal robot"));
    let text = fs::read_to_string(folder.path().join("out/scenario.toml")).unwrap();
    fs::write(folder.path().join("again.toml"), text).unwrap();
    let json = |arguments: &str| -> serde_json::Value {
        serde_json::from_slice(&closeranks(folder.path(), arguments).stdout).unwrap()
    };
    let [again, first] =
        [json("run again.toml --json"), json("run a.toml --seed 7 --controller budget --json")];
    assert_eq!(again["gyration_m"], first["gyration_m"]);
}

/// An empty panel used to be drawn where nobody had searched.
#[test]
fn above_128_robots_there_is_no_panel_of_robustness() {
    let team = "duration_s = 0.02\nexpect = []\n[team]\nrobots = 130\n[link]\nepsilon = 0.001\n[start]\n\
                kind = \"hexagon\"\nspacing_m = 0.6\n";
    let (folder, _) = ran(team, "run a.toml -o out");
    let page = page(folder.path());
    assert!(page.contains("Exact robustness is searched in teams of up to 128 robots."));
    assert!(!folder.path().join("out/robustness.svg").exists());
}

/// `compare -o` used to write pictures alone.
#[test]
fn a_comparison_has_data_and_verdicts() {
    let (folder, told) = ran("duration_s = 1.5\n", "compare a.toml --controllers budget,none -o out");
    let page = page(folder.path());
    for name in ["budget", "none"] {
        for file in [format!("{name}.toml"), format!("{name}.parquet"), format!("{name}-rounds.parquet")] {
            assert!(folder.path().join("out").join(&file).is_file() && told.contains(&file), "{file}");
        }
        assert!(page.contains(&format!("<h2>Under {name}</h2>")));
    }
    assert!(page.contains("</span> broken</strong> <b>degree</b>"), "robots that nobody holds");
    assert!(page.contains("</span> held</strong> <b>degree</b>"));
}

#[test]
fn a_sweep_links_to_its_rows() {
    let (folder, told) =
        ran("duration_s = 0.1\n[link]\nq2 = { draw = [0.2, 0.3] }\n", "sweep a.toml --runs 2 -o out");
    assert!(page(folder.path()).contains("<h1>Sweep of a.toml</h1>"));
    assert!(told.lines().take_while(|line| !line.contains("repeat")).all(|line| line.len() <= 84), "{told}");
}

/// The table of `budget` used to have numbers of phi, which it does not use, and the start of `none` was judged by it.
#[test]
fn phi_is_a_matter_of_the_papers_controller() {
    for (controller, is_there) in [("composed", true), ("budget", false), ("none", false)] {
        let scenario = format!("duration_s = 0.5\n[controller]\nkind = \"{controller}\"\n");
        let (folder, told) = ran(&scenario, "run a.toml");
        assert_eq!(told.contains("phi"), is_there, "{told}");
        let json: serde_json::Value =
            serde_json::from_slice(&closeranks(folder.path(), "run a.toml --json").stdout).unwrap();
        for number in
            [&json["phi_min"], &json["phi_negative"], &json["phi_global_min"], &json["start"]["phi_min"]]
        {
            assert_eq!(number.is_number(), is_there, "{controller}: {number}");
        }
    }
    let (_, told) = ran("duration_s = 0.1\n", "compare a.toml --controllers budget,none");
    assert!(!told.contains("phi"), "{told}");
}

/// Tables used to be 130 columns wide.
#[test]
fn tables_fit_80_columns() {
    for arguments in ["run a.toml", "compare a.toml --controllers composed,budget,none"] {
        let (_, told) = ran("duration_s = 0.1\n", arguments);
        let rules = told.lines().filter(|line| line.starts_with("---")).map(str::len);
        assert!(rules.clone().count() >= 2 && rules.max() <= Some(80), "{told}");
        assert!(!told.contains("\n\n-"), "every block has heads\n{told}");
    }
}
