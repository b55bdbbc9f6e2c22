//! Who counts for whom, and how many of them a robot must keep: one rule for a whole team.

use crate::id::Member;

/// Which neighbours a robot must keep enough of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Neighbours, whoever they are: `F′ = F + ⌊n/2⌋` of them (thm:rs_robust).
    Neighbors,
    /// Normal neighbours: `θ = F + ⌊(n − F)/2⌋` of them, so that malicious robots may move as they like.
    NormalNeighbors,
}

/// Ranks of a team: who counts for a robot depends on the rank of both in the roster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ranks {
    /// m, how many robots have rank 0, from 2F + 1 to n.
    pub core: u16,
    /// Whose values a robot takes in a consensus round.
    pub listen: Listen,
}

/// Whose values a robot takes in a consensus round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Listen {
    /// Those of all neighbours.
    #[default]
    All,
    /// Those of the neighbours that count for it.
    Counted,
}

/// The rule of a team: that of the paper, in which everybody counts for everybody and all need the same number, or ranks.
///
/// Under ranks the robots of rank 0, the core, count for each other by the paper's rule among them. For any other robot those of
/// lower ranks count, and it needs 2F + 1 of them. A team that is all core has the paper's rule.
///
/// Every controller asks this type. The monitors of the simulator write the rule down a second time, so that they do not
/// rest on what they watch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Need {
    robots: u16,
    /// How many robots count for each other: all, or those of rank 0.
    core: u16,
    in_core: u16,
    /// What robots above rank 0 need; `None` without ranks.
    above: Option<u16>,
}

impl Need {
    /// The rule for a team of `robots` (n) of which up to `faults` (F) are malicious.
    //= paper thm:rs_robust
    //= theory eq:need
    #[must_use]
    pub fn new(robots: u16, faults: u16, keep: Keep) -> Self {
        Self { robots, core: robots, in_core: among(robots, faults, keep), above: None }
    }

    /// The rule for the same team with a core of `core` robots (m), where up to `faults` of those around each robot are malicious.
    //= theory thm:ranks
    #[must_use]
    pub fn ranked(robots: u16, core: u16, faults: u16, keep: Keep) -> Self {
        // So many that one more than F of them are normal, whatever up to F others do.
        let above = match keep {
            Keep::Neighbors => faults.saturating_mul(2).saturating_add(1),
            Keep::NormalNeighbors => faults.saturating_add(1),
        };
        Self { robots, core, in_core: among(core, faults, keep), above: Some(above) }
    }

    /// How many of those who count for `robot` it must have as neighbours.
    #[inline]
    #[must_use]
    pub fn need(&self, robot: impl Into<Member>) -> u16 {
        match self.above {
            Some(above) if robot.into().rank > 0 => above,
            _ => self.in_core,
        }
    }

    /// True if `other`, as a neighbour, counts for `robot`.
    #[inline]
    #[must_use]
    pub fn counts(&self, robot: impl Into<Member>, other: impl Into<Member>) -> bool {
        let (robot, other) = (robot.into(), other.into());
        let ranked = self.above.is_none() || other.rank < robot.rank || (robot.rank, other.rank) == (0, 0);
        robot.id != other.id && ranked
    }

    /// How many robots of the team count for `robot`, at most: nobody knows how many share a rank.
    #[inline]
    #[must_use]
    pub fn counting(&self, robot: impl Into<Member>) -> u16 {
        let of = if self.above.is_some() && robot.into().rank == 0 { self.core } else { self.robots };
        of.saturating_sub(1)
    }

    /// True where ranks tell who counts for whom.
    #[inline]
    #[must_use]
    pub fn is_ranked(&self) -> bool {
        self.above.is_some()
    }

    /// How many must count for a robot that needs most.
    #[must_use]
    pub fn most(&self) -> u16 {
        self.in_core.max(self.above.unwrap_or(0))
    }

    /// How many of `others`, all different and none of them `robot` itself, count for `robot`.
    #[inline]
    pub fn counting_among(&self, robot: impl Into<Member>, others: impl Iterator<Item = Member>) -> usize {
        if self.above.is_none() {
            return others.count();
        }
        let robot = robot.into();
        others.filter(|other| self.counts(robot, *other)).count()
    }

