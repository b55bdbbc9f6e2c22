//! Parts of choices that can never be run, whatever else is drawn: mistakes of a text, which draws would pass over in silence.

use core::ops::Range;
use std::collections::BTreeMap;

use super::drawing::draw;
use super::tree::{Node, Root};
use super::{Plan, with_controller};
use crate::parse::{self, Problem};
use crate::random::Random;

/// A part of a choice that was not understood in so many draws of all the rest never is.
const TRIES: u64 = 64;

type Entries = BTreeMap<String, Node>;

impl Plan {
    /// What is wrong with every scenario that the text can draw, and with each part of a choice that no draw makes sense of:
    /// a field that does not exist, a value that is never allowed. What is refused for its team or its start alone is not
    /// looked at, because another draw may have the room.
    pub(super) fn never_read(&self) -> Vec<Problem> {
        let mut problems = self.unread(&self.root);
        if !problems.is_empty() {
            for problem in &mut problems {
                problem.span = self.place(&problem.field);
            }
            return problems;
        }
        let mut seen = Vec::new();
        for (place, root) in narrowed_root(&self.root) {
            // A part of a part that was refused is refused for the same reason.
            let within = |seen: &Range<usize>| seen.start <= place.start && place.end <= seen.end;
            if seen.iter().any(within) {
                continue;
            }
            let refused = self.unread(&root);
            if !refused.is_empty() {
                seen.push(place.clone());
                problems
                    .extend(refused.into_iter().map(|problem| Problem { span: place.clone(), ..problem }));
            }
        }
        problems
    }

    /// What the last of some draws was refused for before anybody looked at its team or start; nothing if one was understood.
    fn unread(&self, root: &Root) -> Vec<Problem> {
        let mut problems = Vec::new();
        for run in 0..TRIES {
            let (values, _) = draw(root, &mut Random::of_run(0, run));
            problems = self.misread(&values);
            if problems.is_empty() {
                break;
            }
        }
        problems
    }

    /// What is not understood in these values under the first controller that does not understand them.
    fn misread(&self, values: &toml::Table) -> Vec<Problem> {
        let read = |values: &toml::Table| parse::misread(&values.to_string(), &self.files);
        if self.controllers.is_empty() {
            return read(values);
        }
        let mut under = self.controllers.iter().map(|controller| read(&with_controller(values, *controller)));
        under.find(|problems| !problems.is_empty()).unwrap_or_default()
    }
}

/// For every part of every choice that can be drawn: where it stands, and the text in which it is the only one.
fn narrowed_root(root: &Root) -> Vec<(Range<usize>, Root)> {
    let entries = narrowed(&root.entries).into_iter();
    let entries = entries.map(|(place, entries)| (place, Root { entries, ..root.clone() }));
    let together = root.together.iter().flat_map(narrowed_node);
    let together = together.map(|(place, node)| (place, Root { together: Some(node), ..root.clone() }));
    entries.chain(together).collect()
}

/// The same for the entries of a table.
fn narrowed(entries: &Entries) -> Vec<(Range<usize>, Entries)> {
    let with = |key: &String, node| {
        let mut entries = entries.clone();
        entries.insert(key.clone(), node);
        entries
    };
    let of = |(key, node): (&String, &Node)| {
        let parts = narrowed_node(node).into_iter();
        parts.map(|(place, node)| (place, with(key, node))).collect::<Vec<_>>()
    };
    entries.iter().flat_map(of).collect()
}

/// The same for one node. Parts come before their parts.
fn narrowed_node(node: &Node) -> Vec<(Range<usize>, Node)> {
    match node {
        Node::Table(entries) => {
            narrowed(entries).into_iter().map(|(place, entries)| (place, Node::Table(entries))).collect()
        }
        Node::List(items) => narrowed_list(items),
        Node::Choice { items, sums, places } => {
            let before = core::iter::once(&0.0).chain(sums);
            let drawn = before.zip(sums).map(|(before, sum)| before < sum);
            let parts = items.iter().zip(places).zip(drawn).filter(|(_, drawn)| *drawn);
            parts.flat_map(|((item, place), _)| narrowed_part(item, place)).collect()
        }
        Node::Plain(_) | Node::Whole { .. } | Node::Number { .. } => Vec::new(),
    }
}

fn narrowed_list(items: &[Node]) -> Vec<(Range<usize>, Node)> {
    let of = |(index, node)| {
        let with = move |(place, node)| {
            let mut items = items.to_vec();
            items[index] = node;
            (place, Node::List(items))
        };
        narrowed_node(node).into_iter().map(with).collect::<Vec<_>>()
    };
    items.iter().enumerate().flat_map(of).collect()
}

/// A part of a choice, and then the parts of it.
fn narrowed_part(item: &Node, place: &Range<usize>) -> Vec<(Range<usize>, Node)> {
    let alone = |item, place: Range<usize>| {
        (place.clone(), Node::Choice { items: vec![item], sums: vec![1.0], places: vec![place] })
    };
    let inner = narrowed_node(item).into_iter().map(|(place, item)| alone(item, place));
    core::iter::once(alone(item.clone(), place.clone())).chain(inner).collect()
}
