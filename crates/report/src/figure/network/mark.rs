//! Markers of nodes: colour and shape say the same.

use crate::svg::palette::{FRAME, INK, LINK, MALICIOUS, NORMAL};
use crate::svg::path::PathData;
use crate::svg::text::{shorten, width};
use crate::svg::{Element, Piece, Svg};

/// Orange of Okabe and Ito, light in grey print where the blue is dark.
const SECOND: &str = "#E69F00";

/// In which set a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// In neither.
    Other,
    /// In S₁.
    First,
    /// In S₂.
    Second,
}

/// How a node is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Mark {
    /// Its set.
    pub(crate) kind: Kind,
    /// It is exempt: a square, with a rim in the colour of its set.
    pub(crate) exempt: bool,
}

impl Kind {
    /// Colour of links inside the set.
    #[must_use]
    pub(crate) fn link(self) -> &'static str {
        match self {
            Self::Other => LINK,
            Self::First => NORMAL,
            Self::Second => SECOND,
        }
    }

    fn fill(self) -> &'static str {
        match self {
            Self::Other => "#ffffff",
            Self::First => NORMAL,
            Self::Second => SECOND,
        }
    }
}

impl Mark {
    /// A node that is nothing special.
    pub(crate) const OTHER: Self = Self { kind: Kind::Other, exempt: false };

    /// Draws the marker, and `name` in it if it fits, else below.
    pub(crate) fn draw(self, svg: &mut Svg, [x, y]: [f64; 2], radius: f64, name: &str) {
        svg.add(self.paint(self.shape([x, y], radius), radius));
        let size = (1.15 * radius).max(7.0);
        let inside = width(name, size) <= 1.75 * radius;
        let base = if inside { y + 0.36 * size } else { y + radius + 9.5 };
        let short = if inside { name.to_owned() } else { shorten(name, 9.0, 90.0) };
        let text = Element::new("text").point(["x", "y"], [x, base]).text("text-anchor", "middle");
        let text = text.number("font-size", if inside { size } else { 9.0 });
        if inside {
            svg.add(text.text("font-weight", "bold").text("fill", self.ink()).label(&[Piece::Plain(&short)]));
        } else {
            let halo =
                text.text("stroke", "#ffffff").number("stroke-width", 2.5).text("paint-order", "stroke");
            svg.add(halo.text("fill", INK).label(&[Piece::Plain(&short)]));
        }
    }

    fn ink(self) -> &'static str {
        match (self.exempt, self.kind) {
            (true, _) | (_, Kind::First) => "#ffffff",
            _ => INK,
        }
    }

    fn paint(self, shape: Element, radius: f64) -> Element {
        let rim = if self.kind == Kind::Other { FRAME } else { self.kind.fill() };
        if self.exempt {
            let shape = shape.text("fill", MALICIOUS).text("stroke", rim);
            return shape.number("stroke-width", 0.28 * radius);
        }
        let edge = if self.kind == Kind::Other { FRAME } else { "#ffffff" };
        shape.text("fill", self.kind.fill()).text("stroke", edge).number("stroke-width", 1.0)
    }

    /// A square, circle or diamond of about the same area.
    fn shape(self, [x, y]: [f64; 2], radius: f64) -> Element {
        if self.exempt {
            let side = 1.7 * radius;
            let square = Element::new("rect").point(["x", "y"], [x - 0.5 * side, y - 0.5 * side]);
            return square.number("width", side).number("height", side);
        }
        if self.kind != Kind::Second {
            return Element::new("circle").point(["cx", "cy"], [x, y]).number("r", radius);
        }
        let reach = 1.28 * radius;
        let mut path = PathData::default();
        path.start([x, y - reach]);
        for corner in [[x + reach, y], [x, y + reach], [x - reach, y], [x, y - reach]] {
            path.continue_to(corner);
        }
        path.element()
    }
}
