//! Motion that is listed in a scenario text or in a file beside it.

use closeranks_sim::parse::{Problem, inlined, named, scenario, scenario_with};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::desired::Desired;
use closeranks_sim::world::{Options, run};

fn problems(text: &str) -> Vec<Problem> {
    scenario(text).expect_err("must be refused")
}

/// The text has one mistake, said as `expected`, and the underlined part is `marked`.
#[track_caller]
fn refused(text: &str, marked: &str, expected: &str) {
    let problems = problems(text);
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert_eq!(problems[0].to_string(), expected);
    assert_eq!(&text[problems[0].span.clone()], marked, "{expected}");
}

fn with_file(text: &str, csv: &str) -> Result<Scenario, Vec<Problem>> {
    let files = [("motion.csv".to_owned(), Ok(csv.to_owned()))].into_iter().collect();
    scenario_with(text, &files)
}

const LISTED: &str =
    "[motion]\nkind = \"waypoints\"\nwaypoints = [[1, 0, 0.5, 0], [1, 2, 0.5, 1.5], [4, 1, 0, 0]]\n";
const FILE: &str = "[motion]\nkind = \"waypoints\"\nfile = \"motion.csv\"\n";

#[test]
fn motion_is_listed_in_the_text_or_in_a_file_beside_it() {
    let listed = scenario(LISTED).unwrap();
    let csv = "# ours\nrobot,time_s,x_m,y_m\n1,0,0.5,0\n\n1,2,0.5,1.5\n4,1,0,0\n";
    let moved = "\u{feff}\"y_m\", x_m, time_s, robot\r\n0, 0.5, 0, 1\r\n1.5,0.5,2.0,1\r\n0,0,1,4";
    for csv in [csv, moved] {
        assert_eq!(with_file(FILE, csv), Ok(listed.clone()));
        let files = [("motion.csv".to_owned(), Ok(csv.to_owned()))].into_iter().collect();
        assert_eq!(scenario(&inlined(FILE, &files)), Ok(listed.clone()));
    }
    assert_eq!(named(FILE), ["motion.csv"]);
    assert!(matches!(listed.desired, Desired::Listed(_)));
    for text in [
        "[motion]\nkind = \"goals\"\ngoals = [[1, 2.0, 0.0]]\nspeed_m_s = 0.5",
        "[motion]\nkind = \"velocities\"\nvelocities = [[1, 0.0, 0.2, 0.0]]",
        "[attack]\nmotion = { kind = \"velocities\", velocities = [[1, 0.0, 0.2, 0.0]] }",
    ] {
        assert!(scenario(text).is_ok(), "{text}");
    }
}

#[test]
fn files_are_refused_with_name_line_value_and_what_is_allowed() {
    let told = |csv: &str, expected: &str| {
        let problems = with_file(FILE, csv).unwrap_err();
        assert_eq!(problems[0].to_string(), format!("`motion.file` is motion.csv, {expected}"));
        assert_eq!(&FILE[problems[0].span.clone()], "\"motion.csv\"");
    };
    let head = "robot,time_s,x_m,y_m\n";
    let told_below = |rows: &str, expected: &str| told(&format!("{head}{rows}"), expected);
    told("", "line 1: the columns \"\", allowed is robot, time_s, x_m, y_m, in any order");
    told(
        "robot,x_m,y_m",
        "line 1: the columns \"robot,x_m,y_m\", allowed is robot, time_s, x_m, y_m, in any order",
    );
    told_below("1,0,inf,0", "line 2: x_m = inf, allowed is a finite number (x_m), -1000000 to 1000000");
    told_below("1,0,0,0\n12,0,0,0", "line 3: robot = 12, allowed is a whole number (robot), 1 to 11");
    told_below("1,0,0", "line 2: 3 numbers, allowed is 4 of them");
    told_below(
        "1,1,0,0\n\n1,1,0,0",
        "line 4: robot 1 at 1 s after 1 s, allowed is more than 1: times of a robot rise",
    );
    let rows: Vec<String> = (0..10_001).map(|t| format!("1,{t},0,0\n")).collect();
    let many = format!("{head}{}", rows.concat());
    let problems = with_file(FILE, &many).unwrap_err();
    assert_eq!(problems[0].to_string(), "`motion.file` is 10001 rows, allowed is 1 to 10000 rows");
}

#[test]
fn lists_are_refused_at_the_number_that_is_wrong() {
    refused(
        "[motion]\nkind = \"goals\"\ngoals = [[1, 0, 0], [2, 0, nan]]",
        "nan",
        "`motion.goals[1][2]` is nan, allowed is a finite number (y_m), -1000000 to 1000000",
    );
    refused(
        "[attack]\nmotion = { kind = \"goals\", goals = [[2, 0, 0], [3, 0, 0]] }",
        "[3, 0, 0]",
        "`attack.motion.goals[1]` is robot 3, allowed is a malicious robot, one of [1, 2]",
    );
    refused(
        "[attack]\nmotion = \"goals\"",
        "\"goals\"",
        "`attack.motion` is a word without a list, allowed is for lists a table, such as { kind = \"goals\", file = \"liars.csv\" }",
    );
    refused(
        FILE,
        "\"motion.csv\"",
        "`motion.file` is motion.csv, which nobody read, allowed is a file beside a scenario file",
    );
    let away = FILE.replace("motion.csv", "../motion.csv");
    refused(
        &away,
        "\"../motion.csv\"",
        "`motion.file` is \"../motion.csv\", allowed is the name of a file beside the scenario, without a path",
    );
    let neither = problems("[motion]\nkind = \"waypoints\"");
    assert!(neither[0].to_string().contains("neither listed nor in a `file`"), "{}", neither[0]);
}

/// The kinds of a file that does what an empty one does can only stand in its comments.
#[test]
fn the_file_with_every_field_names_every_kind_of_motion() {
    let text = include_str!("../../../scenarios/everything.toml");
    for kind in ["paper", "hold", "gather", "wander", "goals", "waypoints", "velocities", "obedient", "flee"]
    {
        assert!(text.contains(&format!("\"{kind}\"")), "{kind}");
    }
}

#[test]
fn robots_and_liars_go_where_the_list_says() {
    let text = "duration_s = 4.0\n[controller]\nkind = \"none\"\n[team]\nmalicious = [2]\n\
        [motion]\nkind = \"waypoints\"\nwaypoints = [[1, 0, 0, 0], [1, 1, 0.5, 1.0], [1, 1.5, 0.5, 1.0]]\n\
        [attack]\nmotion = { kind = \"velocities\", velocities = [[2, 0.5, 1.0, 0.0], [2, 1.0, 0.0, 0.0]] }\n";
    let scenario = scenario(text).unwrap();
    let run = run(&scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap();
    let record = run.record.unwrap();
    let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9;
    let last = record.last_tick();
    assert!(near(record.point(last, 0), [0.5, 1.0]), "{:?}", record.point(last, 0));
    let [start, end] = [record.point(0, 1), record.point(last, 1)];
    assert!(near(end, [start[0] + 0.5, start[1]]), "{start:?} {end:?}");
    assert!(near(record.point(0, 2), record.point(last, 2)), "not listed");
}
