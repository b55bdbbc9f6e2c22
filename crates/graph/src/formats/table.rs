//! The one table of formats: what each is called, how it is recognised, who reads and writes it.

use alloc::string::String;

use super::builder::Draft;
use super::error::{FormatError, WriteError};
use super::{Named, Options, adjacency, bits, dot, gml, json, matrix, sections, text, xml};

/// How a graph is written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Format {
    /// Rows of 0 and 1: row u, column v is the edge u → v. A line `directed` may come first; names may stand at the head of
    /// columns and rows. The diagonal does not count.
    Matrix,
    /// One edge `u v` a line; `#` and `%` begin comments. Names are separated by blanks, tabs, commas or semicolons; an arrow
    /// may stand between them, and a number or `{…}` (a weight) after them. After a first line `directed` or `undirected`
    /// a line may also be a single node.
    EdgeList,
    /// An edge list after a line with the numbers of nodes and links.
    CountedEdges,
    /// Edges as Python prints them: `[(0, 1), (1, 2)]`.
    Tuples,
    /// A node and its neighbours a line, as `networkx.write_adjlist` has them.
    Adjacency,
    /// A node and its number of neighbours, then one of them a line: `networkx.write_multiline_adjlist`.
    MultilineAdjacency,
    /// METIS: a line of counts, then the neighbours of node 1, 2, … a line.
    Metis,
    /// Large Graph Layout: `# node`, then its neighbours, one a line.
    Lgl,
    /// Trivial Graph Format of yEd: nodes with labels, a line `#`, edges.
    Tgf,
    /// graph6 and sparse6 for undirected graphs, digraph6 for directed ones; one graph a line.
    Graph6,
    /// MatrixMarket, coordinates and arrays: row u, column v is the edge u → v.
    MatrixMarket,
    /// DIMACS and PACE: `p edge n m`, then `e u v`, `a u v` (directed) or `u v` a line.
    Dimacs,
    /// Pajek: `*Vertices`, `*Edges`, `*Arcs`, and the lists of both.
    Pajek,
    /// LEDA's native format.
    Leda,
    /// GML: `graph [ node [ id 0 ] edge [ source 0 target 1 ] ]`.
    Gml,
    /// GraphML: `graph`, `node` and `edge` elements; the rest is passed over.
    GraphMl,
    /// GEXF of Gephi.
    Gexf,
    /// DOT of Graphviz.
    Dot,
    /// JSON in networkx's node-link, adjacency or Cytoscape form; links may be listed under `edges` or `links`.
    Json,
}

/// A reader: the graph of a text, or what is wrong with it. Lines end in `\n` alone.
pub(super) type Read = fn(&str, &Options<'_>) -> Result<Draft, FormatError>;

/// How a graph is written.
#[derive(Clone, Copy)]
pub(super) enum Write {
    /// Not at all: the format is only read.
    Never,
    /// Whatever its names are.
    Always(fn(&Named) -> String),
    /// If its names can be written down.
    Names(fn(&Named) -> Result<String, WriteError>),
}

/// Whether a text could be of a format.
pub(super) type LooksLike = fn(&str) -> bool;

/// How a format is recognised.
#[derive(Clone, Copy)]
pub(super) enum Sign {
    /// By something that no other format has. Asked in the order of the table, before all shapes.
    Own(LooksLike),
    /// Only by its shape, which another format may have too. `settles`: the ending of the name is used for nothing else, so
    /// that it decides between formats that the content allows.
    Shape { looks_like: LooksLike, settles: bool },
}

/// All that is known about a format.
pub(super) struct Row {
    pub(super) format: Format,
    /// What users call it.
    pub(super) name: &'static str,
    /// In a sentence, after "read as".
    pub(super) title: &'static str,
    /// Endings of file names, the usual one first.
    pub(super) endings: &'static [&'static str],
    /// Whether a text may leave open which direction there is.
    pub(super) open: bool,
    pub(super) sign: Sign,
    pub(super) read: Read,
    pub(super) write: Write,
}

impl Row {
    /// A format that is read only, and that nothing else looks like.
    const fn new(format: Format, name: &'static str, title: &'static str, read: Read, sign: Sign) -> Self {
        Self { format, name, title, endings: &[], open: false, sign, read, write: Write::Never }
    }

    const fn endings(mut self, endings: &'static [&'static str]) -> Self {
        self.endings = endings;
        self
    }

    const fn open(mut self) -> Self {
        self.open = true;
        self
    }

    const fn written(mut self, write: Write) -> Self {
        self.write = write;
        self
    }
}

/// A format that only its shape tells, and whose ending is used for others too.
const fn shape(looks_like: LooksLike) -> Sign {
    Sign::Shape { looks_like, settles: false }
}

/// A format that only its shape tells, and whose ending no other format has.
const fn known_ending(looks_like: LooksLike) -> Sign {
    Sign::Shape { looks_like, settles: true }
}

use Format as F;
use Sign::Own;

