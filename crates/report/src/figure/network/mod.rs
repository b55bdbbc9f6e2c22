//! A picture of a graph in which two sets of nodes and a third one are marked.

mod layout;
mod mark;

use closeranks_graph::graph::Graph;
use closeranks_graph::graph::set::NodeSet;

use self::layout::positions;
use self::mark::{Kind, Mark};
use crate::svg::palette::{INK, LABEL, TITLE};
use crate::svg::path::PathData;
use crate::svg::text::{shorten, width};
use crate::svg::{Element, Piece, Svg};

/// A graph to be shown.
#[derive(Clone, Copy, Debug)]
pub struct Network<'a> {
    /// The graph.
    pub graph: &'a Graph,
    /// The name of each node; missing ones are left out.
    pub names: &'a [String],
    /// One line above, cut if it is too wide.
    pub title: &'a str,
    /// Blue circles.
    pub first: NodeSet,
    /// Orange diamonds.
    pub second: NodeSet,
    /// Vermillion squares with a rim in the colour of the set that they are in.
    pub exempt: NodeSet,
    /// What the three are called in the legend.
    pub labels: [&'a str; 3],
}

/// Width of the picture.
const WIDTH: f64 = 640.0;
/// Room at the edges.
const MARGIN: f64 = 34.0;
/// Room for the title.
const HEAD: f64 = 26.0;
/// Room for the legend.
const FOOT: f64 = 30.0;

/// The graph as a complete SVG document, 640 units wide; the same network gives the same bytes.
///
/// Nodes stand as far apart as their paths are long and the two sets aside; links inside a set have its colour, others are
/// grey. In a directed graph an arrow points to the node that hears. Shapes say the same as colours.
//= paper def:robustness
#[must_use]
pub fn network(network: &Network<'_>) -> String {
    let points = positions(network.graph, network.first, network.second);
    let (points, height) = placed(&points);
    let mut svg = Svg::new(WIDTH, height, &format!("Graph: {}", network.title));
    let title = shorten(network.title, TITLE, WIDTH - 20.0);
    svg.add(label([0.5 * WIDTH, 18.0], TITLE).label(&[Piece::Plain(&title)]));
    let radius = radius(&points);
    for kind in [Kind::Other, Kind::First, Kind::Second] {
        draw_links(&mut svg, network, &points, radius, kind);
    }
    for (node, point) in points.iter().enumerate() {
        let name = network.names.get(node).map_or("", String::as_str);
        network.mark(node).draw(&mut svg, *point, radius, name);
    }
    draw_legend(&mut svg, network, height - 0.5 * FOOT);
    svg.finish()
}

impl Network<'_> {
    fn mark(&self, node: usize) -> Mark {
        let kind = match (self.first.contains(node), self.second.contains(node)) {
            (true, _) => Kind::First,
            (false, true) => Kind::Second,
            (false, false) => Kind::Other,
        };
        Mark { kind, exempt: self.exempt.contains(node) }
    }

    /// A link inside a set belongs to it.
    fn kind(&self, from: usize, to: usize) -> Kind {
        let (a, b) = (self.mark(from).kind, self.mark(to).kind);
        if a == b { a } else { Kind::Other }
    }
}

