//! A tick in which all robots conspire, and the law that it may not break.

use closeranks_core::controller::assume::Assume;
use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};
use closeranks_core::program::balls::Program;
use closeranks_core::program::balls::row::Row;

use crate::budget_team::{Builder, DISTANCE_MIN_M, ROWS_MAX, Team, id};
use crate::seeded::Seeded;

/// Of positions of some metres and sums of a dozen weights.
const ROUNDING: f64 = 1e-12;

impl<const D: usize> Team<D> {
    /// The worst of some admissible moves of robot i for robot k.
    fn worst_move(&self, i: usize, k: usize, builder: Builder<'_, D>, random: &mut Seeded) -> Vector<D> {
        let rows = builder(&self.budget, id(i), &self.sightings(i), self.reach);
        let far = 5.0 * self.reach.longest_m();
        let away = self.outward(i, k);
        let mut worst = ([0.0; D], f64::INFINITY);
        for attempt in 0..4 {
            let any = core::array::from_fn(|_| random.between(-1.0, 1.0));
            let desired = match attempt {
                0 => away,
                1 => add_scaled(&any, -dot(&any, &away), &away),
                2 => add_scaled(&away, 1.0, &any),
                _ => any,
            };
            let mut memory = [Row::default(); ROWS_MAX];
            let mut program = Program::new(&mut memory, self.reach);
            for row in &rows {
                program.push(*row);
            }
            assert!(!program.is_full(), "memory for all rows");
            let v = program.closest(&desired.map(|component| far * component)).displacement_m;
            let mut x = self.positions.clone();
            x[i] = add_scaled(&x[i], 1.0, &v);
            let harm = self.kept(&x, k);
            if harm < worst.1 {
                worst = (v, harm);
            }
        }
        worst.0
    }

    /// The direction in which i takes most from k, of length 1.
    fn outward(&self, i: usize, k: usize) -> Vector<D> {
        let mut sum = [0.0; D];
        let counts =
            |j: usize| self.counts(k, j) && !(self.budget.assume == Assume::Free && self.malicious[j]);
        for j in (0..self.count()).filter(|&j| if i == k { self.in_range(i, j) && counts(j) } else { j == k })
        {
            let offset = subtract(&self.positions[i], &self.positions[j]);
            let slope = self.budget.curvature.slope_max(length(&offset), 0.0, 0.0);
            sum = add_scaled(&sum, slope + 1e-9, &offset);
        }
        let size = length(&sum).max(1e-12);
        sum.map(|component| component / size)
    }

    /// One tick in which all conspire against one honest robot, or two against each other.
    pub(crate) fn tick(&mut self, builder: Builder<'_, D>) -> Result<(), String> {
        self.random = self.random.wrapping_add(1);
        let mut random = Seeded(self.random);
        let victims: Vec<usize> = self.honest().collect();
        let poorest = victims
            .iter()
            .copied()
            .min_by(|&a, &b| self.h(&self.positions, a).total_cmp(&self.h(&self.positions, b)));
        let victim = match random.below(4) {
            0 => victims[random.below(victims.len())],
            _ => poorest.unwrap_or(0),
        };
        let crash = random.below(4) == 0;
        let moves: Vec<Vector<D>> = (0..self.count())
            .map(|i| {
                if self.malicious[i] && self.budget.assume == Assume::Free {
                    self.any_move(i, victim, &mut random)
                } else if crash {
                    self.approach(i, builder)
                } else {
                    self.worst_move(i, victim, builder, &mut random)
                }
            })
            .collect();
        self.random = random.0;
        self.check(&moves)?;
        self.positions = self.at(&moves, 1.0);
        Ok(())
    }

    /// What a malicious robot does that ignores the rows: flees from the victim, or jumps about.
    fn any_move(&self, i: usize, victim: usize, random: &mut Seeded) -> Vector<D> {
        let any = core::array::from_fn(|_| random.between(-1.0, 1.0));
        let flee = add_scaled(&self.outward(i, victim), 0.3, &any);
        let size = 2.0 * self.reach.longest_m();
        self.reach.clip(&if random.below(2) == 0 { any } else { flee }.map(|component| size * component))
    }

    /// Straight at the closest robot.
    fn approach(&self, i: usize, builder: Builder<'_, D>) -> Vector<D> {
        let sightings = self.sightings(i);
        let closest =
            sightings.iter().map(|sighting| sighting.offset_m).min_by(|a, b| dot(a, a).total_cmp(&dot(b, b)));
        let desired = closest.map_or([0.0; D], |offset| offset.map(|component| -component));
        let mut memory = [Row::default(); ROWS_MAX];
        let mut program = Program::new(&mut memory, self.reach);
        for row in builder(&self.budget, id(i), &sightings, self.reach) {
            program.push(row);
        }
        program.closest(&desired).displacement_m
    }

    fn at(&self, moves: &[Vector<D>], share: f64) -> Vec<Vector<D>> {
        self.positions.iter().zip(moves).map(|(x, v)| add_scaled(x, share, v)).collect()
    }

    /// Theorems B and D: what is kept decays by its share at most, at the tick and inside it, and so do the distances.
    fn check(&self, moves: &[Vector<D>]) -> Result<(), String> {
        let gamma_c = self.budget.gamma_c;
        for share in [0.3, 0.7, 1.0] {
            let after = self.at(moves, share);
            for k in self.honest() {
                let (before, now) = (self.kept(&self.positions, k), self.kept(&after, k));
                let floor = if before < 0.0 { before } else { before - self.budget.loss_max(before) };
                if now < floor - ROUNDING {
                    return Err(format!("h of {k} from {before:e} to {now:e}, allowed is {floor:e}"));
                }
            }
            let free = self.budget.assume == Assume::Free;
            for i in 0..self.count() {
                for j in (0..i).filter(|&j| !(free && (self.malicious[i] || self.malicious[j]))) {
                    let spare = |x: &[Vector<D>]| {
                        let offset = subtract(&x[i], &x[j]);
                        dot(&offset, &offset) - DISTANCE_MIN_M * DISTANCE_MIN_M
                    };
                    let (before, now) = (spare(&self.positions), spare(&after));
                    let floor = if before < 0.0 { before } else { (1.0 - gamma_c) * before };
                    if self.in_range(i, j) && now < floor - ROUNDING {
                        return Err(format!("pair {i}, {j} from {before:e} to {now:e} m²"));
                    }
                }
            }
        }
        Ok(())
    }
}
