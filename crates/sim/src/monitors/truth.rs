//! The state of a team as only the world knows it: what the theorems are about.

use closeranks_core::controller::budget::knowledge::Sighting;
use closeranks_core::equations::link::{Link, LinkShape};
use closeranks_core::num::{sqrt, subtract};
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::settings::Team;
use closeranks_core::settings::params::Params;

use crate::frame::Frame;
use crate::monitors::pairs::Pairs;

/// Sums of weights are rounded by far less than this, and squares of distances by less than this fraction of themselves.
pub(crate) const ROUNDING: f64 = 1e-11;
/// Coordinates are rounded by far less than this fraction of themselves in a tick.
const PLACE_ROUNDING: f64 = 1e-14;

/// True levels, degrees and distances of one tick.
#[derive(Clone, Debug, Default)]
pub(crate) struct Truth {
    /// c_i within R, of the weight that robots use.
    pub(crate) levels: Vec<f64>,
    /// δ_i: neighbours within R.
    pub(crate) neighbors: Vec<u16>,
    /// c_i of the paper's weight, where somebody wants to know φ.
    pub(crate) paper_levels: Vec<f64>,
    /// Neighbours that count: all, or with free liars the normal ones.
    pub(crate) degrees: Vec<u16>,
    /// What is kept at 0 or above: h_i of references; with free liars the sum over normal neighbours, less θ.
    pub(crate) h: Vec<f64>,
    /// h_i as a robot has it that senses exactly: with free liars of the trimmed sum.
    pub(crate) h_own: Vec<f64>,
    /// Squared distances of references and of positions.
    pub(crate) pairs: Pairs,
    /// The least of those of references, m²; of a sparse team that has none near it is infinite.
    pub(crate) least_m2: f64,
    /// The greatest coordinate of any position or reference, m.
    pub(crate) span_m: f64,
    /// Memory for the weights and the slopes of all pairs.
    scratch: [Vec<f64>; 2],
}

impl Truth {
    /// The truth of `frame`. A team of `composed` in a perfect world knows it itself: then nothing is computed twice.
    pub(crate) fn look<const D: usize>(
        &mut self,
        params: &Params<D>,
        malicious: &[bool],
        frame: &Frame<D>,
        plain: bool,
    ) {
        self.measure(params, frame);
        let required = f64::from(required(params));
        if plain {
            return self.take(frame, required);
        }
        let free = is_free(params);
        self.sum(params, malicious, frame, free);
        let lists = params.controller().tells_lists();
        if lists {
            // Without weights it is the degree itself that is kept.
            self.h.clear();
            self.h.extend(self.degrees.iter().map(|degree| f64::from(*degree)));
        }
        for h in &mut self.h {
            *h -= required;
        }
        self.h_own.clone_from(&self.h);
        if free && !lists {
            for (robot, own) in self.h_own.iter_mut().enumerate() {
                *own = trimmed(params, frame, robot) - required;
            }
        }
    }

    /// Distances, and how far from the origin the team is.
    fn measure<const D: usize>(&mut self, params: &Params<D>, frame: &Frame<D>) {
        self.pairs.look(&frame.positions_m, &frame.references_m, wide_m(params));
        let lesser = |least: f64, pair_m2: &f64| if *pair_m2 < least { *pair_m2 } else { least };
        self.least_m2 = self.pairs.references_m2().iter().fold(f64::INFINITY, lesser);
        let coordinates = frame.positions_m.iter().chain(&frame.references_m).flatten();
        self.span_m = coordinates.fold(0.0, |most: f64, x| most.max(x.abs()));
    }

    /// Sums of weights, and degrees. With `free` liars only links to normal robots count for h.
    fn sum<const D: usize>(&mut self, params: &Params<D>, malicious: &[bool], frame: &Frame<D>, free: bool) {
        let margin = params.kept().errors.away_m > 0.0;
        let counts = |robot: usize| !(free && malicious[robot]);
        self.resize(frame.positions_m.len());
        let (pairs, scratch) = (&self.pairs, &mut self.scratch);
        let positions_m2 = pairs.positions_m2();
        weigh(params.link(), pairs, positions_m2, |_| true, &mut self.levels, &mut self.degrees, scratch);
        self.h.clone_from(&self.levels);
        self.neighbors.clone_from(&self.degrees);
        if frame.wants_phi && params.weighs_its_own_way() {
            let (shape, sums) = (params.paper_link(), &mut self.paper_levels);
            weigh(&shape, pairs, positions_m2, |_| true, sums, &mut self.degrees, scratch);
        } else {
            self.paper_levels.clone_from(&self.levels);
        }
        if free {
            weigh(params.link(), pairs, positions_m2, counts, &mut self.h, &mut self.degrees, scratch);
        }
        if free || margin {
            let degrees = &mut vec![0; self.degrees.len()];
            let shape = &params.kept().link;
            weigh(shape, pairs, pairs.references_m2(), counts, &mut self.h, degrees, scratch);
        }
    }

