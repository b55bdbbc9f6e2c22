//! Limits by halving, down to neighbouring numbers.

/// The largest number from `low` to `high` for which `holds`, if it holds up to some number and not beyond. `None` if it does
/// not hold for `low`.
pub(super) fn last(low: f64, high: f64, mut holds: impl FnMut(f64) -> bool) -> Option<f64> {
    if !holds(low) {
        return None;
    }
    if holds(high) {
        return Some(high);
    }
    let (mut low, mut high) = (low, high);
    loop {
        let middle = low + 0.5 * (high - low);
        if middle <= low || middle >= high {
            return Some(low);
        }
        if holds(middle) { low = middle } else { high = middle }
    }
}

/// The largest whole number from 0 to `high` for which `holds`, if it holds up to some number and not beyond.
pub(super) fn last_whole(high: u16, mut holds: impl FnMut(u16) -> bool) -> Option<u16> {
    let (mut low, mut beyond) = (0, high.saturating_add(1));
    while low < beyond {
        let middle = low + (beyond - low) / 2;
        if holds(middle) { low = middle + 1 } else { beyond = middle }
    }
    low.checked_sub(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_found_to_the_last_bit() {
        assert_eq!(last(0.0, 8.0, |x| x <= 0.1), Some(0.1));
        assert_eq!(last(0.0, 8.0, |_| true), Some(8.0));
        assert_eq!(last(1.0, 8.0, |x| x <= 0.1), None);
        for most in 0..20 {
            assert_eq!(last_whole(15, |x| x <= most), Some(most.min(15)));
        }
        assert_eq!(last_whole(15, |_| false), None);
    }
}
