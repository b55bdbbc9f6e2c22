//! The mean weighted by given trusts, after Yemini, Nedić, Goldsmith and Gil 2022 ("Characterizing trust and resilience in distributed
//! consensus for cyberphysical systems"; built from its abstract). There robots learn from side information whom to trust; here trusts are given.
//!
//! ```text
//! y_i ← (y_i + Σ τ_j y_j) / (1 + Σ τ_j),   0 ≤ τ_j ≤ 1
//! ```
//!
//! It assumes that trusts are right. With trust 0 for every liar and more for others normal robots agree on any connected graph of normal
//! robots, however many lie. One trusted liar leads all.

use super::{Told, Update};

/// How far each robot is trusted.
#[derive(Clone, Debug)]
pub struct Trust {
    trust: Vec<f64>,
}

impl Trust {
    /// With these trusts, one a robot.
    #[must_use]
    pub fn new(trust: &[f64]) -> Self {
        Self { trust: trust.to_vec() }
    }
}

impl Update for Trust {
    fn update(&mut self, told: &Told<'_>, next: &mut [f64]) {
        for ((next, own), heard) in next.iter_mut().zip(told.own).zip(told.heard) {
            let (mut sum, mut all, mut low, mut high) = (*own, 1.0, *own, *own);
            for (sender, value) in heard {
                let trust = self.trust.get(usize::from(*sender)).copied().unwrap_or(0.0);
                if trust > 0.0 {
                    (sum, all) = (sum + trust * value, all + trust);
                    (low, high) = (low.min(*value), high.max(*value));
                }
            }
            *next = (sum / all).max(low).min(high);
        }
    }
}
