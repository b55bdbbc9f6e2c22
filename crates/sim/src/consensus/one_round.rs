//! The rules of [`closeranks_core::consensus`], run by the world: for values of several numbers.

use closeranks_core::consensus::Rule;

use super::{Told, Update};

/// A rule that knows no more than the values of one round.
#[derive(Clone, Debug)]
pub struct OneRound {
    rule: Rule,
    heard: Vec<f64>,
}

impl OneRound {
    /// For a rule of the core.
    #[must_use]
    pub fn new(rule: Rule) -> Self {
        Self { rule, heard: Vec::new() }
    }
}

impl Update for OneRound {
    fn update(&mut self, told: &Told<'_>, next: &mut [f64]) {
        for ((next, own), heard) in next.iter_mut().zip(told.own).zip(told.heard) {
            self.heard.clear();
            self.heard.extend(heard.iter().map(|(_, value)| *value));
            *next = self.rule.update(*own, &mut self.heard, told.faults).value;
        }
    }
}
