//! A table of the text, and which of its fields are known.

use core::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A table of the text, or one that is not there and has only defaults.
#[derive(Clone, Debug)]
pub(crate) struct Section<'text> {
    pub(super) path: String,
    pub(super) place: Range<usize>,
    pub(super) entries: Option<&'text DeTable<'text>>,
    pub(super) known: Vec<&'static str>,
    /// True if its kind was refused, so that nobody knows which fields it has.
    pub(super) unclear: bool,
}

impl<'text> Section<'text> {
    /// The whole text.
    pub(crate) fn root(entries: &'text DeTable<'text>) -> Self {
        Self { path: String::new(), place: 0..0, entries: Some(entries), known: Vec::new(), unclear: false }
    }

    /// A table in a list, by its full name and place.
    pub(super) fn item(path: String, place: Range<usize>, entries: &'text DeTable<'text>) -> Self {
        Self { path, place, entries: Some(entries), known: Vec::new(), unclear: false }
    }

    /// Full name of a field.
    pub(crate) fn name(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// Counts `key` among the fields that there are.
    pub(super) fn know(&mut self, key: &'static str) {
        if !self.known.contains(&key) {
            self.known.push(key);
        }
    }

    /// True if the text has this field.
    pub(crate) fn has(&mut self, key: &'static str) -> bool {
        self.know(key);
        self.entries.is_some_and(|entries| entries.contains_key(key))
    }

    /// True if the text has a table by this name.
    pub(crate) fn has_table(&self, key: &str) -> bool {
        self.entries.and_then(|entries| entries.get(key)).is_some_and(|value| value.get_ref().is_table())
    }

    /// True if the text has a table by this name, which is then known to be a field.
    pub(crate) fn knows_table(&mut self, key: &'static str) -> bool {
        self.know(key);
        self.has_table(key)
    }

    /// The table by this name, to look at a second time.
    pub(crate) fn table(&self, key: &str) -> Option<Self> {
        let value = self.entries.and_then(|entries| entries.get(key))?;
        let (path, entries) = (self.name(key), value.get_ref().as_table());
        Some(Self { path, place: value.span(), entries, known: Vec::new(), unclear: false })
    }

    pub(super) fn take(&mut self, key: &'static str) -> Option<&'text Spanned<DeValue<'text>>> {
        self.know(key);
        self.entries.and_then(|entries| entries.get(key))
    }
}
