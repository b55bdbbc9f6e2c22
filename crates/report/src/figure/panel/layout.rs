//! Where panels, titles and legends stand on the page.

use crate::figure::panel::axes::{Place, TITLE_LINE};
use crate::svg::Svg;

/// Room for numbers and label to the left of a panel.
pub(crate) const LEFT: f64 = 50.0;
/// Room at the right edge: half a number of the axis below.
const RIGHT: f64 = 18.0;
/// Room above the titles.
const TOP: f64 = 4.0;
/// Room below a row with numbers and a label.
const AXIS: f64 = 38.0;
/// Room below a row without.
const NO_AXIS: f64 = 10.0;
/// Height of a legend of one line.
const LEGEND: f64 = 26.0;
/// Height of every further line.
pub(crate) const LEGEND_LINE: f64 = 17.0;

/// A row of panels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Row {
    /// Lines above each panel.
    pub(crate) title_lines: usize,
    /// Height of the panels.
    pub(crate) height: f64,
    /// With numbers and a label below.
    pub(crate) axis: bool,
    /// Lines of the legend below; 0 for none.
    pub(crate) legend: usize,
}

/// Panels of one width in rows and columns.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Grid {
    /// Panels in a row.
    pub(crate) columns: usize,
    /// Width of a panel.
    pub(crate) width: f64,
    /// Space between two columns.
    pub(crate) gap: f64,
    /// From the top.
    pub(crate) rows: Vec<Row>,
}

impl Row {
    fn above(&self) -> f64 {
        TOP + 5.0 + TITLE_LINE * count(self.title_lines)
    }

    fn below(&self) -> f64 {
        (if self.axis { AXIS } else { NO_AXIS }) + self.legend_height()
    }

    fn legend_height(&self) -> f64 {
        match self.legend {
            0 => 0.0,
            lines => LEGEND + LEGEND_LINE * count(lines - 1),
        }
    }

    fn total(&self) -> f64 {
        self.above() + self.height + self.below()
    }
}

impl Grid {
    /// An empty document of the right size.
    #[must_use]
    pub(crate) fn document(&self, label: &str) -> Svg {
        Svg::new(self.right() + RIGHT, self.rows.iter().map(Row::total).sum(), label)
    }

    /// Place of a panel.
    #[must_use]
    pub(crate) fn place(&self, column: usize, row: usize) -> Place {
        let left = LEFT + count(column) * (self.width + self.gap);
        let top = self.top(row) + self.rows[row].above();
        Place { left, top, width: self.width, height: self.rows[row].height }
    }

    /// Middle of the page from left to right, and the height of the first line of the legend of `row`.
    #[must_use]
    pub(crate) fn legend(&self, row: usize) -> [f64; 2] {
        [0.5 * (self.right() + RIGHT), self.top(row + 1) - self.rows[row].legend_height() + 0.45 * LEGEND]
    }

    fn top(&self, row: usize) -> f64 {
        self.rows[..row].iter().map(Row::total).sum()
    }

    fn right(&self) -> f64 {
        LEFT + count(self.columns) * (self.width + self.gap) - self.gap
    }
}

/// Room for a legend below `columns` panels of `width` with `gap` between them.
#[must_use]
pub(crate) fn legend_room(columns: usize, width: f64, gap: f64) -> f64 {
    LEFT + count(columns.max(1)) * (width + gap) - gap
}

/// Width of each of `columns` panels with `gap` between them on a page of the usual width, at most `most`.
#[must_use]
pub(crate) fn panel_width(columns: usize, gap: f64, most: f64) -> f64 {
    const PAGE: f64 = 900.0;
    let columns = count(columns.max(1));
    ((PAGE - LEFT - RIGHT + gap) / columns - gap).clamp(150.0, most)
}

fn count(items: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a handful of panels or lines")]
    let count = items as f64;
    count
}
