//! What robot i knows about the spare connectivity h_j of a neighbour, whatever it is told.

use crate::controller::Glimpse;
use crate::controller::budget::interval::{Interval, number};
use crate::controller::budget::settings::Budget;
use crate::controller::budget::survey::Seen;
use crate::num::{Vector, larger};

/// What a robot believes about the levels of its neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// What was told, cut to what is possible.
    Told,
    /// The larger of what was told and what is seen.
    ToldOrSeen,
    /// What is seen alone. No level need be sent, so there is nothing to lie about.
    Seen,
}

/// What malicious robots are assumed to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assume {
    /// They lie but move by the rows (Assumption 1): `h_k = Σ_j a_kj − F′`, `F′ = F + ⌊n/2⌋`.
    Obedient,
    /// They move as they like and tell every neighbour another value: `h_k = T_k − θ`, `θ = F + ⌊(n−F)/2⌋`, with T_k the
    /// sum of the a_kj without its F largest terms.
    Free,
}

/// A level that a neighbour told: the sum of its weights, or the trimmed sum, by [`Assume`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claim {
    /// As told. Any number is safe; what is not finite counts as not told.
    pub level: f64,
    /// m: ticks since the positions that it describes; 0 for those of this tick.
    pub age_ticks: u32,
}

/// A neighbour as robot i senses and hears it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting<const D: usize> {
    /// x_i − x_j, m.
    pub offset_m: Vector<D>,
    /// x_j, m, in a frame that all sightings share: what lies between two neighbours is the same for whoever sees them.
    pub position_m: Vector<D>,
    /// True if its number is lower than that of robot i. Sums are taken in order of numbers, robot i among the others.
    pub lower: bool,
    /// The last that it told.
    pub claim: Option<Claim>,
}

impl<const D: usize> Sighting<D> {
    /// As seen from the origin, by the robot of the lowest number.
    #[must_use]
    pub fn new(offset_m: Vector<D>, claim: Option<Claim>) -> Self {
        Self { offset_m, position_m: offset_m.map(|component| -component), lower: false, claim }
    }
}

/// How many of `sightings` have lower numbers than the robot that has them.
pub(crate) fn place<const D: usize>(sightings: &[Sighting<D>]) -> usize {
    sightings.iter().take_while(|sighting| sighting.lower).count()
}

/// What robot i knows of h_j.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// b_ij ≥ 0: for an honest robot that the theorem covers, never more than h_j⁺.
    pub budget: f64,
    /// By how much h_j is certainly below 0; at least 0.
    pub deficit: f64,
    /// δ⁺_ij.
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
    /// told: min( (1−γ)ᵐ (c_j − required), high − required )        m ticks old
    /// seen: low − required
    /// ```
    ///
    /// First discounted, then cut to the interval of today. Discounted first, because `h_j ≥ (1−γ)ᵐ h_j(then)` is what the
    /// theorem gives, and the interval of today bounds h_j of today, not of then. The cut can only lower the budget, so
    /// it is sound; under [`Assume::Obedient`] it leaves every honest claim as it is, `(1−γ)ᵐ h_j(then) ≤ h_j ≤ high −
    /// required`. Under [`Assume::Free`] T_j itself may fall faster when malicious robots leave; the old claim would still
    /// be sound, because what the theorem protects are the sums over sets that leave F robots out, all of which are at
    /// least T_j and decay by (1−γ) at most; there the cut costs a little room. A negative claim gives 0, never the
    /// discount of a negative number.
    //= method far
    //= theory C
    #[must_use]
    pub fn known<const D: usize>(
        &self,
        index: usize,
        sightings: &[Sighting<D>],
        weights: &mut [f64],
    ) -> Known {
        let interval = self.interval(index, sightings, weights);
        self.believe(&interval, sightings.get(index).and_then(|sighting| sighting.claim))
    }

    /// The same of a robot at `distance_m` (m), from sums over its links. Where the high end cuts nothing, it is not computed: it
    /// costs an exponential. If nobody is unseen, the distance does not matter, and all who see it know the same.
    #[inline]
    #[must_use]
    pub fn known_from(&self, seen: &Seen, distance_m: f64) -> Known {
        let required = f64::from(self.required());
        let reaches = |high: f64| seen.worth <= high - required;
        let high = match seen.low {
            low if reaches(low) => low,
            _ if reaches(self.high_at_least(seen, distance_m)) => f64::INFINITY,
            _ => self.high(seen, distance_m),
        };
        self.weigh([seen.low - required, high - required], seen.worth, larger(seen.degree, 1.0))
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
    #[must_use]
    pub fn known_of(&self, glimpse: &Glimpse<'_, f64>) -> Known {
        let (worth, unseen) = (*glimpse.told, glimpse.unseen);
        let degree = f64::from(glimpse.degree) + number(unseen - glimpse.unseen_near);
        if unseen == 0 {
            return self.known_from(&Seen { low: glimpse.level, degree, unseen, worth }, 0.0);
        }
        if self.is_worth_what_was_told(glimpse) {
            return Known { budget: worth, deficit: 0.0, degree_max: larger(degree, 1.0) };
        }
        self.known_from(&Seen { low: (glimpse.low)(), degree, unseen, worth }, glimpse.distance_m)
    }

    /// True where [`known_of`](Self::known_of) surely is what the claim is worth.
    fn is_worth_what_was_told(&self, glimpse: &Glimpse<'_, f64>) -> bool {
        let required = f64::from(self.required());
        let overlooked = number(glimpse.unseen - glimpse.unseen_near);
        let worth = *glimpse.told;
        if self.trust == Trust::Seen || worth < glimpse.level - required || overlooked == 0.0 {
            return false;
        }
        let missing = worth + required - glimpse.level + ROOM * (1.0 + glimpse.level + worth);
        let nearest_m = self.nearest_m(glimpse.distance_m);
        if nearest_m <= 0.5 * self.curvature.link().radius_m {
            return missing <= overlooked * self.curvature.least_within_half();
        }
        glimpse.degree > FEW && missing <= overlooked * self.weight(&[nearest_m]) * (1.0 - ROOM)
    }

    pub(crate) fn believe(&self, interval: &Interval, claim: Option<Claim>) -> Known {
        let required = f64::from(self.required());
        let spares = [interval.low - required, interval.high - required];
        self.weigh(spares, self.worth(claim), interval.degree_max)
    }

    #[inline]
    fn weigh(&self, [seen, most]: [f64; 2], worth: f64, degree_max: f64) -> Known {
        let told = if worth > most { most } else { worth };
        let believed = match self.trust {
            Trust::Told => told,
            Trust::ToldOrSeen => larger(told, seen),
            Trust::Seen => seen,
        };
        Known { budget: larger(believed, 0.0), deficit: larger(-most, 0.0), degree_max }
    }

    /// What a claim is worth, what m ticks leave of `(c − required)⁺`; 0 for a claim that is not finite, for none, and where none is believed.
    #[must_use]
    pub fn worth(&self, claim: Option<Claim>) -> f64 {
        let Some(claim) = claim.filter(|_| self.trust != Trust::Seen) else { return 0.0 };
        let spare = claim.level - f64::from(self.required());
        match claim.age_ticks {
            _ if !spare.is_finite() => 0.0,
            0 => larger(spare, 0.0),
            ticks => self.left(larger(spare, 0.0), ticks),
        }
    }
}
