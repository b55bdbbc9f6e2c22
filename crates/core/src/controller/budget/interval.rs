//! Bounds of a neighbour's level from positions alone: the verified interval.

use crate::controller::budget::knowledge::{Assume, Sighting, place};
use crate::controller::budget::settings::Budget;
use crate::equations::link::Link;
use crate::num::{Vector, dot, is_finite, length, subtract};

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

impl Budget {
    /// F′ or θ: the level below which h is negative.
    //= theory D
    #[must_use]
    pub fn required(&self) -> u16 {
        match self.assume {
            Assume::Obedient => crate::equations::barrier::required_degree(self.robots, self.faults),
            Assume::Free => self.faults.saturating_add(self.robots.saturating_sub(self.faults) / 2),
        }
    }

    /// What robot i has to tell: its level, or the trimmed one. Zero if `weights` is shorter than `sightings`.
    #[must_use]
    pub fn level<const D: usize>(&self, sightings: &[Sighting<D>], weights: &mut [f64]) -> f64 {
        let own = sightings.iter().map(|sighting| self.entry(&sighting.offset_m));
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
    /// With a margin 2E of offsets, low has every weight at `distance + 2E`, high at least those at `distance − 2E`. A sighting
    /// that is not finite counts as out of sight. Too little scratch gives `low = high = 0`, which is safe.
    //= theory 2.7
    #[must_use]
    pub fn interval<const D: usize>(
        &self,
        index: usize,
        sightings: &[Sighting<D>],
        weights: &mut [f64],
    ) -> Interval {
        let Some(Sighting { offset_m: of, position_m, .. }) = sightings.get(index).copied() else {
            return self.nothing();
        };
        let others = sightings.iter().enumerate().map(|(other, sighting)| {
            let entry = self.entry(&subtract(&sighting.position_m, &position_m));
            (other != index).then_some(entry)
        });
        let (lower, own) = (place(sightings), Some(self.entry(&of)));
        let row = others.clone().take(lower).chain([own]).chain(others.skip(lower)).flatten();
        let unseen = self.unseen(sightings);
        fill(row, weights).map_or_else(|| self.nothing(), |weights| self.bounds(&of, weights, unseen))
    }

    /// The weights that [`interval`](Self::interval) adds up, of every sighting with every other one, each computed
    /// once: line j of the table belongs to sighting j and holds its links in order of numbers, that to robot i among them.
    /// False if `table` is shorter than the square of the sightings.
    pub(crate) fn tabulate<const D: usize>(&self, sightings: &[Sighting<D>], table: &mut [f64]) -> bool {
        let count = sightings.len();
        if count.checked_mul(count).is_none_or(|square| table.len() < square) {
            return false;
        }
        let own = place(sightings);
        // robot i itself stands among the others
        let number = |index: usize| index + usize::from(index >= own);
        let column = |line: usize, other: usize| other - usize::from(other > number(line));
        for (line, of) in sightings.iter().enumerate() {
            table[line * count + column(line, own)] = self.entry(&of.offset_m);
            for (before, other) in sightings[..line].iter().enumerate() {
                let entry = self.entry(&subtract(&other.position_m, &of.position_m));
                table[line * count + column(line, number(before))] = entry;
                table[before * count + column(before, number(line))] = entry;
            }
        }
        true
    }

    /// The interval of a neighbour at `offset` from the weights of its links, −1 for those out of its range.
    pub(crate) fn bounds<const D: usize>(
        &self,
        offset: &Vector<D>,
        weights: &mut [f64],
        unseen: usize,
    ) -> Interval {
        let degree = unseen.saturating_add(weights.iter().filter(|weight| **weight >= 0.0).count());
        let error_m = self.margin.offset_m;
        let low = self.total(weights, 0.0, 0);
        let blur = if error_m > 0.0 { number(degree) * self.weight_error() } else { 0.0 };
        let high = blur
            + match unseen {
                0 => low,
                _ => self.total(weights, self.weight(&[self.nearest_m(length(offset))]), unseen),
            };
        Interval { low, high, degree_max: number(degree.max(1)) }
    }

    /// No robot out of sight is closer than this to one at `distance_m`, m.
    pub(crate) fn nearest_m(&self, distance_m: f64) -> f64 {
        (self.curvature.link().radius_m - distance_m - self.margin.offset_m).max(0.0)
    }

    /// Robots of the team that are not among the sightings.
    pub(crate) fn unseen<const D: usize>(&self, sightings: &[Sighting<D>]) -> usize {
        let seen = sightings.iter().filter(|sighting| is_finite(&sighting.offset_m)).count();
        usize::from(self.robots).saturating_sub(seen.saturating_add(1))
    }

    fn nothing(&self) -> Interval {
        Interval { low: 0.0, high: 0.0, degree_max: f64::from(self.robots).max(1.0) }
    }

    pub(crate) fn link<const D: usize>(&self, offset: &Vector<D>) -> Option<Link<f64>> {
        self.curvature.link().link_at(dot(offset, offset))
    }

    /// True if positions and moves are exact.
    pub(crate) fn is_exact(&self) -> bool {
        self.margin.offset_m == 0.0
    }

    /// True if the level is the plain sum of the weights of all links.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.is_exact() && self.assume == Assume::Obedient
    }

    /// The least weight that a link may have; −1 where there is none for certain.
    pub(crate) fn entry<const D: usize>(&self, offset: &Vector<D>) -> f64 {
        let error_m = self.margin.offset_m;
        if self.is_exact() {
            return self.link(offset).map_or(-1.0, |link| link.weight);
        }
        let distance_m = length(offset);
        let radius_m = self.curvature.link().radius_m;
        if distance_m <= radius_m + error_m { self.weight(&[distance_m + error_m]) } else { -1.0 }
    }

    pub(crate) fn weight<const D: usize>(&self, offset: &Vector<D>) -> f64 {
        self.link(offset).map_or(0.0, |link| link.weight)
    }

    /// How much more a weight may be than the least it may be.
    pub(crate) fn weight_error(&self) -> f64 {
        2.0 * self.margin.offset_m * self.curvature.fall_max()
    }

    /// True unless a robot at `offset` is out of range for certain.
    pub(crate) fn in_range<const D: usize>(&self, offset: &Vector<D>) -> bool {
        let (radius_m, error_m) = (self.curvature.link().radius_m, self.margin.offset_m);
        let sight_m = radius_m + error_m;
        sight_m * sight_m - dot(offset, offset) >= 0.0
    }

    /// Sum of the positive `weights` and `copies` more of size `extra`, without the F largest of them under [`Assume::Free`].
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
        kept.iter().fold(0.0, |sum, weight| sum + weight.max(0.0)) + number(copies) * extra
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
