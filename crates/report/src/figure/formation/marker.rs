//! Markers of robots: colour and shape say the same.

use crate::figure::Case;
use crate::svg::palette::{CLOSE, MALICIOUS, NORMAL, NORMAL_LINES, TEAMS};
use crate::svg::{Element, Piece, Svg};

/// How robots are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Marker {
    /// Radius of the circle; squares have the same area.
    pub(crate) radius: f64,
    /// With the robot's number.
    pub(crate) numbered: bool,
}

impl Marker {
    /// Draws robot `number`.
    pub(super) fn draw(self, svg: &mut Svg, point: [f64; 2], malicious: bool, number: usize) {
        svg.add(shape(point, self.radius, malicious));
        if self.numbered {
            svg.add(robot_number(point, self.radius, number));
        }
    }
}

/// What robots of a kind look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Kind {
    /// Whether they are malicious.
    pub(crate) malicious: bool,
    /// Which of several teams they are of, from 0, if there are several.
    pub(crate) team: Option<usize>,
}

impl Kind {
    /// That of robot `index` of a run.
    pub(crate) fn of(case: Case<'_>, index: usize) -> Self {
        let team = (!case.scenario.teams.is_empty()).then(|| case.scenario.team_of(index));
        Self { malicious: case.record.malicious.get(index) == Some(&true), team }
    }

    /// The colour of its team.
    pub(crate) fn team_colour(self) -> &'static str {
        self.team.map_or(NORMAL, |team| TEAMS[team % TEAMS.len()])
    }

    /// Around a marker: white, or around a malicious robot the colour of its team.
    fn edge_colour(self) -> &'static str {
        if self.malicious && self.team.is_some() { self.team_colour() } else { "#ffffff" }
    }
}

/// The colour of the line of robot `index`: of normal robots blues in turn, or where there are several teams that of its team.
pub(crate) fn line_colour(case: Case<'_>, index: usize) -> &'static str {
    let kind = Kind::of(case, index);
    if kind.malicious {
        return MALICIOUS;
    }
    let before = case.record.malicious.iter().take(index).filter(|malicious| !**malicious).count();
    if kind.team.is_some() { kind.team_colour() } else { NORMAL_LINES[before % NORMAL_LINES.len()] }
}

/// What all robots of a kind share.
pub(crate) fn robots_group(kind: Kind, marker: Marker) -> Element {
    let colour = if kind.malicious { MALICIOUS } else { kind.team_colour() };
    let edge = if marker.numbered { 0.9 } else { 0.4 };
    let edge = if kind.edge_colour() == "#ffffff" { edge } else { 2.0 * edge };
    let group = Element::group().text("fill", colour).text("stroke", kind.edge_colour());
    let group = group.number("stroke-width", edge);
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
