//! A figure of the exact robustness of the network over time.

use closeranks_sim::monitors::robustness::Round;

use crate::figure::panel::axes::{Axes, Decoration};
use crate::figure::panel::layout::{Grid, Row, legend_room, panel_width};
use crate::figure::panel::legend;
use crate::figure::panel::stroke::{largest_f, largest_r, needed};
use crate::figure::panel::ticks::Range;
use crate::figure::panel::title::{Title, fold};
use crate::figure::trace::steps;
use crate::svg::path::PathData;
use crate::svg::{Element, Piece, Svg};

/// One moment. Of numbers that are not known exactly, the proved least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// When, s.
    pub time_s: f64,
    /// Largest r.
    pub r_max: i32,
    /// Largest F, −1 if there is none.
    pub f_max: i32,
}

/// One run.
#[derive(Clone, Debug)]
pub struct RobustnessSeries<'a> {
    /// Its name in titles.
    pub title: &'a str,
    /// F, which the network should survive.
    pub faults: u16,
    /// What was found, in order.
    pub points: Vec<Point>,
}

/// What `RobustnessSeries` was called before.
pub type Survey<'a> = RobustnessSeries<'a>;

/// The points of recorded rounds, for ticks of `tick_s`.
#[must_use]
pub fn points(rounds: &[Round], tick_s: f64) -> Vec<Point> {
    let point = |round: &Round| Point {
        time_s: f64::from(round.tick) * tick_s,
        r_max: round.r_max.least,
        f_max: round.f_max.least,
    };
    rounds.iter().map(point).collect()
}

const GAP: f64 = 14.0;

/// Largest r and largest F of the network of each run over time, with the F it should survive as a dashed line.
///
/// Where the search ran out of its budget, what is proved at least. Returns a complete SVG document.
//= paper def:robustness
#[must_use]
pub fn robustness(series: &[RobustnessSeries<'_>]) -> String {
    let titles: Vec<Title> = series.iter().map(|one| Title::of(one.title)).collect();
    let width = panel_width(series.len(), GAP, 420.0);
    let titles = fold(&titles, 0, width);
    let entries = legend::folded(&legend::ROBUSTNESS, legend_room(series.len(), width, GAP));
    let row = Row { title_lines: 1, height: 120.0, axis: true, legend: entries.len() };
    let grid = Grid { columns: series.len().max(1), width, gap: GAP, rows: vec![row] };
    let mut svg = grid.document("Exact robustness of the network in every consensus round");
    for (column, one) in series.iter().enumerate() {
        let axes = Axes { place: grid.place(column, 0), x: times(series), y: heights(series) };
        draw(&mut svg, &axes, one);
        let y_label: &[Piece<'_>] = if column == 0 { &[Piece::Plain("robustness")] } else { &[] };
        axes.draw(
            &mut svg,
            &Decoration {
                title: &titles[column],
                x_label: &[Piece::Plain("time (s)")],
                y_label,
                x_numbers: true,
                y_numbers: column == 0,
            },
        );
    }
    legend::draw(&mut svg, &entries, grid.legend(0));
    svg.finish()
}

fn times(series: &[RobustnessSeries<'_>]) -> Range {
    let times = series.iter().flat_map(|one| &one.points).map(|point| point.time_s);
    Range::of(times.chain([0.0]))
}

fn heights(series: &[RobustnessSeries<'_>]) -> Range {
    let points = series.iter().flat_map(|one| &one.points);
    let found = points.flat_map(|point| [point.r_max, point.f_max]).map(f64::from);
    let needed = series.iter().map(|one| f64::from(one.faults));
    Range::of(found.chain(needed).chain([0.0])).padded(0.1)
}

fn draw(svg: &mut Svg, axes: &Axes, series: &RobustnessSeries<'_>) {
    let line = |height: &dyn Fn(&Point) -> f64| {
        let points = series.points.iter().map(|point| axes.at_cut([point.time_s, height(point)]));
        steps(&points.collect::<Vec<_>>())
    };
    let faults = f64::from(series.faults);
    svg.add(needed(path(&line(&|_| faults))));
    svg.add(largest_r(path(&line(&|point| f64::from(point.r_max)))));
    svg.add(largest_f(path(&line(&|point| f64::from(point.f_max)))));
}

fn path(points: &[[f64; 2]]) -> Element {
    let mut path = PathData::default();
    for (place, point) in points.iter().enumerate() {
        if place == 0 { path.start(*point) } else { path.continue_to(*point) }
    }
    path.element().text("fill", "none")
}

#[cfg(test)]
mod tests {
    use super::*;
    use closeranks_sim::scenario::Scenario;
    use closeranks_sim::world::{Options, run};

    fn rounds() -> Vec<Round> {
        let scenario = Scenario { duration_s: 0.35, ..Scenario::default() };
        run(&scenario, Options { robustness: true, ..Options::default() }, &mut |_| ()).unwrap().rounds
    }

    #[test]
    fn the_figure_has_a_panel_a_run_and_three_lines_each() {
        let one = RobustnessSeries { title: "one", faults: 2, points: points(&rounds(), 0.005) };
        let svg = robustness(&[one, RobustnessSeries { title: "none", faults: 0, points: Vec::new() }]);
        assert!(svg.contains("(a) one") && svg.contains("(b) none") && svg.contains("time (s)"));
        assert!(crate::svg::png::png(&svg, 1.0).is_ok());
        assert!(crate::svg::png::png(&robustness(&[]), 1.0).is_ok());
    }
}
