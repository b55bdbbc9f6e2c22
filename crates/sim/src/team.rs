//! All robots of a tick at once: the same numbers as [`crate::robots`], bit for bit, at a fraction of the time.
//!
//! In a perfect network every neighbour hears the same level, so weight, slope and both exponentials belong to a pair
//! and are computed once for both ends. Sums are taken in order of robot numbers, as a robot takes them.

use closeranks_core::composed::{Composition, Sum, Term};
use closeranks_core::link::Link;
use closeranks_core::math::{Vector, subtract};
use closeranks_core::params::Params;
use closeranks_core::program::closest;
use closeranks_core::scaled::Scaled;
use closeranks_core::wmsr;

use crate::attack::Liars;
use crate::frame::Frame;
use crate::scenario::{Controller, Scenario};

/// A pair within R.
#[derive(Clone, Copy, Debug)]
struct Pair<const D: usize> {
    first: u16,
    second: u16,
    /// x_first − x_second.
    offset_m: Vector<D>,
    slope: f64,
    collision: f64,
}

/// Scratch and state of a team in a perfect network.
#[derive(Clone, Debug)]
pub struct Team<const D: usize> {
    params: Params<D>,
    controller: Controller,
    ticks_per_round: u32,
    tick: u32,
    pairs: Vec<Pair<D>>,
    terms: Vec<f64>,
    sums: Vec<Sum<D, f64>>,
    next_values: Vec<f64>,
    heard: Vec<Vec<f64>>,
}

impl<const D: usize> Team<D> {
    /// The team of `scenario` with initial `values`.
    #[must_use]
    pub fn new(scenario: &Scenario, params: Params<D>, values: &[f64]) -> Self {
        Self {
            params,
            controller: scenario.controller,
            ticks_per_round: scenario.ticks_per_round(),
            tick: 0,
            pairs: Vec::new(),
            terms: vec![0.0; values.len()],
            sums: vec![Sum::new(0.0); values.len()],
            next_values: values.to_vec(),
            heard: vec![Vec::new(); values.len()],
        }
    }

    /// One tick: fills everything in `frame` but positions and desired velocities.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        self.find_pairs(frame);
        for (index, level) in frame.levels.iter().enumerate() {
            frame.told[index] = liars.level(index, *level);
        }
        if self.tick.is_multiple_of(self.ticks_per_round) {
            self.consensus(frame, liars);
        }
        self.sum_rows(frame);
        self.control(frame);
        self.tick = self.tick.saturating_add(1);
    }

    /// Links, degrees and levels.
    //= paper eq:connectivity
    fn find_pairs(&mut self, frame: &mut Frame<D>) {
        self.pairs.clear();
        frame.levels.fill(0.0);
        frame.degrees.fill(0);
        let positions = &frame.positions_m;
        for (i, first) in (0_u16..).zip(positions) {
            for (j, second) in (0_u16..).zip(positions).skip(usize::from(i) + 1) {
                let offset_m = subtract(first, second);
                let Some(link) = self.params.link().link::<D, f64>(&offset_m) else { continue };
                for end in [i, j] {
                    frame.levels[usize::from(end)] += link.weight;
                    frame.degrees[usize::from(end)] += 1;
                }
                let collision = self.params.composed().collision_term(&offset_m);
                self.pairs.push(Pair { first: i, second: j, offset_m, slope: link.slope, collision });
            }
        }
        frame.links = u32::try_from(self.pairs.len()).unwrap_or(u32::MAX);
    }

    /// A consensus round: values are told, then every robot updates its own.
    fn consensus(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        liars.begin_round();
        for (index, value) in frame.values.iter_mut().enumerate() {
            *value = liars.value(index, self.next_values[index]);
        }
        for heard in &mut self.heard {
            heard.clear();
        }
        for pair in &self.pairs {
            self.heard[usize::from(pair.first)].push(frame.values[usize::from(pair.second)]);
            self.heard[usize::from(pair.second)].push(frame.values[usize::from(pair.first)]);
        }
        let faults = self.params.settings().faults;
        for (own, heard) in self.next_values.iter_mut().zip(&mut self.heard) {
            *own = wmsr::update(*own, heard, faults).value;
        }
    }

    fn sum_rows(&mut self, frame: &Frame<D>) {
        let composed = self.params.composed();
        for ((term, sum), told) in self.terms.iter_mut().zip(&mut self.sums).zip(&frame.told) {
            *term = composed.degree_term(*told);
            *sum = Sum::new(*term);
        }
        for pair in &self.pairs {
            let (first, second) = (usize::from(pair.first), usize::from(pair.second));
            let (own, told) = (self.terms[first], self.terms[second]);
            let pull = composed.coefficient(own, told, pair.slope, pair.collision);
            self.sums[first].add(&pair.offset_m, pull, composed.shared(told), pair.collision);
            self.sums[second].add(&pair.offset_m, -pull, composed.shared(own), pair.collision);
        }
    }

    fn control(&self, frame: &mut Frame<D>) {
        let input = self.params.settings().input;
        for index in 0..frame.positions_m.len() {
            let composition =
                self.sums[index].finish(self.params.composed()).unwrap_or_else(|| self.careful(index, frame));
            let mut solution = closest(&frame.desired_m_s[index], &composition.row, &input);
            if self.controller == Controller::None {
                solution.velocity_m_s = input.clip(&frame.desired_m_s[index]);
            }
            frame.phis[index] = composition.phi;
            frame.velocities_m_s[index] = solution.velocity_m_s;
            frame.outcomes[index] = solution.outcome;
        }
    }

    /// The row of one robot whose plain sums overflowed or vanished.
    fn careful(&self, index: usize, frame: &Frame<D>) -> Composition<D> {
        let composed = self.params.composed();
        let own = &frame.positions_m[index];
        let terms =
            frame.positions_m.iter().zip(&frame.told).enumerate().filter_map(|(other, (position, told))| {
                let offset_m = subtract(own, position);
                let link: Link<Scaled> = self.params.link().link(&offset_m).filter(|_| other != index)?;
                let collision = composed.collision_term(&offset_m);
                Some(Term { offset_m, link, collision, told: composed.degree_term(*told) })
            });
        composed.compose(composed.degree_term(frame.told[index]), terms)
    }
}
