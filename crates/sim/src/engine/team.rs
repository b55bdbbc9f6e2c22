//! All robots of a tick at once: the same numbers as [`crate::engine::fleet`], bit for bit, at a fraction of the time.
//!
//! In a perfect network every neighbour hears the same level, so weight, slope and both exponentials belong to a pair
//! and are computed once for both ends. Sums are taken in order of robot numbers, as a robot takes them.

use closeranks_core::equations::barrier::degree_barrier;
use closeranks_core::equations::composition::{Composition, Sum, TERM_LARGE, Term};
use closeranks_core::equations::link::Link;
use closeranks_core::num::scaled::Scaled;
use closeranks_core::num::{Vector, dot, subtract};
use closeranks_core::program::box_row::closest;
use closeranks_core::settings::params::Params;

use crate::attack::liars::Liars;
use crate::engine::consensus::Consensus;
use crate::frame::Frame;
use crate::scenario::{Controller, Scenario};

/// A pair within R whose slope and collision term are not both 0: in large teams a small part of all.
#[derive(Clone, Copy, Debug)]
struct Pair<const D: usize> {
    ends: [u16; 2],
    /// x of the first minus x of the second end.
    offset_m: Vector<D>,
    slope: f64,
    collision: f64,
}

/// Scratch and state of a team in a perfect network.
#[derive(Clone, Debug)]
pub struct Team<const D: usize> {
    params: Params<D>,
    controller: Controller,
    tick: u32,
    /// Linked robots of higher numbers, robot after robot, and where each robot's end.
    links: Vec<u16>,
    last_link: Vec<usize>,
    pairs: Vec<Pair<D>>,
    terms: Vec<f64>,
    sums: Vec<Sum<D, f64>>,
    consensus: Consensus,
    linked: Linked,
}

/// Who is linked to whom, a bit a pair.
#[derive(Clone, Debug)]
struct Linked {
    robots: usize,
    bits: Vec<u64>,
}

impl Linked {
    fn new(robots: usize) -> Self {
        Self { robots, bits: vec![0; (robots * robots).div_ceil(64)] }
    }

    fn fill(&mut self, links: &[u16], last_link: &[usize]) {
        self.bits.fill(0);
        for (first, others) in links_by_robot(links, last_link) {
            for second in others.iter().map(|other| usize::from(*other)) {
                for bit in [first * self.robots + second, second * self.robots + first] {
                    self.bits[bit / 64] |= 1 << (bit % 64);
                }
            }
        }
    }

    fn has(&self, robot: usize, other: usize) -> bool {
        let bit = robot * self.robots + other;
        self.bits[bit / 64] >> (bit % 64) & 1 == 1
    }
}

/// Every robot with its linked robots of higher numbers.
fn links_by_robot<'a>(links: &'a [u16], last_link: &'a [usize]) -> impl Iterator<Item = (usize, &'a [u16])> {
    let from = core::iter::once(&0).chain(last_link);
    from.zip(last_link).map(|(from, to)| &links[*from..*to]).enumerate()
}

impl<const D: usize> Team<D> {
    /// The team of `scenario` with initial `values`.
    #[must_use]
    pub fn new(scenario: &Scenario, params: Params<D>, values: &[f64]) -> Self {
        Self {
            params,
            controller: scenario.controller,
            tick: 0,
            links: Vec::new(),
            last_link: Vec::new(),
            pairs: Vec::new(),
            terms: vec![0.0; values.len()],
            sums: vec![Sum::new(0.0); values.len()],
            consensus: Consensus::new(scenario, values),
            linked: Linked::new(values.len()),
        }
    }

