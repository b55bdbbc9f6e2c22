//! What all robots of many worlds hold of each other, pair by pair: each number of a pair side by side.

use core::ops::Range;

use closeranks_core::controller::links::bond::{Bond, Deal, Look};
use closeranks_core::controller::links::lanes::{EndInLanes, LookInLanes, PairInLanes, SaidInLanes};
use closeranks_core::num::lane::is_so;

/// What robots hold of each other.
#[derive(Clone, Debug)]
pub(super) struct Table {
    robots: usize,
    /// Second end after second end.
    pub(super) pairs: Vec<PairInLanes>,
    /// Robot after robot, those that each has in order of numbers.
    pub(super) ends: Vec<EndInLanes>,
    /// What each said to each when it spoke last, and what it is about to say.
    pub(super) said: Vec<SaidInLanes>,
    pub(super) says: Vec<SaidInLanes>,
}

impl Table {
    /// Of a team of so many robots of whom nobody holds anything.
    pub(super) fn new(robots: usize) -> Self {
        let ends = robots * robots.saturating_sub(1);
        Self {
            robots,
            pairs: vec![PairInLanes::NONE; ends / 2],
            ends: vec![EndInLanes::NONE; ends],
            said: vec![SaidInLanes::NOTHING; ends],
            says: vec![SaidInLanes::NOTHING; ends],
        }
    }

    /// Which pair two robots are.
    pub(super) fn pair(robot: usize, other: usize) -> usize {
        let (first, second) = if robot < other { (robot, other) } else { (other, robot) };
        second * (second - 1) / 2 + first
    }

    /// Where stands what a robot holds of another one, and says to it.
    pub(super) fn place(&self, [robot, other]: [usize; 2]) -> usize {
        self.room(robot).start + other - usize::from(other > robot)
    }

    /// Where stands what a robot holds of all others.
    pub(super) fn room(&self, robot: usize) -> Range<usize> {
        robot * (self.robots - 1)..(robot + 1) * (self.robots - 1)
    }

    /// True if two robots of one world sense each other.
    pub(super) fn is_sensed(&self, [robot, other]: [usize; 2], lane: usize) -> bool {
        is_so(self.pairs[Self::pair(robot, other)].sensed[lane])
    }

    /// What a robot of one world holds of another one between two ticks.
    pub(super) fn held(&self, [robot, other]: [usize; 2], lane: usize) -> (Bond, Deal) {
        let [own, to] = [[robot, other], [other, robot]].map(|ends| self.place(ends));
        self.ends[own].of(lane, self.born([robot, other], lane), [&self.said[own], &self.said[to]])
    }

    /// The same once a robot has made its promises, from which everything follows that a `look` came to.
    pub(super) fn line(
        &self,
        [robot, other]: [usize; 2],
        lane: usize,
        look: &LookInLanes,
    ) -> (Bond, Deal, Look) {
        let [own, to] = [[robot, other], [other, robot]].map(|ends| self.place(ends));
        let said = [&self.says[own], &self.said[to]];
        self.ends[own].line(lane, self.born([robot, other], lane), said, look)
    }

    fn born(&self, [robot, other]: [usize; 2], lane: usize) -> f64 {
        self.pairs[Self::pair(robot, other)].born[lane]
    }

    /// Takes what robots of one world hold of those whom they sense. False if two robots do not hold each other since the same tick, or have not
    /// heard what the other said.
    pub(super) fn fetch<'a>(
        &mut self,
        lane: usize,
        lines: impl Iterator<Item = ([usize; 2], &'a Bond, &'a Deal)> + Clone,
    ) -> bool {
        self.clear(lane);
        for (ends, bond, deal) in lines.clone() {
            let (place, pair) = (self.place(ends), &mut self.pairs[Self::pair(ends[0], ends[1])]);
            (pair.sensed[lane], pair.born[lane]) = (1.0, f64::from(bond.born()));
            self.ends[place].put(lane, bond, deal);
            self.said[place].put(lane, bond.said());
        }
        lines.into_iter().all(|([robot, other], bond, _)| {
            let heard = self.said[self.place([other, robot])].of(lane) == bond.heard();
            heard && self.born([robot, other], lane) == f64::from(bond.born())
        })
    }

    /// Nobody of one world holds anything.
    fn clear(&mut self, lane: usize) {
        for pair in &mut self.pairs {
            pair.sensed[lane] = 0.0;
        }
        for end in &mut self.ends {
            end.clear(lane);
        }
        for said in &mut self.said {
            said.clear(lane);
        }
    }
}

/// All other robots of a team of so many, each with where stands what `robot` holds of it.
pub(super) fn others(robot: usize, robots: usize) -> impl Iterator<Item = (usize, usize)> {
    let numbers = (0..robots).filter(move |other| *other != robot);
    (robot * (robots - 1)..).zip(numbers)
}