/// One row a format, in the order of [`Format`]. Of two that read the same graph the first is named.
pub(super) static ROWS: [Row; Format::ALL.len()] = [
    Row::new(F::Matrix, "matrix", "a matrix", matrix::read, shape(matrix::looks_like))
        .endings(&["csv", "mat", "tsv"])
        .open()
        .written(Write::Always(matrix::write)),
    Row::new(F::EdgeList, "edges", "an edge list", text::edge_list::read, shape(text::edge_list::looks_like))
        .endings(&["edges", "edgelist", "el", "ncol", "txt", "csv", "tsv"])
        .open()
        .written(Write::Names(text::edge_list::write)),
    Row::new(
        F::CountedEdges,
        "counted-edges",
        "an edge list after a line of counts",
        text::counted::read,
        shape(text::counted::looks_like),
    )
    .open(),
    Row::new(F::Tuples, "tuples", "tuples of Python", text::tuples::read, Own(text::tuples::looks_like))
        .open(),
    Row::new(
        F::Adjacency,
        "adjacency",
        "an adjacency list",
        adjacency::plain::read,
        known_ending(adjacency::plain::looks_like),
    )
    .endings(&["adjlist", "adj"])
    .open(),
    Row::new(
        F::MultilineAdjacency,
        "multiline-adjacency",
        "an adjacency list of many lines",
        adjacency::multiline::read,
        known_ending(adjacency::multiline::looks_like),
    )
    .endings(&["multiline_adjlist", "madjlist"])
    .open(),
    Row::new(F::Metis, "metis", "METIS", adjacency::metis::read, known_ending(adjacency::metis::looks_like))
        .endings(&["graph", "metis"]),
    Row::new(F::Lgl, "lgl", "LGL", adjacency::lgl::read, known_ending(adjacency::lgl::looks_like))
        .endings(&["lgl"]),
    Row::new(F::Tgf, "tgf", "TGF", sections::tgf::read, known_ending(sections::tgf::looks_like))
        .endings(&["tgf"])
        .open(),
    Row::new(F::Graph6, "graph6", "graph6", bits::read, Own(bits::looks_like))
        .endings(&["g6", "graph6", "d6", "s6", "sparse6"])
        .written(Write::Always(bits::write)),
    Row::new(
        F::MatrixMarket,
        "matrix-market",
        "MatrixMarket",
        matrix::market::read,
        Own(matrix::market::looks_like),
    )
    .endings(&["mtx", "mm"])
    .open(),
    Row::new(F::Dimacs, "dimacs", "DIMACS", sections::dimacs::read, Own(sections::dimacs::looks_like))
        .endings(&["col", "gr", "dimacs", "max"]),
    Row::new(F::Pajek, "pajek", "Pajek", sections::pajek::read, Own(sections::pajek::looks_like))
        .endings(&["net", "paj", "pajek"]),
    Row::new(F::Leda, "leda", "LEDA", sections::leda::read, Own(sections::leda::looks_like))
        .endings(&["leda", "lgr", "gw"]),
    Row::new(F::Gml, "gml", "GML", gml::read, Own(gml::looks_like)).endings(&["gml"]),
    Row::new(F::GraphMl, "graphml", "GraphML", xml::graphml::read, Own(xml::looks_like_graphml))
        .endings(&["graphml", "xml"])
        .written(Write::Names(xml::graphml::write)),
    Row::new(F::Gexf, "gexf", "GEXF", xml::gexf::read, Own(xml::looks_like_gexf)).endings(&["gexf"]),
    Row::new(F::Dot, "dot", "DOT", dot::read, Own(dot::looks_like))
        .endings(&["dot", "gv"])
        .written(Write::Always(dot::write)),
    Row::new(F::Json, "json", "JSON", json::read, Own(json::looks_like))
        .endings(&["json"])
        .written(Write::Always(json::write)),
];

/// What is known about a format.
pub(super) fn row(format: Format) -> &'static Row {
    &ROWS[format as usize]
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 19] = [
        Self::Matrix,
        Self::EdgeList,
        Self::CountedEdges,
        Self::Tuples,
        Self::Adjacency,
        Self::MultilineAdjacency,
        Self::Metis,
        Self::Lgl,
        Self::Tgf,
        Self::Graph6,
        Self::MatrixMarket,
        Self::Dimacs,
        Self::Pajek,
        Self::Leda,
        Self::Gml,
        Self::GraphMl,
        Self::Gexf,
        Self::Dot,
        Self::Json,
    ];

    /// What users call it, in small letters.
    #[must_use]
    pub fn name(self) -> &'static str {
        row(self).name
    }

    /// The format with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        ROWS.iter().find(|row| row.name == name).map(|row| row.format)
    }

    /// The format in a sentence, after "read as".
    #[must_use]
    pub fn title(self) -> &'static str {
        row(self).title
    }

    /// Whether a text of this format may leave open which direction its edges have.
    #[must_use]
    pub fn leaves_direction_open(self) -> bool {
        row(self).open
    }

    /// Whether graphs can be written in it.
    #[must_use]
    pub fn is_written(self) -> bool {
        !matches!(row(self).write, Write::Never)
    }
}
