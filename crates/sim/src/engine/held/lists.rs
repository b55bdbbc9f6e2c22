//! The neighbours of all robots in one list, each with what the robot holds of it.

use core::ops::Range;

use closeranks_core::controller::Control;
use closeranks_core::controller::links::bond::{Bond, Deal, Moment, Unseen, Voice};
use closeranks_core::controller::links::control::LinksController;
use closeranks_core::num::Vector;
use closeranks_core::robot::missing::Horizon;
use closeranks_core::robot::neighbor::Slot;

use crate::engine::held::spare::Spare;
use crate::engine::roster::Roster;
use crate::geometry::crowd::Crowd;
use crate::geometry::near::small;

/// So many more neighbours a robot has room for than it has when room is made.
const SPARE: usize = 8;

/// Neighbours robot after robot, those of each in order of numbers. If one robot has another, that one has it too.
#[derive(Clone, Debug)]
pub(crate) struct Lists<const D: usize> {
    /// Where the room of each robot begins, and one past the last; and how much of it is in use.
    starts: Vec<u32>,
    pub(super) counts: Vec<u16>,
    /// The same of what was agreed on with those that count for it, and how many they are in all.
    deal_starts: Vec<u32>,
    deal_counts: Vec<u16>,
    dealt: usize,
    spare: Spare,
    pub(super) rows: Rows,
    /// Those that are not sensed and keep their place, in the same order. There are hardly ever any.
    pub(super) unseen: Vec<Ghost<D>>,
    unseen_before: Vec<Ghost<D>>,
    /// Where robots were in the tick before, m.
    pub(super) before_m: Vec<Vector<D>>,
    /// Of each robot the tick in which it got or lost neighbours last, or it or a neighbour changed its list.
    pub(super) changed: Vec<u32>,
    crowd: Crowd,
    /// Memory for the neighbours of one robot, and for those that it senses.
    fresh: Rows,
    near: Vec<u16>,
}

/// One line a neighbour.
#[derive(Clone, Debug)]
pub(super) struct Rows {
    pub(super) mates: Vec<Mate>,
    pub(super) bonds: Vec<Bond>,
    /// Those with neighbours that count for the robot, in the same order.
    pub(super) deals: Vec<Deal>,
}

/// Who a neighbour is.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Mate {
    pub(crate) other: u16,
    /// True if it counts for the robot, and if both count for each other.
    pub(crate) counts: bool,
    pub(crate) mutual: bool,
    /// True if it has a row, as it was marked last.
    pub(crate) active: bool,
}

/// A neighbour of a robot that the robot does not sense.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ghost<const D: usize> {
    robot: u16,
    other: u16,
    unseen: Unseen<D>,
}

/// The neighbours of one robot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Others<'a, const D: usize> {
    pub(crate) mates: &'a [Mate],
    unseen: &'a [Ghost<D>],
}

/// What decides whether a neighbour that left keeps its place.
pub(crate) struct Rule<'a, const D: usize> {
    pub(crate) controller: &'a LinksController<D>,
    pub(crate) horizon: Horizon,
    pub(crate) roster: &'a Roster,
    pub(crate) moment: Moment,
}

impl<const D: usize> Lists<D> {
    /// Of a team of so many robots in which nobody has a neighbour.
    pub(crate) fn new(robots: usize) -> Self {
        Self {
            starts: vec![0; robots + 1],
            counts: vec![0; robots],
            deal_starts: vec![0; robots + 1],
            deal_counts: vec![0; robots],
            dealt: 0,
            spare: Spare::NEW,
            rows: Rows::new(),
            unseen: Vec::new(),
            unseen_before: Vec::new(),
            before_m: vec![[0.0; D]; robots],
            changed: vec![0; robots],
            crowd: Crowd::default(),
            fresh: Rows::new(),
            near: Vec::new(),
        }
    }

    /// Robots at `positions_m` look around as far as `radius_m`. False if the neighbours of all of them must be looked at anew ([`update`](Self::update)),
    /// whether they are the same or not: some are not sensed.
    pub(crate) fn look(&mut self, positions_m: &[Vector<D>], radius_m: f64, rule: &Rule<'_, D>) -> bool {
        self.crowd.split(positions_m, radius_m);
        self.crowd.count(positions_m);
        let counts = self.crowd.counts();
        if (0..counts.len()).any(|robot| usize::from(counts[robot]) > self.room(robot).len()) {
            self.spare.falls_short(rule.moment.tick());
            self.make_room(rule, |lists, robot| usize::from(lists.crowd.counts()[robot]));
        }
        core::mem::swap(&mut self.unseen, &mut self.unseen_before);
        self.unseen.clear();
        self.unseen_before.is_empty()
    }

