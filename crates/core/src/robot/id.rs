//! The name of a robot.

/// Number of a robot in its team; the paper counts from 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RobotId(pub u16);
