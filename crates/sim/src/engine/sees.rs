//! Who sees whom in a small team, a bit a pair, and the neighbours of each robot with their links.

use crate::engine::dense::DENSE_MAX;

/// Who is linked to whom in a team of at most [`DENSE_MAX`] robots, a word a robot.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sees {
    bits: Vec<u64>,
}

const _: () = assert!(DENSE_MAX <= 64, "a word has a bit for each robot");

impl Sees {
    /// Nobody sees anybody, in a team of so many robots.
    pub(crate) fn new(robots: usize) -> Self {
        Self { bits: vec![0; robots] }
    }

    /// Takes the links, robot by robot with those before it.
    pub(crate) fn fill<'a>(&mut self, links: impl Iterator<Item = (usize, &'a [u16])>) {
        self.bits.fill(0);
        for (second, firsts) in links {
            for first in firsts.iter().map(|first| usize::from(*first)) {
                self.bits[first] |= 1 << second;
                self.bits[second] |= 1 << first;
            }
        }
    }

    /// True if the two are linked.
    #[inline]
    pub(crate) fn linked(&self, robot: usize, other: usize) -> bool {
        self.bits[robot] >> other & 1 == 1
    }

    /// How many neighbours of `other` `robot` does not see, itself left aside.
    #[inline]
    pub(crate) fn unseen_near(&self, robot: usize, other: usize) -> usize {
        let (own, its) = (self.bits[robot], self.bits[other]);
        (its & !own & !(1 << robot)).count_ones() as usize
    }
}

/// Neighbours of every robot, in order of numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Around {
    /// Where those of each robot begin, and one past the last.
    starts: Vec<u32>,
    neighbors: Vec<Half>,
    filled: Vec<u32>,
}

/// A link as one of its ends sees it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Half {
    /// The other end.
    pub(crate) other: u16,
    /// Which pair it is.
    pub(crate) pair: u32,
}

impl Around {
    /// Takes links of a team of so many robots, in order of their second ends and then of the first.
    pub(crate) fn fill(&mut self, robots: usize, links: impl Iterator<Item = [u16; 2]> + Clone) {
        self.starts.clear();
        self.starts.resize(robots + 1, 0);
        for end in links.clone().flatten() {
            self.starts[usize::from(end) + 1] += 1;
        }
        for robot in 0..robots {
            self.starts[robot + 1] += self.starts[robot];
        }
        self.neighbors.resize(self.starts[robots] as usize, Half::default());
        self.filled.clear();
        self.filled.extend_from_slice(&self.starts[..robots]);
        for (pair, [first, second]) in (0..).zip(links) {
            for (end, other) in [(first, second), (second, first)] {
                let place = &mut self.filled[usize::from(end)];
                self.neighbors[*place as usize] = Half { other, pair };
                *place += 1;
            }
        }
    }

    /// The neighbours of one robot, in order.
    #[inline]
    pub(crate) fn of(&self, robot: usize) -> &[Half] {
        &self.neighbors[self.starts[robot] as usize..self.starts[robot + 1] as usize]
    }
}
