//! The pairs of robots that monitors look at in a tick: all of a small or dense team, of a sparse one those that are near.

use closeranks_core::num::Vector;

use crate::geometry::near::{Near, small};
use crate::geometry::{fill_pairs, squared_distance};

/// Squared distances of pairs, second end after second end, and of each the first ends in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pairs {
    /// Ends of each pair, the lower number first; not filled if there are all pairs.
    ends: Vec<[u16; 2]>,
    /// True if only near pairs are there: all others are farther apart than was asked for.
    sparse: bool,
    robots: usize,
    /// Squared distances of references, m².
    references_m2: Vec<f64>,
    /// Squared distances of positions, m²; empty where the positions are the references.
    positions_m2: Vec<f64>,
    /// True if distances are not taken yet.
    put_off: bool,
    near: Near,
}

/// Where the pairs of a tick were in the list of an earlier one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    /// False if every pair is where it was.
    moved: bool,
    then: Vec<u32>,
}

/// In place of a place in a list that does not have the pair.
const NOWHERE: u32 = u32::MAX;

impl Pairs {
    /// Takes all pairs of which positions or references are at most `radius_m` apart; others may be there too.
    pub(crate) fn look<const D: usize>(
        &mut self,
        positions_m: &[Vector<D>],
        references_m: &[Vector<D>],
        radius_m: f64,
    ) {
        let same = positions_m == references_m;
        let away = positions_m.iter().zip(references_m).map(|(x, y)| squared_distance(x, y));
        let away_m = if same { 0.0 } else { closeranks_core::num::sqrt(away.fold(0.0, f64::max)) };
        let radius_m = radius_m + 2.0 * away_m;
        (self.robots, self.put_off) = (positions_m.len(), false);
        self.sparse = self.near.look(positions_m, radius_m);
        self.positions_m2.clear();
        self.ends.clear();
        if self.sparse {
            return self.take_near(positions_m, (!same).then_some(references_m), radius_m);
        }
        fill_pairs(references_m, &mut self.references_m2);
        if !same {
            fill_pairs(positions_m, &mut self.positions_m2);
        }
    }

    /// Of a small team whose positions are its references: takes no distances until they are asked for.
    pub(crate) fn put_off(&mut self, robots: usize) {
        (self.robots, self.sparse, self.put_off) = (robots, false, true);
        self.positions_m2.clear();
        self.ends.clear();
    }

    /// Takes the distances that were put off, of robots that were at `positions_m`.
    pub(crate) fn catch_up<const D: usize>(&mut self, positions_m: &[Vector<D>]) {
        if core::mem::replace(&mut self.put_off, false) {
            fill_pairs(positions_m, &mut self.references_m2);
        }
    }

    fn take_near<const D: usize>(
        &mut self,
        positions_m: &[Vector<D>],
        references_m: Option<&[Vector<D>]>,
        radius_m: f64,
    ) {
        self.references_m2.clear();
        for second in 0..positions_m.len() {
            let (firsts, distances_m2) = self.near.before(second, positions_m, radius_m);
            self.ends.extend(firsts.iter().map(|first| [*first, small(second)]));
            let Some(references_m) = references_m else {
                self.references_m2.extend_from_slice(distances_m2);
                continue;
            };
            self.positions_m2.extend_from_slice(distances_m2);
            let own = &references_m[second];
            let between = |first: &u16| squared_distance(&references_m[usize::from(*first)], own);
            self.references_m2.extend(firsts.iter().map(between));
        }
    }

    /// Squared distances of references, m², in order.
    pub(crate) fn references_m2(&self) -> &[f64] {
        &self.references_m2
    }

    /// Squared distances of positions, m², in the same order.
    pub(crate) fn positions_m2(&self) -> &[f64] {
        if self.positions_m2.is_empty() { &self.references_m2 } else { &self.positions_m2 }
    }

    /// True if positions are the references.
    pub(crate) fn is_of_positions(&self) -> bool {
        self.positions_m2.is_empty()
    }

    /// True if only near pairs are there.
    pub(crate) fn is_sparse(&self) -> bool {
        self.sparse
    }

    /// Calls `look` with the place and the two ends of every pair, in order.
    #[inline]
    pub(crate) fn each(&self, mut look: impl FnMut(usize, [usize; 2])) {
        let (mut first, mut second) = (0, 1);
        for place in 0..self.references_m2.len() {
            let ends = if self.sparse { self.ends[place].map(usize::from) } else { [first, second] };
            look(place, ends);
            first += 1;
            if first == second {
                (first, second) = (0, second + 1);
            }
        }
    }

    /// Finds where each pair was in the list `then`, if it was there.
    pub(crate) fn find_in(&self, then: Option<&Self>, places: &mut Places) {
        places.moved = self.sparse || then.is_none_or(|then| then.sparse || then.robots != self.robots);
        places.then.clear();
        if !places.moved {
            return;
        }
        let mut next = 0;
        self.each(|_, [first, second]| {
            let place = then.and_then(|then| then.place([first, second], &mut next));
            places.then.push(place.and_then(|place| u32::try_from(place).ok()).unwrap_or(NOWHERE));
        });
    }

    /// Where a pair is. `next` is where to look from: pairs are asked for in order.
    fn place(&self, [first, second]: [usize; 2], next: &mut usize) -> Option<usize> {
        if !self.sparse {
            return (second < self.robots).then(|| second * second.saturating_sub(1) / 2 + first);
        }
        let wanted = [second, first];
        let order = |ends: &[u16; 2]| [usize::from(ends[1]), usize::from(ends[0])];
        while self.ends.get(*next).is_some_and(|ends| order(ends) < wanted) {
            *next += 1;
        }
        self.ends.get(*next).filter(|ends| order(ends) == wanted).map(|_| *next)
    }
}

impl Places {
    /// Where the pair at `place` was in the earlier list.
    #[inline]
    pub(crate) fn then(&self, place: usize) -> Option<usize> {
        if !self.moved {
            return Some(place);
        }
        self.then.get(place).filter(|then| **then != NOWHERE).map(|then| *then as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Random, Stream};

    fn drawn(random: &mut Random, robots: usize, half_side_m: f64) -> Vec<Vector<2>> {
        (0..robots).map(|_| core::array::from_fn(|_| random.uniform(-half_side_m, half_side_m))).collect()
    }

    /// Every pair of a sparse tick is found in a sparse, a full and no earlier list exactly if it is there.
    #[test]
    fn pairs_are_found_again() {
        let random = &mut Random::new(5, Stream::Start);
        let mut lists = Vec::new();
        for (robots, half_side_m) in [(200, 8.0), (200, 8.0), (200, 1.0), (40, 8.0)] {
            let positions_m = drawn(random, robots, half_side_m);
            let mut pairs = Pairs::default();
            pairs.look(&positions_m, &positions_m, 1.5);
            lists.push(pairs);
        }
        assert_eq!([0, 1, 2, 3].map(|k: usize| lists[k].is_sparse()), [true, true, false, false]);
        let all = |list: &Pairs| {
            let mut all = Vec::new();
            list.each(|_, ends| all.push(ends));
            all
        };
        for now in &lists {
            for then in &lists {
                let mut places = Places::default();
                now.find_in(Some(then), &mut places);
                let earlier = all(then);
                for (place, ends) in all(now).iter().enumerate() {
                    let expected = earlier.iter().position(|there| there == ends);
                    assert_eq!(places.then(place), expected);
                }
            }
            let mut places = Places::default();
            now.find_in(None, &mut places);
            assert_eq!(places.then(3), None);
        }
    }
}
