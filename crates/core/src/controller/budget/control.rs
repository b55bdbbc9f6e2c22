//! The controller `budget` as a robot runs it: what it senses and hears as rows, the closest velocity, and its worth.

use core::time::Duration;

use crate::controller::assume::Assume;
use crate::controller::budget::Memory;
use crate::controller::budget::curvature::Curvature;
use crate::controller::budget::inequality::{self, Pair};
use crate::controller::budget::knowledge::{Claim, KnownMargin, Sighting};
use crate::controller::budget::recovery::H_ROUNDING;
use crate::controller::budget::settings::{Budget, Form};
use crate::controller::rows::{Move, Rows};
use crate::controller::{
    AtOnce, Batch, Control, Decision, Glimpse, Kept, Motion, Neighbor, Own, Standing, View,
};
use crate::equations::link::{Link, LinkShape};
use crate::need::Need;
use crate::num::{Vector, sqrt};
use crate::program::InputBox;
use crate::program::balls::reach::Reach;
use crate::robot::neighbor::{RobotId, Slot};
use crate::robot::report::{Mode, Reason};
use crate::robot::scratch::{Needs, Scratch};
use crate::settings::{BudgetSettings, Clock, Settings};
use crate::time::Instant;

/// The controller with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BudgetController<const D: usize> {
    /// The parameters of the rows.
    pub budget: Budget,
    reach: Reach<D>,
    input: InputBox<D>,
    hold_s: f64,
    clock: Clock,
}

impl<const D: usize> BudgetController<D> {
    pub(crate) fn new(settings: &Settings<D>, parameters: &BudgetSettings) -> Self {
        let (errors, reach) = (settings.error_bounds(), settings.reach());
        let weight = parameters.weight(&settings.conditions(parameters));
        let radius_m = settings.link.radius_m - 2.0 * errors.away_m;
        let link = LinkShape { radius_m, q1: 2.0 + weight.epsilon, q2: weight.q2 };
        let budget = Budget {
            curvature: Curvature::new(link),
            need: parameters.need(settings.team.robots, settings.team.faults),
            faults: settings.team.faults,
            distance_min_m: settings.limits.distance_min_m + 2.0 * errors.away_m,
            move_max_m: reach.longest_m(),
            gamma: weight.gamma,
            gain_slope: parameters.gain_slope,
            gamma_c: weight.gamma_c,
            trust: parameters.trust,
            assume: parameters.assume,
            form: Form::Level,
            errors,
        };
        Self {
            budget,
            reach,
            input: settings.limits.input,
            hold_s: settings.clock.hold_max().as_secs_f64(),
            clock: settings.clock,
        }
    }

    /// Fills the sightings from the slots and returns how many there are.
    fn see(&self, view: &View<'_, D>, sightings: &mut [Sighting<D>]) -> usize {
        let latest = view.now.after(self.clock.error);
        let mut count = 0;
        for (sighting, slot) in sightings.iter_mut().zip(view.in_view()) {
            let Slot { id, offset_m, position_m, unsensed_m, .. } = *slot;
            let claim = self.claim_of(slot, latest);
            *sighting = Sighting { id, offset_m, position_m, claim, unsensed_m };
            count += 1;
        }
        count
    }

    /// What a neighbour told; `None` if that is from later than `latest`.
    fn claim_of(&self, slot: &Slot<D>, latest: Instant) -> Option<Claim> {
        let told = slot.told?;
        self.claim(told.level, latest.checked_since(told.stamp)?)
    }

    /// The claim of a level told `age` ago. Its age is counted in whole ticks of the fastest clock, rounded up. `None` if it is
    /// too old, or older than can be counted: a claim that counted as younger than it is would be worth too much.
    //= theory sec:clocks
    #[must_use]
    pub fn claim(&self, level: f64, age: Duration) -> Option<Claim> {
        let age_ticks =
            if age.is_zero() { 0 } else { ticks(self.clock.stretched(age), self.clock.level_period)? };
        (age <= self.clock.told_max).then_some(Claim { level, age_ticks })
    }

    fn desired_m(&self, velocity_m_s: &Vector<D>) -> Vector<D> {
        velocity_m_s.map(|component| component * self.hold_s)
    }

