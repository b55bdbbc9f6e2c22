//! Which node a place is divided by.

use super::known::Known;
use super::limits::{Counts, range};
use super::roles::{EXEMPT, MEMBERS};
use super::{Both, Place, SECOND};
use crate::graph::word::Word;
use crate::search::board::Board;

/// A node that is taken for a member of a set, or for a content one, or not.
#[derive(Clone, Copy)]
pub(super) struct Choice<W> {
    pub(super) place: Place<W>,
    pub(super) set: usize,
    node: usize,
    member: bool,
}

impl<W: Word> Choice<W> {
    pub(super) fn taken(&self) -> Place<W> {
        let (mut place, one) = (self.place, W::one(self.node));
        let side = &mut place.known.sides[self.set];
        side.members = side.members | one;
        if !self.member {
            side.content = side.content | one;
        }
        place
    }

    /// Neither the node is taken nor any that look like it, after `spent` nodes of search with it.
    pub(super) fn left(&self, board: &Board<'_, W>, spent: u64) -> Place<W> {
        let mut place = self.place;
        let alike = board.alike(&|node| self.place.known.color(node), self.node, spent);
        if self.member {
            place.known.forbid(self.set, alike);
        } else {
            let side = &mut place.known.sides[self.set];
            side.able = side.able.without(alike);
        }
        place
    }
}

impl<W: Word> Both<'_, '_, W> {
    /// A neighbour of a content member that does not hear enough yet, or somebody that such a member does not hear; else whom a set begins with;
    /// else whether a member is content.
    pub(super) fn choice(&self, place: Place<W>, most: &Counts) -> Option<Choice<W>> {
        let (known, needs) = (&place.known, &self.board.needs);
        if let Some((set, node, hears)) = self.narrowest(known, most) {
            let side = &known.sides[set];
            let (open, heard) = (side.allowed.without(side.members), needs.heard[node]);
            let node = self.board.worthiest(side, if hears { open & heard } else { open.without(heard) })?;
            return Some(Choice { place, set, node, member: true });
        }
        let content = |set: usize, node: usize| Choice { place, set, node, member: false };
        let both = [SECOND, 1 - SECOND];
        if let Some(set) = both.into_iter().find(|set| known.sides[*set].content.is_none()) {
            let side = &known.sides[set];
            let node = self.board.best_root(side.allowed, side.able, i32::from(most[EXEMPT[set]]))?;
            return Some(content(set, node));
        }
        both.into_iter().find_map(|set| {
            let side = &known.sides[set];
            Some(content(set, side.discontent(needs, side.members & side.able)?))
        })
    }

    /// A content member that does not hear enough yet, and whether those that it hears are decided next or the others: where the fewest ways are
    /// open. Of those that it hears a few may be missed, of the others a few may be taken.
    fn narrowest(&self, known: &Known<W>, most: &Counts) -> Option<(usize, usize, bool)> {
        let needs = &self.board.needs;
        let mut best = None;
        for set in [SECOND, 1 - SECOND] {
            let side = &known.sides[set];
            let open = side.allowed.without(side.members);
            let [least, most] = range(most, MEMBERS[set]).map(|size| size - side.members.count());
            for node in side.content.nodes() {
                let lack = needs.need[node] - needs.heard_in(node, side.members);
                if lack <= 0 {
                    continue;
                }
                let heard = needs.heard_in(node, open);
                let others = open.count() - heard;
                let among_heard = self.ways.between(heard, lack.max(least - others), most);
                let among_others = self.ways.between(others, least - heard, most - lack);
                for (open, ways, hears) in [(heard, among_heard, true), (others, among_others, false)] {
                    if open > 0 && best.is_none_or(|(least, _)| ways < least) {
                        best = Some((ways, (set, node, hears)));
                    }
                }
            }
        }
        best.map(|(_, choice)| choice)
    }
}
