//! A panel: a frame with two axes, and the way from data to the page.

use crate::figure::panel::ticks::{Range, Tick, drawable, ticks};
use crate::svg::palette::{FRAME, INK, LABEL, NUMBER, TITLE};
use crate::svg::path::PathData;
use crate::svg::text;
use crate::svg::{Element, Piece, Svg};

/// A rectangle on the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Left edge.
    pub(crate) left: f64,
    /// Upper edge.
    pub(crate) top: f64,
    /// Width.
    pub(crate) width: f64,
    /// Height.
    pub(crate) height: f64,
}

/// A rectangle that shows a part of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axes {
    /// Where on the page.
    pub(crate) place: Place,
    /// What is shown from left to right.
    pub(crate) x: Range,
    /// What is shown from bottom to top.
    pub(crate) y: Range,
}

/// What stands around a panel. Labels that are empty are left out.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Decoration<'a> {
    /// Lines above the panel, cut if they are too wide.
    pub(crate) title: &'a [String],
    /// Below.
    pub(crate) x_label: &'a [Piece<'a>],
    /// To the left, turned.
    pub(crate) y_label: &'a [Piece<'a>],
    /// Numbers below.
    pub(crate) x_numbers: bool,
    /// Numbers to the left.
    pub(crate) y_numbers: bool,
}

/// Distance from a panel to the base line of the lowest line of its title.
const TITLE_GAP: f64 = 7.0;
/// Height of a line of a title.
pub(crate) const TITLE_LINE: f64 = 14.0;
/// Distance from a panel to the middle of the label to its left.
pub(crate) const Y_LABEL_GAP: f64 = 36.0;
/// Distance from a panel to the base line of the label below it.
const X_LABEL_GAP: f64 = 31.0;
/// More numbers than this at an axis are clutter.
const MOST_STEPS: f64 = 6.0;
/// Length of a tick.
const TICK: f64 = 3.5;

impl Place {
    /// Lower edge.
    #[must_use]
    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Middle, from left to right.
    #[must_use]
    pub(crate) fn middle(&self) -> f64 {
        self.left + 0.5 * self.width
    }

    /// The rectangle.
    #[must_use]
    pub(crate) fn element(&self) -> Element {
        let rect = Element::new("rect").point(["x", "y"], [self.left, self.top]);
        rect.number("width", self.width).number("height", self.height)
    }
}

impl Axes {
    /// Place of a point of the plane on the page; not finite if it cannot be drawn.
    #[must_use]
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        if !(drawable(x) && drawable(y)) {
            return [f64::NAN; 2];
        }
        let across = (x - self.x.min) / self.x.width();
        let up = (y - self.y.min) / self.y.width();
        [self.place.left + across * self.place.width, self.place.bottom() - up * self.place.height]
    }

    /// Place of `y`, cut to the panel.
    #[must_use]
    pub(crate) fn at_cut(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let cut = if y.is_nan() { y } else { y.clamp(self.y.min, self.y.max) };
        self.at([x, cut])
    }

    /// Draws frame, ticks, numbers, labels and title: after the data, so that lines end under the frame.
    pub(crate) fn draw(&self, svg: &mut Svg, decoration: &Decoration<'_>) {
        let x_ticks = x_ticks(self.x, self.place.width);
        let y_ticks = ticks(self.y, (self.place.height / 32.0).min(MOST_STEPS));
        self.draw_frame(svg, &x_ticks, &y_ticks);
        svg.begin(&Element::group().number("font-size", NUMBER).text("fill", INK));
        for tick in x_ticks.iter().filter(|_| decoration.x_numbers) {
            svg.add(self.x_number(tick));
        }
        for tick in y_ticks.iter().filter(|_| decoration.y_numbers) {
            svg.add(self.y_number(tick));
        }
        svg.end();
        self.draw_labels(svg, decoration);
        self.draw_title(svg, decoration.title);
    }

    fn draw_frame(&self, svg: &mut Svg, x_ticks: &[Tick], y_ticks: &[Tick]) {
        svg.begin(&Element::group().text("fill", "none").text("stroke", FRAME).number("stroke-width", 0.8));
        svg.add(self.place.element());
        let mut path = PathData::default();
        for tick in x_ticks {
            let [x, _] = self.at([tick.value, self.y.min]);
            path.start([x, self.place.bottom()]);
            path.continue_to([x, self.place.bottom() + TICK]);
        }
        for tick in y_ticks {
            let [_, y] = self.at([self.x.min, tick.value]);
            path.start([self.place.left, y]);
            path.continue_to([self.place.left - TICK, y]);
        }
        if !path.is_empty() {
            svg.add(path.element());
        }
        svg.end();
    }

    fn x_number(&self, tick: &Tick) -> Element {
        let [x, _] = self.at([tick.value, self.y.min]);
        let text = Element::new("text").point(["x", "y"], [x, self.place.bottom() + TICK + NUMBER + 1.5]);
        text.text("text-anchor", "middle").label(&[Piece::Plain(&tick.label)])
    }

    fn y_number(&self, tick: &Tick) -> Element {
        let [_, y] = self.at([self.x.min, tick.value]);
        let text = Element::new("text").point(["x", "y"], [self.place.left - TICK - 2.5, y + 0.36 * NUMBER]);
        text.text("text-anchor", "end").label(&[Piece::Plain(&tick.label)])
    }

    fn draw_labels(&self, svg: &mut Svg, decoration: &Decoration<'_>) {
        if !decoration.x_label.is_empty() {
            let at = [self.place.middle(), self.place.bottom() + X_LABEL_GAP];
            svg.add(middle(at, LABEL).label(decoration.x_label));
        }
        if !decoration.y_label.is_empty() {
            let at = [self.place.left - Y_LABEL_GAP, self.place.top + 0.5 * self.place.height];
            let turn = format!("rotate(-90 {} {})", crate::svg::number(at[0]), crate::svg::number(at[1]));
            svg.add(middle(at, LABEL).text("transform", &turn).label(decoration.y_label));
        }
    }

    fn draw_title(&self, svg: &mut Svg, lines: &[String]) {
        let mut base = self.place.top - TITLE_GAP;
        for line in lines.iter().rev() {
            let short = text::shorten(line, TITLE, self.place.width + 8.0);
            svg.add(middle([self.place.middle(), base], TITLE).label(&[Piece::Plain(&short)]));
            base -= TITLE_LINE;
        }
    }
}

/// A centred text.
fn middle(at: [f64; 2], size: f64) -> Element {
    let text = Element::new("text").point(["x", "y"], at).number("font-size", size);
    text.text("text-anchor", "middle").text("fill", INK)
}

/// Ticks with room for their labels side by side below an axis of `length`.
fn x_ticks(range: Range, length: f64) -> Vec<Tick> {
    let tried = [34.0, 48.0, 64.0, 90.0].map(|room| ticks(range, (length / room).min(MOST_STEPS)));
    let fits = |ticks: &Vec<Tick>| {
        let widest = ticks.iter().map(|tick| text::width(&tick.label, NUMBER)).fold(0.0, f64::max);
        let step = ticks.windows(2).map(|pair| pair[1].value - pair[0].value).fold(range.width(), f64::min);
        step / range.width() * length > widest + 14.0
    };
    let last = tried[tried.len() - 1].clone();
    tried.into_iter().find(fits).unwrap_or(last)
}
