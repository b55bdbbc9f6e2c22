//! Where an axis has its numbers, and how numbers are written.

use crate::svg::trim;

/// Interval of an axis, both ends finite, `min < max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    /// Lower end.
    pub(crate) min: f64,
    /// Upper end.
    pub(crate) max: f64,
}

/// No axis has more ticks than this.
const MOST: u32 = 20;

/// Data beyond this are not drawn.
const LARGEST: f64 = 1e12;

/// A number that has a place on an axis.
#[must_use]
pub(crate) fn drawable(value: f64) -> bool {
    value.is_finite() && value.abs() <= LARGEST
}

impl Range {
    /// The least range with every drawable value in it; a single value gets room on both sides, none gives 0 to 1.
    #[must_use]
    pub(crate) fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let all = values.into_iter().filter(|value| drawable(*value));
        let (min, max) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), value| {
            (f64::min(min, value), f64::max(max, value))
        });
        if min > max { Self { min: 0.0, max: 1.0 } } else { Self { min, max }.at_least_wide() }
    }

    /// A range so narrow that ticks would drown in rounding is made wider around its middle.
    fn at_least_wide(self) -> Self {
        let least = 1e-9 * self.min.abs().max(self.max.abs());
        if self.width() > least.max(1e-12) { self } else { self.padded(0.5_f64.max(0.05 * self.max.abs())) }
    }

    /// Width.
    #[must_use]
    pub(crate) fn width(self) -> f64 {
        self.max - self.min
    }

    /// Wider by `margin` at both ends.
    #[must_use]
    pub(crate) fn padded(self, margin: f64) -> Self {
        Self { min: self.min - margin, max: self.max + margin }
    }

    /// Around the same middle, `width` wide.
    #[must_use]
    pub(crate) fn widened_to(self, width: f64) -> Self {
        self.padded(0.5 * (width - self.width()).max(0.0))
    }

    /// The least range that holds both.
    #[must_use]
    pub(crate) fn with(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// What both ranges share; `self` if that is nothing.
    #[must_use]
    pub(crate) fn within(self, other: Self) -> Self {
        let both = Self { min: self.min.max(other.min), max: self.max.min(other.max) };
        if both.min < both.max { both } else { self }
    }
}

/// A number on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    /// Where.
    pub(crate) value: f64,
    /// As written, with a true minus sign.
    pub(crate) label: String,
}

/// Round numbers (multiples of 1, 2 or 5 times a power of ten) inside `range`, at most `most` steps.
#[must_use]
pub(crate) fn ticks(range: Range, most: f64) -> Vec<Tick> {
    let (mantissa, exponent) = step(range.width() / most);
    let unit = f64::from(mantissa) * power_of_ten(exponent);
    let slack = 1e-9 * range.width();
    let first = ((range.min - slack) / unit).ceil();
    let counts = (0..=MOST).map(|index| first + f64::from(index));
    let values = counts.map(|count| (count, place(count * f64::from(mantissa), exponent)));
    let inside = values.filter(|(_, value)| *value <= range.max + slack);
    inside.map(|(count, value)| Tick { value, label: label(count, mantissa, exponent) }).collect()
}

/// The least 1, 2 or 5 times 10^exponent that is at least `least`.
fn step(least: f64) -> (u32, i32) {
    let mut exponent = 0;
    while power_of_ten(exponent) > least && exponent > -15 {
        exponent -= 1;
    }
    while power_of_ten(exponent + 1) <= least && exponent < 15 {
        exponent += 1;
    }
    let leading = least / power_of_ten(exponent) - 1e-9;
    [1, 2, 5]
        .into_iter()
        .find(|mantissa| f64::from(*mantissa) >= leading)
        .map_or((1, exponent + 1), |m| (m, exponent))
}

fn power_of_ten(exponent: i32) -> f64 {
    place(1.0, exponent)
}

/// `digits · 10^exponent`, rounded once: no noise like 0.30000000000000004.
fn place(digits: f64, exponent: i32) -> f64 {
    let power = (0..exponent.abs()).fold(1.0, |power, _| power * 10.0);
    if exponent < 0 { digits / power } else { digits * power }
}

fn label(count: f64, mantissa: u32, exponent: i32) -> String {
    let digits = count * f64::from(mantissa);
    let value = place(digits, exponent);
    if digits == 0.0 {
        "0".into()
    } else if exponent < -4 || value.abs() >= 1e6 {
        minus(&format!("{value:e}"))
    } else {
        minus(&format!("{value:.*}", usize::try_from(-exponent).unwrap_or(0)))
    }
}

/// With the sign as long as a plus.
fn minus(text: &str) -> String {
    text.replacen('-', "\u{2212}", 1)
}

/// A measured number for a title: at most three decimals.
#[must_use]
pub(crate) fn plain(value: f64) -> String {
    minus(&trim(&format!("{value:.3}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(min: f64, max: f64, most: f64) -> String {
        let labels: Vec<String> =
            ticks(Range { min, max }, most).into_iter().map(|tick| tick.label).collect();
        labels.join(" ")
    }

    #[test]
    fn ticks_are_round_and_without_noise() {
        assert_eq!(labels(0.0, 10.0, 5.0), "0 2 4 6 8 10");
        assert_eq!(labels(-0.31, 0.31, 6.0), "−0.2 0 0.2");
        assert_eq!(labels(-520.0, 520.0, 5.0), "−500 0 500");
        assert_eq!(labels(0.0, 0.005, 5.0), "0 0.001 0.002 0.003 0.004 0.005");
        assert_eq!(labels(-3.2, 2.9, 4.0), "−2 0 2");
        assert_eq!(labels(0.0, 2.5e7, 5.0), "0 5e6 1e7 1.5e7 2e7 2.5e7");
    }

    #[test]
    fn every_range_has_a_few_ticks_inside() {
        for width in [1e-11, 3e-7, 0.02, 1.0, 7.7, 99.0, 1e4, 1.9e12] {
            for min in [0.0, -0.37 * width, 0.2 * width] {
                let range = Range { min, max: min + width };
                let ticks = ticks(range, 5.0);
                assert!((2..=6).contains(&ticks.len()), "{range:?}: {ticks:?}");
                let slack = 1e-6 * width;
                assert!(ticks.iter().all(|t| t.value >= min - slack && t.value <= range.max + slack));
            }
        }
    }

    #[test]
    fn ranges_ignore_what_cannot_be_drawn() {
        assert_eq!(Range::of([f64::NAN, 2.0, f64::INFINITY, -1.0, 1e300]), Range { min: -1.0, max: 2.0 });
        assert_eq!(Range::of([]), Range { min: 0.0, max: 1.0 });
        assert_eq!(Range::of([3.0]), Range { min: 2.5, max: 3.5 });
        assert!(ticks(Range::of([1e12, 1e12 + 1.0]), 5.0).len() >= 2);
    }

    #[test]
    fn plain_numbers_are_short() {
        assert_eq!([10.000_000_1, 0.005, -2.5, -0.000_1].map(plain), ["10", "0.005", "\u{2212}2.5", "0"]);
    }
}
