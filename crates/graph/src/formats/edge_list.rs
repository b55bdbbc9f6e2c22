//! Edge lists.

use alloc::string::String;

use super::Named;
use super::builder::Builder;
use super::error::{FormatError, WriteError};

pub(super) fn read(text: &str, directed: Option<bool>) -> Result<Named, FormatError> {
    let mut builder: Option<Builder> = None;
    let mut last = 1;
    for (index, line) in text.lines().enumerate() {
        let content = line.split('#').next().unwrap_or("").trim();
        if content.is_empty() {
            continue;
        }
        last = index + 1;
        match (&mut builder, declared(content)) {
            (None, Some(said)) => builder = Some(Builder::new(directed.unwrap_or(said))),
            (started, _) => {
                let builder = started.get_or_insert_with(|| Builder::new(directed.unwrap_or(false)));
                read_line(builder, content, last)?;
            }
        }
    }
    builder.unwrap_or_else(|| Builder::new(false)).finish_by_number(last)
}

fn declared(content: &str) -> Option<bool> {
    match content {
        "directed" => Some(true),
        "undirected" => Some(false),
        _ => None,
    }
}

fn read_line(builder: &mut Builder, content: &str, line: usize) -> Result<(), FormatError> {
    let mut words = content.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
    let Some(first) = words.next() else {
        return Err(FormatError::unexpected(line, content, "the names of two nodes"));
    };
    let from = builder.node(first, line)?;
    let Some(second) = words.next() else {
        return Ok(());
    };
    let to = builder.node(second, line)?;
    match words.next() {
        Some(weight) if !weight.starts_with('{') && weight.parse::<f64>().is_err() => {
            Err(FormatError::unexpected(line, weight, "two names, and at most a weight after them"))
        }
        _ => builder.edge(from, to, line),
    }
}

pub(super) fn write(named: &Named) -> Result<String, WriteError> {
    let graph = &named.graph;
    let mut text = String::from(if graph.is_directed() { "directed\n" } else { "undirected\n" });
    for name in &named.names {
        let unfit = |c: char| c.is_whitespace() || matches!(c, ',' | '#' | '{');
        if name.is_empty() || name.contains(unfit) {
            return Err(WriteError::Name { name: name.clone() });
        }
        text.push_str(name);
        text.push('\n');
    }
    for (from, to) in graph.edges() {
        text.extend([named.names[from].as_str(), " ", named.names[to].as_str(), "\n"]);
    }
    Ok(text)
}
