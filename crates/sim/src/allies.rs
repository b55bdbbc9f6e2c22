//! All robots of a tick under `budget` at once: the same numbers as [`crate::robots`], bit for bit.
//!
//! In a perfect world nobody senses anything that another does not. So weights and the bounds of their derivatives belong to a
//! pair and are computed once for both ends, and whoever sees everybody knows the same of each. Whoever does not sums up
//! the weights between those it sees. Rows and answers are made by the functions of [`closeranks_core`] that a robot uses.

use closeranks_core::barrier::degree_barrier;
use closeranks_core::budget::knowledge::Known;
use closeranks_core::budget::row::Row;
use closeranks_core::budget::survey::Seen;
use closeranks_core::budget::tie::{Neighbor, Tie};
use closeranks_core::composed::Sum;
use closeranks_core::math::{Vector, add_scaled, sqrt, subtract};
use closeranks_core::params::Params;

use crate::consensus::Consensus;
use crate::frame::Frame;
use crate::liars::Liars;
use crate::scenario::Scenario;
use crate::truth::fill_pairs;

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
    /// Weight of every robot with every other, in lines of whole blocks, and its tie with those of higher numbers.
    weights: Vec<f64>,
    line: usize,
    ties: Vec<Tie>,
    /// Of pairs in the order of [`crate::truth::Truth::pairs_m2`] weights, slopes and κ.
    pairs: Vec<f64>,
    slopes: Vec<f64>,
    bends: Vec<f64>,
    /// Behind φ_i.
    terms: Vec<f64>,
    sums: Vec<Sum<0, f64>>,
    /// What the claims of all are worth.
    told: Vec<f64>,
    /// What those know of each robot who see everybody.
    knowns: Vec<Known>,
    /// Whom a robot sees, itself among them, whom not, and what it sees of the level of each.
    seen: Vec<usize>,
    unseen: Vec<usize>,
    lows: Vec<f64>,
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
        let line = robots.next_multiple_of(LANES);
        let nobody = Tie {
            distance_m2: 0.0,
            distance_m: 0.0,
            slope: 0.0,
            bend: 0.0,
            wrong: 0.0,
            most: 0.0,
            clear: false,
        };
        let nothing = Known { budget: 0.0, deficit: 0.0, degree_max: 1.0 };
        Some(Self {
            params,
            tick: 0,
            consensus: Consensus::new(scenario, values),
            weights: vec![NO_LINK; robots * line],
            line,
            ties: vec![nobody; robots * robots],
            pairs: Vec::new(),
            slopes: Vec::new(),
            bends: Vec::new(),
            terms: vec![0.0; robots],
            sums: vec![Sum::new(0.0); robots],
            told: vec![0.0; robots],
            knowns: vec![nothing; robots],
            seen: Vec::new(),
            unseen: Vec::new(),
            lows: vec![0.0; line],
            rows: vec![Row::default(); 2 * D + 2 * robots + 1],
        })
    }

    /// One tick: fills everything in `frame` but positions and desired velocities.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        self.find_pairs(frame);
        liars.begin_tick(self.tick);
        self.tell(frame, liars);
        if self.consensus.is_due(self.tick) {
            let (weights, line) = (&self.weights, self.line);
            self.consensus.hold(frame, liars, |robot, other| is_link(weights[robot * line + other]));
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
        fill_pairs(&frame.positions_m, &mut self.pairs);
        self.bends.clear();
        self.bends.extend(self.pairs.iter().map(|pair_m2| sqrt(*pair_m2)));
        self.params.budget().bends_max(&mut self.bends);
        self.slopes.resize(self.pairs.len(), 0.0);
        self.params.link().links_at(&mut self.pairs, &mut self.slopes);
        let mut pair = 0;
        for second in 0..frame.positions_m.len() {
            self.find_links(second, pair, frame);
            pair += second;
        }
    }

    /// Links of `second` to robots of lower numbers, the first of which is that `pair`.
    fn find_links(&mut self, second: usize, pair: usize, frame: &mut Frame<D>) {
        let (robots, line, params) = (self.told.len(), self.line, &self.params);
        let (weights, ties) = (&mut self.weights[..robots * line], &mut self.ties[..robots * robots]);
        let [pairs, slopes, bends] =
            [&self.pairs, &self.slopes, &self.bends].map(|of| &of[pair..pair + second]);
        let Frame { positions_m, levels, degrees, .. } = frame;
        let (positions_m, position) = (&positions_m[..second], positions_m[second]);
        let (levels, own_level) = levels[..=second].split_at_mut(second);
        let (degrees, own_degree) = degrees[..=second].split_at_mut(second);
        let (mut level, mut degree) = (0.0, 0);
        for first in 0..second {
            let weight = pairs[first];
            weights[first * line + second] = weight;
            weights[second * line + first] = weight;
            if !is_link(weight) {
                continue;
            }
            let offset_m = subtract(&positions_m[first], &position);
            let tie = params.budget().tie_with(&offset_m, slopes[first], bends[first], params.reach());
            ties[first * robots + second] = tie;
            ties[second * robots + first] = tie;
            level += weight;
            levels[first] += weight;
            degree += 1;
            degrees[first] += 1;
        }
        frame.links += u32::from(degree);
        (own_level[0], own_degree[0]) = (level, degree);
    }

    /// Levels, as they are and as they are told, and what comes of them for who sees everybody.
    fn tell(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        let (settings, budget) = (self.params.settings(), self.params.budget());
        for (robot, level) in frame.levels.iter().enumerate() {
            frame.spares[robot] = degree_barrier(*level, budget.required());
            frame.told[robot] = liars.level(robot, *level);
            self.told[robot] = budget.told(settings.claim(frame.told[robot], settings.clock_error));
            let degree = f64::from(frame.degrees[robot]);
            let seen = Seen { low: *level, degree, unseen: 0, told: self.told[robot] };
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
        is_link(self.weights[robot * self.line + other])
    }

    fn tie(&self, robot: usize, other: usize) -> &Tie {
        &self.ties[robot * self.told.len() + other]
    }

    /// Rows and answer of one robot.
    fn control(&mut self, robot: usize, frame: &mut Frame<D>) {
        self.look_around(robot);
        let mut rows = core::mem::take(&mut self.rows);
        let (params, position, robots) = (&self.params, frame.positions_m[robot], self.told.len());
        let links = self.weights[robot * self.line..].iter().zip(&self.ties[robot * robots..]);
        let others = links.zip(&frame.positions_m).enumerate();
        let neighbors = others.filter(|(_, ((weight, _), _))| is_link(**weight));
        let neighbors = neighbors.map(|(other, ((_, tie), x))| {
            let known = self.known(other, tie, frame.degrees[other]);
            Neighbor { offset_m: subtract(&position, x), tie, known }
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

    /// What the robot that looked around knows of `other`, which has so many neighbours.
    #[inline]
    fn known(&self, other: usize, tie: &Tie, degree: u16) -> Known {
        if self.unseen.is_empty() {
            return self.knowns[other];
        }
        let weights = &self.weights[other * self.line..];
        let beyond = self.unseen.iter().filter(|unseen| !is_link(weights[**unseen])).count();
        let (low, degree) = (self.lows[other], f64::from(degree) + number(beyond));
        let seen = Seen { low, degree, unseen: self.unseen.len(), told: self.told[other] };
        self.params.budget().known_from(&seen, tie.distance_m)
    }

    /// Whom `robot` does not see, and what it sees of the level of each: sums over the robots that it sees, in order of their
    /// numbers.
    fn look_around(&mut self, robot: usize) {
        let line = self.line;
        let weights = &self.weights[robot * line..][..self.told.len()];
        self.unseen.clear();
        let sees = |other: usize| other == robot || is_link(weights[other]);
        self.unseen.extend((0..weights.len()).filter(|other| !sees(*other)));
        if self.unseen.is_empty() {
            return;
        }
        self.seen.clear();
        self.seen.extend((0..weights.len()).filter(|other| sees(*other)));
        for (block, lows) in self.lows.as_chunks_mut().0.iter_mut().enumerate() {
            let weights = |other: &usize| self.weights[other * line + block * LANES..].first_chunk();
            let weights = self.seen.iter().filter_map(weights);
            *lows = weights.fold([0.0; LANES], |sums, weights| add_scaled(&sums, 1.0, weights));
        }
    }
}

/// A count as a number; exact, because no team has 2³² robots.
fn number(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::MAX, f64::from)
}

fn is_link(weight: f64) -> bool {
    weight.is_sign_positive()
}
