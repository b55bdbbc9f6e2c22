//! Finds orders: cores first, then whoever hears enough of those who are in.

use alloc::vec;
use alloc::vec::Vec;

use super::{Order, need_before, need_in_core};
use crate::network::Network;

/// Looking for cores may cost so many looks at an edge for each edge of the network.
const LOOKS_PER_EDGE: usize = 64;
/// The neighbourhood of a node is thinned out to a core only up to this size.
const CORE_MAX: usize = 256;

/// The largest F for which an order was found, with its order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// The order.
    pub order: Order,
    /// In how many layers, the core counted.
    pub layers: usize,
}

/// The order for the largest F that has one, as far as it is found; `None` if there is none even for F = 0. No F above `most` is tried.
#[must_use]
pub fn largest(network: &Network, most: usize) -> Option<Found> {
    let search = Search::new(network);
    let (mut found, mut least, mut above) = (None, 0, most.min(search.degeneracy()) + 1);
    // What has an order for F has one for every smaller F, but for what the search overlooks.
    while least < above {
        let f = if found.is_none() { least } else { least.midpoint(above - 1).max(least) };
        match search.order(f) {
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
    let order = Search::new(network).order(f)?;
    order.check(network).is_ok().then_some(order)
}

/// A network in which cores are looked for.
struct Search<'a> {
    network: &'a Network,
    hearers: Network,
    /// The largest k such that the node is in a set whose members each hear k others of it.
    coreness: Vec<u32>,
    /// Nodes, those with the largest coreness first.
    seeds: Vec<u32>,
}

impl<'a> Search<'a> {
    fn new(network: &'a Network) -> Self {
        let hearers = network.transposed();
        let coreness = coreness(network, &hearers);
        let mut seeds: Vec<u32> = (0_u32..).zip(&coreness).map(|(node, _)| node).collect();
        seeds.sort_by_key(|node| core::cmp::Reverse(coreness[*node as usize]));
        Self { network, hearers, coreness, seeds }
    }

    /// No core hears more of itself than this.
    fn degeneracy(&self) -> usize {
        self.coreness.iter().copied().max().unwrap_or(0) as usize
    }

    /// An order for F: that of the first core that reaches everybody.
    fn order(&self, f: usize) -> Option<Order> {
        let (need, count) = (need_before(f), self.network.node_count());
        // Whoever hears fewer can be nothing but a member of a small core.
        let short = self.network.degrees().filter(|degree| *degree < need).count();
        if short > 2 * f + 1 {
            return None;
        }
        let mut looks = (LOOKS_PER_EDGE * self.network.edge_count()).max(1 << 16);
        let mut tried = vec![false; count];
        for &seed in &self.seeds {
            if (self.coreness[seed as usize] as usize) < 2 * f || looks == 0 {
                return None;
            }
            if tried[seed as usize] {
                continue;
            }
            for core in [self.clique(seed, f, &mut looks), self.thinned(seed, f, &mut looks)] {
                let Some(core) = core else { continue };
                let rest = self.grow(&core, need, &mut looks);
                if core.len() + rest.len() == count {
                    return Some(Order { f, core, rest });
                }
                // What this core reaches, a core within it does not leave.
                for node in core.iter().chain(&rest) {
                    tried[*node as usize] = true;
                }
            }
        }
        None
    }

    /// 2F + 1 nodes around `seed` that all hear each other, the best connected first.
    fn clique(&self, seed: u32, f: usize, looks: &mut usize) -> Option<Vec<u32>> {
        let both = |one: u32, other: u32| {
            self.network.has_edge(one, other as usize) && self.network.has_edge(other, one as usize)
        };
        let mut near: Vec<u32> = self.network.heard(seed as usize).to_vec();
        near.retain(|node| self.coreness[*node as usize] as usize >= 2 * f && both(seed, *node));
        near.sort_by_key(|node| core::cmp::Reverse(self.coreness[*node as usize]));
        let mut clique = vec![seed];
        for node in near {
            if clique.len() == 2 * f + 1 {
                break;
            }
            *looks = looks.saturating_sub(clique.len());
            if clique.iter().all(|other| both(*other, node)) {
                clique.push(node);
            }
        }
        (clique.len() == 2 * f + 1).then_some(clique)
    }

    /// The neighbourhood of `seed` without those who hear too few of it, one after another, the worst first.
    fn thinned(&self, seed: u32, f: usize, looks: &mut usize) -> Option<Vec<u32>> {
        let mut core: Vec<u32> = self.network.heard(seed as usize).to_vec();
        core.push(seed);
        core.retain(|node| self.coreness[*node as usize] as usize >= 2 * f);
        if core.len() > CORE_MAX {
            return None;
        }
        core.sort_unstable();
        let heard = |node: u32, core: &[u32]| {
            self.network.heard(node as usize).iter().filter(|other| core.binary_search(other).is_ok()).count()
        };
        let mut heards: Vec<usize> = core.iter().map(|node| heard(*node, &core)).collect();
        *looks = looks.saturating_sub(core.iter().map(|node| self.network.heard(*node as usize).len()).sum());
        while core.len() > 2 * f {
            let (place, least) = heards.iter().copied().enumerate().min_by_key(|(_, heard)| *heard)?;
            if least >= need_in_core(f, core.len()) {
                return Some(core);
            }
            let gone = core.remove(place);
            heards.remove(place);
            for (node, heard) in core.iter().zip(&mut heards) {
                *heard -= usize::from(self.network.has_edge(gone, *node as usize));
            }
            *looks = looks.saturating_sub(core.len());
        }
        None
    }

    /// Everybody else who is reached: whoever hears `need` of those who are in is in.
    fn grow(&self, core: &[u32], need: usize, looks: &mut usize) -> Vec<u32> {
        let mut heard = vec![0; self.network.node_count()];
        let mut inside = vec![false; heard.len()];
        for node in core {
            inside[*node as usize] = true;
        }
        let (mut rest, mut next) = (Vec::new(), 0);
        let mut queue = core.to_vec();
        while let Some(&node) = queue.get(next) {
            next += 1;
            let hearers = self.hearers.heard(node as usize);
            *looks = looks.saturating_sub(hearers.len());
            for &hearer in hearers {
                let place = hearer as usize;
                heard[place] += 1;
                if heard[place] >= need && !inside[place] {
                    inside[place] = true;
                    rest.push(hearer);
                    queue.push(hearer);
                }
            }
        }
        rest
    }
}

/// For each node the largest k such that it is in a set whose members each hear k others of it: peel off the least, again and again.
fn coreness(network: &Network, hearers: &Network) -> Vec<u32> {
    let mut degrees: Vec<usize> = network.degrees().collect();
    let most = degrees.iter().copied().max().unwrap_or(0);
    let mut buckets: Vec<Vec<u32>> = vec![Vec::new(); most + 1];
    for (node, degree) in (0_u32..).zip(&degrees) {
        buckets[*degree].push(node);
    }
    let mut coreness = vec![None; degrees.len()];
    let (mut level, mut k) = (0, 0);
    while level <= most {
        let Some(node) = buckets[level].pop() else {
            level += 1;
            continue;
        };
        let place = node as usize;
        if coreness[place].is_some() || degrees[place] != level {
            continue;
        }
        k = k.max(level);
        coreness[place] = u32::try_from(k).ok();
        for &hearer in hearers.heard(place) {
            let other = hearer as usize;
            if coreness[other].is_none() {
                degrees[other] -= 1;
                buckets[degrees[other]].push(hearer);
                level = level.min(degrees[other]);
            }
        }
    }
    coreness.into_iter().map(|k| k.unwrap_or(0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::makers::fixed::{complete, ring};

    #[test]
    fn coreness_is_what_its_definition_says() {
        let of = |network: &Network| coreness(network, &network.transposed());
        assert_eq!(of(&Network::from(&complete(5).unwrap())), [4; 5]);
        assert_eq!(of(&Network::from(&ring(6).unwrap())), [2; 6]);
        // A triangle with a tail.
        let tail = Network::new(5, false, &[(0, 1), (1, 2), (2, 0), (2, 3), (3, 4)]);
        assert_eq!(of(&tail), [2, 2, 2, 1, 1]);
    }

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
}
