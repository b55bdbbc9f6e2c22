//! All robots of a tick at once: the same numbers as [`crate::engine::fleet`], bit for bit, at a fraction of the time.
//!
//! In a perfect network nobody hears what another does not. So weights and whatever else belongs to a pair are computed once for
//! both ends. Sums are taken in order of robot numbers, as a robot takes them, and every robot decides by the same
//! function of its controller.

use closeranks_core::controller::{AtOnce, Decision, Glimpse, Motion, Neighbor, Own, Standing};
use closeranks_core::equations::barrier::degree_barrier;
use closeranks_core::num::{Vector, dot, subtract};
use closeranks_core::obstacle::Obstacle;
use closeranks_core::robot::scratch::Scratch;
use closeranks_core::settings::params::Params;

use crate::attack::liars::Liars;
use crate::engine::bench::{Bench, Decided};
use crate::engine::consensus::Consensus;
use crate::engine::dense::{DENSE_MAX, Dense};
use crate::engine::lanes::composed::Lent;
use crate::engine::links::{Linked, Links};
use crate::engine::marks::{Counting, Marks, glimpse};
use crate::engine::phi::Phi;
use crate::engine::roster::Roster;
use crate::engine::sees::{Around, Half, Sees};
use crate::engine::workers::{Piece, Workers, share};
use crate::frame::Frame;
use crate::scenario::Scenario;

/// A team in a perfect network.
#[derive(Clone, Debug)]
pub struct Team<const D: usize, C: AtOnce<D>> {
    robots: Robots<D, C>,
    consensus: Consensus,
    /// φ_i of a controller that does not use it, from what all told; `None` where that is of another weight than φ.
    phi: Option<Phi>,
    /// What each of those who compute the team needs.
    benches: Vec<Bench<D>>,
    decided: Vec<Decided<D>>,
    tick: u32,
}

/// What its robots sense, hear and know in a tick.
#[derive(Clone, Debug)]
struct Robots<const D: usize, C: AtOnce<D>> {
    params: Params<D>,
    controller: C,
    roster: Roster,
    map: Vec<Obstacle<D>>,
    links: Links<C::Pair>,
    /// In a small team without ranks who sees whom, in bits.
    sees: Option<Sees>,
    around: Around,
    counting: Counting,
    /// Tables in place of `around`, in a small team whose controller looks at neighbours.
    dense: Option<Dense>,
    /// What others make of what each told, and what each adds up.
    told: Vec<C::Told>,
    sums: Vec<C::Sums>,
    /// What can be said of each, and what those who see everybody know of it.
    others: Vec<Other<C::Known>>,
}

/// What can be said of a robot in a tick, in one place, because every neighbour asks for all of it.
#[derive(Clone, Copy, Debug)]
struct Other<Known> {
    told_level: f64,
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
        let (count, roster) = (values.len(), Roster::new(scenario, &params));
        let small = count <= DENSE_MAX && !roster.is_ranked();
        let robots = Robots {
            params,
            controller,
            roster,
            map: scenario.obstacles.in_dimension(),
            links: Links::new(),
            sees: small.then(|| Sees::new(count)),
            around: Around::default(),
            counting: Counting::default(),
            dense: (C::LOOKS && small).then(|| Dense::new(count)),
            told: Vec::with_capacity(count),
            sums: Vec::with_capacity(count),
            others: Vec::with_capacity(count),
        };
        Self {
            robots,
            consensus: Consensus::new(scenario, values),
            phi: params.tells_paper_levels().then(|| Phi::new(scenario)),
            benches: Vec::new(),
            decided: Vec::with_capacity(count),
            tick: 0,
        }
    }

    /// One tick: fills everything in `frame` but positions and desired velocities.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars, workers: &dyn Workers) {
        let (robots, round) = (&mut self.robots, self.consensus.is_due(self.tick));
        robots.links.find(&robots.params, &robots.controller, &robots.roster, frame);
        robots.look(round, frame);
        liars.begin_tick(self.tick);
        robots.tell(frame, liars);
        if round {
            if let Some(sees) = &robots.sees {
                self.consensus.hold(frame, liars, |robot, other| sees.linked(robot, other));
            } else {
                let roster = &robots.roster;
                let around = |robot| {
                    let others = robots.around.of(robot).iter().map(|half| usize::from(half.other));
                    others.map(move |other| (other, roster.counts(robot, other)))
                };
                self.consensus.hold_around(frame, liars, around);
            }
        }
        robots.add(frame);
        self.control(frame, workers);
        if let Some(phi) = self.phi.as_mut().filter(|_| frame.wants_phi && !C::USES_PHI) {
            phi.fill(self.robots.links.by_second(), &frame.told, &frame.positions_m, &mut frame.phis);
        }
        self.tick = self.tick.saturating_add(1);
    }

    /// Lends what computing the team side by side with others takes: a small one without ranks and obstacles, under a controller
    /// that is computed so.
    pub(crate) fn lend(&mut self) -> Option<Lent<'_>> {
        let Self { robots, consensus, tick, .. } = self;
        let can = robots.params.controller().in_lanes().is_some() && robots.map.is_empty();
        (can && robots.sees.is_some()).then_some(Lent { consensus, roster: &robots.roster, tick })
    }

    /// Decides for every robot, a piece of the team for each worker.
    fn control(&mut self, frame: &mut Frame<D>, workers: &dyn Workers) {
        let Self { robots, benches, decided, .. } = self;
        let count = frame.positions_m.len();
        let (each, mut dense) = (share(count, workers), robots.dense.take());
        benches.resize_with(count.div_ceil(each), || Bench::new(&robots.params, count, &robots.map));
        decided.resize(count, Decided::NOTHING);
        if let Some(dense) = &mut dense {
            dense.fill(robots.links.pairs(), robots.links.pair_weights());
            robots.control_in_tables(dense, frame, &mut benches[0].memory.lend(), decided);
        } else if each >= count {
            robots.control_from(0, decided, &mut benches[0], frame);
        } else {
            let (robots, frame) = (&*robots, &*frame);
            let pieces = decided.chunks_mut(each).zip(&mut *benches).enumerate();
            let pieces = pieces.map(|(piece, (decided, bench))| -> Piece<'_> {
                Box::new(move || robots.control_from(piece * each, decided, bench, frame))
            });
            workers.run(pieces.collect());
        }
        robots.dense = dense;
        decided.iter().enumerate().for_each(|(robot, decided)| decided.write(robot, frame));
    }
}

