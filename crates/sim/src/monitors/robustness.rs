//! Exact robustness of the network in every consensus round.

use core::ops::ControlFlow;

use closeranks_graph::decide::Robustness;
use closeranks_graph::effort::{Effort, Meter};
use closeranks_graph::graph::Graph;
use closeranks_graph::makers::random::geometric;
use closeranks_graph::verdict::Interval;

use closeranks_core::num::Vector;
use closeranks_core::obstacle::is_cut;

use crate::frame::Frame;

/// Nodes of the search that one round may cost, of order a microsecond each. Teams of eleven need some tens.
const NODES: u64 = 20_000;

/// How many rounds are kept of a run at most; of a longer one [`thin`] chooses.
pub const ROUNDS_MAX: usize = 1 << 14;

/// What a consensus round found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    /// Tick of the round.
    pub tick: u32,
    /// Largest r for which the network is r-robust.
    pub r_max: Interval,
    /// Largest F for which it is (F+1, F+1)-robust, malicious robots included; −1 if not even (1, 1)-robust.
    pub f_max: Interval,
    /// Least degree of normal robots.
    pub degree_min: u16,
    /// Greatest minus least value of normal robots.
    pub spread: f64,
}

/// Looks at the network once a round; a network that did not change is not searched again.
#[derive(Clone, Debug, Default)]
pub struct Watcher {
    last: Option<(Graph, Interval, Interval)>,
    rounds: Vec<Round>,
}

impl Watcher {
    /// Adds the round of `frame`; teams of more robots than the search takes (128) are left out.
    //= paper def:robustness
    pub fn watch<const D: usize>(&mut self, tick: u32, frame: &Frame<D>, radius_m: f64, malicious: &[bool]) {
        let there: Vec<Vector<D>> = frame.positions_m.iter().filter(|x| !x[0].is_nan()).copied().collect();
        let Ok(mut graph) = geometric(&there, radius_m) else { return };
        for (second, y) in there.iter().enumerate().filter(|_| !frame.cutting.is_empty()) {
            for (first, x) in there[..second].iter().enumerate() {
                if is_cut(&frame.cutting, x, y) {
                    graph.remove_edge(first, second);
                }
            }
        }
        let (r_max, f_max) = match self.last.take() {
            Some((last, r_max, f_max)) if last == graph => (r_max, f_max),
            _ => largest(&graph),
        };
        self.last = Some((graph, r_max, f_max));
        let normal = || {
            let aside = malicious.iter().zip(&frame.presence.absent).map(|(liar, absent)| *liar || *absent);
            aside.zip(&frame.degrees).filter(|(aside, _)| !aside).map(|(_, degree)| *degree)
        };
        let (degree_min, spread) = (normal().min().unwrap_or(0), spread(&frame.values, malicious));
        self.rounds.push(Round { tick, r_max, f_max, degree_min, spread });
        if self.rounds.len() > ROUNDS_MAX {
            thin(&mut self.rounds);
        }
    }

    /// Whether so many rounds are kept that whoever wants each of them should take them.
    pub(crate) fn is_full(&self) -> bool {
        self.rounds.len() >= ROUNDS_MAX / 2
    }

    /// Hands over the rounds that are kept, and forgets them.
    pub(crate) fn take(&mut self) -> Vec<Round> {
        core::mem::take(&mut self.rounds)
    }

    /// All rounds in order, or those that [`thin`] kept of a very long run.
    #[must_use]
    pub fn finish(self) -> Vec<Round> {
        self.rounds
    }
}

/// Largest r and largest F, exactly or as far as the budget goes.
fn largest(graph: &Graph) -> (Interval, Interval) {
    let mut go_on = |_: &_| ControlFlow::Continue(());
    let mut meter = Meter::new(NODES, &mut go_on);
    let mut robustness = Robustness::new(graph, &Effort { nodes: NODES, table_bytes: 0 });
    (robustness.r_max(&mut meter), robustness.f_max(&mut meter))
}

fn spread(values: &[f64], malicious: &[bool]) -> f64 {
    let normal = || values.iter().zip(malicious).filter(|(_, liar)| !**liar).map(|(value, _)| *value);
    let (low, high) = (normal().fold(f64::INFINITY, f64::min), normal().fold(f64::NEG_INFINITY, f64::max));
    (high - low).max(0.0)
}

