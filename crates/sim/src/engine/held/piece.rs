//! A piece of the team: what its robots decide on, first whom they list, then where they go.

use closeranks_core::controller::links::bond::{Bond, Deal};
use closeranks_core::controller::links::line::{Agreement, Line};
use closeranks_core::controller::links::rows::Beside;
use closeranks_core::controller::{Control, Decision, Motion, Standing};
use closeranks_core::id::RobotId;
use closeranks_core::num::{Vector, dot, subtract};
use closeranks_core::obstacle::Obstacle;
use closeranks_core::robot::scratch::Scratch;
use closeranks_core::settings::params::Params;

use crate::engine::bench::Decided;
use crate::engine::held::Robots;
use crate::engine::held::lists::Mate;
use crate::engine::memory::Memory;
use crate::frame::Frame;
use crate::geometry::near::small;

/// What whoever computes a piece of the team needs.
#[derive(Clone, Debug)]
pub(super) struct Desk<const D: usize> {
    memory: Memory<D>,
    values: Vec<f64>,
    /// Who says something else than in the tick before, and to whom.
    news: Vec<[u16; 2]>,
}

impl<const D: usize> Desk<D> {
    /// For a team of so many robots among obstacles.
    pub(super) fn new(params: &Params<D>, robots: usize, map: &[Obstacle<D>]) -> Self {
        let memory = Memory::new(params, robots).among(map);
        Self { memory, values: Vec::new(), news: Vec::new() }
    }

    /// Memory for the robots of the piece, one after another.
    pub(super) fn lend(&mut self) -> Scratch<'_, D> {
        self.memory.lend()
    }

    /// Gives away who says something else than in the tick before, and to whom.
    pub(super) fn news(&mut self) -> impl Iterator<Item = [u16; 2]> {
        self.news.drain(..)
    }
}

/// What robots hold of their neighbours, line by line.
type Held<'a> = (&'a mut [Bond], &'a mut [Deal]);

/// What a robot knows in a tick once it has decided whom it lists.
#[derive(Clone, Copy, Debug)]
pub(super) struct Agreed {
    pub(super) agreement: Agreement,
    /// The squared distance to the nearest neighbour, m²; infinite if there is none.
    pub(super) nearest_m2: f64,
    /// True if its neighbours were not those that it senses, so that its list must be updated first.
    pub(super) outdated: bool,
}

impl Agreed {
    /// That of a robot which knows nobody.
    pub(super) const NOTHING: Self = Self {
        agreement: Agreement { price_m: f64::INFINITY, changed: false },
        nearest_m2: f64::INFINITY,
        outdated: true,
    };
}

/// Where the robots of a tick are, m, how far they sense, m², and whether lists that were outdated are up to date.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scene<'a, const D: usize> {
    pub(super) positions_m: &'a [Vector<D>],
    pub(super) radius_m2: f64,
    pub(super) updated: bool,
}

