//! JSON in the node-link form of networkx.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Write;

use super::Named;
use super::builder::Builder;
use super::error::FormatError;
use super::json_value::{Kind, Value, parse};

pub(super) fn read(text: &str) -> Result<Named, FormatError> {
    let file = parse(text)?;
    if !matches!(file.kind, Kind::Object(_)) {
        return Err(FormatError::unexpected(file.line, "", "an object with \"nodes\" and \"edges\""));
    }
    let mut builder = Builder::new(is_directed(&file)?);
    for node in list(&file, file.get("nodes"), "a list of \"nodes\"")? {
        let id = node.get("id").unwrap_or(node);
        builder.declare(name(id)?, id.line)?;
    }
    for edge in list(&file, file.get("edges").or(file.get("links")), "a list of \"edges\" or \"links\"")? {
        let end = |key: &str| match edge.get(key) {
            Some(end) => builder.known(name(end)?, end.line),
            None => Err(FormatError::unexpected(edge.line, "", "an edge with \"source\" and \"target\"")),
        };
        let (from, to) = (end("source")?, end("target")?);
        builder.edge(from, to, edge.line)?;
    }
    builder.finish(file.line)
}

fn is_directed(file: &Value) -> Result<bool, FormatError> {
    match file.get("directed") {
        None => Ok(false),
        Some(Value { kind: Kind::Bool(directed), .. }) => Ok(*directed),
        Some(other) => Err(FormatError::unexpected(other.line, "", "\"directed\": true or false")),
    }
}

fn list<'v>(
    file: &Value,
    value: Option<&'v Value>,
    allowed: &'static str,
) -> Result<&'v [Value], FormatError> {
    match value {
        Some(Value { kind: Kind::Array(items), .. }) => Ok(items),
        other => Err(FormatError::unexpected(other.map_or(file.line, |other| other.line), "", allowed)),
    }
}

fn name(value: &Value) -> Result<&str, FormatError> {
    match &value.kind {
        Kind::Text(name) | Kind::Number(name) => Ok(name),
        _ => Err(FormatError::unexpected(value.line, "", "a text or a number as the name of a node")),
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
