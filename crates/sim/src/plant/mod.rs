//! How the bodies of robots follow the velocities that they are given. The world owns the bodies, whatever engine computes
//! the robots; one file a plant.
//!
//! A new plant is a file beside this one, a variant of [`Plant`] with what a scenario says of it, and a variant of [`Bodies`].

pub mod double;
pub mod lag;
pub mod single;
pub mod unicycle;

use closeranks_core::num::{Vector, length, subtract};

use crate::parse::common::{DELAY, POSITIVE};
use crate::parse::reader::{Reader, Section};
use crate::plant::lag::Lag;
use crate::plant::single::Single;
use crate::plant::unicycle::Unicycle;

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
    /// A double integrator: its acceleration is limited.
    Double {
        /// The limit, m/s².
        acceleration_max_m_s2: f64,
        /// The greatest speed that it can be asked for, m/s.
        speed_max_m_s: f64,
    },
    /// A body that drives along its heading and turns, steered by a point ahead of it; in the plane.
    Unicycle {
        /// How far ahead the point is, m.
        look_ahead_m: f64,
    },
}

impl Plant {
    /// Reads the fields of the table `plant` of a scenario text that are about the plant.
    /// Robots can be asked for at most `speed_max_m_s`.
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, speed_max_m_s: f64) -> Self {
        let lag_s = reader.number_or(section, "lag_s", DELAY, 0.0);
        let acceleration = reader.number(section, "acceleration_max_m_s2", POSITIVE);
        let look_ahead = reader.number(section, "look_ahead_m", POSITIVE);
        let given = [lag_s > 0.0, acceleration.is_some(), look_ahead.is_some()];
        if given.into_iter().filter(|given| *given).count() > 1 {
            let allowed = "one of lag_s, acceleration_max_m_s2 and look_ahead_m";
            reader.refuse("plant", "more than one kind of body", allowed);
        }
        match (acceleration, look_ahead) {
            (Some(acceleration_max_m_s2), _) => Self::Double { acceleration_max_m_s2, speed_max_m_s },
            (None, Some(look_ahead_m)) => Self::Unicycle { look_ahead_m },
            (None, None) if lag_s > 0.0 => Self::Lag { lag_s },
            (None, None) => Self::Single,
        }
    }

    /// True if a robot is always where its velocities take it. Only then may robots whose controller guarantees something be
    /// computed all at once.
    #[must_use]
    pub fn follows(self) -> bool {
        match self {
            Self::Single | Self::Unicycle { .. } => true,
            Self::Lag { .. } | Self::Double { .. } => false,
        }
    }

    /// The bound of the tracking error that follows from what it is, m, if one does.
    #[must_use]
    pub fn tracking_error_m(self) -> Option<f64> {
        match self {
            Self::Double { acceleration_max_m_s2, speed_max_m_s } => {
                Some(double::tracking_error_m(acceleration_max_m_s2, speed_max_m_s))
            }
            Self::Single | Self::Unicycle { .. } | Self::Lag { .. } => None,
        }
    }
}

/// The bodies of all robots in a run.
#[derive(Clone, Debug)]
pub enum Bodies<const D: usize> {
    /// Bodies that move as they are told.
    Single(Single),
    /// Bodies that lag.
    Lag(Lag<D>),
    /// Bodies with a heading.
    Unicycle(Unicycle<D>),
}

impl<const D: usize> Bodies<D> {
    /// Bodies at rest at `positions_m`, to be moved in steps of `tick_s`.
    #[must_use]
    pub fn new(plant: Plant, tick_s: f64, positions_m: &[Vector<D>]) -> Self {
        let lagging = |lag: Option<Lag<D>>| lag.map_or_else(|| Self::Single(Single::new(tick_s)), Self::Lag);
        match plant {
            Plant::Single => Self::Single(Single::new(tick_s)),
            Plant::Lag { lag_s } => lagging(Lag::new(lag_s, tick_s, positions_m)),
            Plant::Double { acceleration_max_m_s2, speed_max_m_s } => {
                let lag_s = double::lag_s(acceleration_max_m_s2, speed_max_m_s);
                lagging(double::bodies(lag_s, tick_s, positions_m))
            }
            Plant::Unicycle { look_ahead_m } => {
                Self::Unicycle(Unicycle::new(look_ahead_m, tick_s, positions_m.len()))
            }
        }
    }

    /// Moves everybody by a tick in which each is given its velocity.
    pub fn integrate(&mut self, positions_m: &mut [Vector<D>], velocities_m_s: &[Vector<D>]) {
        match self {
            Self::Single(single) => single.integrate(positions_m, velocities_m_s),
            Self::Lag(lag) => lag.integrate(positions_m, velocities_m_s),
            Self::Unicycle(unicycle) => unicycle.integrate(positions_m, velocities_m_s),
        }
    }

    /// Puts the body of robot `index`, which comes, at rest at `place_m`.
    pub(crate) fn place(&mut self, index: usize, place_m: &Vector<D>) {
        match self {
            Self::Single(_) => {}
            Self::Lag(lag) => lag.place(index, place_m),
            Self::Unicycle(unicycle) => unicycle.place(index),
        }
    }

    /// Where the velocities alone would have taken each robot, m, when they are at `positions_m`.
    #[must_use]
    pub fn references_m<'a>(&'a self, positions_m: &'a [Vector<D>]) -> &'a [Vector<D>] {
        match self {
            Self::Single(_) | Self::Unicycle(_) => positions_m,
            Self::Lag(lag) => lag.references_m(),
        }
    }

    /// Greatest distance of a robot from its reference, m, when they are at `positions_m`.
    #[must_use]
    pub fn away_m(&self, positions_m: &[Vector<D>]) -> f64 {
        let Self::Lag(lag) = self else { return 0.0 };
        let pairs = lag.references_m().iter().zip(positions_m);
        pairs.map(|(reference, position)| length(&subtract(reference, position))).fold(0.0, f64::max)
    }

    /// Where the bodies are, m, when what is steered is at `positions_m`: the axles of unicycles, else the same.
    #[must_use]
    pub fn axles_m(&self, positions_m: &[Vector<D>]) -> Vec<Vector<D>> {
        match self {
            Self::Unicycle(unicycle) => unicycle.axles_m(positions_m),
            Self::Single(_) | Self::Lag(_) => positions_m.to_vec(),
        }
    }
}
