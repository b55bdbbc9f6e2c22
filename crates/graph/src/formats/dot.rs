//! DOT, the language of Graphviz.

use alloc::string::String;
use alloc::vec::Vec;

use super::Named;
use super::builder::Builder;
use super::dot_token::{Token, Tokens};
use super::error::FormatError;

struct Reader<'a> {
    tokens: Tokens<'a>,
    next: Token,
    builder: Builder,
}

pub(super) fn read(text: &str) -> Result<Named, FormatError> {
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
    let mut reader = Reader { tokens, next, builder: Builder::new(directed) };
    reader.body()?;
    if strict {
        reader.builder.merge_double_edges();
    }
    reader.builder.finish_by_number(reader.tokens.line)
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
            other => Err(unexpected(self.tokens.line, other, "one graph only")),
        }
    }

    fn statement(&mut self) -> Result<(), FormatError> {
        let line = self.tokens.line;
        match self.step()? {
            Token::Sign(';' | ',') => Ok(()),
            Token::Keyword("graph" | "node" | "edge") => self.attributes(),
            Token::Name(_) if self.next == Token::Sign('=') => {
                self.step()?;
                self.step().map(|_| ())
            }
            Token::Name(name) => self.chain(&name, line),
            other => Err(unexpected(line, &other, "a node, an edge, an attribute or } (no subgraphs)")),
        }
    }

    /// A node, or edges one after the other.
    fn chain(&mut self, name: &str, line: usize) -> Result<(), FormatError> {
        let mut from = self.builder.node(name, line)?;
        self.port()?;
        while matches!(self.next, Token::Arrow | Token::Dashes) {
            let line = self.tokens.line;
            let sign = self.step()?;
            if (sign == Token::Arrow) != self.builder.is_directed() {
                let allowed = "-> in a digraph, -- in a graph";
                return Err(unexpected(line, &sign, allowed));
            }
            let to = match self.step()? {
                Token::Name(name) => self.builder.node(&name, line)?,
                other => return Err(unexpected(line, &other, "the name of a node")),
            };
            self.port()?;
            self.builder.edge(from, to, line)?;
            from = to;
        }
        self.attributes()
    }

    fn port(&mut self) -> Result<(), FormatError> {
        while self.next == Token::Sign(':') {
            self.step()?;
            self.step()?;
        }
        Ok(())
    }

    /// Lists in brackets, which are passed over.
    fn attributes(&mut self) -> Result<(), FormatError> {
        while self.next == Token::Sign('[') {
            while self.next != Token::Sign(']') {
                if self.step()? == Token::End {
                    return Err(unexpected(self.tokens.line, &Token::End, "]"));
                }
            }
            self.step()?;
        }
        Ok(())
    }

    fn expect(&mut self, token: &Token, allowed: &'static str) -> Result<(), FormatError> {
        let line = self.tokens.line;
        let found = self.step()?;
        if found == *token { Ok(()) } else { Err(unexpected(line, &found, allowed)) }
    }

    /// Takes the next token.
    fn step(&mut self) -> Result<Token, FormatError> {
        let following = self.tokens.next()?;
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
