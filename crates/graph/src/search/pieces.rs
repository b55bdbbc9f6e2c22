//! A long search in pieces, one after another or several at once, with the same answer and the same count.

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

use super::board::Board;
use super::grow::{Pair, Room, Search, Step};
use super::side::Side;
use crate::effort::{Meter, Progress, Stopped};
use crate::graph::word::Word;
use crate::workers::{Piece, Workers};

/// How many choices deep a tree is cut into pieces.
const DEPTH: u32 = 6;

/// How many choices deep symmetries are looked for while it is cut.
const DEPTH_OF_SYMMETRY: u32 = 2;

/// A part of the tree that grows one set after the other.
type Part<W> = (Side<W>, Room<W>);

/// A tree that can be searched in parts.
pub(super) trait Tree<W>: Sync {
    /// Where a part begins.
    type Place: Copy + Send + Sync;

    /// All parts, in the order in which a search without threads would come to them.
    fn parts(&self, meter: &mut Meter<'_>) -> Result<Vec<Self::Place>, Stopped>;

    /// Searches the part of that number.
    fn search(
        &self,
        place: Self::Place,
        number: usize,
        meter: &mut Meter<'_>,
    ) -> Result<Option<Pair<W>>, Stopped>;
}

/// The tree below a room.
pub(super) struct Below<'b, 'g, W> {
    pub(super) board: &'b Board<'g, W>,
    pub(super) room: Room<W>,
}

impl<W: Word + Send + Sync> Tree<W> for Below<'_, '_, W> {
    type Place = Part<W>;

    fn parts(&self, meter: &mut Meter<'_>) -> Result<Vec<Part<W>>, Stopped> {
        let (board, room) = (self.board, self.room);
        let mut parts = Vec::new();
        let mut able = room.field;
        while let Some((root, side)) = board.root(able, room) {
            cut(board, (side, room), DEPTH, &mut parts, meter)?;
            able = board.without_root(&side, room, root, u64::MAX);
        }
        Ok(parts)
    }

    fn search(
        &self,
        (side, room): Part<W>,
        number: usize,
        meter: &mut Meter<'_>,
    ) -> Result<Option<Pair<W>>, Stopped> {
        Search::guessing(self.board, meter, number).extend(side, room)
    }
}

/// What became of a part, and what it cost.
struct Outcome<W> {
    place: usize,
    nodes: u64,
    found: Result<Option<Pair<W>>, Stopped>,
}

/// All of a tree.
pub(super) fn search<W: Word + Send + Sync, T: Tree<W>>(
    tree: &T,
    meter: &mut Meter<'_>,
) -> Result<Option<Pair<W>>, Stopped> {
    let parts = tree.parts(meter)?;
    match meter.workers() {
        Some(workers) => at_once(tree, &parts, workers, meter),
        None => one_by_one(tree, &parts, meter),
    }
}

fn cut<W: Word>(
    board: &Board<'_, W>,
    part: Part<W>,
    depth: u32,
    parts: &mut Vec<Part<W>>,
    meter: &mut Meter<'_>,
) -> Result<(), Stopped> {
    if depth == 0 {
        parts.push(part);
        return Ok(());
    }
    meter.spend(1)?;
    match board.step(part.0, part.1) {
        Step::Dead => {}
        // It is looked at again when its turn comes.
        Step::Found { .. } => parts.push(part),
        Step::Open(choice) => {
            cut(board, (choice.taken(), choice.room), depth - 1, parts, meter)?;
            let spent = if depth > DEPTH - DEPTH_OF_SYMMETRY { u64::MAX } else { 0 };
            cut(board, (choice.left(board, spent), choice.room), depth - 1, parts, meter)?;
        }
    }
    Ok(())
}

fn one_by_one<W: Word, T: Tree<W>>(
    tree: &T,
    parts: &[T::Place],
    meter: &mut Meter<'_>,
) -> Result<Option<Pair<W>>, Stopped> {
    for (number, place) in parts.iter().enumerate() {
        let found = tree.search(*place, number, meter)?;
        if found.is_some() {
            return Ok(found);
        }
    }
    Ok(None)
}

/// What the threads tell each other.
struct Shared {
    /// The next part that nobody has begun with.
    next: AtomicUsize,
    /// The first part known to end the search: it has a witness, or the effort does not reach beyond it.
    end: AtomicUsize,
    /// Nodes of each part that is done, plus 1; 0 if it is not.
    done: Vec<AtomicUsize>,
    /// Nodes visited by all, for the callback.
    visited: AtomicUsize,
    /// Somebody said stop.
    stop: AtomicBool,
}

impl Shared {
    /// Nodes of those parts before `place` that are done.
    fn before(&self, place: usize) -> u64 {
        let nodes = self.done[..place].iter().map(|done| done.load(Relaxed).saturating_sub(1) as u64);
        nodes.fold(0, u64::saturating_add)
    }

