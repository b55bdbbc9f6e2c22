//! The rule who releases whom for whoever computes a large team at once: a neighbour is a [`Bond`] with a [`Deal`] and what it says to all, in a
//! sixth of the memory of a slot.

use core::time::Duration;

use crate::controller::links::Links;
use crate::controller::links::bond::{Bond, Deal, Look, Moment, NEVER, Unseen, Voice};
use crate::controller::links::control::LinksController;
use crate::controller::links::partner::{Offer, Partner};
use crate::controller::links::peer::Ledger;
use crate::controller::links::protocol::Number;
use crate::id::{Member, RobotId};
use crate::need::Need;
use crate::num::Vector;
use crate::time::Instant;

/// A neighbour before the messages of a tick.
#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "what a hold says, asked for once")]
pub struct Line<'a, const D: usize> {
    member: Member,
    /// True if the robot counts for it too.
    mutual: bool,
    offset_m: Vector<D>,
    voice: &'a Voice<D>,
    bond: &'a mut Bond,
    deal: &'a mut Deal,
    look: Look,
    tick: u32,
    /// True if what it says was told in the tick before, and that is no longer ago than counts.
    told: bool,
    acknowledges: bool,
    released: bool,
    lists: bool,
    /// What was held of it in the tick before.
    before: Bond,
    /// If it is not sensed.
    unseen: Option<&'a Unseen<D>>,
}

impl<'a, const D: usize> Line<'a, D> {
    /// Of the neighbour `member` at `offset_m` (m), as sensed last, of which a robot holds `bond` and `deal`. The neighbour counts for the robot, and
    /// the robot for it too if that is `mutual`. `voice` is what it said to all in the tick before, and `unseen` says more if it is not sensed now.
    #[inline]
    #[must_use]
    pub fn new(
        (member, mutual): (Member, bool),
        offset_m: Vector<D>,
        (bond, deal): (&'a mut Bond, &'a mut Deal),
        voice: &'a Voice<D>,
        unseen: Option<&'a Unseen<D>>,
        moment: &Moment,
    ) -> Self {
        let (hold, tick) = (bond.hold(moment.tick), moment.tick);
        let told = moment.told && bond.born < tick;
        let (acknowledges, released, lists) = (hold.counts(), hold.is_released(), hold.lists());
        let before = *bond;
        Self {
            member,
            mutual,
            offset_m,
            voice,
            bond,
            deal,
            look: Look::default(),
            tick,
            told,
            acknowledges,
            released,
            lists,
            before,
            unseen,
        }
    }

    /// This neighbour once a robot has looked at it.
    #[must_use]
    pub fn looked_at(self, look: Look) -> Self {
        Self { look, ..self }
    }

    /// True if it is listed or held, and was not in the tick before, or the other way round.
    #[inline]
    fn has_changed(&self) -> bool {
        (self.bond.listed, self.bond.held) != (self.before.listed, self.before.held)
    }
}

impl<const D: usize> Partner<D> for Line<'_, D> {
    #[inline]
    fn member(&self) -> Member {
        self.member
    }

    #[inline]
    fn counts_with(&self, _own: Member, _need: &Need) -> [bool; 2] {
        [true, self.mutual]
    }

    #[inline]
    fn offset_m(&self) -> &Vector<D> {
        &self.offset_m
    }

    #[inline]
    fn is_sensed(&self) -> bool {
        self.unseen.is_none()
    }

    #[inline]
    fn unseen_ticks(&self) -> u32 {
        self.unseen.map_or(0, |unseen| unseen.ticks)
    }

    #[inline]
    fn gone_m(&self) -> f64 {
        self.unseen.map_or(0.0, |unseen| unseen.gone_m)
    }

    #[inline]
    fn was_sensed_within(&self, most: Duration, now: Instant) -> bool {
        self.unseen.is_none_or(|unseen| now.is_within(most, unseen.sensed_at))
    }

    #[inline]
    fn told(&self, _links: &Links, _now: Instant) -> Option<Offer<D>> {
        let Voice { price_m, capped_m_s: wish_m_s, .. } = *self.voice;
        self.told.then_some(Offer { price_m, wish_m_s, promised: self.bond.their.promised })
    }

    #[inline]
    fn acknowledges(&self) -> bool {
        self.acknowledges
    }

    #[inline]
    fn is_listed(&self) -> bool {
        self.bond.listed != NEVER
    }

    #[inline]
    fn is_released(&self) -> bool {
        self.released
    }

    #[inline]
    fn lists(&self) -> bool {
        self.lists
    }

    #[inline]
    fn list(&mut self, _last: Number) {
        if self.bond.listed == NEVER {
            self.bond.listed = self.tick;
            self.acknowledges = false;
        }
    }

    #[inline]
    fn release(&mut self) {
        self.bond.listed = NEVER;
        self.acknowledges = false;
    }

    #[inline]
    fn is_held(&self) -> bool {
        self.bond.held
    }

    #[inline]
    fn hold(&mut self, held: bool) {
        self.bond.held = held;
    }

    #[inline]
    fn is_promised(&self) -> bool {
        self.bond.promised
    }

    #[inline]
    fn promise(&mut self, promised: bool) {
        self.bond.promised = promised;
    }

    #[inline]
    fn deal(&self) -> &Deal {
        self.deal
    }

    #[inline]
    fn deal_mut(&mut self) -> &mut Deal {
        self.deal
    }

    #[inline]
    fn look(&self) -> &Look {
        &self.look
    }

    #[inline]
    fn look_mut(&mut self) -> &mut Look {
        &mut self.look
    }
}

/// What a robot has agreed on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// What a promise of it costs, m.
    pub price_m: f64,
    /// True if it lists or holds others than in the tick before.
    pub changed: bool,
}

impl<const D: usize> LinksController<D> {
    /// What a robot says to all that asks `price_m` (m) for a promise and wants to go with `wish_m_s` (m/s).
    #[must_use]
    pub fn voice(&self, price_m: f64, wish_m_s: Vector<D>) -> Voice<D> {
        Voice { price_m, wish_m_s, capped_m_s: self.links.capped(&wish_m_s) }
    }

    /// Decides whom robot `own` lists and promises something, who wants to go with `wish_m_s`, as a robot on its own does before it tells. `values`
    /// has a number a line, and `tell` is called with every robot to which something else is to be said than in the tick before. Nothing becomes of
    /// neighbours that do not count for `own`, so there are no lines of them.
    pub fn agree_at_once(
        &self,
        own: Member,
        moment: &Moment,
        wish_m_s: &Vector<D>,
        (lines, values): (&mut [Line<'_, D>], &mut [f64]),
        mut tell: impl FnMut(RobotId),
    ) -> Agreement {
        let looked_at = moment.before().map(|before| before.now());
        let mut ledger =
            Ledger { wish_m_s: *wish_m_s, looked_at, ..Ledger::begin(Moment::last(moment.tick)) };
        self.links.agree(own, &mut ledger, lines, moment.now(), values);
        let mut changed = false;
        for line in lines {
            changed |= line.has_changed();
            if line.bond.said() != line.before.said() {
                tell(line.member.id);
            }
        }
        Agreement { price_m: ledger.price_m, changed }
    }

    /// The end of [`agree_at_once`](Self::agree_at_once) for whoever has looked at everybody and made all promises in another way: decides whom
    /// robot `own`, which counts on so many, releases and lists.
    pub fn part_at_once(&self, own: Member, moment: &Moment, lines: &mut [Line<'_, D>], counted: usize) {
        self.links.part_and_list(own, lines, Moment::last(moment.tick), (false, counted));
    }
}
