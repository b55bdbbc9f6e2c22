//! Lines that say what shapes and lines mean.

use crate::figure::distance::{least_style, limit_style};
use crate::figure::formation::link_style;
use crate::figure::formation::marker::{Kind, Marker, ring, robots_group, shape};
use crate::figure::panel::layout::LEGEND_LINE;
use crate::figure::panel::stroke::{largest_f, largest_r, needed};
use crate::figure::paths::start_mark;
use crate::figure::series::malicious_style;
use crate::svg::palette::{INK, LABEL, LINK, MALICIOUS, NORMAL, SHADE};
use crate::svg::path::PathData;
use crate::svg::text;
use crate::svg::{Element, Piece, Svg};

/// Something a legend explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Entry {
    /// The marker of a robot.
    Robot {
        /// Of which kind.
        malicious: bool,
    },
    /// The marker of a normal robot of one of several teams, from 0.
    Team(usize),
    /// A link.
    Link {
        /// With a malicious robot.
        malicious: bool,
    },
    /// The line of a robot.
    Line {
        /// Of which kind.
        malicious: bool,
    },
    /// Two robots that are closer than they may be.
    TooClose,
    /// Where a robot started.
    Start,
    /// The least distance of all pairs.
    Least,
    /// The distance that is demanded.
    Limit,
    /// The region below zero.
    Below,
    /// The largest r.
    LargestR,
    /// The largest F.
    LargestF,
    /// The F that is needed.
    Needed,
}

/// Of formations.
pub(crate) const FORMATION: [Entry; 4] = [
    Entry::Robot { malicious: false },
    Entry::Robot { malicious: true },
    Entry::Link { malicious: false },
    Entry::Link { malicious: true },
];

/// Of paths, above distances over time.
pub(crate) const PATHS: [Entry; 5] = [
    Entry::Start,
    Entry::Robot { malicious: false },
    Entry::Robot { malicious: true },
    Entry::Least,
    Entry::Limit,
];

/// Of lines over time.
pub(crate) const SERIES: [Entry; 3] =
    [Entry::Line { malicious: false }, Entry::Line { malicious: true }, Entry::Below];

/// Of robustness over time.
pub(crate) const ROBUSTNESS: [Entry; 3] = [Entry::LargestR, Entry::LargestF, Entry::Needed];

/// The sample of a robot.
fn draw_robot(svg: &mut Svg, at: [f64; 2], kind: Kind) {
    svg.begin(&robots_group(kind, Marker { radius: 5.5, numbered: true }));
    svg.add(shape(at, 5.5, kind.malicious));
    svg.end();
}

/// Space between entries.
const GAP: f64 = 22.0;
/// Space between a sample and its text.
const SAMPLE_GAP: f64 = 6.0;

