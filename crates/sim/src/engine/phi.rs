//! φ_i of robots whose controller does not use it.

use closeranks_core::equations::composition::{Composed, Sum};
use closeranks_core::equations::link::{Link, LinkShape};
use closeranks_core::num::Vector;
use closeranks_core::settings::params::Params;

use crate::frame::Frame;
use crate::geometry::around::Around;
use crate::geometry::near::Near;
use crate::geometry::squared_distance;
use crate::scenario::Scenario;

/// Computes φ_i of all robots at once.
#[derive(Clone, Debug)]
pub(crate) struct Phi {
    composed: Composed,
    terms: Vec<f64>,
    sums: Vec<Sum<0, f64>>,
    radius_m: f64,
    around: Around,
}

impl Phi {
    /// For the robots of `scenario`.
    pub(crate) fn new(scenario: &Scenario) -> Self {
        Self {
            composed: scenario.composition(),
            terms: Vec::new(),
            sums: Vec::new(),
            radius_m: scenario.link.radius_m,
            around: Around::default(),
        }
    }

    /// φ_i of every robot, from the `levels` of all and all distances. `links` are robots with their neighbours of lower numbers.
    pub(crate) fn fill<'a, const D: usize>(
        &mut self,
        links: impl Iterator<Item = (usize, &'a [u16])>,
        levels: &[f64],
        positions_m: &[Vector<D>],
        phis: &mut [f64],
    ) {
        let composed = self.composed;
        self.terms.clear();
        self.terms.extend(levels.iter().map(|level| composed.degree_term::<f64>(*level)));
        self.sums.clear();
        self.sums.extend(self.terms.iter().map(|term| Sum::new(*term)));
        for (second, firsts) in links {
            for first in firsts.iter().map(|first| usize::from(*first)) {
                let distance_m2 = squared_distance(&positions_m[first], &positions_m[second]);
                let collision = composed.collision_term(distance_m2);
                for (end, other) in [(first, second), (second, first)] {
                    self.sums[end].add_told(composed.shared(self.terms[other]));
                    self.sums[end].add_link(&[], 0.0, collision);
                }
            }
        }
        for (place, sum) in phis.iter_mut().zip(&self.sums) {
            *place = sum.phi(&composed);
        }
        if phis.iter().all(|phi| phi.is_finite()) {
            return;
        }
        self.around.look(positions_m, self.radius_m);
        for (robot, phi) in phis.iter_mut().enumerate().filter(|(_, phi)| !phi.is_finite()) {
            *phi = self.careful(robot, levels, positions_m);
        }
    }

    /// φ_i of a robot whose plain sums overflowed.
    fn careful<const D: usize>(&self, robot: usize, levels: &[f64], positions_m: &[Vector<D>]) -> f64 {
        let own = &positions_m[robot];
        let near = self.around.of(robot).iter().map(|other| usize::from(*other));
        let distances_m2 = near.clone().map(|other| squared_distance(own, &positions_m[other]));
        self.composed.phi(levels[robot], near.map(|other| levels[other]), distances_m2)
    }
}

/// φ_i under a controller that gives links a weight of its own. Nobody tells levels of the paper's weight there, so it is φ_i
/// of true positions and of true levels.
#[derive(Clone, Debug)]
pub(crate) struct PaperPhi {
    phi: Phi,
    link: LinkShape,
    near: Near,
    levels: Vec<f64>,
    /// First ends, second end after second end, and where those of each second end begin and stop.
    firsts: Vec<u16>,
    stops: Vec<usize>,
}

impl PaperPhi {
    /// `None` where robots tell levels, of the weight that the paper gives to links.
    pub(crate) fn new<const D: usize>(scenario: &Scenario, params: &Params<D>) -> Option<Self> {
        (!params.tells_paper_levels()).then(|| Self {
            phi: Phi::new(scenario),
            link: params.paper_link(),
            near: Near::default(),
            levels: Vec::new(),
            firsts: Vec::new(),
            stops: Vec::new(),
        })
    }

    /// Fills φ_i of every robot that is not `down`.
    pub(crate) fn fill<const D: usize>(&mut self, frame: &mut Frame<D>, down: impl Fn(usize) -> bool) {
        self.weigh(&frame.positions_m);
        let Self { phi, levels, firsts, stops, .. } = self;
        let begins = core::iter::once(&0).chain(&*stops);
        let links = begins.zip(&*stops).map(|(from, to)| &firsts[*from..*to]).enumerate();
        phi.fill(links, levels, &frame.positions_m, &mut frame.phis);
        for (_, phi) in frame.phis.iter_mut().enumerate().filter(|(robot, _)| down(*robot)) {
            *phi = f64::NAN;
        }
    }

    /// Finds all links, and the levels of the paper's weight.
    fn weigh<const D: usize>(&mut self, positions_m: &[Vector<D>]) {
        let Self { link, near, levels, firsts, stops, .. } = self;
        levels.clear();
        firsts.clear();
        stops.clear();
        levels.resize(positions_m.len(), 0.0);
        near.look(positions_m, link.radius_m);
        for second in 0..positions_m.len() {
            let (before, distances_m2) = near.before(second, positions_m, link.radius_m);
            for (first, distance_m2) in before.iter().zip(distances_m2) {
                let weight = link.link_at(*distance_m2).map_or(0.0, |link: Link<f64>| link.weight);
                levels[usize::from(*first)] += weight;
                levels[second] += weight;
            }
            firsts.extend_from_slice(before);
            stops.push(firsts.len());
        }
    }
}
