//! What is known of both sets at once.

use super::roles::{CONTENT, EXEMPT, REST};
use crate::graph::word::Word;
use crate::search::peel::Needs;
use crate::search::side::Side;

/// What is known of two disjoint sets that cannot be made larger.
#[derive(Clone, Copy)]
pub(in crate::search) struct Known<W> {
    /// Of S₁, which has no more exempt members than the other, and of S₂.
    pub(super) sides: [Side<W>; 2],
    /// Whoever is in neither set is one of these.
    pub(super) rest: W,
    /// Exempt members that each set has at least.
    pub(super) exempt: [i32; 2],
}

impl<W: Word> Known<W> {
    /// Nothing is known.
    pub(super) fn new(field: W) -> Self {
        let side = Side { members: W::NONE, content: W::NONE, allowed: field, able: field };
        Self { sides: [side; 2], rest: field, exempt: [0; 2] }
    }

    /// Who is in neither set for certain.
    pub(super) fn outsiders(&self) -> W {
        self.rest.without(self.sides[0].allowed | self.sides[1].allowed)
    }

    /// What is known of a node, as a number.
    pub(super) fn color(&self, node: usize) -> usize {
        let one = W::one(node);
        let [first, second] = self.sides.map(|side| side.color(one));
        2 * (16 * first + second) + usize::from(one.is_within(self.rest))
    }

    /// Rules out that some nodes are in a set.
    pub(super) fn forbid(&mut self, set: usize, nodes: W) {
        let side = &mut self.sides[set];
        (side.allowed, side.able) = (side.allowed.without(nodes), side.able.without(nodes));
    }

    /// Whoever is in one set is not elsewhere, and who can be in one place only is there. `None` if somebody can be nowhere.
    pub(super) fn part(&mut self, field: W) -> Option<()> {
        for set in 0..2 {
            self.forbid(set, self.sides[1 - set].members);
            self.rest = self.rest.without(self.sides[set].members);
        }
        let [first, second] = self.sides.map(|side| side.allowed);
        if !field.is_within(first | second | self.rest) {
            return None;
        }
        for set in 0..2 {
            let side = &mut self.sides[set];
            let elsewhere = [second, first][set] | self.rest;
            side.members = side.members | field.without(elsewhere);
            if !side.members.is_within(side.allowed) {
                return None;
            }
        }
        Some(())
    }

    /// Whoever hears enough members of a set is content in it, exempt in the other, or content there: not in neither set, by which the set could be
    /// made larger, and not exempt in this one. And who is certainly in neither set, or exempt in this one, hears no more members than that.
    //= theory sec:joint-search
    pub(super) fn bound_by_largeness(&mut self, needs: &Needs<W>, field: W) {
        for set in 0..2 {
            let Side { members, content, able, .. } = self.sides[set];
            let full = (self.outsiders() | members).without(able);
            for node in field.without(content).nodes() {
                let (one, heard) = (W::one(node), needs.heard_in(node, members));
                if heard >= needs.need[node] {
                    self.rest = self.rest.without(one);
                    if one.is_within(members) {
                        self.sides[set].content = self.sides[set].content | one;
                    } else if !one.is_within(able) {
                        self.forbid(set, one);
                    }
                } else if heard + 1 == needs.need[node] && one.is_within(full) {
                    self.forbid(set, needs.heard[node].without(members));
                }
            }
        }
    }

    /// Only those nodes keep any of some roles.
    pub(super) fn keep(&mut self, roles: usize, nodes: W) {
        for set in 0..2 {
            let side = &mut self.sides[set];
            if roles & CONTENT[set] != 0 {
                side.able = side.able & nodes;
            }
            if roles & EXEMPT[set] != 0 {
                let gone = side.allowed.without(side.able | nodes);
                side.content = side.content | (side.members & side.able).without(nodes);
                self.forbid(set, gone);
            }
        }
        if roles & REST != 0 {
            self.rest = self.rest & nodes;
        }
    }
}

impl<W: Word> PartialEq for Known<W> {
    fn eq(&self, other: &Self) -> bool {
        self.sides == other.sides && self.rest == other.rest
    }
}
