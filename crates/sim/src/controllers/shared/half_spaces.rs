//! The velocity of one robot closest to a desired one inside half-spaces and the input box.

use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};
use closeranks_core::program::balls::Program;
use closeranks_core::program::balls::reach::Reach;
use closeranks_core::program::balls::row::Row;
use closeranks_core::program::{InputBox, Outcome};

use crate::controllers::Answer;

/// So often a velocity that all half-spaces allow is looked for.
const STEPS: usize = 200;
/// A velocity counts as allowed if it breaks no constraint by more than this, m/s.
const ROUNDING_M_S: f64 = 1e-9;

/// The half-spaces of one robot.
#[derive(Clone, Debug, Default)]
pub(in crate::controllers) struct HalfSpaces {
    planes: Vec<Plane>,
}

/// The half-space `normal·w ≥ bound` of velocities, with a normal of length 1; only its first components are used.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: [f64; 3],
    bound: f64,
    /// Where not all can be satisfied, those that come first are.
    first: bool,
}

impl HalfSpaces {
    /// Forgets all half-spaces.
    pub(in crate::controllers) fn clear(&mut self) {
        self.planes.clear();
    }

    /// Adds `normal·w ≥ bound`. Without a direction it says nothing about the velocity, and is left out.
    pub(in crate::controllers) fn push<const D: usize>(&mut self, normal: &Vector<D>, bound: f64) {
        self.add(normal, bound, false);
    }

    /// The same for what comes before all else: that nobody collides.
    pub(in crate::controllers) fn push_first<const D: usize>(&mut self, normal: &Vector<D>, bound: f64) {
        self.add(normal, bound, true);
    }

    fn add<const D: usize>(&mut self, normal: &Vector<D>, bound: f64, first: bool) {
        let size = length(normal);
        if size > 0.0 && size.is_finite() {
            let mut unit = [0.0; 3];
            unit.iter_mut().zip(normal).for_each(|(component, n)| *component = n / size);
            self.planes.push(Plane { normal: unit, bound: bound / size, first });
        }
    }

    /// The velocity closest to `desired` that all allow. Where none is allowed, one is looked for from `from` on that breaks
    /// little, and none of those that come first if that can be; those that it breaks are moved so that it no longer does, and the
    /// outcome is `Infeasible`.
    pub(in crate::controllers) fn closest<const D: usize>(
        &self,
        desired: &Vector<D>,
        from: &Vector<D>,
        input: &InputBox<D>,
    ) -> Answer<D> {
        let (start, missing) = self.allowed(from, input, false);
        let start = if missing > ROUNDING_M_S { self.allowed(&start, input, true).0 } else { start };
        // Seen from `start`, the box and every half-space contain 0, as the program wants it.
        let around = InputBox::of(subtract(&input.min_m_s, &start), subtract(&input.max_m_s, &start));
        let mut rows = vec![Row::default(); 2 * D + self.planes.len()];
        let mut program = Program::new(&mut rows, Reach::new(&around, 1.0));
        for plane in &self.planes {
            let normal: Vector<D> = core::array::from_fn(|d| -plane.normal[d]);
            program.push(Row::new(normal, 0.0, -dot(&normal, &start) - plane.bound));
        }
        let closest = program.closest(&subtract(desired, &start));
        let velocity_m_s = add_scaled(&start, 1.0, &closest.displacement_m);
        let outcome = if missing > ROUNDING_M_S { Outcome::Infeasible } else { closest.outcome };
        Answer { velocity_m_s, outcome }
    }

    /// A velocity in the box that breaks no constraint, and 0, or one that breaks some, and by how much, m/s.
    ///
    /// Each step goes to the boundary of the constraint that is broken most. With `first`, only those count that come first.
    fn allowed<const D: usize>(
        &self,
        from: &Vector<D>,
        input: &InputBox<D>,
        first: bool,
    ) -> (Vector<D>, f64) {
        let planes = || self.planes.iter().filter(|plane| plane.first || !first);
        let broken = |velocity: &Vector<D>, plane: &Plane| {
            let along: f64 = (0..D).map(|d| plane.normal[d] * velocity[d]).sum();
            plane.bound - along
        };
        let mut velocity = input.clip(from);
        for _ in 0..STEPS {
            let worst = planes().map(|plane| (broken(&velocity, plane), plane));
            let worst = worst
                .fold((0.0, None), |most, (by, plane)| if by > most.0 { (by, Some(plane)) } else { most });
            let (by, Some(plane)) = worst else { return (velocity, 0.0) };
            velocity = input.clip(&core::array::from_fn(|d| velocity[d] + by * plane.normal[d]));
        }
        let missing = planes().map(|plane| broken(&velocity, plane)).fold(0.0, f64::max);
        (velocity, missing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closest_velocity_is_allowed_and_what_cannot_be_is_said() {
        let input = InputBox::of([-1.0; 2], [1.0; 2]);
        let mut spaces = HalfSpaces::default();
        spaces.push(&[2.0, 0.0], 1.0);
        spaces.push(&[0.0; 2], 7.0);
        let answer = spaces.closest(&[-1.0, 0.25], &[0.0; 2], &input);
        assert_eq!((answer.velocity_m_s, answer.outcome == Outcome::Infeasible), ([0.5, 0.25], false));
        spaces.push(&[-1.0, 0.0], 0.0);
        assert_eq!(spaces.closest(&[0.0; 2], &[0.0; 2], &input).outcome, Outcome::Infeasible);
        spaces.push_first(&[1.0, 0.0], 0.75);
        let answer = spaces.closest(&[0.0; 2], &[0.0; 2], &input);
        assert!((answer.velocity_m_s[0] - 0.75).abs() < 1e-12, "{answer:?}");
        spaces.clear();
        assert_eq!(spaces.closest(&[2.0, 0.0], &[0.0; 2], &input).velocity_m_s, [1.0, 0.0]);
    }
}
