//! Ranks in a given network: a certificate that it survives liars, which takes linear time to check.
//!
//! A *core* of m nodes that hear each other well, and an order of all others in which each hears 2F + 1 nodes of the core or before
//! it. Then W-MSR(F) agrees whatever up to F malicious nodes *around each normal node* tell, as long as each tells all the same
//! in a round (docs/theory, `thm:ranks`). There is no limit to the number of nodes, or of liars in all.
//!
//! That no such order was found says nothing: other networks survive too.

mod cores;
mod exact;
mod find;

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::ops::ControlFlow;

pub use find::{Found, largest, order, part, parts};

use crate::effort::Meter;
use crate::graph::Graph;
use crate::network::Network;

/// An order that shows that a network survives F liars around each node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Order {
    /// F.
    pub f: usize,
    /// The core. Each of its m nodes hears F + floor(m/2) others of it, or it is small and survives by an exact search.
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
    /// A node of the core hears too few others of it, and no exact search proves the core.
    InCore {
        /// The node.
        node: u32,
        /// How many it hears.
        heard: usize,
        /// F + floor(m/2).
        least: usize,
    },
    /// A node hears too few of those before it.
    Before {
        /// The node.
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
    /// hears 2F + 1 of the earlier ones. It looks at every edge a few times. A small core that does not hear enough of itself is
    /// searched for sets that never agree, within a fixed effort.
    //= theory thm:ranks
    pub fn check(&self, network: &Network) -> Result<usize, Wrong> {
        self.complete(network, Self::check_part)
    }

    /// As [`check`](Self::check), by counting alone: no core is searched.
    pub fn counts(&self, network: &Network) -> Result<usize, Wrong> {
        self.complete(network, |order, network| {
            let layer = order.core_by_counts(network)?;
            order.layers(network, layer)
        })
    }

    /// As [`check`](Self::check), without a look into the core: whether all others hear enough of those before them, and all nodes are there.
    pub fn around_core(&self, network: &Network) -> Result<usize, Wrong> {
        self.complete(network, |order, network| order.layers(network, order.core_layer(network)?))
    }

    /// The network among the nodes of the core, in the order in which the core names them; `None` if they are more than 128, or none.
    #[must_use]
    pub fn core_graph(&self, network: &Network) -> Option<Graph> {
        exact::inside(network, &self.core)
    }

    /// Whether the order proves that its nodes survive if they listen to each other only, and in how many layers.
    pub fn check_part(&self, network: &Network) -> Result<usize, Wrong> {
        let layer = match self.core_by_counts(network) {
            Err(wrong @ Wrong::InCore { .. }) => self.core_by_search(network).ok_or(wrong)?,
            layer => layer?,
        };
        self.layers(network, layer)
    }

    /// A check of a part, and that all nodes are there.
    fn complete(
        &self,
        network: &Network,
        check: impl Fn(&Self, &Network) -> Result<usize, Wrong>,
    ) -> Result<usize, Wrong> {
        let layers = check(self, network)?;
        let mut is_there = vec![false; network.node_count()];
        for node in self.core.iter().chain(&self.rest) {
            is_there[*node as usize] = true;
        }
        match (0_u32..).zip(&is_there).find(|(_, is_there)| !**is_there) {
            Some((node, _)) => Err(Wrong::Missing(node)),
            None => Ok(layers),
        }
    }

    /// The layers of the core, in which each node hears enough of it.
    fn core_by_counts(&self, network: &Network) -> Result<Vec<Option<u32>>, Wrong> {
        let (least, count) = (need_before(self.f), self.core.len());
        if count < least {
            return Err(Wrong::Core { nodes: count, least });
        }
        let layer = self.core_layer(network)?;
        let least = need_in_core(self.f, count);
        for &node in &self.core {
            let heard = network.heard(node as usize).iter().filter(|other| layer[**other as usize].is_some());
            let heard = heard.count();
            if heard < least {
                return Err(Wrong::InCore { node, heard, least });
            }
        }
        Ok(layer)
    }

    /// The layers of the core, of which an exact search says that it survives by itself.
    fn core_by_search(&self, network: &Network) -> Option<Vec<Option<u32>>> {
        let mut go_on = |_: &_| ControlFlow::Continue(());
        let mut meter = Meter::new(exact::EFFORT, &mut go_on);
        let survives = exact::survives(network, &self.core, self.f, &mut meter);
        if survives { self.core_layer(network).ok() } else { None }
    }

    fn core_layer(&self, network: &Network) -> Result<Vec<Option<u32>>, Wrong> {
        let mut layer = vec![None; network.node_count()];
        self.core.iter().try_for_each(|node| enter(&mut layer, *node, 0))?;
        Ok(layer)
    }

    /// How many layers there are, if everybody hears enough of those before it.
    fn layers(&self, network: &Network, mut layer: Vec<Option<u32>>) -> Result<usize, Wrong> {
        let least = need_before(self.f);
        let (mut before, mut most) = (Vec::new(), 0);
        for &node in &self.rest {
            before.clear();
            before.extend(network.heard(node as usize).iter().filter_map(|other| layer[*other as usize]));
            if before.len() < least {
                return Err(Wrong::Before { node, heard: before.len(), least });
            }
            let (_, highest, _) = before.select_nth_unstable(least - 1);
            let own = *highest + 1;
            enter(&mut layer, node, own)?;
            most = most.max(own);
        }
        Ok(most as usize + 1)
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
    use crate::effort::Effort;
    use crate::makers::fixed::{complete, petersen, tight};
    use crate::makers::random::erdos_renyi;

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
