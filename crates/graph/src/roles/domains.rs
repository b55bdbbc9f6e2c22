//! The roles that each node may still have.

use crate::graph::word::Word;

/// For each role the nodes that may have it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Domains<W> {
    /// Honest in S₁, honest in S₂.
    pub(super) honest: [W; 2],
    /// Honest in neither.
    pub(super) neither: W,
    /// Liars with S₁, liars with S₂.
    pub(super) liars: [W; 2],
}

/// Roles as bits: honest in S₁, honest in S₂, neither, liar with S₁, liar with S₂.
pub(super) type Mask = u8;

/// Honest in S₁, honest in S₂.
pub(super) const HONEST: [Mask; 2] = [1, 2];
/// In S₁, in S₂.
pub(super) const INSIDE: [Mask; 2] = [1 | 8, 2 | 16];
/// Every role.
const ALL: Mask = 31;

impl<W: Word> Domains<W> {
    /// Every node of `field` may have every role.
    pub(super) fn all(field: W) -> Self {
        Self { honest: [field; 2], neither: field, liars: [field; 2] }
    }

    /// Nobody may have any role.
    pub(super) fn none() -> Self {
        Self::all(W::NONE)
    }

    /// Who may be a member of a set.
    pub(super) fn inside(&self, side: usize) -> W {
        self.honest[side] | self.liars[side]
    }

    /// Who may be a liar.
    pub(super) fn may_lie(&self) -> W {
        self.liars[0] | self.liars[1]
    }

    /// Who may be honest.
    pub(super) fn may_be_honest(&self) -> W {
        self.honest[0] | self.honest[1] | self.neither
    }

    /// Who lies for certain, of those who have any role.
    pub(super) fn surely_liars(&self) -> W {
        self.may_lie().without(self.may_be_honest())
    }

    /// Who is honest in a set for certain.
    pub(super) fn surely_honest(&self, side: usize) -> W {
        self.honest[side].without(self.honest[1 - side] | self.neither | self.may_lie())
    }

    /// Who is in a set for certain.
    pub(super) fn surely_inside(&self, side: usize) -> W {
        self.inside(side).without(self.inside(1 - side) | self.neither)
    }

    /// Who may have any role.
    pub(super) fn some(&self) -> W {
        self.may_be_honest() | self.may_lie()
    }

    /// The roles that a node may have.
    pub(super) fn of(&self, node: usize) -> Mask {
        let one = W::one(node);
        let bit = |set: W, bit: Mask| if one.is_within(set) { bit } else { 0 };
        bit(self.honest[0], 1)
            | bit(self.honest[1], 2)
            | bit(self.neither, 4)
            | bit(self.liars[0], 8)
            | bit(self.liars[1], 16)
    }

    /// `nodes` keep no role but those of `mask`.
    pub(super) fn only(mut self, nodes: W, mask: Mask) -> Self {
        let keep = |set: &mut W, bit: Mask| {
            if mask & bit == 0 {
                *set = set.without(nodes);
            }
        };
        keep(&mut self.honest[0], 1);
        keep(&mut self.honest[1], 2);
        keep(&mut self.neither, 4);
        keep(&mut self.liars[0], 8);
        keep(&mut self.liars[1], 16);
        self
    }

    /// `nodes` keep no role of `mask`.
    pub(super) fn without(self, nodes: W, mask: Mask) -> Self {
        self.only(nodes, ALL & !mask)
    }
}
