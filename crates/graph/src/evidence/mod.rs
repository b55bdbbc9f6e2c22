//! Evidence: a claim about a network with what proves it, so that others can check it without a search. As a file it is called a
//! certificate.
//!
//! The check looks at every edge a few times. `proofs/evidence.v` has the same check with a proof that a claim which passes is
//! true; `proofs/check.sh` holds the two against each other. As text evidence carries its network, see [`Evidence::text`].

mod eigen;
mod read;
mod search;
mod text;

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

pub use read::EvidenceError;

use crate::graph::set::NODE_LIMIT;
use crate::network::Network;
use crate::ranks::{Order, Wrong};
use crate::roles::{Flaw, Refutation};
use crate::spectrum::Bounds;
pub use eigen::of_eigenvalues;
pub use search::{CHOICES_MAX, of_order, of_robust};

/// A claim about a network. Not checked: see [`Evidence::check`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// The network that the claim is about.
    pub network: Network,
    /// What is claimed of it.
    pub claim: Claim,
}

/// What is claimed, with what proves it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Claim {
    /// It is not (r,s)-robust, because of two sets of nodes.
    //= paper def:robustness
    NotRobust {
        /// The r of (r,s).
        r: usize,
        /// The s of (r,s).
        s: usize,
        /// S₁ and S₂.
        sets: [Vec<u32>; 2],
    },
    /// It is (r,s)-robust for every s, because each node hears floor(n/2) + r − 1 others or more.
    //= paper lem:rs_robust
    Degrees {
        /// The r of (r,s).
        r: usize,
    },
    /// It survives F liars around each node, because of an order.
    //= theory thm:ranks
    Ranks(Order),
    /// It is (r,s)-robust, because two sets would have more nodes than there are.
    //= theory sec:spectrum
    Eigenvalues {
        /// The r of (r,s).
        r: usize,
        /// The s of (r,s), at most n.
        s: usize,
        /// Bounds of the eigenvalues, with what proves them.
        bounds: Bounds,
    },
    /// It is (r,s)-robust, because of the choices that a search made.
    //= theory sec:roles
    Search {
        /// The r of (r,s).
        r: usize,
        /// The s of (r,s).
        s: usize,
        /// The choices.
        refutation: Refutation,
    },
    /// It survives F liars around each node, because of an order whose core has no split, and that because of the choices that a search made.
    //= theory thm:ranks-exact
    SearchedRanks {
        /// The order.
        order: Order,
        /// The choices; nodes are places in the core, from 0.
        refutation: Refutation,
    },
}

/// Why evidence proves nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// One of the two sets is empty.
    Empty,
    /// A node that is in the sets twice, or that the network does not have.
    Node(u32),
    /// All members of a set hear r nodes or more outside of it.
    Full {
        /// 0 for S₁, 1 for S₂.
        set: usize,
    },
    /// Too many members of both sets together hear r nodes or more outside of their own.
    Exempt {
        /// How many do.
        count: usize,
        /// s − 1.
        most: usize,
    },
    /// An r or s of 0, of which nothing is proved by degrees or choices.
    Zero,
    /// A node hears too few others.
    Degree {
        /// The node that hears too few.
        node: usize,
        /// How many it hears.
        heard: usize,
        /// floor(n/2) + r − 1.
        least: usize,
    },
    /// The order is wrong.
    Order(Wrong),
    /// More nodes than a search takes.
    Large {
        /// How many there are.
        nodes: usize,
    },
    /// A link that leads one way only, or numbers that do not prove the bounds of the eigenvalues.
    Eigenvalues,
    /// The bounds of the eigenvalues leave room for two sets.
    Room,
    /// The choices of a search are wrong.
    Choices(Flaw),
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "a set without nodes"),
            Self::Node(node) => write!(f, "node {node} twice in the sets, or not a node of the network"),
            Self::Full { set } => {
                write!(f, "all members of set {} hear r nodes or more outside of it", set + 1)
            }
            Self::Exempt { count, most } => {
                write!(f, "{count} members hear r nodes or more outside of their set, allowed are {most}")
            }
            Self::Zero => write!(f, "r or s is 0, allowed is 1 or more"),
            Self::Degree { node, heard, least } => {
                write!(f, "node {node} hears {heard} others, allowed are {least} or more")
            }
            Self::Order(wrong) => wrong.fmt(f),
            Self::Large { nodes } => write!(f, "a search of {nodes} nodes, allowed are up to {NODE_LIMIT}"),
            Self::Eigenvalues => {
                write!(
                    f,
                    "a link that leads one way only, or numbers that do not prove the bounds of the eigenvalues"
                )
            }
            Self::Room => write!(f, "the bounds of the eigenvalues leave room for two sets"),
            Self::Choices(flaw) => flaw.fmt(f),
        }
    }
}

