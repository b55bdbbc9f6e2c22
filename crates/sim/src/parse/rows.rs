//! Rows of numbers, listed in a scenario text or in a file beside it.

use super::column::{Column, names};
use super::files::{FILE_MAX, is_name};
use super::reader::{Reader, Section};
use super::value::printable;

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
    let text = match files.get(&name) {
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
pub(crate) fn csv(text: &str, columns: &[Column]) -> Result<Vec<(Vec<f64>, usize)>, Wrong> {
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
        let shown = printable(head);
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
        let shown = || printable(fields[*place]);
        number.ok_or_else(|| (format!("{} = {}", column.name, shown()), column.to_string()))
    };
    columns.iter().zip(order).map(number).collect()
}
