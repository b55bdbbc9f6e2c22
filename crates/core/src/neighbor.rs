//! What a robot holds about one neighbour, in memory that its owner lends.

use core::time::Duration;

use crate::composed::Term;
use crate::link::Link;
use crate::math::Vector;
use crate::scaled::Scaled;
use crate::time::Instant;

/// Number of a robot in its team; the paper counts from 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RobotId(pub u16);

/// What a neighbour told, and when it was received.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Told {
    pub(crate) sequence: u32,
    pub(crate) level: f64,
    /// Ê_j of that level.
    pub(crate) term: Scaled,
    pub(crate) at: Instant,
    /// y_j of the consensus round that is on, if told.
    pub(crate) value: Option<f64>,
}

/// Memory for one neighbour. The owner of a [`Robot`](crate::robot::Robot) lends a slice of these, one for each
/// neighbour it wants to be able to have.
#[derive(Clone, Copy, Debug)]
pub struct Slot<const D: usize> {
    pub(crate) id: RobotId,
    /// Sensed in this tick.
    pub(crate) sensed: bool,
    pub(crate) offset_m: Vector<D>,
    pub(crate) link: Link,
    pub(crate) collision: Scaled,
    pub(crate) told: Option<Told>,
    pub(crate) discarded: bool,
}

impl<const D: usize> Default for Slot<D> {
    fn default() -> Self {
        Self {
            id: RobotId(0),
            sensed: false,
            offset_m: [0.0; D],
            link: Link { weight: 0.0, slope: Scaled::ZERO },
            collision: Scaled::ZERO,
            told: None,
            discarded: false,
        }
    }
}

impl<const D: usize> Slot<D> {
    /// Whose slot this is.
    #[must_use]
    pub fn id(&self) -> RobotId {
        self.id
    }

    /// x_i − x_j, m, as sensed.
    #[must_use]
    pub fn offset_m(&self) -> Vector<D> {
        self.offset_m
    }

    /// The link to it.
    #[must_use]
    pub fn link(&self) -> Link {
        self.link
    }

    /// The level it last told, if any.
    #[must_use]
    pub fn told_level(&self) -> Option<f64> {
        self.told.map(|told| told.level)
    }

    /// How old that is at `now`.
    #[must_use]
    pub fn told_age(&self, now: Instant) -> Option<Duration> {
        self.told.map(|told| now.since(told.at))
    }

    /// True if W-MSR discarded its value in the last consensus round.
    #[must_use]
    pub fn discarded(&self) -> bool {
        self.discarded
    }

    pub(crate) fn term(&self) -> Term<D> {
        Term {
            offset_m: self.offset_m,
            link: self.link,
            collision: self.collision,
            told: self.told.map_or(Scaled::ZERO, |told| told.term),
        }
    }
}
