//! What a share of runs proves: exact bounds of Clopper and Pearson.

/// One-sided error of every bound.
const ERROR: f64 = 0.05;

/// Halvings of the interval: more than doubles can tell apart.
const HALVINGS: u32 = 100;

/// The largest probability of a violation that `violating` of `runs` leave possible at 95 %: with any larger one, so few
/// would be seen in less than one of twenty sweeps. 0 of N gives 1 − 0.05^(1/N), about 3/N; no runs at all give 1.
#[must_use]
pub fn upper_95(violating: u64, runs: u64) -> f64 {
    if violating >= runs {
        return 1.0;
    }
    let (k, n) = (count(violating), count(runs));
    let (mut low, mut high) = (k / n, 1.0);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if tail(k, n, middle) > ERROR { low = middle } else { high = middle }
    }
    high
}

/// The least probability that they leave possible at 95 %.
#[must_use]
pub fn lower_95(violating: u64, runs: u64) -> f64 {
    1.0 - upper_95(runs - violating.min(runs), runs)
}

/// Probability of at most `k` of `n` at probability `p` each, `k/n ≤ p < 1`.
///
/// From the term of k down each is less than the one before; the first is taken in the logarithm, the others relative to it.
fn tail(k: f64, n: f64, p: f64) -> f64 {
    let odds = (1.0 - p) / p;
    let (mut term, mut sum, mut i) = (1.0, 1.0, k);
    while i > 0.0 && term > sum * 1e-18 {
        term *= i / (n - i + 1.0) * odds;
        sum += term;
        i -= 1.0;
    }
    libm::exp(log_term(k, n, p) + libm::log(sum))
}

/// Logarithm of `C(n, k) pᵏ (1 − p)ⁿ⁻ᵏ`.
fn log_term(k: f64, n: f64, p: f64) -> f64 {
    let ways = libm::lgamma(n + 1.0) - libm::lgamma(k + 1.0) - libm::lgamma(n - k + 1.0);
    let hits = if k > 0.0 { k * libm::log(p) } else { 0.0 };
    (if k > 0.0 { ways } else { 0.0 }) + hits + (n - k) * libm::log1p(-p)
}

fn count(number: u64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "sweeps are far below 2^53 runs")]
    let count = number as f64;
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Found with exact fractions, `sum(comb(n, i) * p**i * (1 - p)**(n - i) for i in range(k + 1)) == 1/20`, and by hand
    /// for 0 and n.
    #[test]
    fn bounds_are_the_known_ones() {
        let known = [
            (0, 1, 0.95),
            (1, 10, 0.394_163_302_436_504_77),
            (5, 10, 0.777_558_898_991_870_9),
            (9, 10, 0.994_883_803_108_176_3),
            (0, 100, 0.029_513_049_607_039_935),
            (20, 100, 0.277_200_249_670_913_67),
            (3, 200, 0.038_309_708_498_569_35),
            (10, 10, 1.0),
            (0, 0, 1.0),
        ];
        for (k, n, expected) in known {
            assert!((upper_95(k, n) - expected).abs() < 1e-9, "{k} of {n}: {}", upper_95(k, n));
        }
    }

    #[test]
    fn none_in_n_is_about_three_in_n() {
        for n in [10_u64, 1_000, 10_000_000] {
            let exact = 1.0 - libm::exp(libm::log(0.05) / count(n));
            assert!((upper_95(0, n) - exact).abs() < 1e-9 * exact.max(1e-3));
            assert!((upper_95(0, n) * count(n) - 3.0).abs() < 0.5);
        }
    }

    #[test]
    fn bounds_enclose_the_share_and_mirror_each_other() {
        for (k, n) in [(0, 7), (3, 7), (7, 7), (500, 1_000), (4_999_999, 10_000_000)] {
            let share = count(k) / count(n);
            assert!(lower_95(k, n) <= share && share <= upper_95(k, n), "{k} of {n}");
            assert!((lower_95(k, n) - (1.0 - upper_95(n - k, n))).abs() < 1e-12);
        }
        let wide = upper_95(5_000_000, 10_000_000) - lower_95(5_000_000, 10_000_000);
        assert!((wide - 2.0 * 1.645 * 0.5 / 1e7_f64.sqrt()).abs() < 2e-6, "as the normal law says: {wide}");
    }
}
