//! Reads fields of TOML tables one by one and remembers where each stood and what was wrong.

use core::ops::Range;
use std::collections::BTreeMap;

use closeranks_core::settings::range::Allowed;
use toml::Spanned;
use toml::de::DeValue;

use super::files::Files;
use super::gone;
use super::problem::Problem;
pub(crate) use super::section::Section;
use super::value::{describe, number, one_of, printable, whole};

/// Collects problems and the places of fields while a text is read.
#[derive(Debug, Default)]
pub(crate) struct Reader {
    problems: Vec<Problem>,
    pub(super) places: BTreeMap<String, Range<usize>>,
    /// Items of lists that are numbers.
    pub(super) items: BTreeMap<String, f64>,
    files: Files,
    /// Which of several teams is read, from 0, and how many robots the others have.
    pub(super) team: u64,
    pub(super) strangers: u16,
    /// What the table of one of several teams may have beside what `[team]` has.
    pub(super) beside: &'static [&'static str],
}

impl Reader {
    /// Reads a text that names `files`.
    pub(crate) fn new(files: &Files) -> Self {
        Self { files: files.clone(), ..Self::default() }
    }

    /// Reads one of several teams; the others have so many robots.
    pub(super) fn of_team(files: &Files, team: u64, strangers: u16) -> Self {
        Self { team, strangers, ..Self::new(files) }
    }

    /// Notes where a field stands that was read elsewhere.
    pub(super) fn place(&mut self, field: &str, place: Range<usize>) {
        self.places.insert(field.to_owned(), place);
    }

    /// The files beside the text.
    pub(crate) fn files(&self) -> Files {
        self.files.clone()
    }

    /// Notes something wrong with a field that was not read, at its table.
    pub(crate) fn refuse_in(
        &mut self,
        section: &Section<'_>,
        field: &str,
        found: &str,
        allowed: impl Into<String>,
    ) {
        let (span, found) = (section.place.clone(), found.to_owned());
        self.problems.push(Problem { span, field: field.to_owned(), found, allowed: allowed.into() });
    }

    /// What was wrong, in the order of the text.
    pub(crate) fn finish(mut self) -> Vec<Problem> {
        self.problems.sort_by_key(|problem| problem.span.start);
        self.problems
    }

    /// True as long as nothing was wrong.
    pub(crate) fn is_clean(&self) -> bool {
        self.problems.is_empty()
    }

    /// Notes something wrong with a field that was read before, or with its table where it was left to its default.
    pub(crate) fn refuse(&mut self, field: &str, found: impl Into<String>, allowed: impl Into<String>) {
        let table = field.split_once('.').map_or("", |(table, _)| table);
        let (given, nearest) = (self.places.get(field), self.places.get(table));
        let found = if given.is_some() { found.into() } else { format!("{} by default", found.into()) };
        let span = given.or(nearest).cloned().unwrap_or(0..0);
        self.problems.push(Problem { span, field: field.to_owned(), found, allowed: allowed.into() });
    }

    pub(super) fn wrong(&mut self, field: String, value: &Spanned<DeValue<'_>>, allowed: impl Into<String>) {
        let found = describe(value.get_ref());
        self.problems.push(Problem { span: value.span(), field, found, allowed: allowed.into() });
    }

    /// A table below `parent`.
    fn section<'text>(&mut self, parent: &mut Section<'text>, key: &'static str) -> Section<'text> {
        let path = parent.name(key);
        let (place, known) = (parent.place.clone(), Vec::new());
        let mut section = Section { path, place, entries: None, known, unclear: false };
        if let Some(value) = parent.take(key) {
            section.place = value.span();
            self.places.insert(section.path.clone(), value.span());
            section.entries = value.get_ref().as_table();
            if section.entries.is_none() {
                self.wrong(section.path.clone(), value, "a table");
            }
        }
        section
    }

    /// A table below `parent`, read by `read`; fields that it did not ask for are noted.
    pub(crate) fn table<'text, T>(
        &mut self,
        parent: &mut Section<'text>,
        key: &'static str,
        read: impl FnOnce(&mut Self, &mut Section<'text>) -> T,
    ) -> T {
        let mut section = self.section(parent, key);
        let fields = read(self, &mut section);
        self.close(&section);
        fields
    }

