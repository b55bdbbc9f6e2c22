//! What all pairs of a robot's sightings come to, each pair computed once and nothing kept but sums.

use core::ops::Range;

use crate::controller::budget::interval::number;
use crate::controller::budget::knowledge::{Assume, Sighting, place};
use crate::controller::budget::settings::Budget;
use crate::num::subtract;

/// Sums over the links of a robot's sightings.
#[derive(Debug)]
pub(crate) struct Survey<'memory> {
    /// The robot's own level.
    pub(crate) level: f64,
    /// Of each sighting [`Interval::low`](crate::controller::budget::interval::Interval::low), and the neighbours that it may have, not yet at least 1.
    lows: &'memory mut [f64],
    degrees: &'memory mut [f64],
    /// Of its link to the robot, 0 without one.
    pub(crate) slopes: &'memory mut [f64],
    unseen: usize,
}

/// What a robot sees of the links of another, and hears from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Sum of the weights that it sees, its own link to the other among them, in order of numbers.
    pub low: f64,
    /// How many these are, and every robot that it does not see.
    pub degree: f64,
    /// Robots that it does not see.
    pub unseen: usize,
    /// What its claim is worth ([`Budget::worth`]).
    pub worth: f64,
}

impl Budget {
    /// What `tabulate` does, where sums need no table: under [`Assume::Obedient`], in `memory` for
    /// three numbers a sighting. `None` otherwise.
    ///
    /// Every weight is computed once and added for both ends, in order of numbers; what is out of range would add 0.
    pub(crate) fn survey<'memory, const D: usize>(
        &self,
        sightings: &[Sighting<D>],
        memory: &'memory mut [f64],
    ) -> Option<Survey<'memory>> {
        let (count, own) = (sightings.len(), place(sightings));
        if self.assume == Assume::Free || memory.len() / 3 < count {
            return None;
        }
        let (lows, rest) = memory.split_at_mut(count);
        let (degrees, rest) = rest.split_at_mut(count);
        let unseen = self.unseen(sightings);
        let mut survey = Survey { level: 0.0, lows, degrees, slopes: &mut rest[..count], unseen };
        survey.lows.fill(0.0);
        survey.degrees.fill(number(unseen));
        for first in 0..own {
            self.add_pairs(first, first + 1..own, sightings, &mut survey);
            self.add_own(first, &sightings[first], &mut survey);
            self.add_pairs(first, own..count, sightings, &mut survey);
        }
        for (first, sighting) in sightings.iter().enumerate().skip(own) {
            self.add_own(first, sighting, &mut survey);
        }
        for first in own..count {
            self.add_pairs(first, first + 1..count, sightings, &mut survey);
        }
        Some(survey)
    }

    /// Adds the robot's own link to a sighting.
    fn add_own<const D: usize>(&self, index: usize, sighting: &Sighting<D>, survey: &mut Survey<'_>) {
        let link = self.link(&sighting.offset_m);
        survey.slopes[index] = link.map_or(0.0, |link| link.slope);
        let weight = match link {
            Some(link) if self.is_exact() => link.weight,
            _ => self.entry(&sighting.offset_m),
        };
        survey.level += weight.max(0.0);
        survey.add(index, weight);
    }

    /// Adds the links of one sighting to later ones.
    fn add_pairs<const D: usize>(
        &self,
        first: usize,
        later: Range<usize>,
        sightings: &[Sighting<D>],
        survey: &mut Survey<'_>,
    ) {
        let of = &sightings[first].position_m;
        let (mut low, mut degree) = (survey.lows[first], survey.degrees[first]);
        let sums = survey.lows[later.clone()].iter_mut().zip(&mut survey.degrees[later.clone()]);
        for (other, (other_low, other_degree)) in sightings[later].iter().zip(sums) {
            let weight = self.entry(&subtract(&other.position_m, of));
            if weight >= 0.0 {
                low += weight;
                degree += 1.0;
                *other_low += weight;
                *other_degree += 1.0;
            }
        }
        (survey.lows[first], survey.degrees[first]) = (low, degree);
    }

    /// No more than [`high`](Self::high), without an exponential.
    pub(crate) fn high_at_least(&self, seen: &Seen, distance_m: f64) -> f64 {
        let near = self.nearest_m(distance_m) <= 0.5 * self.curvature.link().radius_m;
        let least = if near { self.curvature.least_within_half() } else { 0.0 };
        seen.low + number(seen.unseen) * least
    }

    /// [`Interval::high`](crate::controller::budget::interval::Interval::high) where nothing is trimmed.
    pub(crate) fn high(&self, seen: &Seen, distance_m: f64) -> f64 {
        let blur = if self.is_exact() { 0.0 } else { seen.degree * self.weight_error() };
        let more = match seen.unseen {
            0 => 0.0,
            unseen => number(unseen) * self.weight(&[self.nearest_m(distance_m)]),
        };
        blur + (seen.low + more)
    }
}

impl Survey<'_> {
    fn add(&mut self, index: usize, weight: f64) {
        if weight >= 0.0 {
            self.lows[index] += weight;
            self.degrees[index] += 1.0;
        }
    }

    /// What is seen of the links of a sighting whose claim is worth so much.
    pub(crate) fn seen(&self, index: usize, worth: f64) -> Seen {
        Seen { low: self.lows[index], degree: self.degrees[index], unseen: self.unseen, worth }
    }
}
