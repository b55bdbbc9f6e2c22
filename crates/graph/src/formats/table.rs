//! The one table of formats: how each is recognised, who reads and writes it.

use alloc::string::String;

use super::builder::Draft;
use super::error::{FormatError, WriteError};
use super::format::Format;
use super::{Named, Options, adjacency, bits, dot, gml, json, matrix, sections, text, xml};

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
    const fn new(format: Format, read: Read, sign: Sign) -> Self {
        Self { format, endings: &[], open: false, sign, read, write: Write::Never }
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
    Row::new(F::Matrix, matrix::read, shape(matrix::looks_like))
        .endings(&["csv", "mat", "tsv"])
        .open()
        .written(Write::Always(matrix::write)),
    Row::new(F::EdgeList, text::edge_list::read, shape(text::edge_list::looks_like))
        .endings(&["edges", "edgelist", "el", "ncol", "txt", "csv", "tsv"])
        .open()
        .written(Write::Names(text::edge_list::write)),
    Row::new(F::CountedEdges, text::counted::read, shape(text::counted::looks_like)).open(),
    Row::new(F::Tuples, text::tuples::read, Own(text::tuples::looks_like)).open(),
    Row::new(F::Adjacency, adjacency::plain::read, known_ending(adjacency::plain::looks_like))
        .endings(&["adjlist", "adj"])
        .open(),
    Row::new(
        F::MultilineAdjacency,
        adjacency::multiline::read,
        known_ending(adjacency::multiline::looks_like),
    )
    .endings(&["multiline_adjlist", "madjlist"])
    .open(),
    Row::new(F::Metis, adjacency::metis::read, known_ending(adjacency::metis::looks_like))
        .endings(&["graph", "metis"]),
    Row::new(F::Lgl, adjacency::lgl::read, known_ending(adjacency::lgl::looks_like)).endings(&["lgl"]),
    Row::new(F::Tgf, sections::tgf::read, known_ending(sections::tgf::looks_like)).endings(&["tgf"]).open(),
    Row::new(F::Graph6, bits::read, Own(bits::looks_like))
        .endings(&["g6", "graph6", "d6", "s6", "sparse6"])
        .written(Write::Always(bits::write)),
    Row::new(F::MatrixMarket, matrix::market::read, Own(matrix::market::looks_like))
        .endings(&["mtx", "mm"])
        .open(),
    Row::new(F::Dimacs, sections::dimacs::read, Own(sections::dimacs::looks_like))
        .endings(&["col", "gr", "dimacs", "max"]),
    Row::new(F::Pajek, sections::pajek::read, Own(sections::pajek::looks_like))
        .endings(&["net", "paj", "pajek"]),
    Row::new(F::Leda, sections::leda::read, Own(sections::leda::looks_like)).endings(&["leda", "lgr", "gw"]),
    Row::new(F::Gml, gml::read, Own(gml::looks_like)).endings(&["gml"]),
    Row::new(F::GraphMl, xml::graphml::read, Own(xml::looks_like_graphml))
        .endings(&["graphml", "xml"])
        .written(Write::Names(xml::graphml::write)),
    Row::new(F::Gexf, xml::gexf::read, Own(xml::looks_like_gexf)).endings(&["gexf"]),
    Row::new(F::Dot, dot::read, Own(dot::looks_like))
        .endings(&["dot", "gv"])
        .written(Write::Always(dot::write)),
    Row::new(F::Json, json::read, Own(json::looks_like))
        .endings(&["json"])
        .written(Write::Always(json::write)),
];

/// What is known about a format.
pub(super) fn row(format: Format) -> &'static Row {
    &ROWS[format as usize]
}

impl Format {
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