    /// One tick: fills everything in `frame` but positions and desired velocities.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        self.find_pairs(frame);
        liars.begin_tick(self.tick);
        for (index, level) in frame.levels.iter().enumerate() {
            frame.spares[index] = degree_barrier(*level, self.params.required_degree());
            frame.told[index] = liars.level(index, *level);
        }
        if self.consensus.is_due(self.tick) {
            self.linked.fill(&self.links, &self.last_link);
            let linked = &self.linked;
            self.consensus.hold(frame, liars, |robot, other| linked.has(robot, other));
        }
        self.sum_rows(frame);
        self.control(frame);
        self.tick = self.tick.saturating_add(1);
    }

    /// Links, degrees and levels.
    //= paper eq:connectivity
    fn find_pairs(&mut self, frame: &mut Frame<D>) {
        self.links.clear();
        self.pairs.clear();
        self.last_link.clear();
        frame.levels.fill(0.0);
        frame.degrees.fill(0);
        for first in 0..frame.positions_m.len() {
            self.find_links(first, frame);
            self.last_link.push(self.links.len());
        }
        frame.links = u32::try_from(self.links.len()).unwrap_or(u32::MAX);
    }

    /// Links of `first` to robots of higher numbers.
    fn find_links(&mut self, first: usize, frame: &mut Frame<D>) {
        let (shape, composed) = (*self.params.link(), *self.params.composed());
        let after = first + 1;
        let (position, mut level, mut degree) =
            (frame.positions_m[first], frame.levels[first], frame.degrees[first]);
        let others = frame.positions_m[after..].iter().zip(&mut frame.levels[after..]);
        let others = others.zip(&mut frame.degrees[after..]).zip(small(after)..);
        for (((other, other_level), other_degree), second) in others {
            let offset_m = subtract(&position, other);
            let distance_m2 = dot(&offset_m, &offset_m);
            let Some(link) = shape.link_at::<f64>(distance_m2) else { continue };
            level += link.weight;
            *other_level += link.weight;
            degree += 1;
            *other_degree += 1;
            self.links.push(second);
            let collision: f64 = composed.collision_term(distance_m2);
            if link.slope != 0.0 || collision != 0.0 {
                self.pairs.push(Pair {
                    ends: [small(first), second],
                    offset_m,
                    slope: link.slope,
                    collision,
                });
            }
        }
        (frame.levels[first], frame.degrees[first]) = (level, degree);
    }

    fn sum_rows(&mut self, frame: &Frame<D>) {
        let composed = *self.params.composed();
        for ((term, sum), told) in self.terms.iter_mut().zip(&mut self.sums).zip(&frame.told) {
            *term = composed.degree_term(*told);
            *sum = Sum::new(*term);
        }
        let mut sums = core::mem::take(&mut self.sums);
        for (first, others) in links_by_robot(&self.links, &self.last_link) {
            let (mut own, term) = (sums[first], self.terms[first]);
            for second in others.iter().map(|other| usize::from(*other)) {
                own.add_told(composed.shared(self.terms[second]));
                sums[second].add_told(composed.shared(term));
            }
            sums[first] = own;
        }
        for pair in &self.pairs {
            let [first, second] = pair.ends.map(usize::from);
            let pull =
                composed.coefficient(self.terms[first], self.terms[second], pair.slope, pair.collision);
            sums[first].add_link(&pair.offset_m, pull, pair.collision);
            sums[second].add_link(&pair.offset_m, -pull, pair.collision);
        }
        self.sums = sums;
    }

    fn control(&self, frame: &mut Frame<D>) {
        let input = self.params.settings().input;
        // Beside a huge term no slope counts as 0, so pairs that were left out might matter.
        let ordinary = self.terms.iter().all(|term| *term < TERM_LARGE);
        for index in 0..frame.positions_m.len() {
            let plain = self.sums[index].finish(self.params.composed()).filter(|_| ordinary);
            let composition = plain.unwrap_or_else(|| self.careful(index, frame));
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
                let distance_m2 = dot(&offset_m, &offset_m);
                let link: Link<Scaled> =
                    self.params.link().link_at(distance_m2).filter(|_| other != index)?;
                let collision = composed.collision_term(distance_m2);
                Some(Term { offset_m, link, collision, told: composed.degree_term(*told) })
            });
        composed.compose(composed.degree_term(frame.told[index]), terms)
    }
}

fn small(index: usize) -> u16 {
    u16::try_from(index).unwrap_or(u16::MAX)
}
