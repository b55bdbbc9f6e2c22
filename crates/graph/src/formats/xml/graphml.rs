//! GraphML.

use alloc::string::String;
use alloc::vec::Vec;

use roxmltree::Node;

use super::{Named as _, Xml, escape, only_child, truth};
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::{FormatError, WriteError};
use crate::formats::{Named, Options};

pub(in crate::formats) fn read(text: &str, _: &Options<'_>) -> Result<Draft, FormatError> {
    let xml = Xml::parse(text)?;
    let root = xml.document.root_element();
    let graph = match root.tag_name().name() {
        "graph" => root,
        "graphml" => only_child(&xml, root, "graph")?,
        other => return Err(xml.unexpected(root, other, "graphml or gexf as the first element")),
    };
    let mut builder = Builder::new(is_directed(&xml, graph)?);
    for child in graph.descendants().filter(|child| child.id() != graph.id()) {
        let other = child.has_tag_name_of("graph") || child.has_tag_name_of("hyperedge");
        if other {
            return Err(xml.unexpected(child, child.tag_name().name(), "one graph of nodes and edges"));
        }
    }
    for node in graph.children().filter(|child| child.has_tag_name_of("node")) {
        builder.declare(xml.required(node, "id", "a node with an id")?, xml.line(node))?;
    }
    for edge in graph.children().filter(|child| child.has_tag_name_of("edge")) {
        read_edge(&xml, &mut builder, edge)?;
    }
    builder.finish(xml.last())
}

fn is_directed(xml: &Xml<'_>, graph: Node<'_, '_>) -> Result<bool, FormatError> {
    const ALLOWED: &str = "edgedefault=\"directed\" or \"undirected\"";
    match graph.attribute("edgedefault") {
        Some("directed") => Ok(true),
        Some("undirected") => Ok(false),
        Some(other) => Err(xml.unexpected(graph, other, ALLOWED)),
        None => Err(FormatError::missing(xml.line(graph), ALLOWED)),
    }
}

fn read_edge(xml: &Xml<'_>, builder: &mut Builder, edge: Node<'_, '_>) -> Result<(), FormatError> {
    let allowed = "an edge with a source and a target";
    let line = xml.line(edge);
    let from = builder.known(xml.required(edge, "source", allowed)?, line)?;
    let to = builder.known(xml.required(edge, "target", allowed)?, line)?;
    let directed = match edge.attribute("directed") {
        Some(value) => truth(xml, edge, value)?,
        None => builder.is_directed(),
    };
    builder.link(from, to, !directed, line);
    Ok(())
}

pub(in crate::formats) fn write(named: &Named) -> Result<String, WriteError> {
    let directed = named.graph.is_directed();
    let mut names = Vec::new();
    for name in &named.names {
        // XML has no way at all to write these.
        let unfit = |c: char| c.is_control() && !matches!(c, '\n' | '\r' | '\t' | '\u{7f}'..='\u{9f}');
        if name.contains(|c: char| unfit(c) || matches!(c, '\u{fffe}' | '\u{ffff}')) {
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
