//! All robots of a tick at once: the same numbers as [`crate::engine::fleet`], bit for bit, at a fraction of the time.
//!
//! In a perfect network nobody hears what another does not. So weights and whatever else belongs to a pair are computed once for
//! both ends. Sums are taken in order of robot numbers, as a robot takes them, and every robot decides by the same
//! function of its controller.

use closeranks_core::controller::{AtOnce, Decision, Glimpse, Low, Motion, Neighbor, Own, Standing};
use closeranks_core::equations::barrier::degree_barrier;
use closeranks_core::num::{Vector, dot, sqrt, subtract};
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::robot::scratch::Scratch;
use closeranks_core::settings::params::Params;

use crate::attack::liars::Liars;
use crate::engine::consensus::Consensus;
use crate::engine::dense::{DENSE_MAX, Dense};
use crate::engine::links::{Linked, Links};
use crate::engine::memory::Memory;
use crate::engine::phi::Phi;
use crate::engine::sees::{Around, Half, Sees};
use crate::frame::Frame;
use crate::geometry::near::small;
use crate::scenario::Scenario;

/// A team in a perfect network.
#[derive(Clone, Debug)]
pub struct Team<const D: usize, C: AtOnce<D>> {
    robots: Robots<D, C>,
    consensus: Consensus,
    /// φ_i of a controller that does not use it, from what all told; `None` where that is of another weight than φ.
    phi: Option<Phi>,
    memory: Memory<D>,
    tick: u32,
}

/// What its robots sense, hear and know in a tick.
#[derive(Clone, Debug)]
struct Robots<const D: usize, C: AtOnce<D>> {
    params: Params<D>,
    controller: C,
    links: Links<C::Pair>,
    sees: Sees,
    around: Around,
    /// Tables in place of `around`, in a small team.
    dense: Option<Dense>,
    /// What others make of what each told, and what each adds up.
    told: Vec<C::Told>,
    sums: Vec<C::Sums>,
    /// What can be said of each, and what those who see everybody know of it.
    others: Vec<Other<C::Told, C::Known>>,
}

/// What can be said of a robot in a tick, in one place, because every neighbour asks for all of it.
#[derive(Clone, Copy, Debug)]
struct Other<Told, Known> {
    told_level: f64,
    told: Told,
    level: f64,
    degree: u16,
    known: Known,
}

/// A robot that looks at its neighbours.
#[derive(Clone, Copy, Debug)]
struct Looker<const D: usize> {
    index: usize,
    position_m: Vector<D>,
    /// How many robots of the team it does not see.
    unseen: usize,
}

impl<const D: usize, C: AtOnce<D> + Copy> Team<D, C> {
    /// The team of `scenario` under `controller`, that of `params`, with initial `values`.
    #[must_use]
    pub fn new(scenario: &Scenario, params: Params<D>, controller: C, values: &[f64]) -> Self {
        let count = values.len();
        let robots = Robots {
            params,
            controller,
            links: Links::new(),
            sees: Sees::new(count),
            around: Around::default(),
            dense: (C::LOOKS && count <= DENSE_MAX).then(|| Dense::new(count)),
            told: Vec::with_capacity(count),
            sums: Vec::with_capacity(count),
            others: Vec::with_capacity(count),
        };
        Self {
            robots,
            consensus: Consensus::new(scenario, values),
            phi: (!params.weighs_its_own_way()).then(|| Phi::new(scenario)),
            memory: Memory::new(&params, count),
            tick: 0,
        }
    }

    /// One tick: fills everything in `frame` but positions and desired velocities.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        let (robots, round) = (&mut self.robots, self.consensus.is_due(self.tick));
        robots.links.find(&robots.params, &robots.controller, frame);
        if C::LOOKS || round {
            robots.sees.fill(robots.links.by_second());
        }
        liars.begin_tick(self.tick);
        robots.tell(frame, liars);
        if round {
            self.consensus.hold(frame, liars, |robot, other| robots.sees.linked(robot, other));
        }
        robots.add(frame);
        robots.control(frame, &mut self.memory.lend());
        if let Some(phi) = self.phi.as_mut().filter(|_| frame.wants_phi && !C::USES_PHI) {
            phi.fill(robots.links.by_second(), &frame.told, &frame.positions_m, &mut frame.phis);
        }
        self.tick = self.tick.saturating_add(1);
    }
}

