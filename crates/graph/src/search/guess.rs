//! Guessing a witness: two sets that are changed one node at a time, for the better or, by chance, for a little worse.
//!
//! What is found is a witness whatever led to it. That nothing is found says nothing.

use alloc::vec;
use alloc::vec::Vec;

use super::peel::Needs;
use crate::effort::{Meter, Stopped};
use crate::generator::Generator;
use crate::graph::word::Word;

/// Changes that are tried for each node that is counted; both take about as long.
const CHANGES: i32 = 8;

/// Nodes of a part of the tree before the first guess.
const PATIENCE: u64 = 1 << 15;

/// The next guess comes when a part is so many times as long.
const GROWTH: u64 = 4;

/// One node of guessing for so many nodes of search.
const SHARE: u64 = 4;

/// Changes until the sets are begun again, at first. Each time there are twice as many.
const CHANGES_FIRST: i32 = 1 << 13;

/// No more than this many.
const CHANGES_MOST: i32 = 1 << 24;

/// How much worse a change may be at the beginning and at the end, in units of cost: in half of all cases so much, in a quarter twice as much
/// and so on.
const WARMTH: [i32; 2] = [36, 5];

/// What an exempt member costs that lacks one neighbour.
const EXEMPT: i32 = 64;

/// Where a node is: in neither set, in the first, in the second.
const PLACES: usize = 3;

/// Two sets, and what is known of them.
//= theory sec:guess
pub(super) struct Guess<'b, W> {
    needs: &'b Needs<W>,
    /// Exempt members that both sets may have together.
    effort: i32,
    generator: Generator,
    /// Who is in each place.
    sets: [W; PLACES],
    /// The place of every node.
    places: Vec<usize>,
    /// For every node how many of those that it hears are in each place.
    heard: Vec<[i32; PLACES]>,
    /// Content members of each set.
    content: [i32; PLACES],
    exempt: i32,
    /// Changes until the sets are begun again, and changes so far.
    changes: [i32; 2],
}

/// When the search of a part of the tree guesses: after [`PATIENCE`] nodes, and whenever it is four times as long. A quarter as many nodes then go
/// into guesses.
#[derive(Clone, Copy)]
pub(super) struct Guesses {
    part: usize,
    patience: u64,
    next: u64,
}

impl Guesses {
    /// For the part of that number, which begins at so many nodes.
    pub(super) fn new(part: usize, begin: u64) -> Self {
        Self { part, patience: PATIENCE, next: begin.saturating_add(PATIENCE) }
    }

    /// A seed and a number of nodes, if it is time.
    pub(super) fn due(&mut self, now: u64) -> Option<(u64, u64)> {
        if now < self.next {
            return None;
        }
        let (seed, nodes) = (self.part as u64 ^ self.patience << 8, self.patience / SHARE);
        self.next = now.saturating_add(nodes).saturating_add((GROWTH - 1) * self.patience);
        self.patience = self.patience.saturating_mul(GROWTH);
        Some((seed, nodes))
    }
}

/// What a change would do.
#[derive(Default)]
struct Change {
    cost: i32,
    content: [i32; PLACES],
    exempt: i32,
}

impl<'b, W: Word> Guess<'b, W> {
    /// The sets begin at random, always the same for the same graph and seed. `needs` are thorough ones.
    pub(super) fn new(needs: &'b Needs<W>, effort: i32, seed: u64) -> Self {
        let mut guess = Self {
            needs,
            effort,
            generator: Generator::new(seed),
            sets: [W::NONE; PLACES],
            places: vec![0; needs.need.len()],
            heard: vec![[0; PLACES]; needs.need.len()],
            content: [0; PLACES],
            exempt: 0,
            changes: [CHANGES_FIRST, 0],
        };
        guess.begin();
        guess
    }

    /// Goes on for `nodes` nodes: two disjoint sets with a content member each and no more exempt ones together than there may be.
    pub(super) fn go_on(&mut self, nodes: u64, meter: &mut Meter<'_>) -> Result<Option<(W, W)>, Stopped> {
        for _ in 0..nodes {
            meter.spend(1)?;
            for _ in 0..CHANGES {
                self.try_change(self.warmth());
                if self.is_witness() {
                    return Ok(Some((self.sets[1], self.sets[2])));
                }
            }
            self.count_changes();
        }
        Ok(None)
    }

