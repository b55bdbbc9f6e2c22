//! From a pose to the point that is steered, and from a velocity of that point to one of the base.

use crate::ros::messages::{Pose, Twist};

/// How a base moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Base {
    /// In every direction: the point is the base itself.
    Holonomic,
    /// Forward and by turning. The point lies ahead of the axle by so many m, and moves in every direction. Bases may come nearer
    /// to each other than their points by twice that, so Δ_d must be larger by as much.
    Unicycle {
        /// How far ahead, m, positive.
        ahead_m: f64,
    },
}

impl Base {
    /// The point that is steered, m.
    #[must_use]
    pub fn point_m(self, pose: &Pose) -> [f64; 3] {
        let [x, y, z] = pose.position_m;
        match self {
            Self::Holonomic => pose.position_m,
            Self::Unicycle { ahead_m } => {
                let [cos, sin] = heading(pose);
                [x + ahead_m * cos, y + ahead_m * sin, z]
            }
        }
    }

    /// What the base is to do so that the point has this velocity of the world, m/s.
    #[must_use]
    pub fn twist(self, pose: &Pose, velocity_m_s: &[f64; 3]) -> Twist {
        let [cos, sin] = heading(pose);
        let [x, y, z] = *velocity_m_s;
        let (forward, left) = (x * cos + y * sin, y * cos - x * sin);
        match self {
            Self::Holonomic => Twist { linear_m_s: [forward, left, z], angular_rad_s: [0.0; 3] },
            Self::Unicycle { ahead_m } => {
                Twist { linear_m_s: [forward, 0.0, 0.0], angular_rad_s: [0.0, 0.0, left / ahead_m] }
            }
        }
    }
}

impl Base {
    /// The velocity of the point, in the world, m/s, when the base does this.
    #[must_use]
    pub fn velocity_m_s(self, pose: &Pose, twist: &Twist) -> [f64; 3] {
        let [cos, sin] = heading(pose);
        let [forward, mut left, up] = twist.linear_m_s;
        if let Self::Unicycle { ahead_m } = self {
            left = ahead_m * twist.angular_rad_s[2];
        }
        [forward * cos - left * sin, forward * sin + left * cos, up]
    }
}

/// Cosine and sine of the yaw. A pose that looks straight up or down counts as one that looks along x.
fn heading(pose: &Pose) -> [f64; 2] {
    let [x, y, z, w] = pose.orientation;
    let (cos, sin) = (1.0 - 2.0 * (y * y + z * z), 2.0 * (w * z + x * y));
    let length = (cos * cos + sin * sin).sqrt();
    if length > 1e-9 { [cos / length, sin / length] } else { [1.0, 0.0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NORTH: Pose = Pose {
        position_m: [1.0, 2.0, 0.0],
        orientation: [0.0, 0.0, core::f64::consts::FRAC_1_SQRT_2, core::f64::consts::FRAC_1_SQRT_2],
    };

    fn near(first: [f64; 3], second: [f64; 3]) -> bool {
        first.iter().zip(second).all(|(a, b)| (a - b).abs() < 1e-9)
    }

    #[test]
    fn a_base_that_looks_north_goes_east_to_its_right() {
        let twist = Base::Holonomic.twist(&NORTH, &[1.0, 0.0, 0.5]);
        assert!(near(twist.linear_m_s, [0.0, -1.0, 0.5]));
        let unicycle = Base::Unicycle { ahead_m: 0.1 };
        assert!(near(unicycle.point_m(&NORTH), [1.0, 2.1, 0.0]));
        let twist = unicycle.twist(&NORTH, &[1.0, 0.0, 0.0]);
        assert!(near(unicycle.velocity_m_s(&NORTH, &twist), [1.0, 0.0, 0.0]), "and back");
        assert!(near(twist.linear_m_s, [0.0; 3]) && near(twist.angular_rad_s, [0.0, 0.0, -10.0]));
    }

    /// The point moves as it is asked to, and the base stays behind it.
    #[test]
    fn the_point_of_a_unicycle_moves_as_it_is_told() {
        let base = Base::Unicycle { ahead_m: 0.1 };
        let (asked, step_s) = ([0.3, -0.2, 0.0], 1e-6);
        let Twist { linear_m_s: [forward, ..], angular_rad_s: [.., turn] } = base.twist(&NORTH, &asked);
        let [cos, sin] = heading(&NORTH);
        let [_, _, z, w] = NORTH.orientation;
        let half = 0.5 * turn * step_s;
        let after = Pose {
            position_m: [1.0 + step_s * forward * cos, 2.0 + step_s * forward * sin, 0.0],
            orientation: [0.0, 0.0, z + half * w, w - half * z],
        };
        let moved = [0, 1, 2].map(|axis| (base.point_m(&after)[axis] - base.point_m(&NORTH)[axis]) / step_s);
        assert!(moved.iter().zip(asked).all(|(seen, asked)| (seen - asked).abs() < 1e-4), "{moved:?}");
    }
}
