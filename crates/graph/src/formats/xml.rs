//! As much XML as GraphML needs: tags and their attributes, one after the other.

use alloc::string::String;

use super::error::FormatError;

/// An opening tag (or a whole empty element) and where it stands.
pub(super) struct Tag<'a> {
    pub(super) name: &'a str,
    pub(super) line: usize,
    attributes: &'a str,
}

/// Reads opening tags off the front of a text. Closing tags, text, comments and declarations are passed over.
pub(super) struct Tags<'a> {
    rest: &'a str,
    pub(super) line: usize,
}

impl<'a> Tags<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text, line: 1 }
    }

    pub(super) fn next(&mut self) -> Result<Option<Tag<'a>>, FormatError> {
        loop {
            let Some(start) = self.rest.find('<') else {
                return Ok(None);
            };
            self.take(start);
            let end = if self.rest.starts_with("<!--") {
                self.rest.find("-->").map(|end| end + 3)
            } else if self.rest.starts_with("<![CDATA[") {
                self.rest.find("]]>").map(|end| end + 3)
            } else {
                tag_end(self.rest)
            };
            let line = self.line;
            let Some(end) = end else {
                return Err(FormatError::unexpected(line, self.rest, "a tag or comment that ends"));
            };
            let inner = self.take(end).trim_start_matches('<').trim_end_matches('>').trim_end_matches('/');
            if !inner.starts_with(['!', '?', '/']) {
                let name_end = inner.find(char::is_whitespace).unwrap_or(inner.len());
                let (name, attributes) = inner.split_at(name_end);
                // A prefix such as `g:` names the namespace.
                let name = name.rsplit(':').next().unwrap_or(name);
                return Ok(Some(Tag { name, line, attributes }));
            }
        }
    }

    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.line += taken.matches('\n').count();
        self.rest = rest;
        taken
    }
}

/// Just behind the `>` that ends a tag; one within quotes does not.
fn tag_end(text: &str) -> Option<usize> {
    let mut quote = None;
    for (index, byte) in text.bytes().enumerate() {
        match (byte, quote) {
            (b'>', None) => return Some(index + 1),
            (b'"' | b'\'', None) => quote = Some(byte),
            _ if quote == Some(byte) => quote = None,
            _ => {}
        }
    }
    None
}

impl Tag<'_> {
    /// The value of an attribute, entities resolved.
    pub(super) fn attribute(&self, name: &str) -> Result<Option<String>, FormatError> {
        let mut rest = self.attributes.trim_start();
        while !rest.is_empty() {
            let wrong = || FormatError::unexpected(self.line, rest, "attributes such as id=\"1\"");
            let (key, after) = rest.split_once('=').ok_or_else(wrong)?;
            let after = after.trim_start();
            let quote = after.chars().next().filter(|c| matches!(c, '"' | '\'')).ok_or_else(wrong)?;
            let (value, following) = after[1..].split_once(quote).ok_or_else(wrong)?;
            if key.trim() == name {
                return self.resolve(value).map(Some);
            }
            rest = following.trim_start();
        }
        Ok(None)
    }

    /// The value of an attribute that must be there.
    pub(super) fn required(&self, name: &str, allowed: &'static str) -> Result<String, FormatError> {
        self.attribute(name)?.ok_or_else(|| FormatError::unexpected(self.line, self.name, allowed))
    }

    fn resolve(&self, value: &str) -> Result<String, FormatError> {
        let mut parts = value.split('&');
        let mut resolved = String::from(parts.next().unwrap_or(""));
        for part in parts {
            let known = part.split_once(';').and_then(|(entity, rest)| Some((character(entity)?, rest)));
            let Some((c, rest)) = known else {
                return Err(FormatError::unexpected(self.line, part, "an entity such as &amp; or &#38;"));
            };
            resolved.push(c);
            resolved.push_str(rest);
        }
        Ok(resolved)
    }
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

/// `text` with the characters replaced that would end an attribute, and with the control characters of one as numbers.
pub(super) fn escape(text: &str) -> String {
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
