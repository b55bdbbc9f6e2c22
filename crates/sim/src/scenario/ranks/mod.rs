//! Ranks of a team: listed, or chosen from where robots start.

mod order;
mod read;

use closeranks_core::need::Listen;
use closeranks_core::num::Vector;

use crate::scenario::ranks::order::Start;

/// The ranks of a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ranking {
    /// What they are, or how they are chosen.
    pub how: How,
    /// Whose values robots take.
    pub listen: Listen,
}

/// What ranks are, or how they are chosen from the start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum How {
    /// A rank of its own for each robot outside of the core, from the middle outwards.
    Own {
        /// m.
        core: u16,
    },
    /// The same rank for all that have enough robots of lower ranks in range.
    Layers {
        /// m.
        core: u16,
    },
    /// The rank of each robot is listed.
    Listed(Vec<u16>),
}

/// How many neighbours that count a robot must be able to count on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keeps {
    /// A robot of the core.
    pub core: usize,
    /// Any other.
    pub above: usize,
}

/// Why there are no ranks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RanksError {
    /// The list is about another team.
    #[error("{found} ranks for {robots} robots")]
    Count {
        /// How many there are.
        found: usize,
        /// n.
        robots: u16,
    },
    /// The core cannot keep what it must.
    #[error("a core of {core}, whose robots must each count on {keep} others of it")]
    Core {
        /// m.
        core: u16,
        /// How many of the others each must count on.
        keep: usize,
    },
    /// Nowhere at the start are enough robots close enough to each other.
    #[error("no {core} robots of the start that are each in range of {keep} others of them")]
    NoCore {
        /// m.
        core: u16,
        /// How many of the others each must count on.
        keep: usize,
    },
    /// Some robots can never have enough neighbours of lower ranks.
    #[error(
        "robot {robot}, which can never have {keep} neighbours of lower ranks{}",
        if *.others > 0 { format!(", nor can {} others", .others) } else { String::new() }
    )]
    Short {
        /// The first of them.
        robot: u16,
        /// How many others there are.
        others: usize,
        /// How many of lower ranks each needs.
        keep: usize,
    },
}

impl Ranking {
    /// m.
    #[must_use]
    pub fn core(&self) -> u16 {
        match &self.how {
            How::Own { core } | How::Layers { core } => *core,
            How::Listed(ranks) => small(ranks.iter().filter(|rank| **rank == 0).count()),
        }
    }

    /// The rank of each robot, where robots start at `positions_m`, reach `radius_m` and must count on so many as `keeps` says.
    ///
    /// The core is the m robots nearest to the middle of the team, if each of them is in range of enough of the others, or else
    /// the first robot, from the middle outwards, with its m − 1 nearest.
    pub fn choose<const D: usize>(
        &self,
        positions_m: &[Vector<D>],
        radius_m: f64,
        keeps: Keeps,
    ) -> Result<Vec<u16>, RanksError> {
        let (core, robots) = (self.core(), small(positions_m.len()));
        if let How::Listed(ranks) = &self.how
            && ranks.len() != positions_m.len()
        {
            return Err(RanksError::Count { found: ranks.len(), robots });
        }
        if keeps.core >= usize::from(core) || core > robots {
            return Err(RanksError::Core { core, keep: keeps.core });
        }
        match &self.how {
            How::Listed(ranks) => listed(ranks, keeps),
            How::Own { .. } => Start::new(positions_m, radius_m).own(core, keeps),
            How::Layers { .. } => Start::new(positions_m, radius_m).layers(core, keeps),
        }
    }
}

/// A list, if everybody in it has enough robots of lower ranks in the team.
fn listed(ranks: &[u16], keeps: Keeps) -> Result<Vec<u16>, RanksError> {
    let mut sorted = ranks.to_vec();
    sorted.sort_unstable();
    let short = |rank: u16| rank > 0 && sorted.partition_point(|other| *other < rank) < keeps.above;
    refuse(ranks.iter().map(|rank| short(*rank)), keeps)?;
    Ok(ranks.to_vec())
}

/// Refuses robots that are short of others.
fn refuse(short: impl Iterator<Item = bool>, keeps: Keeps) -> Result<(), RanksError> {
    let short: Vec<usize> = short.enumerate().filter(|(_, short)| *short).map(|(robot, _)| robot).collect();
    match short.as_slice() {
        [] => Ok(()),
        [first, others @ ..] => {
            Err(RanksError::Short { robot: small(first + 1), others: others.len(), keep: keeps.above })
        }
    }
}

