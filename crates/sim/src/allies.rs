//! All robots of a tick under `budget` at once: the same numbers as [`crate::robots`], bit for bit.
//!
//! In a perfect world nobody senses anything that another does not. So weights and the bounds of their derivatives belong to a
//! pair and are computed once for both ends, and whoever sees everybody knows the same of each. Whoever does not sums up
//! the weights between those it sees. Rows and answers are made by the functions of [`closeranks_core`] that a robot uses.

use closeranks_core::barrier::degree_barrier;
use closeranks_core::budget::knowledge::{Claim, Known};
use closeranks_core::budget::row::Row;
use closeranks_core::budget::survey::Seen;
use closeranks_core::budget::tie::{Knowledge, Neighbor, Tie};
use closeranks_core::composed::Sum;
use closeranks_core::math::{Vector, dot, subtract};
use closeranks_core::params::Params;

use crate::consensus::Consensus;
use crate::frame::Frame;
use crate::liars::Liars;
use crate::scenario::Scenario;

/// Positions are rounded to far less than what a robot takes for a jump as long as they are nearer to 0 than this, m.
const NEAR_M: f64 = 1e5;
/// In place of a weight: no link.
const NO_LINK: f64 = -1.0;

/// Scratch and state of a team of `budget` in a perfect world.
#[derive(Clone, Debug)]
pub struct Allies<const D: usize> {
    params: Params<D>,
    tick: u32,
    consensus: Consensus,
    /// Weight of every robot with every other, line after line, and its tie with those of higher numbers.
    weights: Vec<f64>,
    ties: Vec<Tie>,
    /// Behind φ_i.
    terms: Vec<f64>,
    sums: Vec<Sum<0, f64>>,
    claims: Vec<Option<Claim>>,
    /// What those know of each robot who see everybody.
    knowns: Vec<Known>,
    /// What another sees of each robot: the sum of its weights and their number.
    lows: Vec<f64>,
    degrees: Vec<f64>,
    rows: Vec<Row<D>>,
}

impl<const D: usize> Allies<D> {
    /// The team of `scenario`, which must be plain, at `positions_m` with initial `values`; `None` if its robots must be computed one
    /// by one: with margins or free liars, and so far from 0 that rounding looks to a robot like a jump.
    #[must_use]
    pub fn new(
        scenario: &Scenario,
        params: Params<D>,
        positions_m: &[Vector<D>],
        values: &[f64],
    ) -> Option<Self> {
        let robots = values.len();
        let way_m = f64::from(scenario.ticks()) * params.reach().longest_m();
        let near = |x: &f64| x.abs() + way_m < NEAR_M;
        if !params.budget().is_plain() || !positions_m.iter().flatten().all(near) {
            return None;
        }
        let nobody = Tie { distance_m2: 0.0, distance_m: 0.0, slope: 0.0, bend: 0.0, wrong: 0.0 };
        let nothing = Known { budget: 0.0, deficit: 0.0, degree_max: 1.0 };
        Some(Self {
            params,
            tick: 0,
            consensus: Consensus::new(scenario, values),
            weights: vec![NO_LINK; robots * robots],
            ties: vec![nobody; robots * robots],
            terms: vec![0.0; robots],
            sums: vec![Sum::new(0.0); robots],
            claims: vec![None; robots],
            knowns: vec![nothing; robots],
            lows: vec![0.0; robots],
            degrees: vec![0.0; robots],
            rows: vec![Row::default(); 2 * D + 2 * robots + 1],
        })
    }

