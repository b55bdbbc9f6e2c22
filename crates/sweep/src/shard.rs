//! Which runs of a sweep are ours, and in which blocks they are done.

use core::ops::Range;
use core::str::FromStr;

/// Files that a sweep is cut into, at least, if it has so many runs. Each waits for the disk: a millisecond or two.
const BLOCKS: u64 = 128;

/// Most runs of a block.
const BLOCK_MAX: u64 = 2_048;

/// Part `index` of `count`, from 1: runs k with k % count == index − 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Shard {
    /// Which, from 1.
    pub index: u64,
    /// Of how many.
    pub count: u64,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts =
            text.split_once('/').and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
        let shard = parts.and_then(|(index, count)| Self::new(index, count));
        shard.ok_or_else(|| "allowed is I/M with 1 <= I <= M <= 1000000, such as 2/8".to_owned())
    }
}

impl core::fmt::Display for Shard {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl Shard {
    /// True if there is only one.
    #[must_use]
    pub fn is_whole(self) -> bool {
        self.count == 1
    }

    /// The only one.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// Part `index` of `count`, from 1; none if there is no such part.
    #[must_use]
    pub fn new(index: u64, count: u64) -> Option<Self> {
        ((1..=count).contains(&index) && count <= 1_000_000).then_some(Self { index, count })
    }

    /// How many of `runs` are ours.
    #[must_use]
    pub fn runs(self, runs: u64) -> u64 {
        (runs + self.count - self.index) / self.count
    }

    /// Numbers of the runs in block `block` of a sweep of `runs`.
    pub fn block(self, runs: u64, block: u64) -> impl Iterator<Item = u64> {
        self.places(runs, block).map(move |place| place * self.count + self.index - 1)
    }

    /// Which of our runs, in their order, are in a block.
    fn places(self, runs: u64, block: u64) -> Range<u64> {
        let (all, size) = (self.runs(runs), self.block_runs(runs));
        (block * size).min(all)..((block + 1) * size).min(all)
    }

    /// How many blocks a sweep of `runs` has.
    #[must_use]
    pub fn blocks(self, runs: u64) -> u64 {
        self.runs(runs).div_ceil(self.block_runs(runs))
    }

    fn block_runs(self, runs: u64) -> u64 {
        (self.runs(runs) / BLOCKS).clamp(1, BLOCK_MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_run_is_in_one_block_of_one_shard() {
        for (runs, count) in [(1, 1), (500, 1), (500, 3), (2, 3), (100_000, 7), (1_000_000, 2)] {
            let mut seen = vec![0_u8; usize::try_from(runs).unwrap()];
            for index in 1..=count {
                let shard = Shard { index, count };
                let all = (0..shard.blocks(runs)).flat_map(|block| shard.block(runs, block));
                let all: Vec<u64> = all.collect();
                assert_eq!(all.len() as u64, shard.runs(runs));
                assert!(all.is_sorted() && all.iter().all(|run| run % count == index - 1));
                for run in all {
                    seen[usize::try_from(run).unwrap()] += 1;
                }
            }
            assert!(seen.iter().all(|times| *times == 1), "{runs} {count}");
        }
    }

    #[test]
    fn shards_are_read_and_refused() {
        assert_eq!("2/8".parse(), Ok(Shard { index: 2, count: 8 }));
        for wrong in ["", "2", "0/8", "9/8", "1/0", "-1/2", "1/2/3", "1/9999999"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