impl<const D: usize, C: AtOnce<D> + Copy> Robots<D, C> {
    /// Levels, as they are and as they are told, and what others make of them.
    fn tell(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        self.told.clear();
        for (index, level) in frame.levels.iter().enumerate() {
            frame.h[index] = degree_barrier(*level, self.params.need().need(id(index)));
            frame.told[index] = liars.level(index, *level);
            self.told.push(self.controller.told(id(index), Some(frame.told[index])));
        }
        self.others.clear();
        if C::LOOKS {
            self.others.extend((0..frame.told.len()).map(|other| Other {
                told_level: frame.told[other],
                told: self.told[other],
                level: frame.levels[other],
                degree: frame.degrees[other],
                known: self.controller.know(&glimpse(frame, &self.told, other)),
            }));
        }
    }

    /// What each adds up over its neighbours.
    fn add(&mut self, frame: &Frame<D>) {
        let (controller, told) = (&self.controller, &self.told[..]);
        self.sums.clear();
        self.sums.extend(told.iter().map(|own| controller.sums(own)));
        let sums = &mut self.sums[..];
        if !C::ADDS {
            return;
        }
        for (second, firsts) in self.links.by_second() {
            let mut own = sums[second];
            for first in firsts.iter().map(|first| usize::from(*first)) {
                controller.hear(&mut own, &told[first]);
                controller.hear(&mut sums[first], &told[second]);
            }
            sums[second] = own;
        }
        for Linked { ends, pair } in self.links.pairs() {
            let [first, second] = ends.map(usize::from);
            let offset_m = subtract(&frame.positions_m[first], &frame.positions_m[second]);
            let (before, from_second) = sums.split_at_mut(second);
            let sums = [&mut before[first], &mut from_second[0]];
            controller.add_both(sums, &offset_m, pair, [&told[first], &told[second]]);
        }
    }

    fn control(&mut self, frame: &mut Frame<D>, scratch: &mut Scratch<'_, D>) {
        let mut dense = self.dense.take();
        match &mut dense {
            _ if !C::LOOKS => self.control_from_sums(frame, scratch),
            Some(dense) => self.control_in_tables(dense, frame, scratch),
            None => self.control_in_lists(frame, scratch),
        }
        self.dense = dense;
    }

    /// Where sums say everything, neighbours are looked at only if sums fail.
    fn control_from_sums(&self, frame: &mut Frame<D>, scratch: &mut Scratch<'_, D>) {
        for robot in 0..frame.positions_m.len() {
            let others = (0..frame.positions_m.len()).filter(|other| *other != robot);
            let neighbors = others.filter_map(|other| self.distant(robot, other, frame));
            let decision = self.decide(robot, neighbors, frame, scratch);
            self.take(robot, &decision, frame);
        }
    }

    /// In a small team sums over what a robot sees are taken for all others at once.
    fn control_in_tables(&self, dense: &mut Dense, frame: &mut Frame<D>, scratch: &mut Scratch<'_, D>) {
        dense.fill(self.links.pairs(), self.links.pair_weights());
        for robot in 0..frame.positions_m.len() {
            let looker = Looker::new(robot, frame);
            if looker.unseen > 0 {
                dense.look_around(robot);
            }
            let neighbors = dense.neighbors(robot).map(|(other, pair)| {
                self.neighbor(&looker, other, pair, Low::Known(dense.low(other)), frame)
            });
            let decision = self.decide(robot, neighbors, frame, scratch);
            self.take(robot, &decision, frame);
        }
    }

    /// In a large team they are taken where they are asked for.
    fn control_in_lists(&mut self, frame: &mut Frame<D>, scratch: &mut Scratch<'_, D>) {
        self.around.fill(frame.positions_m.len(), self.links.pairs());
        for robot in 0..frame.positions_m.len() {
            let looker = Looker::new(robot, frame);
            let neighbors = self.around.of(robot).iter().map(|half| {
                let other = usize::from(half.other);
                let low = || self.seen_level(robot, other);
                self.neighbor(&looker, other, half.pair as usize, Low::Asked(&low), frame)
            });
            let decision = self.decide(robot, neighbors, frame, scratch);
            self.take(robot, &decision, frame);
        }
    }

