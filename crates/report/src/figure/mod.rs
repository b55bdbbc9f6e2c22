//! The figures of the paper's section V, and one for a single run.

pub mod network;
pub mod robustness;

mod formation;
mod links;
mod series;
pub(crate) mod trace;

pub(crate) mod panel;

use closeranks_sim::output::record::Record;
use closeranks_sim::scenario::Scenario;

use crate::figure::formation::{Look, Moment};
use crate::figure::panel::axes::{Axes, Decoration};
use crate::figure::panel::layout::{Grid, Row, panel_width};
use crate::figure::panel::legend;
use crate::figure::panel::ticks::Range;
use crate::figure::panel::title::{Title, fold};
use crate::figure::series::{Quantity, time_range};
use crate::svg::{Piece, Svg};

/// A run to be shown.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    /// Its name in titles, such as `nominal updating`.
    pub title: &'a str,
    /// What was run; its radius says who is linked.
    pub scenario: &'a Scenario,
    /// What happened.
    pub record: &'a Record,
}

const X_LABEL: &[Piece<'_>] = &[Piece::Italic("x"), Piece::Plain(" (m)")];
const Y_LABEL: &[Piece<'_>] = &[Piece::Italic("y"), Piece::Plain(" (m)")];
const TIME_LABEL: &[Piece<'_>] = &[Piece::Plain("time (s)")];

/// Space between columns that share the axis to their left.
const SHARED_GAP: f64 = 20.0;
/// Space between columns with an axis each.
const OWN_GAP: f64 = 64.0;

/// Formations, the paper's fig:sim: the start of the first case, then the end of each, in panels of one scale in a row.
///
/// x and y in m; in three dimensions the first two axes, and the panel says so. Normal robots are blue circles, malicious
/// ones red squares; links are dotted, those with a malicious robot red. Returns a complete SVG document; the same cases
/// give the same bytes. The cases are expected to share their start.
//= paper fig:sim
#[must_use]
pub fn figure1(cases: &[Case<'_>]) -> String {
    let moments = moments(cases);
    let titles: Vec<Title> = moments.iter().map(Moment::title).collect();
    let width = panel_width(moments.len(), SHARED_GAP, 300.0);
    let look = Look::of(&moments, width, 1.25);
    let titles = fold(&titles, 0, width);
    let row = Row { title_lines: lines(&titles), height: look.aspect * width, axis: true, legend: true };
    let grid = Grid { columns: moments.len(), width, gap: SHARED_GAP, rows: vec![row] };
    let mut svg = grid.document("Robot formations at the start and at the end of each run");
    draw_formations(&mut svg, &grid, &moments, &look, &titles);
    legend::draw(&mut svg, &legend::FORMATION, grid.legend(0));
    svg.finish()
}

/// Barriers and values over time, the paper's fig:sim_result: h_i of each case in the upper row, y_i in the lower.
///
/// Time in s, h_i and y_i dimensionless; a row shares its limits. Normal robots are solid blue, malicious ones dashed red,
/// their values thin and behind. Lines have fewer points than the record but every extreme of every column 0.75 units wide.
/// Returns a complete SVG document; the same cases give the same bytes.
//= paper fig:sim_result
#[must_use]
pub fn figure2(cases: &[Case<'_>]) -> String {
    let titles: Vec<Title> = cases.iter().map(|case| Title::of(case.title)).collect();
    let width = panel_width(cases.len(), SHARED_GAP, 420.0);
    let upper = fold(&titles, 0, width);
    let lower = fold(&titles, titles.len(), width);
    let row = Row { title_lines: lines(&upper), height: 165.0, axis: false, legend: false };
    let rows = vec![row, Row { axis: true, legend: true, ..row }];
    let grid = Grid { columns: cases.len().max(1), width, gap: SHARED_GAP, rows };
    let mut svg = grid.document("Degree barriers and consensus values of all robots over time");
    for (row, (quantity, titles)) in
        [(Quantity::Barrier, &upper), (Quantity::Value, &lower)].iter().enumerate()
    {
        draw_row(&mut svg, &grid, row, cases, *quantity, titles);
    }
    legend::draw(&mut svg, &legend::SERIES, grid.legend(1));
    svg.finish()
}

/// One run: formations at its start and end above, h_i and y_i over time below. As [`figure1`] and [`figure2`].
#[must_use]
pub fn overview(case: Case<'_>) -> String {
    let moments = moments(&[case]);
    let width = panel_width(2, OWN_GAP, 330.0);
    let look = Look::of(&moments, width, 0.9);
    let titles: Vec<Title> = moments.iter().map(Moment::title).collect();
    let above = fold(&titles, 0, width);
    let below = fold(&[Title::of("degree barriers"), Title::of("consensus values")], 2, width);
    let row = Row { title_lines: lines(&above), height: look.aspect * width, axis: true, legend: true };
    let rows = vec![row, Row { title_lines: 1, height: 180.0, ..row }];
    let grid = Grid { columns: 2, width, gap: OWN_GAP, rows };
    let mut svg = grid.document(&format!("Formations, barriers and values of the run {}", case.title));
    draw_formations(&mut svg, &grid, &moments, &look, &above);
    legend::draw(&mut svg, &legend::FORMATION, grid.legend(0));
    for (column, quantity) in [Quantity::Barrier, Quantity::Value].into_iter().enumerate() {
        let axes = series_axes(&grid, [column, 1], &[case], quantity);
        quantity.draw(&mut svg, &axes, case.record);
        axes.draw(&mut svg, &series_decoration(&below[column], quantity, true, true));
    }
    legend::draw(&mut svg, &legend::SERIES, grid.legend(1));
    svg.finish()
}

/// The start of the first case and the end of all.
fn moments<'a>(cases: &[Case<'a>]) -> Vec<Moment<'a>> {
    let start = cases.first().map(|case| Moment::start(*case));
    start.into_iter().chain(cases.iter().map(|case| Moment::end(*case))).collect()
}

fn lines(titles: &[Vec<String>]) -> usize {
    titles.iter().map(Vec::len).max().unwrap_or(0)
}

/// The first row: one scale; numbers to the left where there is room for them.
fn draw_formations(svg: &mut Svg, grid: &Grid, moments: &[Moment<'_>], look: &Look, titles: &[Vec<String>]) {
    for (column, moment) in moments.iter().enumerate() {
        let axes = Axes { place: grid.place(column, 0), x: look.x, y: look.y };
        moment.draw(svg, &axes, look.marker);
        let own = column == 0 || grid.gap >= OWN_GAP;
        let y_label = if own { Y_LABEL } else { &[] };
        let title = &titles[column];
        axes.draw(svg, &Decoration { title, x_label: X_LABEL, y_label, x_numbers: true, y_numbers: own });
    }
}

/// A row of figure 2.
fn draw_row(
    svg: &mut Svg,
    grid: &Grid,
    row: usize,
    cases: &[Case<'_>],
    quantity: Quantity,
    titles: &[Vec<String>],
) {
    for (column, case) in cases.iter().enumerate() {
        let axes = series_axes(grid, [column, row], cases, quantity);
        quantity.draw(svg, &axes, case.record);
        axes.draw(svg, &series_decoration(&titles[column], quantity, grid.rows[row].axis, column == 0));
    }
}

fn series_axes(grid: &Grid, [column, row]: [usize; 2], cases: &[Case<'_>], quantity: Quantity) -> Axes {
    let y: Range = quantity.range(cases);
    Axes { place: grid.place(column, row), x: time_range(cases), y }
}

fn series_decoration(title: &[String], quantity: Quantity, below: bool, left: bool) -> Decoration<'_> {
    Decoration {
        title,
        x_label: if below { TIME_LABEL } else { &[] },
        y_label: if left { quantity.label() } else { &[] },
        x_numbers: below,
        y_numbers: left,
    }
}