    /// It cools from the beginning to the end.
    fn warmth(&self) -> i32 {
        let [all, done] = self.changes.map(i64::from);
        let [first, last] = WARMTH.map(i64::from);
        i32::try_from(first - (first - last) * done / all).unwrap_or(WARMTH[1])
    }

    fn count_changes(&mut self) {
        self.changes[1] += CHANGES;
        if self.changes[1] >= self.changes[0] {
            self.changes = [(2 * self.changes[0]).min(CHANGES_MOST), 0];
            self.begin();
        }
    }

    /// Every node is in one of the two sets, by chance.
    fn begin(&mut self) {
        self.sets = [W::NONE; PLACES];
        for (node, place) in self.places.iter_mut().enumerate() {
            *place = 1 + self.generator.below(2);
            self.sets[*place] = self.sets[*place] | W::one(node);
        }
        (self.content, self.exempt) = ([0; PLACES], 0);
        for (node, place) in self.places.iter().enumerate() {
            self.heard[node] = self.sets.map(|set| self.needs.heard_in(node, set));
            let is_exempt = self.needs.need[node] > self.heard[node][*place];
            self.exempt += i32::from(is_exempt);
            self.content[*place] += i32::from(!is_exempt);
        }
    }

    fn is_witness(&self) -> bool {
        self.exempt <= self.effort && self.content[1] > 0 && self.content[2] > 0
    }

    /// Moves some node to some other place, if that is no worse than the warmth and chance allow and no set loses its last content member.
    fn try_change(&mut self, warmth: i32) {
        let node = self.generator.below(self.places.len());
        let from = self.places[node];
        let to = (from + 1 + self.generator.below(PLACES - 1)) % PLACES;
        let change = self.change(node, from, to);
        let least = |content: [i32; PLACES]| content[1].min(content[2]);
        let content = [0, 1, 2].map(|place| self.content[place] + change.content[place]);
        let keeps = least(content) > 0 || least(self.content) == 0;
        if keeps && (change.cost <= 0 || change.cost * 64 <= warmth * luck(self.generator.next())) {
            (self.content, self.exempt) = (content, self.exempt + change.exempt);
            self.place(node, from, to);
        }
    }

    fn place(&mut self, node: usize, from: usize, to: usize) {
        let one = W::one(node);
        (self.sets[from], self.sets[to]) = (self.sets[from].without(one), self.sets[to] | one);
        self.places[node] = to;
        for hearer in self.needs.told[node].nodes() {
            self.heard[hearer][from] -= 1;
            self.heard[hearer][to] += 1;
        }
    }

    fn change(&self, node: usize, from: usize, to: usize) -> Change {
        let mut change = Change::default();
        let lack = |node: usize, place: usize| self.needs.need[node] - self.heard[node][place];
        self.leave(&mut change, from, lack(node, from), -1);
        self.leave(&mut change, to, lack(node, to), 1);
        let told = self.needs.told[node];
        if from > 0 {
            for lack in (told & self.sets[from]).nodes().map(|hearer| lack(hearer, from)) {
                change.step(from, lack + 1, 1, self.rise(lack + 1));
            }
        }
        if to > 0 {
            for lack in (told & self.sets[to]).nodes().map(|hearer| lack(hearer, to)) {
                change.step(to, lack, -1, self.rise(lack));
            }
        }
        change
    }

    /// A node that lacks so many members of a set comes into it or, with `times` −1, goes.
    fn leave(&self, change: &mut Change, place: usize, lack: i32, times: i32) {
        if place == 0 {
            return;
        }
        change.cost += times * (1..=lack).map(|lack| self.rise(lack)).sum::<i32>();
        if lack > 0 {
            change.exempt += times;
        } else {
            change.content[place] += times;
        }
    }

    /// What it costs to lack one more, so many then.
    fn rise(&self, lack: i32) -> i32 {
        match (lack, self.effort) {
            (..1, _) => 0,
            (1, _) => EXEMPT,
            (_, 0) => EXEMPT / 2,
            (2..=4, _) => EXEMPT / 6,
            _ => 0,
        }
    }
}

