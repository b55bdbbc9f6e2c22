//! The rows of a tick: (held) for neighbours that keep each other, (near) for all.

use crate::controller::budget::inequality::may_bind;
use crate::controller::budget::rows::Rows;
use crate::controller::links::Links;
use crate::num::{Vector, dot, length};
use crate::program::balls::reach::Reach;
use crate::program::balls::row::Row;
use crate::robot::neighbor::Slot;

impl Links {
    /// All rows of a robot that has these `slots`, keeps its row for all of them if it is `obliged`, wants to move by `desired_m` (m) and can move within `reach`.
    //= theory thm:held
    pub(super) fn rows<'memory, const D: usize>(
        &self,
        (slots, obliged): (&[Slot<D>], bool),
        desired_m: &Vector<D>,
        reach: Reach<D>,
        memory: &'memory mut [Row<D>],
    ) -> Rows<'memory, D> {
        let mut rows = Rows::new(desired_m, reach, memory);
        for slot in slots {
            if obliged || slot.peer.hold.is_active() {
                self.push_held(slot, &mut rows);
            }
            self.push_near(slot, &mut rows);
        }
        rows
    }

    /// (held) for a neighbour, unless it is certainly farther away than anybody counts on.
    //= theory eq:held
    fn push_held<const D: usize>(&self, slot: &Slot<D>, rows: &mut Rows<'_, D>) {
        let (offset_m, error_m) = (&slot.offset_m, self.error_m(slot));
        let square_m2 = dot(offset_m, offset_m);
        let distance_m2 = if error_m == 0.0 { square_m2 } else { squared(length(offset_m) + error_m) };
        let bound_m2 = 0.25 * self.gamma * (self.radius_m * self.radius_m - distance_m2).max(0.0);
        let in_sight = square_m2 <= squared(self.sight_m + error_m - self.errors.offset_m);
        if in_sight && may_bind(rows.program.reach.lhs_max(offset_m, error_m, 1.0), bound_m2) {
            rows.push(offset_m, error_m, |offset| Row::far(offset, bound_m2));
        }
    }

    /// (near) for a neighbour, and recovery of the distance of one that is sensed.
    //= theory eq:near
    fn push_near<const D: usize>(&self, slot: &Slot<D>, rows: &mut Rows<'_, D>) {
        let (offset_m, error_m) = (&slot.offset_m, self.error_m(slot));
        let square_m2 = dot(offset_m, offset_m);
        let nearest_m2 =
            if error_m == 0.0 { square_m2 } else { squared((length(offset_m) - error_m).max(0.0)) };
        let spare_m2 = nearest_m2 - squared(self.distance_held_m);
        let give_m2 = 0.5 * self.gamma_c * spare_m2.max(0.0);
        if may_bind(rows.program.reach.lhs_max(offset_m, error_m, 0.0), 0.5 * give_m2) {
            rows.push(offset_m, error_m, |offset| Row::near(offset, give_m2));
        }
        if nearest_m2 < squared(self.distance_min_m) && slot.sensed {
            let distance_m = length(offset_m);
            rows.count_violation(distance_m + error_m < self.distance_min_m);
            let missing_m = self.distance_min_m + error_m - distance_m;
            rows.raise(offset_m, (0.5 * missing_m).min(self.move_max_m));
        }
    }
}

fn squared(x: f64) -> f64 {
    x * x
}
