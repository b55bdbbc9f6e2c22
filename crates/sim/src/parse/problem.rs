//! What is wrong with a scenario file: place, field, value and what is allowed.

use core::fmt;
use core::ops::Range;

/// One mistake in a scenario text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Bytes of the text it is about; for a default that clashes, those of the nearest table.
    pub span: Range<usize>,
    /// Full name of the field, such as `controller.w_r`; empty when the text is not TOML.
    pub field: String,
    /// What is there.
    pub found: String,
    /// What is allowed there.
    pub allowed: String,
}

impl Problem {
    /// Line of the text, from 1, in which it begins.
    #[must_use]
    pub fn line(&self, text: &str) -> usize {
        let before = text.get(..self.span.start).unwrap_or(text);
        before.matches('\n').count() + 1
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.field.is_empty() {
            return f.write_str(&self.found);
        }
        write!(f, "`{}` is {}, allowed is {}", self.field, self.found, self.allowed)
    }
}

impl core::error::Error for Problem {}
