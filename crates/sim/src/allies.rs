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
use closeranks_core::math::{Vector, add_scaled, dot, subtract};
use closeranks_core::params::Params;

use crate::consensus::Consensus;
use crate::frame::Frame;
use crate::liars::Liars;
use crate::scenario::Scenario;

/// Positions are rounded to far less than what a robot takes for a jump as long as they are nearer to 0 than this, m.
const NEAR_M: f64 = 1e5;
/// In place of a weight: no link. Sums do not notice.
const NO_LINK: f64 = -0.0;
/// Weights that are summed at a time.
const LANES: usize = 4;

/// Scratch and state of a team of `budget` in a perfect world.
#[derive(Clone, Debug)]
pub struct Allies<const D: usize> {
    params: Params<D>,
    tick: u32,
    consensus: Consensus,
    /// Weight of every robot with every other, in lines of so many blocks, and its tie with those of higher numbers.
    weights: Vec<[f64; LANES]>,
    blocks: usize,
    ties: Vec<Tie>,
    /// Behind φ_i.
    terms: Vec<f64>,
    sums: Vec<Sum<0, f64>>,
    claims: Vec<Option<Claim>>,
    /// What those know of each robot who see everybody.
    knowns: Vec<Known>,
    /// Whom a robot sees, itself among them, whom not, and what it sees of the level of each.
    seen: Vec<usize>,
    unseen: Vec<usize>,
    lows: Vec<[f64; LANES]>,
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
        let blocks = robots.div_ceil(LANES);
        let nobody = Tie { distance_m2: 0.0, distance_m: 0.0, slope: 0.0, bend: 0.0, wrong: 0.0 };
        let nothing = Known { budget: 0.0, deficit: 0.0, degree_max: 1.0 };
        Some(Self {
            params,
            tick: 0,
            consensus: Consensus::new(scenario, values),
            weights: vec![[NO_LINK; LANES]; robots * blocks],
            blocks,
            ties: vec![nobody; robots * robots],
            terms: vec![0.0; robots],
            sums: vec![Sum::new(0.0); robots],
            claims: vec![None; robots],
            knowns: vec![nothing; robots],
            seen: Vec::new(),
            unseen: Vec::new(),
            lows: vec![[0.0; LANES]; blocks],
            rows: vec![Row::default(); 2 * D + 2 * robots + 1],
        })
    }

    /// One tick: fills everything in `frame` but positions and desired velocities.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        self.find_pairs(frame);
        liars.begin_tick(self.tick);
        self.tell(frame, liars);
        if self.consensus.is_due(self.tick) {
            let (weights, blocks) = (&self.weights, self.blocks);
            self.consensus.hold(frame, liars, |robot, other| linked(weights, blocks, robot, other));
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
        let blocks = self.blocks;
        let (mut level, mut degree) = (frame.levels[first], frame.degrees[first]);
        let others = frame.levels[after..].iter_mut().zip(&mut frame.degrees[after..]);
        let others = frame.positions_m[after..].iter().zip(others).zip(after..);
        let ties = &mut self.ties[first * robots..after * robots];
        for ((other, (other_level, other_degree)), second) in others {
            let offset_m = subtract(&position, other);
            let distance_m2 = dot(&offset_m, &offset_m);
            let link = self.params.link().link_at::<f64>(distance_m2);
            let weight = link.map_or(NO_LINK, |link| link.weight);
            self.weights[first * blocks + second / LANES][second % LANES] = weight;
            self.weights[second * blocks + first / LANES][first % LANES] = weight;
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
                if !self.linked(first, second) {
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
        let distances_m2 = linked().map(|other| self.tie(robot, other).distance_m2);
        self.params.composed().phi(frame.told[robot], levels.clone(), distances_m2.clone())
    }

    fn linked(&self, robot: usize, other: usize) -> bool {
        linked(&self.weights, self.blocks, robot, other)
    }

    fn tie(&self, robot: usize, other: usize) -> &Tie {
        &self.ties[robot.min(other) * self.claims.len() + robot.max(other)]
    }

    /// Rows and answer of one robot.
    fn control(&mut self, robot: usize, frame: &mut Frame<D>) {
        self.look_around(robot);
        let mut rows = core::mem::take(&mut self.rows);
        let (params, position) = (&self.params, frame.positions_m[robot]);
        let others = self.seen.iter().filter(|other| **other != robot);
        let neighbors = others.map(|other| Neighbor {
            offset_m: subtract(&position, &frame.positions_m[*other]),
            tie: self.tie(robot, *other),
            knowledge: self.knowledge(*other, frame),
        });
        let desired_m = params.desired_m(&frame.desired_m_s[robot]);
        let degree = frame.degrees[robot];
        let own = (frame.levels[robot], degree);
        let mut program =
            params.budget().rows_between(own, neighbors, &desired_m, *params.reach(), &mut rows);
        let answer = params.answer(&mut program, &frame.velocities_m_s[robot]);
        frame.velocities_m_s[robot] = answer.velocity_m_s;
        frame.outcomes[robot] = answer.outcome;
        frame.modes[robot] = params.mode(answer.doubt, degree, frame.spares[robot]);
        self.rows = rows;
    }

    /// What the robot that looked around knows of `other`.
    fn knowledge(&self, other: usize, frame: &Frame<D>) -> Knowledge<'_> {
        let unseen = self.unseen.len();
        if unseen == 0 {
            return Knowledge::Known(&self.knowns[other]);
        }
        let (low, degree) = (self.lows[other / LANES][other % LANES], usize::from(frame.degrees[other]));
        let missed = self.unseen.iter().filter(|unseen| self.linked(other, **unseen)).count();
        let degree = u32::try_from(degree - missed + unseen).map_or(f64::MAX, f64::from);
        Knowledge::Seen(Seen { low, degree, unseen, claim: self.claims[other] })
    }

    /// Whom `robot` sees, and what of the level of each: sums over the robots that it sees, in order of their numbers.
    fn look_around(&mut self, robot: usize) {
        let line = &self.weights[robot * self.blocks..(robot + 1) * self.blocks];
        let robots = self.claims.len();
        self.seen.clear();
        self.unseen.clear();
        for (other, weight) in line.as_flattened()[..robots].iter().enumerate() {
            let sees = other == robot || weight.is_sign_positive();
            if sees { &mut self.seen } else { &mut self.unseen }.push(other);
        }
        if self.unseen.is_empty() {
            return;
        }
        for (block, lows) in self.lows.iter_mut().enumerate() {
            let mut sums = [0.0; LANES];
            for other in &self.seen {
                sums = add_scaled(&sums, 1.0, &self.weights[other * self.blocks + block]);
            }
            *lows = sums;
        }
    }
}

fn linked(weights: &[[f64; LANES]], blocks: usize, robot: usize, other: usize) -> bool {
    weights[robot * blocks + other / LANES][other % LANES].is_sign_positive()
}
