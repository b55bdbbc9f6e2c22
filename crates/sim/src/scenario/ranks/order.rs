//! The order in which robots get their ranks, from where they start.

use core::cmp::Ordering;
use std::collections::BinaryHeap;

use closeranks_core::num::Vector;

use crate::geometry::near::Near;
use crate::geometry::squared_distance;
use crate::scenario::ranks::{Keeps, RanksError, refuse};

/// A start, with who is in range of whom.
pub(super) struct Start {
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
    pub(super) fn new<const D: usize>(positions_m: &[Vector<D>], radius_m: f64) -> Self {
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
    pub(super) fn own(&self, core: u16, keeps: Keeps) -> Result<Vec<u16>, RanksError> {
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
    pub(super) fn layers(&self, core: u16, keeps: Keeps) -> Result<Vec<u16>, RanksError> {
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
