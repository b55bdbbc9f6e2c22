//! A scenario text in which values may be draws, as a tree.

use core::ops::Range;
use std::collections::BTreeMap;

use toml::Value;

/// A value, or what to draw it from. Tables go by the alphabet of their keys, and so does the order of draws.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Node {
    /// A value that is not drawn.
    Plain(Value),
    /// A table.
    Table(BTreeMap<String, Node>),
    /// A list.
    List(Vec<Node>),
    /// A whole number, both ends included.
    Whole {
        /// Least.
        min: i64,
        /// Greatest.
        max: i64,
    },
    /// A number of `[min, max)`.
    Number {
        /// Least.
        min: f64,
        /// Greatest.
        max: f64,
        /// True if it is drawn evenly in the logarithm.
        log: bool,
    },
    /// One of several, each with the sum of weights up to and with it.
    Choice {
        /// What to choose from.
        items: Vec<Node>,
        /// The sums, which ascend; the last is that of all weights.
        sums: Vec<f64>,
        /// Where each of them stands in the text.
        places: Vec<Range<usize>>,
    },
}

/// The whole text as a tree.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Root {
    /// Everything at its top but `together`.
    pub(super) entries: BTreeMap<String, Node>,
    /// What is drawn together: one of several texts, each of whose entries takes the place of the one of the same name.
    pub(super) together: Option<Node>,
}

/// The name of the column that says which text was chosen at the top.
pub(super) const TOGETHER: &str = "choose";

impl Root {
    /// Every drawn field by its full name.
    pub(super) fn fields(&self) -> BTreeMap<String, Field> {
        let mut found = BTreeMap::new();
        for (key, node) in &self.entries {
            node.fields(key, false, &mut found);
        }
        if let Some(node) = &self.together {
            node.fields("", true, &mut found);
            let name = found.remove("").map(|field| Field { path: TOGETHER.to_owned(), ..field });
            found.extend(name.map(|field| (field.path.clone(), field)));
        }
        found
    }
}

/// A drawn field, as a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Full name, such as `attack.level.bias`.
    pub path: String,
    /// True if every value that it can have is a number; else they are texts.
    pub number: bool,
    /// True if it can have a few values only: it is chosen, or it is a whole number.
    pub few: bool,
}

/// The name of `key` below `path`.
pub(super) fn below(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

impl Node {
    /// Notes every field below `path` that is drawn. Inside of a choice (`chosen`) these are all fields.
    pub(super) fn fields(&self, path: &str, chosen: bool, found: &mut BTreeMap<String, Field>) {
        match self {
            Self::Plain(Value::Table(_)) => {}
            Self::Plain(value) if chosen => note(found, path, is_number(value), true),
            Self::Plain(_) => {}
            Self::Table(entries) => {
                for (key, node) in entries {
                    node.fields(&below(path, key), chosen, found);
                }
            }
            Self::List(items) if chosen && !items.iter().any(Self::is_table) => {
                note(found, path, false, true);
            }
            Self::List(items) => {
                for (index, node) in items.iter().enumerate() {
                    node.fields(&format!("{path}[{index}]"), chosen, found);
                }
            }
            Self::Whole { .. } => note(found, path, true, true),
            Self::Number { .. } => note(found, path, true, false),
            Self::Choice { items, .. } => {
                if items.iter().any(Self::is_nameless) {
                    note(found, path, false, true);
                }
                for item in items {
                    item.fields(path, true, found);
                }
            }
        }
    }
}

impl Node {
    fn is_table(&self) -> bool {
        matches!(self, Self::Table(_) | Self::Plain(Value::Table(_)))
    }

    /// True for a table without a `kind`, which goes by the names of its fields.
    pub(super) fn is_nameless(&self) -> bool {
        match self {
            Self::Table(entries) => !entries.contains_key("kind"),
            Self::Plain(Value::Table(entries)) => !entries.contains_key("kind"),
            _ => false,
        }
    }
}

fn note(found: &mut BTreeMap<String, Field>, path: &str, number: bool, few: bool) {
    let new = || Field { path: path.to_owned(), number: true, few: true };
    let field = found.entry(path.to_owned()).or_insert_with(new);
    field.number &= number;
    field.few &= few;
}

fn is_number(value: &Value) -> bool {
    value.is_integer() || value.is_float()
}
