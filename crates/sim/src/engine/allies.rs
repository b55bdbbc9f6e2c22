//! All robots of a tick under `budget` at once: the same numbers as [`crate::engine::fleet`], bit for bit.
//!
//! In a perfect world nobody senses anything that another does not. So weights and the bounds of their derivatives belong to a
//! pair and are computed once for both ends, and whoever sees everybody knows the same of each. Whoever does not sums up
//! the weights between those it sees. Rows and answers are made by the functions of [`closeranks_core`] that a robot uses.

use closeranks_core::controller::budget::knowledge::Known;
use closeranks_core::controller::budget::survey::Seen;
use closeranks_core::controller::budget::tie::Neighbor;
use closeranks_core::equations::barrier::degree_barrier;
use closeranks_core::equations::composition::Sum;
use closeranks_core::num::{Vector, subtract};
use closeranks_core::program::balls::row::Row;
use closeranks_core::settings::params::Params;

use crate::attack::liars::Liars;
use crate::engine::consensus::Consensus;
use crate::engine::ties::Ties;
use crate::frame::Frame;
use crate::scenario::Scenario;

/// Positions are rounded to far less than what a robot takes for a jump as long as they are nearer to 0 than this, m.
const NEAR_M: f64 = 1e5;

/// Scratch and state of a team of `budget` in a perfect world.
#[derive(Clone, Debug)]
pub struct Allies<const D: usize> {
    params: Params<D>,
    tick: u32,
    consensus: Consensus,
    ties: Ties,
    /// Behind φ_i.
    terms: Vec<f64>,
    sums: Vec<Sum<0, f64>>,
    /// What the claims of all are worth.
    worths: Vec<f64>,
    /// What those know of each robot who see everybody.
    knowns: Vec<Known>,
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
        let nothing = Known { budget: 0.0, deficit: 0.0, degree_max: 1.0 };
        Some(Self {
            params,
            tick: 0,
            consensus: Consensus::new(scenario, values),
            ties: Ties::new(robots),
            terms: vec![0.0; robots],
            sums: vec![Sum::new(0.0); robots],
            worths: vec![0.0; robots],
            knowns: vec![nothing; robots],
            rows: vec![Row::default(); 2 * D + 2 * robots + 1],
        })
    }

    /// One tick: fills everything in `frame` but positions and desired velocities.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        self.ties.find(&self.params, frame);
        liars.begin_tick(self.tick);
        self.tell(frame, liars);
        if self.consensus.is_due(self.tick) {
            self.consensus.hold(frame, liars, |robot, other| self.ties.linked(robot, other));
        }
        if frame.wants_phi {
            self.sum_phis(frame);
        }
        for robot in 0..frame.positions_m.len() {
            self.control(robot, frame);
        }
        self.tick = self.tick.saturating_add(1);
    }

    /// Levels, as they are and as they are told, and what comes of them for who sees everybody.
    fn tell(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        let (settings, budget) = (self.params.settings(), self.params.budget());
        for (robot, level) in frame.levels.iter().enumerate() {
            frame.spares[robot] = degree_barrier(*level, budget.required());
            frame.told[robot] = liars.level(robot, *level);
            self.worths[robot] = budget.worth(settings.claim(frame.told[robot], settings.clock_error));
            let degree = f64::from(frame.degrees[robot]);
            let seen = Seen { low: *level, degree, unseen: 0, worth: self.worths[robot] };
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
                let tie = self.ties.of(first, second);
                if !self.ties.linked(first, second) {
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
        let linked = || (0..robots).filter(|other| self.ties.linked(robot, *other));
        let levels = linked().map(|other| frame.told[other]);
        let distances_m2 = linked().map(|other| self.ties.of(robot, other).distance_m2);
        self.params.composed().phi(frame.told[robot], levels.clone(), distances_m2.clone())
    }

    /// Rows and answer of one robot.
    fn control(&mut self, robot: usize, frame: &mut Frame<D>) {
        self.ties.look_around(robot);
        let mut rows = core::mem::take(&mut self.rows);
        let (params, position) = (&self.params, frame.positions_m[robot]);
        let neighbors = self.ties.neighbors(robot).map(|(other, tie)| {
            let offset_m = subtract(&position, &frame.positions_m[other]);
            let seen = self.ties.seen(other, frame.degrees[other], self.worths[other]);
            let known = seen.map(|seen| params.budget().known_from(&seen, tie.distance_m));
            Neighbor { offset_m, tie, known: known.unwrap_or(self.knowns[other]) }
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
}
