//! Lines and words of plain texts, with their places.

use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;

use super::error::FormatError;

/// `text` without a mark of the byte order, its lines ended by `\n` whatever ended them.
#[must_use]
pub fn unix_lines(text: &str) -> Cow<'_, str> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if !text.contains('\r') {
        return Cow::Borrowed(text);
    }
    let mut unix = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(end) = rest.find('\r') {
        unix.push_str(&rest[..end]);
        unix.push('\n');
        rest = &rest[end + 1..];
        rest = rest.strip_prefix('\n').unwrap_or(rest);
    }
    unix.push_str(rest);
    Cow::Owned(unix)
}

/// What a line says, without blanks around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    /// From 1.
    pub(super) number: usize,
    /// Where it begins in the whole line, bytes.
    pub(super) start: usize,
    pub(super) text: &'a str,
}

/// A word of a line, without its quotes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Word<'a> {
    pub(super) line: usize,
    /// Where it begins in the whole line, bytes.
    pub(super) at: usize,
    pub(super) text: &'a str,
    pub(super) quoted: bool,
}

impl Word<'_> {
    /// Something else should stand here.
    pub(super) fn unexpected(&self, allowed: &'static str) -> FormatError {
        FormatError::unexpected(self.line, self.text, allowed).at(self.at)
    }

    /// The word as a whole number.
    pub(super) fn count(&self, allowed: &'static str) -> Result<usize, FormatError> {
        self.text.parse().map_err(|_| self.unexpected(allowed))
    }

    /// The word as a number that is neither infinite nor missing.
    pub(super) fn number(&self) -> Option<f64> {
        self.text.parse::<f64>().ok().filter(|value| value.is_finite())
    }
}

/// All lines with their numbers, blanks around them taken off.
pub(super) fn all_lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    text.split('\n').enumerate().map(|(index, line)| {
        let start = line.len() - line.trim_start().len();
        Line { number: index + 1, start, text: line.trim() }
    })
}

/// The lines that say something: `%` at the start and `#` anywhere outside of quotes begin comments.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let said = all_lines(text).map(|line| Line { text: without_comment(line.text), ..line });
    said.filter(|line| !line.text.is_empty())
}

fn without_comment(line: &str) -> &str {
    if line.starts_with('%') {
        return "";
    }
    let mut quoted = false;
    let sign = line.find(|c: char| {
        quoted ^= c == '"';
        c == '#' && !quoted
    });
    line[..sign.unwrap_or(line.len())].trim_end()
}

/// What stands between words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    /// Blanks and tabs, any number of them.
    Blanks,
    /// One sign; what is between two of them may be empty or have blanks inside.
    Sign(char),
}

impl Separator {
    /// A tab, semicolon or comma if every line of more than one word has it outside of quotes and braces, else blanks.
    pub(super) fn of(lines: &[Line<'_>]) -> Self {
        let signs = ['\t', ';', ','].into_iter();
        let separates = |sign: &char| {
            let has = |line: &Line<'_>| is_split(line.text, |c| c == *sign);
            let alone = |line: &Line<'_>| !is_split(line.text, is_between);
            lines.iter().any(has) && lines.iter().all(|line| has(line) || alone(line))
        };
        signs.clone().find(separates).map_or(Self::Blanks, Self::Sign)
    }

    /// The words of a line. An empty one at the end is left out.
    pub(super) fn words(self, line: Line<'_>) -> Vec<Word<'_>> {
        let mut words = Vec::new();
        let mut rest = line.text;
        while let Some((word, after)) = self.first(rest) {
            let at = line.start + line.text.len() - rest.len();
            words.push(placed(word, at, line.number));
            rest = after;
        }
        words
    }

    /// The first word with its quotes, and what comes behind the separator; nothing at the end.
    fn first(self, text: &str) -> Option<(&str, &str)> {
        if text.is_empty() {
            return None;
        }
        let ends = |c: char| match self {
            Self::Blanks => c.is_whitespace(),
            Self::Sign(sign) => c == sign,
        };
        let end = end_of_word(text, ends);
        let (word, rest) = text.split_at(end);
        let rest = match self {
            Self::Blanks => rest.trim_start(),
            Self::Sign(sign) => rest.strip_prefix(sign).unwrap_or(rest),
        };
        Some((word, rest))
    }
}

/// The words between blanks.
pub(super) fn words(line: Line<'_>) -> Vec<Word<'_>> {
    Separator::Blanks.words(line)
}

fn is_between(c: char) -> bool {
    c.is_whitespace() || matches!(c, ',' | ';')
}

fn is_split(text: &str, ends: impl Fn(char) -> bool) -> bool {
    end_of_word(text, ends) < text.len()
}

/// Where the first word ends: quotes protect what is within, and a brace at the start all the rest (a weight as Python
/// prints it).
fn end_of_word(text: &str, ends: impl Fn(char) -> bool) -> usize {
    let start = text.len() - text.trim_start_matches(' ').len();
    let inner = &text[start..];
    let from = match inner.chars().next() {
        Some('{') => return text.len(),
        Some(quote @ ('"' | '\'')) => inner[1..].find(quote).map_or(start, |end| start + end + 2),
        _ => start,
    };
    text[from..].find(ends).map_or(text.len(), |end| from + end)
}

fn placed(word: &str, at: usize, line: usize) -> Word<'_> {
    let inside = word.trim();
    let at = at + word.len() - word.trim_start().len();
    let unquoted = ['"', '\''].into_iter().find_map(|quote| inside.strip_prefix(quote)?.strip_suffix(quote));
    match unquoted {
        Some(text) => Word { line, at: at + 1, text, quoted: true },
        None => Word { line, at, text: inside, quoted: false },
    }
}
