//! At least r of p constraints hold, whichever they are: combinatorial control barrier functions (arXiv 2509.10716), for "at least
//! F′ of my n − 1 links".
//!
//! With `h_ij = R² − Δ_ij²`, robot i needs the F′-th largest of its h_ij not to become negative. It keeps those links
//! that are among the F′ shortest of either end, and those that are longer by at most a hair, which may take their place
//! in a moment; each end takes half. So links may be exchanged when they are equally long. Needs: the positions of the robots in
//! range, and that the other end does its half. Built from the abstract.

use closeranks_core::num::{dot, subtract};
use closeranks_core::robot::neighbor::RobotId;

use crate::controllers::shared::barrier::{Barrier, Shares, pairs_in_range};
use crate::controllers::{Answer, TeamView, Velocities};

/// Links count as equally long up to this difference of squares, as a fraction of R².
const HAIR: f64 = 0.01;

/// The controller.
#[derive(Clone, Debug, Default)]
pub struct PChooseR {
    shares: Shares,
}

impl Velocities for PChooseR {
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]) {
        self.shares.begin(view);
        let robots = 0..view.positions_m.len();
        let limits_m2: Vec<f64> = robots.map(|robot| chosen_m2(view, robot)).collect();
        let hair_m2 = HAIR * view.params.link().radius_m * view.params.link().radius_m;
        for pair @ [one, other] in pairs_in_range(view) {
            if square_m2(view, pair) <= limits_m2[one].max(limits_m2[other]) + hair_m2 {
                self.shares.keep(&Barrier::linked(view, pair));
            }
        }
        self.shares.answer(view, answers);
    }
}

/// The square of the longest of the F′ shortest links of `robot`, m².
fn chosen_m2<const D: usize>(view: &TeamView<'_, D>, robot: usize) -> f64 {
    let number = u16::try_from(robot + 1).unwrap_or(u16::MAX);
    let need = usize::from(view.params.need().need(RobotId(number)));
    let others = (0..view.positions_m.len()).filter(|other| *other != robot);
    let mut squares_m2: Vec<f64> = others.map(|other| square_m2(view, [robot, other])).collect();
    squares_m2.sort_by(f64::total_cmp);
    need.checked_sub(1).and_then(|last| squares_m2.get(last)).copied().unwrap_or(0.0)
}

fn square_m2<const D: usize>(view: &TeamView<'_, D>, [one, other]: [usize; 2]) -> f64 {
    let offset_m = subtract(&view.positions_m[one], &view.positions_m[other]);
    dot(&offset_m, &offset_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controllers::Controller;
    use crate::controllers::shared::testing::{outward, watch};

    #[test]
    fn everybody_keeps_enough_links_and_others_may_go() {
        let mut lost = false;
        let grown = watch(&outward(Controller::PChooseR), |view| {
            let radius_m2 = view.params.link().radius_m * view.params.link().radius_m;
            assert!((0..11).all(|robot| chosen_m2(view, robot) <= radius_m2));
            lost |= pairs_in_range(view).len() < 55;
        });
        assert!(lost && grown > 1.5, "{grown}");
    }
}