    /// The velocity that keeps every row for as long as it may be held. The velocity of the tick before makes it faster to
    /// find, and changes it by no more than rounding.
    #[inline]
    fn decision(&self, rows: &mut Rows<'_, D>, before_m_s: &Vector<D>) -> Decision<D> {
        let Move { displacement_m, outcome, doubt } = rows.decide(&self.desired_m(before_m_s));
        let velocity = displacement_m.map(|component| component / self.hold_s);
        Decision { velocity_m_s: self.input.clip(&velocity), outcome, phi: None, doubt }
    }
}

impl<const D: usize> Control<D> for BudgetController<D> {
    fn need(&self) -> &Need {
        &self.budget.need
    }

    fn sight_m(&self, _radius_m: f64) -> f64 {
        self.budget.curvature.link().radius_m + self.budget.errors.offset_m
    }

    fn promises(&self) -> bool {
        true
    }

    fn kept(&self, _link: &LinkShape, _distance_min_m: f64) -> Kept {
        let Budget { distance_min_m, gamma_c, errors, .. } = self.budget;
        Kept { link: *self.budget.curvature.link(), distance_min_m, gamma_c, errors }
    }

    fn is_obeyed(&self) -> bool {
        self.budget.assume == Assume::Obedient
    }

    fn needs(&self, neighbors: usize) -> Needs {
        let values = Budget::survey_len(self.budget.assume, neighbors);
        Needs { values, sightings: neighbors, rows: rows(D, !self.budget.is_exact(), neighbors) }
    }

    fn reckons(&self) -> bool {
        true
    }

    fn can_be_computed_at_once(&self) -> bool {
        self.budget.is_plain()
    }

    /// The plain sum of weights, or with free liars the trimmed one, with stated errors the least that it can be.
    fn level(&self, view: &View<'_, D>, scratch: &mut Scratch<'_, D>) -> f64 {
        if self.budget.is_plain() && view.is_whole() {
            let counted = view.linked().filter(|slot| self.budget.need.counts(view.id, slot.id));
            return counted.fold(0.0, |level, slot| level + slot.link.weight);
        }
        let count = self.see(view, scratch.sightings);
        self.budget.level(view.id, &scratch.sightings[..count], scratch.values)
    }

    fn alone(&self, view: &View<'_, D>, desired: &Vector<D>, scratch: &mut Scratch<'_, D>) -> Decision<D> {
        let count = self.see(view, scratch.sightings);
        let memory = Memory { rows: scratch.rows, weights: scratch.values };
        let desired_m = self.desired_m(desired);
        let mut rows = self.budget.rows(view.id, &scratch.sightings[..count], &desired_m, self.reach, memory);
        self.decision(&mut rows, &view.before_m_s)
    }

    /// The answer is guaranteed as long as nothing that the robot can check speaks against it.
    fn mode(&self, standing: &Standing) -> Mode {
        let degree_low = standing.degree < standing.need;
        let exact = self.budget.is_exact() && standing.missing == 0;
        match standing.reason {
            _ if degree_low => Mode::Degraded(Reason::Degree),
            Some(reason) => Mode::Degraded(reason),
            None if exact && standing.h < -H_ROUNDING => Mode::Degraded(Reason::OutsideSafeSet),
            None => Mode::Guaranteed,
        }
    }
}

impl<const D: usize> AtOnce<D> for BudgetController<D> {
    type Pair = Pair;
    /// What is left of the claim above what is needed.
    type Told = f64;
    type Sums = ();
    type Known = KnownMargin;

    const LOOKS: bool = true;

    #[inline]
    fn pair(&self, offset_m: &Vector<D>, link: &Link<f64>) -> Option<Pair> {
        Some(self.budget.pair(offset_m, link.slope, &self.reach))
    }

    fn pairs(&self, links: &mut Batch<'_, D>, mut make: impl FnMut(usize, Option<Pair>)) {
        for distance in links.distances_m2.iter_mut() {
            *distance = sqrt(*distance);
        }
        self.budget.bends_max(links.distances_m2);
        for index in 0..links.ends.len() {
            let (slope, bend) = (links.slopes[index], links.distances_m2[index]);
            make(index, Some(self.budget.pair_with(&links.offset_m(index), slope, bend, &self.reach)));
        }
    }

