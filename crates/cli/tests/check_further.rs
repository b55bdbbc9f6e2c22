//! `closeranks check` over several hops, within a count of sets, and of liars that are few in every neighbourhood.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::io::Write as _;
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};

fn closeranks(arguments: &[&str], input: &[u8]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_closeranks"));
    let piped = program.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = piped.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input).unwrap();
    child.wait_with_output().unwrap()
}

/// What `check - ARGUMENTS` says of a graph in a pipe, and its exit code.
fn check(graph: &[u8], arguments: &[&str]) -> (String, Option<i32>) {
    let output = closeranks(&[&["check", "-"], arguments].concat(), graph);
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    (String::from_utf8(output.stdout).unwrap(), output.status.code())
}

fn make(arguments: &[&str]) -> Vec<u8> {
    let output = closeranks(&[&["graph"], arguments].concat(), b"");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// The count ends a search at one place, whatever the number of threads; a clock is not asked.
#[test]
fn a_count_of_sets_ends_a_search_at_the_same_place() {
    let graph = make(&["erdos-renyi", "40", "0.7", "--seed", "2"]);
    let told = |threads: &str| check(&graph, &["--json", "--effort", "9000", "--threads", threads]);
    let alone = told("1");
    assert_eq!(alone.1, Some(1));
    assert_eq!(told("3"), alone);
    let (said, code) = check(&graph, &["--F", "9", "--effort", "3000"]);
    assert!(said.starts_with("Undecided within 3000 sets: whether it is (10,10)-robust"), "{said}");
    assert_eq!(code, Some(1));
}

#[test]
fn several_hops_are_asked_for_by_number() {
    let (ring, grid) = (make(&["ring", "5"]), make(&["grid", "8", "8"]));
    let cases: [(&[u8], &[&str], &str, i32); 6] = [
        (&ring, &["--hops", "1", "--F", "1"], "No: not (2,2)-robust with 1 hop for any liar on the way", 1),
        (&ring, &["--hops", "2", "--F", "1"], "Yes: (2,2)-robust with 2 hops for any liar on the way", 0),
        (&ring, &["--hops", "2", "--r", "1", "--s", "2"], "Yes: (1,2)-robust with 2 hops", 0),
        (&ring, &["--hops", "2"], "Survives any single liar over 2 hops; not any 2 liars.", 0),
        (&grid, &["--hops", "5", "--F", "2"], "No: not (3,3)-robust with 5 hops", 1),
        (&grid, &["--hops", "2", "--F", "0"], "Yes: (1,1)-robust with 2 hops", 0),
    ];
    for (graph, arguments, begins, code) in cases {
        let (told, found) = check(graph, arguments);
        assert!(told.starts_with(begins), "{arguments:?}: {told}");
        assert_eq!(found, Some(code), "{arguments:?}: {told}");
    }
    let (told, _) = check(&ring, &["--hops", "1", "--F", "1", "--json"]);
    let found: Value = serde_json::from_str(&told).unwrap();
    assert_eq!(found["question"], json!({ "hops": 1, "r": 2, "s": 2, "liars": 1 }));
    assert!(found["witness"]["S1"].is_array() && found["witness"]["reached"].is_array(), "{told}");
}

/// F liars in all are few in every neighbourhood, so that far more than twelve robots are answered where they are too many.
#[test]
fn local_liars_are_answered_for_large_graphs_too() {
    let (told, code) = check(&make(&["ring", "40"]), &["--local"]);
    assert!(told.starts_with("Agrees if nobody lies; not if robots hear a single liar each."), "{told}");
    assert_eq!(code, Some(0));
}
