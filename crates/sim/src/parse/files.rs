//! Files beside a scenario. Nobody here opens them: whoever does hands their texts over.

use std::collections::BTreeMap;
use std::sync::Arc;

use toml::Value;
use toml::de::{DeTable, DeValue};

use super::column::{Column, names};
use super::reader::{Reader, Section};

/// Longest file beside a scenario, bytes.
pub const FILE_MAX: usize = 1 << 18;

/// Texts of files by their names, or why one cannot be read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Files(Arc<BTreeMap<String, Result<String, String>>>);

impl Files {
    /// True if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// What they say as comments of a scenario text: with these it differs where one of them does.
    #[must_use]
    pub fn comments(&self) -> String {
        let of = |(name, text): (&String, &Result<String, String>)| {
            let text = text.as_deref().unwrap_or_default();
            let lines = text.lines().map(|line| format!("# {}\n", line.escape_debug()));
            format!("\n# {name}:\n{}", lines.collect::<String>())
        };
        self.0.iter().map(of).collect()
    }
}

impl FromIterator<(String, Result<String, String>)> for Files {
    fn from_iter<I: IntoIterator<Item = (String, Result<String, String>)>>(files: I) -> Self {
        Self(Arc::new(files.into_iter().collect()))
    }
}

/// The files that a scenario text, with or without draws, names: each beside it, without a path.
#[must_use]
pub fn named(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    if let Ok(table) = super::table(text) {
        walk_table(table.get_ref(), &mut found);
    }
    found.sort_unstable();
    found.dedup();
    found
}

fn walk_table(table: &DeTable<'_>, found: &mut Vec<String>) {
    for (key, value) in table {
        match value.get_ref() {
            DeValue::String(name) if key.get_ref() == "file" && is_name(name) => found.push(name.to_string()),
            other => walk(other, found),
        }
    }
}

fn walk(value: &DeValue<'_>, found: &mut Vec<String>) {
    match value {
        DeValue::Table(table) => walk_table(table, found),
        DeValue::Array(items) => items.iter().for_each(|item| walk(item.get_ref(), found)),
        _ => {}
    }
}

fn is_name(name: &str) -> bool {
    let bad = |c: char| c.is_control() || c == '/' || c == '\\';
    (1..=100).contains(&name.len()) && !name.contains(bad) && name != "." && name != ".."
}

/// Where a row stands.
#[derive(Debug)]
pub(crate) struct Place {
    field: String,
    /// Name and line of a file.
    line: Option<(String, usize)>,
}

impl Place {
    /// Notes that the row is wrong.
    pub(crate) fn refuse(&self, reader: &mut Reader, found: &str, allowed: &str) {
        let found = match &self.line {
            Some((file, line)) => format!("{file}, line {line}: {found}"),
            None => found.to_owned(),
        };
        reader.refuse(&self.field, found, allowed);
    }
}

/// The rows of the field `key`, or of the file that the field `file` names: at least one, at most `most`.
pub(crate) fn rows(
    reader: &mut Reader,
    section: &mut Section<'_>,
    key: &'static str,
    columns: &[Column],
    most: usize,
) -> Vec<(Vec<f64>, Place)> {
    let (is_listed, is_file) = (section.has(key), section.has("file"));
    let (field, file) = (section.name(key), section.name("file"));
    if is_listed == is_file {
        let allowed = format!("one of the two, with rows of {}", names(columns));
        let (found, field) =
            if is_file { ("beside `file`", &field) } else { ("neither listed nor in a `file`", &field) };
        reader.refuse_in(section, field, found, allowed);
        return Vec::new();
    }
    let rows = if is_file {
        from_file(reader, section, columns)
    } else {
        let rows = reader.rows(section, key, columns).unwrap_or_default().into_iter().enumerate();
        rows.map(|(index, row)| (row, Place { field: format!("{field}[{index}]"), line: None })).collect()
    };
    if reader.is_clean() && !(1..=most).contains(&rows.len()) {
        let field = if is_file { file } else { field };
        reader.refuse(&field, format!("{} rows", rows.len()), format!("1 to {most} rows"));
        return Vec::new();
    }
    rows
}

