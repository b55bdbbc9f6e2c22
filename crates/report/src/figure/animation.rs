//! A run as a picture that moves: robots and links in some seconds, over and over. It is one SVG file without scripts; what cannot move it
//! shows the end.

use core::fmt::Write as _;

use closeranks_sim::output::record::Record;

use super::Case;
use super::formation::links::{Link, links};
use super::formation::marker::{Kind, Marker, robots_group, shape};
use super::formation::{is_of_one_team, obstacles};
use super::panel::axes::Place;
use super::panel::ticks::{Range, plain};
use crate::svg::palette::{CLOSE, FRAME, INK, LINK, MALICIOUS};
use crate::svg::{Element, Piece, Svg, number};

/// Of the document. Tenths of a unit are enough for positions.
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 420.0;
const MARGIN: f64 = 16.0;
/// Room for the title above and for the time below.
const ABOVE: f64 = 34.0;
const BELOW: f64 = 46.0;

/// How long a round takes, s, and which part of it the end is shown.
const ROUND_S: f64 = 9.0;
const HELD: f64 = 0.15;
/// Pictures of a round: as many as fit, and no more than can be told apart.
const FRAMES: [usize; 2] = [10, 60];
/// Bytes that positions may take.
const BYTES_MAX: usize = 240_000;
/// Bytes of a link and of a robot with its ring in a picture.
const LINK_BYTES: usize = 22;
const ROBOT_BYTES: usize = 30;
/// Robots at most.
const ROBOTS_MAX: u16 = 800;

/// The run of `case` as an animated SVG, of at most some hundred kilobytes: large teams are shown in fewer pictures, and the largest
/// without links. None of more than 800 robots, and none where robots come and go.
#[must_use]
pub fn animation(case: Case<'_>) -> Option<String> {
    if case.record.robots > ROBOTS_MAX || !case.scenario.absences.is_empty() {
        return None;
    }
    let film = Film::new(case);
    let label =
        format!("{}: how robots move and who is linked, in {} pictures", case.title, film.places.len());
    let mut svg = Svg::new(WIDTH, HEIGHT, &label);
    film.draw_title(&mut svg);
    film.draw_obstacles(&mut svg);
    film.draw_links(&mut svg);
    film.draw_robots(&mut svg);
    film.draw_time(&mut svg);
    Some(svg.finish())
}

/// What is shown: some places of a record, and where they lie on the page.
struct Film<'a> {
    case: Case<'a>,
    places: Vec<usize>,
    /// Pairs that are ever linked, none if there is no room for them.
    pairs: Vec<Link>,
    /// For each picture, whether each of these pairs is linked.
    linked: Vec<Vec<bool>>,
    scale: f64,
    middle_m: [f64; 2],
    marker: Marker,
}

impl<'a> Film<'a> {
    fn new(case: Case<'a>) -> Self {
        let record = case.record;
        let robots = usize::from(record.robots);
        let most = places(record, FRAMES[1]);
        let (pairs, _) = pairs(case, &most);
        let room = |pairs: usize| BYTES_MAX / (pairs * LINK_BYTES + robots * ROBOT_BYTES).max(1);
        let with_links = room(pairs.len()) >= FRAMES[0];
        let frames = room(if with_links { pairs.len() } else { 0 }).clamp(FRAMES[0], FRAMES[1]);
        let places = places(record, frames);
        let (pairs, linked) = if with_links { self::pairs(case, &places) } else { Default::default() };
        let [x, y] = [0, 1].map(|axis| Range::of(coordinates(record, &places, axis)));
        let [wide, high] = [WIDTH - 2.0 * MARGIN, HEIGHT - ABOVE - BELOW];
        let radius = if robots <= 40 { 9.0 } else { 4.0 };
        let scale = ((wide - 3.0 * radius) / x.width()).min((high - 3.0 * radius) / y.width());
        let middle_m = [x, y].map(|range| 0.5 * (range.min + range.max));
        Self {
            case,
            places,
            pairs,
            linked,
            scale,
            middle_m,
            marker: Marker { radius, numbered: robots <= 40 },
        }
    }

    /// Where a robot is on the page in the picture at `place`.
    fn point(&self, place: usize, index: usize) -> [f64; 2] {
        self.at(self.case.record.point(place, index))
    }

