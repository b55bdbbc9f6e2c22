//! A panel with the robots of one tick and the links between them.

use closeranks_sim::output::record::Record;

use crate::figure::Case;
use crate::figure::links::{Link, links, position};
use crate::figure::panel::axes::{Axes, Place};
use crate::figure::panel::ticks::{Range, plain};
use crate::figure::panel::title::Title;
use crate::svg::palette::{CLOSE, FRAME, LINK, MALICIOUS, NORMAL};
use crate::svg::path::PathData;
use crate::svg::{Element, Piece, Svg};

/// Up to so many robots have numbers in them.
const NUMBERED: u16 = 40;
/// More links than this in a panel are hairlines: their dots could not be told apart.
const DOTTED: usize = 1_500;

/// Length of a dot and of the space after it.
const DOTS: &str = "1.2 1.9";
/// Their sum.
const PERIOD: f64 = 3.1;

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

/// How robots are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Marker {
    /// Radius of the circle; squares have the same area.
    pub(crate) radius: f64,
    /// With the robot's number.
    pub(crate) numbered: bool,
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

impl View {
    /// Where robot `index` is seen at `tick`, m.
    #[must_use]
    pub(crate) fn point(self, record: &Record, tick: usize, index: usize) -> [f64; 2] {
        let position = position(record, tick, index);
        [position[self.across], position[self.up]]
    }

    /// Says in the panel from where robots are seen, if there is more than one way.
    pub(crate) fn draw_note(self, svg: &mut Svg, place: Place, record: &Record) {
        if record.dimension > 2 {
            note(svg, place, self.note);
        }
    }
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
        let points: Vec<[f64; 2]> = self.points().into_iter().map(|point| axes.at(point)).collect();
        let links = links(self.record(), self.case.scenario.link.radius_m, self.tick);
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
        let close = links(self.record(), self.case.scenario.limits.distance_min_m, self.tick);
        let mut robots: Vec<usize> = close.iter().flat_map(|pair| [pair.first, pair.second]).collect();
        robots.sort_unstable();
        robots.dedup();
        robots
    }

    /// Draws the robots alone, where they are seen at this tick.
    pub(crate) fn draw_only_robots(&self, svg: &mut Svg, axes: &Axes, marker: Marker) {
        let points: Vec<[f64; 2]> = self.points().into_iter().map(|point| axes.at(point)).collect();
        self.draw_robots(svg, &points, marker);
    }

    fn draw_robots(&self, svg: &mut Svg, points: &[[f64; 2]], marker: Marker) {
        let kind = |index: &usize| self.record().malicious.get(*index).copied().unwrap_or(false);
        let mut order: Vec<usize> = (0..points.len()).filter(|index| points[*index][0].is_finite()).collect();
        if !marker.numbered {
            order.sort_by_key(kind);
        }
        for alike in order.chunk_by(|a, b| kind(a) == kind(b)) {
            let malicious = kind(&alike[0]);
            svg.begin(&robots_group(malicious, marker));
            for index in alike {
                draw_robot(svg, points[*index], marker, malicious, index + 1);
            }
            svg.end();
        }
    }
}

fn draw_robot(svg: &mut Svg, point: [f64; 2], marker: Marker, malicious: bool, number: usize) {
    svg.add(shape(point, marker.radius, malicious));
    if marker.numbered {
        svg.add(robot_number(point, marker.radius, number));
    }
}

/// All links of one colour in one path.
fn draw_links(svg: &mut Svg, points: &[[f64; 2]], links: &[Link], colour: &str, dotted: bool) {
    let mut path = PathData::default();
    for link in links {
        let ends = [points[link.first], points[link.second]];
        if ends.iter().flatten().all(|end| end.is_finite()) {
            let [start, end] = in_step(ends);
            path.start(start);
            path.continue_to(end);
        }
    }
    if !path.is_empty() {
        svg.add(link_style(path.element(), colour, dotted));
    }
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

/// What all robots of a kind share.
pub(crate) fn robots_group(malicious: bool, marker: Marker) -> Element {
    let colour = if malicious { MALICIOUS } else { NORMAL };
    let edge = if marker.numbered { 0.9 } else { 0.4 };
    let group = Element::group().text("fill", colour).text("stroke", "#ffffff").number("stroke-width", edge);
    group.text("text-anchor", "middle").text("font-weight", "bold")
}

/// Around a robot that is closer to another one than it may be.
pub(crate) fn ring(point: [f64; 2], radius: f64) -> Element {
    let ring = Element::new("circle").point(["cx", "cy"], point).number("r", radius + 2.6);
    ring.text("fill", "none").text("stroke", CLOSE).number("stroke-width", 1.8)
}

/// A circle, or for malicious robots a square of the same area.
pub(crate) fn shape(point: [f64; 2], radius: f64, malicious: bool) -> Element {
    if malicious {
        let side = 1.772 * radius;
        let corner = point.map(|coordinate| coordinate - 0.5 * side);
        Element::new("rect").point(["x", "y"], corner).number("width", side).number("height", side)
    } else {
        Element::new("circle").point(["cx", "cy"], point).number("r", radius)
    }
}

fn robot_number([x, y]: [f64; 2], radius: f64, number: usize) -> Element {
    let size = if number < 10 { 1.4 * radius } else { 1.2 * radius };
    let text = Element::new("text").point(["x", "y"], [x, y + 0.36 * size]).number("font-size", size);
    text.text("fill", "#ffffff").text("stroke", "none").label(&[Piece::Plain(&number.to_string())])
}

/// A remark in the lower right corner of a panel.
fn note(svg: &mut Svg, place: Place, text: &str) {
    let at = [place.left + place.width - 5.0, place.bottom() - 5.0];
    let element = Element::new("text").point(["x", "y"], at).number("font-size", 9.0);
    svg.add(element.text("text-anchor", "end").text("fill", FRAME).label(&[Piece::Plain(text)]));
}
