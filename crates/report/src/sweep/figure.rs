//! The two figures of a sweep: how often laws were violated, and how far teams spread.

use super::confidence::{lower_95, upper_95};
use super::spread::Spread;
use super::style::{legend, names, style};
use super::tally::{Share, Tally, promises};
use crate::figure::panel::axes::{Axes, Decoration, Place};
use crate::figure::panel::layout::{Grid, Row};
use crate::figure::panel::ticks::Range;
use crate::svg::palette::{FRAME, INK, LABEL, LINK, NUMBER};
use crate::svg::path::PathData;
use crate::svg::text;
use crate::svg::{Element, Piece, Svg};

/// Width of the panel.
const WIDTH: f64 = 560.0;
/// Height of a line of the upper figure: one law under one controller.
const LINE: f64 = 17.0;
/// Space between two laws.
const BETWEEN: f64 = 11.0;
/// Room above and below the panel.
const TOP: f64 = 14.0;
const BELOW: f64 = 70.0;
/// Part of the panel that shows 0, left of the decades.
const ZERO: f64 = 60.0;
/// Room for the words to the right.
const RIGHT: f64 = 110.0;

/// Share of runs in which each of `laws` was violated, under each controller, with the bounds of 95 % on either side; a
/// hollow marker is a law that was never violated. The shares go by powers of ten. Returns a complete SVG document.
#[must_use]
pub fn shares(tally: &Tally, laws: &[&str]) -> String {
    let left = 24.0 + laws.iter().map(|law| text::width(law, LABEL)).fold(30.0, f64::max);
    let group = LINE * count(tally.controllers.len()) + BETWEEN;
    let place = Place { left, top: TOP, width: WIDTH, height: group * count(laws.len()).max(1.0) };
    let width = left + WIDTH + RIGHT;
    let mut svg = Svg::new(width, TOP + place.height + BELOW, "Share of runs in which each law was violated");
    let scale = Decades::new(tally, place);
    scale.draw_grid(&mut svg);
    for (index, law) in laws.iter().enumerate() {
        let top = place.top + group * count(index);
        svg.add(label([left - 8.0, top + 0.5 * group + 0.36 * LABEL], "end", LABEL, law));
        if index > 0 {
            svg.add(line([left, top], [left + WIDTH, top]).text("stroke", LINK).number("stroke-width", 0.5));
        }
        for (place, (name, share)) in tally.controllers.iter().enumerate() {
            let y = top + 0.5 * BETWEEN + LINE * (count(place) + 0.5);
            if !promises(name, law) {
                continue;
            }
            draw_share(&mut svg, &scale, y, name, [share.laws.get(*law).copied().unwrap_or(0), share.runs]);
        }
    }
    scale.draw_frame(&mut svg);
    let runs = tally.controllers.iter().map(|(name, share)| (name.clone(), share.runs));
    legend(&mut svg, &names(runs), false, [place.middle(), place.bottom() + BELOW - 14.0]);
    svg.finish()
}

/// A marker, its interval and its words.
fn draw_share(svg: &mut Svg, scale: &Decades, y: f64, name: &str, [violating, runs]: [u64; 2]) {
    let style = style(name);
    let share = count64(violating) / count64(runs.max(1));
    let [low, high] = [lower_95(violating, runs), upper_95(violating, runs)].map(|share| scale.at(share));
    let mut path = PathData::default();
    path.start([low, y]);
    path.continue_to([high, y]);
    for end in [low, high] {
        path.start([end, y - 3.5]);
        path.continue_to([end, y + 3.5]);
    }
    svg.add(style.bar(&path));
    svg.add(style.marker([scale.at(share), y], violating == 0));
    let words = format!("{violating} of {runs}");
    svg.add(label([scale.place.left + scale.place.width + 8.0, y + 0.36 * NUMBER], "start", NUMBER, &words));
}

/// A scale of shares by powers of ten, with a place of its own for 0.
struct Decades {
    place: Place,
    /// The least power of ten that is shown; 10⁰ is at the right edge.
    least: i32,
}

impl Decades {
    /// Down to a share of one run.
    fn new(tally: &Tally, place: Place) -> Self {
        let runs = tally.controllers.values().map(|share| share.runs).max().unwrap_or(1).max(10);
        Self { place, least: -i32::try_from(runs.ilog10()).unwrap_or(1) - 1 }
    }

