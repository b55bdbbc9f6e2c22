//! What goes wrong between robots and world, as data. All of it wraps the network, the sensors or the plant: a robot never
//! knows.

pub mod clocks;
pub mod network;
pub mod plant;
pub mod sensing;

pub use clocks::Clocks;
pub use network::Network;
pub use plant::Plant;
pub use sensing::Sensing;

/// Everything that can go wrong. The default is a perfect world.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    /// Messages.
    pub network: Network,
    /// The robots' own clocks.
    pub clocks: Clocks,
    /// What robots sense of positions.
    pub sensing: Sensing,
    /// What becomes of velocities.
    pub plant: Plant,
}

impl Faults {
    /// True for a perfect world.
    #[must_use]
    pub fn none(&self) -> bool {
        *self == Self::default()
    }
}

/// A stretch of time in which something is wrong with one robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spell {
    /// Which, from 1.
    pub robot: u16,
    /// From when, s.
    pub from_s: f64,
    /// Until when, s, not included.
    pub to_s: f64,
}

impl Spell {
    /// True while it lasts.
    #[must_use]
    pub fn lasts(&self, time_s: f64) -> bool {
        self.from_s <= time_s && time_s < self.to_s
    }

    /// Index of its robot.
    #[must_use]
    pub fn index(&self) -> usize {
        usize::from(self.robot).saturating_sub(1)
    }
}
