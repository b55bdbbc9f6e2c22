//! W-MSR: a mean that up to F liars cannot drag outside what normal robots hold.

/// One round of W-MSR at one robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    /// The new value, `y_i(t_{p+1})`.
    pub value: f64,
    /// How many of the smallest values were discarded, at most F.
    pub below: usize,
    /// How many of the largest values were discarded, at most F.
    pub above: usize,
    /// Least value kept, the robot's own included.
    pub low: f64,
    /// Greatest value kept, the robot's own included.
    pub high: f64,
    /// How many values of neighbours were kept.
    pub kept: usize,
}

/// The new value `y_i(t_{p+1})`, from the robot's own value and those its neighbours told, with equal weights.
///
/// ```text
/// sort; discard the F largest of the values strictly larger than y_i (all of them if fewer than F), likewise below;
/// y_i(t_{p+1}) = (y_i + Σ kept) / (1 + number kept)
/// ```
///
/// Values equal to `own` are never discarded, so with `faults = 0` this is the plain mean (eq:linear) and β = 1/n.
/// `told` is sorted in place and added up in sorted order, so the answer does not depend on the order in which messages
/// came. Values that are not finite count as not told. The answer lies between the least and the greatest value kept,
/// rounding included. `own` must be finite. Beyond 1e300 the sum may overflow; then the answer is one of these two values.
/// It takes O(k log k) for k values and allocates nothing.
//= paper eq:linear
//= theory thm:contraction
#[must_use]
pub fn update(own: f64, told: &mut [f64], faults: u16) -> Round {
    let finite = sort_finite(told);
    let smaller = finite.partition_point(|&value| value < own);
    let larger = finite.len() - finite.partition_point(|&value| value <= own);
    let (below, above) = (smaller.min(usize::from(faults)), larger.min(usize::from(faults)));
    mean_of_kept(own, finite, below, above)
}

/// Sorts the values and gives the finite ones.
pub(crate) fn sort_finite(told: &mut [f64]) -> &[f64] {
    told.sort_unstable_by(f64::total_cmp);
    let first = told.iter().position(|value| value.is_finite()).unwrap_or(told.len());
    let last = told.iter().rposition(|value| value.is_finite()).map_or(first, |index| index + 1);
    &told[first..last]
}

/// The mean of `own` and of `sorted` without its first `below` and last `above` values.
pub(crate) fn mean_of_kept(own: f64, sorted: &[f64], below: usize, above: usize) -> Round {
    let kept = &sorted[below..sorted.len() - above];
    let low = kept.first().map_or(own, |first| first.min(own));
    let high = kept.last().map_or(own, |last| last.max(own));
    Round {
        value: mean(own, kept.iter().copied(), kept.len(), low, high),
        below,
        above,
        low,
        high,
        kept: kept.len(),
    }
}

/// `(own + Σ kept)/(1 + count)`, added in the order given and cut to `[low, high]` against rounding and overflow.
///
/// This is for callers that have sorted the values of a whole team once; [`update`] is the usual entry.
#[must_use]
pub fn mean(own: f64, kept: impl Iterator<Item = f64>, count: usize, low: f64, high: f64) -> f64 {
    let sum = kept.fold(own, |sum, value| sum + value);
    #[expect(clippy::cast_precision_loss, reason = "counts of robots are far below 2^53")]
    let mean = sum / (count as f64 + 1.0);
    mean.max(low).min(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(own: f64, told: &[f64], faults: u16) -> f64 {
        update(own, &mut told.to_vec(), faults).value
    }

    extern crate std;

    //= paper eq:linear type=test
    #[test]
    fn without_faults_it_is_the_plain_mean() {
        assert_eq!(value(1.0, &[2.0, 3.0, -2.0], 0), 1.0);
        assert_eq!(value(5.0, &[], 0), 5.0);
    }

    #[test]
    fn the_f_largest_and_smallest_go_and_ties_with_oneself_stay() {
        let round = update(2.0, &mut [9.0, 8.0, 2.0, 2.0, 3.0, 1.0, 0.0], 2);
        assert_eq!((round.below, round.above, round.kept), (2, 2, 3));
        assert_eq!((round.low, round.high), (2.0, 3.0));
        assert_eq!(round.value, 9.0 / 4.0);
    }

    #[test]
    fn fewer_larger_values_than_f_are_all_discarded() {
        let round = update(2.0, &mut [7.0, 1.0], 3);
        assert_eq!((round.value, round.below, round.above, round.kept), (2.0, 1, 1, 0));
    }

    #[test]
    fn values_that_are_not_finite_count_as_not_told() {
        let mut told = [f64::NAN, 4.0, f64::INFINITY, -f64::NAN, f64::NEG_INFINITY, 2.0];
        let round = update(3.0, &mut told, 0);
        assert_eq!((round.value, round.kept), (3.0, 2));
        assert_eq!(update(3.0, &mut [f64::NAN, f64::INFINITY], 1).value, 3.0);
    }

    #[test]
    fn huge_values_stay_in_the_hull() {
        let round = update(1e308, &mut [f64::MAX, f64::MAX, 1e308], 0);
        assert!((round.low..=round.high).contains(&round.value), "{}", round.value);
        assert_eq!(value(0.1, &[0.1, 0.1], 0), 0.1);
    }
}
