//! The state of a team as only the world knows it: what the theorems are about.

use closeranks_core::controller::budget::knowledge::Sighting;
use closeranks_core::equations::link::{Link, LinkShape};
use closeranks_core::num::{Vector, length, subtract};
use closeranks_core::obstacle::Obstacle;
use closeranks_core::settings::params::Params;

use crate::frame::Frame;
use crate::geometry::around::Around;
use crate::geometry::squared_distance;
use crate::monitors::glance::Glance;
use crate::monitors::pairs::Pairs;
pub(crate) use crate::monitors::rounding::ROUNDING;
use crate::monitors::rounding::rounding_m2;
use crate::monitors::rule::Rule;

/// A link that has no more room than this beside an obstacle, m, is cut.
const CUT_M: f64 = 1e-9;
/// Robots that sense exactly count on links that have so much room, m, and keep it.
pub(crate) const WHOLE_M: f64 = 8e-5;

/// A robot of another team near one of this.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stranger {
    /// The one of this team.
    pub(crate) robot: usize,
    /// The squared distance of references, m².
    pub(crate) distance_m2: f64,
    /// True if the other one moves as it likes.
    pub(crate) disobedient: bool,
}

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
    /// True if some link has so little room beside what would cut it that a robot need not count on it.
    pub(crate) grazes: bool,
    /// For each pair whether something cuts the link between their positions; empty where nothing cuts links.
    cut: Vec<bool>,
    /// Robots of other teams within reach of a robot, by references.
    pub(crate) strangers: Vec<Stranger>,
    /// False if, under ranks, more than F of those that count for some normal robot and are in range are malicious.
    pub(crate) is_local: bool,
    /// The greatest coordinate of any position or reference, m.
    pub(crate) span_m: f64,
    /// Who is near whom, with free liars and weights.
    around: Around,
    /// R², m².
    radius_m2: f64,
    /// Memory for the weights and the slopes of all pairs.
    scratch: [Vec<f64>; 2],
}

impl Truth {
    /// The truth of `frame`. A team of `composed` in a perfect world knows it itself: then nothing is computed twice.
    pub(crate) fn look<const D: usize>(
        &mut self,
        params: &Params<D>,
        rule: &Rule,
        malicious: &[bool],
        frame: &Frame<D>,
        plain: bool,
    ) {
        self.measure(params, frame);
        if plain {
            return self.take(frame, rule);
        }
        let free = rule.is_free();
        self.sum(params, rule, malicious, frame);
        self.leave_out(&frame.presence.absent);
        let lists = params.controller().tells_lists();
        if lists {
            // Without weights it is the degree itself that is kept.
            self.h.clear();
            self.h.extend(self.degrees.iter().map(|degree| f64::from(*degree)));
            leave_out(&mut self.h, &frame.presence.absent);
        }
        for (robot, h) in self.h.iter_mut().enumerate() {
            *h -= f64::from(rule.required(robot));
        }
        self.h_own.clone_from(&self.h);
        if free && !lists {
            self.around.look(&frame.positions_m, wide_m(params));
            let there = |(robot, _): &(usize, &mut f64)| !frame.presence.absent[*robot];
            for (robot, own) in self.h_own.iter_mut().enumerate().filter(there) {
                let around = self.around.of(robot);
                *own = trimmed(params, rule, frame, robot, around) - f64::from(rule.required(robot));
            }
        }
    }

    /// What whoever watches the run sees of `frame`, and of the rest that of which a `glance` has shown that nothing else is asked, until the
    /// next tick [asks](Pairs::catch_up) for pairs.
    pub(crate) fn glance<const D: usize>(&mut self, frame: &Frame<D>, glance: &Glance<'_>) {
        self.is_local = true;
        match &glance.levels {
            Some(levels) => {
                self.levels.clear();
                self.levels.extend(levels.iter());
            }
            None => self.levels.clone_from(&frame.levels),
        }
        self.degrees.clone_from(&frame.degrees);
        self.neighbors.clone_from(&frame.degrees);
        (self.least_m2, self.span_m) = (glance.least_m2, glance.span_m);
        self.pairs.put_off(frame.positions_m.len());
    }

