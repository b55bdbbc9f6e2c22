//! The largest robustness that n nodes can have, on as few links as can be.
//!
//! After the *minimal edge robust graphs* of Lee and Panagou ("Minimal Construction of Graphs with Maximum Robustness",
//! arXiv 2507.00415), built from what its public summaries say of them: their numbers of links and the cliques in them. That
//! instances have the largest robustness is proved by exact search, and for up to six nodes that fewer links do not do.

use super::fixed::joined;
use super::{MakerError, require};
use crate::graph::Graph;
use crate::graph::set::NODE_LIMIT;

/// The largest r, c = ceil(n/2), on the fewest links: 3c(c − 1)/2 for odd n, and floor(c/2) + 1 more for even n.
///
/// For odd n the first c − 1 nodes are joined to all and the others form a path, as in [`elemental`](super::fixed::elemental). For
/// even n the first half is joined to all, but for floor((c − 1)/2) pairs within it, and the other half has no links of its own.
pub fn merg(node_count: usize) -> Result<Graph, MakerError> {
    require((1..=NODE_LIMIT).contains(&node_count), "node_count", "1 to 128")?;
    let most = node_count.div_ceil(2);
    if node_count % 2 == 1 {
        return joined(node_count, |less, greater| less + 1 < most || greater == less + 1);
    }
    joined(node_count, |less, greater| less < most && !is_pair(less, greater, most.saturating_sub(1) / 2))
}

/// The largest F, ceil(n/2) − 1, on the fewest links: all for odd n, and floor(n/4) fewer for even n, no two of which meet.
pub fn merg_f(node_count: usize) -> Result<Graph, MakerError> {
    require((1..=NODE_LIMIT).contains(&node_count), "node_count", "1 to 128")?;
    let pairs = if node_count % 2 == 1 { 0 } else { node_count / 4 };
    joined(node_count, |less, greater| !is_pair(less, greater, pairs))
}

/// Whether the two are one of the first `pairs` of 0 and 1, 2 and 3, and so on.
fn is_pair(less: usize, greater: usize, pairs: usize) -> bool {
    less.is_multiple_of(2) && greater == less + 1 && less / 2 < pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::largest;
    use crate::definition::is_robust;

    #[test]
    fn they_have_the_largest_robustness_on_so_many_links() {
        for n in 1..=13_usize {
            let most = i32::try_from(n.div_ceil(2)).unwrap();
            let (graph, both) = (merg(n).unwrap(), merg_f(n).unwrap());
            assert_eq!(largest(&graph).0.exactly(), Some(most), "n = {n}");
            assert_eq!(largest(&both).1.exactly(), Some(most - 1), "n = {n}");
            let c = n.div_ceil(2);
            assert_eq!(graph.edge_count(), 3 * c * (c - 1) / 2 + if n % 2 == 0 { c / 2 + 1 } else { 0 });
            assert_eq!(both.edge_count(), n * (n - 1) / 2 - if n % 2 == 0 { n / 4 } else { 0 });
        }
        assert!(merg(0).is_err() && merg_f(129).is_err());
    }

    /// All graphs of up to six nodes with one link fewer: no link more can make up for it, as links never harm.
    #[test]
    fn fewer_links_do_not_do() {
        for n in 2..=6_usize {
            let most = n.div_ceil(2);
            for (graph, s) in [(merg(n).unwrap(), 1), (merg_f(n).unwrap(), most)] {
                let pairs: alloc::vec::Vec<(usize, usize)> =
                    (1..n).flat_map(|to| (0..to).map(move |from| (from, to))).collect();
                let fewer = graph.edge_count() - 1;
                for set in (0_u32..1 << pairs.len()).filter(|set| set.count_ones() as usize == fewer) {
                    let chosen = |less, greater| {
                        pairs
                            .iter()
                            .position(|pair| *pair == (less, greater))
                            .is_some_and(|at| set >> at & 1 == 1)
                    };
                    assert!(!is_robust(&joined(n, chosen).unwrap(), most, s), "n = {n}, s = {s}: {set:b}");
                }
            }
        }
    }
}
