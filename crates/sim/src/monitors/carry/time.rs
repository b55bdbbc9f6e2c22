//! How long ago something was, and how much of the time it held.

/// `part/whole`, 0 of nothing.
pub(crate) fn fraction(part: u64, whole: u64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "counts")]
    let fraction = part as f64 / whole.max(1) as f64;
    fraction
}

/// Ticks since `then`; for ever if it never was.
pub(crate) fn since(then: Option<u32>, tick: u32) -> u32 {
    then.map_or(u32::MAX, |then| tick - then)
}

/// True if `then` is more than `ticks` ticks ago, or never was.
pub(crate) fn longer_ago(then: Option<u32>, tick: u32, ticks: u64) -> bool {
    then.is_none_or(|then| u64::from(tick - then) > ticks)
}
