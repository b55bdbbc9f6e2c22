//! Who is in a team, and who counts for whom.

use closeranks_core::need::Need;
use closeranks_core::robot::neighbor::{Member, RobotId};
use closeranks_core::settings::params::Params;

use crate::geometry::near::small;
use crate::scenario::Scenario;

/// The robots of a team as they know each other.
#[derive(Clone, Debug)]
pub(crate) struct Roster {
    need: Need,
    members: Vec<Member>,
}

impl Roster {
    /// The roster of `scenario`.
    pub(crate) fn new<const D: usize>(scenario: &Scenario, params: &Params<D>) -> Self {
        let ranks = scenario.ranks::<D>().ok().flatten();
        let rank = |index: usize| ranks.as_ref().map_or(0, |ranks| ranks[index]);
        let robots = 0..usize::from(scenario.team.robots);
        let members = robots.map(|index| Member { id: RobotId(small(index + 1)), rank: rank(index) });
        Self { need: *params.need(), members: members.collect() }
    }

    /// All robots in order.
    pub(crate) fn members(&self) -> &[Member] {
        &self.members
    }

    /// One robot.
    #[inline]
    pub(crate) fn member(&self, robot: usize) -> Member {
        self.members[robot]
    }

    /// True where ranks tell who counts for whom.
    #[inline]
    pub(crate) fn is_ranked(&self) -> bool {
        self.need.is_ranked()
    }

    /// True if `other` counts for `robot`.
    #[inline]
    pub(crate) fn counts(&self, robot: usize, other: usize) -> bool {
        self.counts_for(self.members[robot], self.members[other])
    }

    /// The same of robots that are at hand.
    #[inline]
    pub(crate) fn counts_for(&self, robot: Member, other: Member) -> bool {
        self.need.counts(robot, other)
    }

    /// How many robots of these ranks count for `robot`, which is one of them.
    #[inline]
    pub(crate) fn counting_among_ranks(&self, robot: usize, ranks: &[u16]) -> u16 {
        self.need.counting_among_ranks(self.members[robot], ranks)
    }

    /// How many that count `robot` needs.
    #[inline]
    pub(crate) fn need(&self, robot: usize) -> u16 {
        self.need.need(self.members[robot])
    }

    /// How many of the team may count for `robot`.
    #[inline]
    pub(crate) fn counting(&self, robot: usize) -> usize {
        usize::from(self.need.counting(self.members[robot]))
    }
}
