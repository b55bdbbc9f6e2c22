//! Five parts of the nodes, and the numbers of links between them.

/// The content members of S₁, its exempt ones, those of S₂, its exempt ones, and the nodes that are in neither set.
pub(super) const PARTS: usize = 5;

/// The nodes that are in neither set.
pub(super) const REST: usize = 4;

/// Pairs of parts, each part with itself among them.
pub(super) const PAIRS: usize = PARTS * (PARTS + 1) / 2;

/// How many nodes each part has.
pub(super) type Counts = [i128; PARTS];

/// How many members of each kind two disjoint sets have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Quadruple {
    /// Content members of S₁ and of S₂.
    pub(crate) content: [i32; 2],
    /// Exempt members of S₁ and of S₂.
    pub(crate) exempt: [i32; 2],
}

impl Quadruple {
    /// Members of one of the sets.
    pub(crate) fn size(&self, set: usize) -> i32 {
        self.content[set] + self.exempt[set]
    }

    /// How many of so many nodes each part has.
    pub(super) fn counts(&self, nodes: i32) -> Counts {
        let rest = nodes - self.size(0) - self.size(1);
        [self.content[0], self.exempt[0], self.content[1], self.exempt[1], rest].map(i128::from)
    }
}

/// A weighted sum of the numbers of links, and between what it lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) weights: [i128; PAIRS],
    pub(super) low: Option<i128>,
    pub(super) high: Option<i128>,
}

/// The place of a pair of parts in a row, in either order.
pub(super) const fn pair(one: usize, other: usize) -> usize {
    let (low, high) = if one < other { (one, other) } else { (other, one) };
    low * (2 * PARTS + 1 - low) / 2 + high - low
}

/// All pairs, in the order of their places.
pub(super) fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..PARTS).flat_map(|one| (one..PARTS).map(move |other| (one, other)))
}

/// How many links each pair has room for.
pub(super) fn rooms(counts: &Counts) -> [i128; PAIRS] {
    let mut rooms = [0; PAIRS];
    for (one, other) in pairs() {
        let ends = counts[one] * if one == other { counts[one] - 1 } else { counts[other] };
        rooms[pair(one, other)] = if one == other { ends / 2 } else { ends };
    }
    rooms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_have_their_places() {
        for (place, (one, other)) in pairs().enumerate() {
            assert_eq!([pair(one, other), pair(other, one)], [place; 2]);
        }
        assert_eq!(pairs().count(), PAIRS);
        assert_eq!(rooms(&[3, 0, 2, 1, 4])[..5], [3, 0, 6, 3, 12]);
    }
}
