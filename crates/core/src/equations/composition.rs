//! The paper's controller: all constraints composed into one function, split into one row a robot.
//!
//! The equations are exactly as printed: there is no recovery and no slack. The one choice is how φ is split
//! (docs/theory, `sec:split`).

use crate::equations::barrier::{collision_barrier, degree_barrier};
use crate::equations::link::{Link, PAIRS};
use crate::equations::scaling::{is_usual, plain_row, scaled_row, usual_row};
use crate::num::exponential::{exps, vanish};
use crate::num::number::Number;
use crate::num::scaled::Scaled;
use crate::num::{Vector, exp, is_finite};
use crate::program::box_row::Row;

/// How the composition is shared out among the robots in φ_i; the row H_i is the same for both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhiSplit {
    /// `Σ_{k∈B_i} Ê_k/(F′+1)`, as printed in eq:phi_i: exact only if every degree is F′.
    Neighbors,
    /// `Ê_i`: the sum over all robots is φ exactly, and φ_i does not jump when a link forms.
    Own,
}

/// Weights of the composition and its rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composed {
    /// How φ is split into φ_i.
    pub split: PhiSplit,
    /// `w_r` of the degree terms, dimensionless, positive.
    pub w_r: f64,
    /// `w_c` of the collision terms, 1/m², positive.
    pub w_c: f64,
    /// `α(s) = alpha·s`, 1/s, positive.
    pub alpha: f64,
    /// n, the number of robots.
    pub robots: u16,
    /// F′, how many neighbours a robot must keep.
    pub required: u16,
    /// Δ_d, m.
    pub distance_min_m: f64,
}

/// What robot i knows of a neighbour j when it builds its row.
#[derive(Clone, Copy, Debug)]
pub struct Term<const D: usize> {
    /// `x_i − x_j`, m.
    pub offset_m: Vector<D>,
    /// Link of the two.
    pub link: Link,
    /// `E^c_ij`.
    pub collision: Scaled,
    /// `Ê_j`, or 0 if j has told nothing.
    pub told: Scaled,
}

/// The row of one robot and the value it is measured against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composition<const D: usize> {
    /// The row of eq:split, scaled.
    pub row: Row<D>,
    /// φ_i (eq:phi_i), dimensionless, at most 1/n; saturates at the least `f64`.
    pub phi: f64,
}

impl Composed {
    /// `Ê_k = exp(−w_r ĥ_k)` of a told level `c_k`; E_k if the level is true.
    //= paper eq:composition
    #[must_use]
    pub fn degree_term<N: Number>(&self, level: f64) -> N {
        N::exp(self.degree_exponent(level))
    }

    /// `E^c_ij = exp(−w_c h^col_ij)` of two robots at squared distance `Δ²`, m².
    //= paper eq:composition
    #[inline]
    #[must_use]
    pub fn collision_term<N: Number>(&self, distance_m2: f64) -> N {
        N::exp(self.collision_exponent(distance_m2))
    }

    /// [`collision_term`](Self::collision_term) of many pairs, with the bits of each, in place of their squared distances, m².
    pub fn collision_terms(&self, distances_m2: &mut [f64]) {
        let exponent = |distance_m2: f64| self.collision_exponent(distance_m2);
        let (pairs, rest) = distances_m2.as_chunks_mut::<PAIRS>();
        for distances_m2 in pairs {
            let exponents = distances_m2.map(exponent);
            *distances_m2 = if vanish(&exponents) { [0.0; PAIRS] } else { exps(exponents) };
        }
        for distance_m2 in rest {
            *distance_m2 = exp(exponent(*distance_m2));
        }
    }

    /// The exponent of Ê_k.
    #[inline]
    pub(crate) fn degree_exponent(&self, level: f64) -> f64 {
        -self.w_r * degree_barrier(level, self.required)
    }

    /// The exponent of E^c_ij.
    #[inline]
    pub(crate) fn collision_exponent(&self, distance_m2: f64) -> f64 {
        -self.w_c * collision_barrier(distance_m2, self.distance_min_m)
    }

