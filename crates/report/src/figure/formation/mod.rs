//! A panel with the robots of one tick and the links between them.

pub(crate) mod links;
pub(crate) mod marker;
pub(crate) mod obstacles;
pub(crate) mod view;

use closeranks_sim::output::record::Record;

use self::links::{Link, cut_links, links, pairs_within};
use self::marker::{Kind, Marker, ring, robots_group};
use self::view::{View, views};
use crate::figure::Case;
use crate::figure::panel::axes::Axes;
use crate::figure::panel::ticks::{Range, plain};
use crate::figure::panel::title::Title;
use crate::svg::palette::{LINK, MALICIOUS, OBSTACLE};
use crate::svg::path::PathData;
use crate::svg::{Element, Svg};

/// Up to so many robots have numbers in them.
const NUMBERED: u16 = 40;
/// More links than this in a panel are hairlines: their dots could not be told apart.
const DOTTED: usize = 1_500;

/// Length of a dot and of the space after it.
const DOTS: &str = "1.2 1.9";
/// Dots of a link that something cuts are farther apart.
const CUT_DOTS: &str = "1.2 4";
/// Length of a dot and of the space after it, of links.
const PERIOD: f64 = 3.1;

/// One tick of a case.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment<'a> {
    /// Whose.
    pub(crate) case: Case<'a>,
    /// Which.
    pub(crate) tick: usize,
    /// It is shown as the start of all cases.
    pub(crate) start: bool,
    /// From where.
    pub(crate) view: View,
}

/// Everything that panels of one figure share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Look {
    /// Shown from left to right, m.
    pub(crate) x: Range,
    /// Shown from bottom to top, m.
    pub(crate) y: Range,
    /// Robots.
    pub(crate) marker: Marker,
    /// Height of a panel over its width.
    pub(crate) aspect: f64,
}

