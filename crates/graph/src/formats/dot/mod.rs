//! DOT, the language of Graphviz.

mod chain;
mod token;

use alloc::string::String;
use alloc::vec::Vec;

use super::builder::{Builder, Draft};
use super::error::FormatError;
use super::{Named, Options};
use token::{Token, Tokens};

/// Deepest nesting of subgraphs that is read.
const DEPTH_LIMIT: usize = 64;

/// Whether it begins with `graph`, `digraph` or `strict` and a brace follows, perhaps behind a name.
pub(super) fn looks_like(text: &str) -> bool {
    let mut tokens = Tokens::new(text);
    let mut next = || tokens.next().unwrap_or(Token::End);
    let first = next();
    let kind = if first == Token::Keyword("strict") { next() } else { first };
    let behind = match next() {
        Token::Name(_) => next(),
        other => other,
    };
    matches!(kind, Token::Keyword("graph" | "digraph")) && behind == Token::Sign('{')
}

/// Reads tokens one ahead.
struct Reader<'a> {
    tokens: Tokens<'a>,
    next: Token,
    /// Line of `next`.
    line: usize,
    builder: Builder,
    depth: usize,
}

pub(super) fn read(text: &str, _: &Options<'_>) -> Result<Draft, FormatError> {
    let mut tokens = Tokens::new(text);
    let mut next = tokens.next()?;
    let strict = next == Token::Keyword("strict");
    if strict {
        next = tokens.next()?;
    }
    let directed = match next {
        Token::Keyword("graph") => false,
        Token::Keyword("digraph") => true,
        other => return Err(unexpected(tokens.line, &other, "\"graph\" or \"digraph\"")),
    };
    let next = tokens.next()?;
    let line = tokens.line;
    let mut reader = Reader { tokens, next, line, builder: Builder::new(directed), depth: 0 };
    if strict {
        reader.builder.expect_parallel();
    }
    reader.body()?;
    reader.builder.finish_by_number(reader.line)
}

impl Reader<'_> {
    fn body(&mut self) -> Result<(), FormatError> {
        if let Token::Name(_) = self.next {
            self.step()?;
        }
        self.expect(&Token::Sign('{'), "{")?;
        while self.next != Token::Sign('}') {
            self.statement()?;
        }
        self.step()?;
        match &self.next {
            Token::End => Ok(()),
            other => Err(unexpected(self.line, other, "one graph only")),
        }
    }

    /// Lists in brackets, which are passed over but for one thing: the value of `dir`, which says who hears whom.
    fn attributes(&mut self) -> Result<Option<String>, FormatError> {
        let mut direction = None;
        while self.next == Token::Sign('[') {
            self.step()?;
            while self.next != Token::Sign(']') {
                let line = self.line;
                match self.step()? {
                    Token::End => return Err(unexpected(line, &Token::End, "]")),
                    Token::Name(key) if self.next == Token::Sign('=') => {
                        self.step()?;
                        let value = self.step()?;
                        direction = if key == "dir" { Some(value.into_text()) } else { direction };
                    }
                    _ => {}
                }
            }
            self.step()?;
        }
        Ok(direction)
    }

    fn expect(&mut self, token: &Token, allowed: &'static str) -> Result<(), FormatError> {
        let line = self.line;
        let found = self.step()?;
        if found == *token { Ok(()) } else { Err(unexpected(line, &found, allowed)) }
    }

    /// Takes the next token.
    fn step(&mut self) -> Result<Token, FormatError> {
        let following = self.tokens.next()?;
        self.line = self.tokens.start;
        Ok(core::mem::replace(&mut self.next, following))
    }
}

fn unexpected(line: usize, found: &Token, allowed: &'static str) -> FormatError {
    let sign;
    let found = match found {
        Token::Name(name) => name.as_str(),
        Token::Keyword(word) => word,
        Token::Sign(c) => {
            sign = String::from(*c);
            &sign
        }
        Token::Arrow => "->",
        Token::Dashes => "--",
        Token::End => "",
    };
    FormatError::unexpected(line, found, allowed)
}

pub(super) fn write(named: &Named) -> String {
    let directed = named.graph.is_directed();
    let names: Vec<String> = named.names.iter().map(|name| quote(name)).collect();
    let mut text = String::from(if directed { "digraph {\n" } else { "graph {\n" });
    for name in &names {
        text.extend(["  ", name, ";\n"]);
    }
    for (from, to) in named.graph.edges() {
        let sign = if directed { " -> " } else { " -- " };
        text.extend(["  ", &names[from], sign, &names[to], ";\n"]);
    }
    text.push_str("}\n");
    text
}

fn quote(name: &str) -> String {
    let mut quoted = String::from("\"");
    for c in name.chars() {
        if matches!(c, '"' | '\\') {
            quoted.push('\\');
        }
        quoted.push(c);
    }
    quoted.push('"');
    quoted
}
