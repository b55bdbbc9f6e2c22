//! From a tree with draws to plain values.

use std::collections::BTreeMap;

use closeranks_core::num::exp;
use toml::Value;

use super::tree::{Node, Root, TOGETHER, below};
use crate::random::Random;

/// What a drawn field has in one run.
#[derive(Clone, Debug, PartialEq)]
pub enum Drawn {
    /// A number.
    Number(f64),
    /// A word, or a list as TOML.
    Text(String),
}

/// Draws in the order of the tree and notes what was drawn.
struct Drawer<'a> {
    /// The generator of the draws.
    random: &'a mut Random,
    /// Every drawn field by its full name.
    drawn: BTreeMap<String, Drawn>,
}

/// The values of a text, and every drawn field by its full name.
pub(super) fn draw(root: &Root, random: &mut Random) -> (toml::Table, BTreeMap<String, Drawn>) {
    let mut drawer = Drawer { random, drawn: BTreeMap::new() };
    let entries = root.entries.iter();
    let mut values: toml::Table = entries.map(|(key, node)| (key.clone(), drawer.value(key, node))).collect();
    let mut drawn = core::mem::take(&mut drawer.drawn);
    if let Some(Value::Table(chosen)) = root.together.as_ref().map(|node| drawer.value("", node)) {
        drawn.retain(|path, _| {
            let top = path.split(['.', '[']).next().unwrap_or_default();
            !chosen.contains_key(top)
        });
        values.extend(chosen);
        let name = drawer.drawn.remove("").map(|name| (TOGETHER.to_owned(), name));
        drawn.extend(drawer.drawn.into_iter().chain(name));
    }
    (values, drawn)
}

impl Drawer<'_> {
    /// The value of `node`; it is noted if it was drawn.
    fn value(&mut self, path: &str, node: &Node) -> Value {
        match node {
            Node::Plain(value) => value.clone(),
            Node::Table(entries) => Value::Table(
                entries
                    .iter()
                    .map(|(key, node)| (key.clone(), self.value(&below(path, key), node)))
                    .collect(),
            ),
            Node::List(items) => {
                let items = items.iter().enumerate();
                Value::Array(
                    items.map(|(index, node)| self.value(&format!("{path}[{index}]"), node)).collect(),
                )
            }
            _ => {
                let value = self.draw(path, node);
                self.note(path, &value);
                value
            }
        }
    }

    fn draw(&mut self, path: &str, node: &Node) -> Value {
        match node {
            Node::Whole { min, max } => Value::Integer(min + self.step(max.abs_diff(*min))),
            Node::Number { min, max, log: false } => Value::Float(self.random.uniform(*min, *max)),
            Node::Number { min, max, log: true } => Value::Float(self.log_uniform(*min, *max)),
            Node::Choice { items, sums, .. } => self.choose(path, items, sums),
            // What stands inside of a choice is noted by the choice, and a list without tables is noted as a whole.
            Node::Plain(value) => value.clone(),
            Node::Table(entries) => Value::Table(
                entries.iter().map(|(key, node)| (key.clone(), self.draw(&below(path, key), node))).collect(),
            ),
            Node::List(items) => Value::Array(items.iter().map(|node| self.draw(path, node)).collect()),
        }
    }

    /// A whole number from 0 to `width`, both included.
    fn step(&mut self, width: u64) -> i64 {
        i64::try_from(self.random.below(width + 1)).unwrap_or(0)
    }

    /// A number drawn evenly in the logarithm. The logarithm of libm and our exponential give the same bits everywhere.
    fn log_uniform(&mut self, min: f64, max: f64) -> f64 {
        let power = self.random.uniform(libm::log(min), libm::log(max));
        exp(power).max(min).min(max)
    }

    fn choose(&mut self, path: &str, items: &[Node], sums: &[f64]) -> Value {
        let point = self.random.uniform(0.0, sums.last().copied().unwrap_or(1.0));
        let place = sums.iter().position(|sum| point < *sum).unwrap_or(0);
        let value = items.get(place).map_or(Value::Boolean(false), |item| self.draw(path, item));
        if let Value::Table(entries) = &value {
            self.name(path, entries);
        }
        value
    }

    /// A chosen table without a `kind` goes by the names of its fields.
    fn name(&mut self, path: &str, entries: &toml::Table) {
        if !entries.contains_key("kind") {
            let names: Vec<&str> = entries.keys().map(String::as_str).collect();
            let name = if names.is_empty() { "nothing".to_owned() } else { names.join(" + ") };
            self.drawn.insert(path.to_owned(), Drawn::Text(name));
        }
    }

    /// Notes a drawn value. Of a table every field is noted, and so is every table of a list.
    fn note(&mut self, path: &str, value: &Value) {
        let drawn = match value {
            Value::Table(entries) => {
                return entries.iter().for_each(|(key, value)| self.note(&below(path, key), value));
            }
            Value::Array(items) if items.iter().any(Value::is_table) => {
                let items = items.iter().enumerate();
                return items.for_each(|(index, item)| self.note(&format!("{path}[{index}]"), item));
            }
            #[expect(clippy::cast_precision_loss, reason = "beyond 2^53 no field has a meaning")]
            Value::Integer(whole) => Drawn::Number(*whole as f64),
            Value::Float(number) => Drawn::Number(*number),
            Value::String(text) => Drawn::Text(text.clone()),
            other => Drawn::Text(other.to_string()),
        };
        self.drawn.insert(path.to_owned(), drawn);
    }
}
