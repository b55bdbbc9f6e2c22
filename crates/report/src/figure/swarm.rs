//! Runs of many robots in one figure: dots coloured by rank, and bands over time in place of a line a robot.

use closeranks_sim::output::record::Record;

use super::formation::links::links;
use super::formation::view::{View, views};
use super::panel::axes::{Axes, Decoration};
use super::panel::layout::{Grid, Row, panel_width};
use super::panel::ticks::{Range, plain};
use super::series::time_range;
use super::{Case, TIME_LABEL, plane_decoration};
use crate::svg::palette::{INK, LABEL, LINK, MALICIOUS, NORMAL};
use crate::svg::path::PathData;
use crate::svg::{Element, Piece, Svg};

/// Runs of more robots than this are shown this way: a line a robot could not be told apart.
pub const MANY: u16 = 128;

/// More links than this are not drawn.
const LINKS_MAX: usize = 2_500;
/// More robots than this have no links in a panel: to find them would take too long.
const LINKED_MAX: u16 = 400;
/// Points of a band over time at most.
const TIMES_MAX: usize = 300;
/// From the core outwards, and normal robots without ranks: lightness falls with the rank, so that it can be told in grey.
const COLOURS: [&str; 6] = ["#0B1E3F", "#17507F", "#1F83A0", "#3DB39E", "#8FD67F", "#E3E36A"];

/// A start and the ends of runs that have it, all to one scale, with robots coloured by rank; below, the values and the degrees of
/// normal robots over time.
#[must_use]
pub fn swarm(cases: &[Case<'_>]) -> String {
    let columns = (cases.len() + 1).max(2);
    let view = views(cases)[0];
    let width = panel_width(columns, GAP, 400.0);
    let look = Look::of(cases, view, width);
    let plane = Row { title_lines: 1, height: look.height, axis: true, legend: 1 };
    let series = Row { title_lines: 1, height: 170.0, axis: true, legend: 0 };
    let grid = Grid { columns, width, gap: GAP, rows: vec![plane, series] };
    let names: Vec<&str> = cases.iter().map(|case| case.title).collect();
    let mut svg = grid.document(&format!("Formations, values and degrees of {}", names.join(" and ")));
    for (column, moment) in moments(cases).into_iter().enumerate() {
        let axes = Axes { place: grid.place(column, 0), x: look.x, y: look.y };
        draw_robots(&mut svg, &axes, &moment, view);
        axes.draw(&mut svg, &plane_decoration(&[moment.title()], view, true));
    }
    draw_legend(&mut svg, grid.legend(0), cases);
    let bands: Vec<(&Case<'_>, Band)> = match cases {
        [case] => vec![(case, Band::Value), (case, Band::Degree)],
        cases => cases.iter().map(|case| (case, Band::Value)).collect(),
    };
    for (column, (case, band)) in bands.into_iter().enumerate() {
        band.draw(&mut svg, &grid, column, case);
    }
    svg.finish()
}

const GAP: f64 = 66.0;

/// One tick of a case.
struct Moment<'a> {
    case: Case<'a>,
    place: usize,
    start: bool,
}

impl Moment<'_> {
    fn title(&self) -> String {
        let time = format!("t = {} s", plain(self.case.record.time_s(self.place)));
        if self.start { format!("start, {time}") } else { format!("{}, {time}", self.case.title) }
    }
}

fn moments<'a>(cases: &[Case<'a>]) -> Vec<Moment<'a>> {
    let start = cases.first().map(|case| Moment { case: *case, place: 0, start: true });
    let end = |case: &Case<'a>| Moment { case: *case, place: case.record.last_tick(), start: false };
    start.into_iter().chain(cases.iter().map(end)).collect()
}

/// What all panels with robots share.
struct Look {
    x: Range,
    y: Range,
    height: f64,
}

