//! Words and signs of DOT.

use alloc::string::String;

use crate::formats::error::FormatError;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token {
    /// A name, without its quotes.
    Name(String),
    /// A name without quotes that is a keyword, in small letters.
    Keyword(&'static str),
    /// `{ } [ ] = ; , :`
    Sign(char),
    /// `->`
    Arrow,
    /// `--`
    Dashes,
    End,
}

impl Token {
    /// What it says, as a value of an attribute.
    pub(super) fn into_text(self) -> String {
        match self {
            Self::Name(name) => name,
            Self::Keyword(word) => String::from(word),
            _ => String::new(),
        }
    }
}

const KEYWORDS: [&str; 6] = ["strict", "graph", "digraph", "node", "edge", "subgraph"];

/// Reads tokens off the front of a text.
pub(super) struct Tokens<'a> {
    rest: &'a str,
    /// Where the next token is looked for.
    pub(super) line: usize,
    /// Where the last token began.
    pub(super) start: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text, line: 1, start: 1 }
    }

    pub(super) fn next(&mut self) -> Result<Token, FormatError> {
        self.skip_blanks()?;
        self.start = self.line;
        let Some(first) = self.rest.chars().next() else {
            return Ok(Token::End);
        };
        if let Some(token) = self.sign(first) {
            return Ok(token);
        }
        match first {
            '"' => self.quoted().map(Token::Name),
            '<' => self.html(),
            _ if is_bare(first) || first == '-' => Ok(self.bare(first)),
            _ => Err(FormatError::unexpected(self.line, &String::from(first), "a name or a sign of DOT")),
        }
    }

    fn sign(&mut self, first: char) -> Option<Token> {
        let (length, token) = match first {
            '{' | '}' | '[' | ']' | '=' | ';' | ',' | ':' => (1, Token::Sign(first)),
            '-' if self.rest.starts_with("->") => (2, Token::Arrow),
            '-' if self.rest.starts_with("--") => (2, Token::Dashes),
            _ => return None,
        };
        self.advance(length);
        Some(token)
    }

    fn skip_blanks(&mut self) -> Result<(), FormatError> {
        loop {
            let blanks = self.rest.len() - self.rest.trim_start().len();
            self.advance(blanks);
            if self.rest.starts_with("//") || self.rest.starts_with('#') {
                self.advance(self.rest.find('\n').unwrap_or(self.rest.len()));
            } else if self.rest.starts_with("/*") {
                let Some(end) = self.rest.find("*/") else {
                    return Err(FormatError::unexpected(self.line, "/*", "a comment that ends with */"));
                };
                self.advance(end + 2);
            } else {
                return Ok(());
            }
        }
    }

    /// A text in quotes; `"a" + "b"` is one text.
    fn quoted(&mut self) -> Result<String, FormatError> {
        let mut name = self.one_quoted()?;
        loop {
            let (rest, line) = (self.rest, self.line);
            self.skip_blanks()?;
            if !self.rest.starts_with('+') {
                (self.rest, self.line) = (rest, line);
                return Ok(name);
            }
            self.advance(1);
            self.skip_blanks()?;
            if !self.rest.starts_with('"') {
                return Err(FormatError::unexpected(self.line, self.rest, "a text in quotes behind +"));
            }
            name.push_str(&self.one_quoted()?);
        }
    }

    fn one_quoted(&mut self) -> Result<String, FormatError> {
        let mut name = String::new();
        let mut escaped = false;
        for (index, c) in self.rest.char_indices().skip(1) {
            match c {
                '"' if !escaped => {
                    self.advance(index + 1);
                    return Ok(name);
                }
                '\\' if !escaped => escaped = true,
                // A line may be broken within quotes.
                '\n' if escaped => escaped = false,
                _ => {
                    // Only \" is an escape of DOT's own; others belong to labels.
                    if escaped && c != '"' && c != '\\' {
                        name.push('\\');
                    }
                    name.push(c);
                    escaped = false;
                }
            }
        }
        Err(FormatError::unexpected(self.line, self.rest, "a name that ends with a quote"))
    }

    /// A label of HTML, `<…>` with brackets in pairs inside.
    fn html(&mut self) -> Result<Token, FormatError> {
        let mut depth = 0_usize;
        for (index, c) in self.rest.char_indices() {
            match c {
                '<' => depth += 1,
                '>' => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                let label = String::from(&self.rest[..=index]);
                self.advance(index + 1);
                return Ok(Token::Name(label));
            }
        }
        Err(FormatError::unexpected(self.line, self.rest, "a label <…> that ends"))
    }

    fn bare(&mut self, first: char) -> Token {
        let sign = usize::from(first == '-');
        let length = self.rest[sign..].find(|c| !is_bare(c)).unwrap_or(self.rest.len() - sign) + sign;
        let word = &self.rest[..length];
        let keyword = KEYWORDS.into_iter().find(|keyword| word.eq_ignore_ascii_case(keyword));
        let token = keyword.map_or_else(|| Token::Name(String::from(word)), Token::Keyword);
        self.advance(length);
        token
    }

    fn advance(&mut self, bytes: usize) {
        let (passed, rest) = self.rest.split_at(bytes);
        self.line += passed.matches('\n').count();
        self.rest = rest;
    }
}

pub(super) fn is_bare(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | '.')
}