    /// Those who are absent have no level and no h.
    fn leave_out(&mut self, absent: &[bool]) {
        for numbers in [&mut self.levels, &mut self.paper_levels, &mut self.h] {
            leave_out(numbers, absent);
        }
    }

    /// Distances, and how far from the origin the team is.
    pub(crate) fn measure<const D: usize>(&mut self, params: &Params<D>, frame: &Frame<D>) {
        self.radius_m2 = params.link().radius_m * params.link().radius_m;
        self.pairs.look(&frame.positions_m, &frame.references_m, wide_m(params));
        let lesser = |least: f64, pair_m2: &f64| if *pair_m2 < least { *pair_m2 } else { least };
        self.least_m2 = self.pairs.references_m2().iter().fold(f64::INFINITY, lesser);
        let coordinates = frame.positions_m.iter().chain(&frame.references_m).flatten();
        self.span_m = coordinates.fold(0.0, |most: f64, x| most.max(x.abs()));
        self.meet(wide_m(params), frame);
        self.part(frame);
    }

    /// Finds the links that obstacles cut.
    //= theory sec:cut
    fn part<const D: usize>(&mut self, frame: &Frame<D>) {
        let Self { cut, grazes, pairs, radius_m2, .. } = self;
        cut.clear();
        *grazes = false;
        if frame.cutting.is_empty() {
            return;
        }
        pairs.each(|place, [first, second]| {
            let room_m = if pairs.positions_m2()[place] <= *radius_m2 {
                room_m(&frame.cutting, &frame.positions_m[first], &frame.positions_m[second])
            } else {
                f64::INFINITY
            };
            cut.push(room_m <= CUT_M);
            *grazes |= room_m > CUT_M && room_m < WHOLE_M;
        });
    }

    /// Finds robots of other teams that are no farther away than `wide_m`.
    fn meet<const D: usize>(&mut self, wide_m: f64, frame: &Frame<D>) {
        self.strangers.clear();
        let others = frame.strangers.references_m.iter().zip(&frame.strangers.disobedient);
        for (x, disobedient) in others {
            for (robot, own) in frame.references_m.iter().enumerate() {
                let distance_m2 = squared_distance(own, x);
                if distance_m2 <= wide_m * wide_m {
                    self.strangers.push(Stranger { robot, distance_m2, disobedient: *disobedient });
                }
            }
        }
    }

    /// Sums of weights, and degrees. With `free` liars only links to normal robots count for h.
    fn sum<const D: usize>(&mut self, params: &Params<D>, rule: &Rule, malicious: &[bool], frame: &Frame<D>) {
        let free = rule.is_free();
        let margin = params.kept().errors.away_m > 0.0;
        let ranked = rule.ranks().is_some();
        let counts = |robot: usize, other: usize| rule.counts(robot, other) && !(free && malicious[other]);
        let all = |_, _| true;
        self.resize(frame.positions_m.len());
        let (pairs, scratch) = (&self.pairs, &mut self.scratch);
        let positions_m2 = pairs.positions_m2();
        weigh(params.link(), positions_m2, scratch);
        part(&self.cut, &mut scratch[0]);
        add_up(pairs, &scratch[0], all, &mut self.levels, &mut self.degrees);
        self.h.clone_from(&self.levels);
        self.neighbors.clone_from(&self.degrees);
        if free || ranked {
            add_up(pairs, &scratch[0], counts, &mut self.h, &mut self.degrees);
        }
        if frame.wants_phi && params.weighs_its_own_way() {
            weigh(&params.paper_link(), positions_m2, scratch);
            part(&self.cut, &mut scratch[0]);
            let degrees = &mut vec![0; self.degrees.len()];
            add_up(pairs, &scratch[0], all, &mut self.paper_levels, degrees);
        } else {
            self.paper_levels.clone_from(&self.levels);
        }
        if free || margin {
            let degrees = &mut vec![0; self.degrees.len()];
            weigh(&params.kept().link, pairs.references_m2(), scratch);
            part(&self.cut, &mut scratch[0]);
            add_up(pairs, &scratch[0], counts, &mut self.h, degrees);
        }
        self.is_local = !ranked || self.at_most_around(rule, malicious);
    }

