//! How fast, and how sharply, a link can weaken within one tick.

use crate::equations::link::{LinkShape, PAIRS};
use crate::num::exp;
use crate::num::exponential::exps;

/// `z` with `z tanh z = 1/4`: where the weight falls fastest with the squared distance.
const STEEPEST: f64 = 0.521_813_447_795_768_5;
/// Both bounds are raised by this factor, so that rounding never makes them too small.
const RAISE: f64 = 1.0 + 1e-12;
/// So many halvings exhaust the digits of an `f64`.
const HALVINGS: usize = 64;

/// Largest first and second derivatives of the link weight over the distances that a pair can reach in one tick.
///
/// With `s = R² − Δ²`, `z = q₂s²/2` and `e = exp(−q₂s²)`:
///
/// ```text
/// f(s) = −da/dΔ² = 2 q₁q₂ s e/(1+e)²
/// K(s) = −(least eigenvalue of the Hessian of r → a(|r|)) = 2 f(s) + 4 (R² − s) (−f′(s))⁺
/// −f′(s) = 2 q₁q₂ e/(1+e)² (4 z tanh z − 1)
/// ```
///
/// Both rise to one peak and fall from there, so the largest value on an interval of s is at its point closest to the
/// peak: a closed form, not a bound of one. For f the peak is at `4 z tanh z = 1`. For K it is found once, by halving:
///
/// Below `4 z tanh z = 1`, K = 2f rises. Above, let `g = −f′ > 0`; then `K′ = −6 g + 4 (R² − s) g′` has the sign of
/// `g′/g − 3/(2(R² − s))`, whose second term grows in magnitude with s. With `z = x²`, g is `sech² z (z tanh z − 1/4)` up to
/// a factor. `sech²(x²)` is log-concave. So is `p = x² tanh x²`, because `(log p)′ = 2/x + 4x/sinh 2x²` falls; and then
/// `p − c` is too where it is positive: `p″(p − c) ≤ p p″ ≤ p′²` where p″ > 0. Hence `g′/g` falls from +∞: one sign change. ∎
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature {
    link: LinkShape,
    /// s at the peak of f, m².
    steepest_m2: f64,
    /// s at the peak of K, m², at most R².
    sharpest_m2: f64,
}

impl Curvature {
    /// Finds the two peaks. That takes some 64 exponentials, once.
    #[must_use]
    pub fn new(link: LinkShape) -> Self {
        let steepest_m2 = crate::num::sqrt(2.0 * STEEPEST / link.q2);
        let radius_m2 = link.radius_m * link.radius_m;
        let (mut low, mut high) = (steepest_m2, radius_m2);
        if low >= high {
            return Self { link, steepest_m2, sharpest_m2: radius_m2 };
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *if rises(&link, middle) { &mut low } else { &mut high } = middle;
        }
        Self { link, steepest_m2, sharpest_m2: low }
    }

    /// The shape of the links.
    #[must_use]
    pub fn link(&self) -> &LinkShape {
        &self.link
    }

    /// `L`, 1/m²: the largest |da/dΔ²| while a pair at `distance_m`, known to `error_m`, moves apart, each by at most
    /// `move_max_m`.
    ///
    /// Not negative; 0 for a pair at R or farther. NaN in, NaN out.
    //= theory eq:slope-bound
    #[must_use]
    pub fn slope_max(&self, distance_m: f64, move_max_m: f64, error_m: f64) -> f64 {
        let (low, high) = self.slacks(distance_m - error_m, distance_m + (2.0 * move_max_m + error_m));
        if high <= 0.0 {
            return 0.0;
        }
        RAISE * slope(&self.link, closest(self.steepest_m2, low, high))
    }

    /// `κ`, 1/m²: the largest negative curvature of `r → a(|r|)` for |r| within two longest moves of `distance_m`, which is
    /// known to `error_m`.
    ///
    /// `a(r + e) ≥ a(r) + ∇a·e − κ/2 |e|²` for |e| up to twice `move_max_m`, across the rim as well: there the gradient
    /// is continuous and the weight convex. Not negative. NaN in, NaN out.
    //= theory eq:curvature-bound
    #[inline]
    #[must_use]
    pub fn bend_max(&self, distance_m: f64, move_max_m: f64, error_m: f64) -> f64 {
        let [bend] = self.bend_some([distance_m], move_max_m, error_m);
        bend
    }

    /// [`bend_max`](Self::bend_max) of many pairs, in place of their distances, m.
    pub fn bends_max(&self, distances_m: &mut [f64], move_max_m: f64, error_m: f64) {
        let (pairs, rest) = distances_m.as_chunks_mut::<PAIRS>();
        for distances_m in pairs {
            *distances_m = self.bend_some(*distances_m, move_max_m, error_m);
        }
        for distance_m in rest {
            *distance_m = self.bend_max(*distance_m, move_max_m, error_m);
        }
    }

    #[inline]
    fn bend_some<const L: usize>(&self, distances_m: [f64; L], move_max_m: f64, error_m: f64) -> [f64; L] {
        let reach_m = 2.0 * move_max_m + error_m;
        let slacks = distances_m.map(|distance_m| self.slacks(distance_m - reach_m, distance_m + reach_m));
        let sharpest = slacks.map(|(low, high)| closest(self.sharpest_m2, low, high));
        let tails = exps(sharpest.map(|slack_m2| self.link.exponent(slack_m2)));
        let bends: [f64; L] = core::array::from_fn(|k| RAISE * bend_of(&self.link, sharpest[k], tails[k]));
        core::array::from_fn(|k| if slacks[k].1 <= 0.0 { 0.0 } else { bends[k] })
    }

