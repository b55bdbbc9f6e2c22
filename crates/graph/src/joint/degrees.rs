//! What some nodes can hear together, if only their number is known.

use alloc::vec;
use alloc::vec::Vec;

use crate::graph::Graph;

/// Sums of the least and of the largest degrees.
#[derive(Clone, Debug)]
pub(super) struct Degrees {
    /// The sum of the so many least ones.
    least: Vec<i128>,
    /// The sum of the so many largest ones.
    most: Vec<i128>,
}

impl Degrees {
    pub(super) fn new(graph: &Graph) -> Self {
        let degree = |node: usize| i128::try_from(graph.in_degree(node)).unwrap_or(0);
        let mut sorted: Vec<i128> = (0..graph.node_count()).map(degree).collect();
        sorted.sort_unstable();
        let least = sums(sorted.iter());
        Self { least, most: sums(sorted.iter().rev()) }
    }

    /// Whether all nodes have the same degree.
    pub(super) fn are_equal(&self) -> bool {
        self.least == self.most
    }

    /// Between what the degrees of so many nodes sum to.
    pub(super) fn sums(&self, count: i128) -> [i128; 2] {
        let count = usize::try_from(count).unwrap_or(0);
        [&self.least, &self.most].map(|sums| sums.get(count).copied().unwrap_or(0))
    }
}

fn sums<'a>(degrees: impl Iterator<Item = &'a i128>) -> Vec<i128> {
    let mut sums = vec![0];
    for degree in degrees {
        sums.push(sums[sums.len() - 1] + degree);
    }
    sums
}
