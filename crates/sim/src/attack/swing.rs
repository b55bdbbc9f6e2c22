//! The oscillation of lies that swing.

use closeranks_core::num::sin;

/// `amplitude · sin(2π t/period)`.
pub(super) fn swing(amplitude: f64, period_s: f64, time_s: f64) -> f64 {
    amplitude * sin(2.0 * core::f64::consts::PI * (time_s / period_s))
}