    /// Bound of the error of the gradient of `r → a(|r|)`, 1/m, at `distance_m` when r is wrong by at most `error_m`.
    ///
    /// It is `M · error_m`, with M the largest |eigenvalue| of the Hessian in reach. That is K, or near the rim, where the
    /// weight is convex, the radial eigenvalue `4 (R² − s) f′(s) − 2 f(s)`, which falls with s as long as it is positive.
    //= theory eq:gradient-error
    #[inline]
    #[must_use]
    pub fn gradient_error(&self, distance_m: f64, error_m: f64) -> f64 {
        if error_m == 0.0 { 0.0 } else { self.bend_error(distance_m, error_m) }
    }

    fn bend_error(&self, distance_m: f64, error_m: f64) -> f64 {
        let (low, high) = self.slacks(distance_m - error_m, distance_m + error_m);
        if high <= 0.0 {
            return 0.0;
        }
        let sharpest_m2 = closest(self.sharpest_m2, low, high);
        let sharpest = bend_of(&self.link, sharpest_m2, exp(self.link.exponent(sharpest_m2)));
        RAISE * sharpest.max(swell(&self.link, low)) * error_m
    }

    /// Bound of how fast the weight falls with the distance, 1/m: `2 R f(s)` at the peak of f.
    #[must_use]
    pub fn fall_max(&self) -> f64 {
        let radius_m = self.link.radius_m;
        let steepest_m2 =
            if self.steepest_m2 < radius_m * radius_m { self.steepest_m2 } else { radius_m * radius_m };
        RAISE * 2.0 * radius_m * slope(&self.link, steepest_m2)
    }

    /// The interval of s between two distances. Its low end, at the farther distance, is at least 0. A nearer distance below 0
    /// counts as 0.
    fn slacks(&self, nearer_m: f64, farther_m: f64) -> (f64, f64) {
        let nearer_m = if nearer_m < 0.0 { 0.0 } else { nearer_m };
        let radius_m2 = self.link.radius_m * self.link.radius_m;
        let low = radius_m2 - farther_m * farther_m;
        (if low < 0.0 { 0.0 } else { low }, radius_m2 - nearer_m * nearer_m)
    }
}

/// The point of `[low, high]` closest to `peak`; NaN if an end is.
fn closest(peak: f64, low: f64, high: f64) -> f64 {
    match peak {
        _ if low.is_nan() || high.is_nan() => f64::NAN,
        peak if peak < low => low,
        peak if peak > high => high,
        peak => peak,
    }
}

/// `2 q₁q₂ e/(1+e)²`, 1/m⁴, and `4 z tanh z`, from s and e.
#[inline]
fn tail_of(link: &LinkShape, slack_m2: f64, e: f64) -> (f64, f64) {
    let square = link.q2 * slack_m2 * slack_m2;
    let inverse = 1.0 / (1.0 + e);
    (2.0 * link.q1 * link.q2 * e * inverse * inverse, 2.0 * square * (1.0 - e) * inverse)
}

fn tail(link: &LinkShape, slack_m2: f64) -> (f64, f64) {
    tail_of(link, slack_m2, exp(link.exponent(slack_m2)))
}

/// f(s), 1/m².
fn slope(link: &LinkShape, slack_m2: f64) -> f64 {
    tail(link, slack_m2).0 * slack_m2
}

/// K(s), 1/m², from s and e.
#[inline]
fn bend_of(link: &LinkShape, slack_m2: f64, e: f64) -> f64 {
    let (factor, turn) = tail_of(link, slack_m2, e);
    let distance_m2 = link.radius_m * link.radius_m - slack_m2;
    2.0 * factor * (slack_m2 + 2.0 * distance_m2 * (turn - 1.0).max(0.0))
}

/// Radial eigenvalue of the Hessian where it is positive, 1/m².
fn swell(link: &LinkShape, slack_m2: f64) -> f64 {
    let (factor, turn) = tail(link, slack_m2);
    let distance_m2 = link.radius_m * link.radius_m - slack_m2;
    2.0 * factor * (2.0 * distance_m2 * (1.0 - turn) - slack_m2)
}

/// True where K still rises, for s at or above the peak of f.
///
/// ```text
/// 2 (R² − s) q₂ s [4 (tanh z + z sech² z) − 2 tanh z (4 z tanh z − 1)] > 3 (4 z tanh z − 1)
/// ```
fn rises(link: &LinkShape, slack_m2: f64) -> bool {
    let square = link.q2 * slack_m2 * slack_m2;
    let e = exp(-square);
    let tanh = (1.0 - e) / (1.0 + e);
    let turn = 2.0 * square * tanh - 1.0;
    let bracket = 4.0 * (tanh + 0.5 * square * (1.0 - tanh * tanh)) - 2.0 * tanh * turn;
    2.0 * (link.radius_m * link.radius_m - slack_m2) * link.q2 * slack_m2 * bracket > 3.0 * turn
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_no_slope_is_steepest_the_sharpest_bend_is_at_zero_distance() {
        assert_eq!(Curvature::new(LinkShape { radius_m: 0.1, q1: 2.1, q2: 0.3 }).sharpest_m2, 0.1 * 0.1);
    }
}
