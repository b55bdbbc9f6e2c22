//! Who releases whom: the rule "reserve". It decides how far a team gets, and uses whatever is told.
//!
//! A robot has so many slots as robots in range can be counted beyond what it must keep, and promises them to those with whom it
//! would end farthest apart if both got their wish for [`Links::horizon_s`]. A pair that promised each other is *engaged*. It
//! is released once it is stretched, and what is near is listed again:
//!
//! ```text
//! V_ij      = |x_i − x_j + H (w_i − w_j)|
//! eligible  = in range, heard of late, V_ij ≥ price_j, not barred, stretched or not lapsed
//! promise_i = the b_i largest V among the eligible, with `GRACE_M` more for who is engaged
//! price_i   = the least V of the engaged if all b_i are engaged; 0 if slots are left; ∞ if b_i = 0
//! release   = engaged, listed and stretched j, largest V first, while more are counted on than must be
//! ```
//!
//! Who counts on too few, as whoever begins anew does, releases nobody and lists everybody who may be in range. This alone is no matter of
//! taste: thm:anew rests on it.
//!
//! A promise that is of no use for a while lapses. Who goes on listing a robot that has stopped listing it is listed again, because
//! its row is active anyway, and is barred for a time that doubles.

use crate::controller::links::Links;
use crate::controller::links::deal::{Deal, Look};
use crate::controller::links::partner::Partner;
use crate::controller::links::peer::Ledger;
use crate::controller::links::protocol::Number;
use crate::id::Member;
use crate::num::{Vector, add_scaled, dot, length, sqrt, subtract};
use crate::time::Instant;

/// A pair is released beyond this fraction of the held radius, and listed again below the other.
const STRETCHED: f64 = 0.95;
const NEAR: f64 = 0.85;
/// So is a pair whose link has less room than this fraction of the held radius beside what would cut it, and listed above the other.
const TIGHT: f64 = 0.05;
const WIDE: f64 = 0.15;
/// So many ticks a neighbour has time to follow a release.
const PATIENCE_TICKS: u16 = 10;
/// No more time than this passes between two looks, s.
pub(super) const STEP_MAX_S: f64 = 1.0;

/// Up to so many keys are put in order one by one.
const FEW: usize = 16;

/// Who passes to the right looks so many Δ_d ahead; the cosine of 45 degrees.
const PASS_DISTANCES: f64 = 1.2;
const COS_45: f64 = core::f64::consts::FRAC_1_SQRT_2;
/// Cosine and sine of the angle by which a tie is broken.
const TIE: [f64; 2] = [0.999_800_006_666_577_8, 0.019_998_666_693_333_08];

impl Links {
    /// Decides whom robot `own` lists from now on of those that are its `partners`, and what it promises. `values` is scratch, one
    /// number for each.
    pub(crate) fn agree<const D: usize, P: Partner<D>>(
        &self,
        own: Member,
        ledger: &mut Ledger<D>,
        partners: &mut [P],
        now: Instant,
        values: &mut [f64],
    ) {
        let elapsed_s = ledger.looked_at.map_or(0.0, |then| now.since(then).as_secs_f64().min(STEP_MAX_S));
        let (last, first) = (ledger.numbers.last(), ledger.looked_at.is_none());
        let (mut counted, mut in_range, forgotten) = (0, 0, Deal::forgotten(elapsed_s));
        for partner in &mut *partners {
            let distance_m = self.settle(partner, now);
            let (look, may_be_counted) = self.look(own, partner, distance_m, &ledger.wish_m_s, now);
            *partner.look_mut() = look;
            partner.deal_mut().pass(elapsed_s, forgotten, &look);
            counted += usize::from(partner.is_counted());
            in_range += usize::from(may_be_counted);
        }
        let keep = usize::from(self.keep(own));
        let slots_left = in_range.saturating_sub(keep);
        ledger.price_m = promise(partners, slots_left, values);
        self.part_and_list(own, partners, last, (first, counted));
        ledger.looked_at = Some(now);
    }

    /// Decides whom robot `own` releases and lists once promises are made. It counts on so many, and looks at them for the `first` time or not.
    pub(super) fn part_and_list<const D: usize, P: Partner<D>>(
        &self,
        own: Member,
        partners: &mut [P],
        last: Number,
        (first, counted): (bool, usize),
    ) {
        let keep = usize::from(self.keep(own));
        release(partners, counted, keep);
        self.list(own, partners, last, first || counted < keep);
    }

