//! Held links: a controller without weights. Robots agree on which links they keep, and a link that is kept has a row at
//! both ends.
//!
//! Robot i *lists* the neighbours that it wants to keep and *counts on* those that have acknowledged it ([`protocol`]). It
//! moves by the v closest to the desired displacement that satisfies, with `r = x_i − x_j` and `D = |r|²`:
//!
//! ```text
//! (held)  r·v + |v|² ≤ (γ/4) (R_h² − D)⁺        for every j that i lists, or that has not let go of i
//! (near)  −2 r·v     ≤ (γ_c/2) (D − Δ_d²)⁺      for every j in sight
//! (box)   v/T ∈ U_i
//! ```
//!
//! Each set is convex and contains v = 0. A link that is counted on with D ≤ R_h² is never longer than R_h, whatever is lost, late,
//! doubled, reordered or lied: both ends have their row (docs/theory/links.md, thm:held). So a robot that counts on enough
//! neighbours, and releases none of them below that, keeps them for ever.
//!
//! R_h is a hair below R. A robot beyond R_h and in sight still has its row, so that rounding cannot drop it. Half a hair beyond R_h a
//! link may begin to be counted on, for the same reason.
//!
//! | | file |
//! | --- | --- |
//! | who lists whom, who is counted on, whose row is active | [`protocol`] |
//! | what is told, as bytes | [`wire`] |
//! | what a robot holds of a neighbour | [`peer`] |
//! | the rows of a tick, and where none are needed | [`rows`], `slack` |
//! | links that obstacles would cut | [`cut`] |
//! | who releases whom: no guarantee rests on it | `policy`, `deal`; what it asks of a neighbour: `partner` |
//! | the seam | [`control`] |
//! | the same in few bytes, for large teams in which nothing goes wrong | [`bond`], [`mod@line`] |
//! | the same for many worlds at once | [`lanes`] |

pub mod bond;
pub mod control;
pub mod cut;
mod deal;
pub mod lanes;
pub mod line;
mod partner;
pub mod peer;
mod policy;
pub mod protocol;
pub mod rows;
mod slack;
pub mod wire;

use core::time::Duration;

use crate::controller::assume::Assume;
use crate::controller::errors::ErrorBounds;
use crate::controller::links::cut::Room;
use crate::controller::links::partner::Partner;
use crate::id::Member;
use crate::need::Need;
use crate::num::length;
use crate::time::Instant;

/// Links are held so much below R, and distances so much above Δ_d, as fractions: far more than a tick rounds, far less than anybody
/// can see. What many ticks round is in docs/theory/links.md.
const HAIR: f64 = 1e-9;

/// The parameters of the rows and of the rule who releases whom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Links {
    /// Who counts for whom.
    pub need: Need,
    /// How many more than those a robot must count on: F where liars move as they like, so that enough normal ones are left.
    pub spare: u16,
    /// What malicious robots are assumed to do.
    pub assume: Assume,
    /// R_h, m: no link that is counted on is longer.
    pub radius_m: f64,
    /// Up to this distance sensed robots may be within R_h, m.
    pub sight_m: f64,
    /// Δ_d, m, with what errors add.
    pub distance_min_m: f64,
    /// What (near) keeps, m: a hair more, so that rounding takes no robot below Δ_d.
    pub distance_held_m: f64,
    /// ρ, m: no move of a tick is longer.
    pub move_max_m: f64,
    /// The greatest speed of a robot, m/s.
    pub speed_max_m_s: f64,
    /// γ: the fraction of R_h² − D that may be lost in a tick, in (0, 1].
    pub gamma: f64,
    /// γ_c: the fraction of D − Δ_d² that may be lost in a tick, in (0, 1].
    pub gamma_c: f64,
    /// What errors of sensing and tracking cost.
    pub errors: ErrorBounds,
    /// H, s: how far the rule looks ahead.
    pub horizon_s: f64,
    /// Whether robots pass each other on the right.
    pub pass_right: bool,
    /// A neighbour is counted on no longer than this after it was sensed last.
    pub told_max: Duration,
}

impl Links {
    /// R_h, m, for links of `radius_m` with these errors.
    #[must_use]
    pub fn held_radius_m(radius_m: f64, errors: &ErrorBounds) -> f64 {
        (radius_m - 2.0 * errors.away_m) * (1.0 - HAIR)
    }

    /// Up to this distance a pair may begin to be counted, m: R_h and half a hair. Rounding takes a link that is held at R_h beyond it
    /// by less, so that a team that begins anew where its links end keeps them. Its rows let no such link grow.
    fn begun_m(&self) -> f64 {
        self.radius_m * (1.0 + 0.5 * HAIR)
    }

    /// What (near) keeps, m, where no two robots may come nearer than `distance_min_m`.
    #[must_use]
    pub fn held_distance_m(distance_min_m: f64) -> f64 {
        distance_min_m * (1.0 + HAIR)
    }

    /// How many neighbours `robot` must count on.
    #[must_use]
    pub fn keep(&self, robot: Member) -> u16 {
        self.need.need(robot).saturating_add(self.spare)
    }

    /// How wrong the offset to a neighbour may be, m: since it was last sensed, it may have moved by `gone_m`.
    pub(crate) fn error_m(&self, gone_m: f64) -> f64 {
        self.errors.offset_m + gone_m
    }

    /// Notes whether a neighbour that is counted on has been within R_h. Once it certainly was, it is for as long as it is
    /// counted on (thm:held), unless it is certainly beyond: then some assumption was broken. One that is not sensed may have
    /// broken one: it is held only as long as it cannot be beyond, and not for long, because the last sighting may have been
    /// wrong. Gives the distance, m.
    fn settle<const D: usize>(&self, partner: &mut impl Partner<D>, now: Instant) -> f64 {
        let recent = partner.was_sensed_within(self.told_max, now);
        let error_m = self.error_m(partner.gone_m());
        let distance_m = length(partner.offset_m());
        let acknowledges = partner.acknowledges() && recent;
        let before = partner.is_held() && partner.unseen_ticks() == 0;
        let held = self.is_held(acknowledges, before, (distance_m, error_m), &partner.room());
        partner.hold(held);
        distance_m
    }

    /// Whether a neighbour is counted on that acknowledges or not, was so `before` or not, and is seen at a distance with an error, m.
    #[inline]
    fn is_held(
        &self,
        acknowledges: bool,
        before: bool,
        (distance_m, error_m): (f64, f64),
        room: &Room,
    ) -> bool {
        let certainly_within = distance_m + error_m <= self.begun_m() && room.suffices();
        let certainly_beyond = distance_m - error_m > self.radius_m * (1.0 + HAIR) || room.is_lost();
        acknowledges && (before && !certainly_beyond || certainly_within)
    }
}
