//! What goes wrong between robots and world. Each fault has one file with its data, its table in scenario files and its
//! player. All of them wrap the network, the clocks, the sensors or the robot itself: a robot never knows.

pub mod clocks;
pub mod dropouts;
pub mod edges;
pub mod network;
pub mod outages;
pub mod sensing;
pub mod sight;
pub mod spell;
mod ways;

pub use clocks::Clocks;
pub use network::Network;
pub use outages::Outages;
pub use sensing::Sensing;
pub use spell::Spell;

use crate::parse::reader::{Reader, Section};

/// Everything that can go wrong. The default is a perfect world.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    /// Messages.
    pub network: Network,
    /// The robots' own clocks.
    pub clocks: Clocks,
    /// What robots sense of positions.
    pub sensing: Sensing,
    /// When robots do not run.
    pub outages: Outages,
}

impl Faults {
    /// Reads the tables `network`, `clocks` and `sensing` of a scenario text for a team of so many robots. Outages are in the
    /// table `plant`.
    pub(crate) fn read(reader: &mut Reader, root: &mut Section<'_>, robots: u16) -> Self {
        Self {
            network: reader.table(root, "network", |reader, table| Network::read(reader, table, robots)),
            clocks: reader.table(root, "clocks", Clocks::read),
            sensing: reader.table(root, "sensing", |reader, table| Sensing::read(reader, table, robots)),
            outages: Outages::default(),
        }
    }

    /// True for a perfect world.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}