    /// Counts what [`counting_among`](Self::counting_among) does, for robots with these `ranks`, of which `robot` itself is one.
    #[inline]
    pub fn counting_among_ranks(&self, robot: impl Into<Member>, ranks: &[u16]) -> u16 {
        let rank = robot.into().rank;
        if self.above.is_none() {
            return u16::try_from(ranks.len().saturating_sub(1)).unwrap_or(u16::MAX);
        }
        // In the core all but the robot itself count; above it those below.
        let (below, itself) = if rank == 0 { (1, 1) } else { (rank, 0) };
        let count = ranks.iter().fold(0_u16, |count, other| count.wrapping_add(u16::from(*other < below)));
        count.saturating_sub(itself)
    }

    /// n, the number of robots in the team.
    #[must_use]
    pub fn robots(&self) -> u16 {
        self.robots
    }
}

/// What each of so many robots needs that all count for each other.
fn among(robots: u16, faults: u16, keep: Keep) -> u16 {
    let half = match keep {
        Keep::Neighbors => robots / 2,
        Keep::NormalNeighbors => robots.saturating_sub(faults) / 2,
    };
    faults.saturating_add(half)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::neighbor::RobotId;

    //= paper thm:rs_robust type=test
    //= theory eq:need type=test
    #[test]
    fn the_paper_needs_seven_of_ten_and_six_normal_ones() {
        let need = Need::new(11, 2, Keep::Neighbors);
        assert_eq!((need.need(RobotId(1)), need.counting(RobotId(1))), (7, 10));
        assert_eq!(Need::new(11, 2, Keep::NormalNeighbors).need(RobotId(3)), 6);
        assert_eq!(Need::new(u16::MAX, u16::MAX, Keep::Neighbors).need(RobotId(1)), u16::MAX);
        assert!(need.counts(RobotId(1), RobotId(2)) && !need.counts(RobotId(2), RobotId(2)));
        let high = Member { id: RobotId(1), rank: 5 };
        assert!(need.counts(RobotId(2), high) && need.need(high) == 7, "without ranks nobody asks for them");
    }

    //= theory thm:ranks type=test
    #[test]
    fn a_rank_needs_what_the_table_of_the_theorem_says() {
        let of = |id, rank| Member { id: RobotId(id), rank };
        for (robots, core, faults) in [(40, 7, 2), (10_000, 9, 2), (4, 3, 1), (11, 11, 2)] {
            let need = Need::ranked(robots, core, faults, Keep::Neighbors);
            assert_eq!(need.need(of(1, 0)), faults + core / 2);
            assert_eq!([1, 2, 9_000].map(|rank| need.need(of(1, rank))), [2 * faults + 1; 3]);
            let free = Need::ranked(robots, core, faults, Keep::NormalNeighbors);
            assert_eq!(free.need(of(1, 0)), faults + (core - faults) / 2);
            assert_eq!(free.need(of(1, 3)), faults + 1);
            let counts = |own, other| need.counts(of(1, own), of(2, other));
            assert!(counts(0, 0) && counts(1, 0) && counts(5, 4) && counts(u16::MAX, 0));
            assert!(!counts(0, 1) && !counts(1, 1) && !counts(4, 5) && !need.counts(of(1, 2), of(1, 1)));
            assert_eq!((need.counting(of(1, 0)), need.counting(of(1, 3))), (core - 1, robots - 1));
        }
        let all_core = Need::ranked(11, 11, 2, Keep::Neighbors);
        assert_eq!(all_core.need(of(3, 0)), Need::new(11, 2, Keep::Neighbors).need(RobotId(3)));
    }

    #[test]
    fn counting_ranks_is_counting_robots() {
        let ranks = [0, 3, 0, 5, 5, 1, 0, 2];
        let member = |index: usize| Member { id: RobotId(u16::try_from(index).unwrap()), rank: ranks[index] };
        for need in [Need::ranked(40, 3, 1, Keep::Neighbors), Need::new(40, 1, Keep::Neighbors)] {
            for own in 0..ranks.len() {
                let others = (0..ranks.len()).filter(|other| *other != own).map(member);
                let counted = need.counting_among(member(own), others);
                assert_eq!(usize::from(need.counting_among_ranks(member(own), &ranks)), counted, "{own}");
            }
        }
    }
}
