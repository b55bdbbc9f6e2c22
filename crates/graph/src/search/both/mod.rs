//! The search over both sets at once, for questions whose sizes are known.
//!
//! It is given which numbers of content and exempt members the two sets may have together ([`crate::joint`]), and keeps for each set
//! what [`Side`](super::side::Side) has. It begins with a content member of the set with more exempt members, then one of the other, and decides
//! where the fewest ways are open. What it looks for are two sets that cannot be made larger (docs/theory, `sec:joint-search`).

mod choice;
mod known;
mod limits;
mod roles;
#[cfg(test)]
mod tests;
mod ways;

use alloc::vec::Vec;

use super::board::Board;
use super::grow::Pair;
use super::guess::{Guess, Guesses};
use super::pieces::Tree;
use super::symmetry;
use crate::effort::{Meter, Stopped};
use crate::graph::word::Word;
use crate::joint::Quadruple;
use choice::Choice;
use known::Known;
use limits::{Counts, Roles, counts, merged};
use roles::{EXEMPT, MEMBERS};
use ways::Ways;

/// How many choices deep a tree is cut into pieces.
const DEPTH: u32 = 6;

/// The set with more exempt members, or as many.
const SECOND: usize = 1;

/// One question about one graph.
pub(super) struct Both<'b, 'g, W> {
    board: &'b Board<'g, W>,
    /// The quadruples for each number of members that S₂ may have, least first.
    groups: Vec<Vec<Counts>>,
    /// Exempt members that both sets may have together.
    effort: i32,
    field: W,
    ways: Ways,
    /// Whether symmetries are looked for wherever the tree is cut.
    is_symmetric: bool,
}

/// What is known, and for which of the groups.
#[derive(Clone, Copy)]
pub(super) struct Place<W> {
    known: Known<W>,
    group: usize,
}

/// What can be said of a place after all conclusions.
enum Step<W> {
    Dead,
    Found(Pair<W>),
    Open(Choice<W>),
}

impl<'b, 'g, W: Word> Both<'b, 'g, W> {
    pub(super) fn new(board: &'b Board<'g, W>, quadruples: &[Quadruple], effort: i32) -> Self {
        let field = W::from_bits(board.graph.nodes().bits());
        let of_size = |size: i32| -> Vec<Counts> {
            let group = quadruples.iter().filter(|quadruple| quadruple.size(SECOND) == size);
            let group: Vec<Counts> = group.map(|quadruple| counts(quadruple, field.count())).collect();
            merged(&group)
        };
        let groups = (1..=field.count()).map(of_size).filter(|group| !group.is_empty()).collect();
        let is_symmetric = symmetry::orbits(board.graph).iter().any(|orbit| orbit.len() > 1);
        Self { board, groups, effort, field, ways: Ways::new(board.graph.node_count()), is_symmetric }
    }

    /// All that follows from what is known.
    fn conclude(&self, place: Place<W>) -> Option<(Place<W>, Counts)> {
        let (needs, quadruples) = (&self.board.needs, &self.groups[place.group]);
        let mut known = place.known;
        // Sides of which the same was asked before have nothing new to say.
        let (mut asked, mut settled) = ([None; 2], [None; 2]);
        loop {
            let before = known;
            known.part(self.field)?;
            known.bound_by_largeness(needs, self.field);
            for set in 0..2 {
                if asked[set] != Some(known.sides[set]) {
                    known.exempt[set] = self.least_exempt(&known, set)?;
                    asked[set] = Some(known.sides[set]);
                }
            }
            let roles = Roles::new(&known, self.field);
            let most = roles.limits(quadruples, known.exempt)?;
            roles.bound(&mut known, &most);
            for (set, side) in known.sides.iter_mut().enumerate() {
                let [exempt, size] = [EXEMPT[set], MEMBERS[set]].map(|roles| i32::from(most[roles]));
                if settled[set] != Some((*side, exempt, size)) {
                    *side = side.conclude(needs, exempt, size)?;
                    settled[set] = Some((*side, exempt, size));
                }
            }
            if known == before {
                return Some((Place { known, ..place }, most));
            }
        }
    }

