//! A panel with a column of the record over time, a line a robot.

mod inset;
mod line_numbers;

use closeranks_sim::output::record::Record;

use self::line_numbers::End;
use crate::figure::Case;
use crate::figure::formation::marker::line_colour;
use crate::figure::panel::axes::Axes;
use crate::figure::panel::ticks::{Range, drawable};
use crate::figure::trace::{steps, thin};
use crate::svg::palette::{INK, MALICIOUS, SHADE};
use crate::svg::path::PathData;
use crate::svg::{Element, Piece, Svg};

/// Width of the columns in which lines keep their extremes.
const COLUMN: f64 = 0.75;

/// More robots than this have thinner lines.
const CROWD: u16 = 40;

/// More robots than this have no numbers beside their lines: three digits have no room there.
const NUMBERED: u16 = 99;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// h_i (eq:h_i), dimensionless: must stay at or above 0.
    Barrier,
    /// y_i, or a further number of it, counted from 0: held between rounds, so drawn in steps.
    Value(usize),
}

/// The label of each number of a value of several.
const NUMBERS: [&[Piece<'static>]; 3] = [
    &[Piece::Plain("first number of "), Piece::Italic("y"), Piece::Subscript("i")],
    &[Piece::Plain("second number of "), Piece::Italic("y"), Piece::Subscript("i")],
    &[Piece::Plain("third number of "), Piece::Italic("y"), Piece::Subscript("i")],
];

impl Quantity {
    /// Every number of the values of `cases`.
    pub(crate) fn values(cases: &[Case<'_>]) -> impl Iterator<Item = Self> + use<> {
        let more = cases.iter().map(|case| case.record.more_values_told.len()).max().unwrap_or(0);
        (0..=more).map(Self::Value)
    }

    /// Its name beside an axis, where values of `cases` are shown.
    #[must_use]
    pub(crate) fn label(self, cases: &[Case<'_>]) -> &'static [Piece<'static>] {
        match self {
            Self::Barrier => &[Piece::Plain("barrier "), Piece::Italic("h"), Piece::Subscript("i")],
            Self::Value(place) if Self::values(cases).nth(1).is_some() => {
                NUMBERS.get(place).copied().unwrap_or_default()
            }
            Self::Value(_) => &[Piece::Plain("value "), Piece::Italic("y"), Piece::Subscript("i")],
        }
    }

    /// The numbers of all robots tick by tick; none if the record has no such quantity.
    fn column(self, record: &Record) -> &[f64] {
        match self {
            Self::Barrier => &record.h,
            Self::Value(0) => &record.value_told,
            Self::Value(place) => record.more_values_told.get(place - 1).map_or(&[], Vec::as_slice),
        }
    }

    /// As [`Self::column`], but what robots hold instead of what they tell.
    fn held(self, record: &Record) -> &[f64] {
        match self {
            Self::Barrier => &[],
            Self::Value(0) => &record.value,
            Self::Value(place) => record.more_values.get(place - 1).map_or(&[], Vec::as_slice),
        }
    }

    fn is_value(self) -> bool {
        self != Self::Barrier
    }

    /// What has to be shown of all `cases`.
    ///
    /// Values of malicious robots may be anything: they widen the range at most to thrice that of the normal ones.
    #[must_use]
    pub(crate) fn range(self, cases: &[Case<'_>]) -> Range {
        let of = |malicious| Range::of(cases.iter().flat_map(|case| self.numbers(case.record, malicious)));
        let normal = of(Some(false));
        let all = match self {
            Self::Barrier => of(None).with(Range { min: -0.5, max: 0.5 }),
            Self::Value(_) => normal.with(of(Some(true)).within(normal.padded(normal.width()))),
        };
        all.padded(0.05 * all.width())
    }

    /// All numbers of robots of a kind, or of all.
    fn numbers(self, record: &Record, malicious: Option<bool>) -> impl Iterator<Item = f64> {
        let kinds = record.malicious.iter().cycle();
        let pairs = self.column(record).iter().zip(kinds);
        pairs.filter(move |(_, kind)| malicious.is_none_or(|one| one == **kind)).map(|(number, _)| *number)
    }

    /// Draws the panel of one case: malicious values behind, malicious barriers in front.
    pub(crate) fn draw(self, svg: &mut Svg, axes: &Axes, case: Case<'_>) {
        let record = case.record;
        if self == Self::Barrier {
            draw_shade(svg, axes);
        }
        let order = [self.is_value(), !self.is_value()];
        for malicious in order {
            svg.begin(&self.lines_group(malicious, record.robots));
            for (index, _) in record.malicious.iter().enumerate().filter(|(_, kind)| **kind == malicious) {
                self.draw_line(svg, axes, case, index);
            }
            svg.end();
        }
        match self {
            Self::Barrier => draw_zero(svg, axes),
            Self::Value(_) => self.draw_inset(svg, axes, case),
        }
    }

    /// Numbers of robots beside the panel, so that each line can be told. Values agree: they need none.
    pub(crate) fn draw_numbers(self, svg: &mut Svg, axes: &Axes, case: Case<'_>) {
        let record = case.record;
        if self == Self::Barrier && record.last_tick() > 0 && record.robots <= NUMBERED {
            let last = [record.last_tick()];
            let end = |index: usize| End {
                y: self
                    .points_at(axes, record, index, last.into_iter())
                    .first()
                    .map_or(f64::NAN, |point| point[1]),
                robot: index + 1,
                colour: line_colour(case, index),
                malicious: record.malicious[index],
            };
            line_numbers::draw(svg, axes, (0..record.malicious.len()).map(end).collect());
        }
    }

    /// The time in which normal values come to agree, drawn larger.
    fn draw_inset(self, svg: &mut Svg, axes: &Axes, case: Case<'_>) {
        let record = case.record;
        let Some(inset) = inset::axes(axes, record, self.held(record)) else { return };
        inset::clear(svg, &inset);
        svg.begin(&self.lines_group(false, record.robots));
        for (index, _) in record.malicious.iter().enumerate().filter(|(_, malicious)| !**malicious) {
            self.draw_line(svg, &inset, case, index);
        }
        svg.end();
        inset::frame(svg, &inset);
    }

    /// What all lines of a kind share.
    fn lines_group(self, malicious: bool, robots: u16) -> Element {
        let group = Element::group().text("fill", "none").text("stroke-linejoin", "round");
        match (malicious, self) {
            (false, _) => group.number("stroke-width", if robots > CROWD { 0.4 } else { 0.9 }),
            (true, Self::Barrier) => malicious_style(group, 1.3),
            (true, Self::Value(_)) => malicious_style(group, 0.6).number("stroke-opacity", 0.4),
        }
    }

    fn draw_line(self, svg: &mut Svg, axes: &Axes, case: Case<'_>, index: usize) {
        let points = self.points(axes, case.record, index);
        let mut path = PathData::default();
        for part in points.split(|point| !point[0].is_finite()) {
            let part = if self.is_value() { steps(part) } else { part.to_vec() };
            for (place, point) in thin(&part, COLUMN).into_iter().enumerate() {
                if place == 0 { path.start(point) } else { path.continue_to(point) }
            }
        }
        if !path.is_empty() {
            svg.add(coloured(path.element(), case, index));
        }
        if case.record.last_tick() == 0 {
            draw_dot(svg, case, index, &points);
        }
    }

    /// The line of a robot on the page; not finite where it cannot be drawn.
    fn points(self, axes: &Axes, record: &Record, index: usize) -> Vec<[f64; 2]> {
        let ticks = (0..=record.last_tick()).take_while(|tick| record.time_s(*tick) <= axes.x.max);
        self.points_at(axes, record, index, ticks)
    }

    fn points_at(
        self,
        axes: &Axes,
        record: &Record,
        index: usize,
        ticks: impl Iterator<Item = usize>,
    ) -> Vec<[f64; 2]> {
        let column = self.column(record);
        let number = |tick| column.get(record.row(tick, index)).copied().unwrap_or(f64::NAN);
        ticks.map(|tick| axes.at_cut([record.time_s(tick), finite(number(tick))])).collect()
    }
}

/// What cannot be drawn is a gap.
fn finite(number: f64) -> f64 {
    if drawable(number) { number } else { f64::NAN }
}

/// A run of a single tick has no lines.
fn draw_dot(svg: &mut Svg, case: Case<'_>, index: usize, points: &[[f64; 2]]) {
    for point in points.iter().filter(|point| point[0].is_finite()) {
        let dot = Element::new("circle").point(["cx", "cy"], *point).number("r", 2.0);
        svg.add(coloured(dot, case, index));
    }
}

/// Malicious robots have the colour of their group.
fn coloured(element: Element, case: Case<'_>, index: usize) -> Element {
    match case.record.malicious.get(index) {
        Some(false) => element.text("stroke", line_colour(case, index)),
        _ => element,
    }
}

/// Lines of malicious robots.
pub(crate) fn malicious_style(element: Element, width: f64) -> Element {
    let element = element.text("stroke", MALICIOUS).number("stroke-width", width);
    element.text("stroke-dasharray", "4 2")
}

/// Below zero a robot may have fewer than F′ neighbours.
fn draw_shade(svg: &mut Svg, axes: &Axes) {
    let [_, zero] = axes.at([axes.x.min, 0.0]);
    let place =
        crate::figure::panel::axes::Place { top: zero, height: axes.place.bottom() - zero, ..axes.place };
    svg.add(place.element().text("fill", SHADE));
}

fn draw_zero(svg: &mut Svg, axes: &Axes) {
    let mut path = PathData::default();
    path.start(axes.at([axes.x.min, 0.0]));
    path.continue_to(axes.at([axes.x.max, 0.0]));
    svg.add(path.element().text("stroke", INK).number("stroke-width", 1.6));
}

/// Times of all cases; a run of a single tick has room for one more.
#[must_use]
pub(crate) fn time_range(cases: &[Case<'_>]) -> Range {
    let ends = cases.iter().map(|case| case.record.time_s(case.record.last_tick()));
    let step = cases.iter().map(|case| case.record.tick_s).fold(1e-9, f64::max);
    Range { min: 0.0, max: ends.filter(|end| drawable(*end)).fold(step, f64::max) }
}
