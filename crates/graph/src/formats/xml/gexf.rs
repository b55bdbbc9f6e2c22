//! GEXF of Gephi.

use roxmltree::Node;

use super::{Named as _, Xml, only_child};
use crate::formats::Options;
use crate::formats::builder::{Builder, Draft};
use crate::formats::error::FormatError;

const TYPES: &str = "directed, undirected or mutual as the type of edges";

pub(in crate::formats) fn read(text: &str, _: &Options<'_>) -> Result<Draft, FormatError> {
    let xml = Xml::parse(text)?;
    let root = xml.document.root_element();
    if !root.has_tag_name_of("gexf") {
        return Err(xml.unexpected(root, root.tag_name().name(), "gexf as the first element"));
    }
    let graph = only_child(&xml, root, "graph")?;
    if graph.attribute("mode") == Some("dynamic") {
        return Err(xml.unexpected(graph, "dynamic", "a static graph, not one that changes with time"));
    }
    let both = hears_both(&xml, graph, graph.attribute("defaultedgetype").unwrap_or("undirected"))?;
    let mut builder = Builder::new(!both);
    for node in graph.descendants().filter(|child| child.has_tag_name_of("node")) {
        let number = builder.declare(xml.required(node, "id", "a node with an id")?, xml.line(node))?;
        builder.label(number, node.attribute("label").unwrap_or(""));
    }
    for edge in graph.descendants().filter(|child| child.has_tag_name_of("edge")) {
        read_edge(&xml, &mut builder, edge, both)?;
    }
    builder.finish_labelled(xml.last())
}

/// Whether both ends of edges of this type hear each other.
fn hears_both(xml: &Xml<'_>, node: Node<'_, '_>, kind: &str) -> Result<bool, FormatError> {
    match kind {
        "directed" => Ok(false),
        "undirected" | "mutual" => Ok(true),
        other => Err(xml.unexpected(node, other, TYPES)),
    }
}

fn read_edge(
    xml: &Xml<'_>,
    builder: &mut Builder,
    edge: Node<'_, '_>,
    both: bool,
) -> Result<(), FormatError> {
    let allowed = "an edge with a source and a target";
    let line = xml.line(edge);
    let from = builder.known(xml.required(edge, "source", allowed)?, line)?;
    let to = builder.known(xml.required(edge, "target", allowed)?, line)?;
    let both = match edge.attribute("type") {
        Some(kind) => hears_both(xml, edge, kind)?,
        None => both,
    };
    builder.link(from, to, both, line);
    Ok(())
}
