//! The choices that a search without a result has made, and whether they prove what they claim.

use alloc::vec::Vec;
use core::fmt;

use super::domains::{Domains, HONEST, Mask};
use super::rules::Rules;
use super::{Question, check};
use crate::graph::Graph;
use crate::graph::word::Word;

/// A node, and the roles that it has first; then it has none of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The node.
    pub node: u32,
    /// Its roles as bits: honest in S₁ 1, honest in S₂ 2, honest in neither 4, a liar with S₁ 8, a liar with S₂ 16.
    pub roles: u8,
}

/// The choices that are needed if a node is honest in S₁. Afterwards it is honest in neither set, since the sets may trade places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Root {
    /// The node.
    pub node: u32,
    /// In the order in which a search comes to them: at each place that the rules do not close, one is taken, first with the roles,
    /// then without them.
    pub choices: Vec<Choice>,
}

/// A proof that a graph has no split: root after root, until nobody can be honest in a set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refutation {
    /// The roots.
    pub roots: Vec<Root>,
}

/// Why choices prove nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// A node that the graph does not have.
    Node(u32),
    /// A choice between some role and none.
    Choice(Choice),
    /// A root with fewer choices than are needed.
    Few(u32),
    /// A root with more choices than are needed.
    Many(u32),
    /// Not all nodes that may be honest in a set are roots.
    Open,
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node(node) => write!(f, "node {node} is not a node of the network"),
            Self::Choice(Choice { node, roles }) => {
                write!(f, "node {node} has all of the roles {roles} or none of them, allowed is a choice")
            }
            Self::Few(root) => write!(f, "root {root} has too few choices to close every place"),
            Self::Many(root) => write!(f, "root {root} has choices that are not needed"),
            Self::Open => write!(f, "there are too few roots: somebody may still be honest in a set"),
        }
    }
}

impl core::error::Error for Flaw {}

impl Refutation {
    /// Whether the choices prove that `graph` has no split.
    pub fn check(&self, graph: &Graph, question: Question) -> Result<(), Flaw> {
        check(graph, question, self)
    }

    /// How many choices there are, roots counted.
    #[must_use]
    pub fn len(&self) -> usize {
        self.roots.iter().map(|root| root.choices.len() + 1).sum()
    }

    /// Whether there are no roots.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.roots.is_empty()
    }
}

/// What is open after a root.
pub(super) fn check_root<W: Word>(
    rules: &Rules<W>,
    open: Domains<W>,
    root: &Root,
) -> Result<Domains<W>, Flaw> {
    let node = node_of(rules, root.node)?;
    let one = W::one(node);
    let rest = close(rules, open.only(one, HONEST[0]), &root.choices, root.node)?;
    if rest.is_empty() { Ok(open.without(one, HONEST[0] | HONEST[1])) } else { Err(Flaw::Many(root.node)) }
}

/// The choices that are left when every place below `domains` is closed. Each choice parts the roles of a node, so that this is at most
/// four times as deep as there are nodes.
fn close<'c, W: Word>(
    rules: &Rules<W>,
    domains: Domains<W>,
    choices: &'c [Choice],
    root: u32,
) -> Result<&'c [Choice], Flaw> {
    let Some(now) = rules.conclude(domains) else { return Ok(choices) };
    let (&choice, rest) = choices.split_first().ok_or(Flaw::Few(root))?;
    let node = node_of(rules, choice.node)?;
    let roles: Mask = now.of(node);
    if roles & choice.roles == 0 || roles & !choice.roles == 0 {
        return Err(Flaw::Choice(choice));
    }
    let rest = close(rules, now.only(W::one(node), choice.roles), rest, root)?;
    close(rules, now.without(W::one(node), choice.roles), rest, root)
}

fn node_of<W: Word>(rules: &Rules<W>, node: u32) -> Result<usize, Flaw> {
    usize::try_from(node).ok().filter(|node| *node < rules.heard.len()).ok_or(Flaw::Node(node))
}
