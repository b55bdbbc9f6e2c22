//! What is known of one of the two sets, and what follows from it.

use super::peel::Needs;
use crate::graph::word::Word;

/// What is known of a set S with `content ⊆ members ⊆ S ⊆ allowed`.
#[derive(Clone, Copy)]
pub(super) struct Side<W> {
    /// Certainly in S.
    pub(super) members: W,
    /// Certainly in S and content.
    pub(super) content: W,
    /// Whatever is in S is one of these.
    pub(super) allowed: W,
    /// Whatever is content in S is one of these. A member outside of them is exempt.
    pub(super) able: W,
}

impl<W: Word> Side<W> {
    /// Members that are exempt for certain.
    pub(super) fn exempt(&self) -> W {
        self.members.without(self.able)
    }

    /// What is known of a node, as a number below 16.
    pub(super) fn color(&self, node: W) -> usize {
        let sets = [self.members, self.content, self.allowed, self.able];
        sets.iter().fold(0, |color, set| 2 * color + usize::from(node.is_within(*set)))
    }

    /// What is known of a node of a search in `field`, as a number below 32.
    pub(super) fn color_within(&self, node: usize, field: W) -> usize {
        let one = W::one(node);
        self.color(one) + 16 * usize::from(one.is_within(field))
    }

    /// Draws every conclusion, for at most `effort` exempt members and at most `size` members in all.
    /// `None` if no such S is left.
    pub(super) fn conclude(mut self, needs: &Needs<W>, effort: i32, size: i32) -> Option<Self> {
        loop {
            let before = self;
            let spare = effort - self.exempt().count();
            if spare < 0 {
                return None;
            }
            self.able = needs.peel(self.allowed, self.able, self.exempt(), spare);
            if spare == 0 {
                self.allowed = self.able | self.members;
                self.content = self.members & self.able;
            }
            self.bound_by_content(needs, size)?;
            self.bound_by_sum(needs, size)?;
            self.bound_by_size(needs, size);
            if !self.content.is_within(self.able) {
                return None;
            }
            if self == before {
                return Some(self);
            }
        }
    }

    /// Every content member must be able to find what it needs: without room for a single miss, all of it is in S.
    fn bound_by_content(&mut self, needs: &Needs<W>, size: i32) -> Option<()> {
        for node in self.content.nodes() {
            let lack = needs.need[node] - needs.heard_in(node, self.members);
            let room = size - self.members.count() - lack;
            if room < 0 || needs.heard_in(node, self.allowed) < needs.need[node] {
                return None;
            }
            if room == 0 {
                self.allowed = self.allowed & (self.members | needs.heard[node]);
            }
            let open = needs.heard[node] & self.allowed;
            if open.count() == needs.need[node] {
                self.members = self.members | open;
            }
        }
        (self.members.count() <= size).then_some(())
    }

    /// A node that would be content only in a larger S is not content.
    fn bound_by_size(&mut self, needs: &Needs<W>, size: i32) {
        let members = self.members;
        for node in self.able.without(self.content).nodes() {
            let with = (members | W::one(node)).count();
            if with + needs.need[node] - needs.heard_in(node, members) > size {
                self.able = self.able.without(W::one(node));
            }
        }
    }

    /// A member that must or may be content and does not yet hear enough members: the one with the fewest ways out.
    pub(super) fn discontent(&self, needs: &Needs<W>, among: W) -> Option<usize> {
        let lack = |node: usize| needs.need[node] - needs.heard_in(node, self.members);
        let slack = |node: &usize| needs.heard_in(*node, self.allowed.without(self.members)) - lack(*node);
        among.nodes().filter(|&node| lack(node) > 0).min_by_key(slack)
    }
}

impl<W: Word> PartialEq for Side<W> {
    fn eq(&self, other: &Self) -> bool {
        self.members == other.members
            && self.content == other.content
            && self.allowed == other.allowed
            && self.able == other.able
    }
}
