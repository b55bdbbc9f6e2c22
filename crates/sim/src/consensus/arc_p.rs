//! ARC-P, the adversarial robust consensus protocol in continuous time (LeBlanc and Koutsoukos, HSCC 2012; built from
//! its description in the paper and in abstracts).
//!
//! ```text
//! ẏ_i = gain Σ_{j ∈ K} (y_j − y_i),   K: the neighbours without the F of largest and the F of smallest value; nobody if there are no more than 2F
//! ```
//!
//! It assumes that robots hear each other at all times. Here a tick holds what was heard at its beginning, and the equation of a
//! robot is then solved exactly: with k kept and m their mean,
//!
//! ```text
//! y_i(t + T) = m + (y_i(t) − m) e^(−gain k T)
//! ```
//!
//! which lies between `y_i` and m whatever gain and tick are, so values stay in the interval of the start. A robot may use what
//! it was told in this round by those still in range: where messages are lost, a value is held until the next round.
//!
//! F + ⌊n/2⌋ neighbours a robot are enough against F liars. No condition that is also necessary is known to us for this form, which
//! trims on both sides wherever the own value lies.

use closeranks_core::num::exp;

use super::{Told, Update};

/// The protocol.
#[derive(Clone, Debug)]
pub struct ArcP {
    gain_per_s: f64,
    heard: Vec<f64>,
}

impl ArcP {
    /// With this gain, 1/s.
    #[must_use]
    pub fn new(gain_per_s: f64) -> Self {
        Self { gain_per_s, heard: Vec::new() }
    }

    #[expect(clippy::cast_precision_loss, reason = "counts of robots are far below 2^53")]
    fn step(&mut self, own: f64, faults: u16, elapsed_s: f64) -> f64 {
        self.heard.sort_unstable_by(f64::total_cmp);
        let (faults, all) = (usize::from(faults), self.heard.len());
        if all <= 2 * faults {
            return own;
        }
        let kept = &self.heard[faults..all - faults];
        let count = kept.len() as f64;
        let mean = kept.iter().fold(0.0, |sum, value| sum + value / count);
        let mean = mean.max(kept[0]).min(kept[kept.len() - 1]);
        let next = mean + (own - mean) * exp(-self.gain_per_s * count * elapsed_s);
        next.max(own.min(mean)).min(own.max(mean))
    }
}

impl Update for ArcP {
    fn update(&mut self, told: &Told<'_>, next: &mut [f64]) {
        for ((next, own), heard) in next.iter_mut().zip(told.own).zip(told.heard) {
            self.heard.clear();
            self.heard.extend(heard.iter().map(|(_, value)| *value));
            *next = self.step(*own, told.faults, told.elapsed_s);
        }
    }

    fn is_continuous(&self) -> bool {
        true
    }
}
