//! What a robot answers.

use closeranks_core::robot::report::{self, Mode};
use closeranks_sim::output::record::outcome_name;
use numpy::PyArray1;
use pyo3::prelude::*;

/// What a robot answers in a tick.
///
/// Attributes
/// ----------
/// velocity : ndarray (D,), m/s
///     What to drive with until the next tick; always finite and inside the input box.
/// mode : str
///     What the answer is worth: "guaranteed", "degraded", "hold" (no usable desired velocity) or "stopped" (no usable position).
/// reason : str or None
///     Why it is degraded, such as "late" or "degree".
/// degree : int
///     delta_i, neighbours sensed within R.
/// degree_margin : int
///     delta_i less what must be there; negative where the condition of the theorem does not hold.
/// level : float
///     c_i as sensed.
/// h : float
///     h_i = c_i - F'.
/// phi : float or None
///     phi_i, under the controller "composed".
/// outcome : str
///     "free", "active", "infeasible" or "recovering".
/// untold : int
///     Neighbours that have told no level yet, where levels are told.
/// told_age_max_s : float
///     Time since the oldest of the neighbours' last messages was received, s.
/// round : tuple of three int or None
///     In a consensus round: values kept, discarded, and neighbours that were silent.
#[pyclass(frozen, get_all, module = "closeranks")]
pub(crate) struct Output {
    velocity: Py<PyArray1<f64>>,
    mode: &'static str,
    reason: Option<&'static str>,
    degree: u16,
    degree_margin: i32,
    level: f64,
    h: f64,
    phi: Option<f64>,
    outcome: &'static str,
    untold: u16,
    told_age_max_s: f64,
    round: Option<(u16, u16, u16)>,
}

impl Output {
    /// The output of a robot of any dimension.
    pub(crate) fn new<const D: usize>(py: Python<'_>, output: &report::Output<D>) -> Self {
        let report = &output.report;
        Self {
            velocity: PyArray1::from_slice(py, &output.velocity_m_s).unbind(),
            mode: mode_word(report.mode),
            reason: reason(report.mode),
            degree: report.degree,
            degree_margin: report.degree_margin,
            level: report.level,
            h: report.h,
            phi: report.phi,
            outcome: outcome_name(report.outcome),
            untold: report.untold,
            told_age_max_s: report.told_age_max.as_secs_f64(),
            round: report.round.map(|round| (round.kept, round.discarded, round.silent)),
        }
    }
}

#[pymethods]
impl Output {
    fn __repr__(&self, py: Python<'_>) -> String {
        let (velocity, h) = (self.velocity.bind(py), self.h);
        let why = self.reason.map(|reason| format!(" ({reason})")).unwrap_or_default();
        format!("Output(velocity={velocity}, mode={}{why}, degree={}, h={h:.4})", self.mode, self.degree)
    }
}

/// The word for a mode.
fn mode_word(mode: Mode) -> &'static str {
    match mode {
        Mode::Degraded(_) => "degraded",
        other => other.name(),
    }
}

/// Why a mode is degraded.
fn reason(mode: Mode) -> Option<&'static str> {
    let Mode::Degraded(reason) = mode else { return None };
    Some(reason.name())
}
