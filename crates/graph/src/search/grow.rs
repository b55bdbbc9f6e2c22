//! Growing the first set, then the second one in what is left.

use super::Orbits;
use super::peel::Needs;
use super::side::Side;
use crate::effort::{Meter, Stopped};
use crate::graph::Graph;
use crate::graph::word::Word;

/// Two disjoint sets.
type Pair<W> = (W, W);

/// One question (r, ·) about one graph.
pub(super) struct Search<'m, 'a, W> {
    needs: Needs<W>,
    meter: &'m mut Meter<'a>,
    graph: &'m Graph,
    orbits: &'m Orbits,
}

/// Where a side is grown and what is left beside it.
#[derive(Clone, Copy)]
struct Room<W> {
    /// Exempt members that both sets may have together.
    effort: i32,
    /// Exempt members that the set itself may have.
    own: i32,
    /// Exempt members that the other set needs at least.
    other: i32,
    /// The nodes of the search; the other set is looked for among those that are not members.
    field: W,
    /// Whether there is another set still to be found.
    pair: bool,
}

impl<'m, 'a, W: Word> Search<'m, 'a, W> {
    pub(super) fn new(graph: &'m Graph, r: usize, orbits: &'m Orbits, meter: &'m mut Meter<'a>) -> Self {
        Self { needs: Needs::new(graph, r), meter, graph, orbits }
    }

    /// Two disjoint sets, each with a content member, with at most `effort` exempt members together.
    ///
    /// S₁ is sought with no more exempt members than S₂, so with effort/2 or fewer; and if none may be exempt, with no more
    /// members, so with n/2 or fewer.
    pub(super) fn pair(&mut self, effort: i32) -> Result<Option<Pair<W>>, Stopped> {
        self.roots(Room { effort, own: effort / 2, other: 0, field: self.needs.all, pair: true })
    }

    /// A set within `field` with a content member and at most `effort` exempt ones.
    fn single(&mut self, field: W, effort: i32) -> Result<Option<W>, Stopped> {
        let core = self.needs.core(field);
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
    fn roots(&mut self, room: Room<W>) -> Result<Option<Pair<W>>, Stopped> {
        let mut able = room.field;
        let mut allowed = room.field;
        let before = self.meter.nodes();
        loop {
            able = self.needs.peel(allowed, able, W::NONE, room.own);
            if room.own == 0 {
                allowed = able;
            }
            let Some(root) = self.best_root(allowed, able, room.own) else {
                return Ok(None);
            };
            let start = W::one(root);
            let found = self.extend(Side { members: start, content: start, allowed, able }, room)?;
            if found.is_some() {
                return Ok(found);
            }
            able = able.without(start);
            if room.pair {
                // If no pair of sets has the root content in S₁, none has its image under a symmetry there.
                let orbit = self.orbits.of(self.graph, root, self.meter.nodes() - before);
                able = able.without(W::from_bits(orbit.bits()));
            }
        }
    }

    /// The node without which the fewest others can be content.
    fn best_root(&self, allowed: W, able: W, own: i32) -> Option<usize> {
        let rest = |node: usize| self.needs.peel(allowed, able.without(W::one(node)), W::NONE, own).count();
        able.nodes().min_by_key(|&node| (rest(node), -self.needs.heard_in(node, able)))
    }

    fn extend(&mut self, side: Side<W>, mut room: Room<W>) -> Result<Option<Pair<W>>, Stopped> {
        self.meter.spend(1)?;
        let mut size = self.size(side, &mut room);
        let Some(mut side) = side.conclude(&self.needs, room.own.min(room.effort - room.other), size) else {
            return Ok(None);
        };
        if room.pair {
            size = self.size(side, &mut room);
            match side.conclude(&self.needs, room.own.min(room.effort - room.other), size) {
                Some(better) => side = better,
                None => return Ok(None),
            }
        }
        let exempt = side.exempt();
        let done = self.needs.peel(side.members, side.members & side.able, exempt, 0);
        if !done.is_none() {
            return self.finish(done | exempt, room.effort - exempt.count(), room);
        }
        self.branch(side, room)
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
        let other_size = self.needs.least_need(second).max(0) + 1;
        let rest = field - other_size;
        if room.effort == 0 { rest.min(field / 2).min(second.count()) } else { rest }
    }

    /// The first set is found: any set around it has no fewer exempt members and leaves less to the other.
    fn finish(&mut self, first: W, effort: i32, room: Room<W>) -> Result<Option<Pair<W>>, Stopped> {
        if !room.pair {
            return Ok(Some((first, W::NONE)));
        }
        let second = self.single(room.field.without(first), effort)?;
        Ok(second.map(|second| (first, second)))
    }

    fn branch(&mut self, side: Side<W>, room: Room<W>) -> Result<Option<Pair<W>>, Stopped> {
        if let Some(node) = side.discontent(&self.needs, side.content) {
            return self.branch_on_neighbor(side, room, node);
        }
        let undecided = side.members & side.able;
        let Some(node) = side.discontent(&self.needs, undecided) else {
            return Ok(None);
        };
        let one = W::one(node);
        let found = self.extend(Side { content: side.content | one, ..side }, room)?;
        if found.is_some() {
            return Ok(found);
        }
        self.extend(Side { able: side.able.without(one), ..side }, room)
    }

    fn branch_on_neighbor(
        &mut self,
        side: Side<W>,
        room: Room<W>,
        node: usize,
    ) -> Result<Option<Pair<W>>, Stopped> {
        let open = self.needs.heard[node] & side.allowed.without(side.members);
        let worth = |neighbor: &usize| {
            4 * self.needs.heard_in(*neighbor, side.members) - self.needs.heard_in(*neighbor, side.allowed)
        };
        let Some(neighbor) = open.nodes().max_by_key(worth) else {
            return Ok(None);
        };
        let one = W::one(neighbor);
        let found = self.extend(Side { members: side.members | one, ..side }, room)?;
        if found.is_some() {
            return Ok(found);
        }
        self.extend(Side { allowed: side.allowed.without(one), able: side.able.without(one), ..side }, room)
    }
}
