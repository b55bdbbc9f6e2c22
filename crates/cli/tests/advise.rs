//! `closeranks advise`: what it says, its JSON, and what it refuses.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn closeranks(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_closeranks")).current_dir(folder).args(arguments).output().unwrap()
}

/// The exit code, and what is said on standard output and on standard error.
fn advise(arguments: &[&str]) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let output = closeranks(folder.path(), &[&["advise"], arguments].concat());
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&advise(&[arguments, &["--json"]].concat()).1).unwrap()
}

#[track_caller]
fn says(arguments: &[&str], code: i32, parts: &[&str]) {
    let (found, told, errors) = advise(arguments);
    assert_eq!((found, errors.as_str()), (Some(code), ""), "{told}");
    assert!(told.lines().all(|line| line.chars().count() <= 80), "{told}");
    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in parts {
        assert!(told.contains(part), "`{part}` is not in: {told}");
    }
}

#[track_caller]
fn refused(arguments: &[&str], parts: &[&str]) {
    let (found, told, errors) = advise(arguments);
    assert_eq!((found, told.as_str()), (Some(2), ""), "{errors}");
    for part in parts {
        assert!(errors.contains(part), "`{part}` is not in: {errors}");
    }
}

#[test]
fn the_papers_team_has_a_start() {
    says(
        &[],
        0,
        &[
            "11 robots of which 2 may be malicious, in 2 dimensions, under the controller budget.",
            "2F + 1 = 5 is at most n = 11. Under obedient a robot must keep 7 of the 10 that count, which can be.",
            "free 6 of 8 3.598",
            "Under obedient a start exists, with spacings from 0.3001 m (least h 4.665) to 1.133 m (least h 0).",
            "start = { kind = \"hexagon\", spacing_m = 0.9252 }",
            "Under free n = 11 allows F up to 3; F = 2 needs n of at least 7.",
            "the fastest speed is 190.9 m/s along each axis (now 1.5)",
            "No errors are stated, so nothing is lost to them.",
        ],
    );
}

#[test]
fn stated_errors_have_their_price() {
    let errors = ["--position-error", "0.01", "--lag", "0.02", "--hold", "0.006"];
    says(&errors, 0, &["tracking 0.04243 m 2.915 0.3849", "hold +0.001 s"]);
    let json = json(&errors);
    let names: Vec<&str> =
        json["errors"].as_array().unwrap().iter().map(|error| error["error"].as_str().unwrap()).collect();
    assert_eq!(names, ["nothing", "position", "tracking", "hold", "all"]);
    assert!(json["errors"][4]["h_lost"].as_f64().unwrap() > json["errors"][2]["h_lost"].as_f64().unwrap());
}

/// The controller that is recommended is that of docs/which.md, with the numbers measured there.
#[test]
fn the_controller_is_that_of_the_page() {
    says(
        &["--tick", "0.02"],
        0,
        &["take links", "nearest is: 20 ms. There links ended 1.952 m wide and budget 1.574 m"],
    );
    says(&["--silent"], 0, &["take budget", "nearest is: 11 robots, 5 ms"]);
    says(&["--loss", "1"], 0, &["take budget", "Nothing that they tell arrives"]);
    says(&["--loss", "0.4"], 0, &["take links", "half of all messages lost"]);
    says(&["--position-error", "0.01"], 0, &["take links", "positions wrong by 1 cm, stated"]);
    says(&["--lag", "0.02"], 0, &["take links", "a lag of 20 ms, stated"]);
    says(&["--assume", "free"], 0, &["take links", "assume = free"]);
    says(&["--robots", "60", "--tick", "0.1"], 0, &["take links", "40 robots, 100 ms"]);
    assert_eq!(json(&["--silent"])["controller"], "budget");
    assert_eq!(json(&[])["controller"], "links");
    refused(&["--loss", "1.5"], &["'--loss <P>'", "0 to 1"]);
}

#[test]
fn what_is_impossible_is_explained_by_name_and_value() {
    let free = ["--faults", "5", "--assume", "free"];
    says(
        &free,
        1,
        &["Under free there is NO start: F is 5, and n = 11 allows F up to 3.", "which CANNOT be"],
    );
    says(&["--distance-min", "1.5"], 1, &["the spacing is allowed to be at most 1.133 m, but robots"]);
    says(
        &["--radius", "0.7", "--distance-min", "0.1", "--q2", "0.3"],
        1,
        &["even with all robots at one point h is -6.58"],
    );
}

