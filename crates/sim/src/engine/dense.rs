//! What robots of a small team see of each other, in tables: weights of all with all, and sums over them.

use closeranks_core::equations::link::Link;
use closeranks_core::num::add_scaled;

use crate::engine::links::Linked;

/// Teams up to this size are kept in tables.
pub(crate) const DENSE_MAX: usize = 64;
/// So many weights are added at a time. Lines are filled up to a multiple of this.
const LANES: usize = 4;
/// In place of a pair of two robots that have none.
const NO_PAIR: u16 = u16::MAX;

/// The tables of a team.
#[derive(Clone, Debug)]
pub(crate) struct Dense {
    robots: usize,
    /// Weight of every robot with every other, a line a robot, and how long a line is in all tables.
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
            pairs: vec![NO_PAIR; robots * line],
            lows: vec![0.0; line],
        }
    }

    /// Takes the pairs of a tick and their weights.
    pub(crate) fn fill<Pair>(&mut self, pairs: &[Linked<Pair>], weights: &[f64]) {
        let line = self.line;
        let (all_weights, all_pairs) = (&mut self.weights[..], &mut self.pairs[..]);
        all_weights.fill(Link::NONE.weight);
        all_pairs.fill(NO_PAIR);
        for ((index, linked), weight) in (0..).zip(pairs).zip(weights) {
            let [first, second] = linked.ends.map(usize::from);
            for place in [first * line + second, second * line + first] {
                (all_weights[place], all_pairs[place]) = (*weight, index);
            }
        }
    }

    /// The others that `robot` has a pair with, in order of their numbers, and which pair each is.
    #[inline]
    pub(crate) fn neighbors(&self, robot: usize) -> impl Iterator<Item = (usize, usize)> + Clone {
        let pairs = self.pairs[robot * self.line..][..self.robots].iter().enumerate();
        pairs.filter(|(_, pair)| **pair != NO_PAIR).map(|(other, pair)| (other, usize::from(*pair)))
    }

    /// What `robot` sees of the level of each: sums over itself and the robots that it sees, in order of their numbers.
    pub(crate) fn look_around(&mut self, robot: usize) {
        let pairs = &self.pairs[robot * self.line..][..self.robots];
        self.lows.fill(0.0);
        for ((other, pair), weights) in pairs.iter().enumerate().zip(self.weights.chunks_exact(self.line)) {
            if other == robot || *pair != NO_PAIR {
                let weights = weights.as_chunks::<LANES>().0;
                for (lows, weights) in self.lows.as_chunks_mut().0.iter_mut().zip(weights) {
                    *lows = add_scaled(lows, 1.0, weights);
                }
            }
        }
    }

    /// What the robot that looked around sees of the level of `other`.
    #[inline]
    pub(crate) fn low(&self, other: usize) -> f64 {
        self.lows[other]
    }
}
