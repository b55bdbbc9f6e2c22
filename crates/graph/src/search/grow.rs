//! Growing the first set, then the second one in what is left.

use super::board::Board;
use super::guess::{Guess, Guesses};
use super::side::Side;
use crate::effort::{Meter, Stopped};
use crate::graph::word::Word;

/// Two disjoint sets.
pub(super) type Pair<W> = (W, W);

/// One question (r, ·) about one graph, or a part of one.
pub(super) struct Search<'b, 'm, 'a, W> {
    pub(super) board: &'b Board<'b, W>,
    pub(super) meter: &'m mut Meter<'a>,
    guesses: Option<Guesses>,
}

/// Where a side is grown and what is left beside it.
#[derive(Clone, Copy)]
pub(super) struct Room<W> {
    /// Exempt members that both sets may have together.
    pub(super) effort: i32,
    /// Exempt members that the set itself may have.
    pub(super) own: i32,
    /// Exempt members that the other set needs at least.
    pub(super) other: i32,
    /// The nodes of the search; the other set is looked for among those that are not members.
    pub(super) field: W,
    /// Whether there is another set still to be found.
    pub(super) pair: bool,
}

/// What can be said of a side after all conclusions.
pub(super) enum Step<W> {
    /// No set is left.
    Dead,
    /// The first set is found, and the other may have so many exempt members.
    Found { first: W, effort: i32, room: Room<W> },
    /// A node is taken or not.
    Open(Choice<W>),
}

/// A node that is taken or not, and what it is taken for.
#[derive(Clone, Copy)]
pub(super) struct Choice<W> {
    side: Side<W>,
    pub(super) room: Room<W>,
    node: usize,
    /// Taken as a member; else it is one, and is taken as a content one.
    member: bool,
}

impl<W: Word> Choice<W> {
    /// What is known if the node is taken.
    pub(super) fn taken(&self) -> Side<W> {
        let (side, one) = (self.side, W::one(self.node));
        if self.member {
            Side { members: side.members | one, ..side }
        } else {
            Side { content: side.content | one, ..side }
        }
    }

    /// What is known if neither the node is taken nor any of those that look like it, after `spent` nodes of search without it.
    pub(super) fn left(&self, board: &Board<'_, W>, spent: u64) -> Side<W> {
        let side = self.side;
        let alike = board.alike(&|node| side.color_within(node, self.room.field), self.node, spent);
        if self.member {
            Side { allowed: side.allowed.without(alike), able: side.able.without(alike), ..side }
        } else {
            Side { able: side.able.without(alike), ..side }
        }
    }
}

impl<'b, 'm, 'a, W: Word> Search<'b, 'm, 'a, W> {
    pub(super) fn new(board: &'b Board<'b, W>, meter: &'m mut Meter<'a>) -> Self {
        Self { board, meter, guesses: None }
    }

    /// The search of the part of that number, which guesses when it is long.
    pub(super) fn guessing(board: &'b Board<'b, W>, meter: &'m mut Meter<'a>, part: usize) -> Self {
        let guesses = Some(Guesses::new(part, meter.nodes()));
        Self { board, meter, guesses }
    }

    /// Sets that are guessed, now and then and no matter where in the tree.
    fn guess(&mut self, room: Room<W>) -> Result<Option<Pair<W>>, Stopped> {
        let due =
            self.guesses.as_mut().filter(|_| room.pair).and_then(|guesses| guesses.due(self.meter.nodes()));
        let Some((seed, nodes)) = due else { return Ok(None) };
        Guess::new(&self.board.needs, room.effort, seed).go_on(nodes, self.meter)
    }

    /// A set within `field` with a content member and at most `effort` exempt ones.
    fn single(&mut self, field: W, effort: i32) -> Result<Option<W>, Stopped> {
        let core = self.board.needs.core(field);
        if !core.is_none() {
            return Ok(Some(core));
        }
        if effort <= 0 {
            return Ok(None);
        }
        let found = self.roots(Room { effort, own: effort, other: 0, field, pair: false })?;
        Ok(found.map(|(first, _)| first))
    }

    /// Tries every node as a content member of the set, and rules it out as one afterwards.
    pub(super) fn roots(&mut self, room: Room<W>) -> Result<Option<Pair<W>>, Stopped> {
        let mut able = room.field;
        while let Some((root, side)) = self.board.root(able, room) {
            let before = self.meter.nodes();
            let found = self.extend(side, room)?;
            if found.is_some() {
                return Ok(found);
            }
            able = self.board.without_root(&side, room, root, self.meter.nodes() - before);
        }
        Ok(None)
    }

    /// Searches everything that follows from `side`, the node that it is counted.
    pub(super) fn extend(&mut self, side: Side<W>, room: Room<W>) -> Result<Option<Pair<W>>, Stopped> {
        self.meter.spend(1)?;
        if let Some(pair) = self.guess(room)? {
            return Ok(Some(pair));
        }
        match self.board.step(side, room) {
            Step::Dead => Ok(None),
            Step::Found { first, effort, room } => self.finish(first, effort, room),
            Step::Open(choice) => {
                let before = self.meter.nodes();
                let found = self.extend(choice.taken(), choice.room)?;
                if found.is_some() {
                    return Ok(found);
                }
                let left = choice.left(self.board, self.meter.nodes() - before);
                self.extend(left, choice.room)
            }
        }
    }

    /// The first set is found: any set around it has no fewer exempt members and leaves less to the other.
    pub(super) fn finish(
        &mut self,
        first: W,
        effort: i32,
        room: Room<W>,
    ) -> Result<Option<Pair<W>>, Stopped> {
        if !room.pair {
            return Ok(Some((first, W::NONE)));
        }
        let second = self.single(room.field.without(first), effort)?;
        Ok(second.map(|second| (first, second)))
    }
}

