//! What robot i knows about the spare connectivity h_j of a neighbour, whatever it is told.

use crate::budget::rows::Budget;
use crate::link::Link;
use crate::math::{Vector, dot, is_finite, subtract};

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
    /// The last that it told.
    pub claim: Option<Claim>,
}

/// Bounds of the level of a neighbour, from positions alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The level if no robot out of sight is near it.
    pub low: f64,
    /// The level if every robot out of sight is as near to it as it can be.
    pub high: f64,
    /// δ⁺: its neighbours, and every robot out of sight; at least 1.
    pub degree_max: f64,
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

impl Budget {
    /// F′ or θ: the level below which h is negative.
    //= theory D
    #[must_use]
    pub fn required(&self) -> u16 {
        match self.assume {
            Assume::Obedient => crate::barrier::required_degree(self.robots, self.faults),
            Assume::Free => self.faults.saturating_add(self.robots.saturating_sub(self.faults) / 2),
        }
    }

    /// What robot i has to tell: its level, or the trimmed one. Zero if `weights` is shorter than `sightings`.
    #[must_use]
    pub fn level<const D: usize>(&self, sightings: &[Sighting<D>], weights: &mut [f64]) -> f64 {
        let own = sightings.iter().map(|sighting| self.weight(&sighting.offset_m));
        fill(own, weights).map_or(0.0, |weights| self.total(weights, 0.0, 0))
    }

    /// The verified interval of the level of `sightings[index]`. `weights` is scratch, as long as `sightings`.
    ///
    /// ```text
    /// low = Σ_{p seen} a_jp,    high = low + (robots out of sight) · a(max(R − Δ_ij, 0))
    /// ```
    ///
    /// because |x_p − x_i| > R for a robot p out of sight, so Δ_jp > R − Δ_ij. Under [`Assume::Free`] the F largest of the
    /// same terms are left out; a trimmed sum falls when terms are taken away or made smaller, so both bounds remain.
    /// A sighting that is not finite counts as out of sight. Too little scratch gives `low = high = 0`, which is safe.
    //= theory 2.7
    #[must_use]
    pub fn interval<const D: usize>(
        &self,
        index: usize,
        sightings: &[Sighting<D>],
        weights: &mut [f64],
    ) -> Interval {
        let all = f64::from(self.robots) - 1.0;
        let nothing = Interval { low: 0.0, high: 0.0, degree_max: all.max(1.0) };
        let Some(of) = sightings.get(index).map(|sighting| sighting.offset_m) else { return nothing };
        let others = sightings.iter().enumerate().filter(|(other, _)| *other != index);
        let offsets = others.map(|(_, sighting)| subtract(&sighting.offset_m, &of));
        let seen = sightings.iter().filter(|sighting| is_finite(&sighting.offset_m)).count();
        let unseen = usize::from(self.robots).saturating_sub(seen.saturating_add(1));

        let mut degree = unseen;
        let links = offsets.chain([of]).map(|offset| self.link(&offset));
        let counted = links.map(|link| {
            degree += usize::from(link.is_some());
            link.map_or(0.0, |link| link.weight)
        });
        let Some(weights) = fill(counted, weights) else { return nothing };
        let radius_m = self.curvature.link().radius_m;
        let nearest_m = (radius_m - crate::math::length(&of)).max(0.0);
        let most =
            self.curvature.link().link_at(nearest_m * nearest_m).map_or(0.0, |link: Link<f64>| link.weight);
        let low = self.total(weights, 0.0, 0);
        let high = if unseen == 0 { low } else { self.total(weights, most, unseen) };
        Interval { low, high, degree_max: number(degree.max(1)) }
    }

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
        let required = f64::from(self.required());
        let seen = interval.low - required;
        let claim = sightings.get(index).and_then(|sighting| sighting.claim);
        let told = claim.map_or(0.0, |claim| self.discounted(&claim).min(interval.high - required));
        let believed = match self.trust {
            Trust::Told => told,
            Trust::ToldOrSeen => told.max(seen),
            Trust::Seen => seen,
        };
        Known {
            budget: believed.max(0.0),
            deficit: (required - interval.high).max(0.0),
            degree_max: interval.degree_max,
        }
    }

    /// `(1−γ)ᵐ (c − required)⁺`; 0 for a claim that is not finite.
    fn discounted(&self, claim: &Claim) -> f64 {
        let spare = claim.level - f64::from(self.required());
        if spare.is_finite() { power(1.0 - self.gamma, claim.age_ticks) * spare.max(0.0) } else { 0.0 }
    }

    pub(crate) fn link<const D: usize>(&self, offset: &Vector<D>) -> Option<Link<f64>> {
        self.curvature.link().link_at(dot(offset, offset))
    }

    fn weight<const D: usize>(&self, offset: &Vector<D>) -> f64 {
        self.link(offset).map_or(0.0, |link| link.weight)
    }

    /// Sum of `weights` and `copies` more of size `extra`, without the F largest of them under [`Assume::Free`].
    fn total(&self, weights: &mut [f64], extra: f64, copies: usize) -> f64 {
        let drop = match self.assume {
            Assume::Obedient => 0,
            Assume::Free => usize::from(self.faults),
        };
        let (mut kept, mut copies) = (&*weights, copies);
        if drop > 0 {
            weights.sort_unstable_by(f64::total_cmp);
            kept = weights;
        }
        for _ in 0..drop {
            match kept.split_last() {
                Some((largest, rest)) if copies == 0 || *largest >= extra => kept = rest,
                _ => copies = copies.saturating_sub(1),
            }
        }
        kept.iter().fold(0.0, |sum, weight| sum + weight) + number(copies) * extra
    }
}

/// The leading part of `memory`, filled; `None` if it is too short.
fn fill(numbers: impl Iterator<Item = f64>, memory: &mut [f64]) -> Option<&mut [f64]> {
    let mut count = 0;
    for number in numbers {
        *memory.get_mut(count)? = number;
        count += 1;
    }
    memory.get_mut(..count)
}

/// A count as a number; exact, because no team has 2³² robots.
pub(crate) fn number(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::MAX, f64::from)
}

/// `baseᵉ` by squaring, in the same order on every target.
fn power(base: f64, exponent: u32) -> f64 {
    let (mut result, mut square, mut rest) = (1.0, base, exponent);
    while rest > 0 {
        if rest & 1 == 1 {
            result *= square;
        }
        square *= square;
        rest >>= 1;
    }
    result
}
