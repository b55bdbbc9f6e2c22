//! What can be wrong with a text.

use alloc::string::String;
use core::fmt;

use super::{NAME_LIMIT, TEXT_LIMIT};
use crate::set::NODE_LIMIT;

/// What is wrong with a text and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormatError {
    /// Line, counted from 1.
    pub line: usize,
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
    /// The text is longer than [`TEXT_LIMIT`].
    TextTooLong {
        /// Its length.
        bytes: usize,
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
}

impl FormatError {
    /// Something else should stand at `line`; `found` is shortened.
    pub(super) fn unexpected(line: usize, found: &str, allowed: &'static str) -> Self {
        let found = found.chars().take(40).collect();
        Self { line, problem: Problem::Unexpected { found, allowed } }
    }
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
            Self::Loop { node } => write!(f, "loop: {node:?} would hear itself"),
            Self::DoubleEdge { from, to } => write!(f, "edge from {from:?} to {to:?} appears twice"),
            Self::OneSided { row, column } => write!(
                f,
                "row {row} column {column} is 1 but row {column} column {row} is not, as in a directed graph"
            ),
            Self::UnknownNode { name } => write!(f, "no node is named {name:?}"),
            Self::NodeTwice { name } => write!(f, "node {name:?} appears twice"),
            Self::Name { bytes } => write!(f, "a name of {bytes} bytes, allowed are 1 to {NAME_LIMIT}"),
            Self::TooManyNodes => write!(f, "more than {NODE_LIMIT} nodes"),
            Self::NoNodes => write!(f, "no node, at least one is needed"),
            Self::TextTooLong { bytes } => write!(f, "{bytes} bytes of text, at most {TEXT_LIMIT} are read"),
        }
    }
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name { name } => write!(f, "the name {name:?} cannot be written in this format"),
        }
    }
}

impl core::error::Error for FormatError {}
impl core::error::Error for WriteError {}
