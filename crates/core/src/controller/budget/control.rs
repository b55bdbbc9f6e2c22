//! The controller `budget` as a robot runs it: what it senses as rows, the closest velocity, and its worth.

use crate::controller::assume::Assume;
use crate::controller::budget::Memory;
use crate::controller::budget::curvature::Curvature;
use crate::controller::budget::inequality::{self, Pair};
use crate::controller::budget::knowledge::{KnownMargin, Sighting};
use crate::controller::budget::recovery::H_ROUNDING;
use crate::controller::budget::settings::{Budget, Form};
use crate::controller::clearance::Clearance;
use crate::controller::rows::{Move, Rows};
use crate::controller::{
    AtOnce, Batch, Control, Decision, Glimpse, Kept, Motion, Neighbor, Own, Standing, View,
};
use crate::equations::link::{Link, LinkShape};
use crate::need::Need;
use crate::num::{Vector, sqrt};
use crate::obstacle::Obstacle;
use crate::program::InputBox;
use crate::program::balls::reach::Reach;
use crate::robot::neighbor::{Member, Slot};
use crate::robot::report::{Mode, Reason};
use crate::robot::scratch::{Needs, Scratch};
use crate::settings::{BudgetSettings, Settings};

/// The controller with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BudgetController<const D: usize> {
    /// The parameters of the rows.
    pub budget: Budget,
    reach: Reach<D>,
    input: InputBox<D>,
    clearance: Clearance,
    hold_s: f64,
}

impl<const D: usize> BudgetController<D> {
    pub(crate) fn new(settings: &Settings<D>, parameters: &BudgetSettings) -> Self {
        let (errors, reach) = (settings.error_bounds(), settings.reach());
        let weight = parameters.weight(&settings.conditions(parameters));
        let radius_m = settings.link.radius_m - 2.0 * errors.away_m;
        let link = LinkShape { radius_m, q1: 2.0 + weight.epsilon, q2: weight.q2 };
        let budget = Budget {
            curvature: Curvature::new(link),
            need: settings.need(parameters.assume.keep()),
            faults: settings.team.faults,
            distance_min_m: settings.limits.distance_min_m + 2.0 * errors.away_m,
            move_max_m: reach.longest_m(),
            gamma: weight.gamma,
            gamma_c: weight.gamma_c,
            assume: parameters.assume,
            form: Form::Level,
            errors,
        };
        let hold_s = settings.clock.hold_max().as_secs_f64();
        let (input, clearance) = (settings.limits.input, Clearance::new(settings));
        Self { budget, reach, input, clearance, hold_s }
    }

    /// Fills the sightings from the slots and returns how many there are.
    fn see(view: &View<'_, D>, sightings: &mut [Sighting<D>]) -> usize {
        let mut count = 0;
        for (sighting, slot) in sightings.iter_mut().zip(view.in_view()) {
            *sighting = sighting_of(slot);
            count += 1;
        }
        count
    }

    fn desired_m(&self, velocity_m_s: &Vector<D>) -> Vector<D> {
        velocity_m_s.map(|component| component * self.hold_s)
    }

    /// The velocity that keeps every row for as long as it may be held. The velocity of the tick before makes it faster to
    /// find, and changes it by no more than rounding.
    #[inline]
    fn decision(
        &self,
        rows: &mut Rows<'_, D>,
        (position_m, map): (&Vector<D>, &[Obstacle<D>]),
        before_m_s: &Vector<D>,
    ) -> Decision<D> {
        self.clearance.push(position_m, map, &mut rows.program);
        self.clearance.recover(position_m, map, rows);
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
        let Budget { curvature, distance_min_m, gamma, gamma_c, errors, .. } = self.budget;
        Kept {
            link: *curvature.link(),
            distance_min_m,
            fall_max: curvature.fall_max(),
            gamma,
            gamma_c,
            errors,
        }
    }

    /// Where malicious robots move as they like they may leave: as many more must be there.
    fn keep(&self, own: Member) -> u16 {
        let spare = if self.is_obeyed() { 0 } else { self.budget.faults };
        self.budget.need.need(own).saturating_add(spare)
    }

    fn remembers(&self) -> bool {
        false
    }

    fn certain_level(&self, own: Member, sightings: &[Sighting<D>], scratch: &mut [f64]) -> Option<f64> {
        Some(self.budget.level(own, sightings, scratch))
    }

    fn is_obeyed(&self) -> bool {
        self.budget.assume == Assume::Obedient
    }

    fn needs(&self, neighbors: usize) -> Needs {
        let values = Budget::survey_len(self.budget.assume, neighbors);
        Needs {
            values,
            sightings: neighbors,
            rows: rows(D, !self.budget.is_exact(), neighbors) + self.reach.rows() - 2 * D,
        }
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
            let counted = view.linked().filter(|slot| self.budget.need.counts(view.member(), slot.member()));
            return counted.fold(0.0, |level, slot| level + slot.link.weight);
        }
        let count = Self::see(view, scratch.sightings);
        self.budget.level(view.member(), &scratch.sightings[..count], scratch.values)
    }

    fn alone(&self, view: &View<'_, D>, desired: &Vector<D>, scratch: &mut Scratch<'_, D>) -> Decision<D> {
        let count = Self::see(view, scratch.sightings);
        let memory = Memory { rows: scratch.rows, weights: scratch.values };
        let desired_m = self.desired_m(desired);
        let mut rows =
            self.budget.rows(view.member(), &scratch.sightings[..count], &desired_m, self.reach, memory);
        for slot in view.strangers.iter().filter(|slot| slot.sensed || slot.is_missing()) {
            self.budget.push_stranger(&sighting_of(slot), &mut rows);
        }
        self.decision(&mut rows, (&view.position_m, scratch.map), &view.before_m_s)
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
    type Told = ();
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

    #[inline]
    fn know(&self, glimpse: &Glimpse) -> KnownMargin {
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
            let Neighbor { member, offset_m, pair, known } = neighbor;
            Some(inequality::Neighbor { member, offset_m, pair: pair?, known })
        });
        let desired_m = self.desired_m(&motion.desired_m_s);
        let own = (own.member, own.level, own.degree);
        let mut rows = self.budget.rows_between(own, neighbors, &desired_m, self.reach, scratch.rows);
        self.decision(&mut rows, (&motion.position_m, scratch.map), &motion.before_m_s)
    }
}

/// What a slot holds of where a robot is.
fn sighting_of<const D: usize>(slot: &Slot<D>) -> Sighting<D> {
    let Slot { id, rank, offset_m, position_m, unsensed_m, .. } = *slot;
    Sighting { id, rank, offset_m, position_m, unsensed_m }
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
