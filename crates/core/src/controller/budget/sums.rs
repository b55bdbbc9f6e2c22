//! What a survey keeps of the links between sightings: sums of their weights, or the weights one by one.

use crate::controller::assume::Assume;
use crate::id::Member;

/// What the links of a robot's sightings come to.
#[derive(Debug)]
pub struct Survey<'memory> {
    /// The robot that has the sightings.
    pub(super) own: Member,
    /// Its own level, or its trimmed level under [`Assume::Free`].
    pub(super) level: f64,
    pub(super) links: Links<'memory>,
}

/// The links of each sighting.
#[derive(Debug)]
pub(super) enum Links<'memory> {
    /// For each sighting the sum of the weights, how many they are, and the slope of its link to the robot itself. This is enough
    /// if nothing is trimmed.
    Sums { lows: &'memory mut [f64], degrees: &'memory mut [f64], slopes: &'memory mut [f64] },
    /// For each sighting j a line with the weights of its links to all sightings, and in place j to the robot itself; −1 where
    /// there is no link. Trimming needs them one by one.
    Table { weights: &'memory mut [f64], robots: usize },
    /// One line of such a table, computed when it is needed.
    Line(&'memory mut [f64]),
}

impl<'memory> Links<'memory> {
    /// No links yet of so many `robots`; `None` if `memory` is too short.
    pub(super) fn new(assume: Assume, robots: usize, memory: &'memory mut [f64]) -> Option<Self> {
        match (assume, robots.checked_mul(robots)) {
            (Assume::Obedient, _) => {
                let (lows, rest) = memory.split_at_mut_checked(robots)?;
                let (degrees, rest) = rest.split_at_mut_checked(robots)?;
                let slopes = rest.get_mut(..robots)?;
                lows.fill(0.0);
                degrees.fill(0.0);
                Some(Self::Sums { lows, degrees, slopes })
            }
            (Assume::Free, Some(square)) if square <= memory.len() => {
                Some(Self::Table { weights: &mut memory[..square], robots })
            }
            (Assume::Free, _) => Some(Self::Line(memory.get_mut(..robots)?)),
        }
    }
}

impl Survey<'_> {
    /// The robot's own level, or its trimmed level under [`Assume::Free`].
    #[must_use]
    pub fn level(&self) -> f64 {
        self.level
    }

    /// Adds the link of a sighting with the robot itself.
    pub(super) fn add_own(&mut self, index: usize, weight: f64, slope: f64) {
        match &mut self.links {
            Links::Sums { lows, degrees, slopes } => {
                slopes[index] = slope;
                if weight >= 0.0 {
                    lows[index] += weight;
                    degrees[index] += 1.0;
                }
            }
            Links::Table { weights, robots } => weights[index * *robots + index] = weight,
            Links::Line(_) => {}
        }
    }
}