impl Change {
    /// A member of a set lacks one more than before, `lack` then, or with `times` −1 one less.
    fn step(&mut self, place: usize, lack: i32, times: i32, rise: i32) {
        self.cost += times * rise;
        if lack == 1 {
            self.exempt += times;
            self.content[place] -= times;
        }
    }
}

/// −log2 of a number in (0, 1) whose bits these are, times 64, to within a tenth.
fn luck(bits: u64) -> i32 {
    let zeros = bits.leading_zeros().min(63);
    let rest = bits << zeros >> 57 & 63;
    i32::try_from(64 * u64::from(zeros + 1) - rest).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use core::ops::ControlFlow;

    use super::*;
    use crate::definition::{self, Witness};
    use crate::effort::Progress;
    use crate::graph::Graph;
    use crate::graph::set::NodeSet;
    use crate::makers::{fixed, random};

    fn guessed(graph: &Graph, r: usize, s: usize, nodes: u64) -> Option<Witness> {
        let mut go_on = |_: &Progress| ControlFlow::Continue(());
        let mut meter = Meter::new(u64::MAX, &mut go_on);
        let needs = Needs::<u64>::thorough(graph, r);
        let effort = i32::try_from(s).unwrap() - 1;
        let found = Guess::new(&needs, effort, 1).go_on(nodes, &mut meter).unwrap();
        assert!(found.is_some() || meter.nodes() == nodes);
        let set = |set: u64| NodeSet::from_bits(set.into());
        found.map(|(first, second)| Witness::new(graph, r, s, set(first), set(second)))
    }

    //= theory sec:guess type=test
    #[test]
    fn all_that_is_guessed_is_true_and_nearly_all_that_is_true_is_guessed() {
        let (mut found, mut missed) = (0, 0);
        for seed in 0..12 {
            let graph = random::erdos_renyi(8, 0.6, seed % 3 == 0, seed).unwrap();
            for (r, s) in (1..=4).flat_map(|r| (1..=8).map(move |s| (r, s))) {
                match guessed(&graph, r, s, 1500) {
                    Some(witness) => {
                        assert!(witness.holds(&graph), "{witness:?}, {graph:?}");
                        found += 1;
                    }
                    None => missed += usize::from(!definition::is_robust(&graph, r, s)),
                }
            }
        }
        assert!(found > 200 && missed < found / 20, "{found} found, {missed} missed");
    }

    #[test]
    fn what_is_known_of_the_sets_stays_right() {
        let graph = fixed::k_circulant(11, 3, true).unwrap();
        let needs = Needs::<u64>::thorough(&graph, 2);
        let mut guess = Guess::new(&needs, 3, 5);
        for _ in 0..2000 {
            guess.try_change(36);
            let lacks =
                |node: usize, place: usize| needs.need[node] - needs.heard_in(node, guess.sets[place]);
            let mut content = [0; PLACES];
            let mut exempt = 0;
            for (node, place) in guess.places.iter().enumerate().filter(|(_, place)| **place > 0) {
                assert!(u64::one(node).is_within(guess.sets[*place]));
                content[*place] += i32::from(lacks(node, *place) <= 0);
                exempt += i32::from(lacks(node, *place) > 0);
            }
            assert_eq!([content[1], content[2], exempt], [guess.content[1], guess.content[2], guess.exempt]);
        }
    }

    #[test]
    fn guesses_are_made_ever_less_often() {
        let mut guesses = Guesses::new(7, 100);
        let mut due = (100..1 << 20).filter_map(|now| guesses.due(now).map(|(_, nodes)| (now, nodes)));
        assert_eq!(due.next(), Some((100 + PATIENCE, PATIENCE / 4)));
        let second = 100 + 4 * PATIENCE + PATIENCE / 4;
        assert_eq!(due.next(), Some((second, PATIENCE)));
        assert_eq!(due.next(), Some((second + PATIENCE + 12 * PATIENCE, 4 * PATIENCE)));
    }

    #[test]
    fn luck_is_a_logarithm() {
        let at = |bits: u64| luck(bits);
        assert_eq!([u64::MAX, 1 << 63, 3 << 62, 1 << 62, 1 << 60].map(at), [1, 64, 32, 128, 256]);
        assert_eq!([0, 1].map(at), [4096, 4096]);
    }
}