    /// A value by its key, with its place remembered.
    pub(super) fn take<'text>(
        &mut self,
        section: &mut Section<'text>,
        key: &'static str,
    ) -> Option<(String, &'text Spanned<DeValue<'text>>)> {
        let field = section.name(key);
        let value = section.take(key)?;
        self.places.insert(field.clone(), value.span());
        Some((field, value))
    }

    /// A finite number in `allowed`.
    pub(crate) fn number(
        &mut self,
        section: &mut Section<'_>,
        key: &'static str,
        allowed: Allowed,
    ) -> Option<f64> {
        let (field, value) = self.take(section, key)?;
        let number = number(value.get_ref()).filter(|number| allowed.holds(*number));
        if number.is_none() {
            self.wrong(field, value, format!("a number, {allowed}"));
        }
        number
    }

    /// A finite number in `allowed`, or `default` where it is not given.
    pub(crate) fn number_or(
        &mut self,
        section: &mut Section<'_>,
        key: &'static str,
        allowed: Allowed,
        default: f64,
    ) -> f64 {
        self.number(section, key, allowed).unwrap_or(default)
    }

    /// A whole number in `range`.
    pub(crate) fn whole(
        &mut self,
        section: &mut Section<'_>,
        key: &'static str,
        range: Range<u64>,
    ) -> Option<u64> {
        let (field, value) = self.take(section, key)?;
        let whole = whole(value.get_ref()).filter(|whole| range.contains(whole));
        if whole.is_none() {
            self.wrong(field, value, format!("a whole number, {} to {}", range.start, range.end - 1));
        }
        whole
    }

    /// One of `choices`.
    pub(crate) fn word<T: Copy>(
        &mut self,
        section: &mut Section<'_>,
        key: &'static str,
        choices: &[(&str, T)],
    ) -> Option<T> {
        let (field, value) = self.take(section, key)?;
        let word = value.get_ref().as_str();
        let choice = choices.iter().find(|(name, _)| Some(*name) == word).map(|(_, choice)| *choice);
        if choice.is_none() {
            self.wrong(field, value, one_of(choices.iter().map(|(name, _)| *name)));
        }
        choice
    }

    /// The field `kind`, on which depends what other fields there are.
    pub(crate) fn kind<T: Copy>(&mut self, section: &mut Section<'_>, choices: &[(&str, T)]) -> Option<T> {
        let given = section.has("kind");
        let kind = self.word(section, "kind", choices);
        section.unclear = given && kind.is_none();
        kind
    }

    /// A text of 1 to `length` printable characters.
    pub(crate) fn text(
        &mut self,
        section: &mut Section<'_>,
        key: &'static str,
        length: usize,
    ) -> Option<String> {
        let (field, value) = self.take(section, key)?;
        let good =
            |text: &&str| (1..=length).contains(&text.chars().count()) && !text.chars().any(char::is_control);
        let text = value.get_ref().as_str().filter(good).map(str::to_owned);
        if text.is_none() {
            self.wrong(
                field,
                value,
                format!("a text of 1 to {length} characters, without control characters"),
            );
        }
        text
    }

    /// True if the text has this field.
    pub(crate) fn was_given(&self, field: &str) -> bool {
        self.places.contains_key(field)
    }

    /// Notes every field of `section` that nobody asked for.
    pub(crate) fn close(&mut self, section: &Section<'_>) {
        let Some(entries) = section.entries.filter(|_| !section.unclear) else { return };
        for (key, _) in entries {
            if !section.known.contains(&key.get_ref().as_ref()) {
                let field = section.name(&printable(key.get_ref()));
                let (found, allowed) = match gone::instead(&field) {
                    Some(instead) => ("no longer a field".to_owned(), instead.to_owned()),
                    None => ("not a field here".to_owned(), one_of(section.known.iter().copied())),
                };
                self.problems.push(Problem { span: key.span(), field, found, allowed });
            }
        }
    }
}
