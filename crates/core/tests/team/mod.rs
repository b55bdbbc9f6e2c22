//! A team of robots and the paper's equations for it, written as literally as they are printed, with libm's exponential.

#![allow(dead_code, reason = "not every file of tests needs every equation")]

use closeranks_core::equations::composition::{Composed, Composition, PhiSplit, Term};
use closeranks_core::equations::link::{Link, LinkShape};
use closeranks_core::num::scaled::Scaled;
use closeranks_core::num::{Vector, dot, subtract};

use crate::seeded::Seeded;

#[derive(Clone)]
pub(crate) struct Team<const D: usize> {
    pub(crate) positions: Vec<Vector<D>>,
    /// What each robot claims its level to be.
    pub(crate) claims: Vec<f64>,
    pub(crate) shape: LinkShape,
    pub(crate) composed: Composed,
}

impl<const D: usize> Team<D> {
    /// 3 to 12 robots, each in range of an earlier one; no pair closer than 0.35 m or within 1 mm of the rim.
    pub(crate) fn random(seed: u64, split: PhiSplit) -> Self {
        let mut random = Seeded(seed);
        let count = 3 + random.below(10);
        let robots = u16::try_from(count).unwrap_or(0);
        let faults = u16::try_from(random.below((count - 1) / 2 + 1)).unwrap_or(0);
        let q1 = 2.0 + random.between(0.1, 0.9) / f64::from(robots - 1);
        let shape = LinkShape { radius_m: 3.0, q1, q2: random.between(0.05, 0.9) };
        let composed = Composed {
            split,
            w_r: random.between(0.3, 2.0),
            w_c: random.between(10.0, 25.0),
            alpha: random.between(0.05, 5.0),
            robots,
            required: faults + robots / 2,
            distance_min_m: 0.3,
        };
        let mut positions: Vec<Vector<D>> = vec![[0.0; D]];
        while positions.len() < count {
            let from = positions[random.below(positions.len())];
            let place = from.map(|component| component + random.between(-2.0, 2.0));
            let distance = |other: &Vector<D>| libm::sqrt(square(other, &place));
            let clear = |distance: f64| distance > 0.35 && (distance - shape.radius_m).abs() > 1e-3;
            if positions.iter().all(|other| clear(distance(other))) && distance(&from) < shape.radius_m {
                positions.push(place);
            }
        }
        let mut team = Self { positions, claims: Vec::new(), shape, composed };
        team.claims = team.levels();
        team
    }

    pub(crate) fn count(&self) -> usize {
        self.positions.len()
    }

    /// a_ij of eq:adjacency.
    fn weight(&self, i: usize, j: usize) -> f64 {
        let LinkShape { radius_m, q1, q2 } = self.shape;
        let slack = radius_m * radius_m - square(&self.positions[i], &self.positions[j]);
        if slack < 0.0 { 0.0 } else { q1 / (1.0 + libm::exp(-q2 * slack * slack)) - q1 / 2.0 }
    }

    /// The neighbours N_i.
    pub(crate) fn neighbors(&self, i: usize) -> impl Iterator<Item = usize> + Clone {
        let in_range = move |j: usize| {
            let radius = self.shape.radius_m;
            square(&self.positions[i], &self.positions[j]) <= radius * radius
        };
        (0..self.count()).filter(move |&j| j != i && in_range(j))
    }

    /// c_i of every robot (eq:continuous_a), which honest robots claim.
    pub(crate) fn levels(&self) -> Vec<f64> {
        (0..self.count()).map(|i| self.neighbors(i).map(|j| self.weight(i, j)).sum()).collect()
    }

    /// Ê_k of eq:phi_i.
    pub(crate) fn told_term(&self, k: usize) -> f64 {
        libm::exp(-self.composed.w_r * (self.claims[k] - f64::from(self.composed.required)))
    }

    /// E^c_ij of eq:composition.
    pub(crate) fn collision_term(&self, i: usize, j: usize) -> f64 {
        let barrier = square(&self.positions[i], &self.positions[j]) - self.composed.distance_min_m.powi(2);
        libm::exp(-self.composed.w_c * barrier)
    }

    /// φ of eq:composition, with the claims in place of the levels.
    pub(crate) fn phi(&self) -> f64 {
        let degrees: f64 = (0..self.count()).map(|k| self.told_term(k)).sum();
        let pairs =
            (0..self.count()).flat_map(|i| self.neighbors(i).filter(move |&j| i < j).map(move |j| (i, j)));
        let collisions: f64 = pairs.map(|(i, j)| self.collision_term(i, j)).sum();
        1.0 - degrees - collisions
    }

    /// What robot i knows of j, in the types of the crate.
    pub(crate) fn term(&self, i: usize, j: usize) -> Term<D> {
        let offset_m = subtract(&self.positions[i], &self.positions[j]);
        let link = self.shape.link(&offset_m).unwrap_or(Link { weight: 0.0, slope: Scaled::ZERO });
        let collision = self.composed.collision_term(dot(&offset_m, &offset_m));
        Term { offset_m, link, collision, told: self.composed.degree_term(self.claims[j]) }
    }

    /// φ_i and the row of robot i, as the crate computes them.
    pub(crate) fn composition(&self, i: usize) -> Composition<D> {
        let terms = self.neighbors(i).map(|j| self.term(i, j));
        self.composed.compose(self.composed.degree_term(self.claims[i]), terms)
    }
}

fn square<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    let offset = subtract(a, b);
    dot(&offset, &offset)
}
