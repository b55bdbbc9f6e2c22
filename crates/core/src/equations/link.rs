//! Smooth weight of a link of the proximity graph.

use crate::num::exponential::{exp, exps, vanish};
use crate::num::number::Number;
use crate::num::scaled::Scaled;
use crate::num::{Vector, dot};

/// How many pairs of robots are computed at a time where there are many.
pub(crate) const PAIRS: usize = 2;

/// Of an exponent below this, e is less than what 1 + e and 1 − e are rounded by.
const FLAT: f64 = -40.0;

/// Shape of the link weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkShape {
    /// Communication radius R, m, positive.
    pub radius_m: f64,
    /// Height q₁ = 2 + ε, dimensionless; `0 < ε < 1/(n−1)` makes `h_i ≥ 0` imply degree ≥ F′ (lem:connectivity).
    pub q1: f64,
    /// Steepness q₂, 1/m⁴, positive.
    pub q2: f64,
}

/// A link as robot i sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link<N = Scaled> {
    /// `a_ij`, dimensionless, in `[0, q1/2]`. The end q1/2 is reached in floating point, though not in the paper.
    pub weight: f64,
    /// `2 ∂a/∂Δ²`, 1/m², never positive: the factor of `x_i − x_j` in ∂a_ij/∂x_i.
    pub slope: N,
}

impl LinkShape {
    /// Weight and slope of the link at `offset` = x_i − x_j (m); `None` if the two are farther apart than R.
    #[must_use]
    pub fn link<const D: usize, N: Number>(&self, offset: &Vector<D>) -> Option<Link<N>> {
        self.link_at(dot(offset, offset))
    }

    /// Weight and slope of the link at squared distance `Δ²` (m²); `None` beyond R² and for NaN.
    ///
    /// ```text
    /// s    = R² − Δ²,   e = exp(−q₂ s²)
    /// a_ij = q₁/(1 + e) − q₁/2 = (q₁/2) (1 − e)/(1 + e)
    /// ∂a_ij/∂x_i = −4 q₁ q₂ s e/(1 + e)² (x_i − x_j)
    /// ```
    ///
    /// Both reach zero together at the rim s = 0, so a link may form or break without a jump. With `N = Scaled` the slope
    /// keeps its own exponent: for robots close together it vanishes below what `f64` holds, but its direction matters.
    //= paper eq:adjacency
    #[inline]
    #[must_use]
    pub fn link_at<N: Number>(&self, distance_m2: f64) -> Option<Link<N>> {
        let slack_m2 = self.slack_m2(distance_m2);
        (slack_m2 >= 0.0).then(|| self.link_of(slack_m2, N::exp(self.exponent(slack_m2))))
    }

    /// The weight of [`link_at`](Self::link_at) alone, with its bits. Far inside the radius it is flat and takes no exponential.
    #[inline]
    #[must_use]
    pub fn weight_at(&self, distance_m2: f64) -> Option<f64> {
        let slack_m2 = self.slack_m2(distance_m2);
        let exponent = self.exponent(slack_m2);
        let weight = || self.link_of(slack_m2, exp(exponent)).weight;
        (slack_m2 >= 0.0).then(|| if exponent < FLAT { 0.5 * self.q1 } else { weight() })
    }

    /// [`link_at`](Self::link_at) of many pairs, with the bits of each. The weight is written in place of each squared
    /// distance, m², and the slope, 1/m², beside it. Without a link both are those of [`Link::NONE`]. Where one slice is
    /// longer, its rest stays as it is.
    pub fn links_at(&self, distances_m2: &mut [f64], slopes: &mut [f64]) {
        let count = distances_m2.len().min(slopes.len());
        let (pairs, rest) = distances_m2[..count].as_chunks_mut();
        let (pair_slopes, rest_slopes) = slopes[..count].as_chunks_mut();
        for (distances_m2, slopes) in pairs.iter_mut().zip(pair_slopes) {
            self.link_some::<PAIRS>(distances_m2, slopes);
        }
        for (distance_m2, slope) in rest.iter_mut().zip(rest_slopes) {
            let link = self.link_at(*distance_m2).unwrap_or(Link::NONE);
            (*distance_m2, *slope) = (link.weight, link.slope);
        }
    }

    #[inline]
    fn link_some<const L: usize>(&self, distances_m2: &mut [f64; L], slopes: &mut [f64; L]) {
        let slacks_m2 = distances_m2.map(|distance_m2| self.slack_m2(distance_m2));
        let exponents = slacks_m2.map(|slack_m2| self.exponent(slack_m2));
        if vanish(&exponents) && slacks_m2.iter().all(|slack_m2| *slack_m2 >= 0.0) {
            // Far inside the radius the weight is flat: `link_of` with e = 0, without its quotient.
            *distances_m2 = [0.5 * self.q1; L];
            *slopes = slacks_m2.map(|slack_m2| 0.0 * (-4.0 * self.q1 * self.q2 * slack_m2));
            return;
        }
        let tails = exps(exponents);
        let links: [Link<f64>; L] = core::array::from_fn(|k| self.link_of(slacks_m2[k], tails[k]));
        *distances_m2 =
            core::array::from_fn(|k| if slacks_m2[k] >= 0.0 { links[k].weight } else { Link::NONE.weight });
        *slopes =
            core::array::from_fn(|k| if slacks_m2[k] >= 0.0 { links[k].slope } else { Link::NONE.slope });
    }

    #[inline]
    pub(crate) fn slack_m2(&self, distance_m2: f64) -> f64 {
        self.radius_m * self.radius_m - distance_m2
    }

    /// The exponent `−q₂ s²` of e.
    #[inline]
    pub(crate) fn exponent(&self, slack_m2: f64) -> f64 {
        -self.q2 * slack_m2 * slack_m2
    }

