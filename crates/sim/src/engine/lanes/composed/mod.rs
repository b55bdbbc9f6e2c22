//! Many worlds of one scenario under `composed` side by side, a world a lane: the numbers of [`crate::engine::team`], bit for bit, in fewer instructions.
//!
//! A tick is that of a team, robot by robot and pair by pair, and each step of it is one loop over all worlds
//! ([`composed::lanes`](closeranks_core::controller::composed::lanes)). What differs from world to world stays one by one: what liars
//! tell, rounds of consensus, and robots whose numbers are of no usual size ([`alone`]).

mod alone;

use closeranks_core::controller::Standing;
use closeranks_core::controller::composed::ComposedController;
use closeranks_core::controller::composed::lanes::{DecisionInLanes, PairInLanes, SumsInLanes};
use closeranks_core::controller::{Control, Decision};
use closeranks_core::equations::barrier::degree_barrier;
use closeranks_core::num::dot;
use closeranks_core::num::lane::{LANES, Lane};
use closeranks_core::program::Outcome;
use closeranks_core::settings::params::Params;

use crate::engine::consensus::Consensus;
use crate::engine::lanes::{InLane, ends, in_lanes};
use crate::engine::memory::Memory;
use crate::engine::roster::Roster;
use crate::geometry::near::small;
use crate::monitors::glance::{Glance, Glances};

/// What the team of a world lends for a tick, which is then one of its own.
pub(crate) struct Lent<'a> {
    pub(crate) consensus: &'a mut Consensus,
    pub(crate) roster: &'a Roster,
    pub(crate) tick: &'a mut u32,
}

/// A world in a lane.
type World<'a, const D: usize> = InLane<'a, D, Lent<'a>>;

/// Computes up to [`LANES`] worlds whose scenarios differ in their seeds alone.
#[derive(Clone, Debug)]
pub(crate) struct ComposedLanes<const D: usize> {
    controller: ComposedController<D>,
    radius_m2: f64,
    positions_m: Vec<[Lane; D]>,
    /// Where robots were in the tick before; before the first one it means nothing.
    before_m: Vec<[Lane; D]>,
    levels: Vec<Lane>,
    /// How many neighbours each has, as numbers that lie beside the others.
    degrees: Vec<Lane>,
    told: Vec<Lane>,
    /// Second end after second end.
    pairs: Vec<PairInLanes>,
    sums: Vec<SumsInLanes<D>>,
    /// The sum of the collision terms of all links.
    collisions: Lane,
    memory: Memory<D>,
    glances: Glances<D>,
}

impl<const D: usize> ComposedLanes<D> {
    /// For teams with these `params` of which some are `malicious`; `None` under a controller that is not computed so.
    pub(crate) fn new(params: &Params<D>, malicious: Vec<bool>) -> Option<Self> {
        let robots = malicious.len();
        let radius_m = params.link().radius_m;
        Some(Self {
            controller: params.controller().in_lanes()?,
            radius_m2: radius_m * radius_m,
            positions_m: vec![[[0.0; LANES]; D]; robots],
            before_m: vec![[[0.0; LANES]; D]; robots],
            levels: vec![[0.0; LANES]; robots],
            degrees: vec![[0.0; LANES]; robots],
            told: vec![[0.0; LANES]; robots],
            pairs: vec![PairInLanes::NONE; robots * robots.saturating_sub(1) / 2],
            sums: vec![SumsInLanes::new(&[0.0; LANES]); robots],
            collisions: [0.0; LANES],
            memory: Memory::new(params, robots),
            glances: Glances::new(malicious, params.settings().limits.input),
        })
    }

    /// One tick of every world: fills everything in their frames but positions and desired velocities.
    pub(crate) fn step(&mut self, worlds: &mut [World<'_, D>]) {
        self.place(worlds);
        self.weigh();
        for (lane, world) in worlds.iter_mut().enumerate() {
            self.tell(lane, world);
        }
        self.add();
        for robot in 0..self.sums.len() {
            let desired_m_s = in_lanes(worlds, |world| world.frame.asked_m_s[robot]);
            let decision = self.controller.decide_in_lanes(&self.sums[robot], &desired_m_s);
            self.glances.decided(&decision.phis, &decision.velocities_m_s);
            self.write(robot, &decision, worlds);
        }
        for world in worlds {
            *world.team.tick = world.team.tick.saturating_add(1);
        }
    }

    /// What the last tick of a world came to for its whole team; none if its robots must be looked at.
    pub(crate) fn glance(&self, lane: usize) -> Option<Glance<'_>> {
        self.glances.of(lane)
    }

