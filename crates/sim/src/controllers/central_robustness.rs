//! r-robustness kept with a view of the whole team, by bootstrap percolation (after Lee and Panagou, ICRA 2025).
//!
//! A complete graph of 2r − 1 robots is r-robust, and stays so when robots are added one after the other that have r links
//! to those before them (LeBlanc et al. 2013). With r = 2F + 1, which is enough for W-MSR:
//!
//! ```text
//! core        2r − 1 robots, those nearest to the middle of the team in the first tick; every link among them is kept
//! percolation from the core on, in every tick: who has r neighbours inside joins, layer by layer
//! others      h_i = Σ_{j that joined before i} a_ij − r,  shared out evenly among i and these j
//! ```
//!
//! Who does not join has the robots that did before it. Small teams have fewer than 2r − 1 robots: then all are the
//! core, and r is what that gives. Needs: the positions of all robots. Built from the abstract and from what is known of
//! percolation; the source composes its barriers smoothly.

use closeranks_core::num::{dot, subtract};

use crate::controllers::shared::barrier::{Barrier, Shares, pairs_in_range};
use crate::controllers::{Answer, TeamView, Velocities};

/// The controller with the core that it chose.
#[derive(Clone, Debug, Default)]
pub struct CentralRobustness {
    core: Option<Vec<usize>>,
    shares: Shares,
}

impl Velocities for CentralRobustness {
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]) {
        self.shares.begin(view);
        let robots = view.positions_m.len();
        let need = need(view);
        let core = self.core.get_or_insert_with(|| core(view, 2 * need - 1));
        let layers = percolate(robots, &pairs_in_range(view), core, need);
        for (place, one) in core.iter().enumerate() {
            core[..place].iter().for_each(|other| self.shares.keep(&Barrier::linked(view, [*one, *other])));
        }
        #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
        for robot in (0..robots).filter(|robot| layers[*robot] != Some(0)) {
            let before = (0..robots).filter(|other| is_before(layers[*other], layers[robot]));
            self.shares.keep(&Barrier::degree(view, robot, before, need as f64));
        }
        self.shares.answer(view, answers);
    }
}

/// r: `2F + 1`, or as much as the team can have.
fn need<const D: usize>(view: &TeamView<'_, D>) -> usize {
    let wanted = 2 * usize::from(view.params.settings().team.faults) + 1;
    wanted.min(view.positions_m.len().div_ceil(2)).max(1)
}

/// So many robots nearest to the middle of the team.
fn core<const D: usize>(view: &TeamView<'_, D>, size: usize) -> Vec<usize> {
    let square_m2 = |one: usize, other: usize| {
        let offset_m = subtract(&view.positions_m[one], &view.positions_m[other]);
        dot(&offset_m, &offset_m)
    };
    let robots = view.positions_m.len();
    let sum_m2 = |one: usize| (0..robots).map(|other| square_m2(one, other)).sum::<f64>();
    let mut order: Vec<usize> = (0..robots).collect();
    order.sort_by(|one, other| sum_m2(*one).total_cmp(&sum_m2(*other)));
    order.truncate(size);
    order
}

/// In which layer each robot joins: 0 for the core, none for who never has `need` neighbours that joined.
fn percolate(robots: usize, links: &[[usize; 2]], core: &[usize], need: usize) -> Vec<Option<usize>> {
    let mut layers = vec![None; robots];
    for robot in core {
        layers[*robot] = Some(0);
    }
    for layer in 1..=robots {
        let mut inside = vec![0; robots];
        for [one, other] in links {
            inside[*one] += usize::from(layers[*other].is_some());
            inside[*other] += usize::from(layers[*one].is_some());
        }
        for robot in 0..robots {
            if layers[robot].is_none() && inside[robot] >= need {
                layers[robot] = Some(layer);
            }
        }
    }
    layers
}

/// True if one that joined in `layer` did before one that joined in `than`, or never did.
fn is_before(layer: Option<usize>, than: Option<usize>) -> bool {
    layer.is_some_and(|layer| than.is_none_or(|than| layer < than))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controllers::Controller;
    use crate::controllers::shared::testing::{outward, watch};
    use crate::scenario::Scenario;
    use closeranks_core::settings::Team;

    #[test]
    fn percolation_goes_layer_by_layer() {
        let links = [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3], [3, 4], [2, 4], [4, 5]];
        let layers = percolate(6, &links, &[0, 1], 2);
        assert_eq!(layers, [Some(0), Some(0), Some(1), Some(2), Some(3), None]);
        assert!(is_before(layers[2], layers[5]) && !is_before(layers[5], layers[2]));
    }

    #[test]
    fn everybody_goes_on_joining() {
        let scenario =
            Scenario { team: Team { robots: 11, faults: 1 }, ..outward(Controller::CentralRobustness) };
        let mut chosen = None;
        let grown = watch(&scenario, |view| {
            let core = chosen.get_or_insert_with(|| core(view, 5));
            let links = pairs_in_range(view);
            assert!(
                core.iter()
                    .all(|one| core.iter().all(|other| one >= other || links.contains(&[*one, *other])))
            );
            assert!(percolate(11, &links, core, 3).iter().all(Option::is_some));
        });
        assert!(grown > 1.5, "{grown}");
    }
}
