//! All of one run in one figure.

use super::formation::view::{View, views};
use super::formation::{Look, Moment};
use super::panel::axes::Axes;
use super::panel::layout::{Grid, Row, legend_room, panel_width};
use super::panel::legend;
use super::panel::title::{Title, fold};
use super::series::{Quantity, time_range};
use super::{
    Case, DISTANCE_LABEL, OWN_GAP, distance, draw_formations, draw_series, formation_entries, lines, moments,
    paths, plane_decoration, series_axes, time_decoration,
};
use crate::svg::Svg;

/// One run: formations at its start and end, in three dimensions from two sides; paths and least distance; h_i and y_i over
/// time. As [`super::figure1`], [`super::figure2`] and [`super::figure3`].
#[must_use]
pub fn overview(case: Case<'_>) -> String {
    let moments = moments(&[case]);
    let width = panel_width(2, OWN_GAP, 330.0);
    let look = Look::of(&moments.concat(), width, 0.9);
    let above = fold(&moments[0].iter().map(Moment::title).collect::<Vec<_>>(), 0, width);
    let names =
        ["paths", "least distance of two robots", "degree barriers", "consensus values"].map(Title::of);
    let below = fold(&names, 2, width);
    let room = legend_room(2, width, OWN_GAP);
    let formation = formation_entries(&moments);
    let formation = legend::folded(&formation, room);
    let [way, series] = [&legend::PATHS[..], &legend::SERIES].map(|entries| legend::folded(entries, room));
    let plane = Row { title_lines: lines(&above), height: look.aspect * width, axis: true, legend: 0 };
    let mut rows = vec![plane; moments.len()];
    rows.iter_mut().skip(1).for_each(|row| row.title_lines = 0);
    let first = rows.len();
    rows[first - 1].legend = formation.len();
    rows.push(Row { title_lines: 1, legend: way.len(), ..plane });
    let quantities: Vec<Quantity> =
        core::iter::once(Quantity::Barrier).chain(Quantity::values(&[case])).collect();
    rows.extend(quantities.chunks(2).map(|_| Row { title_lines: 1, height: 180.0, legend: 0, ..plane }));
    let last = rows.len() - 1;
    rows[last].legend = series.len();
    let grid = Grid { columns: 2, width, gap: OWN_GAP, rows };
    let mut svg = grid.document(&format!("Formations, paths, barriers and values of the run {}", case.title));
    for (row, moments) in moments.iter().enumerate() {
        draw_formations(&mut svg, &grid, row, moments, &look, if row == 0 { &above } else { &[] });
    }
    draw_way(&mut svg, &grid, first, case, &look, &below);
    for (place, quantity) in quantities.into_iter().enumerate() {
        let axes = series_axes(&grid, [place % 2, first + 1 + place / 2], &[case], quantity);
        let decoration = time_decoration(&below[2 + place.min(1)], quantity.label(&[case]), true, true);
        draw_series(&mut svg, &axes, &case, quantity, &decoration);
    }
    for (row, entries) in [(first - 1, &formation), (first, &way), (last, &series)] {
        legend::draw(&mut svg, entries, grid.legend(row));
    }
    svg.finish()
}

/// Paths to the left, the least distance to the right.
fn draw_way(svg: &mut Svg, grid: &Grid, row: usize, case: Case<'_>, look: &Look, titles: &[Vec<String>]) {
    let view: View = views(&[case])[0];
    let look = look.with_ways(&[case]);
    let axes = Axes { place: grid.place(0, row), x: look.x, y: look.y };
    paths::draw(svg, &axes, case, view, look.marker);
    axes.draw(svg, &plane_decoration(&titles[0], view, true));
    let line = distance::least(case.record);
    let y = distance::range(&[case], core::slice::from_ref(&line));
    let axes = Axes { place: grid.place(1, row), x: time_range(&[case]), y };
    distance::draw(svg, &axes, &case, &line);
    axes.draw(svg, &time_decoration(&titles[1], DISTANCE_LABEL, true, true));
}
