//! The rows of a tick: (held) for neighbours that keep each other, (near) for all.

use crate::controller::links::Links;
use crate::controller::links::cut::Among;
use crate::controller::links::slack::Slack;
use crate::controller::rows::{Rows, give_m2, may_bind};
use crate::num::{Vector, dot, larger, length};
use crate::program::balls::reach::Reach;
use crate::program::balls::row::Row;
use crate::robot::neighbor::Slot;

/// What bounds the move of a robot next to a neighbour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beside<const D: usize> {
    /// x_i − x_j, m, as sensed last.
    pub offset_m: Vector<D>,
    /// How far it can have gone since, m.
    pub gone_m: f64,
    /// True if it is sensed in this tick.
    pub sensed: bool,
    /// True if both keep each other: it has a row (held).
    pub active: bool,
}

impl<const D: usize> Beside<D> {
    /// That of a robot that keeps its row for everybody if it is `obliged`.
    pub(super) fn of(slot: &Slot<D>, obliged: bool) -> Self {
        let active = obliged || slot.peer.hold.is_active();
        Self { offset_m: slot.offset_m, gone_m: slot.gone_m, sensed: slot.sensed, active }
    }

    /// That of a robot of another team, with which no link is kept.
    //= theory sec:strangers
    pub(super) fn stranger(slot: &Slot<D>) -> Self {
        Self { active: false, ..Self::of(slot, false) }
    }
}