impl<const D: usize> Robots<D> {
    /// The robots from `first` on, whose room begins with that of `held`, decide whom they list: those whose neighbours are still the same, and where
    /// lists are updated, those for whom that was needed.
    pub(super) fn agree_from<'a>(
        &'a self,
        first: usize,
        agreed: &mut [Agreed],
        (mut bonds, mut deals): Held<'a>,
        desk: &mut Desk<D>,
        scene: Scene<'_, D>,
    ) {
        let mut lines = Vec::new();
        for (robot, agreed) in (first..).zip(agreed) {
            let [room, deal_room] = [self.lists.room(robot).len(), self.lists.deal_room(robot).len()];
            let held = (bonds.split_off_mut(..room), deals.split_off_mut(..deal_room));
            let (Some(bonds), Some(deals)) = held else { return };
            if agreed.outdated != scene.updated {
                continue;
            }
            lines.clear();
            let (same, nearest_m2) = self.gather(robot, scene, (bonds, deals), &mut lines);
            (agreed.outdated, agreed.nearest_m2) = (!same && !scene.updated, nearest_m2);
            if agreed.outdated {
                continue;
            }
            desk.values.resize(lines.len(), 0.0);
            let (own, wish_m_s) = (self.roster.member(robot), &self.wishes_m_s[robot]);
            let lines = (&mut lines[..], &mut desk.values[..]);
            let tell = |reader: RobotId| desk.news.push([small(robot), reader.0 - 1]);
            agreed.agreement = self.controller.agree_at_once(own, &self.moment, wish_m_s, lines, tell);
        }
    }

    /// Collects the neighbours that count for a robot. Gives whether its neighbours are those that it senses, all of them and nobody else, and the squared
    /// distance to the nearest one, m².
    fn gather<'a>(
        &'a self,
        robot: usize,
        scene: Scene<'_, D>,
        (bonds, deals): Held<'a>,
        lines: &mut Vec<Line<'a, D>>,
    ) -> (bool, f64) {
        let (own_m, others, mut deals) = (&scene.positions_m[robot], self.lists.of(robot), deals.iter_mut());
        let (mut same, mut nearest_m2) = (others.mates.len() == self.lists.near(robot), f64::INFINITY);
        for (mate, bond) in others.mates.iter().zip(bonds) {
            let who = usize::from(mate.other);
            let mut offset_m = subtract(own_m, &scene.positions_m[who]);
            let square_m2 = dot(&offset_m, &offset_m);
            same &= scene.radius_m2 - square_m2 >= 0.0;
            nearest_m2 = if square_m2 < nearest_m2 { square_m2 } else { nearest_m2 };
            if let Some(deal) = mate.counts.then(|| deals.next()).flatten() {
                let unseen = others.unseen(mate.other);
                if let Some(unseen) = unseen {
                    offset_m = unseen.offset_m(own_m);
                }
                let (member, voice) = ((self.roster.member(who), mate.mutual), &self.voices[who]);
                lines.push(Line::new(member, offset_m, (bond, deal), voice, unseen, &self.moment));
            }
        }
        (same, nearest_m2)
    }

    /// The robots from `first` on find their velocities.
    pub(super) fn decide_from(
        &self,
        first: usize,
        decided: &mut [Decided<D>],
        agreed: &[Agreed],
        desk: &mut Desk<D>,
        frame: &Frame<D>,
    ) {
        let scratch = &mut desk.memory.lend();
        for (robot, decided) in (first..).zip(decided) {
            let decision = self.decide(robot, agreed[robot].nearest_m2, frame, scratch);
            *decided = self.judged(robot, &decision, frame);
        }
    }

    fn decide(
        &self,
        robot: usize,
        nearest_m2: f64,
        frame: &Frame<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decision<D> {
        let (own_m, others) = (&frame.positions_m[robot], self.lists.of(robot));
        let offset_m = |mate: &Mate| subtract(own_m, &frame.positions_m[usize::from(mate.other)]);
        let beside = others.mates.iter().map(|mate| match others.unseen(mate.other) {
            Some(unseen) => unseen.beside(own_m, mate.active),
            None => Beside { offset_m: offset_m(mate), gone_m: 0.0, sensed: true, active: mate.active },
        });
        let links = &self.controller.links;
        let desired_m_s = if links.may_meet(nearest_m2) {
            let heard = others.mates.iter().filter(|mate| others.unseen(mate.other).is_none());
            let wish_m_s = |mate: &Mate| &self.voices[usize::from(mate.other)].wish_m_s;
            links.turned(&frame.asked_m_s[robot], heard.map(|mate| (offset_m(mate), wish_m_s(mate))))
        } else {
            frame.asked_m_s[robot]
        };
        let motion = Motion { position_m: *own_m, desired_m_s, before_m_s: frame.velocities_m_s[robot] };
        let counted = frame.counted[robot].len();
        self.controller.decide(self.roster.member(robot), counted, beside, &motion, scratch)
    }

    /// A decision with what it is worth.
    pub(super) fn judged(&self, robot: usize, decision: &Decision<D>, frame: &Frame<D>) -> Decided<D> {
        let Decision { velocity_m_s, outcome, phi, doubt: reason } = *decision;
        let (degree, h, need) = (frame.degrees[robot], frame.h[robot], self.roster.need(robot));
        let standing = Standing { degree, need, h, phi, outcome, untold: 0, missing: 0, reason };
        Decided { velocity_m_s, outcome, mode: self.controller.mode(&standing), phi }
    }
}
