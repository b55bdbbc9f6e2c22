//! Who counts for whom, and how many of them a robot must keep: one rule for a whole team.

use crate::robot::neighbor::RobotId;

/// Which neighbours a robot must keep enough of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Neighbours, whoever they are: `F′ = F + ⌊n/2⌋` of them (thm:rs_robust).
    Neighbors,
    /// Normal neighbours: `θ = F + ⌊(n − F)/2⌋` of them, so that malicious robots may move as they like.
    NormalNeighbors,
}

/// The rule of the paper: everybody counts for everybody, and all need the same number.
///
/// Every controller asks this type, so that another rule, such as ranks, changes one file. The monitors of the simulator write
/// the rule down a second time, so that they do not rest on what they watch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Need {
    robots: u16,
    each: u16,
}

impl Need {
    /// The rule for a team of `robots` (n) of which up to `faults` (F) are malicious.
    //= paper thm:rs_robust
    //= theory eq:need
    #[must_use]
    pub fn new(robots: u16, faults: u16, keep: Keep) -> Self {
        let half = match keep {
            Keep::Neighbors => robots / 2,
            Keep::NormalNeighbors => robots.saturating_sub(faults) / 2,
        };
        Self { robots, each: faults.saturating_add(half) }
    }

    /// How many of those who count for `robot` it must have as neighbours. The paper's rule is the same for all.
    #[inline]
    #[must_use]
    pub fn need(&self, _robot: RobotId) -> u16 {
        self.each
    }

    /// True if `other`, as a neighbour, counts for `robot`.
    #[inline]
    #[must_use]
    pub fn counts(&self, robot: RobotId, other: RobotId) -> bool {
        robot != other
    }

    /// How many robots of the team count for `robot`.
    #[inline]
    #[must_use]
    pub fn counting(&self, _robot: RobotId) -> u16 {
        self.robots.saturating_sub(1)
    }

    /// How many of `others`, all different and none of them `robot` itself, count for `robot`.
    #[inline]
    pub fn counting_among(&self, _robot: RobotId, others: impl Iterator<Item = RobotId>) -> usize {
        others.count()
    }

    /// n, the number of robots in the team.
    #[must_use]
    pub fn robots(&self) -> u16 {
        self.robots
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    //= paper thm:rs_robust type=test
    //= theory eq:need type=test
    #[test]
    fn the_paper_needs_seven_of_ten_and_six_normal_ones() {
        let need = Need::new(11, 2, Keep::Neighbors);
        assert_eq!((need.need(RobotId(1)), need.counting(RobotId(1))), (7, 10));
        assert_eq!(Need::new(11, 2, Keep::NormalNeighbors).need(RobotId(3)), 6);
        assert_eq!(Need::new(u16::MAX, u16::MAX, Keep::Neighbors).need(RobotId(1)), u16::MAX);
        assert!(need.counts(RobotId(1), RobotId(2)) && !need.counts(RobotId(2), RobotId(2)));
    }
}
