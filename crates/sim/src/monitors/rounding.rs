//! How much numbers are rounded, as monitors take it.

use closeranks_core::num::{larger, sqrt};

/// Levels of few links are rounded by less than this, and squares of distances by less than this fraction of themselves.
pub(crate) const ROUNDING: f64 = 1e-11;
/// By no more than this is one weight wrong that `budget` chooses, and by no more than the square of the number of links times the other their sum
/// (docs/proofs.md, `level_rounded.v`).
const WEIGHT_ROUNDING: f64 = 2.5e-13;
const SUM_ROUNDING: f64 = 1.2e-16;
/// Coordinates are rounded by far less than this fraction of themselves in a tick.
const PLACE_ROUNDING: f64 = 1e-14;

/// How much the level of a robot with so many links may be rounded.
pub(crate) fn level_rounding(links: u16) -> f64 {
    let links = f64::from(links);
    larger(links * (WEIGHT_ROUNDING + SUM_ROUNDING * links), ROUNDING)
}

/// How much a squared distance of about `distance_m2` (m²) may be rounded, m², in a team that is nowhere farther from the origin than
/// `span_m`, m: it scales with the numbers compared.
pub(crate) fn rounding_m2(span_m: f64, distance_m2: f64) -> f64 {
    ROUNDING * distance_m2 + PLACE_ROUNDING * span_m * sqrt(distance_m2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// So many times the same weight, added one by one and exactly.
    fn error(weight: f64, links: u16) -> f64 {
        let scale = f64::from_bits((1023 + 52) << 52);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and positive")]
        let whole = |x: f64| (x * scale) as u128;
        let sum = (0..links).fold(0.0, |sum, _| sum + weight);
        let exact = whole(weight) * u128::from(links);
        #[expect(clippy::cast_precision_loss, reason = "a difference is told, not used")]
        let error = whole(sum).abs_diff(exact) as f64;
        error / scale
    }

    #[test]
    fn sums_of_many_weights_are_rounded_by_no_more_than_the_laws_allow() {
        let mut beyond = 0;
        for links in [11, 60, 200, 1_000, 10_000, 65_000] {
            for weight in [1.0 + 0.999 / 4_999.0, 0.1, 1.9, 2.0 / 3.0] {
                let error = error(weight, links);
                assert!(error <= level_rounding(links), "{links} times {weight}: {error}");
                beyond += usize::from(error > ROUNDING);
            }
        }
        assert!(beyond > 4, "{beyond}");
    }
}
