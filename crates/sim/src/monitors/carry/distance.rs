//! Distances of robots from tick to tick: how near they come, between ticks too, and how fast.

use closeranks_core::controller::Kept;
use closeranks_core::num::{sqrt, subtract};
use closeranks_core::settings::params::Params;

use crate::attack::MotionAttack;
use crate::frame::Frame;
use crate::geometry::{fill_pairs, nearest_m2, squared_distance};
use crate::law::{Law, Verdicts, Violation};
use crate::monitors::carry::before::Before;
use crate::monitors::glance::Glance;
use crate::monitors::glance::held::Lists;
use crate::monitors::pairs::Places;
use crate::monitors::truth::{ROUNDING, Truth};
use crate::scenario::Scenario;

/// What became of the pairs of a run.
#[derive(Clone, Debug)]
pub(crate) struct Distances<const D: usize> {
    params: Params<D>,
    kept: Kept,
    malicious: Vec<bool>,
    /// Which team each robot is of, where robots of different teams are looked at; else nothing.
    teams: Vec<usize>,
    /// Distances with a malicious robot may collide: it goes where it likes.
    free: bool,
    /// Pairs of the last tick that were safe once and must have been ever since: no assumption was broken.
    apart: Vec<bool>,
    /// The same of a pair that was too far away to be among them.
    far_apart: bool,
    /// Where the pairs of this tick were in the last one.
    places: Places,
    /// `apart` of the tick before.
    scratch: Vec<bool>,
    /// Least squared distance of two robots yet, m².
    least_m2: f64,
}

impl<const D: usize> Distances<D> {
    /// For the robots of `scenario`.
    pub(crate) fn new(scenario: &Scenario, params: Params<D>) -> Self {
        Self {
            malicious: scenario.malicious_mask(),
            teams: Vec::new(),
            free: scenario.attack.motion != MotionAttack::Obedient,
            kept: *params.kept(),
            params,
            apart: Vec::new(),
            far_apart: false,
            places: Places::default(),
            scratch: Vec::new(),
            least_m2: f64::INFINITY,
        }
    }

    /// For robots of several teams: pairs of the same team are left out. `gamma_c` is the largest of all teams, and malicious robots are
    /// `free` or not.
    pub(crate) fn between(
        scenario: &Scenario,
        params: Params<D>,
        teams: Vec<usize>,
        (gamma_c, free): (f64, bool),
    ) -> Self {
        let distances = Self::new(scenario, params);
        Self { teams, free, kept: Kept { gamma_c, ..distances.kept }, ..distances }
    }

    /// Least squared distance of two robots yet, m².
    pub(crate) fn least_m2(&self) -> f64 {
        self.least_m2
    }

    /// Finds where the pairs of this tick were in the last one, if there was one.
    pub(crate) fn find(&mut self, before: Option<&Before<D>>, truth: &Truth) {
        truth.pairs.find_in(before.map(|before| &before.truth.pairs), &mut self.places);
    }

    /// Looks at one tick, whose pairs were found; `before` is the last one, if what held then says something about this one.
    pub(crate) fn watch(
        &mut self,
        tick: u32,
        frame: &Frame<D>,
        truth: &Truth,
        before: Option<&Before<D>>,
        verdicts: &mut Verdicts,
    ) {
        self.watch_nearer(self.near_m2(frame, before), tick, frame, truth, before, verdicts);
        if truth.pairs.is_sparse() && truth.pairs.positions_m2().is_empty() {
            // Nobody is near anybody: this is rare enough to look at every pair.
            let mut pairs_m2 = Vec::new();
            fill_pairs(&frame.positions_m, &mut pairs_m2);
            self.least_m2 = pairs_m2.iter().fold(self.least_m2, |least, pair_m2| least.min(*pair_m2));
        }
    }

