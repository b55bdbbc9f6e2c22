//! Formats written in XML. roxmltree reads the XML; here is what is made of its elements.

pub(super) mod gexf;
pub(super) mod graphml;
mod lines;

use alloc::string::{String, ToString};

use roxmltree::{Document, Node, ParsingOptions};

use super::error::{FormatError, Problem, shortened};
use lines::Lines;

/// Most elements, texts and comments that are read.
const NODES_LIMIT: u32 = 1 << 20;

/// Whether it is XML whose first element is a `gexf`.
pub(super) fn looks_like_gexf(text: &str) -> bool {
    is_xml(text) && first_element(text).is_some_and(|name| name == "gexf")
}

/// Whether it is any other XML: then GraphML says what is wrong with it.
pub(super) fn looks_like_graphml(text: &str) -> bool {
    is_xml(text) && !looks_like_gexf(text)
}

fn is_xml(text: &str) -> bool {
    text.trim_start().starts_with('<')
}

/// The name of the first element, without its prefix.
fn first_element(text: &str) -> Option<&str> {
    let mut rest = text;
    loop {
        rest = &rest[rest.find('<')? + 1..];
        if let Some(comment) = rest.strip_prefix("!--") {
            rest = &comment[comment.find("-->")?..];
        } else if !rest.starts_with(['!', '?']) {
            let end = rest.find(|c: char| c.is_whitespace() || matches!(c, '>' | '/'))?;
            return rest[..end].rsplit(':').next();
        }
    }
}

/// A document and where its lines begin.
struct Xml<'a> {
    document: Document<'a>,
    lines: Lines,
}

impl<'a> Xml<'a> {
    fn parse(text: &'a str) -> Result<Self, FormatError> {
        let options =
            ParsingOptions { allow_dtd: true, nodes_limit: NODES_LIMIT, ..ParsingOptions::default() };
        // An XML declaration must come first, but blank lines before it harm nobody.
        let start = text.len() - text.trim_start().len();
        match Document::parse_with_options(&text[start..], options) {
            Ok(document) => Ok(Self { document, lines: Lines::of(text, start) }),
            Err(error) => Err(complaint(text, &error)),
        }
    }

    fn line(&self, node: Node<'_, '_>) -> usize {
        self.lines.line(node.range().start)
    }

    /// Line of the end.
    fn last(&self) -> usize {
        self.lines.last()
    }

    fn unexpected(&self, node: Node<'_, '_>, found: &str, allowed: &'static str) -> FormatError {
        FormatError::unexpected(self.line(node), found, allowed)
    }

    /// The value of an attribute that must be there.
    fn required<'n>(
        &self,
        node: Node<'n, '_>,
        name: &str,
        allowed: &'static str,
    ) -> Result<&'n str, FormatError> {
        node.attribute(name).ok_or_else(|| self.unexpected(node, node.tag_name().name(), allowed))
    }
}

/// An error of roxmltree with its line. Where the end is missing, that is the last line.
fn complaint(text: &str, error: &roxmltree::Error) -> FormatError {
    let before = text[..text.len() - text.trim_start().len()].matches('\n').count();
    let last = 1 + text.trim_end().matches('\n').count();
    let row = usize::try_from(error.pos().row).unwrap_or(1);
    let at_end =
        matches!(error, roxmltree::Error::UnclosedRootNode | roxmltree::Error::UnexpectedEndOfStream);
    let line = if at_end { last } else { (row + before).clamp(1, last) };
    let what =
        if at_end { "it ends before its first element does".to_string() } else { shortened_error(error) };
    FormatError::new(line, Problem::Xml { what })
}

/// What roxmltree says, without the place, which we say ourselves.
fn shortened_error(error: &roxmltree::Error) -> String {
    let said = error.to_string();
    let said = said.rsplit_once(" at ").map_or(said.as_str(), |(what, _)| what);
    said.chars().take(120).map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// The only child of `parent` with this name; others are refused.
fn only_child<'a, 'i>(xml: &Xml<'_>, parent: Node<'a, 'i>, name: &str) -> Result<Node<'a, 'i>, FormatError> {
    let mut found = parent.children().filter(|child| child.has_tag_name_of(name));
    let first = found.next().ok_or_else(|| FormatError::unexpected(xml.last(), "", "a graph element"))?;
    match found.next() {
        Some(second) => Err(xml.unexpected(second, name, "one graph")),
        None => Ok(first),
    }
}

/// Names of elements whatever their namespace.
trait Named {
    fn has_tag_name_of(&self, name: &str) -> bool;
}

impl Named for Node<'_, '_> {
    fn has_tag_name_of(&self, name: &str) -> bool {
        self.is_element() && self.tag_name().name() == name
    }
}

/// `true` and `false` as XML writes them.
fn truth(xml: &Xml<'_>, node: Node<'_, '_>, value: &str) -> Result<bool, FormatError> {
    match value {
        "true" | "1" => Ok(true),
        "false" | "0" => Ok(false),
        other => Err(xml.unexpected(node, &shortened(other), "true or false")),
    }
}

/// `text` with the characters replaced that would end an attribute, and with the control characters of one as numbers.
fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' => escaped.push_str("&#10;"),
            '\r' => escaped.push_str("&#13;"),
            '\t' => escaped.push_str("&#9;"),
            _ => escaped.push(c),
        }
    }
    escaped
}
