//! Who plays which part where liars split a network: a search over the roles of all nodes, whose failure is a proof that others can check.
//!
//! A *split* gives each node one of five roles: honest in S₁, honest in S₂, honest in neither, a liar with S₁, a liar with S₂. Both sets have
//! an honest member, and each honest member of a set hears fewer than r nodes outside of it. Of liars there are few:
//!
//! ```text
//! Liars::Total { s }   fewer than s in all: a split is a witness against (r,s)-robustness
//! Liars::Local         fewer than r among those whom any honest node hears: a split under F = r − 1
//! ```
//!
//! The search keeps for each node the roles that it may still have (`domains.rs`), rules out what cannot be (`rules.rs`), and tries a
//! role for a node and then the others (`search.rs`). The nodes that were tried, in order, are a [`Refutation`]: who has them needs the rules
//! alone (`refutation.rs`), and `proofs/roles.v` proves the rules.
//= theory sec:roles

mod domains;
mod refutation;
mod rules;
mod search;

use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use domains::Domains;
pub use refutation::{Choice, Flaw, Refutation, Root};
use rules::Rules;
use search::Search;

/// How many liars a split may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Liars {
    /// Fewer than s in all.
    Total {
        /// The s of (r,s).
        s: usize,
    },
    /// Fewer than r among those whom any honest node hears.
    Local,
}

/// What is asked of a graph: whether there is a split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Question {
    /// Honest members of a set hear fewer than so many nodes outside of it; 1 or more.
    pub r: usize,
    /// How many liars there may be.
    pub liars: Liars,
}

/// The roles of a split that was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Split {
    /// All liars.
    pub liars: NodeSet,
    /// S₁, with its liars.
    pub first: NodeSet,
    /// S₂, with its liars.
    pub second: NodeSet,
}

/// A split, or `None` if there is none. One place of the search is one node of `meter`.
//= theory sec:roles
pub fn split(graph: &Graph, question: Question, meter: &mut Meter<'_>) -> Result<Option<Split>, Stopped> {
    if graph.node_count() <= 64 {
        Search::new(Rules::<u64>::new(graph, question), None).all(graph, meter)
    } else {
        Search::new(Rules::<u128>::new(graph, question), None).all(graph, meter)
    }
}

/// What proves that there is no split; `None` if there is one. Stopped too if the proof would have more than `choices_most` choices.
//= theory sec:roles
pub fn refutation(
    graph: &Graph,
    question: Question,
    choices_most: usize,
    meter: &mut Meter<'_>,
) -> Result<Option<Refutation>, Stopped> {
    let mut search = Search::new(Rules::<u128>::new(graph, question), Some(choices_most));
    let found = search.all(graph, meter)?;
    Ok(search.refutation().filter(|_| found.is_none()))
}

/// Whether the choices prove that `graph` has no split.
//= theory sec:roles
fn check(graph: &Graph, question: Question, refutation: &Refutation) -> Result<(), Flaw> {
    let rules = Rules::<u128>::new(graph, question);
    let mut open: Domains<u128> = Domains::all(graph.nodes().bits());
    for root in &refutation.roots {
        open = refutation::check_root(&rules, open, root)?;
    }
    if rules.conclude(open).is_none() { Ok(()) } else { Err(Flaw::Open) }
}