    /// Leaves out pairs that are farther apart than the root of `near_m2`, unless they come closer too fast.
    fn watch_nearer(
        &mut self,
        near_m2: f64,
        tick: u32,
        frame: &Frame<D>,
        truth: &Truth,
        before: Option<&Before<D>>,
        verdicts: &mut Verdicts,
    ) {
        if self.all_are_far(near_m2, truth) {
            self.least_m2 = self.least_m2.min(truth.least_m2);
            return;
        }
        let positions_m2 = truth.pairs.positions_m2();
        let mut least_m2 = self.least_m2;
        truth.pairs.each(|place, robots| {
            if self.are_of_one_team(robots) {
                return;
            }
            let distance_m2 = positions_m2[place];
            least_m2 = if distance_m2 < least_m2 { distance_m2 } else { least_m2 };
            let rooms_m2 = before.map(|before| self.rooms_m2(place, truth, before));
            let nears = rooms_m2.is_some_and(|[floor_m2, now_m2]| now_m2 < floor_m2);
            if distance_m2 < near_m2 || nears {
                let pair = Pair { place, robots, distance_m2, rooms_m2 };
                self.watch_pair(&pair, tick, (frame, truth), before, verdicts);
            }
        });
        self.least_m2 = least_m2;
    }

    /// True if nobody need be looked at: all pairs are there, robots are at their references, and of no pair anything need be left but
    /// the least distance, to which none is near.
    fn all_are_far(&self, near_m2: f64, truth: &Truth) -> bool {
        let least_m = self.kept.distance_min_m;
        let far = truth.least_m2 >= near_m2 && truth.least_m2 >= least_m * least_m;
        far && all_are_there(truth)
            && self.kept.gamma_c == 1.0
            && !truth.pairs.is_sparse()
            && truth.pairs.is_of_positions()
    }

    /// True if only pairs of different teams are looked at and this is none.
    fn are_of_one_team(&self, [first, second]: [usize; 2]) -> bool {
        self.teams.get(first).is_some_and(|team| self.teams.get(second) == Some(team))
    }

    /// A pair that is farther apart than the root of this, m², was not too near since the tick before.
    fn near_m2(&self, frame: &Frame<D>, before: Option<&Before<D>>) -> f64 {
        let moves = before.map(|before| frame.positions_m.iter().zip(&before.positions_m));
        let moves_m2 = moves.into_iter().flatten().map(|(x, y)| squared_distance(x, y));
        self.near_after_m2(moves_m2.fold(0.0, f64::max))
    }

    /// The same where nobody moved farther than the root of this, m².
    fn near_after_m2(&self, moved_m2: f64) -> f64 {
        let near_m = self.params.settings().limits.distance_min_m + 2.0 * sqrt(moved_m2);
        near_m * near_m * (1.0 + ROUNDING)
    }

    /// True if no two robots of a plain team are near each other, or were since the tick before.
    pub(crate) fn are_far(&self, glance: &Glance<'_>) -> bool {
        let least_m2 = self.kept.distance_min_m * self.kept.distance_min_m;
        glance.least_m2 >= self.near_after_m2(glance.moved_m2) && glance.least_m2 >= least_m2
    }

    /// True if no two robots of a team came too near each other or too fast since the tick before, as far as its `lists` tell, and all that is safe
    /// stays so.
    pub(crate) fn are_apart(&self, glance: &Glance<'_>, lists: &Lists) -> bool {
        let [least_m, kept_m] = [self.params.settings().limits.distance_min_m, self.kept.distance_min_m];
        !lists.falls && lists.path_m2 >= least_m * least_m && glance.least_m2 >= kept_m * kept_m
    }

    /// Looks at a tick in which all [are far](Self::are_far), and carries what is safe to the next one.
    pub(crate) fn glance(&mut self, glance: &Glance<'_>, moved: bool, inside: bool, moves: bool) {
        self.least_m2 = self.least_m2.min(glance.least_m2);
        self.far_apart = moves && inside;
        if self.far_apart {
            self.apart.fill(true);
        } else if !(moves && moved) {
            self.apart.fill(false);
        }
    }

    /// `D − Δ_d²` of two references, m²: the least that must be left of it since the tick before, and what is left. Of a pair
    /// that was too far away to be bounded nothing need be left.
    fn rooms_m2(&self, place: usize, truth: &Truth, before: &Before<D>) -> [f64; 2] {
        let least_m = self.kept.distance_min_m;
        let now = truth.pairs.references_m2()[place] - least_m * least_m;
        let Some(then) = self.places.then(place) else { return [f64::NEG_INFINITY, now] };
        let then = before.truth.pairs.references_m2()[then] - least_m * least_m;
        [(1.0 - self.kept.gamma_c) * then, now]
    }

