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
//! | `robust-by-eigenvalues R S` | `low Q`, a line `row ..` for each node, `high Q`, a line `row ..` for each node |
//! | `ranks-by-search F` | `core ..`, `rest ..`, `roots N`, N lines `root ..` |
//!
//! A line `root` has the node that is honest in S₁, then pairs of a node and a sum of roles, as [`crate::roles::Choice`] says; of
//! `ranks-by-search` nodes are places in the core, from 0. Lines that begin with `#` are remarks.

use alloc::string::String;
use core::fmt::Write as _;

use super::read::{EvidenceError, FIRST_LINE, Lines};
use super::{Claim, Evidence};
use crate::formats::NETWORK_TEXT_LIMIT;
use crate::ranks::Order;
use crate::roles::{Choice, Refutation, Root};
use crate::spectrum::Bounds;

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
            Claim::Eigenvalues { r, s, bounds } => {
                let _ = writeln!(text, "robust-by-eigenvalues {r} {s}");
                push_bounds(&mut text, bounds);
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
        Lines::new(text).evidence()
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

fn push_bounds(text: &mut String, bounds: &Bounds) {
    for (word, (end, triangle)) in ["low", "high"].iter().zip(bounds.ends.iter().zip(&bounds.triangles)) {
        let _ = writeln!(text, "{word} {end}");
        for row in triangle {
            text.push_str("row");
            for entry in row {
                let _ = write!(text, " {entry}");
            }
            text.push('\n');
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::Network;
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
