//! BP-MSR, bootstrap percolation and mean subsequence reduced (Lee and Panagou 2025, arXiv 2510.01144; built from its abstract and
//! descriptions).
//!
//! ```text
//! active: the leaders; then, until nothing changes, whoever hears at least 2F + 1 active robots
//! an active follower:  y_i ← W-MSR(y_i, values of active neighbours);   others keep their value;   leaders hold the reference
//! ```
//!
//! It assumes synchronous rounds and at most F liars around each robot. Followers that are active again and again and form, with the
//! leaders, a strongly (2F + 1)-robust graph end at the leaders' reference; all others stay in the interval of the start. Liars say that
//! they are active: that is the worst they can say, and percolation runs to its end within a round, as n exchanges of a bit would have it.
//! The normal leaders all hold the value at which the first leader starts.

use closeranks_core::wmsr;

use super::{Told, Update};

/// Leaders, and who is active.
#[derive(Clone, Debug)]
pub struct Percolating {
    leaders: Vec<bool>,
    first: usize,
    active: Vec<bool>,
    values: Vec<f64>,
}

impl Percolating {
    /// With these leaders, by number from 1.
    #[must_use]
    pub fn new(leaders: &[u16], robots: usize) -> Self {
        let leads = |robot: usize| leaders.iter().any(|leader| usize::from(*leader) == robot + 1);
        let first = leaders.first().map_or(0, |leader| usize::from(*leader).saturating_sub(1));
        let leaders: Vec<bool> = (0..robots).map(leads).collect();
        Self { active: leaders.clone(), leaders, first, values: Vec::new() }
    }

    /// Whom the last percolation reached.
    #[must_use]
    pub fn active(&self) -> &[bool] {
        &self.active
    }

    fn percolate(&mut self, told: &Told<'_>) {
        let begins = self.leaders.iter().zip(told.malicious).map(|(leads, lies)| *leads || *lies);
        self.active = begins.collect();
        let threshold = 2 * usize::from(told.faults) + 1;
        loop {
            let hears = |heard: &Vec<(u16, f64)>| {
                heard.iter().filter(|(sender, _)| self.active[usize::from(*sender)]).count()
            };
            let new = |robot: &usize| !self.active[*robot] && hears(&told.heard[*robot]) >= threshold;
            let reached: Vec<usize> = (0..self.active.len()).filter(new).collect();
            if reached.is_empty() {
                return;
            }
            for robot in reached {
                self.active[robot] = true;
            }
        }
    }
}

impl Update for Percolating {
    fn update(&mut self, told: &Told<'_>, next: &mut [f64]) {
        self.percolate(told);
        for (robot, heard) in told.heard.iter().enumerate() {
            next[robot] = told.own[robot];
            if self.leaders[robot] || !self.active[robot] {
                continue;
            }
            let active = heard.iter().filter(|(sender, _)| self.active[usize::from(*sender)]);
            self.values.clear();
            self.values.extend(active.map(|(_, value)| *value));
            next[robot] = wmsr::update(told.own[robot], &mut self.values, told.faults).value;
        }
    }

    fn begin(&mut self, values: &mut [f64]) {
        let Some(reference) = values.get(self.first).copied() else { return };
        for (value, leads) in values.iter_mut().zip(&self.leaders) {
            *value = if *leads { reference } else { *value };
        }
    }
}