    fn watch_pair(
        &self,
        pair: &Pair,
        tick: u32,
        (frame, truth): (&Frame<D>, &Truth),
        before: Option<&Before<D>>,
        verdicts: &mut Verdicts,
    ) {
        let [first, second] = pair.robots;
        if self.free && (self.malicious[first] || self.malicious[second]) {
            return;
        }
        let robots = pair.robots.map(|index| u16::try_from(index + 1).unwrap_or(u16::MAX));
        let at = |seen, demanded| Violation { tick, robots, seen, demanded };
        let carried = before.is_some_and(|before| before.moves && self.was_apart(pair.place));
        let least_m = self.params.settings().limits.distance_min_m;
        let limit_m2 = limit_m2(least_m, truth);
        if pair.distance_m2 < limit_m2 {
            verdicts.broke(Law::Distance, at(sqrt(pair.distance_m2), least_m), carried);
        }
        let Some((before, [floor_m2, now_m2])) = before.zip(pair.rooms_m2) else { return };
        let [start, end] = [&before.positions_m, &frame.positions_m].map(|x| subtract(&x[second], &x[first]));
        let path_m2 = nearest_m2(&start, &end);
        if path_m2 < limit_m2 {
            verdicts.broke(Law::Path, at(sqrt(path_m2), least_m), carried);
        }
        if self.binds(pair.place, before)
            && floor_m2 >= 0.0
            && now_m2 < floor_m2 - truth.rounding_m2(pair.distance_m2)
        {
            verdicts.broke(Law::Decay, at(now_m2, floor_m2), carried);
        }
    }

    /// True if (near) bounded how fast a pair could come closer: under `budget`, if it was linked.
    fn binds(&self, place: usize, before: &Before<D>) -> bool {
        let radius_m = self.kept.link.radius_m;
        let budget = self.params.controller().promises();
        let then = self.places.then(place).map(|then| before.truth.pairs.references_m2()[then]);
        budget && then.is_some_and(|then_m2| then_m2 <= radius_m * radius_m)
    }

    /// Whether a pair was safe in the tick before and must be so in this one.
    fn was_apart(&self, place: usize) -> bool {
        match self.places.then(place) {
            Some(then) => self.apart.get(then).copied().unwrap_or(false),
            None => self.far_apart,
        }
    }

    /// What is safe now, or was and must still be because robots `moved` by the rows, must be so at the next tick. `inside` is false while
    /// nothing is promised.
    pub(crate) fn carry(&mut self, truth: &Truth, moved: bool, inside: bool, moves: bool) {
        let limit_m2 = limit_m2(self.kept.distance_min_m, truth);
        if moves && inside && truth.least_m2 >= limit_m2 && all_are_there(truth) {
            self.apart.clear();
            self.apart.resize(truth.pairs.references_m2().len(), true);
            self.far_apart = true;
            return;
        }
        let mut scratch = core::mem::take(&mut self.scratch);
        scratch.clear();
        scratch.extend(truth.pairs.references_m2().iter().enumerate().map(|(place, pair_m2)| {
            // The distance to a robot that is absent is NaN; whoever comes must be far enough away.
            let apart = *pair_m2 >= limit_m2 || pair_m2.is_nan();
            moves && ((inside && apart) || (self.was_apart(place) && moved))
        }));
        self.scratch = core::mem::replace(&mut self.apart, scratch);
        self.far_apart = moves && inside;
    }
}

/// Two robots of a tick.
struct Pair {
    /// In the order of [`Pairs`](crate::monitors::pairs::Pairs).
    place: usize,
    robots: [usize; 2],
    distance_m2: f64,
    /// See [`Distances::rooms_m2`].
    rooms_m2: Option<[f64; 2]>,
}

/// False if some robot is absent: its distances are no numbers.
fn all_are_there(truth: &Truth) -> bool {
    truth.pairs.references_m2().iter().all(|pair_m2| !pair_m2.is_nan())
}

