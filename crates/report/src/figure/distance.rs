//! A panel with the least distance of two robots over time.

use closeranks_core::num::{dot, subtract};
use closeranks_sim::output::record::Record;

use crate::figure::Case;
use crate::figure::formation::links::position;
use crate::figure::panel::axes::{Axes, Place};
use crate::figure::panel::ticks::{Range, drawable};
use crate::figure::trace::thin;
use crate::svg::palette::{INK, MALICIOUS, SHADE};
use crate::svg::path::PathData;
use crate::svg::{Element, Svg};

/// Width of the columns in which the line keeps its extremes.
const COLUMN: f64 = 0.75;

/// The least distance of two robots at each tick, m; not a number where there are no two.
#[must_use]
pub(crate) fn least(record: &Record) -> Vec<f64> {
    (0..=record.last_tick()).map(|tick| least_at(record, tick)).collect()
}

/// Robots in the order of x: only those are compared whose x alone is nearer than the nearest pair so far.
pub(crate) fn least_at(record: &Record, tick: usize) -> f64 {
    let positions = (0..usize::from(record.robots)).map(|index| position(record, tick, index));
    let mut positions: Vec<_> = positions.filter(|position| position.iter().all(|x| drawable(*x))).collect();
    positions.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut least_m2 = f64::INFINITY;
    for (index, here) in positions.iter().enumerate() {
        for there in &positions[index + 1..] {
            let offset_m = subtract(here, there);
            if offset_m[0] * offset_m[0] > least_m2 {
                break;
            }
            least_m2 = least_m2.min(dot(&offset_m, &offset_m));
        }
    }
    if least_m2.is_finite() { least_m2.sqrt() } else { f64::NAN }
}

/// From 0 to above all that is shown, m.
#[must_use]
pub(crate) fn range(cases: &[Case<'_>], lines: &[Vec<f64>]) -> Range {
    let demanded = cases.iter().map(|case| case.scenario.limits.distance_min_m);
    let all = Range::of(lines.iter().flatten().copied().chain(demanded).chain([0.0]));
    Range { min: 0.0, max: all.max + 0.06 * all.width() }
}

/// Draws the shaded region below the distance that is demanded, its limit, and the line.
pub(crate) fn draw(svg: &mut Svg, axes: &Axes, case: &Case<'_>, line: &[f64]) {
    let demanded_m = case.scenario.limits.distance_min_m;
    let [left, top] = axes.at_cut([axes.x.min, demanded_m]);
    let place = Place { left, top, height: axes.place.bottom() - top, ..axes.place };
    svg.add(place.element().text("fill", SHADE));
    let mut limit = PathData::default();
    limit.start([left, top]);
    limit.continue_to([left + axes.place.width, top]);
    svg.add(limit_style(limit.element()));
    let points: Vec<[f64; 2]> = line
        .iter()
        .enumerate()
        .map(|(tick, distance_m)| axes.at_cut([case.record.time_s(tick), *distance_m]))
        .collect();
    let mut path = PathData::default();
    for part in points.split(|point| !point[0].is_finite()) {
        for (place, point) in thin(part, COLUMN).into_iter().enumerate() {
            if place == 0 { path.start(point) } else { path.continue_to(point) }
        }
    }
    if !path.is_empty() {
        svg.add(least_style(path.element()));
    }
}

/// The line of the least distance.
pub(crate) fn least_style(line: Element) -> Element {
    line.text("fill", "none").text("stroke", INK).number("stroke-width", 1.2)
}

/// The line of the distance that is demanded.
pub(crate) fn limit_style(line: Element) -> Element {
    line.text("stroke", MALICIOUS).number("stroke-width", 1.2).text("stroke-dasharray", "4 2")
}

#[cfg(test)]
mod tests {
    use super::*;
    use closeranks_sim::scenario::Limits;
    use closeranks_sim::scenario::Scenario;
    use closeranks_sim::world::{Options, run};

    #[test]
    fn the_least_distance_is_that_of_the_summary() {
        for dimension in [2, 3] {
            let scenario = Scenario {
                duration_s: 0.5,
                dimension,
                start: closeranks_sim::scenario::start::Start::Random {
                    half_side_m: 0.9,
                    distance_min_m: 0.4,
                },
                limits: Limits {
                    input_min_m_s: vec![-1.5; dimension],
                    input_max_m_s: vec![1.5; dimension],
                    ..Limits::default()
                },
                ..Scenario::default()
            };
            let done = run(&scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap();
            let least = least(&done.record.unwrap()).into_iter().fold(f64::INFINITY, f64::min);
            assert!((least - done.summary.extremes.distance_min_m).abs() < 1e-12);
        }
    }
}
