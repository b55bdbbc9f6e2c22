//! Evidence as text: one line for each thing, in a fixed order, nodes as numbers from 0.
//!
//! ```text
//! closeranks certificate 1
//! nodes 4                       then a line a node: the node, and whom it hears, rising
//! hears 0 1 2
//! hears 1 0
//! hears 2 0 1
//! hears 3 2
//! not-robust 2 1                the claim, here r and s
//! set 0 1                       what proves it, here S₁ and S₂
//! set 3
//! ```
//!
//! | claim | then |
//! | --- | --- |
//! | `not-robust R S` | `set ..` twice |
//! | `robust-by-degrees R` | |
//! | `ranks F` | `core ..`, `rest ..` |
//! | `robust-by-search R S` | `roots N`, N lines `root ..` |
//! | `ranks-by-search F` | `core ..`, `rest ..`, `roots N`, N lines `root ..` |
//!
//! A line `root` has the node that is honest in S₁, then pairs of a node and a sum of roles, as [`crate::roles::Choice`] says; of
//! `ranks-by-search` nodes are places in the core, from 0. Lines that begin with `#` are remarks.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::{self, Write as _};
use core::str::FromStr;

use super::{Claim, Evidence};
use crate::formats::NETWORK_TEXT_LIMIT;
use crate::network::{NETWORK_LIMIT, Network};
use crate::ranks::Order;
use crate::roles::{Choice, Refutation, Root};

const FIRST_LINE: &str = "closeranks certificate 1";

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

impl Evidence {
    /// As text that [`Evidence::from_text`] and the proved checker read.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        let _ = writeln!(text, "{FIRST_LINE}\nnodes {}", self.network.node_count());
        for node in 0..self.network.node_count() {
            let _ = write!(text, "hears {node}");
            push(&mut text, self.network.heard(node));
        }
        match &self.claim {
            Claim::NotRobust { r, s, sets } => {
                let _ = writeln!(text, "not-robust {r} {s}");
                for set in sets {
                    text.push_str("set");
                    push(&mut text, set);
                }
            }
            Claim::Degrees { r } => drop(writeln!(text, "robust-by-degrees {r}")),
            Claim::Ranks(order) => {
                let _ = writeln!(text, "ranks {}", order.f);
                push_order(&mut text, order);
            }
            Claim::Search { r, s, refutation } => {
                let _ = writeln!(text, "robust-by-search {r} {s}");
                push_roots(&mut text, refutation);
            }
            Claim::SearchedRanks { order, refutation } => {
                let _ = writeln!(text, "ranks-by-search {}", order.f);
                push_order(&mut text, order);
                push_roots(&mut text, refutation);
            }
        }
        text
    }

    /// Reads what [`Evidence::text`] writes, and remarks. That it can be read does not mean that it proves anything.
    pub fn from_text(text: &str) -> Result<Self, EvidenceError> {
        if text.len() > NETWORK_TEXT_LIMIT {
            return Err(EvidenceError { line: 1, allowed: "a text of at most 268,435,456 bytes" });
        }
        let mut lines = Lines { rest: text.lines(), line: 0 };
        let network = lines.network()?;
        let claim = lines.claim(network.node_count())?;
        match lines.next() {
            None => Ok(Self { network, claim }),
            Some(_) => Err(lines.refuse("the end of the text")),
        }
    }
}

fn push(text: &mut String, nodes: &[u32]) {
    for node in nodes {
        let _ = write!(text, " {node}");
    }
    text.push('\n');
}

fn push_order(text: &mut String, order: &Order) {
    text.push_str("core");
    push(text, &order.core);
    text.push_str("rest");
    push(text, &order.rest);
}

fn push_roots(text: &mut String, refutation: &Refutation) {
    let _ = writeln!(text, "roots {}", refutation.roots.len());
    for Root { node, choices } in &refutation.roots {
        let _ = write!(text, "root {node}");
        for Choice { node, roles } in choices {
            let _ = write!(text, " {node} {roles}");
        }
        text.push('\n');
    }
}

struct Lines<'a> {
    rest: core::str::Lines<'a>,
    line: usize,
}

impl<'a> Lines<'a> {
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
        const ALLOWED: &str = "`not-robust R S`, `robust-by-degrees R`, `robust-by-search R S`, `ranks F` or `ranks-by-search F`";
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
            ("ranks-by-search", Some(&[f])) if f <= NETWORK_LIMIT => {
                Ok(Claim::SearchedRanks { order: self.order(f, count)?, refutation: self.roots(count)? })
            }
            _ => Err(self.refuse(ALLOWED)),
        }
    }

    fn order(&mut self, f: usize, count: usize) -> Result<Order, EvidenceError> {
        Ok(Order { f, core: self.nodes("core", count)?, rest: self.nodes("rest", count)? })
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

/// All numbers of a line, written with digits alone.
fn all<N: FromStr>(text: &str) -> Option<Vec<N>> {
    let digits = |word: &str| word.bytes().all(|byte| byte.is_ascii_digit());
    let words = text.split(' ').filter(|word| !word.is_empty());
    words.map(|word| word.parse().ok().filter(|_| digits(word))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    fn triangle(claim: Claim) -> Evidence {
        Evidence { network: Network::new(3, true, &[(0, 1), (1, 0), (0, 2), (2, 0), (1, 2)]), claim }
    }

    #[test]
    fn what_is_written_is_read() {
        let order = Order { f: 1, core: vec![0, 2], rest: vec![1] };
        let sets = [vec![0], vec![2, 1]];
        let choices = vec![Choice { node: 2, roles: 9 }, Choice { node: 1, roles: 1 }];
        let roots = vec![Root { node: 1, choices }, Root { node: 0, choices: vec![] }];
        let refutation = Refutation { roots };
        for claim in [
            Claim::NotRobust { r: 2, s: 1, sets },
            Claim::Degrees { r: 3 },
            Claim::Ranks(order.clone()),
            Claim::Search { r: 1, s: 2, refutation: refutation.clone() },
            Claim::SearchedRanks { order, refutation },
        ] {
            let evidence = triangle(claim);
            assert_eq!(Evidence::from_text(&evidence.text()), Ok(evidence));
        }
    }

    #[test]
    fn an_error_names_its_line() {
        let good = triangle(Claim::Degrees { r: 1 }).text();
        for (old, new, line) in [
            ("certificate 1", "certificate 2", 1),
            ("nodes 3", "nodes 0", 2),
            ("hears 1 0", "hears 1 3", 4),
            ("hears 1 0", "hears 1 1", 4),
            ("hears 2 0 1", "hears 2 1 0", 5),
            ("degrees 1", "degrees", 6),
            ("degrees 1", "degrees +1", 6),
            ("degrees 1", "degrees 1\nset 0", 7),
        ] {
            assert!(good.contains(old));
            let error = Evidence::from_text(&good.replace(old, new)).unwrap_err();
            assert_eq!(error.line, line, "{new}: {error}");
        }
        assert!(Evidence::from_text(&good.replace("nodes", "# six\nnodes")).is_ok());
    }
}