    /// One tick: fills everything in `frame` but positions and desired velocities.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        self.find_pairs(frame);
        liars.begin_tick(self.tick);
        self.tell(frame, liars);
        if self.consensus.is_due(self.tick) {
            let (weights, robots) = (&self.weights, frame.values.len());
            self.consensus.hold(frame, liars, |robot, other| weights[robot * robots + other] >= 0.0);
        }
        if frame.wants_phi {
            self.sum_phis(frame);
        }
        for robot in 0..frame.positions_m.len() {
            self.control(robot, frame);
        }
        self.tick = self.tick.saturating_add(1);
    }

    pub(crate) fn tick_s(&self) -> f64 {
        self.params.settings().level_period.as_secs_f64()
    }

    /// Weights, ties, degrees and levels.
    //= paper eq:connectivity
    fn find_pairs(&mut self, frame: &mut Frame<D>) {
        frame.levels.fill(0.0);
        frame.degrees.fill(0);
        frame.links = 0;
        for first in 0..frame.positions_m.len() {
            self.find_links(first, frame);
        }
    }

    /// Links of `first` to robots of higher numbers.
    fn find_links(&mut self, first: usize, frame: &mut Frame<D>) {
        let (robots, after, position) = (self.claims.len(), first + 1, frame.positions_m[first]);
        let (mut level, mut degree) = (frame.levels[first], frame.degrees[first]);
        let others = frame.levels[after..].iter_mut().zip(&mut frame.degrees[after..]);
        let others = frame.positions_m[after..].iter().zip(others).zip(after..);
        let ties = &mut self.ties[first * robots..after * robots];
        for ((other, (other_level, other_degree)), second) in others {
            let offset_m = subtract(&position, other);
            let distance_m2 = dot(&offset_m, &offset_m);
            let link = self.params.link().link_at::<f64>(distance_m2);
            let weight = link.map_or(NO_LINK, |link| link.weight);
            self.weights[first * robots + second] = weight;
            self.weights[second * robots + first] = weight;
            let Some(link) = link else { continue };
            ties[second] = self.params.budget().tie(distance_m2, link.slope);
            level += weight;
            *other_level += weight;
            degree += 1;
            *other_degree += 1;
        }
        frame.links += u32::from(degree - frame.degrees[first]);
        (frame.levels[first], frame.degrees[first]) = (level, degree);
    }

    /// Levels, as they are and as they are told, and what comes of them for who sees everybody.
    fn tell(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        let (settings, budget) = (self.params.settings(), self.params.budget());
        for (robot, level) in frame.levels.iter().enumerate() {
            frame.spares[robot] = degree_barrier(*level, budget.required());
            frame.told[robot] = liars.level(robot, *level);
            let claim = settings.claim(frame.told[robot], settings.clock_error);
            let seen = Seen { low: *level, degree: f64::from(frame.degrees[robot]), unseen: 0, claim };
            self.claims[robot] = claim;
            self.knowns[robot] = budget.known_from(&seen, 0.0);
        }
    }

    /// φ_i, which nothing depends on but records and monitors.
    fn sum_phis(&mut self, frame: &mut Frame<D>) {
        let (robots, composed) = (frame.told.len(), *self.params.composed());
        for ((sum, term), told) in self.sums.iter_mut().zip(&mut self.terms).zip(&frame.told) {
            *term = composed.degree_term(*told);
            *sum = Sum::new(*term);
        }
        for first in 0..robots {
            let mut own = self.sums[first];
            for second in first + 1..robots {
                let tie = &self.ties[first * robots + second];
                if self.weights[first * robots + second] < 0.0 {
                    continue;
                }
                let collision = composed.collision_term(tie.distance_m2);
                own.add_told(composed.shared(self.terms[second]));
                own.add_link(&[], 0.0, collision);
                let other = &mut self.sums[second];
                other.add_told(composed.shared(self.terms[first]));
                other.add_link(&[], 0.0, collision);
            }
            self.sums[first] = own;
        }
        for robot in 0..robots {
            let phi = self.sums[robot].phi(&composed);
            frame.phis[robot] = if phi.is_finite() { phi } else { self.careful_phi(robot, frame) };
        }
    }

    /// φ_i of a robot whose plain sums overflowed.
    fn careful_phi(&self, robot: usize, frame: &Frame<D>) -> f64 {
        let robots = frame.told.len();
        let linked = || (0..robots).filter(|other| self.linked(robot, *other));
        let levels = linked().map(|other| frame.told[other]);
        let distances_m2 =
            linked().map(|other| self.ties[robot.min(other) * robots + robot.max(other)].distance_m2);
        self.params.composed().phi(frame.told[robot], levels.clone(), distances_m2.clone())
    }

    fn linked(&self, robot: usize, other: usize) -> bool {
        self.weights[robot * self.claims.len() + other] >= 0.0
    }

    /// Rows and answer of one robot.
    fn control(&mut self, robot: usize, frame: &mut Frame<D>) {
        let (params, robots) = (self.params, self.claims.len());
        let (degree, position) = (frame.degrees[robot], frame.positions_m[robot]);
        let unseen = robots - 1 - usize::from(degree);
        if unseen > 0 {
            self.look_around(robot);
        }
        let mut rows = core::mem::take(&mut self.rows);
        let neighbors = (0..robots).filter(|other| self.linked(robot, *other)).map(|other| Neighbor {
            offset_m: subtract(&position, &frame.positions_m[other]),
            tie: &self.ties[robot.min(other) * robots + robot.max(other)],
            knowledge: self.knowledge(other, unseen),
        });
        let desired_m = params.desired_m(&frame.desired_m_s[robot]);
        let own = (frame.levels[robot], degree);
        let mut program =
            params.budget().rows_between(own, neighbors, &desired_m, *params.reach(), &mut rows);
        let answer = params.answer(&mut program);
        self.rows = rows;
        frame.velocities_m_s[robot] = answer.velocity_m_s;
        frame.outcomes[robot] = answer.outcome;
        frame.modes[robot] = params.mode(answer.doubt, degree, frame.spares[robot]);
    }

    /// What a robot knows of `other` that does not see so many.
    fn knowledge(&self, other: usize, unseen: usize) -> Knowledge<'_> {
        if unseen == 0 {
            return Knowledge::Known(&self.knowns[other]);
        }
        let degree = self.degrees[other] + u32::try_from(unseen).map_or(f64::MAX, f64::from);
        Knowledge::Seen(Seen { low: self.lows[other], degree, unseen, claim: self.claims[other] })
    }

    /// What `robot` sees of the links of each other one: sums over the robots that it sees, in order of their numbers.
    fn look_around(&mut self, robot: usize) {
        let robots = self.claims.len();
        self.lows.fill(0.0);
        self.degrees.fill(0.0);
        for other in 0..robots {
            if other != robot && !self.linked(robot, other) {
                continue;
            }
            let line = &self.weights[other * robots..(other + 1) * robots];
            for ((low, degree), weight) in self.lows.iter_mut().zip(&mut self.degrees).zip(line) {
                *low += weight.max(0.0);
                *degree += if *weight >= 0.0 { 1.0 } else { 0.0 };
            }
        }
    }
}