impl<const D: usize, C: AtOnce<D> + Copy> Robots<D, C> {
    /// Takes in who is linked to whom, as far as somebody asks: controllers that look at neighbours, and rounds.
    fn look(&mut self, round: bool, frame: &Frame<D>) {
        match &mut self.sees {
            _ if !C::LOOKS && !round => {}
            Some(sees) => sees.fill(self.links.by_second()),
            None => self.around.fill(frame.positions_m.len(), self.links.ends()),
        }
        let all = |degree: &u16| usize::from(*degree) + 1 == frame.degrees.len();
        let everybody = !self.roster.is_ranked() && frame.degrees.iter().all(all);
        if C::LOOKS && self.sees.is_none() && !everybody {
            self.counting.fill(&self.around, self.links.pair_weights(), &self.roster);
        }
    }

    /// Levels, as they are and as they are told, and what others make of them.
    fn tell(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        self.told.clear();
        for (index, level) in frame.levels.iter().enumerate() {
            frame.h[index] = degree_barrier(*level, self.roster.need(index));
            let tells = self.controller.tells_levels();
            frame.told[index] = if tells { liars.level(index, *level) } else { *level };
            self.told.push(self.controller.told(Some(frame.told[index])));
        }
        self.others.clear();
        if C::LOOKS {
            let Self { others, controller, roster, links, .. } = self;
            others.extend((0..frame.told.len()).map(|other| Other {
                told_level: frame.told[other],
                level: frame.levels[other],
                degree: links.counted()[other],
                known: controller.know(&glimpse(frame, roster.member(other), links.counted())),
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

    /// Decides for the robots from `first` on.
    fn control_from(&self, first: usize, decided: &mut [Decided<D>], bench: &mut Bench<D>, frame: &Frame<D>) {
        let Bench { memory, marks } = bench;
        let scratch = &mut memory.lend();
        for (robot, decided) in (first..).zip(decided) {
            *decided = if C::LOOKS {
                self.control_in_lists(robot, marks, frame, scratch)
            } else {
                self.control_from_sums(robot, frame, scratch)
            };
        }
    }

    /// Where sums say everything, neighbours are looked at only if sums fail.
    fn control_from_sums(&self, robot: usize, frame: &Frame<D>, scratch: &mut Scratch<'_, D>) -> Decided<D> {
        let others = (0..frame.positions_m.len()).filter(|other| *other != robot);
        let neighbors = others.filter_map(|other| self.distant(robot, other, frame));
        self.decide(robot, neighbors, frame, scratch)
    }

    /// In a small team sums over what a robot sees are taken for all others at once.
    fn control_in_tables(
        &self,
        dense: &mut Dense,
        frame: &Frame<D>,
        scratch: &mut Scratch<'_, D>,
        decided: &mut [Decided<D>],
    ) {
        for (robot, decided) in decided.iter_mut().enumerate() {
            let looker = Looker::new(robot, frame);
            if looker.unseen > 0 {
                dense.look_around(robot);
            }
            let neighbors = dense
                .neighbors(robot)
                .map(|(other, pair)| self.neighbor(&looker, other, pair, || dense.low(other), frame));
            *decided = self.decide(robot, neighbors, frame, scratch);
        }
    }

    /// In a large team, and with ranks, they are taken where they are asked for.
    fn control_in_lists(
        &self,
        robot: usize,
        marks: &mut Marks,
        frame: &Frame<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decided<D> {
        let looker = Looker::new(robot, frame);
        if looker.unseen > 0 || self.roster.is_ranked() {
            marks.look_from(robot, &self.roster, &self.around);
        }
        let halves = self.around.of(robot).iter();
        let neighbors = halves.map(|half| self.neighbor_in_lists(&looker, *half, marks, frame));
        self.decide(robot, neighbors, frame, scratch)
    }

    #[inline]
    fn decide<'a>(
        &'a self,
        robot: usize,
        neighbors: impl Iterator<Item = Neighbor<'a, D, C::Pair, C::Known>> + Clone,
        frame: &Frame<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decided<D> {
        let (level, told_level) = (frame.levels[robot], frame.told[robot]);
        let own =
            Own { member: self.roster.member(robot), level, told_level, degree: self.links.counted()[robot] };
        let (desired_m_s, before_m_s) = (frame.asked_m_s[robot], frame.velocities_m_s[robot]);
        let motion = Motion { position_m: frame.positions_m[robot], desired_m_s, before_m_s };
        let decision = self.controller.decide(&own, &self.sums[robot], neighbors, &motion, scratch);
        self.judged(robot, &decision, frame)
    }

    /// A decision with what it is worth.
    #[inline]
    fn judged(&self, robot: usize, decision: &Decision<D>, frame: &Frame<D>) -> Decided<D> {
        let (degree, h, need) = (self.links.counted()[robot], frame.h[robot], self.roster.need(robot));
        let Decision { velocity_m_s, outcome, phi, doubt: reason } = *decision;
        let standing = Standing { degree, need, h, phi, outcome, untold: 0, missing: 0, reason };
        Decided { velocity_m_s, outcome, mode: self.controller.mode(&standing), phi }
    }

    /// A neighbour as a robot knows it.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "asked of every neighbour in every tick")]
    fn neighbor(
        &self,
        looker: &Looker<D>,
        other: usize,
        pair: usize,
        low: impl Fn() -> f64,
        frame: &Frame<D>,
    ) -> Neighbor<'_, D, C::Pair, C::Known> {
        let offset_m = subtract(&looker.position_m, &frame.positions_m[other]);
        let (pair, member) = (Some(&self.links.pairs()[pair].pair), self.roster.member(other));
        let Other { told_level, level, degree, known } = &self.others[other];
        if looker.unseen == 0 {
            return Neighbor { member, offset_m, pair, known: *known };
        }
        let known = self.controller.know(&Glimpse {
            member,
            weight: 0.0,
            told_level: *told_level,
            level: *level,
            degree: *degree,
            unseen: looker.unseen,
            unseen_near: self.sees.as_ref().map_or(0, |sees| sees.unseen_near(looker.index, other)),
            low: low(),
        });
        Neighbor { member, offset_m, pair, known }
    }

    /// The same from lists. Of a neighbour for which the robot does not count nothing needs to be known.
    #[inline]
    fn neighbor_in_lists(
        &self,
        looker: &Looker<D>,
        half: Half,
        marks: &Marks,
        frame: &Frame<D>,
    ) -> Neighbor<'_, D, C::Pair, C::Known> {
        let (other, pair) = (usize::from(half.other), half.pair as usize);
        let offset_m = subtract(&looker.position_m, &frame.positions_m[other]);
        let (member, ranked) = (self.roster.member(other), self.roster.is_ranked());
        let known = match &self.others[other] {
            _ if ranked && !self.roster.counts(other, looker.index) => C::Known::default(),
            Other { known, .. } if !ranked && looker.unseen == 0 => *known,
            Other { told_level, level, degree, .. } => {
                let weights = self.links.pair_weights();
                let seen = marks.seen(other, &self.counting);
                let counting = marks.counting(other, &self.roster);
                self.controller.know(&Glimpse {
                    member,
                    weight: weights[pair],
                    told_level: *told_level,
                    level: *level,
                    degree: *degree,
                    unseen: self.roster.counting(other).saturating_sub(counting),
                    unseen_near: usize::from(*degree).saturating_sub(seen.links),
                    low: seen.low,
                })
            }
        };
        Neighbor { member, offset_m, pair: Some(&self.links.pairs()[pair].pair), known }
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
        let known = self.controller.know(&glimpse(frame, self.roster.member(other), self.links.counted()));
        in_range.then_some(Neighbor { member: self.roster.member(other), offset_m, pair: None, known })
    }
}

impl<const D: usize> Looker<D> {
    fn new(index: usize, frame: &Frame<D>) -> Self {
        let unseen = frame.positions_m.len() - 1 - usize::from(frame.degrees[index]);
        Self { index, position_m: frame.positions_m[index], unseen }
    }
}