impl Look {
    /// A metre is as long in x as in y, in every panel of `width`.
    fn of(cases: &[Case<'_>], view: View, width: f64) -> Self {
        let moments = moments(cases);
        let [x, y] = [0, 1].map(|axis| {
            Range::of(moments.iter().flat_map(|moment| {
                let robots = 0..usize::from(moment.case.record.robots);
                robots.map(move |index| view.point(moment.case.record, moment.place, index)[axis])
            }))
        });
        let margin = 0.04 * x.width().max(y.width()).max(1.0);
        let (x, y) = (x.padded(margin), y.padded(margin));
        let aspect = (y.width() / x.width()).clamp(0.5, 1.2);
        let span = x.width().max(y.width() / aspect);
        Self { x: x.widened_to(span), y: y.widened_to(span * aspect), height: aspect * width }
    }
}

/// Ranks in as many classes as there are colours: the core, and equal parts of the others.
fn classes(case: &Case<'_>) -> Option<Vec<usize>> {
    let ranks = match case.scenario.dimension {
        3 => case.scenario.ranks::<3>(),
        _ => case.scenario.ranks::<2>(),
    };
    let ranks = ranks.ok().flatten()?;
    let highest = usize::from(ranks.iter().copied().max().unwrap_or(0)).max(1);
    let others = COLOURS.len() - 1;
    let class = |rank: &u16| match usize::from(*rank) {
        0 => 0,
        rank => 1 + (others * (rank - 1) / highest).min(others - 1),
    };
    Some(ranks.iter().map(class).collect())
}

fn draw_robots(svg: &mut Svg, axes: &Axes, moment: &Moment<'_>, view: View) {
    let record = moment.case.record;
    let point = |index: usize| axes.at(view.point(record, moment.place, index));
    draw_links(svg, axes, moment, view);
    let classes = classes(&moment.case);
    let area = axes.place.width * axes.place.height / f64::from(record.robots).max(1.0);
    let size = (0.55 * area.sqrt()).clamp(1.2, 9.0);
    for (class, colour) in COLOURS.iter().enumerate().rev() {
        let is_in = |index: usize| classes.as_ref().map_or(class == 0, |classes| classes[index] == class);
        let normal = |index: &usize| !record.malicious[*index] && is_in(*index);
        let colour = if classes.is_some() { colour } else { NORMAL };
        draw_dots(svg, (0..record.malicious.len()).filter(normal).map(point), colour, size);
    }
    let liars = (0..record.malicious.len()).filter(|index| record.malicious[*index]);
    draw_dots(svg, liars.map(point), MALICIOUS, 1.25 * size);
}

/// One path for all dots: lines without length with round ends.
fn draw_dots(svg: &mut Svg, points: impl Iterator<Item = [f64; 2]>, colour: &str, size: f64) {
    let mut path = PathData::default();
    for [x, y] in points {
        path.start([x, y]);
        path.continue_to([x, y]);
    }
    if !path.is_empty() {
        let dots = path.element().text("fill", "none").text("stroke", colour);
        svg.add(dots.number("stroke-width", size).text("stroke-linecap", "round"));
    }
}

fn draw_links(svg: &mut Svg, axes: &Axes, moment: &Moment<'_>, view: View) {
    let record = moment.case.record;
    if record.robots > LINKED_MAX {
        return;
    }
    let links = links(record, moment.case.scenario, moment.place);
    if links.len() > LINKS_MAX {
        return;
    }
    let mut path = PathData::default();
    for link in &links {
        let [from, to] =
            [link.first, link.second].map(|index| axes.at(view.point(record, moment.place, index)));
        path.start(from);
        path.continue_to(to);
    }
    if !path.is_empty() {
        let line = path.element().text("fill", "none").text("stroke", LINK);
        svg.add(line.number("stroke-width", 0.35));
    }
}

/// Which colour says what, in one line around the middle.
fn draw_legend(svg: &mut Svg, [middle, height]: [f64; 2], cases: &[Case<'_>]) {
    let ranked = cases.iter().any(|case| case.scenario.ranking().is_some());
    let mut entries: Vec<(&str, &str)> = Vec::new();
    if ranked {
        entries.push((COLOURS[0], "core"));
        let words = ["lowest ranks", "", "", "", "highest ranks"];
        entries.extend(COLOURS[1..].iter().copied().zip(words));
    } else {
        entries.push((NORMAL, "normal"));
    }
    entries.push((MALICIOUS, "malicious"));
    let wide = |word: &str| {
        if word.is_empty() {
            14.0
        } else {
            22.0 + 6.2 * f64::from(u8::try_from(word.len()).unwrap_or(u8::MAX))
        }
    };
    let mut left = middle - 0.5 * entries.iter().map(|(_, word)| wide(word)).sum::<f64>();
    for (colour, word) in entries {
        draw_dots(svg, [[left + 5.0, height - 0.35 * LABEL]].into_iter(), colour, 8.0);
        if !word.is_empty() {
            let text =
                Element::new("text").point(["x", "y"], [left + 13.0, height]).number("font-size", LABEL);
            svg.add(text.text("fill", INK).label(&[Piece::Plain(word)]));
        }
        left += wide(word);
    }
}

/// A quantity of normal robots, of which a band over time is drawn.
#[derive(Clone, Copy)]
enum Band {
    Value,
    Degree,
}

impl Band {
    fn number(self, record: &Record, row: usize) -> f64 {
        match self {
            Self::Value => record.value[row],
            Self::Degree => f64::from(record.degree[row]),
        }
    }

    fn title(self, case: &Case<'_>) -> String {
        let what = match self {
            Self::Value => "values",
            Self::Degree => "neighbours",
        };
        format!("{what} of normal robots, {}", case.title)
    }

    /// Least, lower quartile, median, upper quartile and greatest at one place of the record.
    fn five(self, record: &Record, place: usize) -> [f64; 5] {
        let normal = (0..record.malicious.len()).filter(|index| !record.malicious[*index]);
        let mut numbers: Vec<f64> =
            normal.map(|index| self.number(record, record.row(place, index))).collect();
        numbers.sort_unstable_by(f64::total_cmp);
        let last = numbers.len().saturating_sub(1);
        [0, 1, 2, 3, 4].map(|part| numbers.get(part * last / 4).copied().unwrap_or(f64::NAN))
    }

    fn draw(self, svg: &mut Svg, grid: &Grid, column: usize, case: &Case<'_>) {
        let record = case.record;
        let step = (record.ticks.len() / TIMES_MAX).max(1);
        let places = (0..record.ticks.len()).step_by(step);
        let bands: Vec<(f64, [f64; 5])> =
            places.map(|place| (record.time_s(place), self.five(record, place))).collect();
        let all = Range::of(bands.iter().flat_map(|(_, five)| *five)).padded(0.5);
        let axes =
            Axes { place: grid.place(column, 1), x: time_range(&[*case]), y: all.padded(0.04 * all.width()) };
        for (low, high, opacity) in [(0, 4, 0.18), (1, 3, 0.35)] {
            let mut path = PathData::default();
            let above = bands.iter().map(|(time_s, five)| axes.at_cut([*time_s, five[high]]));
            let below = bands.iter().rev().map(|(time_s, five)| axes.at_cut([*time_s, five[low]]));
            above.chain(below).for_each(|point| path.continue_to(point));
            if !path.is_empty() {
                svg.add(path.element().text("fill", NORMAL).number("fill-opacity", opacity));
            }
        }
        let mut path = PathData::default();
        for (time_s, five) in &bands {
            path.continue_to(axes.at_cut([*time_s, five[2]]));
        }
        if !path.is_empty() {
            let line = path.element().text("fill", "none").text("stroke", NORMAL);
            svg.add(line.number("stroke-width", 1.3));
        }
        let label = [Piece::Plain("all, half, median")];
        let title = [self.title(case)];
        axes.draw(
            svg,
            &Decoration {
                title: &title,
                x_label: TIME_LABEL,
                y_label: &label,
                x_numbers: true,
                y_numbers: true,
            },
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use closeranks_sim::parse::scenario;
    use closeranks_sim::world::{Options, run};

    #[test]
    fn a_figure_of_many_robots_is_small_and_shows_all() {
        let text = "duration_s = 0.4\nteam = { robots = 600, faults = 2, ranks = { core = 7 } }\n\
            controller = { kind = \"links\" }\nclock = { tau_1_s = 0.1 }\nmotion = { kind = \"outward\" }";
        let scenario = scenario(text).unwrap();
        let run = run(&scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap();
        let record = run.record.unwrap();
        let svg = swarm(&[Case { title: "many", scenario: &scenario, record: &record }]);
        let dots = svg.matches("stroke-linecap=\"round\"").count();
        assert!(dots >= 14, "two formations and a legend, each with six ranks and liars: {dots}");
        assert!(svg.len() < 100_000, "{}", svg.len());
        assert!(svg.contains("highest ranks") && svg.contains("malicious") && svg.contains("start, t = 0 s"));
    }
}
