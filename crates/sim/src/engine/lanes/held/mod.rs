//! Many worlds of one scenario under `links` side by side, a world a lane: the numbers of [`crate::engine::held`], bit for bit.
//!
//! In a tick in which nobody comes into range or leaves it, all pairs are looked at and promised in one loop over all worlds each
//! ([`lanes`](closeranks_core::controller::links::lanes)), and so is for whom a row is needed. What is rare stays one by one: releases and lists,
//! and the closest velocity among rows. A world in which somebody comes or leaves takes that tick on its own: what its robots
//! hold goes back to its team, and is fetched again afterwards ([`table`]).

mod table;

use closeranks_core::controller::links::bond::{Moment, Voice};
use closeranks_core::controller::links::control::LinksController;
use closeranks_core::controller::links::lanes::{
    BitsInLanes, Facing, LookInLanes, MomentInLanes, TurnInLanes, VoiceInLanes,
};
use closeranks_core::controller::links::line::Line;
use closeranks_core::id::{Member, RobotId};
use closeranks_core::num::lane::{LANES, Lane, at, is_so};
use closeranks_core::num::{Vector, subtract};
use closeranks_core::settings::params::Params;

use crate::engine::held::Held;
use crate::engine::held::lent::each;
use crate::engine::lanes::held::table::{Table, others};
use crate::engine::lanes::phi::PhiLanes;
use crate::engine::lanes::{InLane, ends, in_lanes};
use crate::engine::workers::Alone;
use crate::geometry::near::small;
use crate::monitors::glance::Glance;
use crate::monitors::glance::held::HeldGlances;
use crate::scenario::Scenario;

/// A world in a lane.
type World<'a, const D: usize> = InLane<'a, D, &'a mut Held<D>>;

/// Computes up to [`LANES`] worlds whose scenarios differ in their seeds alone.
#[derive(Clone, Debug)]
pub(crate) struct HeldLanes<const D: usize> {
    controller: LinksController<D>,
    radius_m2: f64,
    /// How many each must count on.
    keep: u16,
    positions_m: Vec<[Lane; D]>,
    /// Where robots were in the tick before; before the first one it means nothing.
    before_m: Vec<[Lane; D]>,
    /// Where each wants to go, m/s, and where it told that it does.
    wishes_m_s: Vec<[Lane; D]>,
    told_m_s: Vec<[Lane; D]>,
    voices: Vec<VoiceInLanes<D>>,
    /// What a promise of each costs from now on, m.
    prices_m: Vec<Lane>,
    table: Table,
    looks: Vec<LookInLanes>,
    bits: Vec<BitsInLanes>,
    /// What was written of them into the frames of worlds.
    noted: Vec<BitsInLanes>,
    /// Worlds whose robots are in the table.
    here: [bool; LANES],
    phi: PhiLanes,
    /// Worlds of which numbers of the whole team were taken in this tick.
    seen: [bool; LANES],
    /// Worlds in whose frames φ_i are.
    knows_phi: [bool; LANES],
    glances: HeldGlances<D>,
}

impl<const D: usize> HeldLanes<D> {
    /// For teams of `scenario` with these `params`; `None` under a controller that is not computed so.
    pub(crate) fn new(scenario: &Scenario, params: &Params<D>) -> Option<Self> {
        let malicious = scenario.malicious_mask();
        let robots = malicious.len();
        let controller = params.controller().lists()?.in_lanes()?;
        let radius_m = params.link().radius_m;
        Some(Self {
            radius_m2: radius_m * radius_m,
            keep: controller.links.keep(member(0)),
            controller,
            positions_m: vec![[[0.0; LANES]; D]; robots],
            before_m: vec![[[0.0; LANES]; D]; robots],
            wishes_m_s: vec![[[0.0; LANES]; D]; robots],
            told_m_s: vec![[[0.0; LANES]; D]; robots],
            voices: vec![VoiceInLanes::SILENCE; robots],
            prices_m: vec![[f64::INFINITY; LANES]; robots],
            table: Table::new(robots),
            looks: vec![LookInLanes::NOTHING; robots.saturating_sub(1)],
            bits: vec![BitsInLanes::NONE; robots],
            noted: vec![BitsInLanes::NONE; robots],
            here: [false; LANES],
            phi: PhiLanes::new(scenario.composition(), params.paper_link(), robots),
            seen: [false; LANES],
            knows_phi: [false; LANES],
            glances: HeldGlances::new(params, malicious),
        })
    }

