//! Sets of nodes as rows of bits.

use core::fmt;

/// Largest number of nodes of a graph: one `u128` is one row of the adjacency matrix.
pub const NODE_LIMIT: usize = 128;

/// A set of nodes `0 ..= 127`, one bit each.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeSet(u128);

impl NodeSet {
    /// The set without nodes.
    pub const EMPTY: Self = Self(0);

    /// The set whose members are the ones of `bits`; bit k is node k.
    #[must_use]
    pub const fn from_bits(bits: u128) -> Self {
        Self(bits)
    }

    /// The bits of the set; bit k is node k.
    #[must_use]
    pub const fn bits(self) -> u128 {
        self.0
    }

    /// The nodes `0 .. count`; `count` above [`NODE_LIMIT`] means all nodes.
    #[must_use]
    pub const fn first(count: usize) -> Self {
        if count >= NODE_LIMIT { Self(u128::MAX) } else { Self((1 << count) - 1) }
    }

    /// Whether `node` is a member. False for every `node >= NODE_LIMIT`.
    #[must_use]
    pub const fn contains(self, node: usize) -> bool {
        node < NODE_LIMIT && self.0 >> node & 1 == 1
    }

    /// Adds `node`. A `node >= NODE_LIMIT` is not added.
    pub const fn insert(&mut self, node: usize) {
        if node < NODE_LIMIT {
            self.0 |= 1 << node;
        }
    }

    /// Takes `node` out, if it is there.
    pub const fn remove(&mut self, node: usize) {
        if node < NODE_LIMIT {
            self.0 &= !(1 << node);
        }
    }

    /// Number of members, `0 ..= 128`.
    #[must_use]
    pub const fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether there is no member.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Members of either set.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Members of both sets.
    #[must_use]
    pub const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Members of this set that are not members of `other`.
    #[must_use]
    pub const fn difference(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether the two sets share no member.
    #[must_use]
    pub const fn is_disjoint(self, other: Self) -> bool {
        self.0 & other.0 == 0
    }

    /// Whether every member is a member of `other`.
    #[must_use]
    pub const fn is_subset(self, other: Self) -> bool {
        self.0 & !other.0 == 0
    }

    /// The members, least first.
    pub fn iter(self) -> impl Iterator<Item = usize> + Clone {
        let mut rest = self.0;
        core::iter::from_fn(move || {
            (rest != 0).then(|| {
                let node = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                node
            })
        })
    }
}

impl FromIterator<usize> for NodeSet {
    fn from_iter<I: IntoIterator<Item = usize>>(nodes: I) -> Self {
        let mut set = Self::EMPTY;
        for node in nodes {
            set.insert(node);
        }
        set
    }
}

impl fmt::Debug for NodeSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_come_back_in_order() {
        let set: NodeSet = [127, 3, 64, 3].into_iter().collect();
        assert!(set.iter().eq([3, 64, 127]));
        assert_eq!(set.len(), 3);
        assert!(!set.contains(128));
        assert_eq!(NodeSet::first(128).len(), 128);
    }
}
