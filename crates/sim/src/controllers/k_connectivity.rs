//! Node connectivity kept by the links of a sparse subgraph (after Luo and Sycara 2019, "minimum k-connectivity maintenance").
//!
//! In every tick k = 2F + 1 scan-first forests are taken out of the graph, one after the other. Together they have at most k (n − 1)
//! links, and they are k-connected if the graph is (Cheriyan, Kao, Thurimella 1993). Their links are kept: `h = R² − Δ²`, each end takes half;
//! all others may go. 2F + 1 is what every graph must have on which W-MSR survives F liars; it is not enough for it. The source
//! takes the lightest subgraph; a forest here begins at the robot in the middle and scans near robots
//! first, which gives short links, not the shortest. Needs: the positions of all robots.

use closeranks_core::num::{dot, subtract};

use crate::controllers::shared::barrier::{Barrier, Shares, pairs_in_range};
use crate::controllers::{Answer, TeamView, Velocities};

/// The controller.
#[derive(Clone, Debug, Default)]
pub struct KConnectivity {
    shares: Shares,
}

impl Velocities for KConnectivity {
    fn velocities<const D: usize>(&mut self, view: &TeamView<'_, D>, answers: &mut [Answer<D>]) {
        self.shares.begin(view);
        let forests = 2 * usize::from(view.params.settings().team.faults) + 1;
        for pair in certificate(view.positions_m.len(), &pairs_in_range(view), forests, &inward(view)) {
            self.shares.keep(&Barrier::linked(view, pair));
        }
        self.shares.answer(view, answers);
    }
}

/// Robots by their distance to the middle of the team, the nearest first.
fn inward<const D: usize>(view: &TeamView<'_, D>) -> Vec<usize> {
    #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
    let robots = view.positions_m.len() as f64;
    let middle_m: [f64; D] =
        core::array::from_fn(|d| view.positions_m.iter().map(|x| x[d]).sum::<f64>() / robots);
    let away_m2 = |robot: &usize| {
        let offset_m = subtract(&view.positions_m[*robot], &middle_m);
        dot(&offset_m, &offset_m)
    };
    let mut order: Vec<usize> = (0..view.positions_m.len()).collect();
    order.sort_by(|one, other| away_m2(one).total_cmp(&away_m2(other)));
    order
}

/// The links of so many scan-first forests of the graph with these `links`. Robots are scanned in this `order` where there is a
/// choice.
fn certificate(robots: usize, links: &[[usize; 2]], forests: usize, order: &[usize]) -> Vec<[usize; 2]> {
    let mut left: Vec<[usize; 2]> = links.to_vec();
    let mut kept = Vec::new();
    for _ in 0..forests {
        let forest = scan_first_forest(robots, &left, order);
        left.retain(|pair| !forest.contains(pair));
        kept.extend(forest);
    }
    kept
}

/// Scans robots one after the other: to scan a robot is to mark all its neighbours that are not marked, with a link to each. Marked
/// robots are scanned first, so that every part of the graph becomes one tree.
fn scan_first_forest(robots: usize, links: &[[usize; 2]], order: &[usize]) -> Vec<[usize; 2]> {
    let (mut marked, mut scanned) = (vec![false; robots], vec![false; robots]);
    let mut forest = Vec::new();
    let next = |marked: &[bool], scanned: &[bool]| {
        let open = || order.iter().copied().filter(|robot| !scanned[*robot]);
        open().find(|robot| marked[*robot]).or_else(|| open().next())
    };
    while let Some(robot) = next(&marked, &scanned) {
        (marked[robot], scanned[robot]) = (true, true);
        for pair in links.iter().filter(|pair| pair.contains(&robot)) {
            let other = pair[0] + pair[1] - robot;
            if !marked[other] {
                marked[other] = true;
                forest.push(*pair);
            }
        }
    }
    forest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controllers::Controller;
    use crate::controllers::shared::testing::{outward, watch};

    /// True if the graph stays connected without any `removed` or fewer of its robots: by trying all sets.
    fn is_connected_without(robots: usize, links: &[[usize; 2]], removed: u32) -> bool {
        (0..1_u32 << robots).filter(|gone| gone.count_ones() <= removed).all(|gone| {
            let here = |robot: usize| gone & (1 << robot) == 0;
            let mut reached = 1_u32 << (0..robots).find(|robot| here(*robot)).unwrap();
            loop {
                let grown = links.iter().filter(|[one, other]| here(*one) && here(*other)).fold(
                    reached,
                    |reached, [one, other]| {
                        let either = reached & (1 << one | 1 << other) != 0;
                        if either { reached | 1 << one | 1 << other } else { reached }
                    },
                );
                if grown == reached {
                    break;
                }
                reached = grown;
            }
            (reached | gone).count_ones() as usize == robots
        })
    }

    #[test]
    fn the_certificate_is_as_connected_as_it_has_forests() {
        let order: Vec<usize> = (0..9).collect();
        for seed in 0..60_usize {
            let pairs = (0..9).flat_map(|one| (one + 1..9).map(move |other| [one, other]));
            let links: Vec<[usize; 2]> =
                pairs.filter(|[one, other]| (one * 31 + other * 17 + seed * 7) % 10 < 7).collect();
            for forests in 1..=4_u32 {
                let kept = certificate(9, &links, forests as usize, &order);
                assert!(kept.len() <= 8 * forests as usize && kept.iter().all(|pair| links.contains(pair)));
                let whole = is_connected_without(9, &links, forests - 1);
                assert_eq!(
                    is_connected_without(9, &kept, forests - 1),
                    whole,
                    "seed {seed}, {forests} forests"
                );
            }
        }
    }

    #[test]
    fn no_four_robots_cut_the_team() {
        let mut tick = 0;
        let grown = watch(&outward(Controller::KConnectivity), |view| {
            if tick % 50 == 0 {
                assert!(is_connected_without(11, &pairs_in_range(view), 4), "tick {tick}");
            }
            tick += 1;
        });
        assert!(grown > 1.1, "{grown}");
    }
}
