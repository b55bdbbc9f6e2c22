//! By how much values must come closer from round to round.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::monitors::heard::Met;
use crate::monitors::rule::Rule;

/// A value is rounded a few times in a round: far less than this fraction of it.
const ROUNDING: f64 = 1e-13;
/// Nothing is left of β^k after so many rounds.
const ROUNDS_MAX: usize = 64;

/// The spreads of the last rounds in which enough was heard.
///
/// If everybody counts for everybody, each round leaves at most 1 − β/2 of the spread (thm:contraction). With ranks, L the highest of
/// a normal robot, no round makes it larger and L + 1 of them leave at most 1 − β^(L+1)/2 (thm:ranks).
#[derive(Clone, Debug)]
pub(crate) struct Agreement {
    rule: Arc<Rule>,
    /// L + 1.
    rounds: usize,
    /// Spreads at the beginning of rounds in a row of which enough was heard, and the last.
    spreads: VecDeque<f64>,
    /// The most values that anybody used in one of them.
    most_heard: u16,
}

impl Agreement {
    /// For the team of `rule`.
    pub(crate) fn new(rule: &Arc<Rule>) -> Self {
        let highest = rule.ranks().map_or(0, |ranks| ranks.iter().copied().max().unwrap_or(0));
        Self {
            rule: Arc::clone(rule),
            rounds: usize::from(highest) + 1,
            spreads: VecDeque::new(),
            most_heard: 0,
        }
    }

    /// Ends a round with this spread of values of up to this `magnitude`; the most that the spread may be, if anything is promised.
    //= paper thm:rs_robust
    //= theory thm:ranks
    pub(crate) fn end_round(&mut self, spread: f64, magnitude: f64, met: Met) -> Option<f64> {
        if met.suffices {
            self.most_heard = self.most_heard.max(met.most_heard);
        } else {
            self.spreads.clear();
            self.most_heard = 0;
        }
        let demanded = self.spreads.back().map(|before| before * self.left(1)).map(|next| {
            let long_ago = self.spreads.len().checked_sub(self.rounds).and_then(|at| self.spreads.get(at));
            let over_all = long_ago.map_or(f64::INFINITY, |then| then * self.left(self.rounds));
            next.min(over_all) + ROUNDING * magnitude
        });
        self.spreads.push_back(spread);
        if self.spreads.len() > self.rounds.min(ROUNDS_MAX) {
            self.spreads.pop_front();
        }
        demanded
    }

    /// The fraction of the spread that is left at most after so many rounds.
    fn left(&self, rounds: usize) -> f64 {
        if self.rule.ranks().is_none() {
            return 1.0 - 0.5 * self.rule.beta();
        }
        if rounds < self.rounds || rounds > ROUNDS_MAX {
            return 1.0;
        }
        let beta = 1.0 / (1.0 + f64::from(self.most_heard));
        1.0 - 0.5 * (0..rounds).fold(1.0, |product, _| product * beta)
    }
}