impl Links {
    /// All rows of a robot that has these `others`, is `among` obstacles, wants to move by `desired_m` (m) and can move within `reach`, to
    /// which `slack` belongs. A link that is certainly cut has none: nobody counts on it.
    //= theory thm:held
    //= theory sec:cut-admitted
    #[inline]
    pub(super) fn rows<'memory, const D: usize>(
        &self,
        others: impl Iterator<Item = Beside<D>>,
        among: &Among<'_, D>,
        desired_m: &Vector<D>,
        (reach, slack): (Reach<D>, &Slack),
        memory: &'memory mut [Row<D>],
    ) -> Rows<'memory, D> {
        let (mut rows, is_open) = (Rows::new(desired_m, reach, memory), among.is_open());
        for other in others {
            let (offset_m, gone_m) = (&other.offset_m, other.gone_m);
            let (square_m2, exact) = (dot(offset_m, offset_m), gone_m == 0.0);
            let is_whole = other.active && (is_open || !among.room(offset_m, gone_m).is_lost());
            if is_whole && !(exact && slack.is_held_slack(square_m2)) {
                self.push_held(&other, &mut rows);
            }
            if is_whole && !is_open {
                among.push(offset_m, gone_m, &mut rows);
            }
            if !(exact && slack.is_near_slack(square_m2)) {
                self.push_near(&other, &mut rows);
            }
        }
        rows
    }

    /// (held) for a neighbour, unless it is certainly farther away than anybody counts on.
    //= theory eq:held
    #[inline]
    fn push_held<const D: usize>(&self, other: &Beside<D>, rows: &mut Rows<'_, D>) {
        let (offset_m, error_m) = (&other.offset_m, self.error_m(other.gone_m));
        let square_m2 = dot(offset_m, offset_m);
        let distance_m2 = if error_m == 0.0 { square_m2 } else { squared(length(offset_m) + error_m) };
        let bound_m2 = 0.25 * self.gamma * larger(squared(self.radius_m) - distance_m2, 0.0);
        let in_sight = square_m2 <= squared(self.sight_m + error_m - self.errors.offset_m);
        if in_sight && may_bind(rows.program.reach.lhs_max(offset_m, error_m, 1.0), bound_m2) {
            rows.push(offset_m, error_m, |offset| Row::far(offset, bound_m2));
        }
    }

    /// (near) for a neighbour, and recovery of the distance of one that is sensed.
    //= theory eq:near
    #[inline]
    fn push_near<const D: usize>(&self, other: &Beside<D>, rows: &mut Rows<'_, D>) {
        let (offset_m, error_m) = (&other.offset_m, self.error_m(other.gone_m));
        let square_m2 = dot(offset_m, offset_m);
        let nearest_m2 =
            if error_m == 0.0 { square_m2 } else { squared((length(offset_m) - error_m).max(0.0)) };
        let spare_m2 = nearest_m2 - squared(self.distance_held_m);
        let give_m2 = give_m2(self.gamma_c, spare_m2);
        if may_bind(rows.program.reach.lhs_max(offset_m, error_m, 0.0), 0.5 * give_m2) {
            rows.push(offset_m, error_m, |offset| Row::near(offset, give_m2));
        }
        if nearest_m2 < squared(self.distance_min_m) && other.sensed {
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

#[cfg(test)]
mod tests {
    use core::time::Duration;

    use super::*;
    use crate::controller::assume::Assume;
    use crate::controller::errors::ErrorBounds;
    use crate::controller::links::cut::Cuts;
    use crate::need::{Keep, Need};
    use crate::num::{add_scaled, subtract};
    use crate::program::InputBox;

    fn links(errors: ErrorBounds) -> Links {
        Links {
            need: Need::new(11, 2, Keep::Neighbors),
            spare: 0,
            assume: Assume::Obedient,
            radius_m: Links::held_radius_m(3.0, &errors),
            sight_m: 3.0 + errors.offset_m,
            distance_min_m: 0.3,
            distance_held_m: Links::held_distance_m(0.3),
            move_max_m: 0.3,
            speed_max_m_s: 3.0,
            gamma: 0.9,
            gamma_c: 0.9,
            errors,
            horizon_s: 4.0,
            pass_right: false,
            told_max: Duration::ZERO,
        }
    }

    fn reach() -> Reach<2> {
        Reach::new(&InputBox::of([-2.0; 2], [2.0; 2]), 0.1)
    }

    /// Nothing is there that could cut links.
    fn nothing() -> Among<'static, 2> {
        Among::new(Cuts { keep_m: 0.0, error_m: 0.0 }, [0.0; 2], &[])
    }

    fn row_of(links: &Links, offset_m: [f64; 2], memory: &mut [Row<2>]) -> [f64; 2] {
        let slot = Slot { sensed: true, offset_m, ..Slot::default() };
        let (beside, slack) = ([Beside::of(&slot, false)], Slack::new(links, &reach()));
        links
            .rows(beside.into_iter(), &nothing(), &offset_m, (reach(), &slack), memory)
            .closest()
            .displacement_m
    }

    //= theory eq:held type=test
    #[test]
    fn a_pair_that_pulls_apart_as_far_as_rows_allow_ends_within_the_held_radius() {
        let links = links(ErrorBounds::NONE);
        for hundredths in 100..=300 {
            let offset_m = [0.01 * f64::from(hundredths), 0.0];
            let memory = &mut [Row::default(); 30];
            let away_m = row_of(&links, offset_m, memory);
            let other_m = row_of(&links, subtract(&[0.0; 2], &offset_m), memory);
            let after = length(&subtract(&add_scaled(&offset_m, 1.0, &away_m), &other_m));
            assert!(after <= links.radius_m.max(offset_m[0]) + 1e-15, "{offset_m:?}: {after}");
            assert!(after >= offset_m[0] && (after > offset_m[0] || hundredths == 300));
        }
    }

    #[test]
    fn rows_hold_for_every_offset_that_errors_allow() {
        let errors = ErrorBounds::new(0.02, 0.0);
        let links = links(errors);
        let offset_m = [2.9, 0.3];
        let moved_m = row_of(&links, offset_m, &mut [Row::default(); 30]);
        for turn in 0..16 {
            let angle = f64::from(turn) * core::f64::consts::FRAC_PI_8;
            let error_m = [libm::cos(angle), libm::sin(angle)].map(|part| errors.offset_m * part);
            let offset_m = add_scaled(&offset_m, 1.0, &error_m);
            let bound_m2 =
                0.25 * links.gamma * (squared(links.radius_m) - dot(&offset_m, &offset_m)).max(0.0);
            assert!(dot(&offset_m, &moved_m) + dot(&moved_m, &moved_m) <= bound_m2 + 1e-15);
        }
    }

    /// At any distance, in any direction: where both rows are left out because neither can bind, neither would have been kept.
    #[test]
    fn rows_that_are_left_out_would_not_have_been_kept() {
        let none = Slack::new(&links(ErrorBounds::new(0.02, 0.0)), &reach());
        let (mut left_out, mut kept) = (0, 0);
        for side_m in [0.02, 0.1, 0.3, 0.6] {
            let reach = Reach::new(&InputBox::of([-side_m, -0.5 * side_m], [0.7 * side_m, side_m]), 1.0);
            let links = links(ErrorBounds::NONE);
            let slack = Slack::new(&links, &reach);
            for step in 0..3_000 {
                let (angle, far_m) = (0.7 * f64::from(step), 0.001 * f64::from(step));
                let offset_m = [far_m * libm::cos(angle), far_m * libm::sin(angle)];
                let other = Beside { offset_m, gone_m: 0.0, sensed: true, active: true };
                let memory = &mut [Row::default(); 12];
                let all = links.rows([other].into_iter(), &nothing(), &[0.0; 2], (reach, &none), memory);
                let rows = all.program.rows().len() - reach.rows();
                let square_m2 = dot(&offset_m, &offset_m);
                let spare =
                    usize::from(slack.is_held_slack(square_m2)) + usize::from(slack.is_near_slack(square_m2));
                assert!(rows + spare <= 2, "{far_m} m, {side_m} m");
                (left_out, kept) = (left_out + spare, kept + rows);
            }
        }
        assert!(left_out > 4_000 && kept > 2_000, "{left_out} {kept}");
    }
}
