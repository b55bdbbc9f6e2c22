//! What a robot knows of the spare connectivity h_j of a neighbour: what it senses, and nothing else.
//!
//! Positions bound the level of the neighbour from below and the number of its neighbours from above. Nothing is told, so there
//! is nothing to lie about, to lose or to be late.

use crate::controller::Glimpse;
use crate::controller::budget::settings::{Budget, Form};
use crate::num::{Vector, larger};
use crate::robot::neighbor::{Member, RobotId};

/// Another robot as robot i senses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting<const D: usize> {
    /// Which robot it is. A robot has one sighting of each other at most, in ascending order.
    pub id: RobotId,
    /// Its rank.
    pub rank: u16,
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
        Self { id: RobotId(0), rank: 0, offset_m: [0.0; D], position_m: [0.0; D], unsensed_m: 0.0 };

    /// The sighting of robot `other` by a robot at the origin; a number alone stands for rank 0.
    #[must_use]
    pub fn new(other: impl Into<Member>, offset_m: Vector<D>) -> Self {
        let Member { id, rank } = other.into();
        let position_m = offset_m.map(|component| -component);
        Self { id, rank, offset_m, position_m, unsensed_m: 0.0 }
    }

    /// The robot as the roster has it.
    #[inline]
    #[must_use]
    pub fn member(&self) -> Member {
        Member { id: self.id, rank: self.rank }
    }
}

/// What robot i sees of the links of a neighbour j.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// j.
    pub robot: Member,
    /// The least that the weight of i is among those that add up to `low`; 0 if i does not count for j.
    pub own: f64,
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
    /// δ⁺_ij: at least the number of neighbours that count for j, and at least 1. Under ranks what stands in its place, so that
    /// nobody needs to know how many there are ([`Budget::known`]).
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
    ///
    /// Under ranks the team may be so large that robots out of sight leave next to nothing. Then j may spend a third of what may be lost
    /// itself, a third is shared by weights, and a third by numbers:
    ///
    /// ```text
    /// 3/(δ⁺_ij + 1) = a_ij/low + 1/(links seen + robots out of sight)
    /// ```
    ///
    /// and the same with 2/δ⁺_ij where (far) leaves half to j.
    //= theory eq:known
    //= theory eq:known-ranked
    //= theory thm:sensed
    #[inline]
    #[must_use]
    pub fn known(&self, seen: &Seen) -> KnownMargin {
        let need = f64::from(self.need.need(seen.robot));
        let degree_max = larger(seen.degree, 1.0);
        KnownMargin {
            budget: larger(seen.low - need, 0.0),
            degree_max: if self.need.is_ranked() { self.parts(seen, degree_max) } else { degree_max },
        }
    }

    /// What stands in place of δ⁺_ij under ranks.
    //= theory eq:known-ranked
    fn parts(&self, seen: &Seen, degree_max: f64) -> f64 {
        let by_weight = if seen.low > 0.0 { seen.own / seen.low } else { 0.0 };
        let by_both = by_weight + 1.0 / degree_max;
        match self.form() {
            Form::Level => 3.0 / by_both - 1.0,
            Form::Link => 2.0 / by_both,
        }
    }

    /// What robot i knows of j in a world in which all sense exactly. Who sees everybody knows the level of j.
    //= theory eq:known
    #[inline]
    #[must_use]
    pub fn known_of(&self, glimpse: &Glimpse) -> KnownMargin {
        let degree = f64::from(glimpse.degree) + count(glimpse.unseen - glimpse.unseen_near);
        let low = if glimpse.unseen == 0 { glimpse.level } else { glimpse.low };
        self.known(&Seen { robot: glimpse.member, own: glimpse.weight, low, degree })
    }

    /// How many of `weights` are links, and the sum of those in ascending order without the F largest. The order of `weights` is lost.
    //= theory thm:free
    #[inline(never)]
    pub(super) fn trimmed(&self, weights: &mut [f64]) -> (usize, f64) {
        let mut links = 0;
        for index in 0..weights.len() {
            if weights[index] >= 0.0 {
                weights.swap(links, index);
                links += 1;
            }
        }
        // Numbers that are not negative are in the order of their bits.
        weights[..links].sort_unstable_by_key(|weight| weight.to_bits());
        let kept = links.saturating_sub(usize::from(self.faults));
        (links, weights[..kept].iter().fold(0.0, |sum, weight| sum + weight))
    }
}

/// A count as a floating-point number; exact, because no team has 2³² robots.
pub(super) fn count(number: usize) -> f64 {
    u32::try_from(number).map_or(f64::MAX, f64::from)
}