    fn is_over(&self, place: usize) -> bool {
        self.stop.load(Relaxed) || self.end.load(Relaxed) < place
    }
}

fn at_once<W: Word + Send + Sync, T: Tree<W>>(
    tree: &T,
    parts: &[T::Place],
    workers: &dyn Workers,
    meter: &mut Meter<'_>,
) -> Result<Option<Pair<W>>, Stopped> {
    let shared = Shared {
        next: AtomicUsize::new(0),
        end: AtomicUsize::new(usize::MAX),
        done: parts.iter().map(|_| AtomicUsize::new(0)).collect(),
        visited: AtomicUsize::new(0),
        stop: AtomicBool::new(false),
    };
    let (shared, left) = (&shared, meter.left());
    let mut outcomes: Vec<Vec<Outcome<W>>> = (0..workers.count()).map(|_| Vec::new()).collect();
    let piece = |outcomes| -> Piece<'_> { Box::new(move || work(tree, parts, shared, left, outcomes)) };
    workers.run(outcomes.iter_mut().map(piece).collect(), &mut || {
        if !meter.look(shared.visited.load(Relaxed) as u64) {
            shared.stop.store(true, Relaxed);
        }
    });
    if shared.stop.load(Relaxed) {
        return Err(Stopped);
    }
    let mut outcomes: Vec<Outcome<W>> = outcomes.into_iter().flatten().collect();
    outcomes.sort_unstable_by_key(|outcome| outcome.place);
    conclude(outcomes, parts.len(), meter)
}

/// Takes one part after another until the search is over.
fn work<W: Word, T: Tree<W>>(
    tree: &T,
    parts: &[T::Place],
    shared: &Shared,
    left: u64,
    outcomes: &mut Vec<Outcome<W>>,
) {
    loop {
        let place = shared.next.fetch_add(1, Relaxed);
        let Some(part) = parts.get(place).filter(|_| !shared.is_over(place)) else { return };
        let mut told = 0;
        let mut look = |progress: &Progress| {
            let nodes = usize::try_from(progress.nodes).unwrap_or(usize::MAX);
            shared.visited.fetch_add(nodes - told, Relaxed);
            told = nodes;
            if shared.is_over(place) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let mut meter = Meter::new(left.saturating_sub(shared.before(place)), &mut look);
        let found = tree.search(*part, place, &mut meter);
        let nodes = meter.nodes();
        if !matches!(found, Ok(None)) {
            shared.end.fetch_min(place, Relaxed);
        }
        shared.done[place].store(usize::try_from(nodes).unwrap_or(usize::MAX).saturating_add(1), Relaxed);
        outcomes.push(Outcome { place, nodes, found });
    }
}

/// What a search without threads would have come to: the first part with a witness, unless the effort ends before.
fn conclude<W>(
    outcomes: Vec<Outcome<W>>,
    parts: usize,
    meter: &mut Meter<'_>,
) -> Result<Option<Pair<W>>, Stopped> {
    for (place, outcome) in outcomes.into_iter().enumerate() {
        if outcome.place != place {
            return Err(Stopped);
        }
        if outcome.nodes > meter.left() || outcome.found.is_err() {
            meter.exhaust();
            return Err(Stopped);
        }
        meter.spend(outcome.nodes)?;
        if let Ok(Some(pair)) = outcome.found {
            return Ok(Some(pair));
        }
        if place + 1 == parts {
            return Ok(None);
        }
    }
    if parts == 0 { Ok(None) } else { Err(Stopped) }
}