    /// How many exempt members a set needs at least for a content member, and for those that are content for certain.
    fn least_exempt(&self, known: &Known<W>, set: usize) -> Option<i32> {
        let side = &known.sides[set];
        let sure = side.exempt();
        let does = |spare: &i32| {
            let able = self.board.needs.peel(side.allowed, side.able, sure, *spare);
            !able.is_none() && side.content.is_within(able)
        };
        let known = known.exempt[set] - sure.count();
        let spare = (known.max(0)..=self.effort - sure.count()).find(does)?;
        Some(sure.count() + spare)
    }

    fn step(&self, place: Place<W>) -> Step<W> {
        let Some((place, most)) = self.conclude(place) else { return Step::Dead };
        if let Some(pair) = self.found(&place.known) {
            return Step::Found(pair);
        }
        self.choice(place, &most).map_or(Step::Dead, Step::Open)
    }

    /// Two sets of certain members, if enough of them are content and few enough are not.
    fn found(&self, known: &Known<W>) -> Option<Pair<W>> {
        let [first, second] = known.sides.map(|side| {
            let exempt = side.exempt();
            let done = self.board.needs.peel(side.members, side.members & side.able, exempt, 0);
            (!done.is_none()).then_some((done | exempt, exempt.count()))
        });
        let ((first, few), (second, more)) = (first?, second?);
        (few + more <= self.effort).then_some((first, second))
    }

    fn extend(
        &self,
        mut place: Place<W>,
        guesses: &mut Guesses,
        meter: &mut Meter<'_>,
    ) -> Result<Option<Pair<W>>, Stopped> {
        loop {
            meter.spend(1)?;
            if let Some((seed, nodes)) = guesses.due(meter.nodes()) {
                let found = Guess::new(&self.board.needs, self.effort, seed).go_on(nodes, meter)?;
                if found.is_some() {
                    return Ok(found);
                }
            }
            match self.step(place) {
                Step::Dead => return Ok(None),
                Step::Found(pair) => return Ok(Some(pair)),
                Step::Open(choice) => {
                    let before = meter.nodes();
                    let found = self.extend(choice.taken(), guesses, meter)?;
                    if found.is_some() {
                        return Ok(found);
                    }
                    place = choice.left(self.board, meter.nodes() - before);
                }
            }
        }
    }

    fn cut(
        &self,
        place: Place<W>,
        depth: u32,
        parts: &mut Vec<Place<W>>,
        meter: &mut Meter<'_>,
    ) -> Result<(), Stopped> {
        if depth == 0 {
            parts.push(place);
            return Ok(());
        }
        meter.spend(1)?;
        match self.step(place) {
            Step::Dead => {}
            // It is looked at again when its turn comes.
            Step::Found(_) => parts.push(place),
            Step::Open(choice) => {
                // Whom the second set begins with is no choice among two: it is cut below each.
                let begun = !choice.place.known.sides[SECOND].content.is_none();
                let is_root = choice.set == SECOND && !begun;
                let below = if is_root { DEPTH } else { depth - 1 };
                self.cut(choice.taken(), below, parts, meter)?;
                let spent = if self.is_symmetric { u64::MAX } else { 0 };
                let left = choice.left(self.board, spent);
                self.cut(left, if is_root { depth } else { depth - 1 }, parts, meter)?;
            }
        }
        Ok(())
    }
}

impl<W: Word + Send + Sync> Tree<W> for Both<'_, '_, W> {
    type Place = Place<W>;

    fn parts(&self, meter: &mut Meter<'_>) -> Result<Vec<Place<W>>, Stopped> {
        let mut parts = Vec::new();
        for group in 0..self.groups.len() {
            self.cut(Place { known: Known::new(self.field), group }, DEPTH, &mut parts, meter)?;
        }
        Ok(parts)
    }

    fn search(
        &self,
        place: Place<W>,
        number: usize,
        meter: &mut Meter<'_>,
    ) -> Result<Option<Pair<W>>, Stopped> {
        let mut guesses = Guesses::new(number, meter.nodes());
        self.extend(place, &mut guesses, meter)
    }
}