    /// Weight and slope from s and e.
    #[inline]
    pub(crate) fn link_of<N: Number>(&self, slack_m2: f64, e: N) -> Link<N> {
        let tail = e.to_f64();
        let inverse = 1.0 / (1.0 + tail);
        let steepness = -4.0 * self.q1 * self.q2 * slack_m2 * inverse * inverse;
        Link { weight: 0.5 * self.q1 * (1.0 - tail) * inverse, slope: e.times_f64(steepness) }
    }
}

impl Link<f64> {
    /// Stands where there is no link. Both numbers are −0, which changes no sum and whose sign no weight has.
    pub const NONE: Self = Self { weight: -0.0, slope: -0.0 };

    /// False for the weight of [`Link::NONE`].
    #[inline]
    #[must_use]
    pub fn is_link(weight: f64) -> bool {
        weight.is_sign_positive()
    }
}

impl From<Link<f64>> for Link {
    fn from(link: Link<f64>) -> Self {
        Self { weight: link.weight, slope: Scaled::new(link.slope) }
    }
}

impl<N: Number> Link<N> {
    /// ∂a_ij/∂x_i, 1/m, for the `offset` the link was made from. By symmetry it is also ∂a_ji/∂x_i = ∂h_j/∂x_i.
    #[must_use]
    pub fn gradient<const D: usize>(&self, offset: &Vector<D>) -> Vector<D> {
        let slope = self.slope.to_f64();
        offset.map(|component| slope * component)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPE: LinkShape = LinkShape { radius_m: 3.0, q1: 2.05, q2: 0.9 };

    //= paper eq:adjacency type=test
    #[test]
    fn the_gradient_is_the_derivative_of_the_weight() {
        let h = 1e-6;
        for q2 in [0.05, 0.1, 0.3, 0.9] {
            let shape = LinkShape { q2, ..SHAPE };
            let weight = |r: f64| shape.link::<3, f64>(&[r, 0.3, -0.2]).map_or(0.0, |link| link.weight);
            for r in [0.5, 1.0, 2.0, 2.5, 2.8, 2.95, 2.97, 2.999] {
                let slope = (weight(r + h) - weight(r - h)) / (2.0 * h);
                let offset = [r, 0.3, -0.2];
                let gradient =
                    shape.link::<3, Scaled>(&offset).map_or([0.0; 3], |link| link.gradient(&offset));
                assert!((gradient[0] - slope).abs() < 1e-6, "at r = {r} m: {} and {slope}", gradient[0]);
            }
        }
    }

    #[test]
    fn weight_and_gradient_meet_zero_at_the_rim() {
        let rim = SHAPE.link::<2, f64>(&[3.0, 0.0]).unwrap();
        assert_eq!(rim.weight, 0.0);
        assert_eq!(rim.slope, 0.0);
        assert!(SHAPE.link::<2, f64>(&[3.0 + 1e-12, 0.0]).is_none());
        assert!(SHAPE.link::<2, f64>(&[f64::NAN, 0.0]).is_none());
    }

    #[test]
    fn the_weight_falls_with_distance_and_stays_in_its_range() {
        let mut last = SHAPE.q1 / 2.0;
        for step in 0..=3_000 {
            let weight = SHAPE.link::<1, f64>(&[f64::from(step) * 0.001]).unwrap().weight;
            assert!((0.0..=last).contains(&weight), "at step {step}");
            last = weight;
        }
    }

    #[test]
    fn the_weight_alone_has_the_bits_of_that_of_the_link() {
        for q2 in [0.0, 0.05, 0.3, 0.9, 3.0, 90.0] {
            let shape = LinkShape { q2, ..SHAPE };
            for step in 0..=40_000 {
                let distance_m2 = f64::from(step) * 0.000_25;
                let weight = shape.link_at::<f64>(distance_m2).map(|link| link.weight.to_bits());
                assert_eq!(shape.weight_at(distance_m2).map(f64::to_bits), weight, "at {distance_m2} m²");
            }
        }
    }

    #[test]
    fn many_links_have_the_bits_of_each() {
        let far_sighted = LinkShape { radius_m: 30.0, ..SHAPE };
        let strange = [f64::NAN, f64::INFINITY, -1.0, 0.0, 9.0, 9.0 + 1e-12, 1e300];
        for shape in [SHAPE, far_sighted, LinkShape { q2: 0.0, ..SHAPE }] {
            for start in 0..40_u16 {
                let ordinary = |k: u16| f64::from((start * 37 + k * k * 101) % 1000) * 0.0117;
                let mut distances_m2 = [0, 1, 2, 3, 4, 5, 6].map(ordinary);
                if start % 3 == 0 {
                    distances_m2[usize::from(start % 7)] = strange[usize::from(start / 3 % 7)];
                }
                let links = distances_m2.map(|distance_m2| shape.link_at::<f64>(distance_m2));
                let mut slopes = [1.0; 7];
                shape.links_at(&mut distances_m2, &mut slopes);
                for (link, found) in links.iter().zip(distances_m2.iter().zip(&slopes)) {
                    let link = link.unwrap_or(Link::NONE);
                    let bits = |x: &f64| x.to_bits();
                    assert_eq!((bits(&link.weight), bits(&link.slope)), (bits(found.0), bits(found.1)));
                }
            }
        }
    }

    #[test]
    fn the_slope_of_a_tight_cluster_is_tiny_but_not_lost() {
        let far_sighted = LinkShape { radius_m: 30.0, ..SHAPE };
        let link = far_sighted.link::<2, Scaled>(&[0.5, 0.0]).unwrap();
        assert_eq!(link.slope.value(), 0.0);
        assert!(link.slope.mantissa < 0.0 && link.slope.exponent < -100_000);
    }
}
