//! What became of those who came and went in a run.

/// What became of those who came and went.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Attendance {
    /// How often a robot left.
    pub left: u32,
    /// How often a robot came.
    pub arrived: u32,
    /// In how many ticks a robot that was to come was refused, and waited.
    pub refused: u32,
    /// The first time that happened: the tick, the robot, and why.
    pub first: Option<(u32, u16, Refused)>,
}

/// Why a robot does not come in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refused {
    /// Its place is nearer to another robot than two robots may be.
    Robot {
        /// Which other robot.
        other: u16,
        /// How far away that is, m.
        distance_m: f64,
        /// How far away it must be, m.
        needed_m: f64,
    },
    /// Its place is nearer to a robot of another team than two robots may be.
    Stranger {
        /// How far away that is, m.
        distance_m: f64,
        /// How far away it must be, m.
        needed_m: f64,
    },
    /// Its place is nearer to an obstacle than a robot may be.
    Obstacle {
        /// How far away that is, m.
        distance_m: f64,
        /// How far away it must be, m.
        needed_m: f64,
    },
    /// No place was found within range of anybody.
    NoPlace,
}

impl core::fmt::Display for Refused {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Robot { other, distance_m, needed_m } => {
                write!(
                    f,
                    "robot {other} was {distance_m:.4} m from its place, allowed is {needed_m:.4} m or more"
                )
            }
            Self::Stranger { distance_m, needed_m } => {
                write!(
                    f,
                    "a robot of another team was {distance_m:.4} m from its place, allowed is {needed_m:.4} m or more"
                )
            }
            Self::Obstacle { distance_m, needed_m } => {
                write!(
                    f,
                    "an obstacle was {distance_m:.4} m from its place, allowed is {needed_m:.4} m or more"
                )
            }
            Self::NoPlace => f.write_str("no place was found within range of anybody"),
        }
    }
}
