//! The data set in docs/data: what it says of its graphs is true, and the example makes it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeMap;
use std::fs;

use closeranks_graph::bounds;
use closeranks_graph::definition::Witness;
use closeranks_graph::formats::{Format, Options, read};
use closeranks_graph::graph::Graph;
use closeranks_graph::graph::set::NodeSet;

#[path = "../examples/dataset/recipes.rs"]
mod recipes;
#[path = "../examples/dataset/row.rs"]
mod row;

/// Up to so many nodes rows are made anew.
const NODES: usize = 12;

fn lines() -> Vec<String> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/data/robustness.csv");
    let text = fs::read_to_string(path).unwrap();
    assert_eq!(text.lines().next(), Some(row::HEAD));
    text.lines().skip(1).map(str::to_owned).collect()
}

fn columns(line: &str) -> BTreeMap<&'static str, String> {
    row::HEAD.split(',').zip(line.split(',').map(str::to_owned)).collect()
}

#[test]
fn rows_of_small_graphs_come_out_again() {
    let (lines, recipes) = (lines(), recipes::recipes());
    assert_eq!(lines.len(), recipes.len());
    for (line, recipe) in lines.iter().zip(&recipes) {
        assert!(line.starts_with(&format!("{},", recipe.command)), "{line}");
        if recipe.graph.node_count() <= NODES {
            assert_eq!(*line, row::row(recipe));
        }
    }
}

#[test]
fn every_row_has_its_graph_and_its_witnesses_hold() {
    for (line, recipe) in lines().iter().zip(recipes::recipes()) {
        let columns = columns(line);
        let number = |name: &str| columns[name].parse::<i32>().unwrap();
        let text = format!("{}\n", columns["graph6"]);
        let asked = Options { format: Some(Format::Graph6), ..Options::default() };
        let graph = read(&text, &asked).unwrap().named.graph;
        assert_eq!(graph, recipe.graph, "{line}");
        if number("r_least") == number("r_most") {
            refuted(&graph, number("r_least") + 1, 1, [&columns["r_S1"], &columns["r_S2"]]);
        }
        if number("F_least") == number("F_most") {
            let r = number("F_least") + 2;
            refuted(&graph, r, r, [&columns["F_S1"], &columns["F_S2"]]);
        }
        if columns["proof_r"] == "degrees" {
            assert!(bounds::r_least(&graph) >= usize::try_from(number("r_least")).unwrap(), "{line}");
        }
        assert!(number("F_local_least") <= number("F_local_most"), "{line}");
        assert!(number("F_local_most") <= number("F_most") && number("F_most") < number("r_most"), "{line}");
    }
}

fn refuted(graph: &Graph, r: i32, s: i32, sides: [&String; 2]) {
    let set = |text: &String| -> NodeSet { text.split(' ').map(|node| node.parse().unwrap()).collect() };
    let [r, s] = [r, s].map(|value| usize::try_from(value).unwrap());
    let [first, second] = sides.map(set);
    assert!(Witness::new(graph, r, s, first, second).holds(graph), "({r}, {s}) {graph:?}");
}
