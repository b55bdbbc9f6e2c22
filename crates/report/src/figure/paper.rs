//! The figures of the paper's section V, and a third one of paths and distances: a column a case.

use super::formation::view::views;
use super::formation::{Look, Moment};
use super::panel::axes::Axes;
use super::panel::layout::{Grid, Row, legend_room, panel_width};
use super::panel::legend;
use super::panel::title::{Title, fold};
use super::series::{Quantity, time_range};
use super::{
    Case, DISTANCE_LABEL, SHARED_GAP, distance, draw_formations, draw_series, formation_entries, lines,
    moments, paths, plane_decoration, series_axes, time_decoration,
};
use crate::svg::Svg;

/// Formations, the paper's fig:sim: the start of the first case, then the end of each, in panels of one scale in a row.
///
/// x and y in m; in three dimensions a second row shows z. Normal robots are blue circles, malicious ones orange squares;
/// links are dotted, those with a malicious robot orange; robots closer than the scenario demands have a ring. Returns a
/// complete SVG document; the same cases give the same bytes. The cases are expected to share their start.
//= paper fig:sim
#[must_use]
pub fn figure1(cases: &[Case<'_>]) -> String {
    let moments = moments(cases);
    let titles: Vec<Title> = moments[0].iter().map(Moment::title).collect();
    let columns = titles.len();
    let width = panel_width(columns, SHARED_GAP, 300.0);
    let look = Look::of(&moments.concat(), width, 1.25);
    let titles = fold(&titles, 0, width);
    let entries = formation_entries(&moments);
    let entries = legend::folded(&entries, legend_room(columns, width, SHARED_GAP));
    let row = Row { title_lines: lines(&titles), height: look.aspect * width, axis: true, legend: 0 };
    let mut rows = vec![row];
    rows.extend(moments[1..].iter().map(|_| Row { title_lines: 0, ..row }));
    let last = rows.len() - 1;
    rows[last].legend = entries.len();
    let grid = Grid { columns, width, gap: SHARED_GAP, rows };
    let mut svg = grid.document("Robot formations at the start and at the end of each run");
    for (row, moments) in moments.iter().enumerate() {
        draw_formations(&mut svg, &grid, row, moments, &look, if row == 0 { &titles } else { &[] });
    }
    legend::draw(&mut svg, &entries, grid.legend(last));
    svg.finish()
}

/// Barriers and values over time, the paper's fig:sim_result: h_i of each case in the upper row, y_i in the lower, each number of it in
/// a row of its own.
///
/// Time in s, h_i and y_i dimensionless; a row shares its limits. Normal robots are solid blue, malicious ones dashed
/// orange, their values thin and behind; the number of a robot stands at the end of its h. Where values agree early, an inset
/// shows how. Lines have fewer points than the record but every extreme of every column 0.75 units wide. Returns a complete
/// SVG document; the same cases give the same bytes.
//= paper fig:sim_result
#[must_use]
pub fn figure2(cases: &[Case<'_>]) -> String {
    let titles: Vec<Title> = cases.iter().map(|case| Title::of(case.title)).collect();
    let columns = cases.len().max(1);
    let width = panel_width(cases.len(), SHARED_GAP, 420.0);
    let upper = fold(&titles, 0, width);
    let lower = fold(&titles, titles.len(), width);
    let entries = legend::folded(&legend::SERIES, legend_room(columns, width, SHARED_GAP));
    let row = Row { title_lines: lines(&upper), height: 165.0, axis: false, legend: 0 };
    let quantities: Vec<Quantity> =
        core::iter::once(Quantity::Barrier).chain(Quantity::values(cases)).collect();
    let last = quantities.len() - 1;
    let mut rows = vec![row; quantities.len()];
    rows[last] = Row { axis: true, legend: entries.len(), ..row };
    let grid = Grid { columns, width, gap: SHARED_GAP, rows };
    let mut svg = grid.document("Degree barriers and consensus values of all robots over time");
    for (row, quantity) in quantities.into_iter().enumerate() {
        draw_row(&mut svg, &grid, row, cases, quantity, if row == 0 { &upper } else { &lower });
    }
    legend::draw(&mut svg, &entries, grid.legend(last));
    svg.finish()
}

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
        let below = grid.rows[row].axis;
        let decoration = time_decoration(&titles[column], quantity.label(cases), below, column == 0);
        draw_series(svg, &axes, case, quantity, &decoration);
    }
}

/// Paths and distances: the way of every robot of each case above, the least distance of two robots over time below.
///
/// x and y in m, of one scale; in three dimensions a second row shows z. Below, the shaded region is closer than the scenario
/// demands. Returns a complete SVG document; the same cases give the same bytes.
#[must_use]
pub fn figure3(cases: &[Case<'_>]) -> String {
    let titles: Vec<Title> = cases.iter().map(|case| Title::of(case.title)).collect();
    let columns = cases.len().max(1);
    let width = panel_width(cases.len(), SHARED_GAP, 300.0);
    let [upper, lower] = [0, titles.len()].map(|first| fold(&titles, first, width));
    let look = Look::of(&moments(cases).concat(), width, 1.25).with_ways(cases);
    let entries = legend::folded(&legend::PATHS, legend_room(columns, width, SHARED_GAP));
    let plane = Row { title_lines: lines(&upper), height: look.aspect * width, axis: true, legend: 0 };
    let mut rows = vec![plane; views(cases).len()];
    rows.iter_mut().skip(1).for_each(|row| row.title_lines = 0);
    rows.push(Row { height: 110.0, legend: entries.len(), ..plane });
    let last = rows.len() - 1;
    let grid = Grid { columns, width, gap: SHARED_GAP, rows };
    let mut svg = grid.document("Paths of all robots, and the least distance of two robots over time");
    for (row, view) in views(cases).iter().enumerate() {
        for (column, case) in cases.iter().enumerate() {
            let axes = Axes { place: grid.place(column, row), x: look.x, y: look.y };
            paths::draw(&mut svg, &axes, *case, *view, look.marker);
            let title: &[String] = if row == 0 { &upper[column] } else { &[] };
            axes.draw(&mut svg, &plane_decoration(title, *view, column == 0));
        }
    }
    draw_distances(&mut svg, &grid, last, cases, &lower);
    legend::draw(&mut svg, &entries, grid.legend(last));
    svg.finish()
}

fn draw_distances(svg: &mut Svg, grid: &Grid, row: usize, cases: &[Case<'_>], titles: &[Vec<String>]) {
    let all: Vec<Vec<f64>> = cases.iter().map(|case| distance::least(case.record)).collect();
    let y = distance::range(cases, &all);
    for (column, (case, line)) in cases.iter().zip(&all).enumerate() {
        let axes = Axes { place: grid.place(column, row), x: time_range(cases), y };
        distance::draw(svg, &axes, case, line);
        axes.draw(svg, &time_decoration(&titles[column], DISTANCE_LABEL, true, column == 0));
    }
}
