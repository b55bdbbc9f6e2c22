//! Who counts for whom, and how many of them each robot must keep: written down once more, so that monitors do not rest on what
//! they watch.

use closeranks_core::robot::neighbor::{Member, RobotId};
use closeranks_core::settings::Team;
use closeranks_core::settings::params::Params;

use crate::scenario::{Rule as Consensus, Scenario};

/// The rule of a team.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    team: Team,
    /// Rank of each robot, and m; `None` where everybody counts for everybody.
    ranks: Option<(Vec<u16>, u16)>,
    /// Malicious robots may move as they like, so that normal neighbours alone are kept.
    free: bool,
    /// F values are discarded at either end of all that were told, whatever the own one is.
    trims: bool,
}

impl Rule {
    /// The rule of `scenario`.
    pub(crate) fn new<const D: usize>(scenario: &Scenario, params: &Params<D>) -> Self {
        let ranks = scenario.ranks::<D>().ok().flatten();
        let core = |ranks: &Vec<u16>| ranks.iter().filter(|rank| **rank == 0).count();
        let ranks = ranks.map(|ranks| (core(&ranks), ranks));
        Self {
            team: scenario.team,
            ranks: ranks.map(|(core, ranks)| (ranks, u16::try_from(core).unwrap_or(u16::MAX))),
            free: !params.controller().is_obeyed(),
            trims: scenario.consensus.rule == Consensus::TrimmedMean,
        }
    }

    /// F, whether in all or around each robot.
    pub(crate) fn faults(&self) -> u16 {
        self.team.faults
    }

    /// β where everybody counts for everybody: no weight of a mean is less.
    pub(crate) fn beta(&self) -> f64 {
        1.0 / f64::from(self.team.robots)
    }

    /// True if malicious robots may move as they like.
    pub(crate) fn is_free(&self) -> bool {
        self.free
    }

    /// The rank of each robot, if there are ranks.
    pub(crate) fn ranks(&self) -> Option<&[u16]> {
        self.ranks.as_ref().map(|(ranks, _)| ranks.as_slice())
    }

    /// A robot as others know it: its number and its rank.
    pub(crate) fn member(&self, robot: usize) -> Member {
        let rank = self.ranks().map_or(0, |ranks| ranks[robot]);
        Member { id: RobotId(u16::try_from(robot + 1).unwrap_or(u16::MAX)), rank }
    }

    /// True if robots count for each other among so many: all, or the core.
    fn among(&self, robot: usize) -> Option<u16> {
        match &self.ranks {
            None => Some(self.team.robots),
            Some((ranks, core)) => (ranks[robot] == 0).then_some(*core),
        }
    }

    /// The degree that counts: F + ⌊n/2⌋, n that of those who all count for each other, or θ among normal robots with free liars;
    /// above rank 0 so many that more than F of them are normal.
    pub(crate) fn required(&self, robot: usize) -> u16 {
        let faults = self.team.faults;
        match self.among(robot) {
            Some(robots) if self.free => faults + robots.saturating_sub(faults) / 2,
            Some(robots) => faults + robots / 2,
            None if self.free => faults + 1,
            None => 2 * faults + 1,
        }
    }

    /// How many neighbours a robot of `links` must count on: those that it needs, and with free liars as many more as may lie.
    pub(crate) fn keep(&self, robot: usize) -> u16 {
        self.required(robot) + if self.free { self.team.faults } else { 0 }
    }

    /// True if `other` counts for `robot`.
    pub(crate) fn counts(&self, robot: usize, other: usize) -> bool {
        let Some((ranks, _)) = &self.ranks else { return true };
        ranks[other] < ranks[robot] || (ranks[robot] == 0 && ranks[other] == 0)
    }

    /// True if values that `robot` heard in a round must have brought it closer: so many of robots that count for it, `normal` of
    /// these normal, where `one_voice` is true if malicious robots tell all the same, and `liars` of those who all
    /// count for each other are malicious.
    //= theory thm:contraction
    //= theory thm:two-faced
    //= theory thm:ranks
    //= theory sec:other-rules
    pub(crate) fn hears_enough(
        &self,
        robot: usize,
        [all, normal]: [u16; 2],
        one_voice: bool,
        liars: u16,
    ) -> bool {
        let faults = self.team.faults;
        if self.trims && (self.ranks.is_some() || all <= 2 * faults) {
            return false;
        }
        match self.among(robot) {
            Some(robots) => {
                (one_voice && all >= faults + robots / 2)
                    || normal >= faults + robots.saturating_sub(liars) / 2
            }
            None => normal > faults,
        }
    }
}
