//! A scenario text with the rows of its files in it.

use toml::Value;

use crate::parse::files::Files;
use crate::parse::rows::csv;
use crate::scenario::route::{KINDS, Listed};

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
fn inline(values: &mut toml::Table, files: &Files) {
    for (_, value) in values.iter_mut() {
        match value {
            Value::Table(inner) => inline(inner, files),
            Value::Array(items) => {
                items.iter_mut().filter_map(Value::as_table_mut).for_each(|inner| inline(inner, files));
            }
            _ => {}
        }
    }
    let name = values.get("file").and_then(Value::as_str).and_then(|name| files.get(name));
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
