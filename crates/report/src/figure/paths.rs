//! A panel with the way that each robot went.

use crate::figure::Case;
use crate::figure::formation::Moment;
use crate::figure::formation::marker::{Marker, line_colour};
use crate::figure::formation::view::View;
use crate::figure::panel::axes::Axes;
use crate::svg::path::PathData;
use crate::svg::{Element, Svg};

/// A path has no two points closer than this on the page.
const STEP: f64 = 0.8;

/// Draws all paths, their starts, and the robots where they are at the end.
pub(crate) fn draw(svg: &mut Svg, axes: &Axes, case: Case<'_>, view: View, marker: Marker) {
    Moment::end(case, view).draw_obstacles(svg, axes);
    let record = case.record;
    for index in 0..usize::from(record.robots) {
        let malicious = record.malicious.get(index) == Some(&true);
        let colour = line_colour(case, index);
        let way = (0..=record.last_tick()).map(|tick| axes.at(view.point(record, tick, index)));
        let way = spaced(way);
        let Some(start) = way.first() else { continue };
        svg.add(path_style(path(&way), colour, malicious));
        svg.add(start_mark(*start).text("stroke", colour));
    }
    Moment::end(case, view).draw_only_robots(svg, axes, marker);
    view.draw_note(svg, axes.place, record);
}

/// Points without those that are next to the one before; the last stays. Where a robot was absent there is one point that is none.
fn spaced(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let is_point = |point: &[f64; 2]| point.iter().all(|coordinate| coordinate.is_finite());
    let mut kept: Vec<[f64; 2]> = Vec::new();
    let mut last = None;
    for point in points {
        if !is_point(&point) {
            kept.extend(last.take().filter(|last| kept.last() != Some(last)));
            if kept.last().is_some_and(is_point) {
                kept.push(point);
            }
            continue;
        }
        let is_near = kept.last().is_some_and(|kept| {
            let [dx, dy] = [point[0] - kept[0], point[1] - kept[1]];
            dx * dx + dy * dy < STEP * STEP
        });
        if !is_near {
            kept.push(point);
        }
        last = Some(point);
    }
    kept.extend(last.filter(|last| kept.last() != Some(last)));
    kept.truncate(kept.iter().rposition(is_point).map_or(0, |place| place + 1));
    kept
}

fn path(points: &[[f64; 2]]) -> Element {
    let mut path = PathData::default();
    for point in points {
        path.continue_to(*point);
    }
    path.element()
}

fn path_style(element: Element, colour: &str, malicious: bool) -> Element {
    let element = element.text("fill", "none").text("stroke", colour).number("stroke-width", 1.1);
    if malicious { element.text("stroke-dasharray", "4 2") } else { element.text("stroke-linejoin", "round") }
}

/// Where a robot started; its colour is to be added.
pub(crate) fn start_mark(point: [f64; 2]) -> Element {
    let dot = Element::new("circle").point(["cx", "cy"], point).number("r", 2.4);
    dot.text("fill", "#ffffff").number("stroke-width", 1.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_keeps_its_ends_and_loses_what_nobody_sees() {
        let line = (0..=1_000_u32).map(|step| [f64::from(step) * 0.01, 0.0]);
        let way = spaced(line.chain([[f64::NAN, 1.0]]));
        assert_eq!((way.first(), way.last()), (Some(&[0.0, 0.0]), Some(&[10.0, 0.0])));
        assert!(way.len() < 16, "{}", way.len());
        assert_eq!(spaced([[1.0, 1.0]; 9].into_iter()), [[1.0, 1.0]]);
        let nowhere = [f64::NAN; 2];
        let away = spaced([nowhere, [0.0, 0.0], [9.0, 0.0], nowhere, nowhere, [0.0, 9.0]].into_iter());
        assert_eq!((away.len(), away[0], away[3]), (4, [0.0, 0.0], [0.0, 9.0]));
        assert!(
            away[2][0].is_nan(),
            "a robot that was absent did not go from where it left to where it came"
        );
    }
}
