//! What a robot and a neighbour have agreed on: promises, and how long they last.

use crate::num::{cut, larger};

/// By how much an engaged pair is preferred, m.
const GRACE_M: f64 = 0.1;
/// A promise unused for so long lapses, s; for so long, s; what it was unused is forgotten at this rate, 1/s.
const LAPSE_S: f64 = 3.0;
const LAPSED_S: f64 = 20.0;
const FORGET_PER_S: f64 = 0.1;
/// Who does not let go is barred for so long, s, twice as long each time, up to a limit.
const BAR_S: f64 = 2.0;
const BAR_MAX_S: f64 = 1_000.0;

/// What a robot and a neighbour have agreed on. Only the rule who releases whom looks into it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "five facts, each with its own life")]
pub struct Deal {
    /// V_ij, m; of use only in the tick in which it was computed.
    pub(super) gain_m: f64,
    /// True if the neighbour is promised a release.
    pub(crate) promised: bool,
    /// True if it promises one too.
    pub(super) engaged: bool,
    pub(super) eligible: bool,
    pub(super) stretched: bool,
    /// True if it was released, and not listed since.
    pub(super) released: bool,
    /// How long the promise was of no use, s, and how long it is lapsed yet.
    pub(super) unused_s: f64,
    pub(super) lapsed_s: f64,
    /// How long it is barred yet, s, and how long it was the last time.
    pub(super) barred_s: f64,
    pub(super) bar_s: f64,
    /// Ticks in which it listed the robot that had stopped listing it.
    pub(super) waiting_ticks: u32,
}

impl Deal {
    /// V with what is added for a pair that is engaged, m.
    #[inline]
    pub(super) fn key_m(&self) -> f64 {
        self.gain_m + if self.engaged { GRACE_M } else { 0.0 }
    }

    /// Takes in how far apart both would end, m, whether the link is `stretched`, whether the neighbour has `promised` a release, and at
    /// which price, m. It may be promised one only if it is sensed and counts, as `may` says.
    #[inline]
    pub(super) fn weigh(&mut self, gain_m: f64, stretched: bool, promised: bool, price_m: f64, may: bool) {
        self.gain_m = gain_m;
        self.engaged = self.promised && promised;
        self.stretched = stretched;
        let usable = self.barred_s <= 0.0 && (self.stretched || self.lapsed_s <= 0.0);
        self.eligible = may && usable && self.key_m() >= price_m;
    }

    /// The share of what a promise was unused that is forgotten in this time.
    pub(super) fn forgotten(elapsed_s: f64) -> f64 {
        cut(FORGET_PER_S * elapsed_s, 0.0, 1.0)
    }

    /// Lets time pass, in which the share `forgotten` is [`forgotten`](Self::forgotten).
    #[inline]
    pub(super) fn pass(&mut self, elapsed_s: f64, forgotten: f64) {
        self.lapsed_s = larger(self.lapsed_s - elapsed_s, 0.0);
        self.barred_s = larger(self.barred_s - elapsed_s, 0.0);
        if self.engaged && !self.stretched {
            self.unused_s += elapsed_s;
        } else {
            self.unused_s -= self.unused_s * forgotten;
        }
        if self.unused_s > LAPSE_S {
            (self.lapsed_s, self.unused_s) = (LAPSED_S, 0.0);
        }
    }

    pub(super) fn bar(&mut self) {
        self.bar_s = if self.bar_s > 0.0 { (2.0 * self.bar_s).min(BAR_MAX_S) } else { BAR_S };
        self.barred_s = self.bar_s;
    }
}
