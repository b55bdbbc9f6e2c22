//! From TOML to a tree with draws; what is malformed is noted with its place.

use core::ops::Range;
use std::collections::BTreeMap;

use toml::de::{DeTable, DeValue};
use toml::{Spanned, Value};

use super::tree::{Node, Root, below};
use crate::parse::Problem;
use crate::parse::value::{describe, number, one_of, printable, whole_signed};

type Item<'text> = Spanned<DeValue<'text>>;

/// Whole numbers beyond this are no longer whole as floats.
const WHOLE_MAX: i64 = 1 << 53;
/// How many items of a refused list are shown.
const SHOWN: usize = 6;

/// Collects problems and the places of fields while a text is read.
#[derive(Debug, Default)]
pub(super) struct Reading {
    /// What was wrong.
    pub(super) problems: Vec<Problem>,
    /// Where each field stands. A field inside of a choice stands where the choice does.
    pub(super) places: BTreeMap<String, Range<usize>>,
    choices: u32,
}

/// True if the text has a draw, or a table `sweep`: then it is no plain scenario.
pub(super) fn is_drawn(table: &DeTable<'_>) -> bool {
    let drawn = |value: &Item<'_>| match value.get_ref() {
        DeValue::Table(inner) => is_draw(inner) || is_drawn(inner),
        DeValue::Array(items) => items.iter().any(in_item),
        _ => false,
    };
    table.get("sweep").is_some() || is_draw(table) || table.iter().any(|(_, value)| drawn(value))
}

fn in_item(item: &Item<'_>) -> bool {
    match item.get_ref() {
        DeValue::Table(inner) => is_draw(inner) || is_drawn(inner),
        DeValue::Array(items) => items.iter().any(in_item),
        _ => false,
    }
}

fn is_draw(table: &DeTable<'_>) -> bool {
    table.get("draw").is_some() || table.get("choose").is_some()
}

impl Reading {
    /// The whole text, without the table `sweep`.
    pub(super) fn root(&mut self, table: &DeTable<'_>) -> Root {
        let mut entries = self.entries("", table);
        entries.remove("sweep");
        let Some(choose) = table.get("choose") else { return Root { entries, together: None } };
        entries.retain(|key, _| !matches!(key.as_str(), "choose" | "weights"));
        let together = self.parts("", table);
        if let Node::Choice { items, .. } = &together
            && !items.iter().all(|item| matches!(item, Node::Table(_)))
        {
            self.refuse("choose", choose, "a list of tables");
        }
        Root { entries, together: Some(together) }
    }

    /// The entries of a table that is not a draw.
    pub(super) fn entries(&mut self, path: &str, table: &DeTable<'_>) -> BTreeMap<String, Node> {
        let entries = table.iter().map(|(key, value)| {
            let key = key.get_ref().as_ref();
            (key.to_owned(), self.node(&below(path, key), value))
        });
        entries.collect()
    }

    fn node(&mut self, path: &str, value: &Item<'_>) -> Node {
        if self.choices == 0 {
            self.places.insert(path.to_owned(), value.span());
        }
        match value.get_ref() {
            DeValue::Table(table) if table.get("draw").is_some() => self.range(path, table),
            DeValue::Table(table) if table.get("choose").is_some() => self.choice(path, table),
            DeValue::Table(table) => Node::Table(self.entries(path, table)),
            DeValue::Array(items) => self.list(path, items),
            _ => Node::Plain(self.plain(path, value)),
        }
    }

