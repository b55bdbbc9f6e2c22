//! The neighbours of all robots in one list, each with what the robot holds of it.

use core::ops::Range;

use closeranks_core::controller::Control;
use closeranks_core::controller::links::bond::{Bond, Deal, Moment, Unseen, Voice};
use closeranks_core::controller::links::control::LinksController;
use closeranks_core::num::{Vector, dot, subtract};
use closeranks_core::robot::missing::Horizon;
use closeranks_core::robot::neighbor::Slot;

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
    counts: Vec<u16>,
    rows: Rows<D>,
    /// Those that are not sensed and keep their place, in the same order. There are hardly ever any.
    unseen: Vec<Ghost<D>>,
    unseen_before: Vec<Ghost<D>>,
    /// Of each robot the squared distance to whoever is nearest to it, m²; infinite if nobody is near.
    nearest_m2: Vec<f64>,
    /// Where robots were in the tick before, m.
    before_m: Vec<Vector<D>>,
    crowd: Crowd,
    /// Memory for the neighbours of one robot, and for those that it senses.
    fresh: Rows<D>,
    near: Vec<u16>,
}

/// One line a neighbour.
#[derive(Clone, Debug)]
struct Rows<const D: usize> {
    others: Vec<u16>,
    /// True of those that count for the robot.
    counts: Vec<bool>,
    /// x_i − x_j, m, as sensed last.
    offsets_m: Vec<Vector<D>>,
    bonds: Vec<Bond>,
    deals: Vec<Deal>,
}

/// A neighbour of a robot that the robot does not sense.
#[derive(Clone, Copy, Debug)]
struct Ghost<const D: usize> {
    robot: u16,
    other: u16,
    unseen: Unseen<D>,
}