impl Entry {
    fn pieces(self) -> &'static [Piece<'static>] {
        match self {
            Self::Robot { malicious: false } | Self::Line { malicious: false } => {
                &[Piece::Plain("normal robot")]
            }
            Self::Robot { malicious: true } | Self::Line { malicious: true } => {
                &[Piece::Plain("malicious robot")]
            }
            Self::Team(0) => &[Piece::Plain("normal robot of team 1")],
            Self::Team(1) => &[Piece::Plain("of team 2")],
            Self::Team(2) => &[Piece::Plain("of team 3")],
            Self::Team(_) => &[Piece::Plain("of team 4")],
            Self::Link { malicious: false } => &[Piece::Plain("link between normal robots")],
            Self::Link { malicious: true } => &[Piece::Plain("link with a malicious robot")],
            Self::TooClose => &[Piece::Plain("closer than allowed")],
            Self::Start => &[Piece::Plain("start")],
            Self::Least => &[Piece::Plain("least distance of two robots")],
            Self::Limit => &[Piece::Plain("demanded")],
            Self::LargestR => &[Piece::Plain("largest "), Piece::Italic("r"), Piece::Plain(": r-robust")],
            Self::LargestF => {
                &[Piece::Plain("largest "), Piece::Italic("F"), Piece::Plain(": (F+1, F+1)-robust")]
            }
            Self::Needed => &[Piece::Italic("F"), Piece::Plain(" of the team")],
            Self::Below => &[Piece::Italic("h"), Piece::Subscript("i"), Piece::Plain(" < 0")],
        }
    }

    fn sample_width(self) -> f64 {
        match self {
            Self::Start => 8.0,
            Self::Robot { .. } | Self::Team(_) | Self::TooClose => 14.0,
            _ => 26.0,
        }
    }

    fn text_width(self) -> f64 {
        let text = |piece: &Piece<'_>| match piece {
            Piece::Plain(text) | Piece::Italic(text) | Piece::Subscript(text) => text::width(text, LABEL),
        };
        self.pieces().iter().map(text).sum()
    }

    fn width(self) -> f64 {
        self.sample_width() + SAMPLE_GAP + self.text_width()
    }

    fn draw_sample(self, svg: &mut Svg, left: f64, y: f64) {
        let right = left + self.sample_width();
        match self {
            Self::Robot { malicious } => {
                draw_robot(svg, [0.5 * (left + right), y], Kind { malicious, team: None });
            }
            Self::Team(team) => {
                draw_robot(svg, [0.5 * (left + right), y], Kind { malicious: false, team: Some(team) });
            }
            Self::Link { malicious } => {
                let colour = if malicious { MALICIOUS } else { LINK };
                svg.add(link_style(line(left, right, y), colour, true));
            }
            Self::Line { malicious: true } => svg.add(malicious_style(line(left, right, y), 1.3)),
            Self::Line { malicious: false } => {
                svg.add(line(left, right, y).text("stroke", NORMAL).number("stroke-width", 1.3));
            }
            Self::TooClose => svg.add(ring([0.5 * (left + right), y], 3.0)),
            Self::Start => svg.add(start_mark([0.5 * (left + right), y]).text("stroke", NORMAL)),
            Self::Least => svg.add(least_style(line(left, right, y))),
            Self::Limit => svg.add(limit_style(line(left, right, y))),
            Self::LargestR => svg.add(largest_r(line(left, right, y))),
            Self::LargestF => svg.add(largest_f(line(left, right, y))),
            Self::Needed => svg.add(needed(line(left, right, y))),
            Self::Below => {
                let place = crate::figure::panel::axes::Place {
                    left,
                    top: y - 5.0,
                    width: right - left,
                    height: 10.0,
                };
                svg.add(place.element().text("fill", SHADE));
            }
        }
    }
}

fn line(left: f64, right: f64, y: f64) -> Element {
    let mut path = PathData::default();
    path.start([left, y]);
    path.continue_to([right, y]);
    path.element()
}

/// Entries in lines that are at most `room` wide.
#[must_use]
pub(crate) fn folded(entries: &[Entry], room: f64) -> Vec<&[Entry]> {
    let mut lines = Vec::new();
    let mut rest = entries;
    while !rest.is_empty() {
        let fits = (1..=rest.len()).rev().find(|count| width(&rest[..*count]) <= room).unwrap_or(1);
        let (line, more) = rest.split_at(fits);
        lines.push(line);
        rest = more;
    }
    lines
}

/// Width of entries side by side.
fn width(entries: &[Entry]) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a handful of entries")]
    let gaps = GAP * entries.len().saturating_sub(1) as f64;
    entries.iter().map(|entry| entry.width()).sum::<f64>() + gaps
}

/// Draws lines of entries around `middle`, the first at height `y`.
pub(crate) fn draw(svg: &mut Svg, lines: &[&[Entry]], [middle, mut y]: [f64; 2]) {
    for entries in lines {
        draw_line(svg, entries, [middle, y]);
        y += LEGEND_LINE;
    }
}

fn draw_line(svg: &mut Svg, entries: &[Entry], [middle, y]: [f64; 2]) {
    let mut left = middle - 0.5 * width(entries);
    for entry in entries {
        entry.draw_sample(svg, left, y);
        let at = [left + entry.sample_width() + SAMPLE_GAP, y + 0.36 * LABEL];
        let text = Element::new("text").point(["x", "y"], at).number("font-size", LABEL).text("fill", INK);
        svg.add(text.label(entry.pieces()));
        left += entry.width() + GAP;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The legend of a single panel used to be wider than the figure, and its last words were cut off.
    #[test]
    fn a_legend_that_is_too_wide_has_more_lines() {
        for room in [10.0, 300.0, 420.0, 2_000.0] {
            let lines = folded(&ROBUSTNESS, room);
            assert_eq!(lines.concat(), ROBUSTNESS);
            assert!(lines.iter().all(|line| line.len() == 1 || width(line) <= room));
        }
        assert_eq!(folded(&ROBUSTNESS, 2_000.0).len(), 1);
        assert_eq!(folded(&ROBUSTNESS, 420.0).len(), 2);
        assert!(folded(&[], 10.0).is_empty());
    }
}