/// Positions on the page and its height: the longer side fills it.
fn placed(points: &[[f64; 2]]) -> (Vec<[f64; 2]>, f64) {
    let ends = |axis: usize| {
        let all = || points.iter().map(|point| point[axis]);
        [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
    };
    let [[left, right], [low, high]] = [ends(0), ends(1)];
    let room = WIDTH - 2.0 * MARGIN;
    let tallest = 0.85 * room;
    let scale = (room / (right - left).max(1e-9)).min(tallest / (high - low).max(1e-9)).min(170.0);
    let tall = scale * (high - low);
    let middle = 0.5 * (left + right);
    let place = |[x, y]: &[f64; 2]| [0.5 * WIDTH + scale * (x - middle), HEAD + MARGIN + scale * (high - y)];
    (points.iter().map(place).collect(), HEAD + 2.0 * MARGIN + tall + FOOT)
}

/// As large as the nearest nodes allow.
fn radius(points: &[[f64; 2]]) -> f64 {
    let mut nearest = f64::INFINITY;
    for (index, a) in points.iter().enumerate() {
        for b in &points[..index] {
            let offset = [a[0] - b[0], a[1] - b[1]];
            nearest = nearest.min(libm::sqrt(offset[0] * offset[0] + offset[1] * offset[1]));
        }
    }
    (0.36 * nearest).max(4.5).min(13.0)
}

/// All links of a kind in one path, arrow heads in another.
fn draw_links(svg: &mut Svg, network: &Network<'_>, points: &[[f64; 2]], radius: f64, kind: Kind) {
    let (mut lines, mut heads) = (PathData::default(), PathData::default());
    for (from, to) in network.graph.edges().filter(|(from, to)| network.kind(*from, *to) == kind) {
        lines.start(points[from]);
        lines.continue_to(points[to]);
        if network.graph.is_directed() {
            head(&mut heads, points[from], points[to], radius);
        }
    }
    if !lines.is_empty() {
        let line = lines.element().text("fill", "none").text("stroke", kind.link());
        svg.add(line.number("stroke-width", if network.graph.edge_count() > 400 { 0.5 } else { 1.0 }));
    }
    if !heads.is_empty() {
        svg.add(heads.element().text("fill", kind.link()));
    }
}

/// A triangle that touches the marker at `to`.
fn head(path: &mut PathData, from: [f64; 2], to: [f64; 2], radius: f64) {
    let offset = [to[0] - from[0], to[1] - from[1]];
    let length = libm::sqrt(offset[0] * offset[0] + offset[1] * offset[1]).max(1e-6);
    let [along, across] = [offset.map(|part| part / length), [-offset[1] / length, offset[0] / length]];
    let at = |back: f64, aside: f64| {
        [0, 1].map(|axis| to[axis] - (radius * 1.15 + back) * along[axis] + aside * across[axis])
    };
    path.start(at(0.0, 0.0));
    path.continue_to(at(0.6 * radius + 2.0, 0.3 * radius + 1.0));
    path.continue_to(at(0.6 * radius + 2.0, -0.3 * radius - 1.0));
}

/// Samples of what is there.
fn draw_legend(svg: &mut Svg, network: &Network<'_>, y: f64) {
    let other = network.graph.nodes().difference(network.first.union(network.second));
    let exempt = network.exempt.iter().next();
    let entries = [
        (!network.first.is_empty(), Mark { kind: Kind::First, exempt: false }, network.labels[0]),
        (!network.second.is_empty(), Mark { kind: Kind::Second, exempt: false }, network.labels[1]),
        (exempt.is_some(), exempt.map_or(Mark::OTHER, |node| network.mark(node)), network.labels[2]),
        (!other.is_empty() && other.len() < network.graph.node_count(), Mark::OTHER, "other robots"),
    ];
    let entries: Vec<_> = entries.into_iter().filter(|(shown, ..)| *shown).collect();
    let wide = |text: &str| 16.0 + width(text, LABEL) + 22.0;
    let mut left = 0.5 * (WIDTH + 22.0 - entries.iter().map(|(_, _, text)| wide(text)).sum::<f64>());
    for (_, mark, text) in &entries {
        mark.draw(svg, [left + 6.0, y], 5.5, "");
        let element = Element::new("text").point(["x", "y"], [left + 16.0, y + 0.36 * LABEL]);
        svg.add(element.number("font-size", LABEL).text("fill", INK).label(&[Piece::Plain(text)]));
        left += wide(text);
    }
}

fn label(at: [f64; 2], size: f64) -> Element {
    let text = Element::new("text").point(["x", "y"], at).number("font-size", size);
    text.text("text-anchor", "middle").text("fill", INK)
}
