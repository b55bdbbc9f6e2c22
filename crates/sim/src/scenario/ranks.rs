//! Ranks of a team: listed, or chosen from where robots start.

use core::cmp::Ordering;
use std::collections::BinaryHeap;

use closeranks_core::need::Listen;
use closeranks_core::num::Vector;

use crate::geometry::near::Near;
use crate::geometry::squared_distance;

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

/// A start, with who is in range of whom.
struct Start {
    /// Squared distance of each robot from the middle, m².
    from_middle_m2: Vec<f64>,
    /// Robots from the middle outwards.
    outwards: Vec<usize>,
    /// Those in range of each robot, the nearest first.
    around: Vec<Vec<usize>>,
}

/// A robot that has enough others before it; the one nearest to the middle is the greatest.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ready {
    from_middle_m2: f64,
    robot: usize,
}

impl Eq for Ready {}

impl PartialOrd for Ready {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Ready {
    fn cmp(&self, other: &Self) -> Ordering {
        other.from_middle_m2.total_cmp(&self.from_middle_m2).then(other.robot.cmp(&self.robot))
    }
}

impl Start {
    fn new<const D: usize>(positions_m: &[Vector<D>], radius_m: f64) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "teams are far below 2^53")]
        let count = positions_m.len().max(1) as f64;
        let middle: Vector<D> =
            core::array::from_fn(|d| positions_m.iter().map(|x| x[d]).sum::<f64>() / count);
        let from_middle_m2: Vec<f64> = positions_m.iter().map(|x| squared_distance(x, &middle)).collect();
        let nearer = |one: &usize, other: &usize| {
            from_middle_m2[*one].total_cmp(&from_middle_m2[*other]).then(one.cmp(other))
        };
        let mut outwards: Vec<usize> = (0..positions_m.len()).collect();
        outwards.sort_unstable_by(nearer);
        let around = around(positions_m, radius_m);
        Self { from_middle_m2, outwards, around }
    }

    /// The robots of the core; all others are not.
    fn core(&self, core: u16, keeps: Keeps) -> Result<Vec<bool>, RanksError> {
        let count = usize::from(core);
        let near = |robot: &usize| {
            let others = self.around[*robot].iter().take(count - 1).copied();
            core::iter::once(*robot).chain(others).collect::<Vec<usize>>()
        };
        let middle = core::iter::once(self.outwards[..count].to_vec());
        let mut found = middle.chain(self.outwards.iter().map(near)).filter_map(|robots| {
            let mut is_core = vec![false; self.around.len()];
            for robot in &robots {
                is_core[*robot] = true;
            }
            let inside = |robot: &usize| self.around[*robot].iter().filter(|other| is_core[**other]).count();
            (robots.len() == count && robots.iter().all(|robot| inside(robot) >= keeps.core))
                .then_some(is_core)
        });
        found.next().ok_or(RanksError::NoCore { core, keep: keeps.core })
    }

    /// A rank of its own for each robot outside of the core: whoever is nearest to the middle of all who have enough
    /// earlier ones in range is next.
    fn own(&self, core: u16, keeps: Keeps) -> Result<Vec<u16>, RanksError> {
        let mut ranks = self.begin(core, keeps)?;
        let mut earlier = vec![0; ranks.len()];
        let mut ready = BinaryHeap::new();
        let mut take = |robot: usize, ranks: &[Option<u16>], ready: &mut BinaryHeap<Ready>| {
            for other in self.around[robot].iter().copied() {
                earlier[other] += 1;
                if earlier[other] == keeps.above && ranks[other].is_none() {
                    ready.push(Ready { from_middle_m2: self.from_middle_m2[other], robot: other });
                }
            }
        };
        for robot in (0..ranks.len()).filter(|robot| ranks[*robot].is_some()).collect::<Vec<_>>() {
            take(robot, &ranks, &mut ready);
        }
        let mut next = 1;
        while let Some(Ready { robot, .. }) = ready.pop() {
            ranks[robot] = Some(next);
            next += 1;
            take(robot, &ranks, &mut ready);
        }
        end(&ranks, keeps)
    }

    /// Rank after rank, all that have enough robots of lower ranks in range.
    fn layers(&self, core: u16, keeps: Keeps) -> Result<Vec<u16>, RanksError> {
        let mut ranks = self.begin(core, keeps)?;
        let mut earlier = vec![0; ranks.len()];
        let mut last: Vec<usize> = (0..ranks.len()).filter(|robot| ranks[*robot].is_some()).collect();
        for rank in 1..=u16::MAX {
            for other in last.iter().flat_map(|robot| &self.around[*robot]) {
                earlier[*other] += 1;
            }
            last = (0..ranks.len())
                .filter(|robot| ranks[*robot].is_none() && earlier[*robot] >= keeps.above)
                .collect();
            if last.is_empty() {
                break;
            }
            for robot in &last {
                ranks[*robot] = Some(rank);
            }
        }
        end(&ranks, keeps)
    }

    /// Rank 0 for the core, none for the others.
    fn begin(&self, core: u16, keeps: Keeps) -> Result<Vec<Option<u16>>, RanksError> {
        Ok(self.core(core, keeps)?.into_iter().map(|is_core| is_core.then_some(0)).collect())
    }
}

/// Who is in range of whom, the nearest first.
fn around<const D: usize>(positions_m: &[Vector<D>], radius_m: f64) -> Vec<Vec<usize>> {
    let mut near = Near::default();
    near.look(positions_m, radius_m);
    let mut around: Vec<Vec<(f64, usize)>> = vec![Vec::new(); positions_m.len()];
    for second in 0..positions_m.len() {
        let (firsts, distances_m2) = near.before(second, positions_m, radius_m);
        for (first, distance_m2) in firsts.iter().zip(distances_m2) {
            around[second].push((*distance_m2, usize::from(*first)));
            around[usize::from(*first)].push((*distance_m2, second));
        }
    }
    let sorted = around.into_iter().map(|mut others| {
        others.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        others.into_iter().map(|(_, other)| other).collect()
    });
    sorted.collect()
}

/// The ranks, if everybody has one.
fn end(ranks: &[Option<u16>], keeps: Keeps) -> Result<Vec<u16>, RanksError> {
    refuse(ranks.iter().map(Option::is_none), keeps)?;
    Ok(ranks.iter().flatten().copied().collect())
}

fn small(number: usize) -> u16 {
    u16::try_from(number).unwrap_or(u16::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
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
