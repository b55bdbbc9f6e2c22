//! Whether four numbers of members are ruled out.

use alloc::vec::Vec;

use super::parts::{Counts, PAIRS, Quadruple, Row, rooms};
use super::proof::Proof;
use super::rules::{Facts, Rule};
use super::simplex::{Outcome, Simplex, float};
use super::vectors::eigenvalue_rules;
use super::whole::whole_rules;

/// Proofs that are kept, because they often do for other numbers too.
const PROOFS: usize = 12;

/// How often rules with vectors are added for one quadruple.
const ROUNDS: usize = 40;

/// Multipliers are rounded to 1/2^62.
const UNIT: f64 = 4_611_686_018_427_387_904.0;

/// What a round costs, in nodes of the search tree, beside its exchanges.
const ROUND_NODES: u64 = 8;

/// A question about one graph: which numbers of members are ruled out.
#[derive(Clone, Debug)]
pub(super) struct Sieve {
    facts: Facts,
    plain: Vec<Rule>,
    /// Those that did last come first.
    proofs: Vec<Proof>,
    /// Work so far, in nodes of the search tree.
    pub(super) nodes: u64,
}

impl Sieve {
    pub(super) fn new(facts: Facts) -> Self {
        let plain = facts.plain_rules();
        Self { facts, plain, proofs: Vec::new(), nodes: 0 }
    }

    /// Whether no two sets have that many members. False says that no proof was found.
    //= theory sec:joint-sizes
    pub(super) fn rules_out(&mut self, quadruple: &Quadruple) -> bool {
        let counts = quadruple.counts(self.facts.nodes);
        self.nodes += 1;
        if let Some(place) = self.proofs.iter().position(|proof| proof.refutes(&self.facts, &counts)) {
            self.nodes += place as u64 / 2;
            self.proofs[..=place].rotate_right(1);
            return true;
        }
        self.nodes += self.proofs.len() as u64 / 2;
        let mut program = Program::new(&self.facts, quadruple);
        for rule in self.plain.iter().chain(self.vectors_that_did()) {
            program.add(*rule);
        }
        let proof = program.prove();
        self.nodes += program.nodes;
        let Some(proof) = proof else { return false };
        self.proofs.insert(0, proof);
        self.proofs.truncate(PROOFS);
        true
    }

    /// The rules of the last proof that have a vector.
    fn vectors_that_did(&self) -> impl Iterator<Item = &Rule> {
        let rules = self.proofs.first().into_iter().flat_map(|proof| &proof.multipliers);
        rules.map(|(rule, _)| rule).filter(|rule| matches!(rule, Rule::Least(_) | Rule::Most(_)))
    }
}

/// A linear program over the numbers of links for one quadruple.
struct Program<'f> {
    facts: &'f Facts,
    counts: Counts,
    simplex: Simplex,
    /// The rules of its rows, and what each row was multiplied by to have 1 as its largest weight.
    rules: Vec<(Rule, f64)>,
    nodes: u64,
}

impl<'f> Program<'f> {
    fn new(facts: &'f Facts, quadruple: &Quadruple) -> Self {
        let counts = quadruple.counts(facts.nodes);
        let simplex = Simplex::new(rooms(&counts).map(float));
        Self { facts, counts, simplex, rules: Vec::new(), nodes: 0 }
    }

    fn add(&mut self, rule: Rule) {
        let row = self.facts.row(rule, &self.counts);
        let scale = 1.0 / float(row.weights.iter().map(|weight| weight.abs()).max().unwrap_or(1).max(1));
        let bound = |bound: Option<i128>, none: f64| bound.map_or(none, |bound| float(bound) * scale);
        let weights: [f64; PAIRS] = row.weights.map(|weight| float(weight) * scale);
        self.simplex.add(&weights, bound(row.low, f64::NEG_INFINITY), bound(row.high, f64::INFINITY));
        self.rules.push((rule, scale));
    }

    /// A proof that whole numbers confirm.
    fn prove(&mut self) -> Option<Proof> {
        for _ in 0..ROUNDS {
            let before = self.simplex.exchanges;
            let outcome = self.simplex.solve();
            self.nodes += u64::from(self.simplex.exchanges - before) + ROUND_NODES;
            match outcome {
                Outcome::Open => return None,
                Outcome::Contradiction(rows) => {
                    let proof = self.rounded(&rows);
                    return proof.refutes(self.facts, &self.counts).then_some(proof);
                }
                Outcome::Met => {
                    if !self.add_broken() {
                        return None;
                    }
                }
            }
        }
        None
    }

    /// Adds rules that the numbers of links break which the program has come to. False: there are none.
    fn add_broken(&mut self) -> bool {
        let links = self.simplex.point().to_vec();
        let mut rules = eigenvalue_rules(self.facts, &self.counts, &links);
        rules.retain(|rule| is_broken(&self.facts.row(*rule, &self.counts), &links));
        if rules.is_empty() {
            rules = whole_rules(self.facts, &self.counts, &links);
        }
        for rule in &rules {
            self.add(*rule);
        }
        !rules.is_empty()
    }

    #[expect(
        clippy::cast_possible_truncation,
        reason = "too large a number becomes the largest, and proves nothing"
    )]
    fn rounded(&self, rows: &[(usize, f64)]) -> Proof {
        let multiplier = |(row, weight): &(usize, f64)| {
            let (rule, scale) = self.rules[*row];
            (rule, (weight * scale * UNIT) as i128)
        };
        Proof { multipliers: rows.iter().map(multiplier).filter(|(_, times)| *times != 0).collect() }
    }
}

/// Whether numbers of links break a row clearly.
fn is_broken(row: &Row, links: &[f64]) -> bool {
    let sum: f64 = row.weights.iter().zip(links).map(|(weight, link)| float(*weight) * link).sum();
    let most = row.weights.iter().map(|weight| weight.abs()).max().unwrap_or(0);
    let slack = 1e-6 * float(most);
    row.low.is_some_and(|low| sum < float(low) - slack)
        || row.high.is_some_and(|high| sum > float(high) + slack)
}
