//! Finds orders: cores first, then whoever hears enough of those who are in.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::ControlFlow;

use super::cores::Cores;
use super::exact::{self, EFFORT};
use super::{Order, need_before};
use crate::effort::Meter;
use crate::network::Network;

/// Looking for cores may cost so many looks at an edge for each edge of the network.
const LOOKS_PER_EDGE: usize = 64;
/// So many small sets at most are given to the exact search.
const SETS_MAX: usize = 32;

/// An order that was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// The order.
    pub order: Order,
    /// In how many layers, the core counted.
    pub layers: usize,
}

impl Found {
    /// How many nodes the order has.
    #[must_use]
    pub fn node_count(&self) -> usize {
        size(&self.order)
    }
}

/// The order for the largest F that has one, as far as it is found; `None` if there is none even for F = 0. No F above `most` is tried.
#[must_use]
pub fn largest(network: &Network, most: usize) -> Option<Found> {
    let mut search = Search::new(network);
    let (mut found, mut least, mut above) = (None, 0, most.min(search.degeneracy()) + 1);
    // What has an order for F has one for every smaller F, but for what the search overlooks.
    while least < above {
        let f = if found.is_none() { least } else { least.midpoint(above - 1).max(least) };
        match search.best(f).filter(|order| search.is_complete(order)) {
            Some(order) => (found, least) = (Some(order), f + 1),
            None => above = f,
        }
    }
    let order = found?;
    let layers = order.check(network).ok()?;
    Some(Found { order, layers })
}

/// An order for F, if one is found.
#[must_use]
pub fn order(network: &Network, f: usize) -> Option<Order> {
    part(network, f).and_then(|found| found.order.check(network).is_ok().then_some(found.order))
}

/// The order of as many nodes as are found: of all, or of a part that survives F liars around each of its nodes by itself.
#[must_use]
pub fn part(network: &Network, f: usize) -> Option<Found> {
    parts(network, f, 1).pop()
}

/// Finds such parts for F from `least` on, as long as there is one, and at most `count` of them.
#[must_use]
pub fn parts(network: &Network, least: usize, count: usize) -> Vec<Found> {
    let mut search = Search::new(network);
    let found = (least..least.saturating_add(count)).map_while(|f| {
        let order = search.best(f)?;
        let layers = order.check_part(network).ok()?;
        Some(Found { order, layers })
    });
    found.collect()
}

/// A network in which orders are looked for.
struct Search<'a> {
    network: &'a Network,
    cores: Cores<'a>,
    /// Nodes, those with the largest coreness first.
    seeds: Vec<u32>,
    reach: Reach,
}

impl<'a> Search<'a> {
    fn new(network: &'a Network) -> Self {
        let hearers = network.transposed();
        let cores = Cores::new(network, &hearers);
        let mut seeds: Vec<u32> = (0_u32..).zip(&cores.coreness).map(|(node, _)| node).collect();
        seeds.sort_by_key(|node| core::cmp::Reverse(cores.coreness[*node as usize]));
        Self { network, cores, seeds, reach: Reach::new(hearers) }
    }

    /// No core hears more of itself than this.
    fn degeneracy(&self) -> usize {
        self.cores.coreness.iter().copied().max().unwrap_or(0) as usize
    }

    fn is_complete(&self, order: &Order) -> bool {
        size(order) == self.network.node_count()
    }

    /// The order for F that has most nodes, of those that are found.
    fn best(&mut self, f: usize) -> Option<Order> {
        let looks = (LOOKS_PER_EDGE * self.network.edge_count()).max(1 << 16);
        let counted = self.counted(f, looks);
        if counted.as_ref().is_some_and(|order| self.is_complete(order)) {
            return counted;
        }
        let searched = self.searched(f, looks);
        // The first of two that are as large is the one that is checked faster.
        [counted, searched].into_iter().flatten().rev().max_by_key(size)
    }

    /// The best order with a core whose members hear enough of it.
    fn counted(&mut self, f: usize, mut looks: usize) -> Option<Order> {
        let mut best: Option<Order> = None;
        let mut tried = vec![false; self.network.node_count()];
        for place in 0..self.seeds.len() {
            let seed = self.seeds[place];
            if (self.cores.coreness[seed as usize] as usize) < 2 * f || looks == 0 {
                break;
            }
            if tried[seed as usize] {
                continue;
            }
            for core in [self.cores.clique(seed, f, &mut looks), self.cores.thinned(seed, f, &mut looks)] {
                let Some(core) = core else { continue };
                let order = self.grown(core, f, &mut looks);
                // What this core reaches, a core within it does not leave.
                for node in order.core.iter().chain(&order.rest) {
                    tried[*node as usize] = true;
                }
                if self.is_complete(&order) {
                    return Some(order);
                }
                best = Some(larger(best, order));
            }
        }
        best
    }