    /// One tick of every world: fills everything in their frames but positions and desired velocities.
    pub(crate) fn step(&mut self, worlds: &mut [World<'_, D>]) {
        let Some(moment) = worlds.first().map(|world| world.team.moment()) else { return };
        let changed = self.place(worlds);
        let time = MomentInLanes::new(moment);
        for (lane, world) in worlds.iter_mut().enumerate() {
            let goes_on = time.is_some() && world.team.moment() == moment && !is_so(changed[lane]);
            if self.here[lane] && !goes_on {
                self.bring_back(lane, world.team);
            }
            self.here[lane] &= goes_on;
        }
        if let Some(time) = time.filter(|_| self.here.contains(&true)) {
            self.agree(&time);
            self.hold(&time);
        }
        for (lane, world) in worlds.iter_mut().enumerate() {
            if self.here[lane] {
                self.go_on(lane, world);
            } else {
                world.team.step(world.frame, world.liars, &Alone);
            }
        }
        self.listen(worlds);
        self.look_at_phi(worlds);
        for (lane, world) in worlds.iter_mut().enumerate().filter(|(_, world)| world.team.are_all_sensed()) {
            if !self.here[lane] {
                self.fetch(lane, world.team);
            }
        }
    }

    /// Takes in where everybody is, and finds in which lanes somebody comes or leaves.
    fn place(&mut self, worlds: &[World<'_, D>]) -> Lane {
        core::mem::swap(&mut self.before_m, &mut self.positions_m);
        for (robot, positions_m) in self.positions_m.iter_mut().enumerate() {
            *positions_m = in_lanes(worlds, |world| world.frame.positions_m[robot]);
        }
        let (mut changed, mut pairs) = ([0.0; LANES], self.table.pairs.iter_mut());
        for (second, second_m) in self.positions_m.iter().enumerate() {
            for (first_m, pair) in self.positions_m[..second].iter().zip(&mut pairs) {
                pair.measure(first_m, second_m, self.radius_m2, &mut changed);
            }
        }
        changed
    }

    /// Every robot decides whom it lists.
    fn agree(&mut self, time: &MomentInLanes) {
        for robot in 0..self.positions_m.len() {
            let mut turn = self.look(robot, time);
            let room = self.table.room(robot);
            let says = &mut self.table.says[room];
            self.prices_m[robot] = self.controller.promise_in_lanes(self.keep, &turn, &mut self.looks, says);
            self.note_events(robot, &mut turn);
            for lane in 0..LANES {
                if is_so(turn.eventful[lane]) && self.here[lane] {
                    self.part(robot, lane, &turn, &time.moment);
                }
            }
        }
        let Table { ends, says, said, .. } = &mut self.table;
        for (end, says) in ends.iter().zip(&mut *says) {
            end.tell(says);
        }
        core::mem::swap(said, says);
    }

    /// A robot looks at all others.
    fn look(&mut self, robot: usize, time: &MomentInLanes) -> TurnInLanes {
        let Self { controller, positions_m, wishes_m_s, voices, table, looks, .. } = self;
        let mut turn = TurnInLanes::NOTHING;
        for ((place, other), look) in others(robot, positions_m.len()).zip(looks) {
            let pair = &table.pairs[Table::pair(robot, other)];
            let [says, hears] = [[robot, other], [other, robot]].map(|ends| table.place(ends));
            let facing = Facing {
                pair,
                own_m: &positions_m[robot],
                other_m: &positions_m[other],
                wishes_m_s: &wishes_m_s[robot],
                voice: &voices[other],
                said: [&table.said[says], &table.said[hears]],
            };
            controller.look_in_lanes(time, &facing, &mut table.ends[place], look, &mut turn);
        }
        turn
    }

    /// Finds in which lanes a robot has anybody to release or to list.
    fn note_events(&self, robot: usize, turn: &mut TurnInLanes) {
        for ((place, other), look) in others(robot, self.positions_m.len()).zip(&self.looks) {
            let (pair, hears) =
                (&self.table.pairs[Table::pair(robot, other)], self.table.place([other, robot]));
            let (end, hears) = (&self.table.ends[place], &self.table.said[hears]);
            self.controller.note_events_in_lanes(self.keep, pair, (end, hears), look, turn);
        }
    }

    /// A robot of one world releases and lists.
    fn part(&mut self, robot: usize, lane: usize, turn: &TurnInLanes, moment: &Moment) {
        let Self { controller, positions_m, table, looks, .. } = self;
        let own_m = at(&positions_m[robot], lane);
        let near = others(robot, positions_m.len()).zip(&*looks);
        let near = near.filter(|((_, other), _)| table.is_sensed([robot, *other], lane));
        let mut held: Vec<_> = near
            .map(|((place, other), look)| {
                let (bond, deal, look) = table.line([robot, other], lane, look);
                let offset_m: Vector<D> = subtract(&own_m, &at(&positions_m[other], lane));
                (place, member(other), offset_m, (bond, deal), look)
            })
            .collect();
        let lines = held.iter_mut().map(|(_, member, offset_m, (bond, deal), look)| {
            let line = Line::new((*member, true), *offset_m, (bond, deal), &Voice::SILENCE, None, moment);
            line.looked_at(*look)
        });
        let counted = whole(turn.counted[lane]);
        controller.part_at_once(member(robot), moment, &mut lines.collect::<Vec<_>>(), counted);
        for (place, _, _, (bond, deal), _) in held {
            table.ends[place].put(lane, &bond, &deal);
        }
    }

    /// Finds what robots hold of each other from now on.
    fn hold(&mut self, time: &MomentInLanes) {
        let Self { controller, table, bits, .. } = self;
        bits.fill(BitsInLanes::NONE);
        for second in 0..bits.len() {
            let (before, own) = ends(bits, second);
            for (first, bits) in before.iter_mut().enumerate() {
                let pair = &table.pairs[Table::pair(first, second)];
                let held = [[first, second], [second, first]].map(|[robot, other]| {
                    let place = table.place([robot, other]);
                    (&table.ends[place], &table.said[place], robot)
                });
                controller.hold_in_lanes(pair, held, time, bits, own);
            }
        }
    }

    /// The rest of a tick of one world.
    fn go_on(&mut self, lane: usize, world: &mut World<'_, D>) {
        let World { frame, liars, team } = world;
        for (robot, (bits, noted)) in self.bits.iter().zip(&mut self.noted).enumerate() {
            note(bits.counted[lane], &mut noted.counted[lane], &mut frame.counted[robot]);
            note(bits.active[lane], &mut noted.active[lane], &mut frame.rows[robot]);
        }
        team.go_on(frame, liars, |robot| self.bits[robot].of(lane));
    }

    /// Fills φ_i of worlds that ask for them.
    fn look_at_phi(&mut self, worlds: &mut [World<'_, D>]) {
        self.phi.look(&self.positions_m);
        self.glances.begin(&self.positions_m, &self.before_m, &self.phi.levels);
        for (lane, World { frame, .. }) in worlds.iter_mut().enumerate() {
            self.knows_phi[lane] = frame.wants_phi && self.phi.is_finite(lane);
            if self.knows_phi[lane] {
                for (phi, phis) in frame.phis.iter_mut().zip(&self.phi.phis) {
                    *phi = phis[lane];
                }
            }
            if self.here[lane] {
                self.glances.hear(lane, frame, |robot| self.bits[robot].of(lane));
            }
            self.seen[lane] = self.here[lane] && (self.knows_phi[lane] || !frame.wants_phi);
        }
    }

    /// What the last tick of a world came to for its whole team; none if its robots must be looked at.
    pub(crate) fn glance(&self, lane: usize) -> Option<Glance<'_>> {
        let PhiLanes { levels, phis, terms, collisions, .. } = &self.phi;
        let phis = if self.knows_phi[lane] { &phis[..] } else { &[] };
        let seen = self.seen[lane];
        let sums = [terms[lane], collisions[lane]];
        seen.then(|| self.glances.of(lane, levels, phis, sums)).flatten()
    }

    /// True if φ_i of a world are in its frame.
    pub(crate) fn knows_phi(&self, lane: usize) -> bool {
        self.knows_phi[lane]
    }

    /// Takes in what robots told all in this tick, and where they want to go from now on.
    fn listen(&mut self, worlds: &[World<'_, D>]) {
        core::mem::swap(&mut self.told_m_s, &mut self.wishes_m_s);
        for (robot, wishes_m_s) in self.wishes_m_s.iter_mut().enumerate() {
            *wishes_m_s = in_lanes(worlds, |world| world.team.wish_m_s(robot));
        }
        for ((voice, told_m_s), prices_m) in self.voices.iter_mut().zip(&self.told_m_s).zip(&self.prices_m) {
            voice.prices_m = *prices_m;
            for lane in 0..LANES {
                let wish_m_s = self.controller.capped(&at(told_m_s, lane));
                for d in 0..D {
                    voice.wishes_m_s[d][lane] = wish_m_s[d];
                }
            }
        }
    }

    /// Gives back what the robots of one world hold.
    fn bring_back(&self, lane: usize, team: &mut Held<D>) {
        let before_m: Vec<Vector<D>> = self.before_m.iter().map(|before_m| at(before_m, lane)).collect();
        let voice = |robot: usize| {
            let price_m = self.voices[robot].prices_m[lane];
            self.controller.voice(price_m, at(&self.told_m_s[robot], lane))
        };
        team.take_back(|ends| self.table.held(ends, lane), voice, &before_m);
    }

    /// Takes what the robots of one world hold, all of whom sense those of whom they do.
    fn fetch(&mut self, lane: usize, team: &Held<D>) {
        self.here[lane] = self.table.fetch(lane, team.lines());
        for (robot, voice) in self.voices.iter_mut().enumerate() {
            voice.prices_m[lane] = team.price_m(robot);
            // Nobody counts on itself: whatever comes is noted.
            (self.noted[robot].counted[lane], self.noted[robot].active[lane]) = (u64::MAX, u64::MAX);
        }
    }
}

/// Writes the numbers of those whose bits are set, if they are not those that were noted.
fn note(bits: u64, noted: &mut u64, numbers: &mut Vec<u16>) {
    if bits != *noted {
        *noted = bits;
        numbers.clear();
        numbers.extend(each(bits).map(|other| small(other + 1)));
    }
}

/// A robot of a team without ranks.
fn member(robot: usize) -> Member {
    Member { id: RobotId(small(robot + 1)), rank: 0 }
}

/// How many there are.
fn whole(count: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a sum of a few ones")]
    let count = count as usize;
    count
}
