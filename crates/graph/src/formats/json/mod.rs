//! JSON: the node-link, adjacency and Cytoscape forms of networkx.
//!
//! The reader of values is ours: serde_json keeps no lines of values, and refuses the `NaN` that Python writes.

mod value;

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Write;

use super::builder::{Builder, Draft};
use super::error::FormatError;
use super::{Named, Options};
use value::{Kind, Value, parse};

const FORMS: &str =
    "an object with \"nodes\" and \"edges\", \"links\" or \"adjacency\", or with \"elements\"";

/// Whether it begins with a brace, or with a bracket that holds no tuples of Python.
pub(super) fn looks_like(text: &str) -> bool {
    text.trim_start().starts_with(['{', '['])
}

pub(super) fn read(text: &str, _: &Options<'_>) -> Result<Draft, FormatError> {
    let file = parse(text)?;
    if !matches!(file.kind, Kind::Object(_)) {
        return Err(FormatError::missing(file.line, FORMS));
    }
    let builder = Builder::new(is_directed(&file)?);
    match (file.get("elements"), file.get("adjacency")) {
        (Some(elements), _) => read_lists(builder, elements, Some("data")),
        (None, Some(adjacency)) => read_adjacency(builder, &file, adjacency),
        (None, None) => read_lists(builder, &file, None),
    }
}

fn is_directed(file: &Value) -> Result<bool, FormatError> {
    match file.get("directed") {
        None => Ok(false),
        Some(Value { kind: Kind::Bool(directed), .. }) => Ok(*directed),
        Some(other) => Err(FormatError::missing(other.line, "\"directed\": true or false")),
    }
}

fn list<'v>(
    file: &Value,
    value: Option<&'v Value>,
    allowed: &'static str,
) -> Result<&'v [Value], FormatError> {
    match value {
        Some(Value { kind: Kind::Array(items), .. }) => Ok(items),
        other => Err(FormatError::missing(other.map_or(file.line, |other| other.line), allowed)),
    }
}

/// A list of nodes and a list of edges. `inside`: the key that holds what is said of each.
fn read_lists(mut builder: Builder, file: &Value, inside: Option<&str>) -> Result<Draft, FormatError> {
    let said = |item: &'_ Value| match inside {
        Some(key) => item
            .get(key)
            .ok_or_else(|| FormatError::missing(item.line, "an element with \"data\""))
            .map(|_| ()),
        None => Ok(()),
    };
    for item in list(file, file.get("nodes"), FORMS)? {
        said(item)?;
        let node = inside.and_then(|key| item.get(key)).unwrap_or(item);
        let id = node.get("id").unwrap_or(node);
        builder.declare(name(id)?, id.line)?;
    }
    for item in list(file, file.get("edges").or(file.get("links")), FORMS)? {
        said(item)?;
        let edge = inside.and_then(|key| item.get(key)).unwrap_or(item);
        let end = |key: &str| match edge.get(key) {
            Some(end) => builder.known(name(end)?, end.line),
            None => Err(FormatError::missing(edge.line, "an edge with \"source\" and \"target\"")),
        };
        let (from, to) = (end("source")?, end("target")?);
        builder.edge(from, to, edge.line);
    }
    builder.finish(file.line)
}

/// A list of nodes, and for each of them the list of its neighbours.
fn read_adjacency(builder: Builder, file: &Value, adjacency: &Value) -> Result<Draft, FormatError> {
    let mut builder = builder.told_from_both_ends();
    let nodes = list(file, file.get("nodes"), FORMS)?;
    for node in nodes {
        let id = node.get("id").unwrap_or(node);
        builder.declare(name(id)?, id.line)?;
    }
    let lists = list(file, Some(adjacency), "a list of lists of neighbours")?;
    if lists.len() != nodes.len() {
        return Err(FormatError::missing(adjacency.line, "as many lists of neighbours as nodes"));
    }
    for (from, neighbours) in lists.iter().enumerate() {
        for neighbour in list(neighbours, Some(neighbours), "a list of neighbours")? {
            let id = neighbour.get("id").unwrap_or(neighbour);
            let to = builder.known(name(id)?, id.line)?;
            builder.edge(from, to, neighbour.line);
        }
    }
    builder.finish(file.line)
}

fn name(value: &Value) -> Result<&str, FormatError> {
    match &value.kind {
        Kind::Text(name) | Kind::Number(name) => Ok(name),
        _ => Err(FormatError::missing(value.line, "a text or a number as the name of a node")),
    }
}

pub(super) fn write(named: &Named) -> String {
    let ids: Vec<String> = named.names.iter().map(|name| id(name)).collect();
    let mut text = String::from("{\n  \"directed\": ");
    text.push_str(if named.graph.is_directed() { "true" } else { "false" });
    text.push_str(",\n  \"multigraph\": false,\n  \"graph\": {},\n  \"nodes\": [");
    for (index, id) in ids.iter().enumerate() {
        text.extend([if index == 0 { "" } else { "," }, "\n    {\"id\": ", id, "}"]);
    }
    text.push_str("\n  ],\n  \"edges\": [");
    for (index, (from, to)) in named.graph.edges().enumerate() {
        let start = if index == 0 { "" } else { "," };
        text.extend([start, "\n    {\"source\": ", &ids[from], ", \"target\": ", &ids[to], "}"]);
    }
    text.push_str("\n  ]\n}\n");
    text
}

/// A whole number as a number, anything else as a text.
fn id(name: &str) -> String {
    let plain = name == "0" || !name.starts_with('0');
    if plain && !name.is_empty() && name.len() < 16 && name.bytes().all(|byte| byte.is_ascii_digit()) {
        return String::from(name);
    }
    let mut quoted = String::from("\"");
    for c in name.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            '\u{0}'..='\u{1f}' => {
                let _ = write!(quoted, "\\u{:04x}", u32::from(c));
            }
            _ => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
