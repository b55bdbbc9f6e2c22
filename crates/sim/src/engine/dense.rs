//! What robots of a small team see of each other, in tables: weights of all with all, and sums over them a few at a time.

use closeranks_core::equations::link::Link;
use closeranks_core::num::add_scaled;

use crate::engine::links::Linked;

/// Teams up to this size are kept in tables.
pub(crate) const DENSE_MAX: usize = 64;
/// So many weights are summed at a time.
const LANES: usize = 4;
/// In place of a pair of two robots that have none.
const NO_PAIR: u16 = u16::MAX;

/// The tables of a team.
#[derive(Clone, Debug)]
pub(crate) struct Dense {
    robots: usize,
    /// Weight of every robot with every other, in lines of whole blocks, and how long a line is.
    weights: Vec<f64>,
    line: usize,
    /// Which pair every robot is with every other.
    pairs: Vec<u16>,
    /// Of the robot that looked around: what it sees of the level of each.
    lows: Vec<f64>,
}

impl Dense {
    /// Of a team in which nobody has a link.
    pub(crate) fn new(robots: usize) -> Self {
        let line = robots.next_multiple_of(LANES);
        Self {
            robots,
            weights: vec![Link::NONE.weight; robots * line],
            line,
            pairs: vec![NO_PAIR; robots * robots],
            lows: vec![0.0; line],
        }
    }

    /// Takes the pairs of a tick and their weights.
    pub(crate) fn fill<Pair>(&mut self, pairs: &[Linked<Pair>], weights: &[f64]) {
        self.weights.fill(Link::NONE.weight);
        self.pairs.fill(NO_PAIR);
        for ((index, linked), weight) in (0..).zip(pairs).zip(weights) {
            let [first, second] = linked.ends.map(usize::from);
            for (end, other) in [(first, second), (second, first)] {
                self.weights[end * self.line + other] = *weight;
                self.pairs[end * self.robots + other] = index;
            }
        }
    }

    /// The others that `robot` has a pair with, in order of their numbers, and which pair each is.
    #[inline]
    pub(crate) fn neighbors(&self, robot: usize) -> impl Iterator<Item = (usize, usize)> + Clone {
        let pairs = self.pairs[robot * self.robots..][..self.robots].iter().enumerate();
        pairs.filter(|(_, pair)| **pair != NO_PAIR).map(|(other, pair)| (other, usize::from(*pair)))
    }

    /// What `robot` sees of the level of each: sums over itself and the robots that it sees, in order of their numbers.
    pub(crate) fn look_around(&mut self, robot: usize) {
        let (line, pairs) = (self.line, &self.pairs[robot * self.robots..][..self.robots]);
        let sees = |other: &usize| *other == robot || pairs[*other] != NO_PAIR;
        for (block, lows) in self.lows.as_chunks_mut().0.iter_mut().enumerate() {
            let weights = |other: usize| self.weights[other * line + block * LANES..].first_chunk();
            let weights = (0..pairs.len()).filter(sees).filter_map(weights);
            *lows = weights.fold([0.0; LANES], |sums, weights| add_scaled(&sums, 1.0, weights));
        }
    }

    /// What the robot that looked around sees of the level of `other`.
    #[inline]
    pub(crate) fn low(&self, other: usize) -> f64 {
        self.lows[other]
    }
}
