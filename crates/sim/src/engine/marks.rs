//! What a robot sees of the links of those around it, link by link: for teams too large for tables, and for those with ranks.

use closeranks_core::controller::Glimpse;
use closeranks_core::robot::neighbor::Member;

use crate::engine::roster::Roster;
use crate::engine::sees::Around;
use crate::frame::Frame;

/// Whom a robot sees in this tick. Memory is a number a robot.
#[derive(Clone, Debug, Default)]
pub(crate) struct Marks {
    looker: u32,
    seen_by: Vec<u32>,
}

/// What a robot sees of the links of a neighbour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Seen {
    /// The sum of the weights that count for the neighbour, in order of numbers.
    pub(crate) low: f64,
    /// How many they are.
    pub(crate) links: usize,
}

impl Marks {
    /// Marks `robot` and whom it sees in `around`, a team of so many robots.
    pub(crate) fn look_from(&mut self, robot: usize, robots: usize, around: &Around) {
        if self.seen_by.len() != robots {
            (self.looker, self.seen_by) = (0, vec![0; robots]);
        }
        // 0 stands for nobody. All marks are of one tick or older: they are overwritten before they are read again.
        self.looker = self.looker.checked_add(1).unwrap_or_else(|| {
            self.seen_by.fill(0);
            1
        });
        self.seen_by[robot] = self.looker;
        for half in around.of(robot) {
            self.seen_by[usize::from(half.other)] = self.looker;
        }
    }

    /// What the robot that looked sees of the links of `other`, whose weights are `weights`.
    #[inline]
    pub(crate) fn seen(&self, other: usize, around: &Around, weights: &[f64], roster: &Roster) -> Seen {
        let mut seen = Seen::default();
        let ranked = roster.is_ranked();
        for half in around.of(other) {
            let third = usize::from(half.other);
            if self.seen_by[third] == self.looker && (!ranked || roster.counts(other, third)) {
                seen.low += weights[half.pair as usize];
                seen.links += 1;
            }
        }
        seen
    }
}

/// How many of those that `robot` sees, itself among them, count for `other`.
pub(crate) fn counting(robot: usize, other: usize, around: &Around, roster: &Roster) -> usize {
    if !roster.is_ranked() {
        return around.of(robot).len();
    }
    let seen = around.of(robot).iter().map(|half| usize::from(half.other)).chain([robot]);
    seen.filter(|third| roster.counts(other, *third)).count()
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
