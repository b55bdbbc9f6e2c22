//! What tells controllers apart in figures: colour, dashes and the shape of markers say the same.

use closeranks_sim::controllers::Controller;

use crate::svg::palette::{CLOSE, INK, LABEL, MALICIOUS, NORMAL};
use crate::svg::path::PathData;
use crate::svg::text;
use crate::svg::{Element, Piece, Svg};

/// Look of a controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    colour: &'static str,
    dashes: &'static str,
    width: f64,
    sides: usize,
}

/// Looks in the order of [`Controller::ALL`]; whoever comes later, and whoever nobody knows, has the last one.
const STYLES: [Style; 4] = [
    Style { colour: NORMAL, dashes: "none", width: 2.2, sides: 0 },
    Style { colour: MALICIOUS, dashes: "7 3", width: 1.7, sides: 4 },
    Style { colour: INK, dashes: "1.5 2.5", width: 1.4, sides: 3 },
    Style { colour: CLOSE, dashes: "10 3 2 3", width: 1.5, sides: 5 },
];

/// Look of the controller `name`.
pub(super) fn style(name: &str) -> Style {
    let place = Controller::named(name).map_or(usize::MAX, |controller| controller as usize);
    STYLES[place.min(STYLES.len() - 1)]
}

impl Style {
    /// As a line.
    pub(super) fn line(self, path: &PathData) -> Element {
        let line = path.element().text("fill", "none").text("stroke", self.colour);
        let line = line.number("stroke-width", self.width).text("stroke-linejoin", "round");
        line.text("stroke-dasharray", self.dashes)
    }

    /// As a solid line: an interval.
    pub(super) fn bar(self, path: &PathData) -> Element {
        path.element().text("fill", "none").text("stroke", self.colour).number("stroke-width", 1.6)
    }

    /// As a marker: a disc, a square, or a triangle that points up or down; hollow for nothing seen.
    pub(super) fn marker(self, [x, y]: [f64; 2], hollow: bool) -> Element {
        const RADIUS: f64 = 4.2;
        let fill = if hollow { "#ffffff" } else { self.colour };
        let corners: &[[f64; 2]] = match self.sides {
            4 => &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
            3 => &[[0.0, -1.15], [1.1, 0.8], [-1.1, 0.8]],
            5 => &[[0.0, 1.15], [1.1, -0.8], [-1.1, -0.8]],
            _ => &[],
        };
        let shape = if corners.is_empty() {
            Element::new("circle").point(["cx", "cy"], [x, y]).number("r", RADIUS)
        } else {
            let mut path = PathData::default();
            for [right, down] in corners.iter().chain(&corners[..1]) {
                path.continue_to([x + RADIUS * right, y + RADIUS * down]);
            }
            path.element()
        };
        shape.text("fill", fill).text("stroke", self.colour).number("stroke-width", 1.6)
    }
}

/// One row of names with their look around `middle`: a marker, or a piece of line.
pub(super) fn legend(svg: &mut Svg, names: &[(String, String)], lines: bool, [middle, y]: [f64; 2]) {
    const GAP: f64 = 26.0;
    let sample = if lines { 30.0 } else { 12.0 };
    let width = |label: &str| sample + 6.0 + text::width(label, LABEL);
    let total: f64 = names.iter().map(|(_, label)| width(label) + GAP).sum::<f64>() - GAP;
    let mut left = middle - 0.5 * total;
    for (name, label) in names {
        if lines {
            let mut path = PathData::default();
            path.start([left, y]);
            path.continue_to([left + sample, y]);
            svg.add(style(name).line(&path));
        } else {
            svg.add(style(name).marker([left + 0.5 * sample, y], false));
        }
        let text = Element::new("text").point(["x", "y"], [left + sample + 6.0, y + 0.36 * LABEL]);
        svg.add(text.number("font-size", LABEL).text("fill", INK).label(&[Piece::Plain(label)]));
        left += width(label) + GAP;
    }
}

/// Names of controllers with how often each was run.
pub(super) fn names(runs: impl Iterator<Item = (String, u64)>) -> Vec<(String, String)> {
    runs.map(|(name, runs)| {
        let label = format!("{name} ({runs} {})", if runs == 1 { "run" } else { "runs" });
        (name, label)
    })
    .collect()
}
