//! Statements of DOT: nodes, chains of edges, subgraphs.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use super::token::Token;
use super::{DEPTH_LIMIT, Reader, unexpected};
use crate::formats::error::FormatError;

/// Which ends hear the other.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Direction {
    Forward,
    Back,
    Both,
}

impl Reader<'_> {
    /// One statement; gives the nodes it names.
    pub(super) fn statement(&mut self) -> Result<BTreeSet<usize>, FormatError> {
        let line = self.line;
        match &self.next {
            Token::Sign(';' | ',') => {
                self.step()?;
                Ok(BTreeSet::new())
            }
            Token::Keyword(word @ ("graph" | "node" | "edge")) => {
                let is_edge = *word == "edge";
                self.step()?;
                match self.attributes()? {
                    Some(direction) if is_edge => {
                        let allowed = "dir at the edges themselves, not for all of them";
                        Err(FormatError::unexpected(line, &direction, allowed))
                    }
                    _ => Ok(BTreeSet::new()),
                }
            }
            Token::Name(_) | Token::Keyword("subgraph") | Token::Sign('{') => self.chain(),
            other => Err(unexpected(line, other, "a node, an edge, a subgraph, an attribute or }")),
        }
    }

    /// Nodes or groups of nodes, joined by edges, and attributes; or `key = value`.
    fn chain(&mut self) -> Result<BTreeSet<usize>, FormatError> {
        let line = self.line;
        let Some(first) = self.group()? else {
            return Ok(BTreeSet::new());
        };
        let mut groups = Vec::from([first]);
        while matches!(self.next, Token::Arrow | Token::Dashes) {
            let line = self.line;
            let sign = self.step()?;
            if (sign == Token::Arrow) != self.builder.is_directed() {
                return Err(unexpected(line, &sign, "-> in a digraph, -- in a graph"));
            }
            match self.group()? {
                Some(group) => groups.push(group),
                None => return Err(unexpected(line, &self.next, "the name of a node")),
            }
        }
        let direction = self.attributes()?;
        if groups.len() > 1 {
            let direction = self.direction(direction.as_deref(), line)?;
            groups.windows(2).for_each(|pair| self.join(&pair[0], &pair[1], direction, line));
        }
        Ok(groups.into_iter().flatten().collect())
    }

    /// Every node of one group with every node of the other.
    fn join(&mut self, from: &BTreeSet<usize>, to: &BTreeSet<usize>, direction: Direction, line: usize) {
        for &from in from {
            for &to in to {
                match direction {
                    Direction::Forward => self.builder.link(from, to, false, line),
                    Direction::Back => self.builder.link(to, from, false, line),
                    Direction::Both => self.builder.link(from, to, true, line),
                }
            }
        }
    }

    /// What an attribute `dir` makes of an edge. In a graph without directions it has no place.
    fn direction(&self, said: Option<&str>, line: usize) -> Result<Direction, FormatError> {
        match (said, self.builder.is_directed()) {
            (None | Some("forward"), true) => Ok(Direction::Forward),
            (Some("back"), true) => Ok(Direction::Back),
            (None | Some("none"), false) | (Some("both" | "none"), true) => Ok(Direction::Both),
            (Some(other), true) => {
                Err(FormatError::unexpected(line, other, "dir=forward, back, both or none"))
            }
            (Some(other), false) => {
                Err(FormatError::unexpected(line, other, "no dir in a graph, or a digraph with ->"))
            }
        }
    }

    /// A node with its port, or a subgraph; nothing if it was `key = value`.
    fn group(&mut self) -> Result<Option<BTreeSet<usize>>, FormatError> {
        let line = self.line;
        match self.step()? {
            Token::Name(_) if self.next == Token::Sign('=') => {
                self.step()?;
                self.step().map(|_| None)
            }
            Token::Name(name) => {
                let node = self.builder.node(&name, line)?;
                self.port()?;
                Ok(Some(BTreeSet::from([node])))
            }
            Token::Keyword("subgraph") => {
                if let Token::Name(_) = self.next {
                    self.step()?;
                }
                self.expect(&Token::Sign('{'), "{ after subgraph")?;
                self.braces(line).map(Some)
            }
            Token::Sign('{') => self.braces(line).map(Some),
            other => Err(unexpected(line, &other, "the name of a node, or a group { … }")),
        }
    }

    /// The nodes of all statements up to the closing brace.
    fn braces(&mut self, line: usize) -> Result<BTreeSet<usize>, FormatError> {
        if self.depth == DEPTH_LIMIT {
            return Err(FormatError::unexpected(line, "{", "at most 64 levels of subgraphs"));
        }
        self.depth += 1;
        let mut nodes = BTreeSet::new();
        while self.next != Token::Sign('}') {
            nodes.extend(self.statement()?);
        }
        self.step()?;
        self.depth -= 1;
        Ok(nodes)
    }

    fn port(&mut self) -> Result<(), FormatError> {
        while self.next == Token::Sign(':') {
            self.step()?;
            self.step()?;
        }
        Ok(())
    }
}
