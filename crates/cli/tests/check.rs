//! `closeranks check` and `closeranks graph` as their user meets them.
#![expect(clippy::unwrap_used, clippy::format_push_string, reason = "helpers of tests")]

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};

fn closeranks(folder: &Path, arguments: &[&str], input: &[u8]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_closeranks"));
    let program = program.current_dir(folder).args(arguments);
    let piped = program.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = piped.spawn().unwrap();
    // The program may refuse its arguments before it reads.
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// What `check - ARGUMENTS` says of a graph in a pipe, and its exit code.
fn check(graph: &[u8], arguments: &[&str]) -> (String, Option<i32>) {
    let output = closeranks(Path::new("."), &[&["check", "-"], arguments].concat(), graph);
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    (text(&output.stdout), output.status.code())
}

fn make(arguments: &[&str]) -> Vec<u8> {
    let output = closeranks(Path::new("."), &[&["graph"], arguments].concat(), b"");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    output.stdout
}

fn golden() -> Vec<Value> {
    let file = include_str!("../../graph/tests/golden/robustness.json");
    let file: Value = serde_json::from_str(file).unwrap();
    file["graphs"].as_array().unwrap().clone()
}

fn edge_list(entry: &Value) -> String {
    let mut list = String::from(if entry["directed"] == true { "directed\n" } else { "undirected\n" });
    (0..entry["n"].as_u64().unwrap()).for_each(|node| list += &format!("{node}\n"));
    for edge in entry["edges"].as_array().unwrap() {
        list += &format!("{} {}\n", edge[0], edge[1]);
    }
    list
}

/// The witness breaks the definition, counted here once more.
fn is_witness(entry: &Value, witness: &Value) -> bool {
    let set = |key: &str| witness[key].as_array().unwrap().clone();
    let heard = |robot: &Value, set: &[Value]| {
        let edges = entry["edges"].as_array().unwrap().iter();
        let both = entry["directed"] == false;
        let outside = |from: &Value, to: &Value| to == robot && !set.contains(from);
        edges.filter(|edge| outside(&edge[0], &edge[1]) || (both && outside(&edge[1], &edge[0]))).count()
    };
    let r = usize::try_from(witness["r"].as_u64().unwrap()).unwrap();
    let exempt = |set: &[Value]| set.iter().filter(|robot| heard(robot, set) >= r).count();
    let (first, second) = (set("S1"), set("S2"));
    let counts = [exempt(&first), exempt(&second)];
    let disjoint =
        !first.is_empty() && !second.is_empty() && first.iter().all(|robot| !second.contains(robot));
    disjoint
        && counts[0] < first.len()
        && counts[1] < second.len()
        && ((counts[0] + counts[1]) as u64) < witness["s"].as_u64().unwrap()
}

#[test]
fn json_has_the_golden_numbers() {
    for entry in golden() {
        let (told, code) = check(edge_list(&entry).as_bytes(), &["--json"]);
        let mut found: Value = serde_json::from_str(&told).unwrap();
        let witness = found.as_object_mut().unwrap().remove("witness").unwrap();
        let read = found.as_object_mut().unwrap().remove("read").unwrap();
        let agreement = found.as_object_mut().unwrap().remove("agreement").unwrap();
        let robots = |set: &Value| set.as_array().unwrap().len();
        let groups =
            [&agreement["groups"][0], &agreement["groups"][1], &agreement["between"], &agreement["liars"]];
        assert_eq!(json!(groups.map(robots).iter().sum::<usize>()), entry["n"], "{}", entry["name"]);
        let links = entry["edges"].as_array().unwrap().len();
        let as_told = json!({
            "format": "edges", "told_by": "content", "robots": entry["n"], "links": links,
            "directed": entry["directed"], "notes": [],
        });
        assert_eq!(read, as_told, "{}", entry["name"]);
        let expected = json!({
            "n": entry["n"],
            "directed": entry["directed"],
            "r_max": entry["r_robustness"],
            "f_max": entry["F_max"],
            "s_max": entry["s_max_by_r"],
            "proved": "exactly",
        });
        assert_eq!((found, code), (expected, Some(0)), "{}", entry["name"]);
        assert!(is_witness(&entry, &witness), "{} {witness}", entry["name"]);
    }
}

#[test]
fn every_format_gives_the_same_answer() {
    let makers: [&[&str]; 3] = [
        &["petersen"],
        &["k-circulant", "10", "4", "--directed"],
        &["geometric", "11", "0.5", "--seed", "3"],
    ];
    for maker in makers {
        let numbers = |graph: &[u8], arguments: &[&str]| {
            let (told, code) = check(graph, arguments);
            let mut found: Value = serde_json::from_str(&told).unwrap();
            let read = found.as_object_mut().unwrap().remove("read").unwrap();
            (found, code, read)
        };
        let expected = numbers(&make(maker), &["--json"]);
        for format in ["edges", "matrix", "graph6", "graphml", "dot", "json"] {
            let graph = make(&[maker, &["--format", format]].concat());
            let [told, asked] =
                [&["--json"][..], &["--json", "--format", format]].map(|more| numbers(&graph, more));
            assert_eq!((&told.0, told.1), (&expected.0, expected.1), "{format} told by its content");
            assert_eq!((&asked.0, asked.1), (&expected.0, expected.1), "{format} asked for");
            assert_eq!([&told.2["told_by"], &asked.2["told_by"]], ["content", "request"]);
            assert_eq!([&told.2["format"], &asked.2["format"]], [format, format]);
        }
    }
}

#[test]
fn the_verdict_is_one_sentence_with_a_witness() {
    let (told, code) = check(b"tom bob\nbob ann\nann eve\n", &[]);
    assert_eq!(code, Some(0));
    assert_eq!(
        told,
        "Agrees if nobody lies: (1,1)-robust, proved by exhaustive search of 1 set; not any single liar: not
(2,2)-robust.
read as an edge list (by its content): 4 robots, 3 links, undirected
degrees 1 to 2, connectivity 1

r  largest s  proved by
----------------------------------------
1          2  exhaustive search of 1 set
2          0  a witness

The degree condition (every honest robot hears F + floor(n/2) = F + 2 or more) promises nothing here.
Robot tom hears 1 robot outside {tom}, and robots ann and eve hear at most 1 robot outside {ann, eve}. A robot
that discards the highest and the lowest value keeps none of these, so the two sides never agree.
Who would still agree: robots tom and bob agree on one value, robots ann and eve agree on another.
"
    );
}

#[test]
fn questions_are_answered_by_sentence_and_exit_code() {
    let tight = make(&["tight", "10", "2"]);
    let cases: [(&[&str], &str, i32); 12] = [
        (&["--F", "1"], "Yes: survives any single liar: (2,2)-robust, proved by", 0),
        (&["--F", "2"], "No: does not survive any 2 liars: not (3,3)-robust, proved by a witness.", 1),
        (&["--r", "2"], "Yes: (2,1)-robust, proved by", 0),
        (&["--r", "3", "--s", "1"], "No: not (3,1)-robust, proved by a witness.", 1),
        (&["--F", "2", "--additions"], "Add 2 edges, as few as can be, and it is (3,3)-robust:", 0),
        (&["--F", "1", "--additions"], "Nothing to add: it is (2,2)-robust.", 0),
        (&["--F", "5", "--additions"], "No edges will do: even the complete graph is not 6-robust.", 1),
        (&["--local"], "Survives liars of which no robot hears more than 1, and not more than 2.", 0),
        (&["--local", "--F", "0"], "Yes: survives liars of which no robot hears more than 0", 0),
        (&["--local", "--F", "2"], "No: does not survive liars of which no robot hears more than 2", 1),
        (
            &["--leaders", "0,1,2"],
            "Strongly 2-robust with respect to robots 0, 1 and 2, and for no larger r.",
            0,
        ),
        (&["--leaders", "0,1", "--r", "3"], "No: not strongly 3-robust with respect to robots 0 and 1", 1),
    ];
    for (arguments, sentence, code) in cases {
        let (told, found) = check(&tight, arguments);
        let told = told.replace('\n', " ");
        assert!(told.starts_with(sentence), "{arguments:?}: {told}");
        assert_eq!(found, Some(code), "{arguments:?}: {told}");
    }
}

#[test]
fn what_is_not_settled_in_time_is_said_to_be_open() {
    let graph = make(&["erdos-renyi", "60", "0.7", "--seed", "2"]);
    let (told, code) = check(&graph, &["--F", "16", "--time-limit", "0.05"]);
    assert!(told.starts_with("Undecided within 0.05 s: whether it is (17,17)-robust"), "{told}");
    assert_eq!(code, Some(1));
    let (told, code) = check(&graph, &["--json", "--time-limit", "0.05"]);
    let found: Value = serde_json::from_str(&told).unwrap();
    assert_eq!((&found["proved"], code), (&json!("bounds"), Some(1)));
    assert!(found["r_max"][0].as_i64().unwrap() < found["r_max"][1].as_i64().unwrap(), "{told}");
}

#[test]
fn bad_arguments_are_refused() {
    let long = " ".repeat(5 << 20);
    let cases: [(&[&str], &[u8], &str); 15] = [
        (
            &["check", "-", "--leaders", "x"],
            b"a b",
            "--leaders names \"x\", which is no robot of the graph; allowed are {a, b}",
        ),
        (&["check", "-", "--additions"], b"a b", "--additions to what end?"),
        (&["check", "-", "--directed"], b"digraph { a -> b }", "DOT says itself what its edges are"),
        (&["check", "-", "--every", "3"], b"a b", "--every is for recorded runs"),
        (&["check", "-", "--undirected"], b"graph { a -- b }", "--undirected is not for"),
        (&["check", "-", "--directed", "--undirected"], b"a b", "cannot be used with"),
        (
            &["check", "-", "--which", "1"],
            b"a b",
            "--which is not for `standard input`: an edge list has one graph",
        ),
        (&["check", "-", "--which", "3"], b"Bw\nBg\n", "2 graphs in the text, choose one: 1 to 2"),
        (
            &["check", "-", "--weights"],
            b"graph { a -- b }",
            "--weights is not for `standard input`, read as DOT",
        ),
        (&["check", "-"], &[0x1f, 0x8b, 0], "is compressed: allowed is text, as gunzip writes it"),
        (&["check", "-"], &[0xff, 0xff], "is not text: byte 0 is not UTF-8"),
        (&["check", "-"], b"PAR1", "the recording `standard input` cannot be read"),
        (&["check", "-"], long.as_bytes(), "no node, at least one is needed"),
        (&["check", "missing"], b"", "cannot read the graph `missing`"),
        (&["graph", "tight", "4", "9"], b"", "no such graph: f must be floor((n - 1)/2) or less"),
    ];
    for (arguments, input, message) in cases {
        let output = closeranks(Path::new("."), arguments, input);
        assert!(text(&output.stderr).contains(message), "{arguments:?}: {}", text(&output.stderr));
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    for arguments in [["--F", "128"], ["--s", "2"], ["--time-limit", "-1"], ["--r", "0"], ["--format", "png"]]
    {
        let output = closeranks(Path::new("."), &[&["check", "-"], &arguments[..]].concat(), b"a b");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
}

/// What a rule of consensus needs: yes, no with a witness, or an honest not known.
#[test]
fn rules_of_consensus_are_asked_about_by_name() {
    let (ring, complete) = (make(&["ring", "5"]), make(&["complete", "7"]));
    for (graph, arguments, begins, code) in [
        (&ring, &["--rule", "two-hop", "--F", "1"][..], "Yes: (2,2)-robust with 2 hops", 0),
        (&ring, &["--rule", "w-msr", "--F", "1"], "No: does not survive", 1),
        (&make(&["ring", "8"]), &["--rule", "two-hop", "--F", "1"], "No: not (2,2)-robust with 2 hops", 1),
        (&make(&["complete", "15"]), &["--rule", "two-hop", "--F", "1"], "Yes: (2,2)-robust with 2 hops", 0),
        (&complete, &["--rule", "sw-msr", "--F", "1"], "Yes: (3,1)-robust", 0),
        (
            &complete,
            &["--rule", "arc-p", "--F", "2"],
            "Yes: every robot hears at least 6 others, and 5 are enough",
            0,
        ),
        (
            &ring,
            &["--rule", "arc-p", "--F", "1"],
            "Not known: 3 neighbours are enough, and a robot hears 2",
            1,
        ),
        (&complete, &["--rule", "bp-msr", "--F", "1", "--leaders", "0,1,2"], "Yes: strongly 3-robust", 0),
        (&complete, &["--rule", "bp-msr", "--F", "1"], "Not known: it needs --leaders", 1),
        (&complete, &["--rule", "median", "--F", "1"], "Not known", 1),
        (&complete, &["--rule", "trust", "--F", "1"], "Not known", 1),
        (&complete, &["--rule", "linear", "--F", "1"], "No: one liar leads all", 1),
        (&complete, &["--rule", "linear", "--F", "0"], "Yes", 0),
    ] {
        let (told, exit) = check(graph, arguments);
        assert!(told.starts_with(begins), "{arguments:?}: {told}");
        assert_eq!(exit, Some(code), "{arguments:?}: {told}");
        assert!(told.contains("needs"), "{told}");
    }
    let (told, _) = check(&complete, &["--rule", "sw-msr", "--F", "2"]);
    assert!(told.contains("sufficient") && told.contains("discards 2"), "{told}");
    let refused = closeranks(Path::new("."), &["check", "-", "--rule", "w-msr"], &ring);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("--F"), "{}", text(&refused.stderr));
}

#[test]
fn the_folder_has_picture_and_page() {
    let folder = tempfile::tempdir().unwrap();
    let output = closeranks(
        folder.path(),
        &["check", "-", "--format", "edges", "-o", "out"],
        b"<a> \x1b[31m\n<a> c\n<a> c\n",
    );
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(!text(&output.stdout).contains('\u{1b}'), "names cannot steer the terminal");
    let file = |name: &str| fs::read(folder.path().join("out").join(name)).unwrap();
    assert!(file("graph.png").starts_with(b"\x89PNG"));
    assert!(text(&file("graph.svg")).contains("&lt;a&gt;"));
    let page = text(&file("report.html"));
    assert!(page.contains("read as an edge list (as --format says): 3 robots, 2 links, undirected"));
    assert!(page.contains("1 parallel link counts once"));
    assert!(page.contains("Agrees if nobody lies") && page.contains("<svg") && page.contains("largest s"));
}

fn failing_windows_name_their_sets(json: &[u8]) {
    let found: Value = serde_json::from_slice(json).unwrap();
    let failures = found["failures"].as_array().unwrap();
    let windows: u64 = failures.iter().map(|failure| failure["windows"].as_u64().unwrap()).sum();
    assert_eq!(windows, found["windows"].as_u64().unwrap() - found["robust"].as_u64().unwrap());
    assert_eq!(found["first_not_robust_tick"], failures[0]["from_tick"]);
    for failure in failures {
        let witness = &failure["witness"];
        let side = |name: &str| witness[name].as_array().unwrap().clone();
        assert!(!side("S1").is_empty() && !side("S2").is_empty() && side("exempt").is_empty(), "{witness}");
        let robots = [side("S1"), side("S2")].concat();
        assert!(robots.iter().all(|robot| (1..=11).contains(&robot.as_u64().unwrap())), "{witness}");
    }
}

#[test]
fn a_recorded_run_has_its_robustness_over_time() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("free.toml"),
        "duration_s = 3\nexpect = []\n[controller]\nkind = \"none\"\n",
    )
    .unwrap();
    let run = closeranks(folder.path(), &["run", "free.toml", "-q", "-o", "run"], b"");
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let check = |arguments: &[&str]| {
        closeranks(folder.path(), &[&["check", "run/run.parquet"], arguments].concat(), b"")
    };
    let output = check(&["-o", "out"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).starts_with("Survives any 2 liars in 19 of 31 rounds (61.2 %); least F -1"));
    assert_eq!(fs::read_to_string(folder.path().join("out/robustness.csv")).unwrap().lines().count(), 32);
    assert!(fs::read(folder.path().join("out/robustness.png")).unwrap().starts_with(b"\x89PNG"));
    let output = check(&["--F", "2", "--every", "100", "--json"]);
    assert_eq!(output.status.code(), Some(1), "asked and not always so");
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["rounds"].as_array().unwrap().len(), 7);
    assert_eq!(
        found["rounds"][0],
        json!({ "tick": 0, "time_s": 0.0, "r_max": 6, "f_max": 5, "degree_min": 10 })
    );
    assert_eq!(check(&["--r", "2"]).status.code(), Some(2));
    let windows = check(&["--rule", "sw-msr", "--window", "3", "--F", "2"]);
    assert!(text(&windows.stdout).contains("jointly 5-robust in"), "{}", text(&windows.stdout));
    let alone = check(&["--window", "3", "--F", "2"]);
    assert_eq!(text(&alone.stdout), text(&windows.stdout), "--window alone means sw-msr");
    assert!(text(&alone.stdout).contains("says nothing of W-MSR"), "{}", text(&alone.stdout));
    assert!(text(&alone.stdout).contains("All links of a window between tick"), "{}", text(&alone.stdout));
    failing_windows_name_their_sets(&check(&["--window", "3", "--F", "2", "--json"]).stdout);
    assert_eq!(check(&["--rule", "two-hop"]).status.code(), Some(2));
    assert_eq!(check(&["--hops", "2"]).status.code(), Some(2));
    let whole = fs::read(folder.path().join("run/run.parquet")).unwrap();
    for length in (4..whole.len()).step_by(whole.len() / 7) {
        let output = closeranks(folder.path(), &["check", "-"], &whole[..length]);
        assert_eq!(output.status.code(), Some(2), "cut at {length}");
    }
}

