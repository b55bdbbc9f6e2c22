//! Edges as Python prints them: `[(0, 1), (0, 2)]`, one or many a line, with weights behind the ends.

use alloc::string::{String, ToString};

use super::Said;
use crate::formats::Options;
use crate::formats::builder::Draft;
use crate::formats::error::FormatError;

const ALLOWED: &str = "pairs such as (0, 1) or ('a', 'b'), perhaps with a weight behind them";

/// Whether the first sign is an opening parenthesis, perhaps behind a bracket or the name of a view of networkx.
pub(in crate::formats) fn looks_like(text: &str) -> bool {
    let start = strip_view(text.trim_start());
    let inner = start.strip_prefix(['[', '{', '(']).unwrap_or(start).trim_start();
    start.starts_with('(') || (inner.starts_with('(') && !text.trim_start().starts_with("{{"))
}

/// Without `EdgeView(` and its relatives.
fn strip_view(text: &str) -> &str {
    let views = [
        "OutMultiEdgeView",
        "OutEdgeView",
        "MultiEdgeView",
        "EdgeView",
        "OutMultiEdgeDataView",
        "OutEdgeDataView",
        "MultiEdgeDataView",
        "EdgeDataView",
    ];
    views.into_iter().find_map(|view| text.strip_prefix(view)?.strip_prefix('(')).unwrap_or(text)
}

pub(in crate::formats) fn read(text: &str, options: &Options<'_>) -> Result<Draft, FormatError> {
    let start = text.len() - text.trim_start().len();
    let view = text[start..].len() - strip_view(&text[start..]).len();
    let mut reader = Reader { rest: &text[start + view..], line: 1 + text[..start].matches('\n').count() };
    let mut builder = Said::builder(None, options.directed);
    let open = reader.outer(view > 0);
    while reader.accept('(') {
        let line = reader.line;
        let from = reader.value()?;
        reader.demand(',')?;
        let to = reader.value()?;
        while reader.accept(',') {
            if !reader.peeks(')') {
                reader.weight()?;
            }
        }
        reader.demand(')')?;
        let (from, to) = (builder.node(&from, line)?, builder.node(&to, line)?);
        builder.edge(from, to, line);
        reader.accept(',');
    }
    for sign in open.chars().rev() {
        reader.demand(sign)?;
    }
    reader.skip_blanks();
    if !reader.rest.is_empty() {
        return Err(reader.unexpected());
    }
    builder.refuse_same_numbers(reader.line)?;
    builder.finish_by_number(reader.line)
}

struct Reader<'a> {
    rest: &'a str,
    line: usize,
}

impl Reader<'_> {
    /// Opens what is around all pairs; gives the signs that must close it, the outermost first.
    fn outer(&mut self, view: bool) -> String {
        let mut closing = String::from(if view { ")" } else { "" });
        if self.accept('[') {
            closing.push(']');
        } else if self.accept('{') {
            closing.push('}');
        } else if self
            .rest
            .trim_start()
            .strip_prefix('(')
            .is_some_and(|rest| rest.trim_start().starts_with('('))
        {
            self.accept('(');
            closing.push(')');
        }
        closing
    }

    /// A number or a text in quotes, as a name. Numbers of numpy, `np.int64(3)`, are numbers.
    fn value(&mut self) -> Result<String, FormatError> {
        self.skip_blanks();
        if let Some(quote) = self.rest.chars().next().filter(|c| matches!(c, '"' | '\'')) {
            let inner = &self.rest[1..];
            let end = inner.find([quote, '\\', '\n']).filter(|&end| inner[end..].starts_with(quote));
            let end = end.ok_or_else(|| self.unexpected())?;
            let name = inner[..end].to_string();
            self.take(end + 2);
            return Ok(name);
        }
        let numpy = self.rest.strip_prefix("np.").and_then(|rest| Some(rest.find('(')? + 4));
        if let Some(length) = numpy {
            self.take(length);
        }
        let end =
            self.rest.find(|c: char| !c.is_ascii_digit() && !matches!(c, '-' | '+' | '.' | 'e')).unwrap_or(0);
        let name = self.rest[..end].to_string();
        if name.parse::<f64>().is_err() {
            return Err(self.unexpected());
        }
        self.take(end);
        if numpy.is_some() {
            self.demand(')')?;
        }
        Ok(name)
    }

    /// A value that is passed over: a dictionary, or anything without brackets up to the next comma.
    fn weight(&mut self) -> Result<(), FormatError> {
        self.skip_blanks();
        let mut depth = 0_usize;
        let mut quote = None;
        for (index, c) in self.rest.char_indices() {
            match (c, quote) {
                ('"' | '\'', None) => quote = Some(c),
                (c, Some(open)) if c == open => quote = None,
                ('{' | '[' | '(', None) => depth += 1,
                (',' | ')', None) if depth == 0 => {
                    let zero = self.rest[..index].trim().parse::<f64>().is_ok_and(|weight| weight == 0.0);
                    if zero {
                        let allowed = "a weight other than 0: nobody can know whether 0 is a link";
                        return Err(FormatError::unexpected(self.line, self.rest[..index].trim(), allowed));
                    }
                    self.take(index);
                    return Ok(());
                }
                ('}' | ']' | ')', None) => depth = depth.saturating_sub(1),
                _ => {}
            }
        }
        Err(FormatError::missing(self.line, "a pair that ends"))
    }

    fn peeks(&mut self, sign: char) -> bool {
        self.skip_blanks();
        self.rest.starts_with(sign)
    }

    fn accept(&mut self, sign: char) -> bool {
        let there = self.peeks(sign);
        if there {
            self.take(sign.len_utf8());
        }
        there
    }

    fn demand(&mut self, sign: char) -> Result<(), FormatError> {
        if self.accept(sign) { Ok(()) } else { Err(self.unexpected()) }
    }

    fn skip_blanks(&mut self) {
        self.take(self.rest.len() - self.rest.trim_start().len());
    }

    fn take(&mut self, bytes: usize) {
        let (taken, rest) = self.rest.split_at(bytes);
        self.line += taken.matches('\n').count();
        self.rest = rest;
    }

    fn unexpected(&self) -> FormatError {
        let found = self.rest.lines().next().unwrap_or("");
        FormatError::unexpected(self.line, found, ALLOWED)
    }
}
