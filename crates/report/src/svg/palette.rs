//! Colours and sizes that all figures share.
//!
//! Blue and vermillion of Okabe and Ito: told apart by every common kind of colour blindness, and of different lightness
//! in grey print. Shape, dashes and width say the same as colour, so that nothing depends on it.

/// Normal robots.
pub(crate) const NORMAL: &str = "#0072B2";
/// Normal robots of several teams, in turn: colours of Okabe and Ito that mean nothing else here.
pub(crate) const TEAMS: [&str; 4] = [NORMAL, "#009E73", "#3C3C3C", "#56B4E9"];
/// Lines of normal robots, in turn: three blues of different lightness.
pub(crate) const NORMAL_LINES: [&str; 3] = ["#0072B2", "#4FA3D8", "#004C78"];
/// Malicious robots.
pub(crate) const MALICIOUS: &str = "#D55E00";
/// Links between normal robots.
pub(crate) const LINK: &str = "#A0A0A0";
/// What is closer than it may be: the purple of Okabe and Ito.
pub(crate) const CLOSE: &str = "#CC79A7";
/// What stands in the way of robots.
pub(crate) const OBSTACLE: &str = "#BDB4A7";
/// Frames and ticks.
pub(crate) const FRAME: &str = "#4D4D4D";
/// Texts.
pub(crate) const INK: &str = "#1A1A1A";
/// Where h_i < 0.
pub(crate) const SHADE: &str = "#F3EBE4";

/// Font size of titles.
pub(crate) const TITLE: f64 = 11.5;
/// Font size of axis labels and legends.
pub(crate) const LABEL: f64 = 11.0;
/// Font size of numbers at axes.
pub(crate) const NUMBER: f64 = 10.0;
