//! Sets that may be cores: cliques, neighbourhoods thinned out, and small dense sets for the exact search.

use alloc::vec;
use alloc::vec::Vec;

use super::exact::CORE_MAX as EXACT_MAX;
use super::need_in_core;
use crate::network::Network;

/// The neighbourhood of a node is thinned out to a core only up to this size.
const CORE_MAX: usize = 256;

/// A network in which cores are looked for.
pub(super) struct Cores<'a> {
    network: &'a Network,
    /// The largest k such that the node is in a set whose members each hear k others of it.
    pub(super) coreness: Vec<u32>,
}

impl<'a> Cores<'a> {
    pub(super) fn new(network: &'a Network, hearers: &Network) -> Self {
        Self { network, coreness: coreness(network, hearers) }
    }

    /// 2F + 1 nodes around `seed` that all hear each other, the best connected first.
    pub(super) fn clique(&self, seed: u32, f: usize, looks: &mut usize) -> Option<Vec<u32>> {
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
    pub(super) fn thinned(&self, seed: u32, f: usize, looks: &mut usize) -> Option<Vec<u32>> {
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

    /// A small set around `seed`, one node after another, each the one that is joined best to those before it.
    pub(super) fn dense(&self, seed: u32, looks: &mut usize) -> Vec<u32> {
        let mut set = vec![seed];
        let mut links: Vec<(u32, usize)> = Vec::new();
        let mut newest = seed;
        while set.len() < EXACT_MAX {
            let near = self.network.heard(newest as usize);
            if near.len() > CORE_MAX {
                break;
            }
            *looks = looks.saturating_sub(near.len() + links.len());
            for &node in near.iter().filter(|node| !set.contains(node)) {
                match links.iter_mut().find(|(other, _)| *other == node) {
                    Some((_, count)) => *count += 1,
                    None => links.push((node, 1)),
                }
            }
            let best = (0..links.len()).max_by_key(|place| {
                let (node, count) = links[*place];
                (count, self.coreness[node as usize], core::cmp::Reverse(node))
            });
            let Some(best) = best else { break };
            newest = links.swap_remove(best).0;
            set.push(newest);
        }
        set
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
}
