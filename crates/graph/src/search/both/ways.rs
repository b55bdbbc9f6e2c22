//! How many ways are open.

use alloc::vec;
use alloc::vec::Vec;

/// How many sets of so many of o nodes there are, for all o up to a number of nodes.
pub(super) struct Ways {
    nodes: usize,
    /// For each o and m the sets of at most m − 1 nodes.
    below: Vec<u128>,
}

impl Ways {
    pub(super) fn new(nodes: usize) -> Self {
        let mut below = Vec::new();
        let mut binomials = vec![0_u128; nodes + 1];
        binomials[0] = 1;
        for open in 0..=nodes {
            let mut sum = 0_u128;
            for binomial in &binomials {
                below.push(sum);
                sum = sum.saturating_add(*binomial);
            }
            below.push(sum);
            for place in (1..=nodes.min(open + 1)).rev() {
                binomials[place] = binomials[place].saturating_add(binomials[place - 1]);
            }
        }
        Self { nodes, below }
    }

    /// Sets of `least` to `most` of `open` nodes; there may be none.
    pub(super) fn between(&self, open: i32, least: i32, most: i32) -> u128 {
        let index = |count: i32| usize::try_from(count).unwrap_or(0);
        let below = |count: i32| {
            self.below[index(open).min(self.nodes) * (self.nodes + 2) + index(count).min(self.nodes + 1)]
        };
        below(most + 1).saturating_sub(below(least))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_are_counted() {
        let ways = Ways::new(6);
        let of = |(open, least, most)| ways.between(open, least, most);
        assert_eq!([(0, 0, 0), (4, 1, 1), (4, 0, 2), (6, -3, 9), (5, 2, 3)].map(of), [1, 4, 11, 64, 20]);
        assert_eq!([(3, 2, 1), (3, 4, 5), (5, -3, -2)].map(of), [0; 3]);
        assert_eq!(Ways::new(128).between(128, 0, 128), u128::MAX);
    }
}