    /// The best order with a small core that the exact search proves.
    fn searched(&mut self, f: usize, mut looks: usize) -> Option<Order> {
        let mut go_on = |_: &_| ControlFlow::Continue(());
        let mut meter = Meter::new(EFFORT, &mut go_on);
        let mut best: Option<Order> = None;
        for place in 0..self.seeds.len().min(SETS_MAX) {
            let seed = self.seeds[place];
            let is_in = |order: &Order| order.core.contains(&seed) || order.rest.contains(&seed);
            if (self.cores.coreness[seed as usize] as usize) <= f || best.as_ref().is_some_and(is_in) {
                continue;
            }
            let dense = self.cores.dense(seed, &mut looks);
            let least = (2 * f + 2).min(dense.len());
            let core = (least..=dense.len())
                .map(|size| &dense[..size])
                .find(|core| exact::survives(self.network, core, f, &mut meter));
            let Some(core) = core else { continue };
            let order = self.grown(core.to_vec(), f, &mut looks);
            if self.is_complete(&order) {
                return Some(order);
            }
            best = Some(larger(best, order));
        }
        best
    }

    /// The order that grows from a core.
    fn grown(&mut self, core: Vec<u32>, f: usize, looks: &mut usize) -> Order {
        let rest = self.reach.grow(&core, need_before(f), looks);
        Order { f, core, rest }
    }
}

/// The larger of the two, the first if they are alike.
fn larger(best: Option<Order>, order: Order) -> Order {
    match best {
        Some(best) if size(&best) >= size(&order) => best,
        _ => order,
    }
}

fn size(order: &Order) -> usize {
    order.core.len() + order.rest.len()
}

/// Who is reached from a core.
struct Reach {
    hearers: Network,
    /// How many of those who are in each node hears. All zero between two calls.
    heard: Vec<u32>,
    inside: Vec<bool>,
}

impl Reach {
    fn new(hearers: Network) -> Self {
        let count = hearers.node_count();
        Self { hearers, heard: vec![0; count], inside: vec![false; count] }
    }

    /// Everybody else who is reached: whoever hears `need` of those who are in is in. It looks at the edges of those alone.
    fn grow(&mut self, core: &[u32], need: usize, looks: &mut usize) -> Vec<u32> {
        let mut queue = core.to_vec();
        for node in core {
            self.inside[*node as usize] = true;
        }
        let mut next = 0;
        while let Some(&node) = queue.get(next) {
            next += 1;
            let hearers = self.hearers.heard(node as usize);
            *looks = looks.saturating_sub(hearers.len());
            for &hearer in hearers {
                let place = hearer as usize;
                self.heard[place] += 1;
                if self.heard[place] as usize >= need && !self.inside[place] {
                    self.inside[place] = true;
                    queue.push(hearer);
                }
            }
        }
        for node in &queue {
            self.inside[*node as usize] = false;
            for hearer in self.hearers.heard(*node as usize) {
                self.heard[*hearer as usize] = 0;
            }
        }
        queue.split_off(core.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::makers::fixed::bipartite;

    /// A hundred thousand nodes, each joined to the seven before it.
    #[test]
    fn long_networks_are_proved_in_no_time() {
        let nodes = 100_000_u32;
        let pairs: Vec<(u32, u32)> =
            (1..nodes).flat_map(|to| (to.saturating_sub(7)..to).map(move |from| (from, to))).collect();
        let network = Network::new(nodes as usize, false, &pairs);
        let found = largest(&network, 100).unwrap();
        assert_eq!(found.order.f, 3);
        assert!(found.layers > 10_000);
        assert_eq!(order(&network, 4), None);
    }

    /// Without triangles no core can be counted, and the exact search proves one.
    #[test]
    fn cores_without_triangles_are_proved_by_search() {
        let network = Network::from(&bipartite(6, 6).unwrap());
        let found = part(&network, 1).unwrap();
        assert_eq!(found.node_count(), 12);
        assert!(found.order.counts(&network).is_err() && found.order.check(&network).is_ok());
        assert!(order(&network, 5).is_none());
    }

    /// Two cliques that hear two of each other: each is a part.
    #[test]
    fn of_what_does_not_agree_the_largest_part_is_found() {
        let mut pairs = Vec::new();
        for (first, size) in [(0, 9), (9, 6)] {
            pairs.extend((first..first + size).flat_map(|to| (first..to).map(move |from| (from, to))));
        }
        pairs.extend([(0, 9), (1, 9), (0, 10), (1, 10)]);
        let network = Network::new(15, false, &pairs);
        assert!(order(&network, 1).is_none() && order(&network, 0).is_some());
        let found = part(&network, 1).unwrap();
        assert_eq!(found.node_count(), 9);
        assert!(matches!(found.order.check(&network), Err(crate::ranks::Wrong::Missing(_))));
    }
}