fn from_file(reader: &mut Reader, section: &mut Section<'_>, columns: &[Column]) -> Vec<(Vec<f64>, Place)> {
    let field = section.name("file");
    let Some(name) = reader.text(section, "file", 100) else { return Vec::new() };
    if !is_name(&name) {
        reader.refuse(
            &field,
            format!("\"{name}\""),
            "the name of a file beside the scenario, without a path",
        );
        return Vec::new();
    }
    let files = reader.files();
    let text = match files.0.get(&name) {
        Some(Ok(text)) => text,
        Some(Err(why)) => {
            reader.refuse(&field, format!("{name}: {why}"), format!("a text of at most {FILE_MAX} bytes"));
            return Vec::new();
        }
        None => {
            reader.refuse(&field, format!("{name}, which nobody read"), "a file beside a scenario file");
            return Vec::new();
        }
    };
    let place = |line| Place { field: field.clone(), line: Some((name.clone(), line)) };
    match csv(text, columns) {
        Ok(rows) => rows.into_iter().map(|(row, line)| (row, place(line))).collect(),
        Err((line, found, allowed)) => {
            place(line).refuse(reader, &found, &allowed);
            Vec::new()
        }
    }
}

/// Line, what is there and what is allowed.
type Wrong = (usize, String, String);

/// Rows of a text with commas, with their lines: names of columns in its first line, then numbers. Blank lines, and those that
/// begin with `#`, say nothing.
fn csv(text: &str, columns: &[Column]) -> Result<Vec<(Vec<f64>, usize)>, Wrong> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let (line, head) = lines.next().unwrap_or((1, ""));
    let order = order(head, columns).map_err(|(found, allowed)| (line, found, allowed))?;
    lines
        .map(|(line, text)| match row(text, columns, &order) {
            Ok(row) => Ok((row, line)),
            Err((found, allowed)) => Err((line, found, allowed)),
        })
        .collect()
}

/// For each column its place in a line.
fn order(head: &str, columns: &[Column]) -> Result<Vec<usize>, (String, String)> {
    let found: Vec<&str> = head.split(',').map(|name| name.trim().trim_matches('"')).collect();
    let place = |column: &Column| found.iter().position(|name| *name == column.name);
    let order: Option<Vec<usize>> = columns.iter().map(place).collect();
    order.filter(|_| found.len() == columns.len()).ok_or_else(|| {
        let shown = super::reader::printable(head);
        (format!("the columns \"{shown}\""), format!("{}, in any order", names(columns)))
    })
}

fn row(text: &str, columns: &[Column], order: &[usize]) -> Result<Vec<f64>, (String, String)> {
    let fields: Vec<&str> = text.split(',').map(str::trim).collect();
    if fields.len() != order.len() {
        return Err((format!("{} numbers", fields.len()), format!("{} of them", order.len())));
    }
    let number = |(column, place): (&Column, &usize)| {
        let number = fields[*place].parse::<f64>().ok().filter(|number| column.holds(*number));
        let shown = || super::reader::printable(fields[*place]);
        number.ok_or_else(|| (format!("{} = {}", column.name, shown()), column.to_string()))
    };
    columns.iter().zip(order).map(number).collect()
}

/// The text with the rows of its files in it, so that it can be run without them; comments are lost. The text itself if it
/// names none that can be read.
#[must_use]
pub fn inlined(text: &str, files: &Files) -> String {
    let Some(mut values) = text.parse::<toml::Table>().ok().filter(|_| !files.is_empty()) else {
        return text.to_owned();
    };
    inline(&mut values, files);
    values.to_string()
}

/// Puts the rows of files in the place of their names.
pub(crate) fn inline(values: &mut toml::Table, files: &Files) {
    for (_, value) in values.iter_mut() {
        if let Value::Table(inner) = value {
            inline(inner, files);
        }
    }
    let name = values.get("file").and_then(Value::as_str).and_then(|name| files.0.get(name));
    let kind = values.get("kind").and_then(Value::as_str).map(str::to_owned);
    if let (Some(Ok(text)), Some(kind)) = (name, kind)
        && let Some(rows) = listed(text, &kind)
    {
        values.remove("file");
        values.insert(kind, rows);
    }
}

/// The rows of a file that was read without fault, in the order of columns of lists of this `kind`.
fn listed(text: &str, kind: &str) -> Option<Value> {
    use crate::scenario::route::{KINDS, Listed};
    let kind = KINDS.iter().find(|(name, _)| *name == kind)?.1;
    let read = |dimension| csv(text, &Listed::columns(kind, u16::MAX, dimension)).ok();
    let rows = read(2).or_else(|| read(3))?;
    let number = |(place, number): (usize, f64)| {
        #[expect(clippy::cast_possible_truncation, reason = "the number of a robot")]
        let whole = number as i64;
        if place == 0 { Value::Integer(whole) } else { Value::Float(number) }
    };
    let row = |(row, _): (Vec<f64>, usize)| Value::Array(row.into_iter().enumerate().map(number).collect());
    Some(Value::Array(rows.into_iter().map(row).collect()))
}