    /// Where a point in m is on the page.
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let middle = [0.5 * WIDTH, ABOVE + 0.5 * (HEIGHT - ABOVE - BELOW)];
        [middle[0] + (x - self.middle_m[0]) * self.scale, middle[1] - (y - self.middle_m[1]) * self.scale]
    }

    fn draw_obstacles(&self, svg: &mut Svg) {
        let [width, height] = [WIDTH - 2.0 * MARGIN, HEIGHT - ABOVE - BELOW];
        let place = Place { left: MARGIN, top: ABOVE, width, height };
        obstacles::draw(
            svg,
            place,
            self.scale,
            |x| self.at([x[0], x[1]]),
            &self.case.scenario.obstacles.list,
        );
    }

    fn draw_title(&self, svg: &mut Svg) {
        let text = Element::new("text").point(["x", "y"], [MARGIN, 22.0]).number("font-size", 13.0);
        let controller = format!("  under {}", self.case.scenario.controller.name());
        let pieces = [Piece::Plain(self.case.title), Piece::Plain(&controller)];
        svg.add(text.text("fill", INK).label(&pieces));
        if self.case.record.dimension > 2 {
            let note =
                Element::new("text").point(["x", "y"], [WIDTH - MARGIN, 22.0]).number("font-size", 10.0);
            let note = note.text("fill", FRAME).text("text-anchor", "end");
            svg.add(note.label(&[Piece::Plain("3D, seen along z")]));
        }
    }

    /// All links of a colour are one path. Of a pair that is not linked, both ends lie in its middle.
    fn draw_links(&self, svg: &mut Svg) {
        for (malicious, colour) in [(false, LINK), (true, MALICIOUS)] {
            let some: Vec<usize> =
                (0..self.pairs.len()).filter(|pair| self.pairs[*pair].malicious == malicious).collect();
            if some.is_empty() {
                continue;
            }
            let shown = |frame: usize| self.path(frame, &some);
            let path = Element::new("path").text("d", &shown(self.places.len() - 1)).text("fill", "none");
            let path =
                path.text("stroke", colour).number("stroke-width", 1.0).text("stroke-dasharray", "1.5 3");
            svg.add(path.child(self.moving("d", "linear", shown)));
        }
    }

    fn path(&self, frame: usize, pairs: &[usize]) -> String {
        let mut data = String::new();
        for pair in pairs {
            let Link { first, second, .. } = self.pairs[*pair];
            let [a, b] = [first, second].map(|index| self.point(self.places[frame], index));
            let middle = [0, 1].map(|axis| 0.5 * (a[axis] + b[axis]));
            let [a, b] = if self.linked[frame][*pair] { [a, b] } else { [middle; 2] };
            let _ = write!(data, "M{} {}L{} {}", short(a[0]), short(a[1]), short(b[0]), short(b[1]));
        }
        data
    }

    fn draw_robots(&self, svg: &mut Svg) {
        for index in 0..usize::from(self.case.record.robots) {
            let malicious = self.case.record.malicious.get(index) == Some(&true);
            let shown = |frame: usize| {
                let [x, y] = self.point(self.places[frame], index);
                format!("{} {}", short(x), short(y))
            };
            let last = format!("translate({})", shown(self.places.len() - 1));
            svg.begin(&robots_group(Kind::of(self.case, index), self.marker).text("transform", &last));
            svg.add(shape([0.0; 2], self.marker.radius, malicious));
            if self.marker.numbered {
                let text = Element::new("text").number("y", 4.0).number("font-size", 11.0);
                let text = text.text("fill", "#ffffff").text("stroke", "none");
                svg.add(text.label(&[Piece::Plain(&(index + 1).to_string())]));
            }
            self.draw_need(svg, index);
            let moving = self.values("animateTransform", "transform", "linear", shown);
            svg.add(moving.text("type", "translate"));
            svg.end();
        }
    }

    /// Whether an honest robot has fewer neighbours than it needs.
    fn is_short(&self, frame: usize, index: usize) -> bool {
        let record = self.case.record;
        let malicious = record.malicious.get(index) == Some(&true);
        !malicious && record.degree[record.row(self.places[frame], index)] < record.required_degree
    }

    /// A ring around an honest robot while it has fewer neighbours than it needs.
    fn draw_need(&self, svg: &mut Svg, index: usize) {
        let is_short = |frame: usize| self.is_short(frame, index);
        if !(0..self.places.len()).any(is_short) {
            return;
        }
        let shown = |frame: usize| u8::from(is_short(frame)).to_string();
        let ring = Element::new("circle").number("r", self.marker.radius + 4.0).text("fill", "none");
        let ring = ring.text("stroke", CLOSE).number("stroke-width", 2.0).text("stroke-dasharray", "5 3");
        let ring = ring.text("opacity", &shown(self.places.len() - 1));
        svg.add(ring.child(self.moving("opacity", "discrete", shown)));
    }

    /// A bar that grows with the time, and what marks mean.
    fn draw_time(&self, svg: &mut Svg) {
        let (wide, y) = (WIDTH - 2.0 * MARGIN, HEIGHT - BELOW + 12.0);
        let bar = |width: f64, colour: &str| {
            let bar = Element::new("rect").point(["x", "y"], [MARGIN, y]).number("width", width);
            bar.number("height", 3.0).text("fill", colour)
        };
        let record = self.case.record;
        let last_s = record.time_s(record.last_tick());
        let shown = |frame: usize| {
            let part = if last_s > 0.0 { record.time_s(self.places[frame]) / last_s } else { 1.0 };
            number(part * wide)
        };
        svg.add(bar(wide, "#e4e4e4"));
        svg.add(bar(wide, FRAME).child(self.moving("width", "linear", shown)));
        let text = |x: f64, anchor: &str, label: &str| {
            let text = Element::new("text").point(["x", "y"], [x, HEIGHT - 14.0]).number("font-size", 11.0);
            text.text("fill", FRAME).text("text-anchor", anchor).label(&[Piece::Plain(label)])
        };
        let rings = (0..self.places.len())
            .any(|frame| (0..usize::from(record.robots)).any(|index| self.is_short(frame, index)));
        let ring = format!("; ring: fewer than {} neighbours", record.required_degree);
        let legend = format!("circles: honest; squares: malicious{}", if rings { &ring } else { "" });
        svg.add(text(MARGIN, "start", &legend));
        svg.add(text(WIDTH - MARGIN, "end", &format!("{} s", plain(last_s))));
    }

    fn moving(&self, attribute: &str, mode: &str, shown: impl Fn(usize) -> String) -> Element {
        self.values("animate", attribute, mode, shown)
    }

    /// An attribute over all pictures; the last one stays for a while.
    fn values(
        &self,
        name: &'static str,
        attribute: &str,
        mode: &str,
        shown: impl Fn(usize) -> String,
    ) -> Element {
        let frames = self.places.len();
        let mut values: Vec<String> = (0..frames).map(&shown).collect();
        let mut times: Vec<String> = (0..frames).map(|frame| time(frame, frames)).collect();
        values.push(shown(frames - 1));
        times.push("1".to_owned());
        let element = Element::new(name).text("attributeName", attribute).text("calcMode", mode);
        let element = element.text("dur", &format!("{}s", number(ROUND_S))).text("repeatCount", "indefinite");
        element.text("keyTimes", &times.join(";")).text("values", &values.join(";"))
    }
}