    /// True if a pair at this distance, m, is far enough apart to be released.
    #[inline]
    pub(super) fn is_stretched(&self, distance_m: f64) -> bool {
        distance_m > STRETCHED * self.radius_m
    }

    /// Within this distance a robot lists others, m: everybody whom it could count on if it needs `all`.
    #[inline]
    pub(super) fn reach_m(&self, all: bool) -> f64 {
        if all { self.begun_m() + self.errors.offset_m } else { NEAR * self.radius_m }
    }

    /// Looks at one neighbour at `distance_m`: how far apart both would end, and whether it may be promised anything. Gives true too if it
    /// is in range and can be counted on, now or soon.
    ///
    /// Under ranks only one of the two lists the other, if any does. It releases the other alone, who has nothing to promise.
    fn look<const D: usize>(
        &self,
        own: Member,
        partner: &impl Partner<D>,
        distance_m: f64,
        wish_m_s: &Vector<D>,
        now: Instant,
    ) -> (Look, bool) {
        let [counts, mutual] = partner.counts_with(own, &self.need);
        let told = partner.told(self, now);
        let sensed = partner.is_sensed();
        let may_be_counted = counts && sensed && distance_m <= self.begun_m() && told.is_some();
        let their_m_s = told.map_or([0.0; D], |told| told.wish_m_s);
        let ends_m = add_scaled(partner.offset_m(), self.horizon_s, &subtract(wish_m_s, &their_m_s));
        let (price_m, promised) = match told {
            None => (f64::INFINITY, false),
            Some(told) if mutual => (told.price_m, told.promised),
            Some(_) => (0.0, true),
        };
        let is_tight = partner.room().least_m < TIGHT * self.radius_m;
        let stretched = self.is_stretched(distance_m) || is_tight;
        let engaged = partner.is_promised() && promised;
        let open = sensed && counts && partner.deal().is_open(stretched);
        (Look::new(length(&ends_m), [stretched, engaged], price_m, open), may_be_counted)
    }

    /// Lists who is near, who does not let go, and with `all` who may be in range.
    fn list<const D: usize, P: Partner<D>>(&self, own: Member, partners: &mut [P], last: Number, all: bool) {
        let counts = |partner: &&mut P| partner.is_sensed() && partner.counts_with(own, &self.need)[0];
        let reach_m = self.reach_m(all);
        let clear = |partner: &P| {
            let room = partner.room();
            if all { !room.is_lost() } else { room.least_m >= WIDE * self.radius_m }
        };
        for partner in partners.iter_mut().filter(counts) {
            if partner.is_listed() {
                partner.deal_mut().waiting_ticks = 0;
                continue;
            }
            let waits = partner.lists();
            let deal = partner.deal_mut();
            deal.waiting_ticks = if waits { deal.waiting_ticks.saturating_add(1) } else { 0 };
            let impatient = deal.waiting_ticks > PATIENCE_TICKS;
            if impatient && deal.released {
                deal.bar();
            }
            let near = dot(partner.offset_m(), partner.offset_m()) <= reach_m * reach_m && clear(partner);
            if impatient || near {
                partner.deal_mut().released = false;
                partner.list(last);
            }
        }
    }

    /// The wish, turned to the right if somebody comes towards the robot, seen along the first two axes: by a hair, so that two
    /// robots that meet head-on slide past each other, or as far as they may.
    #[must_use]
    pub fn turned<'a, const D: usize>(
        &self,
        wish_m_s: &Vector<D>,
        mut sensed: impl Iterator<Item = (Vector<D>, &'a Vector<D>)>,
    ) -> Vector<D> {
        let wish_m2_s2 = dot(wish_m_s, wish_m_s);
        let comes = |(offset_m, their_m_s): (Vector<D>, &Vector<D>)| {
            let (ahead, square_m2) = (-dot(&offset_m, wish_m_s), dot(&offset_m, &offset_m));
            let within = self.may_meet(square_m2) && ahead >= 0.0;
            within
                && ahead * ahead >= COS_45 * COS_45 * square_m2 * wish_m2_s2
                && dot(their_m_s, wish_m_s) < 0.0
        };
        if D < 2 || !sensed.any(comes) {
            return *wish_m_s;
        }
        let [along, right] = if self.pass_right { [COS_45, COS_45] } else { TIE };
        let mut turned = *wish_m_s;
        turned[0] = along * wish_m_s[0] + right * wish_m_s[1];
        turned[1] = along * wish_m_s[1] - right * wish_m_s[0];
        turned
    }

