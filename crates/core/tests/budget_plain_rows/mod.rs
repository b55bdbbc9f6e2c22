//! The rows of a tick, one after the other, each from its formula. Nothing is kept from one row to the next.

use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::knowledge::{KnownMargin, Sighting};
use closeranks_core::controller::budget::settings::{Budget, Form};
use closeranks_core::equations::link::Link;
use closeranks_core::num::{Vector, add_scaled, dot, is_finite, length};
use closeranks_core::program::balls::Program;
use closeranks_core::program::balls::reach::Reach;
use closeranks_core::program::balls::row::Row;
use closeranks_core::robot::neighbor::RobotId;

use crate::budget_literal::{count, known, level};

/// What a tick comes to.
pub(crate) struct Plain<const D: usize> {
    pub(crate) rows: Vec<Row<D>>,
    pub(crate) desired_m: Vector<D>,
    pub(crate) h: f64,
    pub(crate) broken: usize,
}

struct Tick<'a, const D: usize> {
    budget: &'a Budget,
    program: Program<'a, D>,
    desired_m: Vector<D>,
    h: f64,
    degree: f64,
    gradient: Vector<D>,
    bend: f64,
    wrong: f64,
    broken: usize,
}

/// (far) or (far′), then (near), of each neighbour in range; at last (far′) of the robot itself.
pub(crate) fn plain<const D: usize>(
    budget: &Budget,
    own: RobotId,
    sightings: &[Sighting<D>],
    desired_m: &Vector<D>,
    reach: Reach<D>,
    memory: &mut [Row<D>],
) -> Plain<D> {
    let sight_m = budget.curvature.link().radius_m + budget.errors.offset_m;
    let in_range = |offset: &Vector<D>| sight_m * sight_m - dot(offset, offset) >= 0.0;
    let mut tick = Tick {
        budget,
        program: Program::new(memory, reach),
        desired_m: *desired_m,
        h: level(budget, own, sightings) - f64::from(budget.need.need(own)),
        degree: count(sightings.iter().filter(|sighting| in_range(&sighting.offset_m)).count()),
        gradient: [0.0; D],
        bend: 0.0,
        wrong: 0.0,
        broken: 0,
    };
    if !sightings.iter().all(|sighting| is_finite(&sighting.offset_m)) {
        tick.program.push(Row::new([0.0; D], 1.0, 0.0));
        let rows = tick.program.rows().to_vec();
        return Plain { rows, desired_m: *desired_m, h: 0.0, broken: 0 };
    }
    for (index, Sighting { offset_m, .. }) in sightings.iter().enumerate() {
        if in_range(offset_m) {
            tick.far(offset_m, &known(budget, own, index, sightings));
            tick.near(offset_m);
        }
    }
    tick.own();
    let rows = tick.program.rows().to_vec();
    Plain { rows, desired_m: tick.desired_m, h: tick.h, broken: tick.broken }
}

impl<const D: usize> Tick<'_, D> {
    fn far(&mut self, offset_m: &Vector<D>, known: &KnownMargin) {
        let (budget, distance_m) = (self.budget, length(offset_m));
        let (curvature, move_m, error_m) = (&budget.curvature, budget.move_max_m, budget.errors.offset_m);
        let link: Option<Link<f64>> = curvature.link().link(offset_m);
        let gradient = link.map_or([0.0; D], |link| link.gradient(offset_m));
        self.gradient = add_scaled(&self.gradient, 1.0, &gradient);
        if budget.form == Form::Link || budget.assume == Assume::Free {
            let slope = curvature.slope_max(distance_m, move_m, error_m);
            let own_share = self.budget.loss_max(self.h.max(0.0)) / self.degree.max(1.0);
            let beta_m2 = budget.beta_m2(slope, own_share, budget.loss_max(known.budget) / known.degree_max);
            self.push(offset_m, error_m, |offset| Row::far(offset, beta_m2));
        } else {
            let bend = curvature.bend_max(distance_m, move_m, error_m);
            let wrong = curvature.gradient_error(distance_m, error_m);
            (self.bend, self.wrong) = (self.bend + bend, self.wrong + wrong);
            let spend = budget.loss_max(known.budget) / (known.degree_max + 1.0);
            self.push(&gradient, wrong, |gradient| Row::far_level(gradient, bend, spend));
        }
    }

    fn near(&mut self, offset_m: &Vector<D>) {
        let (error_m, least_m) = (self.budget.errors.offset_m, self.budget.distance_min_m);
        let spare_m2 = |more_m: f64| {
            let distance_m = (length(offset_m) + more_m).max(0.0);
            (if more_m == 0.0 { dot(offset_m, offset_m) } else { distance_m * distance_m })
                - least_m * least_m
        };
        let give_m2 = 0.5 * self.budget.gamma_c * spare_m2(-error_m).max(0.0);
        self.push(offset_m, error_m, |offset| Row::near(offset, give_m2));
        if spare_m2(-error_m) < 0.0 {
            self.broken += usize::from(spare_m2(error_m) < 0.0);
            let missing_m = least_m + error_m - length(offset_m);
            self.raise(offset_m, (0.5 * missing_m).min(self.budget.move_max_m));
        }
    }

    fn own(&mut self) {
        let gradient = self.gradient;
        if self.budget.form == Form::Level && self.budget.assume == Assume::Obedient {
            let spend = self.budget.loss_max(self.h.max(0.0)) / (self.degree + 1.0);
            let bend = self.bend;
            self.push(&gradient, self.wrong, |gradient| Row::far_level(gradient, bend, spend));
        }
        if self.h < 0.0 {
            let weight_error = 2.0 * self.budget.errors.offset_m * self.budget.curvature.fall_max();
            self.broken += usize::from(self.h + self.degree * weight_error < 0.0);
            self.raise(&gradient, (-self.h / length(&gradient)).min(self.budget.move_max_m));
        }
    }

    fn push(&mut self, vector: &Vector<D>, wrong: f64, row: impl Fn(&Vector<D>) -> Row<D>) {
        if wrong == 0.0 {
            return self.program.push(row(vector));
        }
        for corner in 0..1_usize << D {
            let tilt = |d: usize| if corner >> d & 1 == 1 { wrong } else { -wrong };
            self.program.push(row(&core::array::from_fn(|d| vector[d] + tilt(d))));
        }
    }

    fn raise(&mut self, direction: &Vector<D>, wanted_m: f64) {
        let size = length(direction);
        if size > 0.0 && size.is_finite() && wanted_m > 0.0 {
            let unit = direction.map(|component| component / size);
            let missing = wanted_m - dot(&unit, &self.desired_m);
            if missing > 0.0 {
                self.desired_m = add_scaled(&self.desired_m, missing, &unit);
            }
        }
    }
}
