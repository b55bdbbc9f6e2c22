//! A row for each pair, of which each robot does half (Jankovic, Santillo, Wang 2024 for collisions; Bhatia et al. 2024 for
//! connectivity).
//!
//! For each pair in range: `h = Δ² − Δ_d²` and `h = R² − Δ²`. So a link that once formed is kept for ever: nothing has to be known
//! of third robots, and the team can close up but hardly spread. Needs: the positions of the robots in range.
//! Built from the description of these works in the paper and in their abstracts.

use crate::controllers::shared::barrier::{Barrier, Shares, pairs_in_range};
use crate::controllers::{Answer, TeamView, Velocities};

/// The controller.
#[derive(Clone, Debug, Default)]
pub struct Pairwise {
    shares: Shares,
}

impl Velocities for Pairwise {
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]) {
        self.shares.begin(view);
        for pair in pairs_in_range(view) {
            self.shares.keep(&Barrier::linked(view, pair));
        }
        self.shares.answer(view, answers);
    }
}

#[cfg(test)]
mod tests {
    use crate::controllers::Controller;
    use crate::controllers::shared::barrier::pairs_in_range;
    use crate::controllers::shared::testing::{outward, watch};

    #[test]
    fn links_only_become_more() {
        let mut before = Vec::new();
        watch(&outward(Controller::Pairwise), |view| {
            let links = pairs_in_range(view);
            assert!(before.iter().all(|pair| links.contains(pair)));
            before = links;
        });
    }
}
