//! Random programs of the budget controller, and a certificate of how far an answer is from the closest point.

#![allow(dead_code, reason = "not every file of tests needs every part")]

use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};
use closeranks_core::program::InputBox;
use closeranks_core::program::balls::reach::Reach;
use closeranks_core::program::balls::row::Row;
use closeranks_core::program::balls::{Closest, Program};

use crate::seeded::Seeded;

const ROWS_MAX: usize = 40;

#[derive(Clone, Debug)]
pub(crate) struct Case<const D: usize> {
    pub(crate) desired: Vector<D>,
    pub(crate) rows: Vec<Row<D>>,
    pub(crate) input: InputBox<D>,
}

impl<const D: usize> Case<D> {
    /// Balls and half-spaces of the sizes that the controller meets.
    pub(crate) fn ordinary(seed: u64) -> Self {
        let mut random = Seeded(seed);
        let rows = (0..=random.below(12))
            .map(|_| {
                let normal = core::array::from_fn(|_| random.between(-2.0, 2.0));
                let curvature = [0.0, 1.0, random.between(0.1, 8.0)][random.below(3)];
                Row::new(normal, curvature, random.between(0.01, 1.5))
            })
            .collect();
        Self::with(rows, &mut random)
    }

    /// Everything that can go wrong: no budget, duplicates, opposite and tangent rows, huge and tiny radii, flat boxes.
    pub(crate) fn degenerate(seed: u64) -> Self {
        let mut random = Seeded(seed);
        let mut rows: Vec<Row<D>> = Vec::new();
        let axis: Vector<D> = core::array::from_fn(|_| random.between(-2.0, 2.0));
        for _ in 0..=random.below(8) {
            let any: Vector<D> = core::array::from_fn(|_| random.between(-2.0, 2.0));
            let turn = [1.0, -1.0, 0.5, -3.0][random.below(4)];
            let normal = match random.below(6) {
                0 => axis.map(|component| turn * component),
                1 => add_scaled(&axis.map(|component| turn * component), 1e-9, &any),
                2 => core::array::from_fn(|d| if d == 0 { turn } else { 0.0 }),
                3 => [0.0; D],
                _ => any,
            };
            let curvature = [0.0, 0.0, 1.0, 1e-9, 1e9, random.between(0.1, 8.0)][random.below(6)];
            let bound = [0.0, 0.0, 1e-18, 1e-6, random.between(0.0, 1.0), 1e3][random.below(6)];
            let size = [1.0, 1.0, 1e-200, 1e200][random.below(4)];
            let row = Row::new(normal.map(|component| size * component), size * curvature, size * bound);
            rows.extend(core::iter::repeat_n(row, 1 + random.below(2)));
        }
        let mut case = Self::with(rows, &mut random);
        for d in 0..D {
            if random.below(8) == 0 {
                case.input.max_m_s[d] = 0.0;
            }
        }
        case
    }

    fn with(rows: Vec<Row<D>>, random: &mut Seeded) -> Self {
        let input = InputBox::of(
            core::array::from_fn(|_| -random.between(0.2, 1.5)),
            core::array::from_fn(|_| random.between(0.2, 1.5)),
        );
        let reach = [0.3, 1.0, 3.0][random.below(3)];
        let desired = core::array::from_fn(|_| reach * random.between(-1.0, 1.0));
        Self { desired, rows, input }
    }

    pub(crate) fn solve(&self) -> Closest<D> {
        self.solve_by(|program| program.closest(&self.desired))
    }

    pub(crate) fn solve_from(&self, before: &Vector<D>) -> Closest<D> {
        self.solve_by(|program| program.closest_from(&self.desired, before))
    }

