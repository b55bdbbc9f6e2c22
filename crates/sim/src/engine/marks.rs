//! What a robot sees of the links of those around it, link by link: for teams too large for tables, and for those with ranks.

use closeranks_core::controller::Glimpse;
use closeranks_core::robot::neighbor::Member;

use crate::engine::roster::Roster;
use crate::engine::sees::{Around, Half};
use crate::frame::Frame;

/// For each robot those around it that count for it, in order, with the weights of their links.
#[derive(Clone, Debug, Default)]
pub(crate) struct Counting {
    /// Where those of each robot begin, and one past the last.
    starts: Vec<u32>,
    thirds: Vec<(u16, f64)>,
}

/// Whom a robot sees in this tick. Memory is a number a robot.
#[derive(Clone, Debug, Default)]
pub(crate) struct Marks {
    looker: u32,
    seen_by: Vec<u32>,
    /// The ranks of the robot that looked and of those that it sees.
    ranks: Vec<u16>,
}

/// What a robot sees of the links of a neighbour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Seen {
    /// The sum of the weights that count for the neighbour, in order of numbers.
    pub(crate) low: f64,
    /// How many they are.
    pub(crate) links: usize,
}

impl Counting {
    /// Takes in a team in which those in `around` are linked and pairs weigh so much.
    pub(crate) fn fill(&mut self, around: &Around, weights: &[f64], roster: &Roster) {
        self.starts.clear();
        self.thirds.clear();
        for robot in 0..roster.members().len() {
            self.starts.push(u32::try_from(self.thirds.len()).unwrap_or(u32::MAX));
            let (own, member) = (roster.member(robot), |half: &&Half| roster.member(usize::from(half.other)));
            let counts = around.of(robot).iter().filter(|half| roster.counts_for(own, member(half)));
            self.thirds.extend(counts.map(|half| (half.other, weights[half.pair as usize])));
        }
        self.starts.push(u32::try_from(self.thirds.len()).unwrap_or(u32::MAX));
    }

    #[inline]
    fn of(&self, robot: usize) -> &[(u16, f64)] {
        &self.thirds[self.starts[robot] as usize..self.starts[robot + 1] as usize]
    }
}

impl Marks {
    /// Marks `robot` and whom it sees in `around`, in the team of `roster`.
    pub(crate) fn look_from(&mut self, robot: usize, roster: &Roster, around: &Around) {
        let robots = roster.members().len();
        if self.seen_by.len() != robots {
            (self.looker, self.seen_by) = (0, vec![0; robots]);
        }
        // 0 stands for nobody. All marks are of one tick or older: they are overwritten before they are read again.
        self.looker = self.looker.checked_add(1).unwrap_or_else(|| {
            self.seen_by.fill(0);
            1
        });
        self.ranks.clear();
        for seen in around.of(robot).iter().map(|half| usize::from(half.other)).chain([robot]) {
            self.seen_by[seen] = self.looker;
            self.ranks.push(roster.member(seen).rank);
        }
    }

    /// What the robot that looked sees of the links of `other`.
    #[inline]
    pub(crate) fn seen(&self, other: usize, counting: &Counting) -> Seen {
        let mut seen = Seen::default();
        for (third, weight) in counting.of(other) {
            let sees = self.seen_by[usize::from(*third)] == self.looker;
            // No weight is negative: a sum does not change by 0.
            seen.low += if sees { *weight } else { 0.0 };
            seen.links += usize::from(sees);
        }
        seen
    }

    /// How many of those that the robot that looked sees, itself among them, count for `other`, whom it sees.
    #[inline]
    pub(crate) fn counting(&self, other: usize, roster: &Roster) -> usize {
        usize::from(roster.counting_among_ranks(other, &self.ranks))
    }
}

/// What whoever sees everybody sees of `member`, where so many are `counted` for each robot.
pub(crate) fn glimpse<const D: usize>(frame: &Frame<D>, member: Member, counted: &[u16]) -> Glimpse {
    let other = usize::from(member.id.0) - 1;
    Glimpse {
        member,
        weight: 0.0,
        told_level: frame.told[other],
        level: frame.levels[other],
        degree: counted[other],
        unseen: 0,
        unseen_near: 0,
        low: 0.0,
    }
}
