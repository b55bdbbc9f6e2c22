//! Lines of an SVG document.

use core::fmt::Write as _;

use crate::svg::{Element, number};

/// Data of a path: lines in absolute coordinates. Points that are not finite are left out and break the line.
#[derive(Clone, Debug, Default)]
pub(crate) struct PathData {
    data: String,
    broken: bool,
}

impl PathData {
    /// Starts a new line at a point.
    pub(crate) fn start(&mut self, point: [f64; 2]) {
        self.broken = true;
        self.continue_to(point);
    }

    /// Goes on to a point, or starts there if there is no line to go on with.
    pub(crate) fn continue_to(&mut self, [x, y]: [f64; 2]) {
        if !(x.is_finite() && y.is_finite()) {
            self.broken = true;
            return;
        }
        let command = if self.broken || self.data.is_empty() { 'M' } else { 'L' };
        let _ = write!(self.data, "{command}{} {}", number(x), number(y));
        self.broken = false;
    }

    /// Nothing was drawn.
    #[must_use]
    pub(crate) fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// The path element.
    #[must_use]
    pub(crate) fn element(&self) -> Element {
        Element::new("path").text("d", &self.data)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::svg::Svg;

    #[test]
    fn paths_break_where_data_are_missing() {
        let mut path = PathData::default();
        for y in [1.0, 2.0, f64::NAN, 4.0, f64::INFINITY, 5.0] {
            path.continue_to([y, y]);
        }
        path.start([7.0, 7.0]);
        let mut svg = Svg::new(9.0, 9.0, "");
        svg.add(path.element());
        assert!(svg.finish().contains("<path d=\"M1 1L2 2M4 4M5 5M7 7\"/>"));
        assert!(PathData::default().is_empty());
    }
}
