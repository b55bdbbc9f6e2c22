//! Answers and what they rest on.

use core::fmt;

use crate::definition::Witness;

/// A whole number known to lie in `least ..= most`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interval {
    /// Proved lower end.
    pub least: i32,
    /// Proved upper end.
    pub most: i32,
}

/// What is proved of a number, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proved {
    /// It is this.
    Exactly(i32),
    /// It is this or more; [`Interval::most`] has the other end.
    AtLeast(i32),
    /// It is this or less, and no lower end above the trivial one is known.
    AtMost(i32),
}

impl Interval {
    /// The number itself, if it is known.
    #[must_use]
    pub fn exactly(self) -> Option<i32> {
        (self.least == self.most).then_some(self.least)
    }

    /// What is proved. A lower end of `0` or `−1` says nothing about robustness, so then the upper end is named.
    #[must_use]
    pub fn proved(self) -> Proved {
        match self.exactly() {
            Some(value) => Proved::Exactly(value),
            None if self.least > 0 => Proved::AtLeast(self.least),
            None => Proved::AtMost(self.most),
        }
    }
}

impl fmt::Display for Proved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exactly(value) => write!(f, "exactly {value}"),
            Self::AtLeast(value) => write!(f, "at least {value}"),
            Self::AtMost(value) => write!(f, "at most {value}"),
        }
    }
}

/// How it is known that a graph is (r,s)-robust.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Certificate {
    /// r = 0, s = 0 or a single node: the definition asks nothing.
    Nothing,
    /// δ ≥ floor(n/2) + r − 1, [`crate::bounds::r_least`].
    //= paper lem:rs_robust
    Degrees {
        /// Least in-degree δ.
        degree_min: usize,
    },
    /// No two nodes can be content in disjoint sets, [`crate::bounds::content_pair`].
    Pairs,
    /// Two such sets would have more than n nodes together, by the eigenvalues of the Laplacian, [`crate::spectrum`].
    //= theory sec:spectrum
    Eigenvalues,
    /// The search tree was exhausted without a witness.
    Search {
        /// Nodes visited for this question.
        nodes: u64,
    },
    /// The table of all subsets has no smaller value.
    Table {
        /// Number of subsets, 2ⁿ.
        subsets: u64,
    },
    /// Follows from (r + `steps`, s − `steps`)-robustness, itself known from eigenvalues, the search or the table.
    Shifted {
        /// How far the r of the question that was answered is above this one.
        steps: usize,
    },
}

impl Certificate {
    /// What this says about the r that is `steps` lower.
    pub(crate) fn shifted(self, steps: usize) -> Self {
        match self {
            Self::Eigenvalues | Self::Search { .. } | Self::Table { .. } if steps > 0 => {
                Self::Shifted { steps }
            }
            other => other,
        }
    }
}

impl fmt::Display for Certificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => write!(f, "nothing to show"),
            Self::Degrees { degree_min } => write!(f, "least degree {degree_min}"),
            Self::Pairs => write!(f, "no two nodes can hold out in disjoint sets"),
            Self::Eigenvalues => write!(f, "eigenvalues: two such sets do not fit into the graph"),
            Self::Search { nodes } => write!(f, "exhaustive search, {nodes} nodes"),
            Self::Table { subsets } => write!(f, "table of all {subsets} subsets"),
            Self::Shifted { steps } => write!(f, "follows from the answer for r + {steps}"),
        }
    }
}

/// The answer to "is this graph (r,s)-robust?".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It is.
    Robust(Certificate),
    /// It is not: two sets that violate the definition.
    NotRobust(Witness),
    /// The effort was spent, or the callback said stop, before the answer.
    Unknown,
}
