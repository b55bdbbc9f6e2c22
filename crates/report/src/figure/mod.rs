//! The figures of the paper's section V, and those of a single run.

pub mod network;
pub mod robustness;

mod animation;
mod comparison;
mod distance;
pub(crate) mod formation;
mod overview;
pub(crate) mod panel;
mod paper;
mod paths;
mod series;
mod swarm;
mod thinned;
pub(crate) mod trace;

use closeranks_sim::output::record::Record;
use closeranks_sim::scenario::Scenario;

pub use self::animation::animation;
pub use self::comparison::comparison;
pub use self::overview::overview;
pub use self::paper::{figure1, figure2, figure3};
pub use self::swarm::{MANY, swarm};
pub use self::thinned::Thinned;

use self::formation::view::{View, views};
use self::formation::{Look, Moment};
use self::panel::axes::{Axes, Decoration};
use self::panel::layout::Grid;
use self::panel::legend::{self, Entry};
use self::series::{Quantity, time_range};
use crate::svg::palette::TEAMS;
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
const TIME_LABEL: &[Piece<'_>] = &[Piece::Plain("time (s)")];
const DISTANCE_LABEL: &[Piece<'_>] = &[Piece::Plain("distance (m)")];

/// Space between columns that share the axis to their left.
const SHARED_GAP: f64 = 20.0;
/// Space between columns with an axis each.
const OWN_GAP: f64 = 70.0;

/// The start of the first case and the end of all, from each side that is needed.
fn moments<'a>(cases: &[Case<'a>]) -> Vec<Vec<Moment<'a>>> {
    let row = |view: &View| {
        let start = cases.first().map(|case| Moment::start(*case, *view));
        start.into_iter().chain(cases.iter().map(|case| Moment::end(*case, *view))).collect()
    };
    views(cases).iter().map(row).collect()
}

/// What the legend of formations has to explain: a ring only where there is one.
fn formation_entries(moments: &[Vec<Moment<'_>>]) -> Vec<Entry> {
    let close = moments.iter().flatten().any(|moment| !moment.too_close().is_empty());
    let teams = moments.iter().flatten().map(|moment| moment.case.scenario.teams.len()).max().unwrap_or(0);
    let normal = legend::FORMATION.into_iter().take(usize::from(teams == 0));
    let teams = (0..teams.min(TEAMS.len())).map(Entry::Team);
    let others = legend::FORMATION.into_iter().skip(1);
    normal.chain(teams).chain(others).chain(close.then_some(Entry::TooClose)).collect()
}

fn lines(titles: &[Vec<String>]) -> usize {
    titles.iter().map(Vec::len).max().unwrap_or(0)
}

/// A row of formations seen from one side, of one scale; numbers to the left where there is room for them.
fn draw_formations(
    svg: &mut Svg,
    grid: &Grid,
    row: usize,
    moments: &[Moment<'_>],
    look: &Look,
    titles: &[Vec<String>],
) {
    for (column, moment) in moments.iter().enumerate() {
        let axes = Axes { place: grid.place(column, row), x: look.x, y: look.y };
        moment.draw(svg, &axes, look.marker);
        let title = titles.get(column).map_or(&[][..], Vec::as_slice);
        axes.draw(svg, &plane_decoration(title, moment.view, column == 0 || grid.gap >= OWN_GAP));
    }
}

fn plane_decoration(title: &[String], view: View, own: bool) -> Decoration<'_> {
    let y_label = if own { view.up_label } else { &[] };
    Decoration { title, x_label: X_LABEL, y_label, x_numbers: true, y_numbers: own }
}

/// A panel with a quantity over time.
fn draw_series(svg: &mut Svg, axes: &Axes, case: &Case<'_>, quantity: Quantity, decoration: &Decoration<'_>) {
    quantity.draw(svg, axes, *case);
    axes.draw(svg, decoration);
    quantity.draw_numbers(svg, axes, *case);
}

fn series_axes(grid: &Grid, [column, row]: [usize; 2], cases: &[Case<'_>], quantity: Quantity) -> Axes {
    Axes { place: grid.place(column, row), x: time_range(cases), y: quantity.range(cases) }
}

fn time_decoration<'a>(
    title: &'a [String],
    label: &'a [Piece<'a>],
    below: bool,
    left: bool,
) -> Decoration<'a> {
    Decoration {
        title,
        x_label: if below { TIME_LABEL } else { &[] },
        y_label: if left { label } else { &[] },
        x_numbers: below,
        y_numbers: left,
    }
}
