//! Ranks in a given network: a certificate that it survives liars, which takes linear time to check.
//!
//! A *core* of m nodes that hear each other well, and an order of all others in which each hears 2F + 1 nodes of the core or before
//! it. Then W-MSR(F) agrees whatever up to F malicious nodes *around each normal node* tell, as long as each tells all the same
//! in a round (docs/theory, `thm:ranks`). There is no limit to the number of nodes, or of liars in all.
//!
//! That no such order was found says nothing: other networks survive too.

mod find;

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

pub use find::{Found, largest, order};

use crate::network::Network;

/// An order that shows that a network survives F liars around each node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Order {
    /// F.
    pub f: usize,
    /// The core. Each of its m nodes hears F + floor(m/2) others of it.
    pub core: Vec<u32>,
    /// All other nodes. Each hears 2F + 1 of the core or of those before it.
    pub rest: Vec<u32>,
}

/// What is wrong with an order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrong {
    /// A core of fewer than 2F + 1 nodes.
    Core {
        /// m.
        nodes: usize,
        /// 2F + 1.
        least: usize,
    },
    /// A node of the core hears too few others of it.
    InCore {
        /// Which.
        node: u32,
        /// How many it hears.
        heard: usize,
        /// F + floor(m/2).
        least: usize,
    },
    /// A node hears too few of those before it.
    Before {
        /// Which.
        node: u32,
        /// How many it hears.
        heard: usize,
        /// 2F + 1.
        least: usize,
    },
    /// A node that is there twice, or that the network does not have.
    Node(u32),
    /// A node of the network that is not there.
    Missing(u32),
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Core { nodes, least } => write!(f, "a core of {nodes} nodes, allowed are {least} or more"),
            Self::InCore { node, heard, least } => {
                write!(f, "node {node} of the core hears {heard} others of it, allowed are {least} or more")
            }
            Self::Before { node, heard, least } => {
                write!(f, "node {node} hears {heard} nodes before it, allowed are {least} or more")
            }
            Self::Node(node) => write!(f, "node {node} twice, or not a node of the network"),
            Self::Missing(node) => write!(f, "node {node} is not in the order"),
        }
    }
}

impl core::error::Error for Wrong {}

/// How many others of a core of `core` nodes each of it must hear.
#[must_use]
pub fn need_in_core(f: usize, core: usize) -> usize {
    f + core / 2
}

/// How many nodes before it every other node must hear.
#[must_use]
pub fn need_before(f: usize) -> usize {
    2 * f + 1
}

impl Order {
    /// Whether the order proves what it claims of `network`, and if so, in how many layers: the core is one, and each layer
    /// hears 2F + 1 of the earlier ones. It looks at every edge a few times.
    //= theory thm:ranks
    pub fn check(&self, network: &Network) -> Result<usize, Wrong> {
        let mut layer: Vec<Option<u32>> = vec![None; network.node_count()];
        let (least, count) = (need_before(self.f), self.core.len());
        if count < least {
            return Err(Wrong::Core { nodes: count, least });
        }
        for &node in &self.core {
            enter(&mut layer, node, 0)?;
        }
        let in_core = need_in_core(self.f, count);
        for &node in &self.core {
            let heard = network.heard(node as usize).iter().filter(|other| layer[**other as usize].is_some());
            let heard = heard.count();
            if heard < in_core {
                return Err(Wrong::InCore { node, heard, least: in_core });
            }
        }
        let mut before = Vec::new();
        for &node in &self.rest {
            before.clear();
            before.extend(network.heard(node as usize).iter().filter_map(|other| layer[*other as usize]));
            before.sort_unstable();
            let Some(highest) = before.get(least - 1) else {
                return Err(Wrong::Before { node, heard: before.len(), least });
            };
            enter(&mut layer, node, highest + 1)?;
        }
        let missing = (0_u32..).zip(&layer).find(|(_, layer)| layer.is_none());
        match missing {
            Some((node, _)) => Err(Wrong::Missing(node)),
            None => Ok(layer.iter().flatten().copied().max().unwrap_or(0) as usize + 1),
        }
    }
}

/// Notes the layer of a node that is new.
fn enter(layers: &mut [Option<u32>], node: u32, layer: u32) -> Result<(), Wrong> {
    match layers.get_mut(node as usize) {
        Some(place @ None) => {
            *place = Some(layer);
            Ok(())
        }
        _ => Err(Wrong::Node(node)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decide::Robustness;
    use crate::effort::{Effort, Meter};
    use crate::makers::fixed::{complete, petersen, tight};
    use crate::makers::random::erdos_renyi;
    use core::ops::ControlFlow;

    //= theory thm:ranks type=test
    #[test]
    fn what_is_found_is_checked_and_robust() {
        let mut found = 0;
        for seed in 0..300 {
            let graph =
                erdos_renyi(9, 0.4 + 0.002 * f64::from(u32::try_from(seed).unwrap()), seed % 3 == 0, seed)
                    .unwrap();
            let network = Network::from(&graph);
            let mut go_on = |_: &_| ControlFlow::Continue(());
            let mut meter = Meter::new(u64::MAX, &mut go_on);
            let f_max = Robustness::new(&graph, &Effort::UNLIMITED).f_max(&mut meter).exactly().unwrap();
            for f in 0..4 {
                let Some(order) = order(&network, f) else { continue };
                order.check(&network).unwrap();
                assert!(
                    i32::try_from(f).unwrap() <= f_max,
                    "seed {seed}: an order for F = {f}, F_max = {f_max}"
                );
                found += 1;
            }
        }
        assert!(found > 300, "{found}");
    }

    #[test]
    fn a_wrong_order_is_refused() {
        let network = Network::from(&complete(9).unwrap());
        let good = order(&network, 2).unwrap();
        assert_eq!(good.check(&network), Ok(2));
        let wrong = |change: fn(&mut Order)| {
            let mut order = good.clone();
            change(&mut order);
            order.check(&network).unwrap_err()
        };
        assert!(matches!(wrong(|order| order.core.truncate(4)), Wrong::Core { nodes: 4, least: 5 }));
        assert!(matches!(wrong(|order| order.f = 3), Wrong::Core { least: 7, .. } | Wrong::InCore { .. }));
        assert!(matches!(wrong(|order| order.rest.truncate(3)), Wrong::Missing(_)));
        assert!(matches!(wrong(|order| order.rest[3] = order.core[0]), Wrong::Node(_)));
        assert_eq!(wrong(|order| order.rest[0] = 9), Wrong::Before { node: 9, heard: 0, least: 5 });
        let sparse = Network::from(&petersen().unwrap());
        assert!(matches!(
            good.check(&sparse),
            Err(Wrong::InCore { .. } | Wrong::Node(_) | Wrong::Missing(_))
        ));
        for f in 1..4 {
            assert_eq!(order(&Network::from(&tight(10, f).unwrap()), f), None, "one degree short");
        }
    }

    /// A core that stands on one edge less than the theorem asks is refused.
    #[test]
    fn a_core_one_link_short_is_refused() {
        let mut graph = complete(5).unwrap();
        graph.remove_edge(0, 1);
        let order = Order { f: 2, core: vec![0, 1, 2, 3, 4], rest: vec![] };
        let wrong = order.check(&Network::from(&graph)).unwrap_err();
        assert_eq!(wrong, Wrong::InCore { node: 0, heard: 3, least: 4 });
    }
}
