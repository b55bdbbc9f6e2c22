//! What a setting may be, and the greatest numbers that there are.

/// Greatest number of robots in a team.
pub const ROBOTS_MAX: u16 = 10_000;
/// Greatest magnitude of any length, weight or speed: far outside use, far inside `f64`.
pub const MAGNITUDE_MAX: f64 = 1e6;

/// A range of allowed numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Allowed {
    /// From the first number to the second, both included.
    Closed(f64, f64),
    /// More than the first number and less than the second.
    Open(f64, f64),
    /// More than the first number and at most the second.
    LeftOpen(f64, f64),
}

impl Allowed {
    /// True when `value` is in the range.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        match self {
            Self::Closed(low, high) => low <= value && value <= high,
            Self::Open(low, high) => low < value && value < high,
            Self::LeftOpen(low, high) => low < value && value <= high,
        }
    }
}

impl core::fmt::Display for Allowed {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Closed(low, high) => write!(f, "{low} to {high}"),
            Self::Open(low, high) => write!(f, "more than {low} and less than {high}"),
            Self::LeftOpen(low, high) => write!(f, "more than {low} and at most {high}"),
        }
    }
}
