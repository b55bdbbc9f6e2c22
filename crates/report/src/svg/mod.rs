//! A small builder of SVG documents: every text is escaped, every number is finite and short.
//!
//! The same calls give the same bytes. Lengths are in user units, 1/96 inch at scale 1.

pub mod png;

pub(crate) mod palette;
pub(crate) mod path;
pub(crate) mod text;

use core::fmt::Write as _;

/// Fonts of every figure; the PNG is drawn with the first.
pub(crate) const FONTS: &str = "DejaVu Sans, Verdana, sans-serif";

/// Numbers beyond this never reach a document.
const LARGEST: f64 = 1e6;

/// A document being written.
#[derive(Clone, Debug)]
pub(crate) struct Svg {
    body: String,
    open: usize,
}

impl Svg {
    /// An empty white document of `width` × `height`; `label` is read to those who cannot see it.
    #[must_use]
    pub(crate) fn new(width: f64, height: f64, label: &str) -> Self {
        let mut svg = Self { body: String::new(), open: 0 };
        let view = format!("0 0 {} {}", number(width), number(height));
        let root = Element::new("svg").text("xmlns", "http://www.w3.org/2000/svg");
        let root = root.number("width", width).number("height", height).text("viewBox", &view);
        let root = root.text("font-family", FONTS).text("role", "img").text("aria-label", label);
        svg.begin(&root);
        svg.add(Element::new("rect").number("width", width).number("height", height).text("fill", "#ffffff"));
        svg
    }

    /// Adds an element without children.
    pub(crate) fn add(&mut self, element: Element) {
        self.body.push_str(&element.finish());
        self.body.push('\n');
    }

    /// Opens a group; everything up to [`Svg::end`] is in it.
    pub(crate) fn begin(&mut self, group: &Element) {
        assert!(group.content.is_empty(), "a group has children, not text");
        self.body.push_str(&group.head);
        self.body.push_str(">\n");
        self.open += 1;
    }

    /// Closes the last group.
    pub(crate) fn end(&mut self) {
        assert!(self.open > 1, "the document itself is closed by finish");
        self.body.push_str("</g>\n");
        self.open -= 1;
    }

    /// The whole document.
    #[must_use]
    pub(crate) fn finish(mut self) -> String {
        assert_eq!(self.open, 1, "every group is closed");
        self.body.push_str("</svg>\n");
        self.body
    }
}

/// A piece of a label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Piece<'a> {
    /// Upright.
    Plain(&'a str),
    /// Italic, for symbols.
    Italic(&'a str),
    /// Small and low.
    Subscript(&'a str),
}

/// An element being written.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    name: &'static str,
    head: String,
    content: String,
}

impl Element {
    /// An element without attributes.
    #[must_use]
    pub(crate) fn new(name: &'static str) -> Self {
        Self { name, head: format!("<{name}"), content: String::new() }
    }

    /// A group.
    #[must_use]
    pub(crate) fn group() -> Self {
        Self::new("g")
    }

    /// Adds an attribute.
    #[must_use]
    pub(crate) fn text(mut self, key: &str, value: &str) -> Self {
        let _ = write!(self.head, " {key}=\"{}\"", escape(value));
        self
    }

    /// Adds an attribute that is a number, in the form of [`number`].
    #[must_use]
    pub(crate) fn number(self, key: &str, value: f64) -> Self {
        let value = number(value);
        self.text(key, &value)
    }

    /// Adds two attributes that are a point.
    #[must_use]
    pub(crate) fn point(self, keys: [&str; 2], [x, y]: [f64; 2]) -> Self {
        self.number(keys[0], x).number(keys[1], y)
    }

    /// Adds a label after what is there already.
    #[must_use]
    pub(crate) fn label(mut self, pieces: &[Piece<'_>]) -> Self {
        let mut low = false;
        for piece in pieces {
            let (text, style) = match piece {
                Piece::Plain(text) => (text, ""),
                Piece::Italic(text) => (text, " font-style=\"italic\""),
                Piece::Subscript(text) => (text, " font-style=\"italic\" font-size=\"8\" dy=\"2.5\""),
            };
            let rise = if low { " dy=\"-2.5\"" } else { "" };
            let _ = write!(self.content, "<tspan{style}{rise}>{}</tspan>", escape(text));
            low = matches!(piece, Piece::Subscript(_));
        }
        self
    }

    /// Puts an element into this one.
    #[must_use]
    pub(crate) fn child(mut self, child: Self) -> Self {
        self.content.push_str(&child.finish());
        self
    }

    fn finish(self) -> String {
        if self.content.is_empty() {
            self.head + "/>"
        } else {
            format!("{}>{}</{}>", self.head, self.content, self.name)
        }
    }
}

/// A number with at most two decimals, without `-0` and without zeros at its end.
///
/// What is not finite becomes 0, what is beyond a million is cut: a document stays valid whatever the data are.
#[must_use]
pub(crate) fn number(value: f64) -> String {
    let value = if value.is_finite() { value.clamp(-LARGEST, LARGEST) } else { 0.0 };
    trim(&format!("{value:.2}"))
}

/// Removes zeros after the decimal point, and the sign of zero.
#[must_use]
pub(crate) fn trim(decimal: &str) -> String {
    let short =
        if decimal.contains('.') { decimal.trim_end_matches('0').trim_end_matches('.') } else { decimal };
    if short == "-0" { "0".into() } else { short.into() }
}

/// Text that is safe in XML and HTML, in content and in quoted attributes. Characters that XML forbids become U+FFFD.
#[must_use]
pub(crate) fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            '\n' | '\t' => safe.push(character),
            '\u{fffe}' | '\u{ffff}' => safe.push('\u{fffd}'),
            _ if character.is_control() => safe.push('\u{fffd}'),
            _ => safe.push(character),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_finite() {
        let shown = [0.1 + 0.2, -0.001, 12.0, -3.456, 1e300, f64::NAN, f64::NEG_INFINITY].map(number);
        assert_eq!(shown, ["0.3", "0", "12", "-3.46", "1000000", "0", "0"]);
    }

    #[test]
    fn text_is_escaped() {
        assert_eq!(
            escape("<a & \"b\" 'c'>\u{1b}\0"),
            "&lt;a &amp; &quot;b&quot; &#39;c&#39;&gt;\u{fffd}\u{fffd}"
        );
    }

    #[test]
    fn a_small_document_is_what_it_should_be() {
        let mut svg = Svg::new(20.0, 10.0, "one & two");
        svg.begin(&Element::group().text("fill", "none"));
        let label = [Piece::Italic("h"), Piece::Subscript("i"), Piece::Plain(" <")];
        svg.add(Element::new("text").point(["x", "y"], [1.0, 2.5]).label(&label));
        svg.end();
        let expected = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20\" height=\"10\" viewBox=\"0 0 20 10\" \
             font-family=\"DejaVu Sans, Verdana, sans-serif\" role=\"img\" aria-label=\"one &amp; two\">\n\
             <rect width=\"20\" height=\"10\" fill=\"#ffffff\"/>\n<g fill=\"none\">\n\
             <text x=\"1\" y=\"2.5\"><tspan font-style=\"italic\">h</tspan>\
             <tspan font-style=\"italic\" font-size=\"8\" dy=\"2.5\">i</tspan><tspan dy=\"-2.5\"> &lt;</tspan></text>\n\
             </g>\n</svg>\n";
        assert_eq!(svg.finish(), expected);
    }
}
