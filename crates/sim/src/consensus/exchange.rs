//! Rounds of consensus that the world holds for its robots: the engine says who has whose message, and what it says is held here.

use closeranks_core::num::Vector;

use super::safe_point::safe_point;
use super::{Combine, Consensus, Told, Update};
use crate::attack::value::ValueLiar;
use crate::engine::robots::Robots;
use crate::frame::Frame;
use crate::geometry::around::Around;
use crate::random::{Random, Stream};
use crate::scenario::Scenario;

/// Values of a team, and what was told of them in the round that is on.
#[derive(Debug)]
pub(crate) struct Exchange {
    combine: Combine,
    faults: u16,
    ticks_per_round: u32,
    tick_s: f64,
    radius_m: f64,
    malicious: Vec<bool>,
    /// One a number of the values.
    coordinates: Vec<Coordinate>,
    /// Draws what is told to one neighbour alone.
    faces: Random,
    /// Whose messages of this round each robot has, ascending.
    senders: Vec<Vec<u16>>,
    around: Around,
}

/// One number of the values of all robots.
#[derive(Debug)]
struct Coordinate {
    rule: Box<dyn Update>,
    liar: ValueLiar,
    start: Vec<f64>,
    held: Vec<f64>,
    told: Vec<f64>,
    /// What each robot was told, by whom.
    heard: Vec<Vec<(u16, f64)>>,
    next: Vec<f64>,
}

impl Coordinate {
    fn new(scenario: &Scenario, place: usize, values: &[f64]) -> Self {
        let consensus = &scenario.consensus;
        let mut rule = consensus.rule.update(consensus, values.len());
        let mut held = values.to_vec();
        rule.begin(&mut held);
        // The lies of the first number are those that are told where values have one.
        let seed = scenario.seed ^ ((place as u64) << 56);
        Self {
            rule,
            liar: ValueLiar::new(scenario.attack.value, seed, values.len()),
            start: held.clone(),
            told: held.clone(),
            next: held.clone(),
            held,
            heard: vec![Vec::new(); values.len()],
        }
    }

    /// Notes what each robot was told by those whose messages it has.
    fn listen(&mut self, senders: &[Vec<u16>], malicious: &[bool], faces: &mut Random) {
        for ((heard, senders), own) in self.heard.iter_mut().zip(senders).zip(&self.held) {
            heard.clear();
            for &sender in senders {
                let told = self.told[usize::from(sender)];
                let told = if malicious[usize::from(sender)] {
                    self.liar.to_one(told, *own, faces)
                } else {
                    Some(told)
                };
                heard.extend(told.map(|told| (sender, told)));
            }
        }
    }
}

impl Exchange {
    /// For the robots of `scenario` with initial `values`, one list a number of them; none if the robots of the core do it all.
    pub(crate) fn new(scenario: &Scenario, values: &[Vec<f64>]) -> Option<Self> {
        let Consensus { combine, .. } = scenario.consensus;
        if scenario.consensus.is_of_robots() {
            return None;
        }
        let coordinate = |(place, values): (usize, &Vec<f64>)| Coordinate::new(scenario, place, values);
        Some(Self {
            combine,
            faults: scenario.team.faults,
            ticks_per_round: scenario.ticks_per_round(),
            tick_s: scenario.tick_s(),
            radius_m: scenario.link.radius_m,
            malicious: scenario.malicious_mask(),
            coordinates: values.iter().enumerate().map(coordinate).collect(),
            faces: Random::new(scenario.seed, Stream::Faces),
            senders: vec![Vec::new(); usize::from(scenario.team.robots)],
            around: Around::default(),
        })
    }

    /// After the robots ticked: values are updated and told at the beginning of a round, and messages are noted until the next. Fills
    /// `values` and `held` of `frame`, and the same of further numbers.
    pub(crate) fn step<const D: usize>(
        &mut self,
        tick: u32,
        frame: &mut Frame<D>,
        robots: &dyn Robots<D>,
        given: Option<&[f64]>,
    ) {
        self.restart(&frame.down, robots);
        let begins = tick.is_multiple_of(self.ticks_per_round);
        if begins {
            if tick > 0 {
                self.end_round(&frame.down);
            }
            self.begin_round(tick, given);
        }
        self.note(&frame.positions_m, &frame.down, robots, begins);
        self.show(frame);
        self.flow(&frame.down);
    }

    /// Robots that begin anew hold what they started with.
    fn restart<const D: usize>(&mut self, down: &[bool], robots: &dyn Robots<D>) {
        let Some(edges) = robots.edges() else { return };
        for robot in (0..down.len()).filter(|robot| edges.downtime.reborn(*robot)) {
            for coordinate in &mut self.coordinates {
                coordinate.held[robot] = coordinate.start[robot];
                coordinate.rule.forget(robot);
            }
        }
    }

