//! Who sees whom, a bit a pair, and the neighbours of each robot with their links.

use crate::engine::links::Linked;

/// Who is linked to whom. Memory is n²/8 bytes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sees {
    words: usize,
    bits: Vec<u64>,
}

impl Sees {
    /// Nobody sees anybody, in a team of so many robots.
    pub(crate) fn new(robots: usize) -> Self {
        let words = robots.div_ceil(64);
        Self { words, bits: vec![0; robots * words] }
    }

    /// Takes the links, robot by robot with those before it.
    pub(crate) fn fill<'a>(&mut self, links: impl Iterator<Item = (usize, &'a [u16])>) {
        self.bits.fill(0);
        let words = self.words;
        for (second, firsts) in links {
            let (before, from_second) = self.bits.split_at_mut(second * words);
            for first in firsts.iter().map(|first| usize::from(*first)) {
                before[first * words + second / 64] |= 1 << (second % 64);
                from_second[first / 64] |= 1 << (first % 64);
            }
        }
    }

    /// True if the two are linked.
    #[inline]
    pub(crate) fn linked(&self, robot: usize, other: usize) -> bool {
        self.bits[robot * self.words + other / 64] >> (other % 64) & 1 == 1
    }

    /// How many neighbours of `other` `robot` does not see, itself left aside.
    #[inline]
    pub(crate) fn unseen_near(&self, robot: usize, other: usize) -> usize {
        if self.words > 1 {
            return self.unseen_near_of_many(robot, other);
        }
        let (own, its) = (self.bits[robot], self.bits[other]);
        (its & !own & !(1 << robot)).count_ones() as usize
    }

    /// The same in a team whose bits take several words.
    #[inline(never)]
    fn unseen_near_of_many(&self, robot: usize, other: usize) -> usize {
        let [own, its] = [robot, other].map(|of| &self.bits[of * self.words..][..self.words]);
        let beyond = own.iter().zip(its).map(|(own, its)| (its & !own).count_ones() as usize);
        beyond.sum::<usize>() - usize::from(self.linked(other, robot))
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
    /// Takes the pairs of a team of so many robots.
    pub(crate) fn fill<Pair>(&mut self, robots: usize, pairs: &[Linked<Pair>]) {
        self.starts.clear();
        self.starts.resize(robots + 1, 0);
        for end in pairs.iter().flat_map(|linked| linked.ends) {
            self.starts[usize::from(end) + 1] += 1;
        }
        for robot in 0..robots {
            self.starts[robot + 1] += self.starts[robot];
        }
        self.neighbors.resize(2 * pairs.len(), Half::default());
        self.filled.clear();
        self.filled.extend_from_slice(&self.starts[..robots]);
        for (pair, linked) in (0..).zip(pairs) {
            let [first, second] = linked.ends;
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