/// When a picture is shown, as a part of a round.
#[expect(clippy::cast_precision_loss, reason = "some tens of pictures")]
fn time(frame: usize, frames: usize) -> String {
    let part = frame as f64 / (frames - 1).max(1) as f64;
    format!("{:.4}", part * (1.0 - HELD))
}

/// A coordinate with a tenth of a unit.
fn short(coordinate: f64) -> String {
    number((coordinate * 10.0).round() / 10.0)
}

/// Places of the record that are as far from each other in time as can be, the first and the last among them.
fn places(record: &Record, frames: usize) -> Vec<usize> {
    let last = record.last_tick();
    let end = record.ticks.get(last).copied().unwrap_or(0);
    let steps = u64::try_from(frames.max(2) - 1).unwrap_or(1);
    let mut places: Vec<usize> = (0..=steps)
        .map(|step| {
            let wanted = u64::from(end) * step / steps;
            record.ticks.partition_point(|tick| u64::from(*tick) < wanted).min(last)
        })
        .collect();
    places.dedup();
    if places.len() == 1 {
        places.push(places[0]);
    }
    places
}

/// Pairs that are linked in any of the pictures, and for each picture which of them are.
fn pairs(case: Case<'_>, places: &[usize]) -> (Vec<Link>, Vec<Vec<bool>>) {
    let shown: Vec<Vec<Link>> = places.iter().map(|place| links_of(case, *place)).collect();
    let mut pairs: Vec<Link> = shown.iter().flatten().copied().collect();
    pairs.sort_by_key(|link| (link.first, link.second));
    pairs.dedup();
    let linked = shown.iter().map(|links| pairs.iter().map(|pair| links.contains(pair)).collect()).collect();
    (pairs, linked)
}

/// The links at one place of the record.
fn links_of(case: Case<'_>, place: usize) -> Vec<Link> {
    let mut links = links(case.record, case.scenario, place);
    links.retain(|link| is_of_one_team(case, link));
    links
}

fn coordinates<'a>(record: &'a Record, places: &'a [usize], axis: usize) -> impl Iterator<Item = f64> + 'a {
    let robots = 0..usize::from(record.robots);
    places.iter().flat_map(move |place| robots.clone().map(move |index| record.point(*place, index)[axis]))
}
