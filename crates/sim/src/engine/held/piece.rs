//! A piece of the team: what its robots decide on, first whom they list, then where they go.

use closeranks_core::controller::links::bond::{Bond, Terms};
use closeranks_core::controller::links::rows::Beside;
use closeranks_core::controller::{Control, Decision, Motion, Standing};
use closeranks_core::num::{Vector, subtract};
use closeranks_core::obstacle::Obstacle;
use closeranks_core::robot::neighbor::Slot;
use closeranks_core::robot::scratch::Scratch;
use closeranks_core::settings::params::Params;

use crate::engine::bench::Decided;
use crate::engine::held::Robots;
use crate::engine::memory::Memory;
use crate::frame::Frame;

/// What whoever computes a piece of the team needs.
#[derive(Clone, Debug)]
pub(super) struct Desk<const D: usize> {
    memory: Memory<D>,
    slots: Vec<Slot<D>>,
    /// Which line of the robot each slot is.
    lines: Vec<usize>,
    values: Vec<f64>,
}

impl<const D: usize> Desk<D> {
    /// For a team of so many robots among obstacles.
    pub(super) fn new(params: &Params<D>, robots: usize, map: &[Obstacle<D>]) -> Self {
        let memory = Memory::new(params, robots).among(map);
        Self { memory, slots: Vec::new(), lines: Vec::new(), values: Vec::new() }
    }

    /// The slot for the next line.
    fn slot(&mut self) -> &mut Slot<D> {
        if self.slots.len() == self.lines.len() {
            self.slots.push(Slot::default());
        }
        &mut self.slots[self.lines.len()]
    }
}

/// What one robot holds of its neighbours, line by line.
type Held<'a> = (&'a mut [Bond], &'a mut [Terms]);

impl<const D: usize> Robots<D> {
    /// The robots from `first` on, whose room begins with that of `held`, decide whom they list; gives prices and levels.
    pub(super) fn agree_from(
        &self,
        first: usize,
        (prices_m, levels): (&mut [f64], &mut [f64]),
        (bonds, terms): Held<'_>,
        desk: &mut Desk<D>,
        positions_m: &[Vector<D>],
    ) {
        let begin = self.lists.room(first).start;
        for (robot, (price_m, level)) in (first..).zip(prices_m.iter_mut().zip(levels)) {
            let range = self.lists.range(robot);
            let range = range.start - begin..range.end - begin;
            let (bonds, terms) = (&mut bonds[range.clone()], &mut terms[range]);
            *price_m = self.agree(robot, (&mut *bonds, terms), desk, positions_m);
            let counted = bonds.iter().filter(|bond| bond.is_counted(&self.moment));
            *level = counted.fold(0.0, |level, _| level + 1.0);
        }
    }

    fn agree(
        &self,
        robot: usize,
        (bonds, terms): Held<'_>,
        desk: &mut Desk<D>,
        positions_m: &[Vector<D>],
    ) -> f64 {
        let (own_m, others) = (&positions_m[robot], self.lists.of(robot));
        desk.lines.clear();
        for (line, other) in others.numbers.iter().enumerate() {
            let index = usize::from(*other);
            if !self.roster.counts(robot, index) {
                continue;
            }
            let (member, offset_m) = (self.roster.member(index), subtract(own_m, &positions_m[index]));
            let slot = desk.slot();
            bonds[line].fill(slot, &terms[line], &self.moment, member, offset_m, &self.voices[index]);
            if let Some(unseen) = others.unseen(*other) {
                unseen.fill(slot, own_m);
            }
            desk.lines.push(line);
        }
        let Desk { slots, lines, values, .. } = desk;
        let slots = &mut slots[..lines.len()];
        values.resize(lines.len(), 0.0);
        let (own, wish_m_s) = (self.roster.member(robot), &self.wishes_m_s[robot]);
        let price_m = self.controller.agree_at_once(own, &self.moment, wish_m_s, slots, values);
        for (slot, line) in slots.iter().zip(lines) {
            bonds[*line].keep(&mut terms[*line], &self.moment, slot);
        }
        price_m
    }

    /// The robots from `first` on find their velocities.
    pub(super) fn decide_from(
        &self,
        first: usize,
        decided: &mut [Decided<D>],
        desk: &mut Desk<D>,
        frame: &Frame<D>,
    ) {
        let scratch = &mut desk.memory.lend();
        for (robot, decided) in (first..).zip(decided) {
            let decision = self.decide(robot, frame, scratch);
            *decided = self.judged(robot, &decision, frame);
        }
    }

    fn decide(&self, robot: usize, frame: &Frame<D>, scratch: &mut Scratch<'_, D>) -> Decision<D> {
        let (own_m, others) = (&frame.positions_m[robot], self.lists.of(robot));
        let bonds = self.lists.bonds(robot);
        let offset_m = |other: usize| subtract(own_m, &frame.positions_m[other]);
        let beside = others.numbers.iter().zip(bonds).map(|(other, bond)| {
            let active = bond.is_active(&self.moment);
            match others.unseen(*other) {
                Some(unseen) => unseen.beside(own_m, active),
                None => Beside { offset_m: offset_m(usize::from(*other)), gone_m: 0.0, sensed: true, active },
            }
        });
        let counted = bonds.iter().filter(|bond| bond.is_counted(&self.moment)).count();
        let heard = others.sensed().map(|other| (offset_m(other), self.voices[other].wish_m_s));
        let desired_m_s = self.controller.links.turned(&frame.asked_m_s[robot], heard);
        let motion = Motion { position_m: *own_m, desired_m_s, before_m_s: frame.velocities_m_s[robot] };
        self.controller.decide(self.roster.member(robot), counted, beside, &motion, scratch)
    }

    /// A decision with what it is worth.
    fn judged(&self, robot: usize, decision: &Decision<D>, frame: &Frame<D>) -> Decided<D> {
        let Decision { velocity_m_s, outcome, phi, doubt: reason } = *decision;
        let (degree, h, need) = (frame.degrees[robot], frame.h[robot], self.roster.need(robot));
        let standing = Standing { degree, need, h, phi, outcome, untold: 0, missing: 0, reason };
        Decided { velocity_m_s, outcome, mode: self.controller.mode(&standing), phi }
    }
}