    /// φ_i and the row `H_i·u ≥ −α φ_i` of one robot, from its own `Ê_i` and its neighbours in order of their number.
    ///
    /// ```text
    /// φ_i = 1/n − Σ_{k∈B_i} Ê_k/(F′+1) − ½ Σ_j E^c_ij        (or Ê_i in place of the first sum)
    /// H_i = Σ_j [ w_r (Ê_i + Ê_j) ∂a_ij/∂x_i + 2 w_c E^c_ij (x_i − x_j) ]
    /// ```
    ///
    /// The second line is eq:split with ∂h^col_ij/∂x_i = 2 (x_i − x_j), ∂h_i/∂x_i = Σ_j ∂a_ij/∂x_i and ∂h_j/∂x_i = ∂a_ij/∂x_i.
    /// It is summed in plain `f64`, and again with free exponents if that overflowed or vanished. So a level of −10⁶, or
    /// robots close together far inside the radius, still give a row with a direction.
    //= paper eq:phi_i
    //= paper eq:split
    #[must_use]
    pub fn compose<const D: usize, Terms>(&self, own: Scaled, terms: Terms) -> Composition<D>
    where
        Terms: Iterator<Item = Term<D>> + Clone,
    {
        let plain: Sum<D, f64> = self.sum(own, terms.clone());
        plain.finish(self).unwrap_or_else(|| self.sum::<D, Scaled>(own, terms).finish_scaled(self))
    }

    /// φ_i alone, with the bits of [`compose`](Self::compose): from the own level, those that neighbours told, and the squared
    /// distances to all of them, m², in order of their number.
    #[must_use]
    pub fn phi(
        &self,
        own_level: f64,
        levels: impl Iterator<Item = f64> + Clone,
        distances_m2: impl Iterator<Item = f64> + Clone,
    ) -> f64 {
        let plain: f64 = self.sum_phi(own_level, levels.clone(), distances_m2.clone());
        if plain.is_finite() {
            return plain;
        }
        self.sum_phi::<Scaled>(own_level, levels, distances_m2).value().max(f64::MIN)
    }

    fn sum_phi<N: Number>(
        &self,
        own_level: f64,
        levels: impl Iterator<Item = f64>,
        distances_m2: impl Iterator<Item = f64>,
    ) -> N {
        let mut sum: Sum<0, N> = Sum::new(self.degree_term(own_level));
        for level in levels {
            sum.add_told(self.shared(self.degree_term(level)));
        }
        for distance_m2 in distances_m2 {
            sum.add_link(&[], N::ZERO, self.collision_term(distance_m2));
        }
        sum.phi(self)
    }

    fn sum<const D: usize, N: Number>(&self, own: Scaled, terms: impl Iterator<Item = Term<D>>) -> Sum<D, N> {
        let own = N::from_scaled(own);
        let mut sum = Sum::new(own);
        for term in terms {
            let told = N::from_scaled(term.told);
            let collision = N::from_scaled(term.collision);
            let pull = self.coefficient(own, told, N::from_scaled(term.link.slope), collision);
            sum.add_told(self.shared(told));
            sum.add_link(&term.offset_m, pull, collision);
        }
        sum
    }

    /// The factor of `x_i − x_j` in H_i, the same for both ends of the link:
    /// `w_r (Ê_i + Ê_j) slope_ij + 2 w_c E^c_ij`. In `f64` it is not finite if a slope that counts as 0 might matter.
    #[must_use]
    pub fn coefficient<N: Number>(&self, own: N, told: N, slope: N, collision: N) -> N {
        let degrees = own.plus(told).times_f64(HEADROOM).times(slope).times_f64(self.w_r / HEADROOM);
        degrees.plus(collision.times_f64(2.0 * self.w_c))
    }

    /// What a neighbour's `Ê_j` adds to the first sum of φ_i.
    #[must_use]
    pub fn shared<N: Number>(&self, told: N) -> N {
        match self.split {
            PhiSplit::Neighbors => told,
            PhiSplit::Own => N::ZERO,
        }
    }

    /// What the first sum of φ_i is multiplied with.
    fn portion(&self) -> f64 {
        match self.split {
            PhiSplit::Neighbors => 1.0 / (f64::from(self.required) + 1.0),
            PhiSplit::Own => 1.0,
        }
    }
}

