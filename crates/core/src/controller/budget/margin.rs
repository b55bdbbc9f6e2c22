//! Room for wrong positions: what a robot still knows of a link, and of a row, when positions are known only to some error.

use crate::controller::budget::knowledge::{Assume, Sighting};
use crate::controller::budget::settings::Budget;
use crate::equations::link::Link;
use crate::num::{Vector, dot, length};

/// Bounds of the errors of sensing and tracking, as the theorem needs them.
///
/// Let every sensed position be wrong by at most e, and let every robot be at most ε from where its velocities would have
/// taken it. The theorem is then about *references*. The reference of a robot is the position that it sensed first plus all
/// its moves. The robot knows its own reference exactly, and moves it exactly as the rows say. The reference lies within
/// `A = e + ε` of the robot; if ε = 0, then `A = 0` and the robot is its own reference. What others sense of a reference is
/// wrong by at most `E = e + A`, so an offset is wrong by at most `2E`.
///
/// | what the theorem needs | what makes it so |
/// | --- | --- |
/// | links of references are links of robots | their radius is `R − 2A` |
/// | robots as far apart as Δ_d | references as far apart as `Δ_d + 2A` |
/// | no row is left out | rows for all that are sensed within `R + 2e` |
/// | `b ≤ h⁺`, `δ⁺ ≥ δ` | weights at `distance + 2E`, degrees within `R − 2A + 2E` |
/// | a row `n·v + c|v|² ≤ b` of the true offset | `(n + μ s)·v + c|v|² ≤ b` for every `s ∈ {±1}ᴰ`, `μ` a bound of the error of n |
///
/// The last line holds because `n_true·v ≤ n·v + μ|v| ≤ n·v + μ Σ|v_d|`. Every such set is still convex and contains 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorBounds {
    /// A, m: how far a robot may be from its reference.
    pub away_m: f64,
    /// 2E, m: bound of the error of an offset between two references.
    pub offset_m: f64,
    /// How much of it is there only because a robot was not sensed in this tick, m: how far it can have gone since.
    pub unsensed_m: f64,
}

impl ErrorBounds {
    /// Exact positions and moves.
    pub const NONE: Self = Self { away_m: 0.0, offset_m: 0.0, unsensed_m: 0.0 };

    /// The bounds for e = `position_error_m` and ε = `tracking_error_m`.
    //= theory sec:margins
    #[must_use]
    pub fn new(position_error_m: f64, tracking_error_m: f64) -> Self {
        let away_m = if tracking_error_m > 0.0 { position_error_m + tracking_error_m } else { 0.0 };
        Self { away_m, offset_m: 2.0 * (position_error_m + away_m), unsensed_m: 0.0 }
    }

    /// E, m: how far a sensed position may lie from the reference.
    #[must_use]
    pub fn sensed_m(&self) -> f64 {
        0.5 * self.offset_m
    }
}

impl Budget {
    /// The same with offsets that may be wrong by `unsensed_m` (m) more: for a robot that can have gone so far since it was
    /// sensed, or for two such robots.
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
            return self.link(offset).map_or(-1.0, |link| link.weight);
        }
        let (distance_m, error_m) = (length(offset), self.errors.offset_m);
        let radius_m = self.curvature.link().radius_m;
        if distance_m <= radius_m + error_m { self.weight_at(distance_m + error_m) } else { -1.0 }
    }

    /// The weight of a link of this length; 0 beyond R.
    pub(crate) fn weight_at(&self, distance_m: f64) -> f64 {
        self.link(&[distance_m]).map_or(0.0, |link| link.weight)
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

#[cfg(test)]
mod tests {
    use super::*;

    //= theory sec:margins type=test
    #[test]
    fn error_bounds_by_hand() {
        assert_eq!(ErrorBounds::new(0.0, 0.0), ErrorBounds::NONE);
        let bounds = |away_m, offset_m| ErrorBounds { away_m, offset_m, unsensed_m: 0.0 };
        assert_eq!(ErrorBounds::new(0.25, 0.0), bounds(0.0, 0.5));
        assert_eq!(ErrorBounds::new(0.25, 0.5), bounds(0.75, 2.0));
        assert_eq!(ErrorBounds::new(0.25, 0.5).sensed_m(), 1.0);
    }
}
