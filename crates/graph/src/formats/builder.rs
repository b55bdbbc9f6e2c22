//! A graph in the making, node by node and edge by edge, as the lines of a text have them.

use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::error::{FormatError, Problem};
use super::{NAME_LIMIT, Named};
use crate::graph::Graph;
use crate::set::NODE_LIMIT;

pub(super) struct Builder {
    directed: bool,
    names: Vec<String>,
    numbers: BTreeMap<String, usize>,
    edges: Vec<(usize, usize, usize)>,
}

impl Builder {
    pub(super) fn new(directed: bool) -> Self {
        Self { directed, names: Vec::new(), numbers: BTreeMap::new(), edges: Vec::new() }
    }

    pub(super) fn is_directed(&self) -> bool {
        self.directed
    }

    /// The node of this name, new if it must be.
    pub(super) fn node(&mut self, name: &str, line: usize) -> Result<usize, FormatError> {
        match self.numbers.get(name) {
            Some(&number) => Ok(number),
            None => self.declare(name, line),
        }
    }

    /// The node of this name, which must be new.
    pub(super) fn declare(&mut self, name: &str, line: usize) -> Result<usize, FormatError> {
        let problem = if self.numbers.contains_key(name) {
            Problem::NodeTwice { name: name.to_string() }
        } else if name.is_empty() || name.len() > NAME_LIMIT {
            Problem::Name { bytes: name.len() }
        } else if self.names.len() == NODE_LIMIT {
            Problem::TooManyNodes
        } else {
            let number = self.names.len();
            self.names.push(name.to_string());
            self.numbers.insert(name.to_string(), number);
            return Ok(number);
        };
        Err(FormatError { line, problem })
    }

    /// The node of this name, which must be there.
    pub(super) fn known(&self, name: &str, line: usize) -> Result<usize, FormatError> {
        let unknown = || {
            let name = name.chars().take(NAME_LIMIT).collect();
            FormatError { line, problem: Problem::UnknownNode { name } }
        };
        self.numbers.get(name).copied().ok_or_else(unknown)
    }

    pub(super) fn edge(&mut self, from: usize, to: usize, line: usize) -> Result<(), FormatError> {
        let name = |node: usize| self.names.get(node).cloned().unwrap_or_default();
        if from == to {
            return Err(FormatError { line, problem: Problem::Loop { node: name(from) } });
        }
        // More edges than a graph can have: one of them is there twice, and `finish` says which.
        if self.edges.len() <= NODE_LIMIT * NODE_LIMIT {
            self.edges.push((from, to, line));
        }
        Ok(())
    }

    /// The graph, its nodes in the order of the text.
    pub(super) fn finish(self, line: usize) -> Result<Named, FormatError> {
        let order: Vec<usize> = (0..self.names.len()).collect();
        self.in_order(&order, line)
    }

    /// The graph, its nodes by number if all names are numbers, otherwise in the order of the text.
    pub(super) fn finish_by_number(self, line: usize) -> Result<Named, FormatError> {
        let number = |index: usize| self.names[index].parse::<u64>().ok();
        let mut order: Vec<usize> = (0..self.names.len()).collect();
        if order.iter().all(|&index| number(index).is_some()) {
            order.sort_by_key(|&index| number(index));
        }
        self.in_order(&order, line)
    }

    fn in_order(mut self, order: &[usize], line: usize) -> Result<Named, FormatError> {
        let mut rank: Vec<usize> = order.to_vec();
        for (place, &index) in order.iter().enumerate() {
            rank[index] = place;
        }
        let mut graph = Graph::empty(order.len(), self.directed)
            .map_err(|_| FormatError { line, problem: Problem::NoNodes })?;
        for &(from, to, line) in &self.edges {
            if graph.add_edge(rank[from], rank[to]).is_err() {
                let (from, to) = (self.names[from].clone(), self.names[to].clone());
                return Err(FormatError { line, problem: Problem::DoubleEdge { from, to } });
            }
        }
        let names = order.iter().map(|&index| core::mem::take(&mut self.names[index])).collect();
        Ok(Named { graph, names })
    }

    /// Forgets edges that are there already, as DOT's `strict` demands.
    pub(super) fn merge_double_edges(&mut self) {
        let directed = self.directed;
        let ends = |from: usize, to: usize| if directed || from < to { (from, to) } else { (to, from) };
        let mut seen = alloc::collections::BTreeSet::new();
        self.edges.retain(|&(from, to, _)| seen.insert(ends(from, to)));
    }
}
