//! The paper's controller: one row a robot (eq:split), and the closest velocity that satisfies it (seq:qp).
//!
//! It is exactly as printed: there is no recovery and no slack. The one choice is the split (docs/theory, `sec:split`).
//! The equations are in [`crate::equations::composition`].

pub mod lanes;

use crate::controller::clearance::Clearance;
use crate::controller::{AtOnce, Batch, Control, Decision, Glimpse, Motion, Neighbor, Own, Standing, View};
use crate::equations::composition::{Composed, Composition, PhiSplit, Sum, TERM_LARGE, Term};
use crate::equations::link::{Link, LinkShape};
use crate::need::Need;
use crate::num::scaled::Scaled;
use crate::num::{Vector, dot};
use crate::program::balls::Program;
use crate::program::balls::reach::Reach;
use crate::program::box_row::{Row, Solution, closest};
use crate::program::one_row::closest_beyond;
use crate::program::{InputBox, Outcome};
use crate::robot::neighbor::RobotId;
use crate::robot::report::{Mode, Reason};
use crate::robot::scratch::{Needs, Scratch};
use crate::settings::{ComposedSettings, Settings};

/// The controller with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComposedController<const D: usize> {
    /// The equations.
    pub composed: Composed,
    link: LinkShape,
    need: Need,
    input: InputBox<D>,
    reach: Reach<D>,
    clearance: Clearance,
    hold_s: f64,
}

/// What both ends of a link share in their rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// `2 ∂a/∂Δ²`, 1/m².
    pub slope: f64,
    /// `E^c_ij`.
    pub collision: f64,
}

/// The sums behind φ_i and H_i.
#[derive(Clone, Copy, Debug)]
pub struct Sums<const D: usize> {
    row: Sum<D, f64>,
    /// The sum of the Ê of the robot and its neighbours. No single one is larger.
    terms: f64,
}

impl<const D: usize> Default for Sums<D> {
    fn default() -> Self {
        Self { row: Sum::new(0.0), terms: 0.0 }
    }
}

impl<const D: usize> ComposedController<D> {
    pub(crate) fn new(settings: &Settings<D>, parameters: &ComposedSettings, link: LinkShape) -> Self {
        let need = settings.need_of_neighbors();
        let composed = Composed {
            split: parameters.phi_split,
            w_r: parameters.w_r,
            w_c: parameters.w_c,
            alpha: parameters.alpha,
            robots: settings.team.robots,
            required: need.need(RobotId(0)),
            distance_min_m: settings.limits.distance_min_m,
        };
        Self {
            composed,
            link,
            need,
            input: settings.limits.input,
            reach: settings.reach(),
            clearance: Clearance::new(settings),
            hold_s: settings.clock.hold_max().as_secs_f64(),
        }
    }

    /// The sums behind φ_i and H_i as the split wants them.
    #[inline]
    fn row(&self, sums: &Sums<D>) -> Sum<D, f64> {
        match self.composed.split {
            PhiSplit::Neighbors => sums.row.with_terms(sums.terms),
            PhiSplit::Own => sums.row,
        }
    }

    /// The closest velocity where there is more than a box and a row: obstacles, whose rows come first, or a disc.
    #[cold]
    fn among(&self, row: &Row<D>, motion: &Motion<D>, scratch: &mut Scratch<'_, D>) -> Solution<D> {
        let mut program = Program::new(scratch.rows, self.reach);
        self.clearance.push(&motion.position_m, scratch.map, &mut program);
        let desired_m = motion.desired_m_s.map(|component| component * self.hold_s);
        let row = Row { normal: row.normal, bound: row.bound * self.hold_s };
        let moved = closest_beyond(&mut program, &desired_m, &row);
        let velocity_m_s = self.input.clip(&moved.displacement_m.map(|component| component / self.hold_s));
        Solution { velocity_m_s, outcome: moved.outcome }
    }

    /// Row and φ_i from all neighbours, with free exponents. This is for robots whose plain sums overflow or vanish.
    #[cold]
    fn careful<'a>(
        &self,
        own: &Own,
        neighbors: impl Iterator<Item = Neighbor<'a, D, Pair, Option<f64>>> + Clone,
    ) -> Composition<D> {
        let terms = neighbors.filter_map(|neighbor| {
            let distance_m2 = dot(&neighbor.offset_m, &neighbor.offset_m);
            let link: Link<Scaled> = self.link.link_at(distance_m2)?;
            let told = neighbor.known.map_or(Scaled::ZERO, |level| self.composed.degree_term(level));
            let collision = self.composed.collision_term(distance_m2);
            Some(Term { offset_m: neighbor.offset_m, link, collision, told })
        });
        self.composed.compose(self.composed.degree_term(own.told_level), terms)
    }
}

impl<const D: usize> Control<D> for ComposedController<D> {
    fn need(&self) -> &Need {
        &self.need
    }

    fn tells_levels(&self) -> bool {
        true
    }

    fn can_be_computed_at_once(&self) -> bool {
        true
    }

    /// Rows only where the box is not all.
    fn needs(&self, neighbors: usize) -> Needs {
        let rows = if self.reach.ball_m().is_some() { self.reach.rows() + 1 } else { 0 };
        Needs { values: neighbors, sightings: 0, rows }
    }

