//! Reads the files named on standard input, one a line, and prints each graph as a line of JSON: for tests against the
//! writers of other programs (`tests/writers`). Behind a tab a line may have the words `directed` and `weights`.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a program for tests")]

use std::fs;
use std::io::{self, BufRead as _};
use std::path::Path;

use closeranks_graph::formats::{Options, read};
use serde_json::{Value, json};

fn main() {
    for line in io::stdin().lock().lines() {
        println!("{}", answer(&line.unwrap()));
    }
}

fn answer(line: &str) -> Value {
    let (path, words) = line.split_once('\t').unwrap_or((line, ""));
    let asked = |word: &str| words.split(' ').any(|said| said == word);
    let Ok(text) = String::from_utf8(fs::read(path).unwrap()) else {
        return json!({ "error": "not UTF-8" });
    };
    let options = Options {
        ending: Path::new(path).extension().and_then(|ending| ending.to_str()),
        directed: asked("directed").then_some(true),
        weights: asked("weights"),
        ..Options::default()
    };
    match read(&text, &options) {
        Ok(reading) => {
            let names = &reading.named.names;
            let edge = |(from, to): (usize, usize)| json!([names[from], names[to]]);
            json!({
                "format": reading.format.name(),
                "directed": reading.named.graph.is_directed(),
                "nodes": names,
                "edges": reading.named.graph.edges().map(edge).collect::<Vec<Value>>(),
            })
        }
        Err(error) => json!({ "error": error.to_string() }),
    }
}
