//! The name of a robot.

/// Number of a robot in its team; the paper counts from 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RobotId(pub u16);

/// A robot as the roster has it: its number and its rank. Without ranks all have rank 0, and nobody asks for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Member {
    /// Its number.
    pub id: RobotId,
    /// Its rank ([`Ranks`](crate::need::Ranks)).
    pub rank: u16,
}

impl From<RobotId> for Member {
    fn from(id: RobotId) -> Self {
        Self { id, rank: 0 }
    }
}
