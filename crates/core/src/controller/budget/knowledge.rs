//! What a robot knows of the spare connectivity h_j of a neighbour, whatever it is told.
//!
//! It has two sources. What it *sees*, positions alone, bounds the level of the neighbour from below and from above. What it
//! is *told* is a claim, which may be a lie; it counts only up to the upper bound.

use crate::controller::assume::Assume;
use crate::controller::budget::settings::{Budget, Trust};
use crate::controller::{Glimpse, Low};
use crate::num::{Vector, larger};
use crate::robot::neighbor::RobotId;

/// A level that a neighbour told: the sum of its weights, or the trimmed sum, by [`Assume`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claim {
    /// The level as it was told. Any number is safe; one that is not finite counts as not told.
    pub level: f64,
    /// m: ticks since the positions that it describes; 0 for those of this tick.
    pub age_ticks: u32,
}

/// Another robot as robot i senses and hears it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting<const D: usize> {
    /// Which robot it is. A robot has one sighting of each other at most, in ascending order.
    pub id: RobotId,
    /// x_i − x_j, m.
    pub offset_m: Vector<D>,
    /// x_j, m, in a frame that all sightings share: what lies between two neighbours is the same for whoever sees them.
    pub position_m: Vector<D>,
    /// The last level that it told.
    pub claim: Option<Claim>,
    /// How far it can have gone since it was sensed, m; 0 for a robot that was sensed in this tick.
    pub unsensed_m: f64,
}

impl<const D: usize> Sighting<D> {
    /// A place holder in memory that is not filled yet.
    pub const NOBODY: Self =
        Self { id: RobotId(0), offset_m: [0.0; D], position_m: [0.0; D], claim: None, unsensed_m: 0.0 };

    /// The sighting of robot `id` by a robot at the origin.
    #[must_use]
    pub fn new(id: RobotId, offset_m: Vector<D>, claim: Option<Claim>) -> Self {
        let position_m = offset_m.map(|component| -component);
        Self { id, offset_m, position_m, claim, unsensed_m: 0.0 }
    }
}

/// What robot i sees of the links of a neighbour j, and what it was told by it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen<'a> {
    /// j.
    pub robot: RobotId,
    /// The level of j if no robot out of sight of i has a link with it: the sum of the weights that i sees, its own link to
    /// j among them, in order of numbers. Under [`Assume::Free`] it is the trimmed sum.
    pub low: f64,
    /// How many links i sees, and every robot out of sight that counts for j.
    pub degree: f64,
    /// How many robots out of sight count for j.
    pub unseen: usize,
    /// What the claim of j still says ([`Budget::discounted_claim`]).
    pub discounted_claim: f64,
    /// The weights behind `low` in ascending order. Only [`Assume::Free`] needs them.
    pub weights: &'a [f64],
}

/// What robot i knows of h_j.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KnownMargin {
    /// b_ij ≥ 0: for an honest robot that the theorem covers, never more than h_j⁺.
    pub budget: f64,
    /// δ⁺_ij: at least the number of neighbours that count for j, and at least 1.
    pub degree_max: f64,
}

/// Far more than the rounding of a sum of weights, as a fraction.
const ROOM: f64 = 1e-9;
/// Up to so many neighbours a sum costs less than an exponential.
const FEW: u16 = 32;

