//! What keeps a robot clear of still obstacles: one more half-space for each obstacle that a move could reach, under whichever
//! controller.
//!
//! ```text
//! (clear)  −o·v ≤ |o| (|o| − radius − m)⁺        o = from the nearest point of the obstacle's segment to the robot
//! ```
//!
//! An obstacle is convex and stands still, so it lies behind the plane through its nearest point: what a move may take of the
//! distance is all that there is, in any tick of any length, between ticks too. The half-space contains v = 0.
//!
//! A robot that is nearer than m all the same goes away from the obstacle (`Clearance::recover`).

use crate::controller::rows::{Rows, may_bind};
use crate::num::{Vector, length};
use crate::obstacle::Obstacle;
use crate::program::balls::Program;
use crate::program::balls::row::Row;
use crate::settings::Settings;

/// Robots are held so much farther away than they must be, m: more than rounding, less than anybody can see.
const HAIR_M: f64 = 1e-9;

/// How far robots keep from obstacles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// m, from a reference to an obstacle, m: what is demanded of robots, and how far a robot may be from its reference.
    pub keep_m: f64,
    /// How wrong the place is at which a robot counts itself, m.
    pub error_m: f64,
}

impl Clearance {
    /// What follows from the settings. A robot with a tracking error knows its reference, which may be away from it; one without
    /// is its own reference, and may sense it wrong.
    //= theory eq:clear
    #[must_use]
    pub fn new<const D: usize>(settings: &Settings<D>) -> Self {
        let away_m = settings.error_bounds().away_m;
        let error_m = if away_m > 0.0 { 0.0 } else { settings.errors.position_m };
        Self { keep_m: settings.limits.clearance_m + away_m + HAIR_M, error_m }
    }

    /// Adds the rows of a robot at `position_m` for what of `map` a move can reach. With an error of the place there is one for
    /// every corner of the cube around the offset.
    //= theory eq:clear
    pub(crate) fn push<const D: usize>(
        &self,
        position_m: &Vector<D>,
        map: &[Obstacle<D>],
        program: &mut Program<'_, D>,
    ) {
        for obstacle in map {
            let toward_m = obstacle.offset_m(position_m).map(|component| -component);
            let least_m = (length(&toward_m) - self.error_m).max(0.0);
            let bound_m2 = least_m * (least_m - obstacle.radius_m - self.keep_m).max(0.0);
            if may_bind(program.reach.lhs_max(&toward_m, self.error_m, 0.0), bound_m2) {
                program.push_around(&toward_m, self.error_m, |toward| Row::new(*toward, 0.0, bound_m2));
            }
        }
    }
}

impl Clearance {
    /// Lets a robot at `position_m` that is nearer to something of `map` than it may be wish to go straight away from it: in a tick by all
    /// that is missing, but no farther than the longest move. One whose place is on the segment of an obstacle has no way out to wish for.
    //= theory sec:clear-recovery
    pub(crate) fn recover<const D: usize>(
        &self,
        position_m: &Vector<D>,
        map: &[Obstacle<D>],
        rows: &mut Rows<'_, D>,
    ) {
        for obstacle in map {
            let offset_m = obstacle.offset_m(position_m);
            let missing_m = obstacle.radius_m + self.keep_m - length(&offset_m);
            if missing_m + self.error_m > HAIR_M {
                rows.count_obstacle(missing_m - self.error_m > HAIR_M);
                let longest_m = rows.program.reach.longest_m();
                rows.raise(&offset_m, (missing_m + self.error_m).min(longest_m));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::{add_scaled, subtract};
    use crate::program::InputBox;
    use crate::program::balls::reach::Reach;

    const REACH_M: f64 = 0.3;

    fn moved(clearance: Clearance, at: [f64; 2], map: &[Obstacle<2>], wish_m: [f64; 2]) -> [f64; 2] {
        let mut memory = [Row::default(); 40];
        let mut program =
            Program::new(&mut memory, Reach::new(&InputBox::of([-REACH_M; 2], [REACH_M; 2]), 1.0));
        clearance.push(&at, map, &mut program);
        program.closest(&wish_m).displacement_m
    }

    fn gap_m(obstacle: &Obstacle<2>, at: &[f64; 2]) -> f64 {
        length(&obstacle.offset_m(at)) - obstacle.radius_m
    }

    /// Wherever a robot is, whatever it wishes, and wherever it really is within its error: not nearer than allowed, between ticks too.
    //= theory thm:clear type=test
    #[test]
    fn no_wish_and_no_error_takes_a_robot_nearer_than_allowed() {
        let map = [Obstacle::disc([0.0, 0.0], 0.5), Obstacle::wall([0.9, -1.0], [1.1, 1.0])];
        let mut stopped = 0;
        for error_m in [0.0, 0.02] {
            let clearance = Clearance { keep_m: 0.15, error_m };
            for k in 0..1200 {
                let angle = 0.37 * f64::from(k);
                let (there, turn) = ([libm::cos(angle), libm::sin(angle)], 1.7 * f64::from(k % 11));
                let sensed = there.map(|part| (0.66 + 0.001 * f64::from(k % 200)) * part);
                let at = add_scaled(&sensed, error_m, &[libm::cos(turn), libm::sin(turn)]);
                if map.iter().any(|obstacle| gap_m(obstacle, &at) < 0.15) {
                    continue;
                }
                let wish = [libm::cos(2.3 * turn), libm::sin(2.3 * turn)];
                let v = moved(clearance, sensed, &map, wish);
                stopped += u32::from(length(&subtract(&v, &wish)) > 0.8);
                for part in [0.25, 0.5, 1.0] {
                    let end = add_scaled(&at, part, &v);
                    assert!(
                        map.iter().all(|obstacle| gap_m(obstacle, &end) >= 0.15 - 1e-12),
                        "{k} {error_m}"
                    );
                }
            }
        }
        assert!(stopped > 100, "{stopped}");
    }

    #[test]
    fn who_is_too_near_comes_no_nearer_and_may_leave() {
        let (map, clearance) = ([Obstacle::disc([0.0, 0.0], 0.5)], Clearance { keep_m: 0.15, error_m: 0.0 });
        assert_eq!(moved(clearance, [0.6, 0.0], &map, [-0.2, 0.0]), [0.0, 0.0]);
        assert_eq!(moved(clearance, [0.6, 0.0], &map, [0.2, 0.1]), [0.2, 0.1]);
    }

    #[test]
    fn an_obstacle_without_numbers_forbids_any_move() {
        let clearance = Clearance { keep_m: 0.15, error_m: 0.0 };
        for bad in [f64::NAN, f64::INFINITY] {
            let map = [Obstacle::disc([bad, 0.0], 0.5)];
            assert_eq!(moved(clearance, [0.6, 0.0], &map, [0.2, 0.1]), [0.0, 0.0]);
        }
    }

    #[test]
    fn more_obstacles_than_there_is_memory_for_mean_standing_still() {
        let map = [Obstacle::disc([0.9, 0.0], 0.5); 3];
        let mut memory = [Row::default(); 6];
        let mut program = Program::new(&mut memory, Reach::new(&InputBox::of([-1.0; 2], [1.0; 2]), 1.0));
        Clearance { keep_m: 0.1, error_m: 0.0 }.push(&[0.0, 0.0], &map, &mut program);
        assert!(program.is_full());
        assert_eq!(program.closest(&[-0.5, 0.0]).displacement_m, [0.0, 0.0]);
    }
}
