//! A small panel inside that of values: the part in which they come to agree, which else is a corner of a long run.

use closeranks_sim::output::record::Record;

use crate::figure::panel::axes::{Axes, Decoration, Place};
use crate::figure::panel::ticks::Range;
use crate::svg::Svg;

/// Values agree when their spread is below this part of the first.
const AGREED: f64 = 0.02;
/// An inset is drawn if they do so within this part of the run.
const EARLY: f64 = 0.25;

/// The place of the inset and what it shows, if normal `values` agree early; `axes` are those of the whole panel.
#[must_use]
pub(crate) fn axes(whole: &Axes, record: &Record, values: &[f64]) -> Option<Axes> {
    let agreed = agreed(record, values)?;
    let end_s = record.time_s(agreed) * 1.6;
    if agreed == 0 || end_s > EARLY * whole.x.max {
        return None;
    }
    let ticks = (0..=record.last_tick()).take_while(|tick| record.time_s(*tick) <= end_s);
    let shown = Range::of(ticks.flat_map(|tick| normal(record, values, tick)));
    let last = normal(record, values, record.last_tick()).next()?;
    let settled = whole.at_cut([0.0, last])[1];
    let Place { left, top, width, height } = whole.place;
    // Away from the line that goes on to the end.
    let is_low = settled > top + 0.5 * height;
    let top = if is_low { top + 7.0 } else { settled + 7.0 };
    let room = if is_low { settled - top } else { whole.place.bottom() - top };
    let place = Place { left: left + 0.45 * width, top, width: 0.5 * width, height: room - 24.0 };
    let x = Range { min: 0.0, max: end_s };
    (place.height >= 24.0).then(|| Axes { place, x, y: shown.padded(0.06 * shown.width()) })
}

/// The first tick from which normal values stay together.
fn agreed(record: &Record, values: &[f64]) -> Option<usize> {
    let first = spread(record, values, 0);
    let apart = (0..=record.last_tick()).rev().find(|tick| spread(record, values, *tick) > AGREED * first)?;
    (apart < record.last_tick()).then_some(apart + 1)
}

/// Greatest less least normal value.
fn spread(record: &Record, values: &[f64], tick: usize) -> f64 {
    let ends = normal(record, values, tick)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| [least.min(value), most.max(value)]);
    ends[1] - ends[0]
}

fn normal<'a>(record: &'a Record, values: &'a [f64], tick: usize) -> impl Iterator<Item = f64> + 'a {
    let robots = record.malicious.iter().enumerate().filter(|(_, malicious)| !**malicious);
    robots.filter_map(move |(index, _)| values.get(record.row(tick, index)).copied())
}

/// Covers what is behind the inset, its numbers too.
pub(crate) fn clear(svg: &mut Svg, inset: &Axes) {
    let Place { left, top, width, height } = inset.place;
    let ground = Place { left: left - 6.0, top: top - 3.0, width: width + 12.0, height: height + 20.0 };
    svg.add(ground.element().text("fill", "#ffffff"));
}

/// The frame of the inset, with times below.
pub(crate) fn frame(svg: &mut Svg, inset: &Axes) {
    inset.draw(svg, &Decoration { x_numbers: true, ..Decoration::default() });
}
