//! The links of the start are kept, and no other is relied on (Saldaña, Prorok, Sundaram, Campos, Kumar 2017; Usevitch and Panagou
//! 2020, who keep topologies of known robustness).
//!
//! For each pair that is in range in the first tick: `h = R² − Δ²`, each robot takes half of it. If the start is robust enough, the
//! team stays so without ever computing robustness; in exchange it cannot change its shape. Needs: the positions of the
//! robots at the other ends of its links, and their agreement on what the links of the start were. Built from the
//! description of these works in the paper and in their abstracts.

use crate::controllers::shared::barrier::{Barrier, Shares, pairs_in_range};
use crate::controllers::{Answer, TeamView, Velocities};

/// The controller with the links of the first tick.
#[derive(Clone, Debug, Default)]
pub struct FixedTopology {
    links: Option<Vec<[usize; 2]>>,
    shares: Shares,
}

impl Velocities for FixedTopology {
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]) {
        self.shares.begin(view);
        for pair in self.links.get_or_insert_with(|| pairs_in_range(view)) {
            self.shares.keep(&Barrier::linked(view, *pair));
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
    fn no_link_of_the_start_is_lost_however_robots_pull() {
        let mut first = None;
        let grown = watch(&outward(Controller::FixedTopology), |view| {
            let links = pairs_in_range(view);
            let first = first.get_or_insert_with(|| links.clone());
            assert!(first.iter().all(|pair| links.contains(pair)), "{first:?} {links:?}");
        });
        assert!(grown > 1.1, "it moves as far as that lets it: {grown}");
    }
}