    /// True if a robot at this squared distance, m², is near enough to turn the wish ([`turned`](Self::turned)).
    #[inline]
    #[must_use]
    pub fn may_meet(&self, square_m2: f64) -> bool {
        let near_m = PASS_DISTANCES * self.distance_min_m;
        square_m2 <= near_m * near_m
    }

    /// A told wish, no faster than a robot can go.
    pub(crate) fn capped<const D: usize>(&self, wish_m_s: &Vector<D>) -> Vector<D> {
        let (speed_m2_s2, most_m_s) = (dot(wish_m_s, wish_m_s), self.speed_max_m_s);
        if speed_m2_s2 <= most_m_s * most_m_s {
            return *wish_m_s;
        }
        let fraction = most_m_s / sqrt(speed_m2_s2).max(most_m_s);
        wish_m_s.map(|component| fraction * component)
    }
}

/// Promises the `left` slots to the eligible with the largest V; of equals, to those of the lowest numbers. Gives what a promise costs then, m.
fn promise<const D: usize, P: Partner<D>>(partners: &mut [P], left: usize, values: &mut [f64]) -> f64 {
    let mut count = 0;
    for look in partners.iter().map(Partner::look).filter(|look| look.eligible) {
        if let Some(value) = values.get_mut(count) {
            *value = look.key_m();
            count += 1;
        }
    }
    let keys = values.get_mut(..count).unwrap_or(&mut []);
    let least = if left == 0 { f64::INFINITY } else { largest(keys, left - 1) };
    let above = keys.iter().filter(|key| **key > least).count();
    let mut equal = left.saturating_sub(above);
    let (mut engaged, mut least_m) = (0, f64::INFINITY);
    for partner in partners {
        let look = partner.look_mut();
        let key_m = look.key_m();
        let last = look.eligible && key_m == least && equal > 0;
        equal -= usize::from(last);
        let promised = look.eligible && (key_m > least || last);
        look.engaged &= promised;
        if look.engaged {
            (engaged, least_m) = (engaged + 1, least_m.min(look.gain_m));
        }
        partner.promise(promised);
    }
    match left {
        0 => f64::INFINITY,
        _ if engaged < left => 0.0,
        _ => least_m,
    }
}

/// The largest of `keys` but so many; 0 if there are no more. Their order is lost. None of them is NaN or negative.
fn largest(keys: &mut [f64], but: usize) -> f64 {
    if but >= keys.len() {
        return 0.0;
    }
    if keys.len() > FEW {
        return *keys.select_nth_unstable_by(but, |one, other| other.total_cmp(one)).1;
    }
    for next in 1..keys.len() {
        let (key, mut place) = (keys[next], next);
        while place > 0 && keys[place - 1] < key {
            keys[place] = keys[place - 1];
            place -= 1;
        }
        keys[place] = key;
    }
    keys[but]
}

/// Releases who is to be released and follows those who have let go, as long as enough are counted on.
//= theory thm:anew
fn release<const D: usize, P: Partner<D>>(partners: &mut [P], mut counted: usize, keep: usize) {
    loop {
        let loose = |partner: &P| {
            if !partner.look().stretched || !partner.is_listed() {
                return false;
            }
            let (is_counted, engaged) = (partner.is_counted(), partner.look().engaged);
            let let_go = partner.is_released() && (engaged || !is_counted);
            (engaged || let_go) && counted >= keep + usize::from(is_counted)
        };
        let mut farthest: Option<&mut P> = None;
        for partner in partners.iter_mut().filter(|partner| loose(partner)) {
            if farthest.as_ref().is_none_or(|most| partner.look().gain_m > most.look().gain_m) {
                farthest = Some(partner);
            }
        }
        let Some(partner) = farthest else { return };
        counted -= usize::from(partner.is_counted());
        partner.deal_mut().released = true;
        partner.hold(false);
        partner.release();
    }
}
