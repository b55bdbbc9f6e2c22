//! What a robot knows of the spare connectivity h_j of a neighbour: what it senses, and nothing else.
//!
//! Positions bound the level of the neighbour from below and the number of its neighbours from above. Nothing is told, so there
//! is nothing to lie about, to lose or to be late.

use crate::controller::Glimpse;
use crate::controller::budget::settings::Budget;
use crate::num::{Vector, larger};
use crate::robot::neighbor::RobotId;

/// Another robot as robot i senses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting<const D: usize> {
    /// Which robot it is. A robot has one sighting of each other at most, in ascending order.
    pub id: RobotId,
    /// x_i − x_j, m.
    pub offset_m: Vector<D>,
    /// x_j, m, in a frame that all sightings share: what lies between two neighbours is the same for whoever sees them.
    pub position_m: Vector<D>,
    /// How far it can have gone since it was sensed, m; 0 for a robot that was sensed in this tick.
    pub unsensed_m: f64,
}

impl<const D: usize> Sighting<D> {
    /// A place holder in memory that is not filled yet.
    pub const NOBODY: Self =
        Self { id: RobotId(0), offset_m: [0.0; D], position_m: [0.0; D], unsensed_m: 0.0 };

    /// The sighting of robot `id` by a robot at the origin.
    #[must_use]
    pub fn new(id: RobotId, offset_m: Vector<D>) -> Self {
        let position_m = offset_m.map(|component| -component);
        Self { id, offset_m, position_m, unsensed_m: 0.0 }
    }
}

/// What robot i sees of the links of a neighbour j.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// j.
    pub robot: RobotId,
    /// The least that the level of j can be: the sum of the weights that i sees, its own link to j among them, in order of
    /// numbers. Under [`Assume::Free`](crate::controller::assume::Assume::Free) it is the trimmed sum.
    pub low: f64,
    /// How many links i sees, and every robot out of sight that counts for j.
    pub degree: f64,
}

/// What robot i knows of h_j.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KnownMargin {
    /// b_ij ≥ 0: for a robot that the theorem covers, never more than h_j⁺.
    pub budget: f64,
    /// δ⁺_ij: at least the number of neighbours that count for j, and at least 1.
    pub degree_max: f64,
}

impl Budget {
    /// b_ij and δ⁺_ij, what robot i may count on.
    ///
    /// ```text
    /// low = Σ_{p seen} a_jp ≤ c_j,    b_ij = max(low − need, 0),    δ⁺_ij = links seen + robots out of sight
    /// ```
    ///
    /// A robot that i does not see can only add to the level of j. Under [`Assume::Free`](crate::controller::assume::Assume::Free) the F
    /// largest of the same terms are left out; a trimmed sum falls too when terms are taken away. If offsets are known to 2E,
    /// every weight in `low` is that at `distance + 2E`.
    //= theory eq:known
    //= theory thm:sensed
    #[inline]
    #[must_use]
    pub fn known(&self, seen: &Seen) -> KnownMargin {
        let need = f64::from(self.need.need(seen.robot));
        KnownMargin { budget: larger(seen.low - need, 0.0), degree_max: larger(seen.degree, 1.0) }
    }

    /// What robot i knows of j in a world in which all sense exactly. Who sees everybody knows the level of j.
    //= theory eq:known
    #[inline]
    #[must_use]
    pub fn known_of(&self, glimpse: &Glimpse) -> KnownMargin {
        let degree = f64::from(glimpse.degree) + count(glimpse.unseen - glimpse.unseen_near);
        let low = if glimpse.unseen == 0 { glimpse.level } else { glimpse.low };
        self.known(&Seen { robot: glimpse.id, low, degree })
    }

    /// The sum of the positive ones of `weights`, which ascend, without the F largest.
    //= theory thm:free
    #[inline(never)]
    pub(super) fn trimmed(&self, weights: &[f64]) -> f64 {
        let kept = weights.len().saturating_sub(usize::from(self.faults));
        weights[..kept].iter().fold(0.0, |sum, weight| sum + weight.max(0.0))
    }
}

/// A count as a floating-point number; exact, because no team has 2³² robots.
pub(super) fn count(number: usize) -> f64 {
    u32::try_from(number).map_or(f64::MAX, f64::from)
}
