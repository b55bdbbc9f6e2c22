//! A graph in the making, node by node and edge by edge, as the lines of a text have them.

use alloc::collections::BTreeSet;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::NAME_LIMIT;
use super::error::{FormatError, Problem};
use super::index::Index;
use super::links::Links;
use super::note::Note;
use crate::graph::set::NODE_LIMIT;
use crate::network::{NETWORK_LIMIT, Network};

/// What a reader has made of a text.
pub(super) struct Draft {
    pub(super) network: Network,
    /// The name of each node.
    pub(super) names: Vec<String>,
    /// The line with the first node that a graph for exact search has no place for.
    pub(super) beyond: Option<usize>,
    pub(super) notes: Vec<Note>,
    /// The first parallel link or loop, as an error.
    pub(super) repeat: Option<FormatError>,
}

/// Nodes with their names and labels, and pairs (u, v) of nodes of which v hears u.
pub(super) struct Builder {
    directed: bool,
    names: Vec<String>,
    labels: Vec<String>,
    numbers: Index,
    beyond: Option<usize>,
    links: Links,
    one_way: bool,
    loops: usize,
    /// The node and the line of the first.
    first_loop: Option<(usize, usize)>,
    notes: Vec<Note>,
}

impl Builder {
    /// No nodes yet. `directed` is what [`Builder::edge`] makes.
    pub(super) fn new(directed: bool) -> Self {
        Self {
            directed,
            names: Vec::new(),
            labels: Vec::new(),
            numbers: Index::default(),
            beyond: None,
            links: Links::default(),
            one_way: false,
            loops: 0,
            first_loop: None,
            notes: Vec::new(),
        }
    }

    /// For lists in which each end may name the other: a link u — v is not parallel to v — u.
    pub(super) fn told_from_both_ends(mut self) -> Self {
        self.links.each_end = true;
        self
    }

    /// What the graph is, beside its one-way edges.
    pub(super) fn set_directed(&mut self, directed: bool) {
        self.directed = directed;
    }

    pub(super) fn is_directed(&self) -> bool {
        self.directed
    }

    pub(super) fn note(&mut self, note: Note) {
        self.notes.push(note);
    }

    /// The node of this name, new if it must be.
    pub(super) fn node(&mut self, name: &str, line: usize) -> Result<usize, FormatError> {
        match self.numbers.get(name) {
            Some(number) => Ok(number),
            None => self.declare(name, line),
        }
    }

    /// The node of this name, which must be new.
    pub(super) fn declare(&mut self, name: &str, line: usize) -> Result<usize, FormatError> {
        let problem = if self.numbers.get(name).is_some() {
            Problem::NodeTwice { name: name.to_string() }
        } else if name.is_empty() || name.len() > NAME_LIMIT {
            Problem::Name { bytes: name.len() }
        } else if self.names.len() == NETWORK_LIMIT {
            Problem::TooManyNodes
        } else {
            let number = self.names.len();
            if number == NODE_LIMIT {
                self.beyond.get_or_insert(line);
            }
            self.names.push(name.to_string());
            self.labels.push(String::new());
            self.numbers.insert(name, number);
            return Ok(number);
        };
        Err(FormatError::new(line, problem))
    }

    /// So many nodes with the names `first`, `first + 1`, …
    pub(super) fn declare_numbers(
        &mut self,
        first: usize,
        count: usize,
        line: usize,
    ) -> Result<(), FormatError> {
        (first..first.saturating_add(count))
            .try_for_each(|number| self.declare(&number.to_string(), line).map(|_| ()))
    }

    /// The node of this name, which must be there.
    pub(super) fn known(&self, name: &str, line: usize) -> Result<usize, FormatError> {
        let unknown = || {
            let name = name.chars().take(NAME_LIMIT).collect();
            FormatError::new(line, Problem::UnknownNode { name })
        };
        self.numbers.get(name).ok_or_else(unknown)
    }

    /// What a person calls the node, if the text has such a thing beside its name.
    pub(super) fn label(&mut self, node: usize, label: &str) {
        if let Some(place) = self.labels.get_mut(node) {
            *place = label.to_string();
        }
    }

    /// An edge of the kind that the graph has.
    pub(super) fn edge(&mut self, from: usize, to: usize, line: usize) {
        self.link(from, to, !self.directed, line);
    }

