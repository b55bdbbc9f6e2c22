//! Our controller `budget`, for robots that tell each other nothing of their motion: rows that no lie and no step length can
//! break (docs/theory, docs/budget.md).
//!
//! `h_k` is the spare connectivity of robot k, a budget that k and its neighbours spend by moving apart. In one tick each of
//! them may spend a fixed fraction of what it *sees* that k still has, so all of them together cannot overspend. Robot i
//! moves by the v closest to the desired displacement that satisfies, for every neighbour j with `r = x_i − x_j`, `D = |r|²`:
//!
//! ```text
//! (far)   r·v + |v|²          ≤ min( s(h_i⁺)/δ_i, s(b_ij)/δ⁺_ij ) / (4 L_ij)      or, if all obey,
//! (far′)  −g_ik·v + κ_ik |v|² ≤ s(b_ik)/(δ⁺_ik + 1)                               for each neighbour k and i itself
//! (near)  −2 r·v              ≤ (γ_c/2) (D − Δ_d²)⁺
//! (box)   v/T ∈ U_i
//!
//! h⁺ = max(h, 0),  L_ij, κ: bounds of the link weight's derivatives,  b_ij ≤ h_j⁺ seen,  δ⁺ ≥ δ_j,  s(h) = γ h what may be lost
//! ```
//!
//! Each set is convex and contains v = 0: the program is feasible at every tick.
//!
//! A tick in this file: [`Budget::survey`] says what is seen of the links between the neighbours, [`Budget::known`] what is
//! known of each neighbour, [`Budget::rows`] makes the rows, and [`Rows::decide`] finds the closest point and the outcome.
//!
//! | label in docs/theory | here |
//! | --- | --- |
//! | eq:far, eq:far-prime, eq:near: both sides, and when a row is slack | [`inequality`] |
//! | eq:known, thm:sensed, thm:free | [`knowledge`] |
//! | the sums behind them | [`survey`] |
//! | the program of a tick, and what comes of it | [`crate::controller::rows`] |
//! | eq:loss and the settings | [`settings`] |
//! | eq:slope-bound, eq:curvature-bound | [`curvature`] |
//! | sec:margins | [`margin`] |
//! | sec:recovery | `recovery` |
//! | sec:program | [`crate::program::balls`] |
//! | thm:discrete | this file; the test is `tests/budget_law.rs` |

pub mod control;
pub mod curvature;
pub mod inequality;
pub mod knowledge;
pub mod margin;
mod recovery;
pub mod settings;
mod sums;
pub mod survey;
pub mod weight;

use crate::controller::budget::inequality::{Neighbor, Pair};
use crate::controller::budget::knowledge::{KnownMargin, Sighting, count};
use crate::controller::budget::settings::{Budget, Form};
use crate::controller::budget::survey::Survey;
use crate::controller::rows::{Rows, give_m2, may_bind};
use crate::id::Member;
use crate::num::{Vector, add_scaled};
use crate::program::balls::reach::Reach;
use crate::program::balls::row::Row;

/// Memory that the caller lends for one tick.
#[derive(Debug)]
pub struct Memory<'memory, const D: usize> {
    /// `2·D + 2·N + 1` rows are always enough for N neighbours. If positions have errors, `2·D + 2ᴰ (2·N + 1)` are.
    pub rows: &'memory mut [Row<D>],
    /// Numbers for [`Budget::survey`](Budget::survey).
    pub weights: &'memory mut [f64],
}

/// What a robot adds up over its neighbours for its own rows.
struct Own<const D: usize> {
    member: Member,
    /// h_i.
    h: f64,
    /// δ_i: how many neighbours count for it.
    degree: f64,
    /// ∂h_i/∂x_i, 1/m.
    gradient: Vector<D>,
    /// κ_ii.
    bend: f64,
    /// Bound of the error of the gradient, 1/m.
    gradient_error: f64,
    /// How much more h_i may be, because neighbours were not sensed.
    unsensed: f64,
}

