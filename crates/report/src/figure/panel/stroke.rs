//! How lines of robustness look, in the panel and in its legend alike.

use crate::svg::Element;
use crate::svg::palette::{INK, MALICIOUS, NORMAL};

/// Line of r_max.
pub(crate) fn largest_r(line: Element) -> Element {
    line.text("stroke", NORMAL).number("stroke-width", 1.0)
}

/// Line of F_max.
pub(crate) fn largest_f(line: Element) -> Element {
    line.text("stroke", INK).number("stroke-width", 1.8)
}

/// Line of F.
pub(crate) fn needed(line: Element) -> Element {
    line.text("stroke", MALICIOUS).number("stroke-width", 1.2).text("stroke-dasharray", "4 2")
}