    /// Takes in whom one robot senses now. Of several robots this is asked in order of their numbers.
    pub(crate) fn update(&mut self, robot: usize, positions_m: &[Vector<D>], rule: &Rule<'_, D>) {
        self.merge(robot, positions_m, rule);
        self.put(robot, rule);
    }

    /// Ends a look around. Where deals take more room than they need, as when it was not known yet who counts for whom, they get less.
    pub(crate) fn looked(&mut self, positions_m: &[Vector<D>], rule: &Rule<'_, D>) {
        self.before_m.copy_from_slice(positions_m);
        let (tick, room, robots) = (rule.moment.tick(), self.rows.deals.len(), self.counts.len());
        if self.spare.suffices(tick, room, self.dealt, robots) {
            self.make_room(rule, |lists, robot| usize::from(lists.counts[robot]));
        }
    }

    /// How many robots are near this one.
    #[inline]
    pub(crate) fn near(&self, robot: usize) -> usize {
        usize::from(self.crowd.counts()[robot])
    }

    /// Collects the neighbours of one robot where some came or left.
    fn merge(&mut self, robot: usize, positions_m: &[Vector<D>], rule: &Rule<'_, D>) {
        let newcomer = |other: u16| (rule.mate(robot, other), Bond::new(&rule.moment), Deal::default());
        self.fresh.clear();
        self.crowd.around(robot, positions_m, &mut self.near);
        let mut near = self.near.iter().copied().peekable();
        let range = self.range(robot);
        let mut deals = self.rows.deals[self.deal_room(robot)].iter();
        for (mate, bond) in self.rows.mates[range.clone()].iter().zip(&self.rows.bonds[range]) {
            let deal = mate.counts.then(|| deals.next()).flatten().copied().unwrap_or_default();
            let (mate, bond, other) = (*mate, *bond, mate.other);
            while let Some(new) = near.next_if(|near| *near < other) {
                self.fresh.push(newcomer(new));
            }
            if near.next_if_eq(&other).is_none() {
                let before = find(&self.unseen_before, robot, other);
                let last_m = self.before_m[usize::from(other)];
                let mut unseen = before.unwrap_or_else(|| Unseen::new(&rule.moment, last_m));
                unseen.reckon(&rule.moment, &rule.horizon, &positions_m[robot]);
                if !rule.keeps((other, &bond, &deal), &unseen, &positions_m[robot]) {
                    continue;
                }
                self.unseen.push(Ghost { robot: small(robot), other, unseen });
            }
            self.fresh.push((mate, bond, deal));
        }
        near.for_each(|new| self.fresh.push(newcomer(new)));
    }

    /// Puts those that were collected where the neighbours of one robot are.
    fn put(&mut self, robot: usize, rule: &Rule<'_, D>) {
        let (count, dealt) = (self.fresh.mates.len(), self.fresh.deals.len());
        if count > self.room(robot).len() || dealt > self.deal_room(robot).len() {
            self.spare.falls_short(rule.moment.tick());
            self.make_room(
                rule,
                |lists, other| if other == robot { count } else { usize::from(lists.counts[other]) },
            );
        }
        self.rows.put([self.starts[robot], self.deal_starts[robot]].map(|start| start as usize), &self.fresh);
        self.counts[robot] = small(count);
        self.dealt = self.dealt + dealt - usize::from(self.deal_counts[robot]);
        self.deal_counts[robot] = small(dealt);
        self.changed[robot] = rule.moment.tick();
    }

