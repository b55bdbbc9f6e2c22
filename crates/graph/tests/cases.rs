//! Small files that people have, and what is right for each: read as the graph it says, or refused.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::fs;
use std::path::Path;

use closeranks_graph::analysis::analyze;
use closeranks_graph::effort::Effort;
use closeranks_graph::formats::{Options, Reading, read};
use core::ops::ControlFlow;

/// A line of `cases.tsv`.
struct Case<'a> {
    fields: Vec<&'a str>,
}

impl Case<'_> {
    fn read(&self) -> Result<Reading, String> {
        let [name, given_as, arguments] = [self.fields[1], self.fields[2], self.fields[3]];
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
        let text = fs::read_to_string(folder.join(name)).unwrap();
        let ending = Path::new(name).extension().and_then(|ending| ending.to_str());
        let options = Options {
            ending: ending.filter(|_| given_as == "file"),
            directed: (arguments == "--directed").then_some(true),
            ..Options::default()
        };
        read(&text, &options).map_err(|error| error.to_string())
    }
}

/// `directed robots r_max f_max s_max`, as the columns of the table have them.
fn answer(reading: &Reading) -> [String; 5] {
    let graph = &reading.named.graph;
    let analysis = analyze(graph, &Effort::UNLIMITED, &mut |_| ControlFlow::Continue(()));
    let mut s_max = Vec::new();
    for (index, (s, _)) in analysis.s_max.iter().enumerate() {
        s_max.push(format!("{}:{}", index + 1, s.exactly().unwrap()));
    }
    [
        String::from(if graph.is_directed() { "directed" } else { "undirected" }),
        graph.node_count().to_string(),
        analysis.r_max.exactly().unwrap().to_string(),
        analysis.f_max.exactly().unwrap().to_string(),
        s_max.join(","),
    ]
}

#[test]
fn every_file_is_read_as_what_it_is() {
    let table = include_str!("cases/cases.tsv");
    let cases: Vec<Case<'_>> =
        table.lines().skip(1).map(|line| Case { fields: line.split('\t').collect() }).collect();
    assert!(cases.len() > 20);
    for case in cases {
        let found = case.read();
        if case.fields[5] == "refusal" {
            assert!(found.is_err(), "{}: {found:?}", case.fields[1]);
            continue;
        }
        let reading = found.unwrap_or_else(|error| panic!("{}: {error}", case.fields[1]));
        assert_eq!(answer(&reading).as_slice(), &case.fields[4..9], "{}", case.fields[1]);
    }
}