impl Budget {
    /// All rows for robot `own`, which has these `sightings`, wants to move by `desired_m` (m) and can move within `reach`.
    ///
    /// Whoever is certainly farther away than R gets no row. Where there are more sightings than other robots, something is
    /// certainly wrong. A sighting without a finite position forbids any move, and so does
    /// too little memory.
    //= theory thm:discrete
    #[must_use]
    pub fn rows<'memory, const D: usize>(
        &self,
        own: impl Into<Member>,
        sightings: &[Sighting<D>],
        desired_m: &Vector<D>,
        reach: Reach<D>,
        memory: Memory<'memory, D>,
    ) -> Rows<'memory, D> {
        let (own, Memory { rows, weights }) = (own.into(), memory);
        let mut rows = Rows::new(desired_m, reach, rows);
        let Some(mut survey) = self.survey(own, sightings, weights) else {
            rows.forbid_any_move();
            return rows;
        };
        let mut own = self.own(own, survey.level(), self.degree(own, sightings));
        rows.h = own.h;
        if sightings.len() >= usize::from(self.need.robots()) {
            rows.count_violation(true);
        }
        for (index, sighting) in sightings.iter().enumerate() {
            if sighting.unsensed_m == 0.0 {
                self.push_sighting(index, sightings, &mut survey, &mut own, &mut rows);
            } else {
                let blurred = self.blurred(sighting.unsensed_m);
                blurred.push_sighting(index, sightings, &mut survey, &mut own, &mut rows);
            }
        }
        self.push_own(&own, &mut rows);
        rows
    }

    /// Adds a neighbour as it is sighted, unless it is certainly out of range.
    fn push_sighting<const D: usize>(
        &self,
        index: usize,
        sightings: &[Sighting<D>],
        survey: &mut Survey<'_>,
        own: &mut Own<D>,
        rows: &mut Rows<'_, D>,
    ) {
        let (member, offset_m) = (sightings[index].member(), sightings[index].offset_m);
        if !self.in_range(&offset_m) {
            return;
        }
        let slope = self.slope(index, &sightings[index], survey);
        let pair = &self.pair(&offset_m, slope, &rows.program.reach);
        let known = if self.need.counts(member, own.member) {
            let Some(seen) = self.seen(index, sightings, survey) else { return };
            self.known(&seen)
        } else {
            // Nothing that this robot does weakens j, so no row asks what is known of it.
            KnownMargin::default()
        };
        self.push_neighbor(own, &Neighbor { member, offset_m, pair, known }, rows);
    }

    /// Adds the row (near) for a robot of another team, unless it is certainly out of range. It is in no sum.
    //= theory sec:strangers
    pub(crate) fn push_stranger<const D: usize>(&self, sighting: &Sighting<D>, rows: &mut Rows<'_, D>) {
        let offset_m = sighting.offset_m;
        let budget = self.blurred(sighting.unsensed_m);
        if !budget.in_range(&offset_m) {
            return;
        }
        let pair = budget.pair(&offset_m, 0.0, &rows.program.reach);
        if !pair.near_is_slack {
            budget.push_near(&offset_m, &pair, rows);
        }
    }

    /// Makes the same rows for robot `own` with this `level` and `degree` and all its `neighbors` in order of their numbers.
    /// This is for whoever computes a whole team at once. The pairs must have been made with this `reach`, because which rows can bind
    /// depends on it.
    #[must_use]
    pub fn rows_between<'memory, 'a, const D: usize>(
        &self,
        (own, level, degree): (Member, f64, u16),
        neighbors: impl Iterator<Item = Neighbor<'a, D>>,
        desired_m: &Vector<D>,
        reach: Reach<D>,
        memory: &'memory mut [Row<D>],
    ) -> Rows<'memory, D> {
        let mut rows = Rows::new(desired_m, reach, memory);
        let mut own = self.own(own, level, f64::from(degree));
        rows.h = own.h;
        for neighbor in neighbors {
            self.push_neighbor(&mut own, &neighbor, &mut rows);
        }
        self.push_own(&own, &mut rows);
        rows
    }

    /// h_i and δ_i of robot `member`; the other sums begin at 0.
    fn own<const D: usize>(&self, member: Member, level: f64, degree: f64) -> Own<D> {
        let h = level - f64::from(self.need.need(member));
        Own { member, h, degree, gradient: [0.0; D], bend: 0.0, gradient_error: 0.0, unsensed: 0.0 }
    }

    /// How many of `sightings` may be neighbours of robot `own` that count for it.
    fn degree<const D: usize>(&self, own: Member, sightings: &[Sighting<D>]) -> f64 {
        let counts =
            |sighting: &&Sighting<D>| self.is_in_range(sighting) && self.need.counts(own, sighting.member());
        count(sightings.iter().filter(counts).count())
    }

    /// Adds a neighbour to the robot's own sums, and its rows where they bound the move.
    #[inline]
    fn push_neighbor<const D: usize>(
        &self,
        own: &mut Own<D>,
        neighbor: &Neighbor<'_, D>,
        rows: &mut Rows<'_, D>,
    ) {
        let Neighbor { member, offset_m, pair, known } = neighbor;
        let gradient = pair.gradient(offset_m);
        if self.need.counts(own.member, *member) {
            own.gradient = add_scaled(&own.gradient, 1.0, &gradient);
            own.bend += pair.bend;
            own.gradient_error += pair.gradient_error;
            if self.errors.unsensed_m > 0.0 {
                own.unsensed += self.weight_error();
            }
        }
        let far_is_slack = self.form() == Form::Level && self.far_level_is_slack(pair.lhs_max, known);
        if !far_is_slack {
            self.push_far(own, neighbor, &gradient, rows);
        }
        if !pair.near_is_slack {
            self.push_near(offset_m, pair, rows);
        }
    }

    /// (far) or (far′) for a neighbour. Only a robot that counts for another one can weaken it. Where h_k is below 0 the row
    /// lets nothing be taken; mending it is for robot k (sec:recovery).
    #[inline(never)]
    fn push_far<const D: usize>(
        &self,
        own: &Own<D>,
        neighbor: &Neighbor<'_, D>,
        gradient: &Vector<D>,
        rows: &mut Rows<'_, D>,
    ) {
        let Neighbor { member, offset_m, pair, known } = neighbor;
        match self.form() {
            Form::Link => {
                let (beta_m2, error_m) = (self.beta_of(own, neighbor), self.errors.offset_m);
                if may_bind(rows.program.reach.lhs_max(offset_m, error_m, 1.0), beta_m2) {
                    rows.push(offset_m, error_m, |offset| Row::far(offset, beta_m2));
                }
            }
            Form::Level if !self.need.counts(*member, own.member) => {}
            Form::Level => {
                let spend = self.spend(known);
                rows.push(gradient, pair.gradient_error, |gradient| {
                    Row::far_level(gradient, pair.bend, spend)
                });
            }
        }
    }

    /// (far′) for the robot itself, and recovery of its h_i.
    fn push_own<const D: usize>(&self, own: &Own<D>, rows: &mut Rows<'_, D>) {
        if self.form() == Form::Level {
            let spend = self.spend_own(own);
            if may_bind(rows.program.reach.lhs_max(&own.gradient, own.gradient_error, own.bend), spend) {
                rows.push(&own.gradient, own.gradient_error, |gradient| {
                    Row::far_level(gradient, own.bend, spend)
                });
            }
        }
        self.recover_own(own, rows);
    }

    /// (near) for another robot, and recovery of the distance.
    #[inline(never)]
    fn push_near<const D: usize>(&self, offset: &Vector<D>, pair: &Pair, rows: &mut Rows<'_, D>) {
        let error_m = self.errors.offset_m;
        let spare_m2 = self.spare_m2(pair, -error_m);
        let give_m2 = give_m2(self.gamma_c, spare_m2);
        if may_bind(rows.program.reach.lhs_max(offset, error_m, 0.0), 0.5 * give_m2) {
            rows.push(offset, error_m, |offset| Row::near(offset, give_m2));
        }
        if spare_m2 < 0.0 {
            self.recover_distance(offset, pair, rows);
        }
    }
}