    fn begin_round(&mut self, tick: u32, given: Option<&[f64]>) {
        self.senders.iter_mut().for_each(Vec::clear);
        let time_s = f64::from(tick) * self.tick_s;
        for (place, coordinate) in self.coordinates.iter_mut().enumerate() {
            let Coordinate { liar, held, told, .. } = coordinate;
            liar.begin_round(tick, time_s, held.iter().copied(), &self.malicious);
            for (robot, told) in told.iter_mut().enumerate() {
                *told = match given.filter(|_| place == 0) {
                    _ if !self.malicious[robot] => held[robot],
                    Some(given) => given[robot],
                    None => liar.value(robot, held[robot]),
                };
            }
        }
    }

    /// Notes whose messages have come by now. In a perfect network these are those within R when values are told, and of them, for rules of
    /// continuous time, who has stayed there.
    fn note<const D: usize>(
        &mut self,
        positions_m: &[Vector<D>],
        down: &[bool],
        robots: &dyn Robots<D>,
        begins: bool,
    ) {
        let continuous = self.is_continuous();
        let (mut looked, mut heard) = (false, Vec::new());
        for robot in (0..down.len()).filter(|robot| !down[*robot]) {
            heard.clear();
            if robots.heard(robot, &mut heard) {
                let senders = &mut self.senders[robot];
                if continuous {
                    senders.clear();
                }
                senders.append(&mut heard);
                senders.sort_unstable();
                senders.dedup();
            } else if begins || continuous {
                if !core::mem::replace(&mut looked, true) {
                    self.around.look(positions_m, self.radius_m);
                }
                let (senders, around) = (&mut self.senders[robot], self.around.of(robot));
                if begins {
                    senders.extend(around);
                } else {
                    senders.retain(|sender| around.binary_search(sender).is_ok());
                }
            }
        }
    }

    fn is_continuous(&self) -> bool {
        self.combine == Combine::Coordinates && self.coordinates.iter().any(|one| one.rule.is_continuous())
    }

    fn end_round(&mut self, down: &[bool]) {
        if !self.is_continuous() {
            self.update(down, f64::from(self.ticks_per_round) * self.tick_s);
        }
    }

    /// Rules of continuous time go on by a tick: normal robots tell what they hold, liars what they chose for the round.
    fn flow(&mut self, down: &[bool]) {
        if !self.is_continuous() {
            return;
        }
        self.update(down, self.tick_s);
        for Coordinate { held, told, .. } in &mut self.coordinates {
            for (robot, told) in told.iter_mut().enumerate().filter(|(robot, _)| !self.malicious[*robot]) {
                *told = held[robot];
            }
        }
    }

    fn update(&mut self, down: &[bool], elapsed_s: f64) {
        for coordinate in &mut self.coordinates {
            coordinate.listen(&self.senders, &self.malicious, &mut self.faces);
            let Coordinate { rule, held, heard, next, .. } = coordinate;
            let (faults, malicious) = (self.faults, &self.malicious[..]);
            if self.combine == Combine::Coordinates {
                rule.update(&Told { faults, own: held, heard, malicious, elapsed_s }, next);
            }
        }
        if self.combine == Combine::SafePoint {
            self.combine();
        }
        for Coordinate { held, next, .. } in &mut self.coordinates {
            let runs = held.iter_mut().zip(next).zip(down).filter(|(_, down)| !**down);
            runs.for_each(|((held, next), _)| *held = *next);
        }
    }

    /// Half of the way to the safe point, where there is one; who hears too few keeps its value.
    fn combine(&mut self) {
        let [x, y] = &mut self.coordinates[..] else { return };
        let mut points = Vec::new();
        for robot in 0..x.held.len() {
            let own = [x.held[robot], y.held[robot]];
            points.clear();
            points.push(own);
            points.extend(x.heard[robot].iter().zip(&y.heard[robot]).map(|((_, x), (_, y))| [*x, *y]));
            let safe = safe_point(&points, usize::from(self.faults)).unwrap_or(own);
            [x.next[robot], y.next[robot]] = [0, 1].map(|d| 0.5 * own[d] + 0.5 * safe[d]);
        }
    }

    fn show<const D: usize>(&self, frame: &mut Frame<D>) {
        let Some((first, more)) = self.coordinates.split_first() else { return };
        frame.values.clone_from(&first.told);
        frame.held.clone_from(&first.held);
        frame.more_values = more.iter().map(|one| one.told.clone()).collect();
        frame.more_held = more.iter().map(|one| one.held.clone()).collect();
    }
}