impl Budget {
    /// b_ij, what robot i may count on: the larger of 0 and, by [`Trust`], of what was told and what is seen.
    ///
    /// ```text
    /// told: min( decayed (c_j − need)⁺, high − need )        a claim c_j that is m ticks old
    /// seen: low − need
    /// ```
    ///
    /// A claim is first discounted and then cut to the interval of today. The order matters: the theorem says what m ticks
    /// leave of h_j as it was then, and the interval bounds h_j as it is today. The cut can only lower the budget, so it is
    /// sound. Under [`Assume::Obedient`] it leaves every honest claim as it is, because `decayed h_j(then) ≤ h_j ≤ high − need`.
    /// Under [`Assume::Free`] T_j itself may fall faster when malicious robots leave. The old claim would still be sound
    /// there, because the theorem protects the sums over sets that leave F robots out. All of these are at least T_j and
    /// none decays faster than it may. There the cut costs a little room.
    ///
    /// `distance_m` is that of robot j. It matters only if somebody is out of sight. Who sees everybody knows the same of j
    /// as all others who do. The high end of the interval costs an exponential, so it is computed only where it cuts something.
    //= theory eq:known
    //= theory thm:any-claim
    #[inline]
    #[must_use]
    pub fn known(&self, seen: &Seen<'_>, distance_m: f64) -> KnownMargin {
        let need = f64::from(self.need.need(seen.robot));
        let is_possible = |high: f64| seen.discounted_claim <= high - need;
        let high = match seen.low {
            low if is_possible(low) => low,
            _ if is_possible(self.high_lower_bound(seen, distance_m)) => f64::INFINITY,
            _ => self.high(seen, distance_m),
        };
        let (h_min, h_max) = (seen.low - need, high - need);
        let told = if seen.discounted_claim > h_max { h_max } else { seen.discounted_claim };
        let believed = match self.trust {
            Trust::Told => told,
            Trust::ToldOrSeen => larger(told, h_min),
            Trust::Seen => h_min,
        };
        KnownMargin { budget: larger(believed, 0.0), degree_max: larger(seen.degree, 1.0) }
    }

    /// What robot i knows of j in a world in which all sense exactly and hear the same.
    ///
    /// Where the claim is worth at least what i can see and at most what is possible, it is what i knows, and the sum of what i
    /// sees is not needed. Both can be told from the true level of j:
    ///
    /// ```text
    /// low ≤ level,    high ≥ level + (unseen − unseen_near) · a(R − Δ_ij)
    /// ```
    ///
    /// The first holds to the last bit, because `low` leaves terms of the same sum out that are not negative. The second is used
    /// with more room than rounding takes: each of the unseen near j is at least R − Δ_ij away from it.
    //= theory eq:known
    #[inline]
    #[must_use]
    pub fn known_of(&self, glimpse: &Glimpse<'_, f64>) -> KnownMargin {
        let (discounted_claim, unseen) = (*glimpse.told, glimpse.unseen);
        let degree = f64::from(glimpse.degree) + count(unseen - glimpse.unseen_near);
        let seen = |low| Seen { robot: glimpse.id, low, degree, unseen, discounted_claim, weights: &[] };
        let low = match glimpse.low {
            _ if unseen == 0 => glimpse.level,
            Low::Known(low) => low,
            Low::Asked(_) if self.is_as_claimed(glimpse) => {
                let degree_max = larger(degree, 1.0);
                return KnownMargin { budget: discounted_claim, degree_max };
            }
            Low::Asked(low) => low(),
        };
        self.known(&seen(low), glimpse.distance_m)
    }

    /// True where [`known_of`](Self::known_of) surely is what the claim says.
    fn is_as_claimed(&self, glimpse: &Glimpse<'_, f64>) -> bool {
        let (need, claimed) = (f64::from(self.need.need(glimpse.id)), *glimpse.told);
        let overlooked = count(glimpse.unseen - glimpse.unseen_near);
        if self.trust == Trust::Seen || claimed < glimpse.level - need || overlooked == 0.0 {
            return false;
        }
        let missing = claimed + need - glimpse.level + ROOM * (1.0 + glimpse.level + claimed);
        let nearest_m = self.nearest_out_of_sight_m(glimpse.distance_m);
        if nearest_m <= 0.5 * self.curvature.link().radius_m {
            return missing <= overlooked * self.curvature.least_within_half();
        }
        glimpse.degree > FEW && missing <= overlooked * self.weight_at(nearest_m) * (1.0 - ROOM)
    }

