//! What must hold of the numbers of links between the five parts, in whole numbers.

use alloc::vec::Vec;

use super::degrees::Degrees;
use super::parts::{Counts, PAIRS, PARTS, REST, Row, pair, pairs};
use super::strong::Strong;
use crate::graph::Graph;
use crate::spectrum::{SCALE, Spectrum};

/// One condition on the numbers of links.
//= theory sec:joint-sizes
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    /// The degrees of all nodes of some parts together; a bit for each part.
    Degrees(usize),
    /// Content members of a set hear fewer than r nodes outside of it.
    Content(usize),
    /// Exempt members of a set hear r nodes or more outside of it.
    Exempt(usize),
    /// Who is in neither set hears r nodes or more outside of a set.
    Rest(usize),
    /// Not less than λ allows, for a vector that is constant on each part.
    Least([i32; PARTS]),
    /// Not more than Λ allows.
    Most([i32; PARTS]),
    /// What a node of each part hears, weighted by the vector, is a whole number: none lies between the second number and the next one.
    Whole([i32; PARTS], [i32; PARTS]),
}

/// What is known of one graph at one r.
#[derive(Clone, Debug)]
pub(super) struct Facts {
    pub(super) nodes: i32,
    pub(super) r: i128,
    pub(super) degrees: Degrees,
    /// λ and Λ times `SCALE`.
    pub(super) ends: [i128; 2],
    pub(super) strong: Option<Strong>,
}

impl Facts {
    pub(super) fn new(graph: &Graph, spectrum: Spectrum, r: usize) -> Self {
        let (least, most) = spectrum.bounds();
        Self {
            nodes: i32::try_from(graph.node_count()).unwrap_or(i32::MAX),
            r: i128::try_from(r).unwrap_or(i128::from(u64::MAX)),
            degrees: Degrees::new(graph),
            ends: [least, most].map(i128::from),
            strong: Strong::new(graph),
        }
    }

    /// The rules that any two sets meet, but for those that have a vector.
    pub(super) fn plain_rules(&self) -> Vec<Rule> {
        let all = 1 << PARTS;
        let parts = (1..all).filter(|parts: &usize| !self.degrees.are_equal() || parts.is_power_of_two());
        let sets = (0..2).flat_map(|set| [Rule::Content(set), Rule::Exempt(set), Rule::Rest(set)]);
        parts.map(Rule::Degrees).chain(sets).collect()
    }

    /// What a rule says of parts of that many nodes.
    pub(super) fn row(&self, rule: Rule, counts: &Counts) -> Row {
        match rule {
            Rule::Degrees(parts) => self.degrees_row(parts, counts),
            Rule::Content(set) => outside(set, 2 * set, None, Some((self.r - 1) * counts[2 * set])),
            Rule::Exempt(set) => outside(set, 2 * set + 1, Some(self.r * counts[2 * set + 1]), None),
            Rule::Rest(set) => outside(set, REST, Some(self.r * counts[REST]), None),
            Rule::Least(vector) => self.end_row(&vector, counts, 0),
            Rule::Most(vector) => self.end_row(&vector, counts, 1),
            Rule::Whole(vector, below) => match &self.strong {
                Some(strong) => strong.row(&vector, &below, counts),
                None => Row { weights: [0; PAIRS], low: None, high: None },
            },
        }
    }

    fn degrees_row(&self, parts: usize, counts: &Counts) -> Row {
        let has = |part: &usize| parts >> part & 1 == 1;
        let mut weights = [0; PAIRS];
        for part in (0..PARTS).filter(has) {
            for other in 0..PARTS {
                weights[pair(part, other)] += ends(part, other);
            }
        }
        let count: i128 = (0..PARTS).filter(has).map(|part| counts[part]).sum();
        let [low, high] = self.degrees.sums(count);
        Row { weights, low: Some(low), high: Some(high) }
    }

    /// SCALE n Σ e (w − w')² and the bound times n (Σ w² − (Σ w)²/n).
    fn end_row(&self, vector: &[i32; PARTS], counts: &Counts, end: usize) -> Row {
        let vector = vector.map(i128::from);
        let n = i128::from(self.nodes);
        let mut weights = [0; PAIRS];
        for (one, other) in pairs() {
            weights[pair(one, other)] = i128::from(SCALE) * n * (vector[one] - vector[other]).pow(2);
        }
        let sum: i128 = vector.iter().zip(counts).map(|(value, count)| value * count).sum();
        let squares: i128 = vector.iter().zip(counts).map(|(value, count)| value * value * count).sum();
        let bound = Some(self.ends[end] * (n * squares - sum * sum));
        if end == 0 {
            Row { weights, low: bound, high: None }
        } else {
            Row { weights, low: None, high: bound }
        }
    }
}

/// How many ends in `part` a link between two parts has.
fn ends(part: usize, other: usize) -> i128 {
    if part == other { 2 } else { 1 }
}

/// How many nodes outside of a set the nodes of a part hear together.
fn outside(set: usize, part: usize, low: Option<i128>, high: Option<i128>) -> Row {
    let mut weights = [0; PAIRS];
    for other in (0..PARTS).filter(|other| other / 2 != set) {
        weights[pair(part, other)] = ends(part, other);
    }
    Row { weights, low, high }
}
