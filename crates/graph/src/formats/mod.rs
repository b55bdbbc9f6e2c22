//! Graphs as text: six formats, read and written. No files here: text in, text out.
//!
//! In every format a directed edge u → v means that v hears u. Nodes keep their names; a node's number is its place in
//! the file, or its rank if all names are whole numbers and the format has no list of nodes.

mod builder;
mod dot;
mod dot_token;
mod edge_list;
mod error;
mod graph6;
mod graphml;
mod json;
mod json_value;
mod matrix;
mod xml;

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::graph::Graph;
pub use error::{FormatError, Problem, WriteError};

/// Longest text that is read, bytes.
pub const TEXT_LIMIT: usize = 1 << 22;

/// Longest name of a node, bytes.
pub const NAME_LIMIT: usize = 256;

/// A graph whose nodes have names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// The graph.
    pub graph: Graph,
    /// The name of each node, all different.
    pub names: Vec<String>,
}

impl From<Graph> for Named {
    /// Nodes named by their numbers.
    fn from(graph: Graph) -> Self {
        let names = (0..graph.node_count()).map(|node| node.to_string()).collect();
        Self { graph, names }
    }
}

/// How a graph is written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// One edge `u v` a line, or a single node; `#` begins a comment; a line `directed` or `undirected` may come first.
    /// Names are separated by blanks, tabs or commas. A number or `{…}` after the two names (a weight) is passed over.
    EdgeList,
    /// Rows of 0 and 1: row u, column v is the edge u → v. A line `directed` may come first.
    Matrix,
    /// graph6 for undirected graphs and digraph6 for directed ones, as nauty and networkx have them.
    Graph6,
    /// GraphML: `graph`, `node` and `edge` elements; the rest is passed over.
    GraphMl,
    /// DOT of Graphviz, without subgraphs.
    Dot,
    /// JSON in networkx's node-link form; edges are listed under `edges` or `links`.
    Json,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 6] =
        [Self::EdgeList, Self::Matrix, Self::Graph6, Self::GraphMl, Self::Dot, Self::Json];

    /// The usual ending of a file's name, without the dot.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::EdgeList => "edges",
            Self::Matrix => "csv",
            Self::Graph6 => "g6",
            Self::GraphMl => "graphml",
            Self::Dot => "dot",
            Self::Json => "json",
        }
    }

    /// The format of a file with this ending, if it tells.
    #[must_use]
    pub fn from_extension(extension: &str) -> Option<Self> {
        match extension.to_ascii_lowercase().as_str() {
            "edges" | "edgelist" | "el" | "txt" => Some(Self::EdgeList),
            "csv" | "mat" => Some(Self::Matrix),
            "g6" | "graph6" | "d6" => Some(Self::Graph6),
            "graphml" | "xml" => Some(Self::GraphMl),
            "dot" | "gv" => Some(Self::Dot),
            "json" => Some(Self::Json),
            _ => None,
        }
    }

    /// The format that `text` looks like; [`Format::EdgeList`] if nothing else fits.
    #[must_use]
    pub fn guess(text: &str) -> Self {
        let start = text.trim_start();
        let word = start.split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or("");
        match start.as_bytes().first() {
            // A line of graph6 may begin with a brace, but no other format has its bytes alone.
            _ if graph6::looks_like(start) => Self::Graph6,
            Some(b'<') => Self::GraphMl,
            Some(b'{') => Self::Json,
            Some(b'>' | b'&') => Self::Graph6,
            _ if matches!(word, "graph" | "digraph" | "strict") || start.starts_with("//") => Self::Dot,
            _ if matrix::looks_like(text) => Self::Matrix,
            _ => Self::EdgeList,
        }
    }
}

/// Reads the graph that `text` holds.
///
/// `directed` decides for the two formats that may not say it themselves, edge list and matrix; `None` means what the text says,
/// and undirected if it says nothing. At most [`TEXT_LIMIT`] bytes and 128 nodes.
pub fn read(text: &str, format: Format, directed: Option<bool>) -> Result<Named, FormatError> {
    if text.len() > TEXT_LIMIT {
        return Err(FormatError { line: 1, problem: Problem::TextTooLong { bytes: text.len() } });
    }
    match format {
        Format::EdgeList => edge_list::read(text, directed),
        Format::Matrix => matrix::read(text, directed),
        Format::Graph6 => graph6::read(text),
        Format::GraphMl => graphml::read(text),
        Format::Dot => dot::read(text),
        Format::Json => json::read(text),
    }
}

/// Writes `named` down. What is written reads back as the same graph; matrix and graph6 have no place for names.
pub fn write(named: &Named, format: Format) -> Result<String, WriteError> {
    match format {
        Format::EdgeList => edge_list::write(named),
        Format::Matrix => Ok(matrix::write(&named.graph)),
        Format::Graph6 => Ok(graph6::write(&named.graph)),
        Format::GraphMl => graphml::write(named),
        Format::Dot => Ok(dot::write(named)),
        Format::Json => Ok(json::write(named)),
    }
}
