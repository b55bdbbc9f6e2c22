//! Robustness over several hops: what a graph must be if robots pass on what they were told.
//!
//! The definition is that of Yuan and Ishii 2021 (arXiv 2201.03214) for at most f liars in all (f-total). With L ⊂ V the liars and S a set
//! of nodes,
//!
//! ```text
//! Z^r_S = { i ∈ S : at least r paths of at most l edges lead from outside S to i, disjoint but for i, with no liar in their middle }
//! (r,s)-robust with l hops: for all sets L of at most f liars and all disjoint nonempty S₁, S₂:
//!     Z^r_S₁ = S₁   or   Z^r_S₂ = S₂   or   |Z^r_S₁| + |Z^r_S₂| ≥ s
//! ```
//!
//! A liar may be the beginning of a path. W-MSR over l hops withstands any f liars if and only if the graph is (f + 1, f + 1)-robust with l
//! hops. With l = 1 no path has a middle, and this is the definition of [`crate::definition`].
//!
//! Exact answers, in this order: a graph that is (r,s)-robust with one hop is with more, since paths of one edge stay; a node that hears
//! fewer than r others, or fewer than r liars that cut two sets off, are witnesses for every l; up to [`NODES_MAX`] nodes a table of all
//! subsets, for each set of liars (docs/theory, `sec:hops`).

mod paths;
mod quick;
mod table;

use crate::decide::Robustness;
use crate::effort::{Effort, Meter, Stopped};
use crate::graph::Graph;
use crate::graph::set::NodeSet;
use crate::verdict::Verdict;
use paths::Paths;

/// Graphs with more nodes are not looked at in a table of all subsets.
pub const NODES_MAX: usize = 20;

/// Is a graph (r,s)-robust with so many hops?
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HopQuestion {
    /// l, 1 or more.
    pub hops: usize,
    /// r.
    pub r: usize,
    /// s.
    pub s: usize,
    /// f: how many liars may be in the middle of paths.
    pub liars: usize,
}

impl HopQuestion {
    /// Whether W-MSR over `hops` hops withstands any `f` liars: (f + 1, f + 1).
    #[must_use]
    pub fn survives(hops: usize, f: usize) -> Self {
        Self { hops, r: f + 1, s: f + 1, liars: f }
    }
}

/// Two sets that never agree over several hops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HopWitness {
    /// What they violate.
    pub question: HopQuestion,
    /// Those who pass on nothing that is true.
    pub liars: NodeSet,
    /// S₁.
    pub first: NodeSet,
    /// S₂.
    pub second: NodeSet,
}

impl HopWitness {
    /// Z^r_S₁ ∪ Z^r_S₂.
    pub fn reached(&self, graph: &Graph, meter: &mut Meter<'_>) -> Result<NodeSet, Stopped> {
        Ok(self.reached_in(graph, self.first, meter)?.union(self.reached_in(graph, self.second, meter)?))
    }

    /// Whether the claim is true of `graph`, word for word.
    pub fn holds(&self, graph: &Graph, meter: &mut Meter<'_>) -> Result<bool, Stopped> {
        let sets = !self.first.is_empty() && !self.second.is_empty() && self.first.is_disjoint(self.second);
        let inside = self.first.union(self.second).union(self.liars).is_subset(graph.nodes());
        if !sets || !inside || self.liars.len() > self.question.liars {
            return Ok(false);
        }
        let one = self.reached_in(graph, self.first, meter)?;
        let other = self.reached_in(graph, self.second, meter)?;
        let full = one == self.first || other == self.second;
        Ok(!full && one.len() + other.len() < self.question.s)
    }

    fn reached_in(&self, graph: &Graph, set: NodeSet, meter: &mut Meter<'_>) -> Result<NodeSet, Stopped> {
        let paths = Paths { graph, hops: self.question.hops, liars: self.liars };
        let mut reached = NodeSet::EMPTY;
        for node in set.iter() {
            if paths.are_at_least(self.question.r, set, node, meter)? {
                reached.insert(node);
            }
        }
        Ok(reached)
    }
}

/// The answer to a [`HopQuestion`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HopVerdict {
    /// It is, and already with one hop.
    RobustWithOneHop,
    /// It is: no pair of sets in the table is a witness, for any set of liars.
    Robust,
    /// It is not.
    NotRobust(HopWitness),
    /// More than [`NODES_MAX`] nodes, and nothing that is quick to see settled it.
    TooLarge,
}

/// Answers a question; `Err` if `meter` says so.
pub fn decide(graph: &Graph, question: HopQuestion, meter: &mut Meter<'_>) -> Result<HopVerdict, Stopped> {
    if question.r == 0 || question.s == 0 || graph.node_count() < 2 {
        return Ok(HopVerdict::RobustWithOneHop);
    }
    if let Some(witness) = quick::lonely(graph, question) {
        return Ok(HopVerdict::NotRobust(witness));
    }
    match Robustness::new(graph, &Effort::UNLIMITED).decide(question.r, question.s, meter) {
        Verdict::Robust(_) => return Ok(HopVerdict::RobustWithOneHop),
        Verdict::NotRobust(found) => {
            // Often the two sets hold out over more hops too, the exempt ones being the liars.
            let liars = found.exempt;
            let witness = HopWitness { question, liars, first: found.first, second: found.second };
            if witness.holds(graph, meter)? {
                return Ok(HopVerdict::NotRobust(witness));
            }
        }
        Verdict::Unknown => return Err(Stopped),
    }
    if let Some(witness) = quick::cut(graph, question, meter)? {
        return Ok(HopVerdict::NotRobust(witness));
    }
    if graph.node_count() > NODES_MAX {
        return Ok(HopVerdict::TooLarge);
    }
    Ok(table::witness(graph, question, meter)?.map_or(HopVerdict::Robust, HopVerdict::NotRobust))
}

#[cfg(test)]
mod tests;