    /// The truth as robots know it that sense exactly.
    fn take<const D: usize>(&mut self, frame: &Frame<D>, rule: &Rule) {
        self.is_local = true;
        self.levels.clone_from(&frame.levels);
        self.paper_levels.clone_from(&frame.levels);
        self.degrees.clone_from(&frame.degrees);
        self.neighbors.clone_from(&frame.degrees);
        self.h.clear();
        self.h.extend((0..).zip(&frame.levels).map(|(robot, level)| level - f64::from(rule.required(robot))));
        self.h_own.clone_from(&self.h);
    }

    /// True if at most F of those that count for each normal robot and are in range are malicious.
    fn at_most_around(&self, rule: &Rule, malicious: &[bool]) -> bool {
        let mut liars = vec![0; malicious.len()];
        let radius_m2 = self.radius_m2;
        self.pairs.each(|place, [first, second]| {
            for (end, other) in [(first, second), (second, first)] {
                let linked = self.cut.get(place) != Some(&true);
                let near = malicious[other] && self.pairs.positions_m2()[place] <= radius_m2 && linked;
                liars[end] += u16::from(near && rule.counts(end, other));
            }
        });
        liars.iter().zip(malicious).all(|(liars, lies)| *lies || *liars <= rule.faults())
    }

    /// How much a squared distance of about `distance_m2` (m²) may be rounded, m²: it scales with the numbers compared.
    pub(crate) fn rounding_m2(&self, distance_m2: f64) -> f64 {
        rounding_m2(self.span_m, distance_m2)
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

/// How much room the straight way between two robots has beside what cuts links, m.
pub(crate) fn room_m<const D: usize>(cutting: &[Obstacle<D>], x: &Vector<D>, y: &Vector<D>) -> f64 {
    let room_m = |one: &Obstacle<D>| length(&one.offset_between_m(x, y)) - one.radius_m;
    cutting.iter().map(room_m).fold(f64::INFINITY, f64::min)
}

/// What is cut is no link.
fn part(cut: &[bool], weights: &mut [f64]) {
    for (weight, _) in weights.iter_mut().zip(cut).filter(|(_, cut)| **cut) {
        *weight = Link::NONE.weight;
    }
}

/// Fills `weights` with those of pairs with these squared distances, m².
fn weigh(shape: &LinkShape, pairs_m2: &[f64], [weights, slopes]: &mut [Vec<f64>; 2]) {
    weights.clear();
    weights.extend_from_slice(pairs_m2);
    slopes.resize(weights.len(), 0.0);
    shape.links_at(weights, slopes);
}

/// Sum and number of the links of every robot with the others that count, in order of their numbers; each pair once.
fn add_up(
    pairs: &Pairs,
    weights: &[f64],
    counts: impl Fn(usize, usize) -> bool,
    sums: &mut [f64],
    degrees: &mut [u16],
) {
    sums.fill(0.0);
    degrees.fill(0);
    pairs.each(|place, [first, second]| {
        let weight = weights[place];
        if !Link::is_link(weight) || weight.is_nan() {
            return;
        }
        for (end, other) in [(second, first), (first, second)] {
            if counts(end, other) {
                sums[end] += weight;
                degrees[end] += 1;
            }
        }
    });
}

fn leave_out(numbers: &mut [f64], absent: &[bool]) {
    for (number, _) in numbers.iter_mut().zip(absent).filter(|(_, absent)| **absent) {
        *number = f64::NAN;
    }
}

/// The trimmed sum T_i of a robot that senses exactly, from whom it has `around` it.
fn trimmed<const D: usize>(
    params: &Params<D>,
    rule: &Rule,
    frame: &Frame<D>,
    robot: usize,
    around: &[u16],
) -> f64 {
    let own = frame.positions_m[robot];
    let sighting =
        |other: usize| Sighting::new(rule.member(other), subtract(&own, &frame.positions_m[other]));
    let sightings: Vec<Sighting<D>> = around.iter().map(|other| sighting(usize::from(*other))).collect();
    let scratch = &mut vec![0.0; sightings.len()];
    params.controller().certain_level(rule.member(robot), &sightings, scratch).unwrap_or(0.0)
}
