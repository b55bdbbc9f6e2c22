//! Room for wrong positions: what a robot still knows of a link, and of a row, when positions are known only to some error.

use crate::controller::assume::Assume;
use crate::controller::budget::knowledge::Sighting;
use crate::controller::budget::settings::Budget;
use crate::controller::errors::ErrorBounds;
use crate::equations::link::Link;
use crate::num::{Vector, dot, length};

impl Budget {
    /// These parameters with offsets that may be wrong by `unsensed_m` (m) more: for a robot that can have gone so far since it
    /// was sensed, or for two such robots.
    //= theory sec:unsensed
    pub(crate) fn blurred(&self, unsensed_m: f64) -> Self {
        let offset_m = self.errors.offset_m + unsensed_m;
        Self { errors: ErrorBounds { offset_m, unsensed_m, ..self.errors }, ..*self }
    }

    /// True if positions and moves are exact.
    pub(crate) fn is_exact(&self) -> bool {
        self.errors.offset_m == 0.0
    }

    /// True if the level is the plain sum of the weights of all links.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.is_exact() && self.assume == Assume::Obedient
    }

    /// The link at `offset` (m) as it is if the offset is exact; `None` beyond R.
    pub(crate) fn link<const D: usize>(&self, offset: &Vector<D>) -> Option<Link<f64>> {
        self.curvature.link().link_at(dot(offset, offset))
    }

    /// The least weight that the link at the sensed `offset` (m) may have; −1 if there certainly is no link.
    //= theory sec:margins
    pub(crate) fn weight_lower_bound<const D: usize>(&self, offset: &Vector<D>) -> f64 {
        if self.is_exact() {
            return self.curvature.link().weight_at(dot(offset, offset)).unwrap_or(-1.0);
        }
        let (distance_m, error_m) = (length(offset), self.errors.offset_m);
        let radius_m = self.curvature.link().radius_m;
        if distance_m <= radius_m + error_m { self.weight_at(distance_m + error_m) } else { -1.0 }
    }

    /// The weight of a link of this length; 0 beyond R.
    pub(crate) fn weight_at(&self, distance_m: f64) -> f64 {
        self.curvature.link().weight_at(distance_m * distance_m).unwrap_or(0.0)
    }

    /// How much more a weight may be than its lower bound.
    pub(crate) fn weight_error(&self) -> f64 {
        2.0 * self.errors.offset_m * self.curvature.fall_max()
    }

    /// True unless a robot at the sensed `offset` (m) is certainly out of range.
    pub(crate) fn in_range<const D: usize>(&self, offset: &Vector<D>) -> bool {
        let sight_m = self.curvature.link().radius_m + self.errors.offset_m;
        sight_m * sight_m - dot(offset, offset) >= 0.0
    }

    /// True unless a sighting is certainly out of range.
    pub(crate) fn is_in_range<const D: usize>(&self, sighting: &Sighting<D>) -> bool {
        match sighting.unsensed_m {
            0.0 => self.in_range(&sighting.offset_m),
            unsensed_m => self.blurred(unsensed_m).in_range(&sighting.offset_m),
        }
    }
}
