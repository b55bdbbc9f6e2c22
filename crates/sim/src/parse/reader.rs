//! Reads fields of TOML tables one by one and remembers where each stood and what was wrong.

use core::ops::Range;
use std::collections::BTreeMap;

use closeranks_core::settings::range::Allowed;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::column::{Column, names};
use super::files::Files;
use super::problem::Problem;

/// Collects problems and the places of fields while a text is read.
#[derive(Debug, Default)]
pub(crate) struct Reader {
    problems: Vec<Problem>,
    places: BTreeMap<String, Range<usize>>,
    /// Items of lists that are numbers.
    items: BTreeMap<String, f64>,
    files: Files,
}

/// A table of the text, or one that is not there and has only defaults.
#[derive(Clone, Debug)]
pub(crate) struct Section<'text> {
    path: String,
    place: Range<usize>,
    entries: Option<&'text DeTable<'text>>,
    known: Vec<&'static str>,
    /// True if its kind was refused, so that nobody knows which fields it has.
    unclear: bool,
}

impl<'text> Section<'text> {
    /// The whole text.
    pub(crate) fn root(entries: &'text DeTable<'text>) -> Self {
        Self { path: String::new(), place: 0..0, entries: Some(entries), known: Vec::new(), unclear: false }
    }

    /// Full name of a field.
    pub(crate) fn name(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    fn know(&mut self, key: &'static str) {
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

    fn take(&mut self, key: &'static str) -> Option<&'text Spanned<DeValue<'text>>> {
        self.know(key);
        self.entries.and_then(|entries| entries.get(key))
    }
}

impl Reader {
    /// Reads a text that names `files`.
    pub(crate) fn new(files: &Files) -> Self {
        Self { files: files.clone(), ..Self::default() }
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

    fn wrong(&mut self, field: String, value: &Spanned<DeValue<'_>>, allowed: impl Into<String>) {
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
    fn take<'text>(
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

    /// A list, each item read by `item`; a bad item is named with its place in the list.
    pub(crate) fn list<T>(
        &mut self,
        section: &mut Section<'_>,
        key: &'static str,
        allowed: &str,
        item: impl Fn(&DeValue<'_>) -> Option<T>,
    ) -> Option<Vec<T>> {
        let (field, value) = self.take(section, key)?;
        let Some(items) = value.get_ref().as_array() else {
            self.wrong(field, value, format!("a list, each item {allowed}"));
            return None;
        };
        let mut read = Vec::with_capacity(items.len());
        for (index, value) in items.iter().enumerate() {
            let name = format!("{field}[{index}]");
            match item(value.get_ref()) {
                Some(good) => read.push(good),
                None => self.wrong(name.clone(), value, allowed),
            }
            self.items.extend(number(value.get_ref()).map(|number| (name.clone(), number)));
            self.places.insert(name, value.span());
        }
        (read.len() == items.len()).then_some(read)
    }

    /// A list of lists with a number for each of `columns`; a bad number is named with its place in both.
    pub(crate) fn rows(
        &mut self,
        section: &mut Section<'_>,
        key: &'static str,
        columns: &[Column],
    ) -> Option<Vec<Vec<f64>>> {
        let allowed = format!("a list of {} numbers, {}", columns.len(), names(columns));
        let (field, value) = self.take(section, key)?;
        let Some(items) = value.get_ref().as_array() else {
            self.wrong(field, value, format!("a list, each item {allowed}"));
            return None;
        };
        let mut rows = Vec::with_capacity(items.len());
        for (index, value) in items.iter().enumerate() {
            let field = format!("{field}[{index}]");
            self.places.insert(field.clone(), value.span());
            match value.get_ref().as_array().filter(|numbers| numbers.len() == columns.len()) {
                Some(numbers) => rows.extend(self.row(&field, numbers.iter(), columns)),
                None => self.wrong(field, value, allowed.as_str()),
            }
        }
        (rows.len() == items.len()).then_some(rows)
    }

    fn row<'text>(
        &mut self,
        field: &str,
        values: impl Iterator<Item = &'text Spanned<DeValue<'text>>>,
        columns: &[Column],
    ) -> Option<Vec<f64>> {
        let mut row = Vec::with_capacity(columns.len());
        for (index, (value, column)) in values.zip(columns).enumerate() {
            match number(value.get_ref()).filter(|number| column.holds(*number)) {
                Some(number) => row.push(number),
                None => self.wrong(format!("{field}[{index}]"), value, column.to_string()),
            }
        }
        (row.len() == columns.len()).then_some(row)
    }

    /// The name of the second item of a list that is `number`, or of the list itself if nobody knows where that stands.
    pub(crate) fn second(&self, list: &str, number: f64) -> String {
        let is_it = |place: &usize| self.items.get(&format!("{list}[{place}]")) == Some(&number);
        let place = (0..self.items.len()).filter(is_it).nth(1);
        place.map_or(list.to_owned(), |place| format!("{list}[{place}]"))
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
                let found = "not a field here".to_owned();
                let allowed = one_of(section.known.iter().copied());
                let field = section.name(&printable(key.get_ref()));
                self.problems.push(Problem { span: key.span(), field, found, allowed });
            }
        }
    }
}

/// A number written as integer or float.
pub(crate) fn number(value: &DeValue<'_>) -> Option<f64> {
    let number = match value {
        #[expect(clippy::cast_precision_loss, reason = "a whole number above 2^53 is out of every range")]
        DeValue::Integer(_) => whole_signed(value)? as f64,
        DeValue::Float(float) => float.as_str().parse().ok()?,
        _ => return None,
    };
    number.is_finite().then_some(number)
}

/// A whole number, not negative.
pub(crate) fn whole(value: &DeValue<'_>) -> Option<u64> {
    whole_signed(value).and_then(|whole| u64::try_from(whole).ok())
}

/// A whole number.
pub(crate) fn whole_signed(value: &DeValue<'_>) -> Option<i64> {
    let integer = value.as_integer()?;
    i64::from_str_radix(integer.as_str(), integer.radix()).ok()
}

/// Names as a message lists them.
pub(crate) fn one_of<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// The value, shortened, as an error shows it.
pub(crate) fn describe(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("\"{}\"", printable(text)),
        DeValue::Integer(integer) => printable(&integer.to_string()),
        DeValue::Float(float) => printable(float.as_str()),
        DeValue::Boolean(flag) => flag.to_string(),
        DeValue::Datetime(_) => "a date".to_owned(),
        DeValue::Array(items) => format!("a list of {}", items.len()),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// The text, shortened and without control characters.
pub(crate) fn printable(text: &str) -> String {
    let short: String = text.chars().take(40).flat_map(char::escape_debug).collect();
    if text.chars().count() > 40 { format!("{short}...") } else { short }
}
