//! What a robot holds of a neighbour in every lane, and how it comes from a [`Bond`] with a [`Deal`] and becomes one.

use crate::controller::links::bond::{Bond, NEVER, Said};
use crate::controller::links::deal::{Deal, Look};
use crate::controller::links::lanes::{LookInLanes, MomentInLanes, VoiceInLanes};
use crate::num::lane::{LANES, Lane, fact, is_so};

/// What a robot holds of a neighbour from tick to tick, but for what both say to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndInLanes {
    /// The tick since which it is listed.
    pub(super) listed: Lane,
    /// Facts.
    pub(super) held: Lane,
    released: Lane,
    /// s.
    unused_s: Lane,
    lapsed_s: Lane,
    barred_s: Lane,
    bar_s: Lane,
    pub(super) waiting_ticks: Lane,
}

/// What a robot says to a neighbour, as facts in every lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SaidInLanes {
    pub(super) listed: Lane,
    pub(super) promised: Lane,
}

/// What a hold says before the messages of a tick ([`Hold`](crate::controller::links::protocol::Hold)).
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    pub(super) acknowledges: bool,
    pub(super) released: bool,
}

impl SaidInLanes {
    /// Nothing was said.
    pub const NOTHING: Self = Self { listed: [0.0; LANES], promised: [0.0; LANES] };

    /// Nothing is said in a lane.
    pub fn clear(&mut self, lane: usize) {
        self.put(lane, Said::default());
    }

    /// Takes what a bond says in a lane.
    pub fn put(&mut self, lane: usize, said: Said) {
        (self.listed[lane], self.promised[lane]) = (fact(said.listed), fact(said.promised));
    }

    /// What is said in a lane.
    #[must_use]
    pub fn of(&self, lane: usize) -> Said {
        Said { listed: is_so(self.listed[lane]), promised: is_so(self.promised[lane]) }
    }
}

impl EndInLanes {
    /// Of a neighbour that is not there, or just came.
    pub const NONE: Self = Self {
        listed: [never(); LANES],
        held: [0.0; LANES],
        released: [0.0; LANES],
        unused_s: [0.0; LANES],
        lapsed_s: [0.0; LANES],
        barred_s: [0.0; LANES],
        bar_s: [0.0; LANES],
        waiting_ticks: [0.0; LANES],
    };

    /// Nothing is held in a lane.
    pub fn clear(&mut self, lane: usize) {
        (self.listed[lane], self.held[lane], self.released[lane]) = (never(), 0.0, 0.0);
        (self.waiting_ticks[lane], self.bar_s[lane]) = (0.0, 0.0);
        self.pass(lane, &Deal::default());
    }

    /// Takes what a robot holds in one world.
    pub fn put(&mut self, lane: usize, bond: &Bond, deal: &Deal) {
        self.listed[lane] = f64::from(bond.listed);
        self.held[lane] = fact(bond.held);
        self.released[lane] = fact(deal.released);
        self.waiting_ticks[lane] = f64::from(deal.waiting_ticks);
        self.bar_s[lane] = f64::from(deal.bar_s);
        self.pass(lane, deal);
    }

    /// What a robot holds in one world of a neighbour that came in the tick `born`, and what was said: by itself, and to it.
    #[must_use]
    pub fn of(&self, lane: usize, born: f64, [says, hears]: [&SaidInLanes; 2]) -> (Bond, Deal) {
        let promised = is_so(says.promised[lane]);
        let bond = Bond {
            born: whole(born),
            listed: whole(self.listed[lane]),
            held: is_so(self.held[lane]),
            promised,
            their: hears.of(lane),
        };
        let deal = Deal {
            released: is_so(self.released[lane]),
            waiting_ticks: few(self.waiting_ticks[lane]),
            bar_s: short_s(self.bar_s[lane]),
            ..self.times(lane)
        };
        (bond, deal)
    }

    /// Gives what [`of`](Self::of) gives in the midst of a tick, after a `look` at the neighbour.
    #[must_use]
    pub fn line(
        &self,
        lane: usize,
        born: f64,
        [says, hears]: [&SaidInLanes; 2],
        look: &LookInLanes,
    ) -> (Bond, Deal, Look) {
        let (bond, deal) = self.of(lane, born, [says, hears]);
        (bond, deal, look.of(lane))
    }

    /// The times of a deal in a lane.
    #[inline]
    pub(super) fn times(&self, lane: usize) -> Deal {
        Deal {
            unused_s: self.unused_s[lane],
            lapsed_s: self.lapsed_s[lane],
            barred_s: self.barred_s[lane],
            ..Deal::default()
        }
    }

    /// Takes the times of a deal that pass.
    #[inline]
    pub(super) fn pass(&mut self, lane: usize, deal: &Deal) {
        self.unused_s[lane] = deal.unused_s;
        self.lapsed_s[lane] = deal.lapsed_s;
        self.barred_s[lane] = deal.barred_s;
    }

    /// What is known before the messages of `tick` of a neighbour that came before it, in the tick `born`; as [`Bond::hold`] has it.
    #[inline]
    pub(super) fn known(&self, lane: usize, born: f64, hears: &SaidInLanes, tick: f64) -> Known {
        let answered = born < tick - 1.0;
        let acknowledged = if answered { tick - 1.0 } else { 0.0 };
        let silent = !is_so(hears.listed[lane]);
        Known { acknowledges: self.listed[lane] < acknowledged, released: answered & silent }
    }

    /// True if it is counted on, once the messages of this tick are there.
    #[inline]
    pub(super) fn is_counted(&self, lane: usize, time: &MomentInLanes) -> bool {
        let (held, before) = (is_so(self.held[lane]), self.listed[lane] < time.tick);
        held & before
    }

    /// True if the neighbour is listed.
    #[inline]
    pub(super) fn is_listed(&self, lane: usize) -> bool {
        self.listed[lane] < never()
    }
}

impl<const D: usize> VoiceInLanes<D> {
    /// Of robots that said nothing.
    pub const SILENCE: Self = Self { prices_m: [f64::INFINITY; LANES], wishes_m_s: [[0.0; LANES]; D] };
}

/// A tick that never was, among the others.
const fn never() -> f64 {
    NEVER as f64
}

/// A tick, or how many they were.
fn whole(ticks: f64) -> u32 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it was one before")]
    let ticks = ticks as u32;
    ticks
}

/// How many ticks a neighbour waited.
fn few(ticks: f64) -> u16 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it was one before")]
    let ticks = ticks as u16;
    ticks
}

/// How long a neighbour was barred, s.
fn short_s(bar_s: f64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "it was one before")]
    let bar_s = bar_s as f32;
    bar_s
}
