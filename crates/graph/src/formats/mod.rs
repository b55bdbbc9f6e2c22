//! Graphs as text: many formats are read, six of them are written. No files here: text in, text out.
//!
//! In every format a directed edge u → v means that v hears u. Nodes keep their names; a node's number is its place in
//! the file, or its rank if all names are whole numbers and the format has no list of nodes.
//!
//! Nothing is guessed in silence: what a text is, is told by its content, and a text that two formats read as two different
//! graphs is refused with both names ([`Problem::Ambiguous`]). A format is one file, its words in `format.rs` and one row of `table.rs`.
//!
//! | folder | formats |
//! | --- | --- |
//! | `text` | edge lists, with counts first, as tuples of Python |
//! | `adjacency` | a node and its neighbours a line: networkx, METIS, LGL |
//! | `matrix` | matrices as text, MatrixMarket |
//! | `sections` | a head or a list of nodes before the edges: DIMACS and PACE, TGF, Pajek, LEDA |
//! | `bits` | graph6, digraph6, sparse6 |
//! | `xml`, `json`, `dot`, `gml` | languages with brackets |

mod adjacency;
mod bits;
mod builder;
mod choose;
mod dot;
mod error;
mod format;
mod gml;
mod index;
mod json;
mod links;
mod matrix;
mod note;
mod sections;
mod table;
mod text;
mod words;
mod xml;

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::graph::Graph;
use crate::network::Network;
pub use error::{FormatError, Problem, WriteError};
pub use format::Format;
pub use note::Note;
pub use words::unix_lines;

/// Longest text that is read, bytes.
pub const TEXT_LIMIT: usize = 1 << 22;

/// Longest text of a network that is read, bytes.
pub const NETWORK_TEXT_LIMIT: usize = 1 << 28;

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

/// How a text is to be read. The default asks the text for everything.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options<'a> {
    /// The format, if it is not to be told by the content.
    pub format: Option<Format>,
    /// The ending of the file's name, without the dot. It decides only between formats that the content allows.
    pub ending: Option<&'a str>,
    /// Whether edges have a direction, in formats that may leave it open ([`Format::leaves_direction_open`]); elsewhere it
    /// is passed over. `None` means what the text says, and undirected if it says nothing.
    pub directed: Option<bool>,
    /// Every directed edge is turned round after reading.
    pub transpose: bool,
    /// Parallel links and loops are errors; otherwise they count once or not at all, with a note.
    pub strict: bool,
    /// In a matrix any number but 0 is a link; otherwise only 1 is.
    pub weights: bool,
    /// Which graph of a text with several, from 1.
    pub which: Option<usize>,
}

/// How the format was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToldBy {
    /// Nothing else fits the content, or all that fits is the same graph.
    Content,
    /// The content fits several formats, and the ending of the name is that of one.
    Ending,
    /// [`Options::format`].
    Request,
}

/// A graph that was read, and as what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reading {
    /// The graph.
    pub named: Named,
    /// The format it was read as.
    pub format: Format,
    /// How the format was found.
    pub told_by: ToldBy,
    /// What a reader should know who expected something else.
    pub notes: Vec<Note>,
}

/// A network of any size that was read, and as what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NetworkReading {
    /// The network.
    pub network: Network,
    /// The name of each node, all different.
    pub names: Vec<String>,
    /// The line with the first node that a graph for exact search has no place for.
    beyond: Option<usize>,
    /// The format it was read as.
    pub format: Format,
    /// How the format was found.
    pub told_by: ToldBy,
    /// What a reader should know who expected something else.
    pub notes: Vec<Note>,
}

/// Reads the graph that `text` holds: at most [`TEXT_LIMIT`] bytes and 128 nodes.
///
/// A mark of the byte order at the start is passed over, and lines may end in any way. Fails where the text is not what
/// its format demands, and where it may be two different graphs.
pub fn read(text: &str, options: &Options<'_>) -> Result<Reading, FormatError> {
    if text.len() > TEXT_LIMIT {
        return Err(FormatError::new(1, Problem::TextTooLong { bytes: text.len(), most: TEXT_LIMIT }));
    }
    read_network(text, options)?.small()
}

/// Reads the network that `text` holds: at most [`NETWORK_TEXT_LIMIT`] bytes and
/// [`NETWORK_LIMIT`](crate::network::NETWORK_LIMIT) nodes, otherwise as [`read`].
pub fn read_network(text: &str, options: &Options<'_>) -> Result<NetworkReading, FormatError> {
    let recognised = recognise(text, options)?;
    read_as(text, recognised, options)
}

/// Reads the network that `text` holds as [`recognise`] has found it.
pub fn read_as(
    text: &str,
    (format, told_by): (Format, ToldBy),
    options: &Options<'_>,
) -> Result<NetworkReading, FormatError> {
    if text.len() > NETWORK_TEXT_LIMIT {
        let problem = Problem::TextTooLong { bytes: text.len(), most: NETWORK_TEXT_LIMIT };
        return Err(FormatError::new(1, problem));
    }
    let draft = (table::row(format).read)(&unix_lines(text), options)?;
    match draft.repeat {
        Some(repeat) if options.strict => return Err(repeat),
        _ => {}
    }
    let (mut network, mut notes) = (draft.network, draft.notes);
    if options.transpose && network.is_directed() {
        network = network.transposed();
    } else if options.transpose {
        notes.push(Note::NothingToTranspose);
    }
    let (names, beyond) = (draft.names, draft.beyond);
    Ok(NetworkReading { network, names, beyond, format, told_by, notes })
}

impl NetworkReading {
    /// Makes it a graph for exact search, which is refused where the text has more nodes than that takes.
    pub fn small(self) -> Result<Reading, FormatError> {
        let Self { network, names, beyond, format, told_by, notes } = self;
        let many = |_| FormatError::new(beyond.unwrap_or(1), Problem::TooManyNodes);
        let graph = network.graph().map_err(many)?;
        Ok(Reading { named: Named { graph, names }, format, told_by, notes })
    }
}

/// The format that `text` would be read as, if that is clear.
pub fn recognise(text: &str, options: &Options<'_>) -> Result<(Format, ToldBy), FormatError> {
    if text.len() > NETWORK_TEXT_LIMIT {
        let problem = Problem::TextTooLong { bytes: text.len(), most: NETWORK_TEXT_LIMIT };
        return Err(FormatError::new(1, problem));
    }
    let (row, told_by) = choose::choose(&unix_lines(text), options)?;
    Ok((row.format, told_by))
}

/// Writes `named` down. What is written reads back as the same graph; matrix and graph6 have no place for names.
pub fn write(named: &Named, format: Format) -> Result<String, WriteError> {
    match table::row(format).write {
        table::Write::Always(write) => Ok(write(named)),
        table::Write::Names(write) => write(named),
        table::Write::Never => Err(WriteError::ReadOnly { format }),
    }
}