    /// Gives each robot room for at least as many neighbours as `needed`, and for some more. All newcomers may count for it.
    fn make_room(&mut self, rule: &Rule<'_, D>, needed: impl Fn(&Self, usize) -> usize) {
        let (mut rows, mut starts, mut deal_starts) = (Rows::new(), vec![0], vec![0]);
        for robot in 0..self.counts.len() {
            let [start, deal_start] = [rows.mates.len(), rows.deals.len()];
            let [known, dealt] = [self.counts[robot], self.deal_counts[robot]].map(usize::from);
            let new = needed(self, robot).saturating_sub(known);
            rows.resize(
                [start + known + new + SPARE, deal_start + dealt + new + self.spare.deals()],
                &rule.moment,
            );
            let deals = self.deal_starts[robot] as usize..self.deal_starts[robot] as usize + dealt;
            rows.copy([start, deal_start], &self.rows, [self.range(robot), deals]);
            starts.push(u32::try_from(rows.mates.len()).unwrap_or(u32::MAX));
            deal_starts.push(u32::try_from(rows.deals.len()).unwrap_or(u32::MAX));
        }
        (self.rows, self.starts, self.deal_starts) = (rows, starts, deal_starts);
    }

    /// The neighbours of one robot.
    #[inline]
    pub(crate) fn of(&self, robot: usize) -> Others<'_, D> {
        let range = self.range(robot);
        Others { mates: &self.rows.mates[range], unseen: self.unseen_by(robot) }
    }

    /// How many neighbours each robot senses, and whether it does not sense one that must still be there.
    pub(crate) fn count(&self, degrees: &mut [u16], missing: &mut [bool]) {
        degrees.copy_from_slice(&self.counts);
        missing.fill(false);
        for ghost in &self.unseen {
            let robot = usize::from(ghost.robot);
            degrees[robot] -= 1;
            missing[robot] |= ghost.unseen.is_missing();
        }
    }

    /// Where the neighbours of one robot are.
    #[inline]
    pub(crate) fn range(&self, robot: usize) -> Range<usize> {
        let start = self.starts[robot] as usize;
        start..start + usize::from(self.counts[robot])
    }

    /// Where there is room for the neighbours of one robot.
    #[inline]
    pub(crate) fn room(&self, robot: usize) -> Range<usize> {
        self.starts[robot] as usize..self.starts[robot + 1] as usize
    }

    /// Where there is room for what a robot has agreed on with those that count for it.
    #[inline]
    pub(crate) fn deal_room(&self, robot: usize) -> Range<usize> {
        self.deal_starts[robot] as usize..self.deal_starts[robot + 1] as usize
    }

    /// Notes that a robot lists or holds others since this tick.
    pub(crate) fn has_changed(&mut self, robot: usize, moment: &Moment) {
        self.changed[robot] = moment.tick();
    }

    /// Marks the neighbours of a robot that have a row in this tick, and gives the neighbours with whether each is counted on and has a row.
    /// `None` if they are those of the tick before: what is held of a neighbour comes to the same from the second tick after a change on.
    pub(crate) fn mark(
        &mut self,
        robot: usize,
        moment: Moment,
    ) -> Option<impl Iterator<Item = (u16, [bool; 2])>> {
        let recent = self.changed[robot].saturating_add(1) >= moment.tick();
        let range = if recent { self.range(robot) } else { 0..0 };
        let lines = self.rows.mates[range.clone()].iter_mut().zip(&self.rows.bonds[range]);
        let marks = lines.map(move |(mate, bond)| {
            mate.active = bond.is_active(&moment);
            (mate.other, [bond.is_counted(&moment), mate.active])
        });
        recent.then_some(marks)
    }

    /// Takes out what robots hold, for whoever changes it and gives it back.
    pub(crate) fn take(&mut self) -> (Vec<Bond>, Vec<Deal>) {
        (core::mem::take(&mut self.rows.bonds), core::mem::take(&mut self.rows.deals))
    }

    /// Takes it back.
    pub(crate) fn give(&mut self, bonds: Vec<Bond>, deals: Vec<Deal>) {
        (self.rows.bonds, self.rows.deals) = (bonds, deals);
    }

    /// Speakers say to readers what is so now. All others say what they said before: two robots hold each other from the same
    /// tick on, and nothing is said then.
    pub(crate) fn exchange(&mut self, news: impl Iterator<Item = [u16; 2]>, moment: &Moment) {
        for [speaker, reader] in news {
            if let (Some(from), Some(to)) = (self.place(speaker, reader), self.place(reader, speaker)) {
                let said = self.rows.bonds[from].said();
                self.rows.bonds[to].hear(said);
                self.changed[usize::from(reader)] = moment.tick();
            }
        }
    }

    /// Where a neighbour of a robot is.
    fn place(&self, robot: u16, other: u16) -> Option<usize> {
        let range = self.range(usize::from(robot));
        let line = self.rows.mates[range.clone()].binary_search_by_key(&other, |mate| mate.other).ok()?;
        Some(range.start + line)
    }

    fn unseen_by(&self, robot: usize) -> &[Ghost<D>] {
        if self.unseen.is_empty() {
            return &[];
        }
        let from = self.unseen.partition_point(|ghost| usize::from(ghost.robot) < robot);
        let to = self.unseen.partition_point(|ghost| usize::from(ghost.robot) <= robot);
        &self.unseen[from..to]
    }
}

