//! Which quadruples of sizes are left at a place of the tree, and what they say together.

use alloc::vec::Vec;

use super::known::Known;
use super::roles::{EXEMPT, ROLES};
use crate::graph::word::Word;
use crate::joint::Quadruple;

/// Sets of roles, a bit for each.
const SETS: usize = 1 << ROLES;

/// A number of nodes for each set of roles.
pub(super) type Counts = [u8; SETS];

/// How many nodes have one of some roles, by a quadruple.
pub(super) fn counts(quadruple: &Quadruple, nodes: i32) -> Counts {
    let [first, second] = [0, 1].map(|set| [quadruple.content[set], quadruple.exempt[set]]);
    let rest = nodes - quadruple.size(0) - quadruple.size(1);
    let roles = [first[0], first[1], second[0], second[1], rest];
    core::array::from_fn(|set| {
        let sum: i32 = (0..ROLES).filter(|role| set >> role & 1 == 1).map(|role| roles[role]).sum();
        u8::try_from(sum).unwrap_or(u8::MAX)
    })
}

/// No more counts than this are compared at each place.
const COUNTS_MOST: usize = 64;

/// The same counts, or if they are many, the most of some that follow each other in the place of those.
pub(super) fn merged(counts: &[Counts]) -> Vec<Counts> {
    let chunks = counts.chunks(counts.len().div_ceil(COUNTS_MOST).max(1));
    chunks.map(|chunk| chunk.iter().fold([0; SETS], most_of)).collect()
}

/// The larger of two counts, for each set of roles.
fn most_of(mut most: Counts, counts: &Counts) -> Counts {
    for (most, count) in most.iter_mut().zip(counts) {
        *most = (*most).max(*count);
    }
    most
}

/// What is left for nodes to be.
pub(super) struct Roles<W> {
    /// For each set of roles those who have one of them for certain.
    certain: [W; SETS],
}

impl<W: Word> Roles<W> {
    pub(super) fn new(known: &Known<W>, field: W) -> Self {
        let [first, second] = known.sides.map(|side| [side.able, side.allowed.without(side.content)]);
        let roles = [first[0], first[1], second[0], second[1], known.rest];
        let mut may = [W::NONE; SETS];
        for set in 1..SETS {
            let role = set.trailing_zeros() as usize;
            may[set] = may[set & (set - 1)] | roles[role];
        }
        Self { certain: core::array::from_fn(|set| field.without(may[SETS - 1 - set])) }
    }

    /// The most nodes that have one of some roles, by those quadruples that fit: none has fewer than have the role for certain, or fewer exempt
    /// members than that. `None` if none fit.
    //= theory sec:joint-search
    pub(super) fn limits(&self, quadruples: &[Counts], exempt: [i32; 2]) -> Option<Counts> {
        let mut least = self.certain.map(|nodes| u8::try_from(nodes.count()).unwrap_or(u8::MAX));
        for (set, exempt) in EXEMPT.into_iter().zip(exempt) {
            least[set] = least[set].max(u8::try_from(exempt).unwrap_or(u8::MAX));
        }
        let fitting = quadruples.iter().filter(|counts| is_enough(counts, &least));
        let most = fitting.fold([0; SETS], most_of);
        (most[SETS - 1] > 0).then_some(most)
    }

    /// Where as many nodes have one of some roles for certain as may have one, no others have.
    pub(super) fn bound(&self, known: &mut Known<W>, most: &Counts) {
        for set in 1..SETS - 1 {
            let certain = self.certain[set];
            if certain.count() == i32::from(most[set]) {
                known.keep(set, certain);
            }
        }
    }
}

/// Without a branch, so that all are compared at once.
fn is_enough(counts: &Counts, least: &Counts) -> bool {
    counts.iter().zip(least).fold(0, |short, (count, least)| short | u8::from(count < least)) == 0
}

/// From how many to how many nodes have one of some roles.
pub(super) fn range(most: &Counts, set: usize) -> [i32; 2] {
    [i32::from(most[SETS - 1]) - i32::from(most[SETS - 1 - set]), i32::from(most[set])]
}
