//! The least of all barriers, as a function that is not smooth (Glotfelter, Cortés, Egerstedt 2017).
//!
//! With every `h_i = c_i − F′` and every `Δ² − Δ_d²`, let h be the least. Where several
//! are within `ALMOST` of it, all of them count as active, as the source wants it near a kink:
//!
//! ```text
//! Σ_i ∂h_k/∂x_i · u_i ≥ −α h        for every k with h_k ≤ h + ALMOST
//! ```
//!
//! Each row is shared out evenly among the robots that it is about. Needs: the positions of all robots. Built from the
//! description in the paper and in the abstract; the source leaves open how rows are shared out.

use closeranks_core::robot::neighbor::RobotId;

use crate::controllers::shared::barrier::{Barrier, Shares, pairs_in_range};
use crate::controllers::{Answer, TeamView, Velocities};

/// How much larger than the least one a barrier is that counts as active.
const ALMOST: f64 = 0.2;

/// The controller.
#[derive(Clone, Debug, Default)]
pub struct MinComposition {
    shares: Shares,
}

impl Velocities for MinComposition {
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]) {
        let barriers = barriers(view);
        let least = barriers.iter().fold(f64::INFINITY, |least, barrier| least.min(barrier.h));
        self.shares.begin(view);
        for barrier in barriers.iter().filter(|barrier| barrier.h <= least + ALMOST) {
            self.shares.keep_at(barrier, least);
        }
        self.shares.answer(view, answers);
    }
}

/// The h_i of all robots and the distances of all pairs in range.
fn barriers<const D: usize>(view: &TeamView<'_, D>) -> Vec<Barrier<D>> {
    let robots = view.positions_m.len();
    let degrees = (1_u16..).zip(0..robots).map(|(number, robot)| {
        let need = f64::from(view.params.need().need(RobotId(number)));
        Barrier::degree(view, robot, 0..robots, need)
    });
    let apart = pairs_in_range(view).into_iter().map(|pair| Barrier::apart(view, pair));
    degrees.chain(apart).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controllers::Controller;
    use crate::controllers::shared::testing::{outward, watch};

    #[test]
    fn the_least_barrier_does_not_become_negative() {
        let mut least = f64::INFINITY;
        let grown = watch(&outward(Controller::MinComposition), |view| {
            least = barriers(view).iter().fold(least, |least, barrier| least.min(barrier.h));
        });
        assert!(least > -1e-2, "sampled every 5 ms it is nearly kept: {least}");
        assert!(grown > 1.1, "{grown}");
    }
}
