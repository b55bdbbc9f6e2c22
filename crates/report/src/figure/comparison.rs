//! Controllers side by side in small panels: one panel a number, one bar a controller.

use closeranks_sim::law::Law;

use crate::figure::panel::axes::Place;
use crate::svg::palette::{FRAME, INK, LABEL, LINK, MALICIOUS, NORMAL, NUMBER};
use crate::svg::path::PathData;
use crate::svg::{Element, Piece, Svg, text};
use crate::table::{Line, number};

/// Width of a panel.
const WIDTH: f64 = 118.0;
/// Space between two panels, in which the numbers of the left one stand.
const GAP: f64 = 50.0;
/// Height of a controller.
const LINE: f64 = 17.0;
/// Room above for the head of a panel.
const TOP: f64 = 40.0;
const BELOW: f64 = 12.0;
/// Panels in a row.
const COLUMNS: usize = 4;

/// A number of a run, with two lines of head and its digits.
struct Measure {
    head: [&'static str; 2],
    digits: usize,
    of: fn(&Line<'_>) -> f64,
    /// What it must not be less than.
    demanded: fn(&Line<'_>) -> Option<f64>,
}

const MEASURES: [Measure; 8] = [
    Measure {
        head: ["neighbours of a", "normal robot, least"],
        digits: 0,
        of: |line| line.summary.extremes.degree_min.map_or(f64::NAN, f64::from),
        demanded: |line| Some(f64::from(line.scenario.composition().required)),
    },
    Measure {
        head: ["distance of two", "robots, least, m"],
        digits: 3,
        of: |line| line.summary.extremes.distance_min_m,
        demanded: |line| Some(line.scenario.limits.distance_min_m),
    },
    Measure {
        head: ["radius of gyration", "at the end, m"],
        digits: 2,
        of: |line| line.summary.gyration_m,
        demanded: |_| None,
    },
    Measure {
        head: ["progress along", "the wish, m"],
        digits: 2,
        of: |line| line.summary.conduct.progress_m,
        demanded: |_| None,
    },
    Measure {
        head: ["deviation from", "the wish, m/s"],
        digits: 2,
        of: |line| line.summary.conduct.deviation_m_s,
        demanded: |_| None,
    },
    Measure {
        head: ["time blocked,", "s"],
        digits: 2,
        of: |line| line.summary.conduct.blocked_s,
        demanded: |_| None,
    },
    Measure {
        head: ["jerk,", "m/s^3"],
        digits: 0,
        of: |line| line.summary.conduct.jerk_m_s3,
        demanded: |_| None,
    },
    Measure {
        head: ["programs without", "a solution"],
        digits: 0,
        of: |line| {
            #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
            let count = line.summary.broken(Law::Feasible) as f64;
            count
        },
        demanded: |_| None,
    },
];

/// One panel for each number, one bar for each run, named by its controller; a dashed line is what is demanded, and a bar that does not
/// reach it is orange. Returns a complete SVG document; the same runs give the same bytes.
#[must_use]
pub fn comparison(lines: &[Line<'_>]) -> String {
    let names = lines.iter().map(|line| text::width(line.scenario.controller.name(), LABEL));
    let left = 20.0 + names.fold(30.0, f64::max);
    let height = LINE * count(lines.len());
    let rows = MEASURES.len().div_ceil(COLUMNS);
    let width = left + count(COLUMNS) * (WIDTH + GAP);
    let mut svg = Svg::new(width, count(rows) * (TOP + height + BELOW), "Controllers side by side");
    for (index, measure) in MEASURES.iter().enumerate() {
        let (column, row) = (index % COLUMNS, index / COLUMNS);
        let top = count(row) * (TOP + height + BELOW) + TOP;
        let place = Place { left: left + count(column) * (WIDTH + GAP), top, width: WIDTH, height };
        if column == 0 {
            for (line, y) in lines.iter().zip(middles(place)) {
                svg.add(label([left - 8.0, y], "end", LABEL, line.scenario.controller.name()));
            }
        }
        draw(&mut svg, measure, lines, place);
    }
    svg.finish()
}

/// Heights at which the words of each line stand.
fn middles(place: Place) -> impl Iterator<Item = f64> {
    (0..).map(move |index| place.top + LINE * (count(index) + 0.5) + 0.36 * NUMBER)
}

fn draw(svg: &mut Svg, measure: &Measure, lines: &[Line<'_>], place: Place) {
    for (words, y) in measure.head.into_iter().zip([place.top - 20.0, place.top - 7.0]) {
        svg.add(label([place.left, y], "start", NUMBER, words));
    }
    let demanded = lines.iter().filter_map(measure.demanded).fold(0.0, f64::max);
    let numbers: Vec<f64> = lines.iter().map(measure.of).collect();
    let most = numbers.iter().copied().filter(|x| x.is_finite()).fold(demanded, f64::max).max(1e-9);
    let scale = place.width / most;
    for ((line, number_of), y) in lines.iter().zip(&numbers).zip(middles(place)) {
        let missed = (measure.demanded)(line).is_some_and(|demanded| *number_of < demanded);
        let length = if number_of.is_finite() { number_of.max(0.0) * scale } else { 0.0 };
        let bar = Place { left: place.left, top: y - 0.36 * NUMBER - 5.0, width: length, height: 10.0 };
        svg.add(bar.element().text("fill", if missed { MALICIOUS } else { NORMAL }));
        svg.add(label([place.left + length + 4.0, y], "start", NUMBER, &number(*number_of, measure.digits)));
    }
    svg.add(upright(place.left, place).text("stroke", FRAME).number("stroke-width", 0.8));
    if demanded > 0.0 {
        let at = upright(place.left + demanded * scale, place).text("stroke-dasharray", "3 2");
        svg.add(at.text("stroke", LINK).number("stroke-width", 1.0));
    }
}

fn upright(x: f64, place: Place) -> Element {
    let mut path = PathData::default();
    path.start([x, place.top]);
    path.continue_to([x, place.bottom()]);
    path.element()
}

fn label(at: [f64; 2], anchor: &str, size: f64, words: &str) -> Element {
    let text = Element::new("text").point(["x", "y"], at).number("font-size", size);
    text.text("text-anchor", anchor).text("fill", INK).label(&[Piece::Plain(words)])
}

fn count(number: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a handful of panels and controllers")]
    let number = number as f64;
    number
}
