//! What a robot sees of the links between the robots around it, from one pass over all pairs of its sightings.

use core::ops::Range;

use crate::controller::assume::Assume;
use crate::controller::budget::knowledge::{Seen, Sighting, count};
use crate::controller::budget::settings::Budget;
use crate::controller::budget::sums::Links;
pub use crate::controller::budget::sums::Survey;
use crate::num::{is_finite, subtract};
use crate::robot::neighbor::Member;

impl Budget {
    /// How many numbers a survey of `sightings` robots needs, so that each pair of them is computed only once.
    #[must_use]
    pub const fn survey_len(assume: Assume, sightings: usize) -> usize {
        match assume {
            Assume::Obedient => sightings.saturating_mul(3),
            Assume::Free => sightings.saturating_mul(sightings),
        }
    }

    /// The survey of the `sightings` of robot `own`. `None` if one of them is not finite, or if `memory` is too short: 3·N
    /// numbers are needed for N sightings, N under [`Assume::Free`].
    ///
    /// Under [`Assume::Free`] each pair is computed once with [`survey_len`](Self::survey_len) numbers and twice with fewer.
    #[must_use]
    pub fn survey<'memory, const D: usize>(
        &self,
        own: impl Into<Member>,
        sightings: &[Sighting<D>],
        memory: &'memory mut [f64],
    ) -> Option<Survey<'memory>> {
        let own = own.into();
        let whole = sightings.iter().all(|sighting| is_finite(&sighting.offset_m));
        if !whole {
            return None;
        }
        // a trimmed level needs all weights at once; a plain one is added up with the links
        let level = match self.assume {
            Assume::Obedient => 0.0,
            Assume::Free => self.level(own, sightings, memory),
        };
        let links = Links::new(self.assume, sightings.len(), memory)?;
        let mut survey = Survey { own, level, links };
        self.add_all(sightings, &mut survey);
        Some(survey)
    }

    /// Adds all links in an order in which the sum of each robot is in order of numbers, the robot itself among the others.
    fn add_all<const D: usize>(&self, sightings: &[Sighting<D>], survey: &mut Survey<'_>) {
        let robots = sightings.len();
        let lower = sightings.iter().take_while(|sighting| sighting.id < survey.own.id).count();
        for first in 0..lower {
            self.add_pairs(first, first + 1..lower, sightings, survey);
            self.add_own(first, &sightings[first], survey);
            self.add_pairs(first, lower..robots, sightings, survey);
        }
        for (first, sighting) in sightings.iter().enumerate().skip(lower) {
            self.add_own(first, sighting, survey);
        }
        for first in lower..robots {
            self.add_pairs(first, first + 1..robots, sightings, survey);
        }
    }

    /// Adds the robot's own link to a sighting.
    fn add_own<const D: usize>(&self, index: usize, sighting: &Sighting<D>, survey: &mut Survey<'_>) {
        let link = self.link(&sighting.offset_m);
        let weight = match link {
            Some(link) if self.is_exact() && sighting.unsensed_m == 0.0 => link.weight,
            _ => self.weight_of(sighting),
        };
        if self.assume == Assume::Obedient && self.need.counts(survey.own, sighting.member()) {
            survey.level += weight.max(0.0);
        }
        let slope = link.map_or(0.0, |link| link.slope);
        survey.add_own(index, self.counted(sighting.member(), survey.own, weight), slope);
    }

    /// Adds the links of one sighting to later ones.
    fn add_pairs<const D: usize>(
        &self,
        first: usize,
        later: Range<usize>,
        sightings: &[Sighting<D>],
        survey: &mut Survey<'_>,
    ) {
        let (robots, one, own) = (sightings.len(), &sightings[first], survey.own);
        // What lies between two others matters where one of them counts for the other, for whom the robot itself counts.
        let matters = |one: &Sighting<D>, other: &Sighting<D>| {
            self.need.counts(one.member(), other.member()) && self.need.counts(one.member(), own)
        };
        match &mut survey.links {
            Links::Sums { lows, degrees, .. } => {
                let (mut low, mut degree) = (lows[first], degrees[first]);
                let sums = lows[later.clone()].iter_mut().zip(&mut degrees[later.clone()]);
                for (other, (other_low, other_degree)) in sightings[later].iter().zip(sums) {
                    let (counts, counted) = (matters(one, other), matters(other, one));
                    if !counts && !counted {
                        continue;
                    }
                    let weight = self.weight_between(one, other);
                    if weight >= 0.0 {
                        if counts {
                            low += weight;
                            degree += 1.0;
                        }
                        if counted {
                            *other_low += weight;
                            *other_degree += 1.0;
                        }
                    }
                }
                (lows[first], degrees[first]) = (low, degree);
            }
            Links::Table { weights, .. } => {
                for index in later {
                    let other = &sightings[index];
                    let (counts, counted) = (matters(one, other), matters(other, one));
                    let weight = if counts || counted { self.weight_between(one, other) } else { -1.0 };
                    weights[first * robots + index] = if counts { weight } else { -1.0 };
                    weights[index * robots + first] = if counted { weight } else { -1.0 };
                }
            }
            Links::Line(_) => {}
        }
    }

    /// What is seen of the links of `sightings[index]`, the sightings that the `survey` was made of, for which the robot itself
    /// counts. `None` if there is no such.
    #[must_use]
    pub fn seen<const D: usize>(
        &self,
        index: usize,
        sightings: &[Sighting<D>],
        survey: &mut Survey<'_>,
    ) -> Option<Seen> {
        let robot = sightings.get(index)?.member();
        let (own, robots) = (survey.own, sightings.len());
        let unseen = self.unseen(index, own, sightings);
        let own_weight = self.own_weight(own, &sightings[index]);
        let weights = match &mut survey.links {
            Links::Sums { lows, degrees, .. } => {
                let (low, degree) = (*lows.get(index)?, count(unseen) + *degrees.get(index)?);
                return Some(Seen { robot, own: own_weight, low, degree });
            }
            Links::Table { weights, .. } => weights.get_mut(index * robots..)?.get_mut(..robots)?,
            Links::Line(line) => {
                self.fill_line(index, own, sightings, line);
                &mut line[..]
            }
        };
        let (links, low) = self.trimmed(weights);
        Some(Seen { robot, own: own_weight, low, degree: count(unseen) + count(links) })
    }

    /// The slope of the link of `sightings[index]` to the robot itself, 1/m²; 0 without a link.
    pub(super) fn slope<const D: usize>(
        &self,
        index: usize,
        sighting: &Sighting<D>,
        survey: &Survey<'_>,
    ) -> f64 {
        match &survey.links {
            Links::Sums { slopes, .. } => slopes[index],
            _ => self.link(&sighting.offset_m).map_or(0.0, |link| link.slope),
        }
    }

    /// Fills the line of one sighting, as it would stand in the table.
    fn fill_line<const D: usize>(
        &self,
        index: usize,
        own: Member,
        sightings: &[Sighting<D>],
        line: &mut [f64],
    ) {
        let one = &sightings[index];
        for (place, (other, weight)) in sightings.iter().zip(line).enumerate() {
            *weight = if place == index {
                self.counted(one.member(), own, self.weight_of(one))
            } else {
                self.counted(one.member(), other.member(), self.weight_between(one, other))
            };
        }
    }

    /// The level of robot `own`, or the trimmed one under [`Assume::Free`]. Only that needs `scratch`, of one number
    /// a sighting; with less the level is 0.
    #[must_use]
    pub fn level<const D: usize>(
        &self,
        own: impl Into<Member>,
        sightings: &[Sighting<D>],
        scratch: &mut [f64],
    ) -> f64 {
        let own = own.into();
        let weights =
            sightings.iter().map(|sighting| self.counted(own, sighting.member(), self.weight_of(sighting)));
        if self.assume == Assume::Obedient {
            return weights.fold(0.0, |sum, weight| sum + weight.max(0.0));
        }
        let Some(scratch) = scratch.get_mut(..sightings.len()) else { return 0.0 };
        scratch.iter_mut().zip(weights).for_each(|(place, weight)| *place = weight);
        self.trimmed(scratch).1
    }

    fn weight_between<const D: usize>(&self, one: &Sighting<D>, other: &Sighting<D>) -> f64 {
        let offset_m = subtract(&other.position_m, &one.position_m);
        match one.unsensed_m + other.unsensed_m {
            0.0 => self.weight_lower_bound(&offset_m),
            unsensed_m => self.blurred(unsensed_m).weight_lower_bound(&offset_m),
        }
    }

    /// The least weight that the link of the robot itself with a sighting may have; −1 if there certainly is none.
    fn weight_of<const D: usize>(&self, sighting: &Sighting<D>) -> f64 {
        match sighting.unsensed_m {
            0.0 => self.weight_lower_bound(&sighting.offset_m),
            unsensed_m => self.blurred(unsensed_m).weight_lower_bound(&sighting.offset_m),
        }
    }

    /// The weight of a link as `robot` counts it: −1, as without a link, if `other` does not count for it.
    #[inline]
    fn counted(&self, robot: Member, other: Member, weight: f64) -> f64 {
        if self.need.counts(robot, other) { weight } else { -1.0 }
    }

    /// The least that the weight of robot `own` is among those that count for a sighting. Only ranks ask for it.
    fn own_weight<const D: usize>(&self, own: Member, sighting: &Sighting<D>) -> f64 {
        if !self.need.is_ranked() {
            return 0.0;
        }
        self.counted(sighting.member(), own, self.weight_of(sighting)).max(0.0)
    }

    /// How many robots that count for `sightings[index]` are not in sight of robot `own`.
    fn unseen<const D: usize>(&self, index: usize, own: Member, sightings: &[Sighting<D>]) -> usize {
        let robot = sightings[index].member();
        let others = sightings[..index].iter().chain(&sightings[index + 1..]);
        let seen = self.need.counting_among(robot, others.map(Sighting::member).chain([own]));
        usize::from(self.need.counting(robot)).saturating_sub(seen)
    }
}
