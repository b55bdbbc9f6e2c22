//! φ_i, and the levels and sums behind it, of robots whose controller does not use them: the numbers of
//! [`PaperPhi`](crate::engine::phi::PaperPhi) of many worlds at once.

use closeranks_core::equations::composition::Composed;
use closeranks_core::equations::lanes::{PairInLanes, PhiInLanes};
use closeranks_core::equations::link::LinkShape;
use closeranks_core::num::lane::{LANES, Lane};

use crate::engine::lanes::ends;

/// The numbers of a tick, robot after robot.
#[derive(Clone, Debug)]
pub(super) struct PhiLanes {
    composed: Composed,
    link: LinkShape,
    pairs: Vec<PairInLanes>,
    /// c_i of the paper's weight.
    pub(super) levels: Vec<Lane>,
    sums: Vec<PhiInLanes>,
    pub(super) phis: Vec<Lane>,
    /// The sums of all E_i and of all E^c_ij.
    pub(super) terms: Lane,
    pub(super) collisions: Lane,
}

impl PhiLanes {
    /// For teams of so many robots.
    pub(super) fn new(composed: Composed, link: LinkShape, robots: usize) -> Self {
        Self {
            composed,
            link,
            pairs: vec![PairInLanes::NONE; robots * robots.saturating_sub(1) / 2],
            levels: vec![[0.0; LANES]; robots],
            sums: vec![PhiInLanes::new([0.0; LANES]); robots],
            phis: vec![[0.0; LANES]; robots],
            terms: [0.0; LANES],
            collisions: [0.0; LANES],
        }
    }

    /// Takes in where robots are, m.
    pub(super) fn look<const D: usize>(&mut self, positions_m: &[[Lane; D]]) {
        self.weigh(positions_m);
        self.terms = [0.0; LANES];
        for (sums, level) in self.sums.iter_mut().zip(&self.levels) {
            *sums = PhiInLanes::new(self.composed.terms_in_lanes(level));
            add(&mut self.terms, &sums.own);
        }
        let mut pairs = self.pairs.iter();
        for second in 0..positions_m.len() {
            let (firsts, own) = ends(&mut self.sums, second);
            for (first, pair) in firsts.iter_mut().zip(&mut pairs) {
                self.composed.add_phis_in_lanes(first, own, pair);
            }
        }
        for (phis, sums) in self.phis.iter_mut().zip(&self.sums) {
            *phis = self.composed.phis_in_lanes(sums);
        }
    }

    fn weigh<const D: usize>(&mut self, positions_m: &[[Lane; D]]) {
        let Self { composed, link, pairs, levels, collisions, .. } = self;
        *collisions = [0.0; LANES];
        levels.fill([0.0; LANES]);
        let mut pairs = pairs.iter_mut();
        for (second, second_m) in positions_m.iter().enumerate() {
            let (levels, own) = ends(levels, second);
            for ((level, first_m), pair) in levels.iter_mut().zip(positions_m).zip(&mut pairs) {
                composed.pair_in_lanes(link, first_m, second_m, pair);
                add_link(pair, level, own, collisions);
            }
        }
    }

    /// True if no φ_i of a world overflowed.
    pub(super) fn is_finite(&self, lane: usize) -> bool {
        self.phis.iter().all(|phis| phis[lane].is_finite())
    }
}

/// Adds a link, or nothing where there is none.
#[inline(never)]
fn add_link(pair: &PairInLanes, first: &mut Lane, second: &mut Lane, collisions: &mut Lane) {
    for k in 0..LANES {
        collisions[k] += pair.collision(k).0;
        first[k] += pair.weights[k];
        second[k] += pair.weights[k];
    }
}

fn add(sum: &mut Lane, numbers: &Lane) {
    for (sum, number) in sum.iter_mut().zip(numbers) {
        *sum += number;
    }
}
