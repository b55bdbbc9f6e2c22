//! What `closeranks check` says of the files it reads and of those it refuses.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

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

#[test]
fn what_was_read_is_said() {
    let cases: [(&[u8], &[&str], &str); 6] = [
        (
            b"a b\nb a\n",
            &[],
            "read as an edge list (by its content): 2 robots, 1 link, undirected\nnote: 1 parallel link counts once\n",
        ),
        (
            b"# Directed graph\n1 2\n",
            &[],
            "read as an edge list (by its content): 2 robots, 1 edge, directed\n",
        ),
        (
            b"# Directed graph\n1 2\n",
            &["--undirected"],
            "2 robots, 1 link, undirected\nnote: the comment in line 1 says directed, which was overruled\n",
        ),
        (
            b"0 1 1\n0 0 0\n0 0 0\n",
            &["--directed", "--transpose"],
            "read as a matrix (by its content): 3 robots, 2 edges, directed\nin-degrees 0 to 2",
        ),
        (
            b"0 1 1\n0 0 0\n0 0 0\n",
            &["--directed"],
            "read as a matrix (by its content): 3 robots, 2 edges, directed\nin-degrees 0 to 1",
        ),
        (
            b"\xff\xfea\0 \0b\0\n\0",
            &[],
            "read as an edge list (by its content): 2 robots, 1 link, undirected\n",
        ),
    ];
    for (graph, arguments, line) in cases {
        let told = text(&closeranks(Path::new("."), &[&["check", "-"], arguments].concat(), graph).stdout);
        assert!(told.contains(line), "{told}");
    }
}

/// Name of a file, what is in it, arguments, and how the message begins.
type Bad = (&'static str, &'static str, &'static [&'static str], &'static str);

const BAD: [Bad; 10] = [
    (
        "a.edges",
        "a b\nb b\n",
        &["--strict"],
        "error: loop: \"b\" would hear itself\n --> a.edges:2:1\n  |\n2 | b b\n  | ^^^\n",
    ),
    (
        "a.edges",
        "a b\n\nb a\n",
        &["--strict"],
        "error: edge from \"b\" to \"a\" appears twice\n --> a.edges:3:1\n",
    ),
    ("a.csv", "0,1,0\n0,0,0\n0,0,0\n", &[], "error: row 0 column 1 is a link but row 1 column 0 is not"),
    // The second 7 is marked, not the one within 17.
    (
        "a.edges",
        "17 b 7 x\n",
        &[],
        "error: found \"x\", expected two names, and at most a weight after them\n",
    ),
    (
        "a.csv",
        "0,7,0\n7,0,0\n0,0,0\n",
        &[],
        "error: found \"7\", expected 0 or 1, or that weights are asked for: then any number but 0 is a link\n --> a.csv:1:3\n  |\n1 | 0,7,0\n  |   ^\n",
    ),
    (
        "a.dot",
        "graph {\n a -> b }",
        &[],
        "error: found \"->\", expected -> in a digraph, -- in a graph\n --> a.dot:2:4\n",
    ),
    (
        "a.json",
        "{\"nodes\": [1],\n\"edges\": [{\"source\": 1, \"target\": 3}]}",
        &[],
        "error: no node is named \"3\"\n",
    ),
    ("a.txt", "", &[], "error: a.txt:1: no node, at least one is needed\n"),
    (
        "a.adjlist",
        "3 2\n0 1\n1 2\n",
        &[],
        "error: the text may be an edge list or an edge list after a line of counts, which are different graphs: expected the format edges or counted-edges\n",
    ),
    (
        "a.edges",
        "0 1\r1 2 3\r",
        &[],
        "error: 3 columns, but 2 in line 1: expected as many in every line of an edge list\n --> a.edges:2:1\n  |\n2 | 1 2 3\n",
    ),
];

#[test]
fn bad_graphs_are_refused_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    for (name, graph, arguments, message) in BAD {
        refused(folder.path(), name, graph, arguments, message);
    }
    let many: String =
        (0..129).fold("undirected\n".into(), |list: String, node| list + &format!("n{node}\n"));
    let message = "error: --output is for graphs of up to 128 robots, and `a.edges` has 129";
    refused(folder.path(), "a.edges", &many, &[], message);
}

/// With exit code 2, and nothing is written.
fn refused(folder: &Path, name: &str, graph: &str, arguments: &[&str], message: &str) {
    fs::write(folder.join(name), graph).unwrap();
    let output = closeranks(folder, &[&["check", name, "-o", "out"], arguments].concat(), b"");
    assert!(text(&output.stderr).starts_with(message), "{}", text(&output.stderr));
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty() && !folder.join("out").exists());
}
