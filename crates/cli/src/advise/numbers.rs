//! Numbers of four digits, rounded to the side on which they are still true.

/// Digits that are shown.
const DIGITS: i32 = 4;

/// The nearest.
pub(super) fn plain(value: f64) -> String {
    shown(value, f64::round)
}

/// As it was given, unless that is long.
pub(super) fn given(value: f64) -> String {
    let text = value.to_string();
    if text.len() <= 12 { text } else { plain(value) }
}

/// Not more than the value: a largest allowed number that is copied is allowed.
pub(super) fn down(value: f64) -> String {
    shown(value, f64::floor)
}

/// Not less than the value.
pub(super) fn up(value: f64) -> String {
    shown(value, f64::ceil)
}

fn shown(value: f64, round: fn(f64) -> f64) -> String {
    if !value.is_finite() || value == 0.0 {
        return if value == 0.0 { "0".to_owned() } else { "-".to_owned() };
    }
    #[expect(clippy::cast_possible_truncation, reason = "an exponent of ten")]
    let size = value.abs().log10().floor() as i32;
    let after = usize::try_from(DIGITS - 1 - size).unwrap_or(0);
    if after > 12 {
        return format!("{value:.1e}");
    }
    let unit = 10_f64.powi(i32::try_from(after).unwrap_or(0));
    let text = format!("{:.after$}", round(value * unit) / unit);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_shown_is_on_the_right_side() {
        assert_eq!([plain(0.123_45), down(0.123_45), up(0.123_41)], ["0.1235", "0.1234", "0.1235"]);
        assert_eq!([plain(-1.5), down(269.99), up(0.3)], ["-1.5", "269.9", "0.3"]);
        assert_eq!([plain(0.0), plain(f64::NAN), plain(1e-20)], ["0", "-", "1.0e-20"]);
        assert_eq!([given(2.345_67), given(1e-300), given(1e6)], ["2.34567", "1.0e-300", "1000000"]);
        assert_eq!([down(123_456.7), up(2e6)], ["123456", "2000000"]);
    }
}
