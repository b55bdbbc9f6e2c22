//! How the bodies of robots follow the velocities that they are given. The world owns the bodies, whatever engine computes
//! the robots; one file a plant.
//!
//! A new plant is a file beside this one, a variant of [`Plant`] with what a scenario says of it, and a variant of [`Bodies`].

pub mod lag;
pub mod single;

use closeranks_core::num::{Vector, length, subtract};

use crate::parse::common::DELAY;
use crate::parse::reader::{Reader, Section};
use crate::plant::lag::Lag;
use crate::plant::single::Single;

/// What moves a robot, as a scenario says it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Plant {
    /// The velocity itself: the paper's robots (eq:dynamics).
    #[default]
    Single,
    /// A velocity that follows the one that was asked for, by a first-order lag.
    Lag {
        /// Time constant, s, positive.
        lag_s: f64,
    },
}

impl Plant {
    /// Reads the fields of the table `plant` of a scenario text that are about the plant.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>) -> Self {
        let lag_s = reader.number_or(section, "lag_s", DELAY, 0.0);
        if lag_s > 0.0 { Self::Lag { lag_s } } else { Self::Single }
    }
}

/// The bodies of all robots in a run.
#[derive(Clone, Debug)]
pub enum Bodies<const D: usize> {
    /// Bodies that move as they are told.
    Single(Single),
    /// Bodies that lag.
    Lag(Lag<D>),
}

impl<const D: usize> Bodies<D> {
    /// Bodies at rest at `positions_m`, to be moved in steps of `tick_s`.
    #[must_use]
    pub fn new(plant: Plant, tick_s: f64, positions_m: &[Vector<D>]) -> Self {
        match plant {
            Plant::Single => Self::Single(Single::new(tick_s)),
            Plant::Lag { lag_s } => Lag::new(lag_s, tick_s, positions_m)
                .map_or_else(|| Self::Single(Single::new(tick_s)), Self::Lag),
        }
    }

    /// Moves everybody by a tick in which each is given its velocity.
    pub fn integrate(&mut self, positions_m: &mut [Vector<D>], velocities_m_s: &[Vector<D>]) {
        match self {
            Self::Single(single) => single.integrate(positions_m, velocities_m_s),
            Self::Lag(lag) => lag.integrate(positions_m, velocities_m_s),
        }
    }

    /// Where the velocities alone would have taken each robot, m, when they are at `positions_m`.
    #[must_use]
    pub fn references_m<'a>(&'a self, positions_m: &'a [Vector<D>]) -> &'a [Vector<D>] {
        match self {
            Self::Single(_) => positions_m,
            Self::Lag(lag) => lag.references_m(),
        }
    }

    /// Greatest distance of a robot from its reference, m, when they are at `positions_m`.
    #[must_use]
    pub fn away_m(&self, positions_m: &[Vector<D>]) -> f64 {
        let pairs = self.references_m(positions_m).iter().zip(positions_m);
        pairs.map(|(reference, position)| length(&subtract(reference, position))).fold(0.0, f64::max)
    }
}
