//! Whole multipliers of rules that no numbers of links meet together.

use alloc::vec::Vec;

use super::parts::{Counts, PAIRS, Row, rooms};
use super::rules::{Facts, Rule};

/// Rules with multipliers: a positive one takes the upper bound of its row, a negative one the lower.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Proof {
    pub(super) multipliers: Vec<(Rule, i128)>,
}

impl Proof {
    /// Whether there are no numbers of links between parts of that many nodes.
    ///
    /// The sum of the rows times their multipliers is at most the sum of the bounds times the multipliers. If no numbers from 0 to what there is
    /// room for make it so little, there are none. Sums that are too large prove nothing.
    //= theory sec:joint-sizes
    pub(super) fn refutes(&self, facts: &Facts, counts: &Counts) -> bool {
        let Some((weights, bound)) = self.sum(facts, counts) else { return false };
        let least = weights
            .iter()
            .zip(rooms(counts))
            .try_fold(0_i128, |sum, (weight, room)| sum.checked_add((*weight).min(0).checked_mul(room)?));
        least.is_some_and(|least| least > bound)
    }

    fn sum(&self, facts: &Facts, counts: &Counts) -> Option<([i128; PAIRS], i128)> {
        let (mut weights, mut bound) = ([0_i128; PAIRS], 0_i128);
        for (rule, multiplier) in &self.multipliers {
            let row = facts.row(*rule, counts);
            bound = bound.checked_add(bound_of(&row, *multiplier)?.checked_mul(*multiplier)?)?;
            for (sum, weight) in weights.iter_mut().zip(row.weights) {
                *sum = sum.checked_add(weight.checked_mul(*multiplier)?)?;
            }
        }
        Some((weights, bound))
    }
}

/// The bound of a row that a multiplier of that sign takes.
fn bound_of(row: &Row, multiplier: i128) -> Option<i128> {
    match multiplier {
        0 => Some(0),
        1.. => row.high,
        _ => row.low,
    }
}
