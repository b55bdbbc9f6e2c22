//! GraphML.

use alloc::string::String;
use alloc::vec::Vec;

use super::Named;
use super::builder::Builder;
use super::error::{FormatError, WriteError};
use super::xml::{Tag, Tags, escape};

pub(super) fn read(text: &str) -> Result<Named, FormatError> {
    let mut tags = Tags::new(text);
    let mut builder: Option<Builder> = None;
    // An edge may stand before its nodes.
    let mut edges: Vec<Tag<'_>> = Vec::new();
    while let Some(tag) = tags.next()? {
        match (tag.name, &mut builder) {
            ("graph", None) => builder = Some(Builder::new(is_directed(&tag)?)),
            ("graph" | "hyperedge", Some(_)) => {
                return Err(FormatError::unexpected(tag.line, tag.name, "one graph of nodes and edges"));
            }
            ("node", Some(builder)) => {
                builder.declare(&tag.required("id", "a node with an id")?, tag.line)?;
            }
            ("edge", Some(_)) => edges.push(tag),
            _ => {}
        }
    }
    let Some(mut builder) = builder else {
        return Err(FormatError::unexpected(tags.line, "", "a graph element"));
    };
    for tag in edges {
        read_edge(&mut builder, &tag)?;
    }
    builder.finish(tags.line)
}

fn is_directed(tag: &Tag<'_>) -> Result<bool, FormatError> {
    match tag.attribute("edgedefault")?.as_deref() {
        Some("directed") => Ok(true),
        Some("undirected") => Ok(false),
        other => Err(FormatError::unexpected(
            tag.line,
            other.unwrap_or("graph"),
            "edgedefault=\"directed\" or \"undirected\"",
        )),
    }
}

fn read_edge(builder: &mut Builder, tag: &Tag<'_>) -> Result<(), FormatError> {
    let allowed = "an edge with a source and a target";
    let from = builder.known(&tag.required("source", allowed)?, tag.line)?;
    let to = builder.known(&tag.required("target", allowed)?, tag.line)?;
    let own = tag.attribute("directed")?;
    let same = if builder.is_directed() { "true" } else { "false" };
    match own {
        Some(value) if value != same => {
            Err(FormatError::unexpected(tag.line, &value, "edges that are all directed or all undirected"))
        }
        _ => builder.edge(from, to, tag.line),
    }
}

pub(super) fn write(named: &Named) -> Result<String, WriteError> {
    let directed = named.graph.is_directed();
    let mut names = Vec::new();
    for name in &named.names {
        // XML has no way at all to write these.
        if name.contains(|c: char| c.is_control() && !matches!(c, '\n' | '\r' | '\t')) {
            return Err(WriteError::Name { name: name.clone() });
        }
        names.push(escape(name));
    }
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    text.push_str("<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n  <graph edgedefault=\"");
    text.push_str(if directed { "directed\">\n" } else { "undirected\">\n" });
    for name in &names {
        text.extend(["    <node id=\"", name, "\"/>\n"]);
    }
    for (from, to) in named.graph.edges() {
        text.extend(["    <edge source=\"", &names[from], "\" target=\"", &names[to], "\"/>\n"]);
    }
    text.push_str("  </graph>\n</graphml>\n");
    Ok(text)
}
