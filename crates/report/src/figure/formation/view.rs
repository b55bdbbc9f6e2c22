//! From where robots are seen: in space from two sides.

use closeranks_sim::output::record::Record;

use super::links::position;
use crate::figure::Case;
use crate::figure::panel::axes::Place;
use crate::svg::palette::FRAME;
use crate::svg::{Element, Piece, Svg};

/// A direction from which robots are seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct View {
    /// Axis from left to right.
    across: usize,
    /// Axis from bottom to top.
    up: usize,
    /// What a panel says in three dimensions.
    note: &'static str,
    /// Label of the axis to the left.
    pub(crate) up_label: &'static [Piece<'static>],
}

/// Views of robots in space: from above, and from the front. In the plane the first is all.
const VIEWS: [View; 2] = [
    View {
        across: 0,
        up: 1,
        note: "3D, seen along z",
        up_label: &[Piece::Italic("y"), Piece::Plain(" (m)")],
    },
    View {
        across: 0,
        up: 2,
        note: "3D, seen along y",
        up_label: &[Piece::Italic("z"), Piece::Plain(" (m)")],
    },
];

/// The views that show all coordinates of `cases`.
#[must_use]
pub(crate) fn views(cases: &[Case<'_>]) -> &'static [View] {
    if cases.iter().any(|case| case.record.dimension > 2) { &VIEWS } else { &VIEWS[..1] }
}

impl View {
    /// Where robot `index` is seen at `tick`, m.
    #[must_use]
    pub(crate) fn point(self, record: &Record, tick: usize, index: usize) -> [f64; 2] {
        let position = position(record, tick, index);
        [position[self.across], position[self.up]]
    }

    /// Where a point of space is seen, m.
    #[must_use]
    pub(crate) fn seen(self, x: &[f64; 3]) -> [f64; 2] {
        [x[self.across], x[self.up]]
    }

    /// Says in the panel from where robots are seen, if there is more than one way.
    pub(crate) fn draw_note(self, svg: &mut Svg, place: Place, record: &Record) {
        if record.dimension > 2 {
            note(svg, place, self.note);
        }
    }
}

/// A remark in the lower right corner of a panel.
fn note(svg: &mut Svg, place: Place, text: &str) {
    let at = [place.left + place.width - 5.0, place.bottom() - 5.0];
    let element = Element::new("text").point(["x", "y"], at).number("font-size", 9.0);
    svg.add(element.text("text-anchor", "end").text("fill", FRAME).label(&[Piece::Plain(text)]));
}