impl core::error::Error for Refused {}

impl Evidence {
    /// Whether the claim is proved.
    pub fn check(&self) -> Result<(), Refused> {
        match &self.claim {
            Claim::NotRobust { r, s, sets } => refutes(&self.network, *r, *s, sets),
            Claim::Degrees { r } => degrees(&self.network, *r),
            Claim::Ranks(order) => order.counts(&self.network).map(|_| ()).map_err(Refused::Order),
            Claim::Eigenvalues { r, s, bounds } => eigen::robust(&self.network, *r, *s, bounds),
            Claim::Search { r, s, refutation } => search::robust(&self.network, *r, *s, refutation),
            Claim::SearchedRanks { order, refutation } => search::ranks(&self.network, order, refutation),
        }
    }
}

/// The conditions of the definition, for two sets.
//= paper def:robustness
fn refutes(network: &Network, r: usize, s: usize, sets: &[Vec<u32>; 2]) -> Result<(), Refused> {
    let mut set_of: Vec<Option<usize>> = vec![None; network.node_count()];
    for (set, nodes) in sets.iter().enumerate() {
        for &node in nodes {
            match set_of.get_mut(node as usize) {
                Some(place @ None) => *place = Some(set),
                _ => return Err(Refused::Node(node)),
            }
        }
    }
    let mut count = 0;
    for (set, nodes) in sets.iter().enumerate() {
        if nodes.is_empty() {
            return Err(Refused::Empty);
        }
        let outside = |node: u32| {
            let heard = network.heard(node as usize).iter();
            heard.filter(|other| set_of[**other as usize] != Some(set)).count()
        };
        let exempt = nodes.iter().filter(|node| outside(**node) >= r).count();
        if exempt == nodes.len() {
            return Err(Refused::Full { set });
        }
        count += exempt;
    }
    if count < s { Ok(()) } else { Err(Refused::Exempt { count, most: s.saturating_sub(1) }) }
}

//= paper lem:rs_robust
fn degrees(network: &Network, r: usize) -> Result<(), Refused> {
    if r == 0 {
        return Err(Refused::Zero);
    }
    let least = (network.node_count() / 2).saturating_add(r - 1);
    match network.degrees().enumerate().find(|(_, heard)| *heard < least) {
        Some((node, heard)) => Err(Refused::Degree { node, heard, least }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::definition::{Witness, counterexample, is_robust};
    use crate::graph::set::NodeSet;
    use crate::makers::random::erdos_renyi;

    fn nodes(set: NodeSet) -> Vec<u32> {
        set.iter().map(|node| u32::try_from(node).unwrap()).collect()
    }

    /// Any two sets pass here exactly if they are a witness by the definition.
    //= paper def:robustness type=test
    #[test]
    fn sets_pass_if_they_are_a_witness() {
        for seed in 0..12 {
            let graph = erdos_renyi(5, 0.5, seed % 2 == 0, seed).unwrap();
            let network = Network::from(&graph);
            for (first, second) in (0..32).flat_map(|first| (0..32).map(move |second| (first, second))) {
                let sets = [NodeSet::from_bits(first), NodeSet::from_bits(second)];
                for (r, s) in (0..4).flat_map(|r| (0..5).map(move |s| (r, s))) {
                    let holds = Witness::new(&graph, r, s, sets[0], sets[1]).holds(&graph);
                    assert_eq!(refutes(&network, r, s, &sets.map(nodes)).is_ok(), holds, "seed {seed}");
                }
            }
        }
    }

    #[test]
    fn what_passes_is_true() {
        let mut passed = [0; 2];
        for seed in 0..60 {
            let graph =
                erdos_renyi(7, 0.5 + 0.008 * f64::from(u32::try_from(seed).unwrap()), false, seed).unwrap();
            let network = Network::from(&graph);
            for r in 1..4 {
                if degrees(&network, r).is_ok() {
                    assert!((1..8).all(|s| is_robust(&graph, r, s)), "seed {seed}, r = {r}");
                    passed[0] += 1;
                }
                if let Some(witness) = counterexample(&graph, r, 2) {
                    let sets = [nodes(witness.first), nodes(witness.second)];
                    let evidence =
                        Evidence { network: network.clone(), claim: Claim::NotRobust { r, s: 2, sets } };
                    evidence.check().unwrap();
                    passed[1] += 1;
                }
            }
        }
        assert!(passed.iter().all(|count| *count > 20), "{passed:?}");
    }
}
