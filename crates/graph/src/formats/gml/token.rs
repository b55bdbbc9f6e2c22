//! Words and signs of GML.

use alloc::string::String;

use crate::formats::error::FormatError;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind<'a> {
    /// A word that begins with a letter.
    Key(&'a str),
    /// A number, as it is written.
    Value(&'a str),
    /// A text, without its quotes, entities as they are written.
    Text(&'a str),
    /// `[`
    Open,
    /// `]`
    Close,
    End,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub(super) kind: Kind<'a>,
    pub(super) line: usize,
}

/// Reads tokens off the front of a text; `#` begins a comment up to the end of its line.
pub(super) struct Tokens<'a> {
    rest: &'a str,
    pub(super) line: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text, line: 1 }
    }

    pub(super) fn next(&mut self) -> Result<Token<'a>, FormatError> {
        self.skip_blanks();
        let line = self.line;
        let Some(first) = self.rest.chars().next() else {
            return Ok(Token { kind: Kind::End, line });
        };
        let kind = match first {
            '[' => {
                self.take(1);
                Kind::Open
            }
            ']' => {
                self.take(1);
                Kind::Close
            }
            '"' => self.text()?,
            _ if first.is_ascii_alphabetic() || first == '_' => Kind::Key(self.word()),
            '0'..='9' | '-' | '+' | '.' => Kind::Value(self.word()),
            _ => return Err(FormatError::unexpected(line, &String::from(first), "a key or a value of GML")),
        };
        Ok(Token { kind, line })
    }

    fn text(&mut self) -> Result<Kind<'a>, FormatError> {
        let inner = &self.rest[1..];
        let Some(end) = inner.find('"') else {
            return Err(FormatError::unexpected(self.line, self.rest, "a text that ends with a quote"));
        };
        self.take(end + 2);
        Ok(Kind::Text(&inner[..end]))
    }

    fn word(&mut self) -> &'a str {
        let ends = |c: char| c.is_whitespace() || matches!(c, '[' | ']' | '"' | '#');
        let end = self.rest.find(ends).unwrap_or(self.rest.len());
        let word = &self.rest[..end];
        self.take(end);
        word
    }

    fn skip_blanks(&mut self) {
        loop {
            let blanks = self.rest.len() - self.rest.trim_start().len();
            self.take(blanks);
            if !self.rest.starts_with('#') {
                return;
            }
            self.take(self.rest.find('\n').unwrap_or(self.rest.len()));
        }
    }

    fn take(&mut self, bytes: usize) {
        let (passed, rest) = self.rest.split_at(bytes);
        self.line += passed.matches('\n').count();
        self.rest = rest;
    }
}

/// A text with its entities resolved, as far as they are known: `&amp;`, `&quot;`, `&#228;`, `&#xe4;`.
pub(super) fn resolved(text: &str) -> String {
    let mut parts = text.split('&');
    let mut resolved = String::from(parts.next().unwrap_or(""));
    for part in parts {
        match part.split_once(';').and_then(|(entity, rest)| Some((character(entity)?, rest))) {
            Some((c, rest)) => {
                resolved.push(c);
                resolved.push_str(rest);
            }
            None => resolved.extend(["&", part]),
        }
    }
    resolved
}

fn character(entity: &str) -> Option<char> {
    match entity {
        "amp" => Some('&'),
        "lt" => Some('<'),
        "gt" => Some('>'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => {
            let number = entity.strip_prefix('#')?;
            let code = match number.strip_prefix(['x', 'X']) {
                Some(digits) => u32::from_str_radix(digits, 16),
                None => number.parse(),
            };
            char::from_u32(code.ok()?)
        }
    }
}
