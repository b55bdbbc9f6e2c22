//! Files beside a scenario. Nobody here opens them: whoever does hands their texts over.

use std::collections::BTreeMap;
use std::sync::Arc;

use toml::de::{DeTable, DeValue};

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

    /// What the file `name` says, or why it cannot be read; `None` if nobody read it.
    pub(crate) fn get(&self, name: &str) -> Option<Result<&str, &str>> {
        self.0.get(name).map(|text| text.as_deref().map_err(String::as_str))
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
    if let Ok(table) = crate::parse::table(text) {
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

/// True if a file beside a scenario may be called so.
pub(super) fn is_name(name: &str) -> bool {
    let bad = |c: char| c.is_control() || c == '/' || c == '\\';
    (1..=100).contains(&name.len()) && !name.contains(bad) && name != "." && name != ".."
}