#[test]
fn every_example_of_the_help_makes_a_graph() {
    let help = text(&closeranks(Path::new("."), &["graph", "--help"], b"").stdout);
    let examples = help.lines().filter_map(|line| line.trim().strip_prefix("closeranks graph "));
    let mut count = 0;
    for example in examples.filter(|example| !example.contains('|')) {
        let arguments = example.split("  ").next().unwrap().split(' ');
        assert!(!make(&arguments.collect::<Vec<&str>>()).is_empty(), "{example}");
        count += 1;
    }
    assert_eq!(count, 26, "{help}");
}

/// What a certificate says is what was answered, and the program that wrote it is not needed to check it.
#[test]
fn a_certificate_is_written_once_and_passes_its_check() {
    let folder = tempfile::tempdir().unwrap();
    let run = |graph: &[u8], arguments: &[&str]| {
        let output = closeranks(folder.path(), &[&["check", "-", "-q"], arguments].concat(), graph);
        (text(&output.stderr), output.status.code())
    };
    for (graph, arguments, code, line) in [
        (&["complete", "7"][..], &["--F", "2"][..], 0, "robust-by-degrees 3"),
        (&["complete", "7"], &["--F", "4"], 1, "not-robust 5 5"),
        (&["complete", "7"], &["--F", "2", "--local"], 0, "ranks 2"),
        (&["wheel", "9"], &["--F", "1"], 0, "robust-by-search 2 2"),
        (&["bipartite", "6", "6"], &["--F", "1", "--local"], 0, "ranks-by-search 1"),
        (&["paley", "41"], &["--F", "8"], 0, "robust-by-eigenvalues 9 9"),
    ] {
        let all = [arguments, &["--certificate", line]].concat();
        let (errors, exit) = run(&make(graph), &all);
        assert_eq!((errors.as_str(), exit), ("", Some(code)), "{line}");
        let certificate = fs::read_to_string(folder.path().join(line)).unwrap();
        assert!(certificate.lines().any(|found| found == line), "{certificate}");
        closeranks_graph::evidence::Evidence::from_text(&certificate).unwrap().check().unwrap();
        let (errors, exit) = run(&make(graph), &all);
        assert!(errors.contains("cannot write the certificate") && exit == Some(2), "{errors}");
    }
    let (errors, exit) = run(&make(&["wheel", "9"]), &["--F", "1", "--effort", "9", "--certificate", "no"]);
    assert!(errors.contains("no certificate was written to `no`") && exit == Some(2), "{errors}");
    assert!(!folder.path().join("no").exists());
}