/// The round with the least proved F_max, and with the least proved r_max among those.
#[must_use]
pub fn weakest(rounds: &[Round]) -> Option<&Round> {
    rounds.iter().min_by_key(|round| (round.f_max.least, round.r_max.least))
}

/// The round with the least proved r_max.
#[must_use]
pub fn narrowest(rounds: &[Round]) -> Option<&Round> {
    rounds.iter().min_by_key(|round| round.r_max.least)
}

/// Keeps about half of many rounds: the [`weakest`] and the [`narrowest`] of every four in a row. So those of the whole run are kept.
pub fn thin(rounds: &mut Vec<Round>) {
    let kept = rounds.chunks(4).flat_map(|four| {
        let mut two = [weakest(four), narrowest(four)];
        two.sort_by_key(|round| round.map(|round| round.tick));
        two.into_iter().flatten().copied()
    });
    let mut kept: Vec<Round> = kept.collect();
    kept.dedup_by_key(|round| round.tick);
    *rounds = kept;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn watched(positions: Vec<Vector<2>>) -> Round {
        let robots = positions.len();
        let mut watcher = Watcher::default();
        watcher.watch(0, &Frame::new(positions, vec![0.0; robots]), 1.0, &vec![false; robots]);
        watcher.finish()[0]
    }

    //= paper def:robustness type=test
    #[test]
    fn a_cluster_is_as_robust_as_a_complete_graph_and_a_line_is_not() {
        let cluster = watched((0..7).map(|i| [0.1 * f64::from(i), 0.0]).collect());
        assert_eq!((cluster.r_max.exactly(), cluster.f_max.exactly()), (Some(4), Some(3)));
        let line = watched((0..7).map(|i| [0.9 * f64::from(i), 0.0]).collect());
        assert_eq!((line.r_max.exactly(), line.f_max.exactly()), (Some(1), Some(0)));
        let apart = watched(vec![[0.0, 0.0], [2.0, 0.0]]);
        assert_eq!((apart.r_max.exactly(), apart.f_max.exactly()), (Some(0), Some(-1)));
    }

    #[test]
    fn the_weakest_round_is_found() {
        let strong = watched(vec![[0.0, 0.0], [0.5, 0.0], [0.2, 0.3]]);
        let weak = Round { tick: 9, ..watched(vec![[0.0, 0.0], [0.9, 0.0], [1.8, 0.0]]) };
        assert_eq!(weakest(&[strong, weak, strong]).map(|round| round.tick), Some(9));
        assert_eq!(weakest(&[]), None);
    }

    #[test]
    fn thinned_rounds_are_fewer_and_keep_the_extremes() {
        let exactly = |value| Interval { least: value, most: value };
        let round = |tick: u32| Round {
            tick,
            r_max: exactly(if tick == 611 { 1 } else { 4 }),
            f_max: exactly(if tick == 902 { 0 } else { 2 }),
            degree_min: 6,
            spread: 1.0,
        };
        let all: Vec<Round> = (0..1_000).map(round).collect();
        let mut few = all.clone();
        for most in [500, 250, 125] {
            thin(&mut few);
            assert!(few.len() <= most + 2, "{}", few.len());
            assert!(few.is_sorted_by(|one, next| one.tick < next.tick));
        }
        assert_eq!(weakest(&few), weakest(&all));
        assert_eq!(narrowest(&few), narrowest(&all));
    }

    #[test]
    fn a_watcher_keeps_a_bounded_number_of_rounds() {
        let mut watcher = Watcher::default();
        let frame = Frame::new(vec![[0.0, 0.0], [0.5, 0.0]], vec![0.0; 2]);
        for (tick, _) in (0..).zip(0..3 * ROUNDS_MAX) {
            watcher.watch(tick, &frame, 1.0, &[false; 2]);
            assert!(watcher.rounds.len() <= ROUNDS_MAX);
        }
        assert!(watcher.is_full());
        assert!(watcher.take().len() >= ROUNDS_MAX / 4);
        assert!(watcher.finish().is_empty());
    }
}