    /// The truth as robots know it that sense exactly.
    fn take<const D: usize>(&mut self, frame: &Frame<D>, required: f64) {
        self.levels.clone_from(&frame.levels);
        self.paper_levels.clone_from(&frame.levels);
        self.degrees.clone_from(&frame.degrees);
        self.neighbors.clone_from(&frame.degrees);
        self.h.clear();
        self.h.extend(frame.levels.iter().map(|level| level - required));
        self.h_own.clone_from(&self.h);
    }

    /// How much a squared distance of about `distance_m2` (m²) may be rounded, m²: it scales with the numbers compared.
    pub(crate) fn rounding_m2(&self, distance_m2: f64) -> f64 {
        ROUNDING * distance_m2 + PLACE_ROUNDING * self.span_m * sqrt(distance_m2)
    }

    fn resize(&mut self, count: usize) {
        self.levels.resize(count, 0.0);
        self.paper_levels.resize(count, 0.0);
        self.degrees.resize(count, 0);
    }
}

/// Pairs that are farther apart than this, m, have no link and cannot have met since the tick before.
fn wide_m<const D: usize>(params: &Params<D>) -> f64 {
    let meets_m = params.settings().limits.distance_min_m + 2.0 * params.reach().longest_m();
    params.link().radius_m.max(meets_m * (1.0 + 1e-6))
}

/// Sum and number of the links of every robot with the others that count, in order of their numbers; each pair once.
fn weigh(
    shape: &LinkShape,
    pairs: &Pairs,
    pairs_m2: &[f64],
    counts: impl Fn(usize) -> bool,
    sums: &mut [f64],
    degrees: &mut [u16],
    scratch: &mut [Vec<f64>; 2],
) {
    sums.fill(0.0);
    degrees.fill(0);
    let [weights, slopes] = scratch;
    weights.clear();
    weights.extend_from_slice(pairs_m2);
    slopes.resize(weights.len(), 0.0);
    shape.links_at(weights, slopes);
    pairs.each(|place, [first, second]| {
        let weight = weights[place];
        if !Link::is_link(weight) {
            return;
        }
        for (end, other) in [(second, first), (first, second)] {
            if counts(other) {
                sums[end] += weight;
                degrees[end] += 1;
            }
        }
    });
}

/// The degree that counts: F′, or θ among normal robots with free liars. Written down once more, so that monitors do not rest on what they watch.
pub(crate) fn required<const D: usize>(params: &Params<D>) -> u16 {
    let Team { robots, faults } = params.settings().team;
    let free = is_free(params);
    faults + if free { (robots - faults) / 2 } else { robots / 2 }
}

/// How many neighbours a robot of `links` must count on: those that it needs, and with free liars as many more as may lie.
pub(crate) fn keep<const D: usize>(params: &Params<D>) -> u16 {
    required(params) + if is_free(params) { params.settings().team.faults } else { 0 }
}

/// True if malicious robots may move as they like.
pub(crate) fn is_free<const D: usize>(params: &Params<D>) -> bool {
    !params.controller().is_obeyed()
}

/// The trimmed sum T_i of a robot that senses exactly.
fn trimmed<const D: usize>(params: &Params<D>, frame: &Frame<D>, robot: usize) -> f64 {
    let own = frame.positions_m[robot];
    let id = |index: usize| RobotId(u16::try_from(index + 1).unwrap_or(u16::MAX));
    let others = frame.positions_m.iter().enumerate().filter(|(other, _)| *other != robot);
    let sightings: Vec<Sighting<D>> =
        others.map(|(other, x)| Sighting::new(id(other), subtract(&own, x))).collect();
    let scratch = &mut vec![0.0; sightings.len()];
    params.budget().map_or(0.0, |budget| budget.level(id(robot), &sightings, scratch))
}