    fn decade(&self) -> f64 {
        (self.place.width - ZERO) / f64::from(-self.least)
    }

    fn at(&self, share: f64) -> f64 {
        if share <= 0.0 {
            return self.place.left + 0.5 * ZERO;
        }
        let right = self.place.left + self.place.width;
        (right + libm::log10(share) * self.decade()).max(self.place.left + 0.5 * ZERO)
    }

    fn draw_grid(&self, svg: &mut Svg) {
        let [top, bottom] = [self.place.top, self.place.bottom()];
        svg.add(label([self.at(0.0), bottom + 15.0], "middle", NUMBER, "0"));
        for power in self.least..=0 {
            let x = self.place.left + self.place.width + f64::from(power) * self.decade();
            let line = line([x, top], [x, bottom + 3.5]).text("stroke", LINK).number("stroke-width", 0.6);
            svg.add(if power == self.least { line.text("stroke-dasharray", "3 2") } else { line });
            svg.add(label([x, bottom + 15.0], "middle", NUMBER, &percent(power)));
        }
        let words = "runs that violate the law, with the bounds of 95 % on either side";
        svg.add(label([self.place.middle(), bottom + 33.0], "middle", LABEL, words));
    }

    fn draw_frame(&self, svg: &mut Svg) {
        svg.add(self.place.element().text("fill", "none").text("stroke", FRAME).number("stroke-width", 0.8));
    }
}

/// A power of ten in percent.
fn percent(power: i32) -> String {
    let digits = usize::try_from(-2 - power).unwrap_or(0);
    format!("{:.digits$} %", libm::pow(10.0, f64::from(power + 2)))
}

/// Share of runs whose radius of gyration at the end is at most so large, a line a controller. Returns a complete SVG
/// document.
#[must_use]
pub fn gyrations(tally: &Tally, spread: &Spread) -> String {
    let rows = vec![Row { title_lines: 0, height: 250.0, axis: true, legend: 1 }];
    let grid = Grid { columns: 1, width: WIDTH, gap: 0.0, rows };
    let mut svg = grid.document("Distribution of the radius of gyration at the end of the runs");
    let x = Range::of(spread.range_m());
    let wide = x.padded(0.02 * x.width());
    let x = Range { min: wide.min.max(0.0), ..wide };
    let axes = Axes { place: grid.place(0, 0), x, y: Range { min: 0.0, max: 1.02 } };
    for (name, curve) in spread.curves() {
        svg.add(style(name).line(&stairs(&axes, &curve)));
    }
    axes.draw(&mut svg, &DECORATION);
    let runs = tally.controllers.iter().map(|(name, share): (&String, &Share)| (name.clone(), share.runs));
    legend(&mut svg, &names(runs), true, grid.legend(0));
    svg.finish()
}

const DECORATION: Decoration<'_> = Decoration {
    title: &[],
    x_label: &[Piece::Plain("radius of gyration at the end (m)")],
    y_label: &[Piece::Plain("share of runs at or below")],
    x_numbers: true,
    y_numbers: true,
};

fn stairs(axes: &Axes, curve: &[[f64; 2]]) -> PathData {
    let mut path = PathData::default();
    let corners = core::iter::once([axes.x.min, 0.0]).chain(curve.iter().copied()).chain([[axes.x.max, 1.0]]);
    for point in crate::figure::trace::steps(&corners.map(|point| axes.at(point)).collect::<Vec<_>>()) {
        path.continue_to(point);
    }
    path
}

fn line(from: [f64; 2], to: [f64; 2]) -> Element {
    let mut path = PathData::default();
    path.start(from);
    path.continue_to(to);
    path.element()
}

fn label(at: [f64; 2], anchor: &str, size: f64, words: &str) -> Element {
    let text = Element::new("text").point(["x", "y"], at).number("font-size", size);
    text.text("text-anchor", anchor).text("fill", INK).label(&[Piece::Plain(words)])
}

fn count(number: usize) -> f64 {
    count64(number as u64)
}

fn count64(number: u64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "sweeps are far below 2^53 runs")]
    let number = number as f64;
    number
}
