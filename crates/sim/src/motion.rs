//! Where robots want to go.

use closeranks_core::math::{Vector, length};

/// Desired motion u_{i,des}(x_i).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// The paper's section V: unit speed in four directions (six in 3D), which would break the network.
    Paper,
    /// Stay.
    Hold,
}

impl Motion {
    /// Desired velocity of robot `number` (from 1) of `robots`, m/s.
    ///
    /// ```text
    /// v = (−1)^i · 100 e_d − x_i,   u_des = v/‖v‖
    /// ```
    ///
    /// with axis d = 1 for the first ⌊n/D⌋ robots, d = 2 for the next, and so on: for n = 11, D = 2 as printed.
    //= paper sec:sim
    #[must_use]
    pub fn desired<const D: usize>(self, number: u16, robots: u16, position: &Vector<D>) -> Vector<D> {
        let Self::Paper = self else {
            return [0.0; D];
        };
        let axis = (1..D).filter(|d| usize::from(number) > d * usize::from(robots) / D).count();
        let sign = if number.is_multiple_of(2) { 1.0 } else { -1.0 };
        let toward: Vector<D> =
            core::array::from_fn(|d| if d == axis { sign * 100.0 - position[d] } else { -position[d] });
        let distance = length(&toward);
        if distance > 0.0 { toward.map(|component| component / distance) } else { [0.0; D] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    //= paper sec:sim type=test
    #[test]
    fn the_papers_eleven_robots_go_four_ways() {
        let way = |number| Motion::Paper.desired(number, 11, &[0.0, 0.0]);
        assert_eq!(way(1), [-1.0, 0.0]);
        assert_eq!(way(4), [1.0, 0.0]);
        assert_eq!(way(5), [-1.0, 0.0]);
        assert_eq!(way(6), [0.0, 1.0]);
        assert_eq!(way(11), [0.0, -1.0]);
    }

    #[test]
    fn in_three_dimensions_six_ways() {
        let way = |number| Motion::Paper.desired(number, 12, &[0.0, 0.0, 0.0]);
        assert_eq!(way(4), [1.0, 0.0, 0.0]);
        assert_eq!(way(5), [0.0, -1.0, 0.0]);
        assert_eq!(way(9), [0.0, 0.0, -1.0]);
    }

    #[test]
    fn the_goal_itself_and_holding_ask_for_nothing() {
        assert_eq!(Motion::Paper.desired(2, 11, &[100.0, 0.0]), [0.0, 0.0]);
        assert_eq!(Motion::Hold.desired(2, 11, &[1.0, 0.0]), [0.0, 0.0]);
    }
}