    /// Takes in where everybody is. Lanes without a world have the first one.
    fn place(&mut self, worlds: &[World<'_, D>]) {
        self.before_m.clone_from(&self.positions_m);
        for (robot, positions_m) in self.positions_m.iter_mut().enumerate() {
            *positions_m = in_lanes(worlds, |world| world.frame.positions_m[robot]);
        }
        self.glances.begin(&self.positions_m, &self.before_m);
    }

    /// Makes all pairs, and from them levels and degrees.
    //= paper eq:connectivity
    fn weigh(&mut self) {
        let Self { controller, positions_m, levels, degrees, pairs, collisions, .. } = self;
        *collisions = [0.0; LANES];
        levels.fill([0.0; LANES]);
        degrees.fill([0.0; LANES]);
        let mut pairs = pairs.iter_mut();
        for second in 0..positions_m.len() {
            let (levels, own_level) = ends(levels, second);
            let (degrees, own_degree) = ends(degrees, second);
            let firsts = levels.iter_mut().zip(degrees).zip(&positions_m[..second]);
            for (((level, degree), first_m), pair) in firsts.zip(&mut pairs) {
                controller.pair_in_lanes(first_m, &positions_m[second], pair);
                add_link(pair, level, own_level, degree, own_degree, collisions);
            }
        }
    }

    /// Levels of one world, as they are and as they are told, and its round, if one is due.
    fn tell(&mut self, lane: usize, world: &mut World<'_, D>) {
        let InLane { frame, liars, team } = world;
        liars.begin_tick(*team.tick);
        let mut links = 0;
        for robot in 0..self.levels.len() {
            let (level, degree) = (self.levels[robot][lane], count(self.degrees[robot][lane]));
            links += u32::from(degree);
            (frame.levels[robot], frame.degrees[robot]) = (level, degree);
            frame.h[robot] = degree_barrier(level, team.roster.need(robot));
            frame.told[robot] = liars.level(robot, level);
            self.told[robot][lane] = frame.told[robot];
        }
        (frame.links, frame.collisions) = (links / 2, Some(self.collisions[lane]));
        if team.consensus.is_due(*team.tick) {
            let linked = |robot, other| robot != other && self.linked(lane, robot, other);
            team.consensus.hold(frame, liars, linked);
        }
    }

    fn linked(&self, lane: usize, robot: usize, other: usize) -> bool {
        let [own_m, other_m] = [robot, other].map(|robot| &self.positions_m[robot]);
        let offset_m = core::array::from_fn(|d| own_m[d][lane] - other_m[d][lane]);
        self.radius_m2 - dot::<D>(&offset_m, &offset_m) >= 0.0
    }

    /// What each adds up over its neighbours.
    fn add(&mut self) {
        let Self { controller, positions_m, levels, degrees, told, pairs, sums, glances, .. } = self;
        for (robot, (sums, told)) in sums.iter_mut().zip(told).enumerate() {
            let (level, of_told) = (&levels[robot], controller.told_in_lanes(told));
            *sums = SumsInLanes::new(&of_told);
            let of_level =
                if glances.is_malicious(robot) { controller.told_in_lanes(level) } else { of_told };
            glances.know(robot, level, &of_level, &degrees[robot]);
        }
        let mut pairs = pairs.iter();
        for second in 0..positions_m.len() {
            let (before, own) = ends(sums, second);
            for ((first, first_m), pair) in before.iter_mut().zip(&*positions_m).zip(&mut pairs) {
                controller.add_both_in_lanes(first, own, first_m, &positions_m[second], pair);
            }
        }
    }

    /// Writes what became of a robot into the frame of each world.
    fn write(&mut self, robot: usize, decision: &DecisionInLanes<D>, worlds: &mut [World<'_, D>]) {
        for (lane, world) in worlds.iter_mut().enumerate() {
            let (frame, roster) = (&mut *world.frame, world.team.roster);
            let decided = decision.of(lane);
            if decided.is_none_or(|decision| decision.outcome == Outcome::Infeasible) {
                self.glances.is_unusual(lane);
            }
            let decided = decided.unwrap_or_else(|| {
                alone::decide(&self.controller, robot, roster, frame, &mut self.memory.lend())
            });
            let Decision { velocity_m_s, outcome, phi, .. } = decided;
            let (degree, h, need) = (frame.degrees[robot], frame.h[robot], roster.need(robot));
            let standing = Standing { degree, need, h, phi, outcome, untold: 0, missing: 0, reason: None };
            frame.velocities_m_s[robot] = velocity_m_s;
            (frame.outcomes[robot], frame.modes[robot]) = (outcome, self.controller.mode(&standing));
            frame.phis[robot] = phi.unwrap_or(f64::NAN);
        }
    }
}

/// Adds a link, or nothing where there is none, to levels and degrees of both ends, and to the sum of all.
#[inline(never)]
fn add_link(
    pair: &PairInLanes,
    first_level: &mut Lane,
    second_level: &mut Lane,
    first_degree: &mut Lane,
    second_degree: &mut Lane,
    collisions: &mut Lane,
) {
    for k in 0..LANES {
        let (collision, linked) = pair.collision(k);
        collisions[k] += collision;
        let one = if linked { 1.0 } else { 0.0 };
        first_level[k] += pair.weights[k];
        second_level[k] += pair.weights[k];
        first_degree[k] += one;
        second_degree[k] += one;
    }
}

fn count(degree: f64) -> u16 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a sum of a few ones")]
    let degree = degree as usize;
    small(degree)
}