/// The sums behind φ_i and H_i of one robot, for whoever computes a whole team at once.
///
/// The bits are those of [`Composed::compose`] if neighbours are added in order of their number.
#[derive(Clone, Copy, Debug)]
pub struct Sum<const D: usize, N> {
    normal: [N; D],
    degrees: N,
    collisions: N,
}

impl<const D: usize, N: Number> Sum<D, N> {
    /// The sums of a robot without neighbours: they have nothing but its own `Ê_i`.
    #[must_use]
    pub fn new(own: N) -> Self {
        Self { normal: [N::ZERO; D], degrees: own, collisions: N::ZERO }
    }

    /// The sums behind H_i, behind the first sum of φ_i and behind its last one.
    #[inline]
    pub(crate) fn of(normal: [N; D], degrees: N, collisions: N) -> Self {
        Self { normal, degrees, collisions }
    }

    /// Replaces the first sum of φ_i by `degrees`, that of `Ê_i` and of what all neighbours told.
    #[must_use]
    pub fn with_terms(self, degrees: N) -> Self {
        Self { degrees, ..self }
    }

    /// Adds what a neighbour told: the number of [`Composed::shared`].
    pub fn add_told(&mut self, shared: N) {
        self.degrees = self.degrees.plus(shared);
    }

    /// Adds a link at `offset` = x_i − x_j with the number of [`Composed::coefficient`]. Links whose slope and
    /// collision term are both 0 may be left out as long as every Ê is below [`TERM_LARGE`].
    pub fn add_link(&mut self, offset: &Vector<D>, coefficient: N, collision: N) {
        for d in 0..D {
            self.normal[d] = self.normal[d].plus(coefficient.times_f64(offset[d]));
        }
        self.collisions = self.collisions.plus(collision);
    }

    /// φ_i alone. In `f64` it is not finite if something overflowed; use [`Composed::phi`] then.
    #[must_use]
    pub fn phi(&self, composed: &Composed) -> N {
        let whole = N::from_f64(1.0 / f64::from(composed.robots));
        whole.plus(self.degrees.times_f64(-composed.portion())).plus(self.collisions.times_f64(-0.5))
    }
}

/// Rows below this size have lost terms to underflow and are summed again with free exponents.
const VANISHED: f64 = 1e-200;
/// 2⁸⁰⁰, multiplied in and out again without rounding: Ê beyond 2²²³ overflow and are summed with free exponents.
///
/// Below that, a slope under 2⁻¹⁰²¹, which `f64` takes for 0, costs a row at most 2⁻⁷⁹⁷ times w_r, an offset and the
/// number of neighbours: nothing beside a row of size `VANISHED`.
const HEADROOM: f64 = f64::from_bits((1023 + 800) << 52);
/// An Ê below this stays ordinary in every row; whoever leaves out links of slope 0 must look at it.
pub const TERM_LARGE: f64 = f64::from_bits((1023 + 200) << 52);

impl<const D: usize> Sum<D, f64> {
    /// φ_i and the row. `None` if something overflowed or vanished; use [`Composed::compose`] then.
    #[must_use]
    pub fn finish(&self, composed: &Composed) -> Option<Composition<D>> {
        let phi = self.phi(composed);
        let largest = self.normal.iter().fold(0.0, |most: f64, component| most.max(component.abs()));
        let ordinary = is_finite(&self.normal) && largest >= VANISHED && phi.is_finite();
        ordinary.then(|| Composition { row: plain_row(&self.normal, composed.alpha, phi), phi })
    }
}

impl<const D: usize> Sum<D, f64> {
    /// φ_i, the row, and whether they are what [`finish`](Self::finish) gives, which is so where all numbers are of a usual size. No
    /// branches: for many worlds at once.
    #[inline]
    pub(crate) fn usual(&self, composed: &Composed) -> (Composition<D>, bool) {
        let phi = self.phi(composed);
        let usual = is_usual(&self.normal, composed.alpha, phi);
        (Composition { row: usual_row(&self.normal, composed.alpha, phi), phi }, usual)
    }
}

impl<const D: usize> Sum<D, Scaled> {
    fn finish_scaled(&self, composed: &Composed) -> Composition<D> {
        let phi = self.phi(composed);
        let row = scaled_row(&self.normal, composed.alpha, phi);
        Composition { row, phi: phi.value().max(f64::MIN) }
    }
}