    #[inline]
    fn decide<'a>(
        &'a self,
        robot: usize,
        neighbors: impl Iterator<Item = Neighbor<'a, D, C::Pair, C::Known>> + Clone,
        frame: &Frame<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decision<D> {
        let (level, told_level) = (frame.levels[robot], frame.told[robot]);
        let own = Own { id: id(robot), level, told_level, degree: frame.degrees[robot] };
        let (desired_m_s, before_m_s) = (frame.asked_m_s[robot], frame.velocities_m_s[robot]);
        let motion = Motion { desired_m_s, before_m_s };
        self.controller.decide(&own, &self.sums[robot], neighbors, &motion, scratch)
    }

    #[inline]
    fn take(&self, robot: usize, decision: &Decision<D>, frame: &mut Frame<D>) {
        let (degree, h, need) = (frame.degrees[robot], frame.h[robot], self.params.need().need(id(robot)));
        let (outcome, phi, reason) = (decision.outcome, decision.phi, decision.doubt);
        frame.velocities_m_s[robot] = decision.velocity_m_s;
        frame.outcomes[robot] = outcome;
        frame.modes[robot] =
            self.controller.mode(&Standing { degree, need, h, phi, outcome, untold: 0, missing: 0, reason });
        if let Some(phi) = phi {
            frame.phis[robot] = phi;
        }
    }

    /// A neighbour as a robot knows it.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "asked of every neighbour in every tick")]
    fn neighbor(
        &self,
        looker: &Looker<D>,
        other: usize,
        pair: usize,
        low: Low<'_>,
        frame: &Frame<D>,
    ) -> Neighbor<'_, D, C::Pair, C::Known> {
        let offset_m = subtract(&looker.position_m, &frame.positions_m[other]);
        let (pair, id) = (Some(&self.links.pairs()[pair].pair), id(other));
        let Other { told_level, told, level, degree, known } = &self.others[other];
        if looker.unseen == 0 {
            return Neighbor { id, offset_m, pair, known: *known };
        }
        let known = self.controller.know(&Glimpse {
            id,
            told_level: *told_level,
            told,
            level: *level,
            degree: *degree,
            unseen: looker.unseen,
            unseen_near: self.sees.unseen_near(looker.index, other),
            distance_m: sqrt(dot(&offset_m, &offset_m)),
            low,
        });
        Neighbor { id, offset_m, pair, known }
    }

    /// Sum of the weights of `other` with `robot` and with whomever it sees, in order of numbers.
    fn seen_level(&self, robot: usize, other: usize) -> f64 {
        let seen =
            |of: &&Half| usize::from(of.other) == robot || self.sees.linked(robot, usize::from(of.other));
        let halves = self.around.of(other).iter().filter(seen);
        halves.fold(0.0, |sum, half| sum + self.links.pair_weights()[half.pair as usize])
    }

    /// A neighbour of a controller that needs neighbours one by one only in rare cases.
    fn distant(
        &self,
        robot: usize,
        other: usize,
        frame: &Frame<D>,
    ) -> Option<Neighbor<'_, D, C::Pair, C::Known>> {
        let offset_m = subtract(&frame.positions_m[robot], &frame.positions_m[other]);
        let radius_m = self.params.link().radius_m;
        let in_range = radius_m * radius_m - dot(&offset_m, &offset_m) >= 0.0;
        let known = self.controller.know(&glimpse(frame, &self.told, other));
        in_range.then_some(Neighbor { id: id(other), offset_m, pair: None, known })
    }
}

/// What whoever sees everybody sees of `other`.
fn glimpse<'a, const D: usize, Told>(frame: &Frame<D>, told: &'a [Told], other: usize) -> Glimpse<'a, Told> {
    Glimpse {
        id: id(other),
        told_level: frame.told[other],
        told: &told[other],
        level: frame.levels[other],
        degree: frame.degrees[other],
        unseen: 0,
        unseen_near: 0,
        distance_m: 0.0,
        low: Low::Known(0.0),
    }
}

impl<const D: usize> Looker<D> {
    fn new(index: usize, frame: &Frame<D>) -> Self {
        let unseen = frame.positions_m.len() - 1 - usize::from(frame.degrees[index]);
        Self { index, position_m: frame.positions_m[index], unseen }
    }
}

fn id(index: usize) -> RobotId {
    RobotId(small(index + 1))
}