impl Rows {
    fn new() -> Self {
        Self { mates: Vec::new(), bonds: Vec::new(), deals: Vec::new() }
    }

    fn clear(&mut self) {
        self.mates.clear();
        self.bonds.clear();
        self.deals.clear();
    }

    fn push(&mut self, (mate, bond, deal): (Mate, Bond, Deal)) {
        self.mates.push(mate);
        self.bonds.push(bond);
        if mate.counts {
            self.deals.push(deal);
        }
    }

    /// Makes room for so many neighbours and deals.
    fn resize(&mut self, [lines, deals]: [usize; 2], moment: &Moment) {
        self.mates.resize(lines, Mate::default());
        self.bonds.resize(lines, Bond::new(moment));
        self.deals.resize(deals, Deal::default());
    }

    /// Copies neighbours and deals to where they begin.
    fn copy(&mut self, [start, deal_start]: [usize; 2], from: &Self, [lines, deals]: [Range<usize>; 2]) {
        let to = start..start + lines.len();
        self.mates[to.clone()].copy_from_slice(&from.mates[lines.clone()]);
        self.bonds[to].copy_from_slice(&from.bonds[lines]);
        self.deals[deal_start..deal_start + deals.len()].copy_from_slice(&from.deals[deals]);
    }

    /// Puts all of `from` where the neighbours and the deals of a robot begin.
    fn put(&mut self, starts: [usize; 2], from: &Self) {
        self.copy(starts, from, [0..from.mates.len(), 0..from.deals.len()]);
    }
}

impl<'a, const D: usize> Others<'a, D> {
    /// Where a neighbour was sensed last, if it is not sensed.
    #[inline]
    pub(crate) fn unseen(&self, other: u16) -> Option<&'a Unseen<D>> {
        if self.unseen.is_empty() {
            return None;
        }
        self.unseen.iter().find(|ghost| ghost.other == other).map(|ghost| &ghost.unseen)
    }

    /// Those that are sensed, each with whether it counts for the robot.
    #[inline]
    pub(crate) fn sensed(self) -> impl Iterator<Item = (usize, bool)> + 'a {
        let sensed = self.mates.iter().filter(move |mate| self.unseen(mate.other).is_none());
        sensed.map(|mate| (usize::from(mate.other), mate.counts))
    }
}

impl<const D: usize> Rule<'_, D> {
    /// A neighbour of a robot that has no row yet.
    fn mate(&self, robot: usize, other: u16) -> Mate {
        let (counts, back) =
            (self.roster.counts(robot, usize::from(other)), self.roster.counts(usize::from(other), robot));
        Mate { other, counts, mutual: counts && back, active: false }
    }

    /// True if a neighbour of a robot at `own_m` (m) that it does not sense keeps its place. What it told does not matter here.
    fn keeps(&self, (other, bond, deal): (u16, &Bond, &Deal), unseen: &Unseen<D>, own_m: &Vector<D>) -> bool {
        let member = self.roster.member(usize::from(other));
        let mut slot = Slot::default();
        bond.fill(&mut slot, deal, &self.moment, member, [0.0; D], &Voice::SILENCE);
        unseen.fill(&mut slot, own_m);
        self.controller.keeps_unseen(&slot)
    }
}

fn find<const D: usize>(unseen: &[Ghost<D>], robot: usize, other: u16) -> Option<Unseen<D>> {
    let ghost = unseen.iter().find(|ghost| (usize::from(ghost.robot), ghost.other) == (robot, other));
    ghost.map(|ghost| ghost.unseen)
}
