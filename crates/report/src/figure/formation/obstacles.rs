//! What stands in the way, below links and robots.

use closeranks_core::num::Vector;
use closeranks_core::obstacle::Obstacle;

use crate::figure::panel::axes::Place;
use crate::svg::palette::OBSTACLE;
use crate::svg::{Element, Svg};

/// Walls without thickness are so wide.
const WALL: f64 = 2.4;

/// Draws obstacles inside `place`, where a point in m lies at `at` and a metre is `scale` long. Nothing is added without any.
pub(crate) fn draw(
    svg: &mut Svg,
    place: Place,
    scale: f64,
    at: impl Fn(&Vector<3>) -> [f64; 2],
    obstacles: &[Obstacle<3>],
) {
    if obstacles.is_empty() {
        return;
    }
    let within = format!("within-{:.0}-{:.0}", place.left, place.top);
    svg.add(Element::new("clipPath").text("id", &within).child(place.element()));
    svg.begin(&Element::group().text("clip-path", &format!("url(#{within})")));
    for Obstacle { from_m, to_m, radius_m, .. } in obstacles {
        let ends = [from_m, to_m].map(&at);
        if ends.iter().flatten().all(|end| end.is_finite()) {
            svg.add(shape(ends, radius_m * scale));
        }
    }
    svg.end();
}

fn shape([from, to]: [[f64; 2]; 2], radius: f64) -> Element {
    if from == to {
        let disc = Element::new("circle").point(["cx", "cy"], from).number("r", radius.max(0.5 * WALL));
        return disc.text("fill", OBSTACLE);
    }
    let line = Element::new("line").point(["x1", "y1"], from).point(["x2", "y2"], to);
    let line = line.text("stroke", OBSTACLE).number("stroke-width", (2.0 * radius).max(WALL));
    line.text("stroke-linecap", "round")
}