    /// What a claim of `robot` still says of its h: what m ticks leave of `(c − need)⁺`. It is 0 without a claim, for a claim
    /// that is not finite, and where no claim is believed. A negative claim gives 0, never the discount of a negative number.
    //= theory eq:decayed
    #[must_use]
    pub fn discounted_claim(&self, robot: RobotId, claim: Option<Claim>) -> f64 {
        let Some(claim) = claim.filter(|_| self.trust != Trust::Seen) else { return 0.0 };
        let spare = claim.level - f64::from(self.need.need(robot));
        match claim.age_ticks {
            _ if !spare.is_finite() => 0.0,
            0 => larger(spare, 0.0),
            ticks => self.decayed(larger(spare, 0.0), ticks),
        }
    }

    /// The level of a neighbour at `distance_m` (m) if every robot out of sight is as near to it as it can be.
    ///
    /// ```text
    /// low = Σ_{p seen} a_jp,    high = low + (robots out of sight) · a(max(R − Δ_ij, 0))
    /// ```
    ///
    /// This holds because a robot p out of sight of i has `|x_p − x_i| > R`, so `Δ_jp > R − Δ_ij`. Under [`Assume::Free`] the F
    /// largest of the same terms are left out. A trimmed sum falls when terms are taken away or made smaller, so both bounds
    /// remain. If offsets are known to 2E, every weight in `low` is that at `distance + 2E`, and `high` has room for weights
    /// at `distance − 2E`.
    //= theory eq:interval
    #[inline]
    #[must_use]
    pub fn high(&self, seen: &Seen<'_>, distance_m: f64) -> f64 {
        let blur = if self.is_exact() { 0.0 } else { seen.degree * self.weight_error() };
        let high = match (seen.unseen, self.assume) {
            (0, _) => seen.low,
            (unseen, Assume::Obedient) => seen.low + count(unseen) * self.weight_out_of_sight(distance_m),
            (unseen, Assume::Free) => {
                self.trimmed(seen.weights, self.weight_out_of_sight(distance_m), unseen)
            }
        };
        blur + high
    }

    /// A number that is never more than [`high`](Self::high), without an exponential.
    #[inline]
    fn high_lower_bound(&self, seen: &Seen<'_>, distance_m: f64) -> f64 {
        let near = self.nearest_out_of_sight_m(distance_m) <= 0.5 * self.curvature.link().radius_m;
        let least = if near { self.curvature.least_within_half() } else { 0.0 };
        match self.assume {
            Assume::Obedient => seen.low + count(seen.unseen) * least,
            Assume::Free => seen.low,
        }
    }

    #[inline]
    fn weight_out_of_sight(&self, distance_m: f64) -> f64 {
        self.weight_at(self.nearest_out_of_sight_m(distance_m))
    }

    /// No robot out of sight is closer than this to one at `distance_m`, m.
    fn nearest_out_of_sight_m(&self, distance_m: f64) -> f64 {
        (self.curvature.link().radius_m - distance_m - self.errors.offset_m).max(0.0)
    }

    /// The sum of the positive ones of `weights`, which ascend, and of `copies` more of size `extra`, without the F largest.
    //= theory thm:free
    #[inline(never)]
    pub(super) fn trimmed(&self, weights: &[f64], extra: f64, copies: usize) -> f64 {
        let (mut kept, mut copies) = (weights, copies);
        for _ in 0..self.faults {
            match kept.split_last() {
                Some((largest, rest)) if copies == 0 || *largest >= extra => kept = rest,
                _ => copies = copies.saturating_sub(1),
            }
        }
        kept.iter().fold(0.0, |sum, weight| sum + weight.max(0.0)) + count(copies) * extra
    }
}

/// A count as a floating-point number; exact, because no team has 2³² robots.
pub(super) fn count(number: usize) -> f64 {
    u32::try_from(number).map_or(f64::MAX, f64::from)
}