    /// What counts of a level that was told in this tick.
    #[inline]
    fn told(&self, robot: RobotId, level: Option<f64>) -> f64 {
        let claim = level.and_then(|level| self.claim(level, self.clock.error));
        self.budget.discounted_claim(robot, claim)
    }

    #[inline]
    fn know(&self, glimpse: &Glimpse<'_, f64>) -> KnownMargin {
        self.budget.known_of(glimpse)
    }

    #[inline]
    fn decide<'a>(
        &self,
        own: &Own,
        (): &(),
        neighbors: impl Iterator<Item = Neighbor<'a, D, Pair, KnownMargin>> + Clone,
        motion: &Motion<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decision<D> {
        let neighbors = neighbors.filter_map(|neighbor| {
            let Neighbor { id, offset_m, pair, known } = neighbor;
            Some(inequality::Neighbor { id, offset_m, pair: pair?, known })
        });
        let desired_m = self.desired_m(&motion.desired_m_s);
        let own = (own.id, own.level, own.degree);
        let mut rows = self.budget.rows_between(own, neighbors, &desired_m, self.reach, scratch.rows);
        self.decision(&mut rows, &motion.before_m_s)
    }
}

/// How many rows there can be: two for each axis, two for each neighbour, and one of the robot's own. With stated errors
/// each row but those of the axes is there once for every corner of a cube.
///
/// Without them that is so only of neighbours that are missing, for which no room is demanded: whoever has none left stands
/// still in that tick.
fn rows(dimension: usize, blurred: bool, neighbors: usize) -> usize {
    let corners = if blurred { 1 << dimension.min(8) } else { 1 };
    neighbors.saturating_mul(2).saturating_add(1).saturating_mul(corners).saturating_add(2 * dimension)
}

/// `age` in periods, rounded up; a longer period than 64 bits hold counts as shorter, which makes the age greater.
fn ticks(age: Duration, period: Duration) -> Option<u32> {
    let nanos = |span: Duration| u64::try_from(span.as_nanos());
    let period_ns = nanos(period).unwrap_or(u64::MAX).max(1);
    u32::try_from(nanos(age).ok()?.div_ceil(period_ns)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn controller(level_period: Duration) -> BudgetController<2> {
        let clock = Clock { level_period, told_max: Duration::MAX, ..Clock::default() };
        let parameters = BudgetSettings { gamma: Some(0.5), ..BudgetSettings::default() };
        BudgetController::new(&Settings { clock, ..Settings::default() }, &parameters)
    }

    #[test]
    fn claims_are_never_younger_than_they_are() {
        let budget = controller(Duration::from_nanos(1));
        let age = |nanos| budget.claim(7.0, Duration::from_nanos(nanos)).map(|claim| claim.age_ticks);
        let most = u64::from(u32::MAX);
        assert_eq!([0, 1, most].map(age), [Some(0), Some(1), Some(u32::MAX)]);
        assert_eq!([most + 1, u64::MAX].map(age), [None; 2]);
        assert_eq!(budget.claim(7.0, Duration::MAX), None);
        let aged = controller(Duration::MAX).claim(7.0, Duration::from_secs(1));
        assert_eq!(aged.map(|claim| claim.age_ticks), Some(1));
    }

    /// Clocks that lose a tenth of every second count nine ticks where those that gain as much make eleven.
    //= theory sec:clocks type=test
    #[test]
    fn ages_are_those_of_the_fastest_clock() {
        let mut budget = controller(Duration::from_millis(10));
        let age = |budget: &BudgetController<2>, ms| {
            budget.claim(7.0, Duration::from_millis(ms)).map(|claim| claim.age_ticks)
        };
        assert_eq!([0, 90, 91].map(|ms| age(&budget, ms)), [Some(0), Some(9), Some(10)]);
        budget.clock.drift = Duration::from_millis(100);
        assert_eq!([0, 90, 91].map(|ms| age(&budget, ms)), [Some(0), Some(11), Some(12)]);
        budget.clock.drift = Duration::from_secs(1);
        assert_eq!([0, 1].map(|ms| age(&budget, ms)), [Some(0), None]);
    }
}