    fn list(&mut self, path: &str, items: &[Item<'_>]) -> Node {
        let items = items.iter().enumerate();
        Node::List(items.map(|(index, item)| self.node(&format!("{path}[{index}]"), item)).collect())
    }

    /// A value that is neither table nor list.
    fn plain(&mut self, path: &str, value: &Item<'_>) -> Value {
        let read = match value.get_ref() {
            DeValue::String(text) => Some(Value::String(text.clone().into_owned())),
            DeValue::Integer(_) => whole_signed(value.get_ref()).map(Value::Integer),
            DeValue::Float(float) => float.as_str().parse().ok().map(Value::Float),
            DeValue::Boolean(flag) => Some(Value::Boolean(*flag)),
            DeValue::Datetime(date) => Some(Value::Datetime(*date)),
            DeValue::Array(_) | DeValue::Table(_) => None,
        };
        read.unwrap_or_else(|| {
            self.refuse(path, value, "a number of at most 63 bits");
            Value::Integer(0)
        })
    }

    /// `{ draw = [least, greatest] }`, with `log = true` if wanted.
    fn range(&mut self, path: &str, table: &DeTable<'_>) -> Node {
        self.close(path, table, &["draw", "log"]);
        let log = table.get("log").map(|log| (log, log.get_ref().as_bool()));
        if let Some((log, None)) = log {
            self.refuse(&below(path, "log"), log, "true or false");
        }
        let log = log.is_some_and(|(_, log)| log == Some(true));
        let Some(ends) = table.get("draw") else { return Node::List(Vec::new()) };
        let read = ends.get_ref().as_array().and_then(|items| range(items, log));
        read.unwrap_or_else(|| {
            let allowed = if log {
                "two numbers, both more than 0, ascending, one of them written as a float"
            } else {
                "two finite numbers, ascending; whole numbers at most 2^53"
            };
            self.refuse(&below(path, "draw"), ends, allowed);
            Node::List(Vec::new())
        })
    }

    /// `{ choose = [...] }`, with `weights = [...]` if wanted.
    fn choice(&mut self, path: &str, table: &DeTable<'_>) -> Node {
        self.close(path, table, &["choose", "weights"]);
        self.parts(path, table)
    }

    /// What `choose` and `weights` of a table say.
    fn parts(&mut self, path: &str, table: &DeTable<'_>) -> Node {
        let Some(choose) = table.get("choose") else { return Node::List(Vec::new()) };
        let items = choose.get_ref().as_array().filter(|items| !items.is_empty());
        let Some(items) = items else {
            self.refuse(&below(path, "choose"), choose, "a list of at least one value");
            return Node::List(Vec::new());
        };
        self.choices += 1;
        let read = items.iter().map(|item| self.node(path, item)).collect::<Vec<_>>();
        self.choices -= 1;
        let sums = table.get("weights").map_or_else(
            || sums(&vec![1.0; read.len()]),
            |weights| {
                let found = numbers(weights.get_ref()).filter(|found| found.len() == read.len());
                let sums = found.and_then(|found| sums(&found));
                if sums.is_none() {
                    let allowed =
                        format!("a list of {} numbers, none negative and not all of them 0", read.len());
                    self.refuse(&below(path, "weights"), weights, &allowed);
                }
                sums
            },
        );
        let places = items.iter().map(Item::span).collect();
        Node::Choice { items: read, sums: sums.unwrap_or_default(), places }
    }

    /// Notes a value that is not allowed.
    pub(super) fn refuse(&mut self, field: &str, value: &Item<'_>, allowed: &str) {
        let found = match value.get_ref() {
            DeValue::Array(items) => {
                let more = if items.len() > SHOWN { ", ..." } else { "" };
                let items: Vec<String> =
                    items.iter().take(SHOWN).map(|item| describe(item.get_ref())).collect();
                format!("[{}{more}]", items.join(", "))
            }
            other => describe(other),
        };
        let problem = Problem { span: value.span(), field: field.to_owned(), found, allowed: allowed.into() };
        self.problems.push(problem);
    }

    /// Notes every field of `table` but `known`.
    pub(super) fn close(&mut self, path: &str, table: &DeTable<'_>, known: &[&str]) {
        for (key, _) in table {
            if !known.contains(&key.get_ref().as_ref()) {
                let field = below(path, &printable(key.get_ref()));
                let (found, allowed) = ("not a field here".to_owned(), one_of(known.iter().copied()));
                self.problems.push(Problem { span: key.span(), field, found, allowed });
            }
        }
    }
}

fn range(items: &[Item<'_>], log: bool) -> Option<Node> {
    let [first, last] = items else { return None };
    let whole = |item: &Item<'_>| whole_signed(item.get_ref()).filter(|end| end.abs() <= WHOLE_MAX);
    if first.get_ref().is_integer() && last.get_ref().is_integer() {
        let (min, max) = (whole(first)?, whole(last)?);
        return (!log && min <= max).then_some(Node::Whole { min, max });
    }
    let (min, max) = (number(first.get_ref())?, number(last.get_ref())?);
    let allowed = min <= max && (max - min).is_finite() && (!log || min > 0.0);
    allowed.then_some(Node::Number { min, max, log })
}

fn numbers(value: &DeValue<'_>) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(|item| number(item.get_ref())).collect()
}

/// Sums of weights from the first on; `None` if a weight is negative or all are 0.
fn sums(weights: &[f64]) -> Option<Vec<f64>> {
    let mut sum = 0.0;
    let sums: Vec<f64> = weights
        .iter()
        .map(|weight| {
            sum += weight;
            sum
        })
        .collect();
    let allowed = weights.iter().all(|weight| *weight >= 0.0) && sum > 0.0 && sum.is_finite();
    allowed.then_some(sums)
}
