//! A held team of which many are computed side by side ([`lanes`](crate::engine::lanes::held)): what it takes over from there and gives back,
//! and what it does by itself in a tick in which who releases whom is known already.

use closeranks_core::controller::links::bond::{Bond, Deal, Moment, Voice};
use closeranks_core::controller::links::control::LinksController;
use closeranks_core::controller::links::lanes;
use closeranks_core::controller::links::rows::Beside;
use closeranks_core::controller::{Decision, Motion};
use closeranks_core::num::{Vector, subtract};
use closeranks_core::robot::scratch::Scratch;

use crate::attack::liars::Liars;
use crate::engine::dense::DENSE_MAX;
use crate::engine::held::lists::Lists;
use crate::engine::held::piece::Desk;
use crate::engine::held::{Held, Robots};
use crate::frame::Frame;

impl<const D: usize> Held<D> {
    /// Its controller if its robots can be computed side by side with those of other worlds.
    pub(crate) fn in_lanes(&self) -> Option<LinksController<D>> {
        let fits = (2..=DENSE_MAX).contains(&self.agreed.len()) && self.map.is_empty();
        self.team.controller.in_lanes().filter(|_| fits)
    }

    /// The tick that comes.
    pub(crate) fn moment(&self) -> Moment {
        Moment::new(self.tick, self.period_nanos)
    }

    /// True if every robot senses all those of whom it holds anything.
    pub(crate) fn are_all_sensed(&self) -> bool {
        self.team.lists.are_all_sensed()
    }

    /// What each robot holds of each neighbour.
    pub(crate) fn lines(&self) -> impl Iterator<Item = ([usize; 2], &Bond, &Deal)> + Clone {
        self.team.lists.lines()
    }

    /// What a promise of a robot costs, m.
    pub(crate) fn price_m(&self, robot: usize) -> f64 {
        self.team.voices[robot].price_m
    }

    /// Where a robot wants to go, m/s.
    pub(crate) fn wish_m_s(&self, robot: usize) -> Vector<D> {
        self.team.wishes_m_s[robot]
    }

    /// Takes back what robots hold of their neighbours, what they told all, and where they were in the tick before, m.
    pub(crate) fn take_back(
        &mut self,
        held: impl Fn([usize; 2]) -> (Bond, Deal),
        voice: impl Fn(usize) -> Voice<D>,
        before_m: &[Vector<D>],
    ) {
        let moment = self.moment();
        self.team.lists.replace(held, before_m, &moment);
        for (robot, place) in self.team.voices.iter_mut().enumerate() {
            *place = voice(robot);
        }
    }

    /// One tick in which nobody came into range or left it, and robots agreed on what they hold `of` others: fills everything in `frame` but
    /// positions, desired velocities, and on whom robots count, which is there.
    pub(crate) fn go_on(
        &mut self,
        frame: &mut Frame<D>,
        liars: &mut Liars,
        of: impl Fn(usize) -> lanes::Others,
    ) {
        liars.begin_tick(self.tick);
        self.tell(frame, liars);
        self.hold_round(frame, liars);
        let Self { team, desks, params, map, .. } = self;
        if desks.is_empty() {
            desks.push(Desk::new(params, frame.counted.len(), map));
        }
        let Some(desk) = desks.first_mut() else { return };
        let scratch = &mut desk.lend();
        for robot in 0..frame.counted.len() {
            let decision = team.decide_beside(robot, of(robot), frame, scratch);
            team.judged(robot, &decision, frame).write(robot, frame);
        }
        let input = params.settings().limits.input;
        for (wish_m_s, asked_m_s) in team.wishes_m_s.iter_mut().zip(&frame.asked_m_s) {
            *wish_m_s = input.clip(asked_m_s);
        }
        self.tick = self.tick.saturating_add(1);
    }
}

impl<const D: usize> Lists<D> {
    /// True if nobody keeps its place without being sensed.
    fn are_all_sensed(&self) -> bool {
        self.unseen.is_empty()
    }

    /// Each neighbour of each robot of a team in which everybody counts, with what the robot holds of it, robot after robot.
    fn lines(&self) -> impl Iterator<Item = ([usize; 2], &Bond, &Deal)> + Clone {
        let of = |robot: usize| {
            let places = self.range(robot).zip(self.deal_room(robot));
            places.map(move |(place, deal_place)| (robot, place, deal_place))
        };
        (0..self.counts.len()).flat_map(of).map(|(robot, place, deal_place)| {
            let (other, rows) = (usize::from(self.rows.mates[place].other), &self.rows);
            ([robot, other], &rows.bonds[place], &rows.deals[deal_place])
        })
    }

    /// Replaces what each robot holds of each of its neighbours before the tick of `moment`, and takes where everybody was in the tick before, m.
    fn replace(
        &mut self,
        held: impl Fn([usize; 2]) -> (Bond, Deal),
        before_m: &[Vector<D>],
        moment: &Moment,
    ) {
        for robot in 0..self.counts.len() {
            for (place, deal_place) in self.range(robot).zip(self.deal_room(robot)) {
                let other = usize::from(self.rows.mates[place].other);
                (self.rows.bonds[place], self.rows.deals[deal_place]) = held([robot, other]);
            }
        }
        self.before_m.copy_from_slice(before_m);
        self.changed.fill(moment.tick());
    }
}

impl<const D: usize> Robots<D> {
    /// The decision of a robot whose move is bounded by nobody but those near it.
    fn decide_beside(
        &self,
        robot: usize,
        others: lanes::Others,
        frame: &Frame<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decision<D> {
        let own_m = &frame.positions_m[robot];
        let offset_m = |other: usize| subtract(own_m, &frame.positions_m[other]);
        let beside = each(others.near).map(|other| Beside {
            offset_m: offset_m(other),
            gone_m: 0.0,
            sensed: true,
            active: others.active >> other & 1 == 1,
        });
        let heard = each(others.near).map(|other| (offset_m(other), &self.wishes_m_s[other]));
        let desired_m_s = self.controller.links.turned(&frame.asked_m_s[robot], heard);
        let motion = Motion { position_m: *own_m, desired_m_s, before_m_s: frame.velocities_m_s[robot] };
        let counted = frame.counted[robot].len();
        self.controller.decide(self.roster.member(robot), counted, beside, &motion, scratch)
    }
}

/// Those whose bit is set, in order of their numbers.
#[inline]
pub(crate) fn each(mut bits: u64) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let next = bits.trailing_zeros() as usize;
        bits &= bits.wrapping_sub(1);
        (next < 64).then_some(next)
    })
}
