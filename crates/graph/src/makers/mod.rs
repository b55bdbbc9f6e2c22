//! Graphs by name.

pub mod delaunay;
pub mod fixed;
pub mod large;
mod mesh;
pub mod minimal;
pub mod random;
pub mod symmetric;

use core::fmt;

use crate::graph::GraphError;

/// Why a graph cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MakerError {
    /// Too few or too many nodes.
    Graph(GraphError),
    /// A parameter is out of its range.
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// What is allowed.
        allowed: &'static str,
    },
}

impl From<GraphError> for MakerError {
    fn from(error: GraphError) -> Self {
        Self::Graph(error)
    }
}

impl fmt::Display for MakerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Graph(error) => error.fmt(f),
            Self::Parameter { name, allowed } => write!(f, "{name} must be {allowed}"),
        }
    }
}

impl core::error::Error for MakerError {}

fn require(condition: bool, name: &'static str, allowed: &'static str) -> Result<(), MakerError> {
    if condition { Ok(()) } else { Err(MakerError::Parameter { name, allowed }) }
}
