//! What can be wrong with a text.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::NAME_LIMIT;
use super::format::Format;
use crate::graph::set::NODE_LIMIT;

/// What is wrong with a text and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormatError {
    /// Line, counted from 1.
    pub line: usize,
    /// Where in the line, bytes from its start, if that is known.
    pub column: Option<usize>,
    /// What is wrong there.
    pub problem: Problem,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Problem {
    /// Something else should stand here.
    Unexpected {
        /// What stands there, shortened; empty at the end of the text.
        found: String,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Something is not there.
    Missing {
        /// What should be.
        allowed: &'static str,
    },
    /// The text fits several formats, which read it as different graphs.
    Ambiguous {
        /// Those that fit, in the order of the table.
        formats: Vec<Format>,
    },
    /// The text does not look like any format, though the reader of one would make a graph of it.
    Doubtful {
        /// This is the format.
        format: Format,
    },
    /// The text is a single word, and not one of graph6.
    OneWord {
        /// The word, shortened.
        word: String,
    },
    /// A line has another number of columns than the first one.
    Columns {
        /// Its number of columns.
        found: usize,
        /// Number of the first line.
        first_line: usize,
        /// Its number of columns.
        first: usize,
    },
    /// Names that are one number, written differently.
    SameNumber {
        /// The first of them.
        first: String,
        /// The other.
        second: String,
    },
    /// A comment speaks of direction, but not plainly.
    DirectionUnclear,
    /// A head promises another number than there is.
    Count {
        /// Of what.
        what: &'static str,
        /// As promised.
        promised: usize,
        /// As found.
        found: usize,
    },
    /// The text is no well-formed XML.
    Xml {
        /// What is wrong with it.
        what: String,
    },
    /// The text has several graphs, and none was chosen, or one that is not there.
    Which {
        /// How many it has.
        graphs: usize,
    },
    /// An edge from a node to itself.
    Loop {
        /// The node.
        node: String,
    },
    /// An edge that an earlier line has.
    DoubleEdge {
        /// Where it begins.
        from: String,
        /// Where it ends.
        to: String,
    },
    /// The matrix of an undirected graph has u → v but not v → u.
    OneSided {
        /// The row of the 1, from 0.
        row: usize,
        /// Its column, from 0.
        column: usize,
    },
    /// An edge names a node that was not declared.
    UnknownNode {
        /// The name.
        name: String,
    },
    /// A node is declared twice.
    NodeTwice {
        /// The name.
        name: String,
    },
    /// A name is empty or longer than [`NAME_LIMIT`].
    Name {
        /// Its length, bytes.
        bytes: usize,
    },
    /// More nodes than [`NODE_LIMIT`].
    TooManyNodes,
    /// There is no node.
    NoNodes,
    /// The text is longer than `TEXT_LIMIT`.
    TextTooLong {
        /// Its length.
        bytes: usize,
        /// How long it may be.
        most: usize,
    },
}

/// Why a graph cannot be written in a format.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WriteError {
    /// The format has no way to write this name.
    Name {
        /// The name.
        name: String,
    },
    /// The format is only read.
    ReadOnly {
        /// This is the format.
        format: Format,
    },
}

impl FormatError {
    /// A problem with a line as a whole.
    pub(super) fn new(line: usize, problem: Problem) -> Self {
        Self { line, column: None, problem }
    }

    /// Something else should stand at `line`; `found` is shortened.
    pub(super) fn unexpected(line: usize, found: &str, allowed: &'static str) -> Self {
        Self::new(line, Problem::Unexpected { found: shortened(found), allowed })
    }

    /// Something is not there that should be at `line`.
    pub(super) fn missing(line: usize, allowed: &'static str) -> Self {
        Self::new(line, Problem::Missing { allowed })
    }

    /// Says at which byte of the line the problem is, from the start of the line.
    pub(super) fn at(mut self, column: usize) -> Self {
        self.column = Some(column);
        self
    }
}

/// The first 40 characters.
pub(super) fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.problem)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unexpected { found, allowed } if found.is_empty() => {
                write!(f, "ends here, expected {allowed}")
            }
            Self::Unexpected { found, allowed } => write!(f, "found {found:?}, expected {allowed}"),
            Self::Missing { allowed } => write!(f, "expected {allowed}"),
            Self::Ambiguous { formats } => ambiguous(f, formats),
            Self::Doubtful { format } => write!(
                f,
                "this does not look like {}, nor like anything else: expected to be told the format, perhaps {}",
                format.title(),
                format.name()
            ),
            Self::OneWord { word } => {
                write!(f, "the text is one word, {word:?}: expected two names a line, or a line of graph6")
            }
            Self::Columns { found, first_line, first } => write!(
                f,
                "{found} column{}, but {first} in line {first_line}: expected as many in every line of an edge list",
                if *found == 1 { "" } else { "s" }
            ),
            Self::SameNumber { first, second } => {
                write!(
                    f,
                    "the names {first:?} and {second:?} are the same number: expected one way to write it"
                )
            }
            Self::DirectionUnclear => write!(
                f,
                "a comment speaks of direction, but not plainly: expected \"directed graph\" or \"undirected graph\" as its first words"
            ),
            Self::Count { what, promised, found } => {
                write!(f, "{promised} {what} promised, {found} found: is the text cut off?")
            }
            Self::Xml { what } => write!(f, "not well-formed XML: {what}"),
            Self::Which { graphs } => write!(f, "{graphs} graphs in the text, choose one: 1 to {graphs}"),
            Self::Loop { node } => write!(f, "loop: {node:?} would hear itself"),
            Self::DoubleEdge { from, to } => write!(f, "edge from {from:?} to {to:?} appears twice"),
            Self::OneSided { row, column } => write!(
                f,
                "row {row} column {column} is a link but row {column} column {row} is not: expected both in an undirected graph"
            ),
            Self::UnknownNode { name } => write!(f, "no node is named {name:?}"),
            Self::NodeTwice { name } => write!(f, "node {name:?} appears twice"),
            Self::Name { bytes } => write!(f, "a name of {bytes} bytes, allowed are 1 to {NAME_LIMIT}"),
            Self::TooManyNodes => write!(f, "more than {NODE_LIMIT} nodes"),
            Self::NoNodes => write!(f, "no node, at least one is needed"),
            Self::TextTooLong { bytes, most } => write!(f, "{bytes} bytes of text, at most {most} are read"),
        }
    }
}

/// "may be a matrix or an edge list, which are different graphs: expected --format matrix or edges".
fn ambiguous(f: &mut fmt::Formatter<'_>, formats: &[Format]) -> fmt::Result {
    let list = |f: &mut fmt::Formatter<'_>, name: fn(Format) -> &'static str| {
        for (index, &format) in formats.iter().enumerate() {
            write!(f, "{}{}", if index == 0 { "" } else { " or " }, name(format))?;
        }
        Ok(())
    };
    write!(f, "the text may be ")?;
    list(f, Format::title)?;
    write!(f, ", which are different graphs: expected the format ")?;
    list(f, Format::name)
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name { name } => write!(f, "the name {name:?} cannot be written in this format"),
            Self::ReadOnly { format } => write!(f, "{} is only read", format.title()),
        }
    }
}

impl core::error::Error for FormatError {}
impl core::error::Error for WriteError {}