/// What follows from what is known, without a search.
impl<W: Word> Board<'_, W> {
    /// The node to begin with if of `field` only `able` can be content, and what is known with it; `None` if nobody can be.
    pub(super) fn root(&self, able: W, room: Room<W>) -> Option<(usize, Side<W>)> {
        // Without exempt members whoever is not able is not allowed: `able` has shrunk to itself before.
        let mut able = able;
        let mut allowed = if room.own == 0 { able } else { room.field };
        able = self.needs.peel(allowed, able, W::NONE, room.own);
        if room.own == 0 {
            allowed = able;
        }
        let root = self.best_root(allowed, able, room.own)?;
        let start = W::one(root);
        Some((root, Side { members: start, content: start, allowed, able }))
    }

    /// Who can still be content once nothing was found with `root`, nor therefore with any that look like it.
    pub(super) fn without_root(&self, side: &Side<W>, room: Room<W>, root: usize, spent: u64) -> W {
        let before = Side { members: W::NONE, content: W::NONE, ..*side };
        side.able.without(self.alike(&|node| before.color_within(node, room.field), root, spent))
    }

    /// The node without which the fewest others can be content.
    pub(super) fn best_root(&self, allowed: W, able: W, own: i32) -> Option<usize> {
        let rest = |node: usize| self.needs.peel(allowed, able.without(W::one(node)), W::NONE, own).count();
        able.nodes().min_by_key(|&node| (rest(node), -self.needs.heard_in(node, able)))
    }

    /// All that follows from `side`.
    pub(super) fn step(&self, side: Side<W>, mut room: Room<W>) -> Step<W> {
        let mut size = self.size(side, &mut room);
        let Some(mut side) = side.conclude(&self.needs, room.own.min(room.effort - room.other), size) else {
            return Step::Dead;
        };
        if room.pair {
            size = self.size(side, &mut room);
            match side.conclude(&self.needs, room.own.min(room.effort - room.other), size) {
                Some(better) => side = better,
                None => return Step::Dead,
            }
        }
        let exempt = side.exempt();
        let done = self.needs.peel(side.members, side.members & side.able, exempt, 0);
        if !done.is_none() {
            return Step::Found { first: done | exempt, effort: room.effort - exempt.count(), room };
        }
        self.choice(side, room).map_or(Step::Dead, Step::Open)
    }

    /// The most members that the set can have, and in `room` what the other set costs at least.
    fn size(&self, side: Side<W>, room: &mut Room<W>) -> i32 {
        if !room.pair {
            return room.field.count();
        }
        let rest = room.field.without(side.members);
        let most = room.effort - side.exempt().count();
        let mut second = self.needs.peel(rest, rest, W::NONE, room.other);
        while second.is_none() && room.other <= most {
            room.other += 1;
            second = self.needs.peel(rest, rest, W::NONE, room.other);
        }
        if most > room.other {
            second = self.needs.peel(rest, rest, W::NONE, most);
        }
        let field = room.field.count();
        let other_size = self.needs.least_size(second, most.max(0));
        let rest = field.saturating_sub(other_size).min(self.size_by_eigenvalues(side, room));
        if room.effort == 0 { rest.min(field / 2).min(second.count()) } else { rest }
    }

    /// The most members that the set can have if the other one is as large as the exempt members ask for that are left to it, and −1 if for
    /// no number of exempt members both are large enough. Numbers of the set's own exempt members for which they are not are ruled out.
    //= theory sec:spectrum
    fn size_by_eigenvalues(&self, side: Side<W>, room: &mut Room<W>) -> i32 {
        let Some(sizes) = &self.sizes else { return room.field.count() };
        let as_size = |size: usize| i32::try_from(size).unwrap_or(i32::MAX);
        let index = |exempt: i32| usize::try_from(exempt).unwrap_or(0);
        let others = |exempt: i32| as_size(sizes.least_within(index(room.effort - exempt)));
        let room_for = |exempt: i32| room.field.count() - others(exempt);
        let fits = |exempt: &i32| {
            as_size(sizes.least(index(*exempt))) <= room_for(*exempt).min(side.allowed.count())
        };
        let known = side.exempt().count();
        let possible = (known..=room.own.min(room.effort - room.other)).filter(fits);
        let (size, own) = possible.fold((-1, -1), |(size, _), exempt| (room_for(exempt).max(size), exempt));
        room.own = own;
        size
    }

    fn choice(&self, side: Side<W>, room: Room<W>) -> Option<Choice<W>> {
        if let Some(node) = side.discontent(&self.needs, side.content) {
            let node = self.neighbor(&side, node)?;
            return Some(Choice { side, room, node, member: true });
        }
        let node = side.discontent(&self.needs, side.members & side.able)?;
        Some(Choice { side, room, node, member: false })
    }

    /// The neighbour of `node` to take or not.
    fn neighbor(&self, side: &Side<W>, node: usize) -> Option<usize> {
        self.worthiest(side, self.needs.heard[node] & side.allowed.without(side.members))
    }

    /// Of `open` the node that hears the most members, and few others.
    pub(super) fn worthiest(&self, side: &Side<W>, open: W) -> Option<usize> {
        let worth = |neighbor: &usize| {
            4 * self.needs.heard_in(*neighbor, side.members) - self.needs.heard_in(*neighbor, side.allowed)
        };
        open.nodes().max_by_key(worth)
    }
}
