//! What a robot and a neighbour have agreed on: what lasts from tick to tick, and what comes of a look at the neighbour.

use crate::num::{cut, larger};

/// By how much an engaged pair is preferred, m.
const GRACE_M: f64 = 0.1;
/// A promise unused for so long lapses, s; for so long, s; what it was unused is forgotten at this rate, 1/s.
const LAPSE_S: f64 = 3.0;
const LAPSED_S: f64 = 20.0;
const FORGET_PER_S: f64 = 0.1;
/// Who does not let go is barred for so long, s, twice as long each time, up to a limit.
const BAR_S: f32 = 2.0;
const BAR_MAX_S: f32 = 1_000.0;

/// What a robot and a neighbour have agreed on, but for promises. Only the rule who releases whom looks into it.
///
/// A large team reads all of them in every tick, so they are small: two of them fill 64 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deal {
    /// How long a promise was of no use, s, and how long it is lapsed yet.
    pub(super) unused_s: f64,
    pub(super) lapsed_s: f64,
    /// How long the neighbour is barred yet, s, and how long it was the last time.
    pub(super) barred_s: f64,
    pub(super) bar_s: f32,
    /// Ticks in which it listed the robot that had stopped listing it, counted as far as a `u16` goes.
    pub(super) waiting_ticks: u16,
    /// True if it was released, and not listed since.
    pub(super) released: bool,
}

/// What comes of a look at a neighbour in a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Look {
    /// V_ij, m.
    pub(super) gain_m: f64,
    /// True if both promise each other a release.
    pub(super) engaged: bool,
    /// True if the neighbour may be promised one.
    pub(super) eligible: bool,
    /// True if the link is long enough to be released.
    pub(super) stretched: bool,
}

impl Look {
    /// How far apart both would end, m, whether the link is `stretched` and the pair `engaged`, and at which price, m, the neighbour promises a release. It may
    /// be promised one only if it is `open` for one.
    #[inline]
    pub(super) fn new(gain_m: f64, [stretched, engaged]: [bool; 2], price_m: f64, open: bool) -> Self {
        let look = Self { gain_m, engaged, eligible: false, stretched };
        Self { eligible: open && look.key_m() >= price_m, ..look }
    }

    /// V with what is added for a pair that is engaged, m.
    #[inline]
    pub(super) fn key_m(&self) -> f64 {
        self.gain_m + if self.engaged { GRACE_M } else { 0.0 }
    }
}

impl Deal {
    /// True if the neighbour is not barred, and the promise has not lapsed or the link is stretched.
    #[inline]
    pub(super) fn is_open(&self, stretched: bool) -> bool {
        self.barred_s <= 0.0 && (stretched || self.lapsed_s <= 0.0)
    }

    /// The fraction of what a promise was unused that is forgotten in this time.
    pub(super) fn forgotten(elapsed_s: f64) -> f64 {
        cut(FORGET_PER_S * elapsed_s, 0.0, 1.0)
    }

    /// Lets time pass, in which the fraction `forgotten` is [`forgotten`](Self::forgotten), after this `look` at the neighbour.
    #[inline]
    pub(super) fn pass(&mut self, elapsed_s: f64, forgotten: f64, look: &Look) {
        self.lapsed_s = larger(self.lapsed_s - elapsed_s, 0.0);
        self.barred_s = larger(self.barred_s - elapsed_s, 0.0);
        if look.engaged && !look.stretched {
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
        self.barred_s = f64::from(self.bar_s);
    }
}