/// The neighbours of one robot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Others<'a, const D: usize> {
    pub(crate) numbers: &'a [u16],
    /// True of those that count for the robot.
    pub(crate) counts: &'a [bool],
    /// x_i − x_j, m, as sensed last.
    pub(crate) offsets_m: &'a [Vector<D>],
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
            rows: Rows::new(),
            unseen: Vec::new(),
            unseen_before: Vec::new(),
            nearest_m2: vec![f64::INFINITY; robots],
            before_m: vec![[0.0; D]; robots],
            crowd: Crowd::default(),
            fresh: Rows::new(),
            near: Vec::new(),
        }
    }

    /// Robots at `positions_m` look around as far as `radius_m`.
    pub(crate) fn look(&mut self, positions_m: &[Vector<D>], radius_m: f64, rule: &Rule<'_, D>) {
        self.crowd.split(positions_m, radius_m);
        self.crowd.count(positions_m);
        let counts = self.crowd.counts();
        if (0..counts.len()).any(|robot| usize::from(counts[robot]) > self.room(robot).len()) {
            self.make_room(rule, |lists, robot| usize::from(lists.crowd.counts()[robot]));
        }
        core::mem::swap(&mut self.unseen, &mut self.unseen_before);
        self.unseen.clear();
        for robot in 0..positions_m.len() {
            let same = self.measure(robot, positions_m, radius_m * radius_m);
            if !same || !self.unseen_before.is_empty() {
                self.merge(robot, positions_m, rule);
                self.put(robot, rule);
                self.measure(robot, positions_m, radius_m * radius_m);
            }
        }
        self.measure_unseen(positions_m);
        self.before_m.copy_from_slice(positions_m);
    }

    /// Measures where the neighbours of one robot are. True if they are those that it senses: all of them, and nobody else.
    fn measure(&mut self, robot: usize, positions_m: &[Vector<D>], radius_m2: f64) -> bool {
        let (range, own_m) = (self.range(robot), &positions_m[robot]);
        let mut same = range.len() == usize::from(self.crowd.counts()[robot]);
        let offsets_m = &mut self.rows.offsets_m[range.clone()];
        let mut nearest_m2 = f64::INFINITY;
        for (offset_m, other) in offsets_m.iter_mut().zip(&self.rows.others[range]) {
            *offset_m = subtract(own_m, &positions_m[usize::from(*other)]);
            let square_m2 = dot(offset_m, offset_m);
            same &= radius_m2 - square_m2 >= 0.0;
            nearest_m2 = if square_m2 < nearest_m2 { square_m2 } else { nearest_m2 };
        }
        self.nearest_m2[robot] = nearest_m2;
        same
    }

    /// Measures where neighbours were that are not sensed.
    fn measure_unseen(&mut self, positions_m: &[Vector<D>]) {
        for Ghost { robot, other, unseen } in &self.unseen {
            if let Some(place) = self.place(*robot, *other) {
                self.rows.offsets_m[place] = unseen.offset_m(&positions_m[usize::from(*robot)]);
            }
        }
    }

    /// Collects the neighbours of one robot where some came or left.
    fn merge(&mut self, robot: usize, positions_m: &[Vector<D>], rule: &Rule<'_, D>) {
        let counts = |other: u16| (other, rule.roster.counts(robot, usize::from(other)));
        self.fresh.clear();
        self.crowd.around(robot, positions_m, &mut self.near);
        let mut near = self.near.iter().copied().peekable();
        for place in self.range(robot) {
            let (other, bond, deal) = self.rows.line(place);
            while let Some(new) = near.next_if(|near| *near < other) {
                self.fresh.push(counts(new), Bond::new(&rule.moment), Deal::default());
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
            self.fresh.push(counts(other), bond, deal);
        }
        for new in near {
            self.fresh.push(counts(new), Bond::new(&rule.moment), Deal::default());
        }
    }

    /// Puts those that were collected where the neighbours of one robot are.
    fn put(&mut self, robot: usize, rule: &Rule<'_, D>) {
        let count = self.fresh.others.len();
        if count > self.room(robot).len() {
            self.make_room(
                rule,
                |lists, other| if other == robot { count } else { usize::from(lists.counts[other]) },
            );
        }
        self.rows.put(self.starts[robot] as usize, &self.fresh);
        self.counts[robot] = small(count);
    }

    /// Gives each robot room for at least as many neighbours as `needed`, and for some more.
    fn make_room(&mut self, rule: &Rule<'_, D>, needed: impl Fn(&Self, usize) -> usize) {
        let (mut rows, mut starts) = (Rows::new(), vec![0]);
        for robot in 0..self.counts.len() {
            let start = rows.others.len();
            let room = needed(self, robot).max(usize::from(self.counts[robot])) + SPARE;
            rows.resize(start + room, &rule.moment);
            rows.copy(start, &self.rows, self.range(robot));
            starts.push(u32::try_from(rows.others.len()).unwrap_or(u32::MAX));
        }
        (self.rows, self.starts) = (rows, starts);
    }

    /// The neighbours of one robot.
    #[inline]
    pub(crate) fn of(&self, robot: usize) -> Others<'_, D> {
        let range = self.range(robot);
        let (numbers, counts) = (&self.rows.others[range.clone()], &self.rows.counts[range.clone()]);
        Others { numbers, counts, offsets_m: &self.rows.offsets_m[range], unseen: self.unseen_by(robot) }
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

    /// The squared distance to whoever is nearest to a robot, m².
    #[inline]
    pub(crate) fn nearest_m2(&self, robot: usize) -> f64 {
        self.nearest_m2[robot]
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

    /// What a robot holds of each neighbour.
    #[inline]
    pub(crate) fn bonds(&self, robot: usize) -> &[Bond] {
        &self.rows.bonds[self.range(robot)]
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
    pub(crate) fn exchange(&mut self, news: impl Iterator<Item = [u16; 2]>) {
        for [speaker, reader] in news {
            if let (Some(from), Some(to)) = (self.place(speaker, reader), self.place(reader, speaker)) {
                let said = self.rows.bonds[from].said();
                self.rows.bonds[to].hear(said);
            }
        }
    }

    /// Where a neighbour of a robot is.
    fn place(&self, robot: u16, other: u16) -> Option<usize> {
        let range = self.range(usize::from(robot));
        let line = self.rows.others[range.clone()].binary_search(&other).ok()?;
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

impl<const D: usize> Rows<D> {
    fn new() -> Self {
        Self {
            others: Vec::new(),
            counts: Vec::new(),
            offsets_m: Vec::new(),
            bonds: Vec::new(),
            deals: Vec::new(),
        }
    }

    fn clear(&mut self) {
        self.others.clear();
        self.counts.clear();
        self.offsets_m.clear();
        self.bonds.clear();
        self.deals.clear();
    }

    fn push(&mut self, (other, counts): (u16, bool), bond: Bond, deal: Deal) {
        self.others.push(other);
        self.counts.push(counts);
        self.offsets_m.push([0.0; D]);
        self.bonds.push(bond);
        self.deals.push(deal);
    }

    fn line(&self, place: usize) -> (u16, Bond, Deal) {
        (self.others[place], self.bonds[place], self.deals[place])
    }

    fn resize(&mut self, lines: usize, moment: &Moment) {
        self.others.resize(lines, 0);
        self.counts.resize(lines, false);
        self.offsets_m.resize(lines, [0.0; D]);
        self.bonds.resize(lines, Bond::new(moment));
        self.deals.resize(lines, Deal::default());
    }

    fn copy(&mut self, start: usize, from: &Self, range: Range<usize>) {
        let to = start..start + range.len();
        self.others[to.clone()].copy_from_slice(&from.others[range.clone()]);
        self.counts[to.clone()].copy_from_slice(&from.counts[range.clone()]);
        self.offsets_m[to.clone()].copy_from_slice(&from.offsets_m[range.clone()]);
        self.bonds[to.clone()].copy_from_slice(&from.bonds[range.clone()]);
        self.deals[to].copy_from_slice(&from.deals[range]);
    }

    fn put(&mut self, start: usize, from: &Self) {
        self.copy(start, from, 0..from.others.len());
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

    /// Those that are sensed.
    #[inline]
    pub(crate) fn sensed(self) -> impl Iterator<Item = usize> + 'a {
        self.numbers
            .iter()
            .filter(move |other| self.unseen(**other).is_none())
            .map(|other| usize::from(*other))
    }
}

impl<const D: usize> Rule<'_, D> {
    /// True if a neighbour of a robot at `own_m` (m) that it does not sense keeps its place. What it told does not matter here.
    fn keeps(&self, (other, bond, deal): (u16, &Bond, &Deal), unseen: &Unseen<D>, own_m: &Vector<D>) -> bool {
        let silent = Voice { price_m: 0.0, wish_m_s: [0.0; D] };
        let member = self.roster.member(usize::from(other));
        let mut slot = Slot::default();
        bond.fill(&mut slot, deal, &self.moment, member, [0.0; D], &silent);
        unseen.fill(&mut slot, own_m);
        self.controller.keeps_unseen(&slot)
    }
}

fn find<const D: usize>(unseen: &[Ghost<D>], robot: usize, other: u16) -> Option<Unseen<D>> {
    let ghost = unseen.iter().find(|ghost| (usize::from(ghost.robot), ghost.other) == (robot, other));
    ghost.map(|ghost| ghost.unseen)
}
