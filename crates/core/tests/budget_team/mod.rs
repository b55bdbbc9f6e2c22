//! Teams that move by rows, with liars among them.

#![allow(dead_code, reason = "not every file of tests needs every part")]

use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::Memory;
use closeranks_core::controller::budget::curvature::Curvature;
use closeranks_core::controller::budget::knowledge::Sighting;
use closeranks_core::controller::budget::settings::{Budget, Form};
use closeranks_core::controller::errors::ErrorBounds;
use closeranks_core::equations::link::LinkShape;
use closeranks_core::need::Need;
use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};
use closeranks_core::program::InputBox;
use closeranks_core::program::balls::reach::Reach;
use closeranks_core::program::balls::row::Row;
use closeranks_core::robot::neighbor::{Member, RobotId};

use crate::seeded::Seeded;

mod conspiracy;

pub(crate) const ROWS_MAX: usize = 208;
const SPACING_M: f64 = 0.31;
const DISTANCE_MIN_M: f64 = 0.3;

/// The rows of robot i from what it senses.
pub(crate) type Builder<'a, const D: usize> =
    &'a dyn Fn(&Budget, RobotId, &[Sighting<D>], Reach<D>) -> Vec<Row<D>>;

/// A weight of links. One of those that `budget` chooses is steeper than the paper's, and has up to the largest ε with which h of at
/// least 0 means enough neighbours (lem:degree).
fn shape(chosen: bool, robots: u16, need: u16, random: &mut Seeded) -> LinkShape {
    if chosen {
        let q1 = 2.0 + random.between(0.1, 0.999) * 2.0 / f64::from((need - 1).max(1));
        return LinkShape { radius_m: 3.0, q1, q2: [1.0, 5.0, 48.0, 280.0][random.below(4)] };
    }
    let q1 = 2.0 + random.between(0.1, 0.9) / f64::from(robots - 1);
    LinkShape { radius_m: 3.0, q1, q2: [0.05, 0.1, 0.3, 0.9][random.below(4)] }
}

/// The rows of the crate.
pub(crate) fn crate_rows<const D: usize>(
    budget: &Budget,
    own: RobotId,
    sightings: &[Sighting<D>],
    reach: Reach<D>,
) -> Vec<Row<D>> {
    // Every other time there is so little memory that trimmed sums compute each weight twice. The answer must be the same.
    let scratch = if sightings.len().is_multiple_of(2) { 144 } else { 3 * sightings.len() };
    let memory = Memory { rows: &mut [Row::default(); ROWS_MAX], weights: &mut vec![0.0; scratch] };
    budget.rows(member(budget, own), sightings, &[0.0; D], reach, memory).program.rows().to_vec()
}

#[derive(Clone, Debug)]
pub(crate) struct Team<const D: usize> {
    pub(crate) positions: Vec<Vector<D>>,
    pub(crate) malicious: Vec<bool>,
    pub(crate) budget: Budget,
    pub(crate) reach: Reach<D>,
    /// Bound of the error of every sensed position, m.
    pub(crate) error_m: f64,
    random: u64,
}

impl<const D: usize> Team<D> {
    /// 4 to 12 robots, every honest h at least 0 and one of them little more; `None` if the seed gives no such team.
    pub(crate) fn random(seed: u64, assume: Assume, form: Form) -> Option<Self> {
        let mut random = Seeded(seed);
        let count = 4 + random.below(9);
        let robots = u16::try_from(count).ok()?;
        let faults = u16::try_from(random.below((count - 1) / 2 + 1)).ok()?;
        let need = Need::new(robots, faults, assume.keep());
        Self::of((seed, random), need, faults, assume, form)
    }

    /// Draws a team of 6 to 14 robots with ranks ([`member`]), whose core is as small as it may be, or somewhat larger.
    pub(crate) fn ranked(seed: u64, assume: Assume, form: Form) -> Option<Self> {
        let mut random = Seeded(seed);
        let count = 6 + random.below(9);
        let robots = u16::try_from(count).ok()?;
        let faults = u16::try_from(random.below(3)).ok()?;
        let core = 2 * faults + 1 + u16::try_from(random.below(3)).ok()?;
        let need = Need::ranked(robots, core.min(robots), faults, assume.keep());
        Self::of((seed, random), need, faults, assume, form)
    }

    fn of(
        (seed, mut random): (u64, Seeded),
        need: Need,
        faults: u16,
        assume: Assume,
        form: Form,
    ) -> Option<Self> {
        let (robots, count) = (need.robots(), usize::from(need.robots()));
        let link = shape(seed % 3 == 2, robots, need.most(), &mut random);
        let period_s = [0.005, 0.05][random.below(2)];
        let reach = Reach::new(&InputBox::of([-1.5; D], [1.5; D]), period_s);
        let budget = Budget {
            curvature: Curvature::new(link),
            need,
            faults,
            distance_min_m: DISTANCE_MIN_M,
            move_max_m: reach.longest_m(),
            gamma: [0.2, 0.2, 0.7, 1.0][random.below(4)],
            gamma_c: [0.2, 1.0][random.below(2)],
            assume,
            form,
            errors: ErrorBounds::NONE,
        };
        let mut malicious = vec![false; count];
        for _ in 0..faults {
            malicious[random.below(count)] = true;
        }
        let positions = scatter(count, &mut random);
        let mut team = Self { positions, malicious, budget, reach, error_m: 0.0, random: random.0 };
        team.stretch(random.between(0.0, 0.3)).then_some(team)
    }

