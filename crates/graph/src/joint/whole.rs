//! Vectors for which what nodes hear would not be whole numbers.

use alloc::vec::Vec;

use super::parts::{Counts, PARTS, pair};
use super::rules::{Facts, Rule};
use super::simplex::float;
use super::vectors::floor;

/// Vectors with entries −1, 0 and 1, as numbers of five digits of base 3.
const VECTORS: usize = 243;

/// So many rules are taken at once.
const RULES: usize = 4;

/// The rules of whole numbers that numbers of links break most; none if the graph is not strongly regular.
pub(super) fn whole_rules(facts: &Facts, counts: &Counts, links: &[f64]) -> Vec<Rule> {
    if facts.strong.is_none() {
        return Vec::new();
    }
    // A vector and its opposite say the same: those above the middle are enough.
    let vectors = (VECTORS / 2 + 1..VECTORS).map(vector);
    let rules = vectors.map(|vector| Rule::Whole(vector, below(&vector, counts, links)));
    let breach = |rule: Rule| {
        let row = facts.row(rule, counts);
        let sum: f64 = row.weights.iter().zip(links).map(|(weight, link)| float(*weight) * link).sum();
        float(row.low.unwrap_or(0)) - sum
    };
    let mut broken: Vec<(f64, Rule)> = rules.map(|rule| (breach(rule), rule)).collect();
    broken.retain(|(breach, _)| *breach > 1e-4);
    broken.sort_by(|(one, _), (other, _)| other.total_cmp(one));
    broken.truncate(RULES);
    broken.into_iter().map(|(_, rule)| rule).collect()
}

fn vector(code: usize) -> [i32; PARTS] {
    let digit = |part: usize| (code / 3_usize.pow(u32::try_from(part).unwrap_or(0))) % 3;
    core::array::from_fn(|part| i32::try_from(digit(part)).unwrap_or(0) - 1)
}

/// What a node of each part hears on average, weighted, rounded down.
fn below(vector: &[i32; PARTS], counts: &Counts, links: &[f64]) -> [i32; PARTS] {
    let heard = |part: usize, other: usize| {
        let ends = if part == other { 2.0 } else { 1.0 };
        f64::from(vector[other]) * ends * links[pair(part, other)]
    };
    core::array::from_fn(|part| {
        let sum: f64 = (0..PARTS).map(|other| heard(part, other)).sum();
        floor(sum / float(counts[part].max(1)))
    })
}
