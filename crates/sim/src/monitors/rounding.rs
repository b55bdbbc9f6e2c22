//! How much numbers are rounded, as monitors take it.

use closeranks_core::num::sqrt;

/// Sums of weights are rounded by far less than this, and squares of distances by less than this fraction of themselves.
pub(crate) const ROUNDING: f64 = 1e-11;
/// Coordinates are rounded by far less than this fraction of themselves in a tick.
const PLACE_ROUNDING: f64 = 1e-14;

/// How much a squared distance of about `distance_m2` (m²) may be rounded, m², in a team that is nowhere farther from the origin than
/// `span_m`, m: it scales with the numbers compared.
pub(crate) fn rounding_m2(span_m: f64, distance_m2: f64) -> f64 {
    ROUNDING * distance_m2 + PLACE_ROUNDING * span_m * sqrt(distance_m2)
}