    /// An edge, heard by both of its ends or by `to` alone.
    pub(super) fn link(&mut self, from: usize, to: usize, both: bool, line: usize) {
        if from == to {
            self.loops += 1;
            self.first_loop.get_or_insert((from, line));
            return;
        }
        self.one_way |= !both;
        self.links.push((from, to), line, both);
    }

    /// Parallel links are no news from now on, as in a DOT graph that says `strict`.
    pub(super) fn expect_parallel(&mut self) {
        self.links.expected = true;
    }

    /// Refuses two names that are one number, such as `1` and `01`.
    pub(super) fn refuse_same_numbers(&self, line: usize) -> Result<(), FormatError> {
        let value = |name: &String| name.parse::<f64>().ok().filter(|value| value.is_finite());
        let mut numbers: Vec<(f64, &String)> =
            self.names.iter().filter_map(|name| Some((value(name)?, name))).collect();
        numbers.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        for pair in numbers.windows(2) {
            if let [(a, first), (b, second)] = pair
                && a == b
            {
                let (first, second) = ((*first).clone(), (*second).clone());
                return Err(FormatError::new(line, Problem::SameNumber { first, second }));
            }
        }
        Ok(())
    }

    /// So many columns were passed over.
    pub(super) fn notes_columns(&mut self, count: usize) {
        self.notes.extend((count > 0).then_some(Note::Columns(count)));
    }

    /// The graph, its nodes in the order of the text. `line` is the last one.
    pub(super) fn finish(self, line: usize) -> Result<Draft, FormatError> {
        let order: Vec<usize> = (0..self.names.len()).collect();
        self.in_order(&order, line)
    }

    /// Gives the graph under the labels of its nodes, if every node has one of its own.
    pub(super) fn finish_labelled(mut self, line: usize) -> Result<Draft, FormatError> {
        let different: BTreeSet<&String> = self.labels.iter().collect();
        let fit = |label: &String| !label.is_empty() && label.len() <= NAME_LIMIT;
        if different.len() == self.labels.len() && self.labels.iter().all(fit) {
            self.names = core::mem::take(&mut self.labels);
        }
        self.finish(line)
    }

    /// The graph, its nodes by number if all names are numbers, otherwise in the order of the text.
    pub(super) fn finish_by_number(self, line: usize) -> Result<Draft, FormatError> {
        let number = |index: usize| self.names[index].parse::<u64>().ok();
        let mut order: Vec<usize> = (0..self.names.len()).collect();
        if order.iter().all(|&index| number(index).is_some()) {
            order.sort_by_key(|&index| number(index));
        }
        self.in_order(&order, line)
    }

    fn in_order(mut self, order: &[usize], line: usize) -> Result<Draft, FormatError> {
        let mut rank: Vec<usize> = order.to_vec();
        for (place, &index) in order.iter().enumerate() {
            rank[index] = place;
        }
        let directed = self.directed || self.one_way;
        if order.is_empty() {
            return Err(FormatError::new(line, Problem::NoNodes));
        }
        let small = |node: usize| u32::try_from(rank[node]).unwrap_or(u32::MAX);
        let pairs = self.links.pairs().map(|(from, to)| (small(from as usize), small(to as usize))).collect();
        let network = Network::of_heard(order.len(), directed, pairs);
        let told = self.links.told();
        let repeat = self.repeat(told.first);
        let names = order.iter().map(|&index| core::mem::take(&mut self.names[index])).collect();
        let mut notes = self.notes;
        notes.extend((told.parallel > 0).then_some(Note::Parallel(told.parallel)));
        notes.extend((self.loops > 0).then_some(Note::Loops(self.loops)));
        notes.extend((directed && told.both_ways > 0).then_some(Note::BothWays(told.both_ways)));
        Ok(Draft { network, names, beyond: self.beyond, notes, repeat })
    }

    /// The first loop or parallel link as an error, whichever comes first.
    fn repeat(&self, parallel: Option<(usize, usize, usize)>) -> Option<FormatError> {
        let name = |node: usize| self.names.get(node).cloned().unwrap_or_default();
        match (self.first_loop, parallel) {
            (Some((node, line)), parallel) if parallel.is_none_or(|(.., other)| line <= other) => {
                Some(FormatError::new(line, Problem::Loop { node: name(node) }))
            }
            (_, Some((from, to, line))) => {
                let (from, to) = (name(from), name(to));
                Some(FormatError::new(line, Problem::DoubleEdge { from, to }))
            }
            _ => None,
        }
    }
}