impl Look {
    /// One look for all `moments` in panels of `width`, at most `tallest` times as high: a metre is as long in x as in y, in every panel.
    #[must_use]
    pub(crate) fn of(moments: &[Moment<'_>], width: f64, tallest: f64) -> Self {
        let [x, y] = [0, 1].map(|axis| Range::of(coordinates(moments, axis)));
        let margin = 0.09 * x.width().max(y.width()).max(1.0);
        let (x, y) = (x.padded(margin), y.padded(margin));
        let aspect = (y.width() / x.width()).clamp(0.6, tallest);
        let span = x.width().max(y.width() / aspect);
        let (x, y) = (x.widened_to(span), y.widened_to(span * aspect));
        Self { x, y, marker: Marker::of(moments, width / span), aspect }
    }

    /// The same panels with room for the whole way of every robot: a path may leave what holds its two ends.
    #[must_use]
    pub(crate) fn with_ways(self, cases: &[Case<'_>]) -> Self {
        let [x, y] = [0, 1].map(|axis| Range::of(ways(cases, axis)));
        if self.x.with(x) == self.x && self.y.with(y) == self.y {
            return self;
        }
        let margin = 0.03 * x.width().max(y.width());
        let (x, y) = (self.x.with(x.padded(margin)), self.y.with(y.padded(margin)));
        let span = x.width().max(y.width() / self.aspect);
        Self { x: x.widened_to(span), y: y.widened_to(span * self.aspect), ..self }
    }
}

/// A coordinate of all robots at all ticks, in every view.
fn ways<'a>(cases: &'a [Case<'_>], axis: usize) -> impl Iterator<Item = f64> + 'a {
    views(cases).iter().flat_map(move |view| cases.iter().flat_map(move |case| way(*case, *view, axis)))
}

fn way(case: Case<'_>, view: View, axis: usize) -> impl Iterator<Item = f64> {
    let robots = 0..usize::from(case.record.robots);
    let ticks = 0..=case.record.last_tick();
    ticks.flat_map(move |tick| robots.clone().map(move |index| view.point(case.record, tick, index)[axis]))
}

impl Marker {
    /// As large as robots leave room for, at `scale` page units a metre.
    fn of(moments: &[Moment<'_>], scale: f64) -> Self {
        let numbered = moments.iter().all(|moment| moment.case.record.robots <= NUMBERED);
        let [least, greatest] = if numbered { [4.9, 7.0] } else { [2.2, 4.0] };
        let distances = moments.iter().map(|moment| usual_distance(moment));
        let room = 0.45 * scale * distances.fold(f64::INFINITY, f64::min);
        Self { radius: room.clamp(least, greatest), numbered }
    }
}

/// The distance in the plane that nine of ten robots keep from all others, m.
fn usual_distance(moment: &Moment<'_>) -> f64 {
    let points = moment.points();
    let nearest = |point: &[f64; 2]| {
        let squares = points.iter().map(|other| {
            let [dx, dy] = [other[0] - point[0], other[1] - point[1]];
            dx * dx + dy * dy
        });
        squares.filter(|square| *square > 0.0).fold(f64::INFINITY, f64::min).sqrt()
    };
    let mut distances: Vec<f64> = points.iter().map(nearest).collect();
    distances.sort_by(f64::total_cmp);
    distances.get(distances.len() / 10).copied().unwrap_or(f64::INFINITY)
}

fn coordinates<'a>(moments: &'a [Moment<'_>], axis: usize) -> impl Iterator<Item = f64> + 'a {
    moments.iter().flat_map(Moment::points).map(move |point| point[axis])
}

impl<'a> Moment<'a> {
    /// The first tick of a case.
    #[must_use]
    pub(crate) fn start(case: Case<'a>, view: View) -> Self {
        Self { case, tick: 0, start: true, view }
    }

    /// The last tick of a case.
    #[must_use]
    pub(crate) fn end(case: Case<'a>, view: View) -> Self {
        Self { case, tick: case.record.last_tick(), start: false, view }
    }

    fn record(&self) -> &'a Record {
        self.case.record
    }

    /// Where robots are in the plane of the view, m.
    fn points(&self) -> Vec<[f64; 2]> {
        let robots = 0..usize::from(self.record().robots);
        robots.map(|index| self.view.point(self.record(), self.tick, index)).collect()
    }

    /// What its panel is called: the start, or the case and the time.
    #[must_use]
    pub(crate) fn title(&self) -> Title {
        let time = format!("t = {} s", plain(self.record().time_s(self.tick)));
        let name = if self.start { "start" } else { self.case.title };
        Title { name: name.into(), time, time_known: self.start }
    }

    /// Draws links, then robots: in the order of their numbers, which stay readable where robots overlap (a wide number is
    /// above a narrow one); without numbers malicious ones last.
    pub(crate) fn draw(&self, svg: &mut Svg, axes: &Axes, marker: Marker) {
        self.draw_obstacles(svg, axes);
        let points: Vec<[f64; 2]> = self.points().into_iter().map(|point| axes.at(point)).collect();
        let mut links = links(self.record(), self.case.scenario, self.tick);
        links.retain(|link| is_of_one_team(self.case, link));
        draw_cut(svg, &points, &cut_links(self.record(), self.case.scenario, self.tick));
        let (red, grey): (Vec<Link>, Vec<Link>) = links.iter().partition(|link| link.malicious);
        for (some, colour) in [(grey, LINK), (red, MALICIOUS)] {
            draw_links(svg, &points, &some, colour, links.len() <= DOTTED);
        }
        self.draw_robots(svg, &points, marker);
        for index in self.too_close().into_iter().filter(|index| points[*index][0].is_finite()) {
            svg.add(ring(points[index], marker.radius));
        }
        self.view.draw_note(svg, axes.place, self.record());
    }

    /// Robots that are closer to another one than the scenario demands, by index.
    #[must_use]
    pub(crate) fn too_close(&self) -> Vec<usize> {
        let close = pairs_within(self.record(), self.case.scenario.limits.distance_min_m, self.tick);
        let mut robots: Vec<usize> = close.iter().flat_map(|pair| [pair.first, pair.second]).collect();
        robots.sort_unstable();
        robots.dedup();
        robots
    }

    /// Draws what stands in the way.
    pub(crate) fn draw_obstacles(&self, svg: &mut Svg, axes: &Axes) {
        let (scale, list) = (axes.place.width / axes.x.width(), &self.case.scenario.obstacles.list);
        obstacles::draw(svg, axes.place, scale, |x| axes.at(self.view.seen(x)), list);
    }

    /// Draws the robots alone, where they are seen at this tick.
    pub(crate) fn draw_only_robots(&self, svg: &mut Svg, axes: &Axes, marker: Marker) {
        let points: Vec<[f64; 2]> = self.points().into_iter().map(|point| axes.at(point)).collect();
        self.draw_robots(svg, &points, marker);
    }

    fn draw_robots(&self, svg: &mut Svg, points: &[[f64; 2]], marker: Marker) {
        let kind = |index: &usize| Kind::of(self.case, *index);
        let mut order: Vec<usize> = (0..points.len()).filter(|index| points[*index][0].is_finite()).collect();
        if !marker.numbered {
            order.sort_by_key(kind);
        }
        for alike in order.chunk_by(|a, b| kind(a) == kind(b)) {
            let kind = kind(&alike[0]);
            svg.begin(&robots_group(kind, marker));
            for index in alike {
                marker.draw(svg, points[*index], kind.malicious, index + 1);
            }
            svg.end();
        }
    }
}

/// True for a link: robots of different teams have none, however near they are.
pub(crate) fn is_of_one_team(case: Case<'_>, link: &Link) -> bool {
    case.scenario.team_of(link.first) == case.scenario.team_of(link.second)
}

/// Pairs within R whose link something cuts: a thin line in the colour of what cuts them.
fn draw_cut(svg: &mut Svg, points: &[[f64; 2]], pairs: &[Link]) {
    let path = lines(points, pairs);
    if !path.is_empty() {
        let element = path.element().text("fill", "none").text("stroke", OBSTACLE);
        svg.add(element.number("stroke-width", 0.9).text("stroke-dasharray", CUT_DOTS));
    }
}

/// All links of one colour in one path.
fn draw_links(svg: &mut Svg, points: &[[f64; 2]], links: &[Link], colour: &str, dotted: bool) {
    let path = lines(points, links);
    if !path.is_empty() {
        svg.add(link_style(path.element(), colour, dotted));
    }
}

fn lines(points: &[[f64; 2]], links: &[Link]) -> PathData {
    let mut path = PathData::default();
    for link in links {
        let ends = [points[link.first], points[link.second]];
        if ends.iter().flatten().all(|end| end.is_finite()) {
            let [start, end] = in_step(ends);
            path.start(start);
            path.continue_to(end);
        }
    }
    path
}

/// Shortens a link by less than a period, under the marker at its end, so that links along one line have their dots in the
/// same places: else the dots of one fill the spaces of another, and the line looks solid.
fn in_step(mut ends: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    ends.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let [start, end] = ends;
    let offset = [end[0] - start[0], end[1] - start[1]];
    let length = (offset[0] * offset[0] + offset[1] * offset[1]).sqrt();
    if length < 2.0 * PERIOD {
        return ends;
    }
    let along = (start[0] * offset[0] + start[1] * offset[1]) / length;
    let share = (PERIOD - along.rem_euclid(PERIOD)) / length;
    [[start[0] + share * offset[0], start[1] + share * offset[1]], end]
}

/// Dotted, or a hairline where there are too many.
pub(crate) fn link_style(element: Element, colour: &str, dotted: bool) -> Element {
    let element = element.text("fill", "none").text("stroke", colour);
    if dotted {
        element.number("stroke-width", 0.9).text("stroke-dasharray", DOTS)
    } else {
        element.number("stroke-width", 0.25).number("stroke-opacity", 0.5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use closeranks_sim::scenario::Scenario;
    use closeranks_sim::scenario::desired::Desired;
    use closeranks_sim::world::{Options, run};

    #[test]
    fn a_way_that_leaves_its_ends_makes_the_panel_wider() {
        let scenario = Scenario { duration_s: 5.0, desired: Desired::Wander, ..Scenario::default() };
        let run = run(&scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap();
        let record = run.record.unwrap();
        let case = Case { title: "wander", scenario: &scenario, record: &record };
        let start = Moment::start(case, views(&[case])[0]);
        let narrow = Look {
            x: Range { min: -0.1, max: 0.1 },
            y: Range { min: 0.0, max: 0.2 },
            ..Look::of(&[start], 300.0, 1.0)
        };
        let wide = narrow.with_ways(&[case]);
        let holds = |look: &Look| {
            ways(&[case], 0).all(|x| (look.x.min..=look.x.max).contains(&x))
                && ways(&[case], 1).all(|y| (look.y.min..=look.y.max).contains(&y))
        };
        assert!(!holds(&narrow) && holds(&wide));
        assert!((wide.y.width() / wide.x.width() - wide.aspect).abs() < 1e-12);
        assert_eq!(wide.with_ways(&[case]), wide);
    }
}
