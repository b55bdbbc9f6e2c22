//! What all pairs of a robot's sightings come to, each pair computed once and nothing kept but sums.

use crate::budget::interval::number;
use crate::budget::knowledge::{Assume, Sighting};
use crate::budget::settings::Budget;
use crate::math::{Vector, subtract};

/// Sums over the links of a robot's sightings.
#[derive(Debug)]
pub(crate) struct Survey<'memory> {
    /// The robot's own level.
    pub(crate) level: f64,
    /// Of each sighting [`Interval::low`](crate::budget::interval::Interval::low), and the neighbours that it may have, not yet at least 1.
    pub(crate) lows: &'memory mut [f64],
    pub(crate) degrees: &'memory mut [f64],
    /// Of its link to the robot, [`NO_SLOPE`] without one.
    slopes: &'memory mut [f64],
}

/// Stands for no link; slopes are never positive.
const NO_SLOPE: f64 = 1.0;

impl Budget {
    /// What `tabulate` does, where sums need no table: under [`Assume::Obedient`], in `memory` for
    /// three numbers a sighting. `None` otherwise.
    ///
    /// Every weight is computed once and added for both ends, in order of the sightings; what is out of range would add 0.
    pub(crate) fn survey<'memory, const D: usize>(
        &self,
        sightings: &[Sighting<D>],
        memory: &'memory mut [f64],
    ) -> Option<Survey<'memory>> {
        let count = sightings.len();
        if self.assume == Assume::Free || memory.len() / 3 < count {
            return None;
        }
        let (lows, rest) = memory.split_at_mut(count);
        let (degrees, rest) = rest.split_at_mut(count);
        let mut survey = Survey { level: 0.0, lows, degrees, slopes: &mut rest[..count] };
        survey.lows.fill(0.0);
        survey.degrees.fill(number(self.unseen(sightings)));
        for (first, Sighting { offset_m, .. }) in sightings.iter().enumerate() {
            let link = self.link(offset_m);
            survey.slopes[first] = link.map_or(NO_SLOPE, |link| link.slope);
            let weight = match link {
                Some(link) if self.is_exact() => link.weight,
                _ => self.entry(offset_m),
            };
            survey.level += weight.max(0.0);
            survey.add(first, weight);
            self.add_pairs(first, sightings, &mut survey);
        }
        Some(survey)
    }

    /// Adds the links of one sighting to all later ones.
    fn add_pairs<const D: usize>(&self, first: usize, sightings: &[Sighting<D>], survey: &mut Survey<'_>) {
        let (before, after) = sightings.split_at(first + 1);
        let Some(Sighting { offset_m: of, .. }) = before.last() else { return };
        let (low, lows) = split(survey.lows, first);
        let (degree, degrees) = split(survey.degrees, first);
        for ((other, other_low), other_degree) in after.iter().zip(lows).zip(degrees) {
            let weight = self.entry(&subtract(&other.offset_m, of));
            if weight >= 0.0 {
                *low += weight;
                *degree += 1.0;
                *other_low += weight;
                *other_degree += 1.0;
            }
        }
    }

    /// [`Interval::high`](crate::budget::interval::Interval::high) where nothing is trimmed.
    pub(crate) fn high<const D: usize>(
        &self,
        low: f64,
        offset: &Vector<D>,
        degree: f64,
        unseen: usize,
    ) -> f64 {
        let blur = if self.is_exact() { 0.0 } else { degree * self.weight_error() };
        let more = match unseen {
            0 => 0.0,
            _ => number(unseen) * self.weight(&[self.nearest_m(offset)]),
        };
        blur + (low + more)
    }
}

impl Survey<'_> {
    fn add(&mut self, index: usize, weight: f64) {
        if weight >= 0.0 {
            self.lows[index] += weight;
            self.degrees[index] += 1.0;
        }
    }

    /// ∂a/∂x of the link to a sighting at `offset`, 1/m.
    pub(crate) fn gradient<const D: usize>(&self, index: usize, offset: &Vector<D>) -> Vector<D> {
        let slope = self.slopes[index];
        if slope <= 0.0 { offset.map(|component| slope * component) } else { [0.0; D] }
    }
}

/// Element `index` and those after it.
fn split(numbers: &mut [f64], index: usize) -> (&mut f64, &mut [f64]) {
    let (before, after) = numbers.split_at_mut(index + 1);
    (&mut before[index], after)
}
