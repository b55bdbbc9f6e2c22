//! SW-MSR, a sliding window (Saldaña, Prorok, Sundaram, Campos, Kumar 2017, resilient consensus for networks that change; built from
//! its description in the paper and in the abstract).
//!
//! ```text
//! W_i(t) = the newest value of everybody heard in the rounds t − window + 1 … t;   y_i(t+1) = W-MSR(y_i(t), W_i(t))
//! ```
//!
//! It assumes that rounds are synchronous and at most F robots lie. Normal robots then agree if the union of the graphs of any window
//! is (2F + 1)-robust, even where no single graph is. What is remembered was once the value of somebody normal or one of F lies, so values
//! stay in the interval of the start.

use closeranks_core::wmsr;

use super::{Told, Update};

/// What everybody remembers.
#[derive(Clone, Debug)]
pub struct Sliding {
    window: u32,
    round: u32,
    /// For each robot: of whom it remembers what, and since which round; ascending.
    memory: Vec<Vec<Remembered>>,
    values: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Remembered {
    sender: u16,
    round: u32,
    value: f64,
}

impl Sliding {
    /// Values are remembered for `window` rounds, that of this round included.
    #[must_use]
    pub fn new(window: u16, robots: usize) -> Self {
        Self {
            window: u32::from(window.max(1)),
            round: 0,
            memory: vec![Vec::new(); robots],
            values: Vec::new(),
        }
    }

    fn remember(&mut self, robot: usize, heard: &[(u16, f64)]) {
        let (memory, round) = (&mut self.memory[robot], self.round);
        for &(sender, value) in heard {
            let new = Remembered { sender, round, value };
            match memory.binary_search_by_key(&sender, |known| known.sender) {
                Ok(place) => memory[place] = new,
                Err(place) => memory.insert(place, new),
            }
        }
        memory.retain(|known| round - known.round < self.window);
    }
}

impl Update for Sliding {
    fn update(&mut self, told: &Told<'_>, next: &mut [f64]) {
        for (robot, heard) in told.heard.iter().enumerate() {
            self.remember(robot, heard);
            self.values.clear();
            self.values.extend(self.memory[robot].iter().map(|known| known.value));
            next[robot] = wmsr::update(told.own[robot], &mut self.values, told.faults).value;
        }
        self.round = self.round.saturating_add(1);
    }

    fn forget(&mut self, robot: usize) {
        self.memory[robot].clear();
    }
}