#[test]
fn impossible_numbers_are_refused_by_the_name_of_the_option() {
    refused(&["--faults", "6"], &["--faults is 6, allowed is 0 to 5 (2F + 1 <= n)"]);
    refused(&["--robots", "1"], &["invalid value '1' for '--robots <N>': allowed is a number, 2 to 10000"]);
    refused(&["--robots", "4.5"], &["allowed is a whole number"]);
    refused(&["--radius", "-1"], &["'--radius <M>'", "more than 0 and at most 1000000"]);
    refused(&["--tick", "NaN"], &["'--tick <S>'", "0.000001 to 3600"]);
    refused(&["--hold", "0.001"], &["--hold is 0.001, allowed is 0.005 to 3600 (at least clock.tau_1_s)"]);
    refused(&["--speed", "1000"], &["--speed is 1000, allowed is at most 190.9 with this tick", "0.0009545"]);
    refused(&["--distance-min", "3"], &["--distance-min is 3, allowed is less than", "stand still"]);
    refused(&["--lag", "0.1", "--tracking-error", "0.1"], &["cannot be used with"]);
    refused(&["--assume", "good"], &["obedient, free"]);
    refused(&["--dimension", "4"], &["2, 3"]);
    refused(&["missing.toml"], &["the scenario `missing.toml`"]);
}

#[test]
fn json_has_the_same_numbers() {
    let json = json(&["--assume", "free", "--robots", "7"]);
    assert_eq!(json["asked"]["faults"], 2);
    assert_eq!((&json["exists"], &json["asked"]["assume"]), (&Value::Bool(true), &Value::from("free")));
    assert_eq!(json["assume"]["free"]["need"], 4);
    assert_eq!(json["assume"]["obedient"]["need"], 5);
    let room = &json["assume"]["free"]["spacings"]["most_room"];
    assert_eq!(json["start"]["spacing_m"], room["spacing_m"]);
    assert!(json["speed_max_m_s"].as_f64().unwrap() > 100.0 && json["start_of_file"].is_null());
}

/// The start of the answer can be copied, and is what it says.
#[test]
fn in_space_the_positions_are_listed_and_can_be_run() {
    let json = json(&["--dimension", "3"]);
    let positions = &json["start"]["positions_m"];
    assert_eq!(positions.as_array().unwrap().len(), 11);
    let folder = tempfile::tempdir().unwrap();
    let scenario = format!(
        "duration_s = 0\ndimension = 3\n[controller]\nkind = \"budget\"\n[start]\nkind = \"listed\"\npositions_m = {positions}\n"
    );
    fs::write(folder.path().join("a.toml"), scenario).unwrap();
    let run = closeranks(folder.path(), &["run", "a.toml", "--json"]);
    let run: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(run["start"]["inside"], true);
    let h = json["assume"]["obedient"]["spacings"]["most_room"]["h"].as_f64().unwrap();
    assert!((run["start"]["h_min"].as_f64().unwrap() - h).abs() < 1e-9);
}

#[test]
fn run_points_here_when_a_start_lies_outside() {
    let folder = tempfile::tempdir().unwrap();
    let run = |scenario: &str, command: &str| {
        fs::write(folder.path().join("my team.toml"), scenario).unwrap();
        String::from_utf8(closeranks(folder.path(), &[command, "my team.toml"]).stdout).unwrap()
    };
    let budget = "duration_s = 0\n[controller]\nkind = \"budget\"\n";
    let outside = format!("{budget}[start]\nkind = \"hexagon\"\nspacing_m = 1.2\n");
    let note = "note: `closeranks advise 'my team.toml'` says which starts, speeds and F are possible";
    assert!(run(&outside, "run").contains(note));
    assert!(!run(budget, "run").contains("advise"));
    assert!(run(&outside, "advise").contains("The start of the file lies OUTSIDE the safe set of budget"));
    assert!(run(budget, "advise").contains("The start of the file lies inside"));
}

#[test]
fn a_lag_that_is_not_stated_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let advise = |stated_m: f64| {
        let text = format!(
            "[controller]\nkind = \"budget\"\ntracking_error_m = {stated_m}\n[plant]\nlag_s = 0.02\n"
        );
        fs::write(folder.path().join("a.toml"), text).unwrap();
        let output = closeranks(folder.path(), &["advise", "a.toml"]);
        String::from_utf8(output.stdout).unwrap().split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let note = "Its robots LAG, for which a tracking error of 0.04243 m is enough; 0.01 m is stated.";
    assert!(advise(0.01).contains(note));
    assert!(!advise(0.043).contains("LAG"));
}

/// The example of the page is what the program says, paragraph by paragraph.
#[test]
fn the_page_has_the_words_of_the_program() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/budget.md");
    let page = fs::read_to_string(page).unwrap();
    let (_, after) = page.split_once("closeranks advise --position-error 0.01 --lag 0.02").unwrap();
    let block = after.split("```").find(|block| block.starts_with("text")).unwrap();
    let (_, told, _) = advise(&["--position-error", "0.01", "--lag", "0.02"]);
    for paragraph in block.trim_start_matches("text").trim().split("\n\n") {
        assert!(told.contains(paragraph), "the page has\n{paragraph}\nthe program says\n{told}");
    }
}