    fn solve_by(&self, closest: impl FnOnce(&mut Program<'_, D>) -> Closest<D>) -> Closest<D> {
        let mut memory = [Row::default(); ROWS_MAX];
        let mut program = Program::new(&mut memory, Reach::new(&self.input, 1.0));
        for row in &self.rows {
            program.push(*row);
        }
        let closest = closest(&mut program);
        let v = closest.displacement_m;
        assert!(!program.is_full() && self.admits(&v), "{v:?} is not admissible in {self:?}");
        closest
    }

    pub(crate) fn admits(&self, v: &Vector<D>) -> bool {
        self.input.contains(v) && self.rows.iter().all(|row| row.holds(v))
    }

    /// No admissible point is closer to the desired one than v by more than this. It follows from duality: for any
    /// multipliers λ ≥ 0, `min_v |v − p|² + Σ λ_j (n_j·v + c_j|v|² − b_j)` is below the squared distance of every admissible v.
    pub(crate) fn gap(&self, v: &Vector<D>) -> f64 {
        let distance = length(&subtract(v, &self.desired));
        let mut tight: Vec<Row<D>> = self.with_sides();
        tight.retain(|row| value(row, v) >= row.bound() - 1e-7 * (row.bound() + length(v)));
        let mut least = if distance == 0.0 { 0.0 } else { f64::INFINITY };
        for first in 0..tight.len() {
            least = least.min(distance - self.bound(v, &tight[first..=first]));
            for second in first + 1..tight.len() {
                least = least.min(distance - self.bound(v, &[tight[first], tight[second]]));
                for third in second + 1..tight.len() {
                    least = least.min(distance - self.bound(v, &[tight[first], tight[second], tight[third]]));
                }
            }
        }
        least
    }

    fn with_sides(&self) -> Vec<Row<D>> {
        let side = |d: usize, sign: f64| core::array::from_fn(|axis| if axis == d { sign } else { 0.0 });
        let low = (0..D).map(|d| Row::new(side(d, -1.0), 0.0, -self.input.min_m_s[d]));
        let high = (0..D).map(|d| Row::new(side(d, 1.0), 0.0, self.input.max_m_s[d]));
        self.rows.iter().copied().chain(low).chain(high).collect()
    }

    /// A distance, from duality with these rows: no admissible point is closer to the desired one.
    fn bound(&self, v: &Vector<D>, rows: &[Row<D>]) -> f64 {
        let pull = subtract(&self.desired, v);
        let gradients: Vec<Vector<D>> =
            rows.iter().map(|row| add_scaled(row.normal(), 2.0 * row.curvature(), v)).collect();
        let Some(multipliers) = nonnegative(&gradients, &pull.map(|component| 2.0 * component)) else {
            return 0.0;
        };
        // L at its minimum v + e, written about v so that nothing large cancels
        let (mut curvature, mut slack) = (1.0, 0.0);
        let mut slope = pull.map(|component| -2.0 * component);
        for ((row, gradient), multiplier) in rows.iter().zip(&gradients).zip(&multipliers) {
            curvature += multiplier * row.curvature();
            slope = add_scaled(&slope, *multiplier, gradient);
            slack += multiplier * (value(row, v) - row.bound());
        }
        let square = dot(&pull, &pull) + slack - dot(&slope, &slope) / (4.0 * curvature);
        libm::sqrt(square.max(0.0))
    }
}

pub(crate) fn value<const D: usize>(row: &Row<D>, v: &Vector<D>) -> f64 {
    dot(row.normal(), v) + row.curvature() * dot(v, v)
}

/// Least squares `Σ λ_j g_j ≈ pull` with λ ≥ 0, by elimination with a little damping; `None` if some λ is negative.
fn nonnegative<const D: usize>(gradients: &[Vector<D>], pull: &Vector<D>) -> Option<Vec<f64>> {
    let count = gradients.len();
    let mut system: Vec<Vec<f64>> = (0..count)
        .map(|j| {
            let row = gradients.iter().map(|other| dot(&gradients[j], other));
            row.chain([dot(&gradients[j], pull)]).collect()
        })
        .collect();
    for pivot in 0..count {
        let lead = system[pivot][pivot];
        if lead <= 1e-300 {
            return None;
        }
        for below in 0..count {
            if below != pivot {
                let share = system[below][pivot] / lead;
                let line = system[pivot].clone();
                system[below].iter_mut().zip(&line).for_each(|(entry, other)| *entry -= share * other);
            }
        }
    }
    let multipliers: Vec<f64> = (0..count).map(|j| system[j][count] / system[j][j]).collect();
    multipliers.iter().all(|&multiplier| multiplier >= 0.0).then_some(multipliers)
}
