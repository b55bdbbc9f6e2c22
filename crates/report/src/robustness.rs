//! Robustness over time: r_max and F_max of every round.

use crate::axes::{Axes, Decoration};
use crate::layout::{Grid, Row};
use crate::palette::{FRAME, INK, LABEL, MALICIOUS, NORMAL};
use crate::path::PathData;
use crate::svg::{Element, Piece, Svg};
use crate::text::width;
use crate::ticks::Range;

/// One round. Of numbers that are not known exactly, the proved least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// When, s.
    pub time_s: f64,
    /// Largest r.
    pub r_max: i32,
    /// Largest F, −1 if there is none.
    pub f_max: i32,
}

/// r_max and F_max in steps over time, and the `faults` F that the team is prepared for, as a complete SVG document.
///
/// r_max is solid blue, F_max dashed vermillion, F a dotted line.
//= paper def:robustness
#[must_use]
pub fn over_time(points: &[Point], faults: u16, title: &str) -> String {
    let row = Row { title_lines: 1, height: 220.0, axis: true, legend: true };
    let grid = Grid { columns: 1, width: 560.0, gap: 0.0, rows: vec![row] };
    let mut svg = grid.document(&format!("Robustness over time: {title}"));
    let axes = axes(&grid, points, faults);
    let ends = [axes.x.min, axes.x.max];
    line(&mut svg, &axes, ends.map(|time| [time, f64::from(faults)]).into_iter(), STYLES[2]);
    line(&mut svg, &axes, steps(points, |point| point.r_max), STYLES[0]);
    line(&mut svg, &axes, steps(points, |point| point.f_max), STYLES[1]);
    axes.draw(
        &mut svg,
        &Decoration {
            title: &[title.to_owned()],
            x_label: &[Piece::Plain("time (s)")],
            y_label: &[Piece::Plain("robustness")],
            x_numbers: true,
            y_numbers: true,
        },
    );
    legend(&mut svg, grid.legend(0));
    svg.finish()
}

/// Colour, width, dashes, name.
type Style = (&'static str, f64, &'static str, &'static str);

const STYLES: [Style; 3] = [
    (NORMAL, 2.2, "none", "largest r"),
    (MALICIOUS, 2.2, "7 3", "liars survived, largest F"),
    (FRAME, 1.2, "1.5 3", "F of the team"),
];

fn axes(grid: &Grid, points: &[Point], faults: u16) -> Axes {
    let heights = points.iter().flat_map(|point| [point.r_max, point.f_max]).map(f64::from);
    let y = Range::of(heights.chain([0.0, f64::from(faults) + 1.0]));
    let end = points.iter().map(|point| point.time_s).fold(1e-9, f64::max);
    let start = points.iter().map(|point| point.time_s).fold(end, f64::min);
    let x = if end > start { Range { min: start, max: end } } else { Range { min: 0.0, max: end } };
    Axes { place: grid.place(0, 0), x, y: y.padded(0.4) }
}

/// A height is held until the next round.
fn steps(points: &[Point], height: impl Fn(&Point) -> i32) -> impl Iterator<Item = [f64; 2]> {
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for (index, point) in points.iter().enumerate() {
        let y = f64::from(height(point));
        match corners.last() {
            Some(last) if last[1].to_bits() == y.to_bits() && index + 1 < points.len() => {}
            Some(last) => corners.extend([[point.time_s, last[1]], [point.time_s, y]]),
            None => corners.push([point.time_s, y]),
        }
    }
    corners.into_iter()
}

fn line(svg: &mut Svg, axes: &Axes, points: impl Iterator<Item = [f64; 2]>, style: Style) {
    let mut path = PathData::default();
    for point in points {
        path.continue_to(axes.at(point));
    }
    if !path.is_empty() {
        svg.add(styled(path.element(), style));
    }
}

fn styled(element: Element, (colour, width, dashes, _): Style) -> Element {
    let element = element.text("fill", "none").text("stroke", colour).number("stroke-width", width);
    element.text("stroke-dasharray", dashes)
}

fn legend(svg: &mut Svg, [middle, y]: [f64; 2]) {
    let wide = |style: &Style| 34.0 + width(style.3, LABEL) + 20.0;
    let mut left = middle - 0.5 * STYLES.iter().map(wide).sum::<f64>();
    for style in STYLES {
        let mut path = PathData::default();
        path.start([left, y]);
        path.continue_to([left + 28.0, y]);
        svg.add(styled(path.element(), style));
        let text = Element::new("text").point(["x", "y"], [left + 34.0, y + 0.36 * LABEL]);
        svg.add(text.number("font-size", LABEL).text("fill", INK).label(&[Piece::Plain(style.3)]));
        left += wide(&style);
    }
}