    /// Scales the team up until the least honest h is at most `spare`; false if it is below 0 from the start.
    fn stretch(&mut self, spare: f64) -> bool {
        let compact = self.positions.clone();
        let (mut low, mut high) = (0.0, 8.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            self.positions = compact.iter().map(|x| x.map(|component| middle * component)).collect();
            *if self.least_h() >= spare { &mut low } else { &mut high } = middle;
        }
        self.positions = compact.iter().map(|x| x.map(|component| low * component)).collect();
        low > 0.0 && self.closest_pair() > DISTANCE_MIN_M && self.least_h() >= 0.0
    }

    fn closest_pair(&self) -> f64 {
        let distance = |i: usize, j: usize| length(&subtract(&self.positions[i], &self.positions[j]));
        let pairs = (0..self.count()).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.map(|(i, j)| distance(i, j)).fold(f64::INFINITY, f64::min)
    }

    pub(crate) fn need(&self) -> u16 {
        self.budget.need.need(RobotId(1))
    }

    pub(crate) fn count(&self) -> usize {
        self.positions.len()
    }

    pub(crate) fn honest(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        (0..self.count()).filter(|&k| !self.malicious[k])
    }

    fn least_h(&self) -> f64 {
        self.honest().map(|k| self.h(&self.positions, k)).fold(f64::INFINITY, f64::min)
    }

    /// a_ij of eq:adjacency, written as it is printed.
    fn weight(&self, x: &[Vector<D>], i: usize, j: usize) -> f64 {
        let LinkShape { radius_m, q1, q2 } = *self.budget.curvature.link();
        let offset = subtract(&x[i], &x[j]);
        let slack = radius_m * radius_m - dot(&offset, &offset);
        if slack < 0.0 { 0.0 } else { q1 / (1.0 + libm::exp(-q2 * slack * slack)) - q1 / 2.0 }
    }

    /// h_k at the positions `x`, from the level or, with free liars, from the trimmed one.
    pub(crate) fn h(&self, x: &[Vector<D>], k: usize) -> f64 {
        let mut weights: Vec<f64> =
            (0..self.count()).filter(|&j| self.counts(k, j)).map(|j| self.weight(x, k, j)).collect();
        weights.sort_by(f64::total_cmp);
        let trimmed = if self.budget.assume == Assume::Free { usize::from(self.budget.faults) } else { 0 };
        weights[..weights.len().saturating_sub(trimmed)].iter().sum::<f64>() - self.need_of(k)
    }

    /// What the theorem keeps at 0 or more: h_k, or under `Free` the sum over normal neighbours less θ.
    pub(crate) fn kept(&self, x: &[Vector<D>], k: usize) -> f64 {
        match self.budget.assume {
            Assume::Obedient => self.h(x, k),
            Assume::Free => {
                let normal = self.honest().filter(|&j| self.counts(k, j)).map(|j| self.weight(x, k, j));
                normal.sum::<f64>() - self.need_of(k)
            }
        }
    }

    fn need_of(&self, k: usize) -> f64 {
        f64::from(self.budget.need.need(member(&self.budget, id(k))))
    }

    /// True if j counts for k.
    pub(crate) fn counts(&self, k: usize, j: usize) -> bool {
        let [own, other] = [k, j].map(|robot| member(&self.budget, id(robot)));
        self.budget.need.counts(own, other)
    }

    pub(crate) fn in_range(&self, i: usize, j: usize) -> bool {
        let radius_m = self.radius_m();
        let offset = subtract(&self.positions[i], &self.positions[j]);
        i != j && dot(&offset, &offset) <= radius_m * radius_m
    }

    pub(crate) fn radius_m(&self) -> f64 {
        self.budget.curvature.link().radius_m
    }

    pub(crate) fn neighbors(&self, i: usize) -> Vec<usize> {
        (0..self.count()).filter(|&j| self.in_range(i, j)).collect()
    }

    pub(crate) fn sightings(&self, i: usize) -> Vec<Sighting<D>> {
        let near = (0..self.count()).filter(|&j| self.in_range(i, j) || (self.error_m > 0.0 && i != j));
        let own = self.sensed(i, i);
        let of = |j: usize| member(&self.budget, id(j));
        near.map(|j| Sighting::new(of(j), subtract(&own, &self.sensed(i, j)))).collect()
    }

    /// Where i senses j in this tick: anywhere up to the error from where it is, as a rule right at the bound.
    fn sensed(&self, i: usize, j: usize) -> Vector<D> {
        let mut random = Seeded(self.random ^ ((i as u64) << 32) ^ ((j as u64) << 48));
        let any: Vector<D> = core::array::from_fn(|_| random.between(-1.0, 1.0));
        let size = length(&any).max(1e-9) * [1.0, 1.0, 3.0][random.below(3)];
        add_scaled(&self.positions[j], self.error_m / size, &any)
    }
}

/// The number of a robot.
pub(crate) fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap_or(u16::MAX))
}

/// The robot as the roster has it: with ranks the first robots are the core, and after them two at a time share a rank.
pub(crate) fn member(budget: &Budget, id: RobotId) -> Member {
    let core = budget.need.counting(RobotId(1)) + 1;
    let rank = if budget.need.is_ranked() && id.0 > core { (id.0 - core).div_ceil(2) } else { 0 };
    Member { id, rank }
}

/// Places in a box of some 2 m, or 8 m long, no two closer than [`SPACING_M`].
fn scatter<const D: usize>(count: usize, random: &mut Seeded) -> Vec<Vector<D>> {
    let mut places: Vec<Vector<D>> = Vec::new();
    let long = [1.0, 2.5][random.below(2)];
    while places.len() < count {
        let place = core::array::from_fn(|d| if d == 0 { long } else { 1.0 } * random.between(-0.9, 0.9));
        if places.iter().all(|other| length(&subtract(other, &place)) > SPACING_M) {
            places.push(place);
        }
    }
    places
}
