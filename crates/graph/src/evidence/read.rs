//! Reads evidence line by line, as `text.rs` describes it.

use alloc::vec::Vec;
use core::fmt;
use core::str::FromStr;

use super::{Claim, Evidence};
use crate::network::{NETWORK_LIMIT, Network};
use crate::ranks::Order;
use crate::roles::{Choice, Refutation, Root};
use crate::spectrum::Bounds;

pub(super) const FIRST_LINE: &str = "closeranks certificate 1";

/// Text that is no evidence: the line, from 1, and what is allowed there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EvidenceError {
    /// The line, from 1.
    pub line: usize,
    /// What is allowed there.
    pub allowed: &'static str,
}

impl fmt::Display for EvidenceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: allowed is {}", self.line, self.allowed)
    }
}

impl core::error::Error for EvidenceError {}

/// The lines of a text that are still to be read.
pub(super) struct Lines<'a> {
    rest: core::str::Lines<'a>,
    line: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text.lines(), line: 0 }
    }

    /// All of the text.
    pub(super) fn evidence(&mut self) -> Result<Evidence, EvidenceError> {
        let network = self.network()?;
        let claim = self.claim(network.node_count())?;
        match self.next() {
            None => Ok(Evidence { network, claim }),
            Some(_) => Err(self.refuse("the end of the text")),
        }
    }

    /// The next line that is no remark.
    fn next(&mut self) -> Option<&'a str> {
        loop {
            self.line += 1;
            let line = self.rest.next()?;
            if !line.starts_with('#') {
                return Some(line);
            }
        }
    }

    fn refuse(&self, allowed: &'static str) -> EvidenceError {
        EvidenceError { line: self.line, allowed }
    }

    fn network(&mut self) -> Result<Network, EvidenceError> {
        if self.next() != Some(FIRST_LINE) {
            return Err(self.refuse("`closeranks certificate 1`"));
        }
        let counts: Vec<usize> = self.numbers("nodes", "`nodes` and a number from 1 to 4,194,304")?;
        let &[count @ 1..=NETWORK_LIMIT] = &counts[..] else {
            return Err(self.refuse("`nodes` and a number from 1 to 4,194,304"));
        };
        let mut edges = Vec::new();
        for node in 0..count {
            self.hears(node, count, &mut edges)?;
        }
        Ok(Network::new(count, true, &edges))
    }

    fn hears(&mut self, node: usize, count: usize, edges: &mut Vec<(u32, u32)>) -> Result<(), EvidenceError> {
        const ALLOWED: &str = "`hears`, the number of the node, and the other nodes that it hears, rising";
        let numbers: Vec<u32> = self.numbers("hears", ALLOWED)?;
        let Some((&own, heard)) = numbers.split_first() else { return Err(self.refuse(ALLOWED)) };
        let rising = heard.windows(2).all(|pair| pair[0] < pair[1]);
        let inside = heard.iter().all(|other| (*other as usize) < count && *other != own);
        if own as usize != node || !rising || !inside {
            return Err(self.refuse(ALLOWED));
        }
        edges.extend(heard.iter().map(|other| (*other, own)));
        Ok(())
    }

    fn claim(&mut self, count: usize) -> Result<Claim, EvidenceError> {
        const ALLOWED: &str = "`not-robust R S`, `robust-by-degrees R`, `robust-by-search R S`, `robust-by-eigenvalues R S` with S of at most n, `ranks F` or `ranks-by-search F`";
        let line = self.next().ok_or_else(|| self.refuse(ALLOWED))?;
        let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
        let numbers: Option<Vec<usize>> = all(rest);
        match (word, numbers.as_deref()) {
            ("not-robust", Some(&[r, s])) => {
                Ok(Claim::NotRobust { r, s, sets: [self.nodes("set", count)?, self.nodes("set", count)?] })
            }
            ("robust-by-degrees", Some(&[r])) => Ok(Claim::Degrees { r }),
            ("ranks", Some(&[f])) if f <= NETWORK_LIMIT => Ok(Claim::Ranks(self.order(f, count)?)),
            ("robust-by-search", Some(&[r, s])) => Ok(Claim::Search { r, s, refutation: self.roots(count)? }),
            ("robust-by-eigenvalues", Some(&[r, s])) if s <= count => {
                Ok(Claim::Eigenvalues { r, s, bounds: self.bounds(count)? })
            }
            ("ranks-by-search", Some(&[f])) if f <= NETWORK_LIMIT => {
                Ok(Claim::SearchedRanks { order: self.order(f, count)?, refutation: self.roots(count)? })
            }
            _ => Err(self.refuse(ALLOWED)),
        }
    }

    fn order(&mut self, f: usize, count: usize) -> Result<Order, EvidenceError> {
        Ok(Order { f, core: self.nodes("core", count)?, rest: self.nodes("rest", count)? })
    }

    fn bounds(&mut self, count: usize) -> Result<Bounds, EvidenceError> {
        let (least, low) = self.triangle("low", count)?;
        let (most, high) = self.triangle("high", count)?;
        Ok(Bounds { ends: [least, most], triangles: [low, high] })
    }

    fn triangle(&mut self, word: &str, count: usize) -> Result<(i64, Vec<Vec<i64>>), EvidenceError> {
        const ALLOWED: &str = "`low` or `high` and a whole number, then for each node `row` and whole numbers of up to 13 digits";
        let numbers: Vec<u32> = self.numbers(word, ALLOWED)?;
        let &[end] = &numbers[..] else { return Err(self.refuse(ALLOWED)) };
        let rows = (0..count).map(|_| {
            let line = self.next().ok_or_else(|| self.refuse(ALLOWED))?;
            let rest = line.strip_prefix("row").filter(|rest| rest.is_empty() || rest.starts_with(' '));
            let words = rest.ok_or_else(|| self.refuse(ALLOWED))?.split(' ').filter(|word| !word.is_empty());
            words.map(|word| signed(word).ok_or_else(|| self.refuse(ALLOWED))).collect()
        });
        Ok((i64::from(end), rows.collect::<Result<_, _>>()?))
    }

    fn roots(&mut self, count: usize) -> Result<Refutation, EvidenceError> {
        const ALLOWED: &str = "`roots` and the number of roots, at most as many as there are nodes";
        let roots: Vec<usize> = self.numbers("roots", ALLOWED)?;
        let &[roots] = &roots[..] else { return Err(self.refuse(ALLOWED)) };
        if roots > count {
            return Err(self.refuse(ALLOWED));
        }
        Ok(Refutation { roots: (0..roots).map(|_| self.root()).collect::<Result<_, _>>()? })
    }

    fn root(&mut self) -> Result<Root, EvidenceError> {
        const ALLOWED: &str = "`root`, a node, and pairs of a node and a sum of roles from 1 to 31";
        let numbers: Vec<u32> = self.numbers("root", ALLOWED)?;
        let Some((&node, pairs)) = numbers.split_first() else { return Err(self.refuse(ALLOWED)) };
        let choice = |pair: &[u32]| match *pair {
            [node, roles @ 1..=31] => u8::try_from(roles).ok().map(|roles| Choice { node, roles }),
            _ => None,
        };
        let choices: Option<Vec<Choice>> = pairs.chunks(2).map(choice).collect();
        Ok(Root { node, choices: choices.ok_or_else(|| self.refuse(ALLOWED))? })
    }

    /// A set of nodes; at most as many as the network has.
    fn nodes(&mut self, word: &str, count: usize) -> Result<Vec<u32>, EvidenceError> {
        const ALLOWED: &str = "`set`, `core` or `rest`, as the claim asks, and numbers of nodes";
        let nodes: Vec<u32> = self.numbers(word, ALLOWED)?;
        if nodes.len() <= count { Ok(nodes) } else { Err(self.refuse(ALLOWED)) }
    }

    fn numbers<N: FromStr>(&mut self, word: &str, allowed: &'static str) -> Result<Vec<N>, EvidenceError> {
        let line = self.next().ok_or_else(|| self.refuse(allowed))?;
        let rest = line.strip_prefix(word).filter(|rest| rest.is_empty() || rest.starts_with(' '));
        rest.and_then(all).ok_or_else(|| self.refuse(allowed))
    }
}

/// A whole number of up to 13 digits, perhaps with a minus.
fn signed(word: &str) -> Option<i64> {
    let digits = word.strip_prefix('-').unwrap_or(word);
    let is_number = (1..=13).contains(&digits.len()) && digits.bytes().all(|byte| byte.is_ascii_digit());
    word.parse().ok().filter(|_| is_number)
}

/// All numbers of a line, written with digits alone.
fn all<N: FromStr>(text: &str) -> Option<Vec<N>> {
    let digits = |word: &str| word.bytes().all(|byte| byte.is_ascii_digit());
    let words = text.split(' ').filter(|word| !word.is_empty());
    words.map(|word| word.parse().ok().filter(|_| digits(word))).collect()
}
