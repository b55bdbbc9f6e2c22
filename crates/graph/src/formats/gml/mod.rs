//! GML: keys with values, and lists of these in brackets.

mod token;

use alloc::string::String;
use alloc::vec::Vec;

use super::Options;
use super::builder::{Builder, Draft};
use super::error::{FormatError, Problem};
use token::{Kind, Token, Tokens};

/// Deepest nesting that is read.
const DEPTH_LIMIT: usize = 64;

/// Whether some key is `graph` and its value a list; what comes before are keys with single values.
pub(super) fn looks_like(text: &str) -> bool {
    let mut tokens = Tokens::new(text);
    loop {
        match (tokens.next(), tokens.next()) {
            (Ok(Token { kind: Kind::Key(key), .. }), Ok(Token { kind, .. })) => match kind {
                Kind::Open => return key.eq_ignore_ascii_case("graph"),
                Kind::Value(_) | Kind::Text(_) => {}
                _ => return false,
            },
            _ => return false,
        }
    }
}

/// Keys of an element that matter, with their lines.
#[derive(Default)]
struct Element {
    line: usize,
    id: Option<String>,
    label: Option<String>,
    source: Option<String>,
    target: Option<String>,
}

/// What stands in the graph.
#[derive(Default)]
struct Content {
    directed: bool,
    nodes: Vec<Element>,
    edges: Vec<Element>,
}

struct Reader<'a> {
    tokens: Tokens<'a>,
    graph: Option<Content>,
}

pub(super) fn read(text: &str, _: &Options<'_>) -> Result<Draft, FormatError> {
    let mut reader = Reader { tokens: Tokens::new(text), graph: None };
    reader.top()?;
    let last = reader.tokens.line;
    let content = reader.graph.ok_or_else(|| FormatError::unexpected(last, "", "graph [ … ]"))?;
    let mut builder = Builder::new(content.directed);
    for node in &content.nodes {
        let id = node.id.as_ref().ok_or_else(|| FormatError::missing(node.line, "a node with an id"))?;
        let number = builder.declare(id, node.line)?;
        builder.label(number, node.label.as_deref().unwrap_or(""));
    }
    for edge in &content.edges {
        let missing = || FormatError::missing(edge.line, "an edge with a source and a target");
        let end = |end: &Option<String>| builder.known(end.as_ref().ok_or_else(missing)?, edge.line);
        let (from, to) = (end(&edge.source)?, end(&edge.target)?);
        builder.edge(from, to, edge.line);
    }
    builder.finish_labelled(last)
}

impl Reader<'_> {
    fn top(&mut self) -> Result<(), FormatError> {
        loop {
            let token = self.tokens.next()?;
            match token.kind {
                Kind::End => return Ok(()),
                Kind::Key(key) if key.eq_ignore_ascii_case("graph") => {
                    if self.graph.is_some() {
                        return Err(FormatError::unexpected(token.line, key, "one graph"));
                    }
                    self.open()?;
                    self.graph = Some(self.content()?);
                }
                Kind::Key(_) => self.skip_value()?,
                other => return Err(other.unexpected(token.line, "a key such as graph")),
            }
        }
    }

    fn open(&mut self) -> Result<(), FormatError> {
        let token = self.tokens.next()?;
        if matches!(token.kind, Kind::Open) { Ok(()) } else { Err(token.kind.unexpected(token.line, "[")) }
    }

    fn content(&mut self) -> Result<Content, FormatError> {
        let mut content = Content::default();
        loop {
            let token = self.tokens.next()?;
            match token.kind {
                Kind::Close => return Ok(content),
                Kind::Key("node") => content.nodes.push(self.element(token.line)?),
                Kind::Key("edge") => content.edges.push(self.element(token.line)?),
                Kind::Key("directed") => {
                    content.directed = match self.value()?.as_str() {
                        "0" => false,
                        "1" => true,
                        other => return Err(FormatError::unexpected(token.line, other, "directed 0 or 1")),
                    };
                }
                Kind::Key(_) => self.skip_value()?,
                other => return Err(other.unexpected(token.line, "a key or ]")),
            }
        }
    }

    fn element(&mut self, line: usize) -> Result<Element, FormatError> {
        self.open()?;
        let mut element = Element { line, ..Element::default() };
        loop {
            let token = self.tokens.next()?;
            let place = match token.kind {
                Kind::Close => return Ok(element),
                Kind::Key("id") => &mut element.id,
                Kind::Key("label") => &mut element.label,
                Kind::Key("source") => &mut element.source,
                Kind::Key("target") => &mut element.target,
                Kind::Key(_) => {
                    self.skip_value()?;
                    continue;
                }
                other => return Err(other.unexpected(token.line, "a key or ]")),
            };
            *place = Some(self.value()?);
        }
    }

    fn value(&mut self) -> Result<String, FormatError> {
        let token = self.tokens.next()?;
        match token.kind {
            Kind::Value(value) => Ok(String::from(value)),
            Kind::Text(text) => Ok(token::resolved(text)),
            other => Err(other.unexpected(token.line, "a number or a text in quotes")),
        }
    }

    /// A value or a list with all that is in it.
    fn skip_value(&mut self) -> Result<(), FormatError> {
        let mut depth = 0_usize;
        loop {
            let token = self.tokens.next()?;
            match token.kind {
                Kind::Open if depth == DEPTH_LIMIT => {
                    return Err(token.kind.unexpected(token.line, "at most 64 levels of brackets"));
                }
                Kind::Open => depth += 1,
                Kind::Close if depth > 0 => depth -= 1,
                Kind::Value(_) | Kind::Text(_) => {}
                Kind::Key(_) if depth > 0 => {}
                other => return Err(other.unexpected(token.line, "a value")),
            }
            if depth == 0 {
                return Ok(());
            }
        }
    }
}

impl Kind<'_> {
    fn unexpected(&self, line: usize, allowed: &'static str) -> FormatError {
        let found = match self {
            Self::Open => "[",
            Self::Close => "]",
            Self::Key(word) | Self::Value(word) | Self::Text(word) => word,
            Self::End => "",
        };
        FormatError::new(line, Problem::Unexpected { found: super::error::shortened(found), allowed })
    }
}