/// A pair at least `least_m` apart is no nearer than this, but for rounding, m².
fn limit_m2(least_m: f64, truth: &Truth) -> f64 {
    let least_m2 = least_m * least_m;
    least_m2 - truth.rounding_m2(least_m2)
}

#[cfg(test)]
mod tests {
    use closeranks_core::num::Vector;
    use closeranks_core::settings::{Errors, Team};

    use super::*;
    use crate::monitors::rule::Rule;
    use crate::random::{Random, Stream};
    use crate::scenario;

    /// A tick of a team in a small box, its references up to `noise_m` from its positions.
    fn drawn(random: &mut Random, robots: u16, noise_m: f64) -> Frame<2> {
        let mut near =
            |[x, y]: Vector<2>, by_m: f64| [x + random.uniform(-by_m, by_m), y + random.uniform(-by_m, by_m)];
        let positions_m = (0..robots).map(|_| near([0.0; 2], 0.8)).collect();
        let mut frame = Frame::new(positions_m, vec![0.0; usize::from(robots)]);
        for (reference, x) in frame.references_m.iter_mut().zip(&frame.positions_m) {
            *reference = near(*x, noise_m);
        }
        frame
    }

    /// The next tick: nobody moves farther than `move_m` along an axis, and references with their robots up to `noise_m`.
    fn moved(random: &mut Random, frame: &Frame<2>, move_m: f64, noise_m: f64) -> Frame<2> {
        let mut next = frame.clone();
        for (reference, x) in next.references_m.iter_mut().zip(&mut next.positions_m) {
            for d in 0..2 {
                let step_m = random.uniform(-move_m, move_m);
                x[d] += step_m;
                reference[d] += step_m + random.uniform(-noise_m, noise_m);
            }
        }
        next
    }

    /// Both ways to look at a tick after another, or at a first one.
    fn verdicts(scenario: &Scenario, seed: u64) -> [(Verdicts, f64); 2] {
        let random = &mut Random::new(seed, Stream::Start);
        let noise_m = [0.0, 1e-3, 0.2][usize::try_from(random.below(3)).unwrap_or(0)];
        let move_m = [0.0, 0.01, 0.1, 0.5, 1.0][usize::try_from(random.below(5)).unwrap_or(0)];
        let then = drawn(random, scenario.team.robots, noise_m);
        let now = moved(random, &then, move_m, noise_m);
        let (params, malicious) = (scenario.params().unwrap(), scenario.malicious_mask());
        let [was, is] = [&then, &now].map(|frame| {
            let mut truth = Truth::default();
            truth.look(&params, &Rule::new(scenario, &params), &malicious, frame, false);
            truth
        });
        let mut pairs = Distances::new(scenario, params);
        let mut before = Before { moves: random.chance(0.9), ..Before::default() };
        pairs.carry(&was, before.moves, true, before.moves);
        (before.truth, before.positions_m) = (was, then.positions_m);
        let before = random.chance(0.9).then_some(&before);
        [pairs.near_m2(&now, before), f64::INFINITY].map(|near_m2| {
            let (mut pairs, mut verdicts) = (pairs.clone(), Verdicts::default());
            pairs.watch_nearer(near_m2, 7, &now, &is, before, &mut verdicts);
            (verdicts, pairs.least_m2())
        })
    }

    #[test]
    fn pairs_that_are_left_out_break_nothing() {
        let plain = Scenario {
            controller: scenario::Controller::Budget,
            team: Team { robots: 5, faults: 1 },
            ..Scenario::default()
        };
        let margins = Scenario { errors: Errors { tracking_m: 0.05, position_m: 0.02 }, ..plain.clone() };
        let free = Scenario { attack: MotionAttack::Flee.into(), ..plain.clone() };
        let mut broken = [0; 3];
        for scenario in [plain, margins, free] {
            for seed in 0..3_000 {
                let [screened, all] = verdicts(&scenario, seed);
                assert_eq!(screened, all, "seed {seed}, {scenario:?}");
                for (count, law) in broken.iter_mut().zip([Law::Distance, Law::Path, Law::Decay]) {
                    *count += all.0.of(law).count;
                }
            }
        }
        assert!(broken.iter().all(|count| *count > 1_000), "{broken:?}");
    }
}