fn small(number: usize) -> u16 {
    u16::try_from(number).unwrap_or(u16::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::squared_distance;
    use crate::scenario::start;

    const KEEPS: Keeps = Keeps { core: 5, above: 5 };

    fn hexagon(robots: u16) -> Vec<Vector<2>> {
        start::Start::Hexagon { spacing_m: 0.6 }.positions(robots, 1).unwrap()
    }

    fn ranks(how: How, positions_m: &[Vector<2>], radius_m: f64) -> Result<Vec<u16>, RanksError> {
        Ranking { how, listen: Listen::All }.choose(positions_m, radius_m, KEEPS)
    }

    /// True if everybody has enough in range that count.
    fn suffice(ranks: &[u16], positions_m: &[Vector<2>], radius_m: f64) -> bool {
        (0..ranks.len()).all(|robot| {
            let counted = (0..ranks.len()).filter(|&other| {
                let counts = ranks[other] < ranks[robot] || ranks[robot] + ranks[other] == 0;
                let distance_m2 = squared_distance(&positions_m[robot], &positions_m[other]);
                other != robot && counts && distance_m2 <= radius_m * radius_m
            });
            counted.count() >= 5
        })
    }

    #[test]
    fn chosen_ranks_give_everybody_enough_in_range() {
        for robots in [7, 8, 40, 129, 500] {
            let positions_m = hexagon(robots);
            let own = ranks(How::Own { core: 7 }, &positions_m, 1.5).unwrap();
            let layers = ranks(How::Layers { core: 7 }, &positions_m, 1.5).unwrap();
            let mut sorted = own.clone();
            sorted.sort_unstable();
            assert!(sorted[7..].iter().copied().eq(1..=robots - 7), "each has a rank of its own");
            assert!(suffice(&own, &positions_m, 1.5) && suffice(&layers, &positions_m, 1.5));
            assert!(layers.iter().max() <= own.iter().max());
        }
    }

    #[test]
    fn a_ring_has_its_core_on_the_ring() {
        // A square ring, 15 robots a side.
        let ring: Vec<Vector<2>> = (0..60_u8)
            .map(|k| {
                let along = -5.0 + 10.0 * f64::from(k % 15) / 15.0;
                [[along, -5.0], [5.0, along], [-along, 5.0], [-5.0, -along]][usize::from(k / 15)]
            })
            .collect();
        let own = ranks(How::Own { core: 7 }, &ring, 4.0).unwrap();
        assert!(suffice(&own, &ring, 4.0));
    }

    #[test]
    fn what_cannot_be_is_refused_by_name() {
        let mut positions_m = hexagon(20);
        let core = ranks(How::Own { core: 5 }, &positions_m, 1.5).unwrap_err();
        assert_eq!(core, RanksError::Core { core: 5, keep: 5 });
        let sparse = ranks(How::Own { core: 7 }, &positions_m, 0.5).unwrap_err();
        assert_eq!(sparse, RanksError::NoCore { core: 7, keep: 5 });
        positions_m[12] = [9.0, 0.0];
        for how in [How::Own { core: 7 }, How::Layers { core: 7 }] {
            let short = ranks(how, &positions_m, 1.5).unwrap_err();
            assert_eq!(short.to_string(), "robot 13, which can never have 5 neighbours of lower ranks");
        }
        let mut list = vec![0; 7];
        list.extend([2; 13]);
        assert!(ranks(How::Listed(list.clone()), &positions_m, 1.5).is_ok());
        list.pop();
        assert!(matches!(
            ranks(How::Listed(list), &positions_m, 1.5),
            Err(RanksError::Count { found: 19, robots: 20 })
        ));
    }

    #[test]
    fn a_listed_robot_needs_enough_below_it_in_the_team() {
        let keeps = Keeps { core: 3, above: 5 };
        let ranking = Ranking { how: How::Listed(vec![0, 0, 0, 0, 1, 2, 2]), listen: Listen::All };
        let error = ranking.choose(&hexagon(7), 9.0, keeps).unwrap_err();
        assert_eq!(error, RanksError::Short { robot: 5, others: 0, keep: 5 });
    }
}
