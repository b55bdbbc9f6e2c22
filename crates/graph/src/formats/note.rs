//! What was passed over or decided while reading, for whoever expected something else.

use alloc::string::String;
use core::fmt;

/// A remark on what was read. Each is one sentence without a full stop.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Note {
    /// So many links were there before.
    Parallel(usize),
    /// So many edges began where they ended.
    Loops(usize),
    /// So many links of a directed graph have no direction of their own, and count in both.
    BothWays(usize),
    /// The first line names the columns.
    Header {
        /// Its number, from 1.
        line: usize,
        /// The line, shortened.
        text: String,
    },
    /// A comment says which direction there is, and the caller says otherwise.
    DirectionOverruled {
        /// Line of the comment, from 1.
        line: usize,
        /// What it says.
        directed: bool,
    },
    /// Columns that are no ends of links were passed over.
    Columns(usize),
    /// One of several graphs.
    Which {
        /// Which, from 1.
        graph: usize,
        /// Of how many.
        graphs: usize,
    },
    /// The graph is undirected, so there was nothing to transpose.
    NothingToTranspose,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Parallel(1) => write!(f, "1 parallel link counts once"),
            Self::Parallel(count) => write!(f, "{count} parallel links count once"),
            Self::Loops(1) => write!(f, "1 loop is left out: a robot does not count itself"),
            Self::Loops(count) => write!(f, "{count} loops are left out: a robot does not count itself"),
            Self::BothWays(1) => write!(f, "1 link without a direction counts in both"),
            Self::BothWays(count) => write!(f, "{count} links without a direction count in both"),
            Self::Header { line, text } => write!(f, "line {line} is a header and was skipped: {text:?}"),
            Self::DirectionOverruled { line, directed } => {
                let said = if *directed { "directed" } else { "undirected" };
                write!(f, "the comment in line {line} says {said}, which was overruled")
            }
            Self::Columns(1) => write!(f, "1 column beside the two ends was passed over"),
            Self::Columns(count) => write!(f, "{count} columns beside the two ends were passed over"),
            Self::Which { graph, graphs } => write!(f, "graph {graph} of the {graphs} in the file"),
            Self::NothingToTranspose => write!(f, "undirected, so there was nothing to transpose"),
        }
    }
}