    fn alone(&self, view: &View<'_, D>, desired: &Vector<D>, scratch: &mut Scratch<'_, D>) -> Decision<D> {
        let own =
            Own { member: view.member(), level: view.told_level, told_level: view.told_level, degree: 0 };
        let told = self.told(Some(view.told_level));
        let mut sums = self.sums(&told);
        for slot in view.linked() {
            let other = self.told(slot.told_level());
            self.hear(&mut sums, &other);
            if let Some(pair) = self.pair(&slot.offset_m, &slot.link) {
                self.add(&mut sums, &slot.offset_m, &pair, [&told, &other]);
            }
        }
        let neighbors = view.linked().map(|slot| Neighbor {
            member: slot.member(),
            offset_m: slot.offset_m,
            pair: None,
            known: slot.told_level(),
        });
        let (position_m, before_m_s) = (view.position_m, view.before_m_s);
        let motion = Motion { position_m, desired_m_s: *desired, before_m_s };
        self.decide(&own, &sums, neighbors, &motion, scratch)
    }

    /// The answer is never guaranteed, because thm:cbf-qp needs continuous time. Of all that speaks against it, the gravest is
    /// named.
    fn mode(&self, standing: &Standing) -> Mode {
        Mode::Degraded(match standing.outcome {
            _ if standing.degree < standing.need => Reason::Degree,
            Outcome::Infeasible => Reason::Infeasible,
            _ if standing.phi.is_some_and(|phi| phi < 0.0) => Reason::OutsideSafeSet,
            _ if standing.untold > 0 => Reason::Untold,
            _ => Reason::ContinuousTime,
        })
    }
}

impl<const D: usize> AtOnce<D> for ComposedController<D> {
    type Pair = Pair;
    type Told = f64;
    type Sums = Sums<D>;
    type Known = Option<f64>;

    const ADDS: bool = true;
    const USES_PHI: bool = true;

    /// There is no pair where slope and collision term are both too small for `f64`. Such a pair matters only beside a huge
    /// Ê, and then all neighbours are looked at one by one.
    #[inline]
    fn pair(&self, offset_m: &Vector<D>, link: &Link<f64>) -> Option<Pair> {
        let collision = self.composed.collision_term(dot(offset_m, offset_m));
        (link.slope != 0.0 || collision != 0.0).then_some(Pair { slope: link.slope, collision })
    }

    fn pairs(&self, links: &mut Batch<'_, D>, mut make: impl FnMut(usize, Option<Pair>)) {
        self.composed.collision_terms(links.distances_m2);
        for (index, (collision, slope)) in links.distances_m2.iter().zip(links.slopes).enumerate() {
            let (slope, collision) = (*slope, *collision);
            make(index, (slope != 0.0 || collision != 0.0).then_some(Pair { slope, collision }));
        }
    }

    /// Ê of a told level; 0 if none was told.
    #[inline]
    fn told(&self, level: Option<f64>) -> f64 {
        level.map_or(0.0, |level| self.composed.degree_term(level))
    }

    #[inline]
    fn sums(&self, own: &f64) -> Sums<D> {
        Sums { row: Sum::new(*own), terms: *own }
    }

    #[inline]
    fn hear(&self, sums: &mut Sums<D>, told: &f64) {
        sums.terms += *told;
    }

    #[inline]
    fn add(&self, sums: &mut Sums<D>, offset_m: &Vector<D>, pair: &Pair, [own, other]: [&f64; 2]) {
        let pull = self.composed.coefficient(*own, *other, pair.slope, pair.collision);
        sums.row.add_link(offset_m, pull, pair.collision);
    }

    #[inline]
    fn add_both(
        &self,
        [first, second]: [&mut Sums<D>; 2],
        offset_m: &Vector<D>,
        pair: &Pair,
        [one, other]: [&f64; 2],
    ) {
        let pull = self.composed.coefficient(*one, *other, pair.slope, pair.collision);
        first.row.add_link(offset_m, pull, pair.collision);
        second.row.add_link(offset_m, -pull, pair.collision);
    }

    fn know(&self, glimpse: &Glimpse) -> Option<f64> {
        Some(glimpse.told_level)
    }

    //= paper seq:qp
    #[inline]
    fn decide<'a>(
        &self,
        own: &Own,
        sums: &Sums<D>,
        neighbors: impl Iterator<Item = Neighbor<'a, D, Pair, Option<f64>>> + Clone,
        motion: &Motion<D>,
        scratch: &mut Scratch<'_, D>,
    ) -> Decision<D> {
        // Beside a huge Ê no slope counts as 0, so pairs that were left out might matter.
        let plain = self.row(sums).finish(&self.composed).filter(|_| sums.terms < TERM_LARGE);
        let Composition { row, phi } = plain.unwrap_or_else(|| self.careful(own, neighbors));
        let solution = if scratch.map.is_empty() && self.reach.ball_m().is_none() {
            closest(&motion.desired_m_s, &row, &self.input)
        } else {
            self.among(&row, motion, scratch)
        };
        Decision {
            velocity_m_s: solution.velocity_m_s,
            outcome: solution.outcome,
            phi: Some(phi),
            doubt: None,
        }
    }
}
