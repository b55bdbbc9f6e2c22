//! JSON values that know their line.

use alloc::string::String;
use alloc::vec::Vec;

use crate::formats::error::FormatError;

/// Deepest nesting that is read.
const DEPTH_LIMIT: usize = 64;

#[derive(Debug)]
pub(super) enum Kind {
    Null,
    Bool(bool),
    /// As it is written.
    Number(String),
    Text(String),
    Array(Vec<Value>),
    Object(Vec<(String, Value)>),
}

#[derive(Debug)]
pub(super) struct Value {
    pub(super) kind: Kind,
    pub(super) line: usize,
}

impl Value {
    /// The last entry of this key, as most readers take it.
    pub(super) fn get(&self, key: &str) -> Option<&Value> {
        match &self.kind {
            Kind::Object(entries) => {
                entries.iter().rev().find(|(name, _)| name == key).map(|(_, value)| value)
            }
            _ => None,
        }
    }
}

pub(super) fn parse(text: &str) -> Result<Value, FormatError> {
    let mut reader = Reader { rest: text, line: 1, depth: 0 };
    let value = reader.value()?;
    reader.skip_blanks();
    if reader.rest.is_empty() { Ok(value) } else { Err(reader.unexpected("the end of the text")) }
}

struct Reader<'a> {
    rest: &'a str,
    line: usize,
    depth: usize,
}

impl<'a> Reader<'a> {
    fn value(&mut self) -> Result<Value, FormatError> {
        self.skip_blanks();
        let line = self.line;
        let kind = match self.rest.as_bytes().first() {
            Some(b'{') => self.nested(Self::object)?,
            Some(b'[') => self.nested(Self::array)?,
            Some(b'"') => Kind::Text(self.text()?),
            Some(b'-' | b'0'..=b'9') => Kind::Number(self.number()?),
            _ => self.word()?,
        };
        Ok(Value { kind, line })
    }

    fn nested(&mut self, read: fn(&mut Self) -> Result<Kind, FormatError>) -> Result<Kind, FormatError> {
        if self.depth == DEPTH_LIMIT {
            return Err(self.unexpected("at most 64 levels of brackets"));
        }
        self.depth += 1;
        self.take(1);
        let kind = read(self)?;
        self.depth -= 1;
        Ok(kind)
    }

    fn object(&mut self) -> Result<Kind, FormatError> {
        let mut entries = Vec::new();
        if self.accept('}') {
            return Ok(Kind::Object(entries));
        }
        loop {
            self.skip_blanks();
            if !self.rest.starts_with('"') {
                return Err(self.unexpected("a key in quotes"));
            }
            let key = self.text()?;
            if !self.accept(':') {
                return Err(self.unexpected(":"));
            }
            entries.push((key, self.value()?));
            if self.accept('}') {
                return Ok(Kind::Object(entries));
            }
            if !self.accept(',') {
                return Err(self.unexpected(", or }"));
            }
        }
    }

    fn array(&mut self) -> Result<Kind, FormatError> {
        let mut items = Vec::new();
        if self.accept(']') {
            return Ok(Kind::Array(items));
        }
        loop {
            items.push(self.value()?);
            if self.accept(']') {
                return Ok(Kind::Array(items));
            }
            if !self.accept(',') {
                return Err(self.unexpected(", or ]"));
            }
        }
    }

    fn text(&mut self) -> Result<String, FormatError> {
        self.take(1);
        let mut text = String::new();
        loop {
            let length = self.rest.find(['"', '\\', '\n']).unwrap_or(self.rest.len());
            text.push_str(self.take(length));
            match self.rest.as_bytes().first() {
                Some(b'"') => {
                    self.take(1);
                    return Ok(text);
                }
                Some(b'\\') => text.push(self.escape()?),
                _ => return Err(self.unexpected("a text that ends with a quote on its line")),
            }
        }
    }

    fn escape(&mut self) -> Result<char, FormatError> {
        self.take(1);
        let plain = match self.rest.as_bytes().first() {
            Some(b'u') => return self.code_point(),
            Some(b'n') => '\n',
            Some(b't') => '\t',
            Some(b'r') => '\r',
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(&sign @ (b'"' | b'\\' | b'/')) => char::from(sign),
            _ => return Err(self.unexpected("an escape of JSON")),
        };
        self.take(1);
        Ok(plain)
    }

    /// Behind a backslash: `uXXXX`, or two of them for a character above U+FFFF.
    fn code_point(&mut self) -> Result<char, FormatError> {
        let high = self.hexadecimal()?;
        let mut code = high;
        if (0xd800..0xdc00).contains(&high) && self.rest.starts_with("\\u") {
            self.take(1);
            let low = self.hexadecimal()?;
            code = 0x1_0000 + ((high - 0xd800) << 10) + low.wrapping_sub(0xdc00) % 0x400;
        }
        char::from_u32(code).ok_or_else(|| self.unexpected("a pair of surrogates"))
    }

    fn hexadecimal(&mut self) -> Result<u32, FormatError> {
        let digits = self.rest.get(1..5).filter(|digits| digits.bytes().all(|byte| byte.is_ascii_hexdigit()));
        let code = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let code = code.ok_or_else(|| self.unexpected("four hexadecimal digits"))?;
        self.take(5);
        Ok(code)
    }

    fn number(&mut self) -> Result<String, FormatError> {
        let end = |c: char| !matches!(c, '-' | '+' | '.' | 'e' | 'E' | '0'..='9');
        let length = self.rest.find(end).unwrap_or(self.rest.len());
        if self.rest[..length].parse::<f64>().is_err() {
            return Err(self.unexpected("a number"));
        }
        Ok(String::from(self.take(length)))
    }

    fn word(&mut self) -> Result<Kind, FormatError> {
        let words = [("true", Kind::Bool(true)), ("false", Kind::Bool(false)), ("null", Kind::Null)];
        // Python writes NaN for a missing weight.
        let words = words.into_iter().chain([("NaN", Kind::Null), ("Infinity", Kind::Null)]);
        for (word, kind) in words {
            if self.rest.starts_with(word) {
                self.take(word.len());
                return Ok(kind);
            }
        }
        Err(self.unexpected("a value of JSON"))
    }

    fn accept(&mut self, sign: char) -> bool {
        self.skip_blanks();
        let there = self.rest.starts_with(sign);
        if there {
            self.take(1);
        }
        there
    }

    fn skip_blanks(&mut self) {
        let blanks =
            self.rest.len() - self.rest.trim_start_matches([' ', '\t', '\r', '\n', '\u{feff}']).len();
        self.take(blanks);
    }

    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.line += taken.matches('\n').count();
        self.rest = rest;
        taken
    }

    fn unexpected(&self, allowed: &'static str) -> FormatError {
        let found = self.rest.lines().next().unwrap_or("");
        FormatError::unexpected(self.line, found, allowed)
    }
}
