//! What a robot holds about one neighbour, in memory that its owner lends.

use crate::controller::links::cut::Room;
use crate::controller::links::peer::Peer;
use crate::controller::links::protocol::Number;
use crate::equations::link::Link;
pub use crate::id::{Member, RobotId};
use crate::num::Vector;
use crate::time::Instant;

/// Stands for the link to a robot that is out of range.
pub(crate) const NO_LINK: Link<f64> = Link { weight: 0.0, slope: 0.0 };

/// What a neighbour told, and when it was received.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Told {
    pub(crate) sequence: u32,
    /// When it was told, by its sender's clock.
    pub(crate) stamp: Instant,
    pub(crate) level: Option<f64>,
    /// When the message was received, by the own clock.
    pub(crate) at: Instant,
    /// y_j of the consensus round that is on, if it was told.
    pub(crate) value: Option<f64>,
}

/// Memory for one neighbour. The owner of a [`Robot`](crate::robot::Robot) lends a slice of these, one for each
/// neighbour it wants to be able to have.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "four facts, each with its own life")]
pub struct Slot<const D: usize> {
    pub(crate) id: RobotId,
    pub(crate) rank: u16,
    /// True if it was sensed in this tick.
    pub(crate) sensed: bool,
    /// True if it was sensed in the tick before and not yet in this one.
    pub(crate) seen_before: bool,
    pub(crate) offset_m: Vector<D>,
    /// Where it was sensed, m, when, and how far it can have gone since, m.
    pub(crate) position_m: Vector<D>,
    pub(crate) sensed_at: Instant,
    pub(crate) gone_m: f64,
    /// How far it can have gone if it is missing, m. For all others it is 0.
    pub(crate) unsensed_m: f64,
    pub(crate) link: Link<f64>,
    /// True if it is within R as sensed. It is false for a robot that only the margin of `budget` brings into view.
    pub(crate) linked: bool,
    pub(crate) told: Option<Told>,
    pub(crate) discarded: bool,
    /// What `links` holds of it.
    pub(crate) peer: Peer<D>,
    /// How much room the link to it has beside what would cut it, under `links`.
    pub(crate) room: Room,
}

impl<const D: usize> Default for Slot<D> {
    fn default() -> Self {
        Self {
            id: RobotId(0),
            rank: 0,
            sensed: false,
            seen_before: false,
            offset_m: [0.0; D],
            position_m: [0.0; D],
            sensed_at: Instant::START,
            gone_m: 0.0,
            unsensed_m: 0.0,
            link: NO_LINK,
            linked: false,
            told: None,
            discarded: false,
            peer: Peer::new(Number::NONE),
            room: Room::OPEN,
        }
    }
}

impl<const D: usize> Slot<D> {
    /// Whose slot this is.
    #[must_use]
    pub fn id(&self) -> RobotId {
        self.id
    }

    /// Whose slot this is, with the rank with which it was observed.
    #[must_use]
    pub fn member(&self) -> Member {
        Member { id: self.id, rank: self.rank }
    }

    /// True if it was sensed in this tick.
    #[must_use]
    pub fn is_sensed(&self) -> bool {
        self.sensed
    }

    /// True if it was not sensed in this tick, but must still be within R ([`missing`](crate::robot::missing)).
    #[must_use]
    pub fn is_missing(&self) -> bool {
        self.unsensed_m > 0.0
    }

    /// x_i − x_j, m, as sensed; of a missing neighbour with x_j where it was last sensed.
    #[must_use]
    pub fn offset_m(&self) -> Vector<D> {
        self.offset_m
    }

    /// The link to it.
    #[must_use]
    pub fn link(&self) -> Link<f64> {
        self.link
    }

    /// The level that it told last, if any.
    #[must_use]
    pub fn told_level(&self) -> Option<f64> {
        self.told.and_then(|told| told.level)
    }

    /// The value it told in the consensus round that is on, if any.
    #[must_use]
    pub fn told_value(&self) -> Option<f64> {
        self.told.and_then(|told| told.value)
    }

    /// True if `links` lists it.
    #[must_use]
    pub fn is_listed(&self) -> bool {
        self.peer.hold.is_listed()
    }

    /// True if W-MSR discarded its value in the last consensus round.
    #[must_use]
    pub fn discarded(&self) -> bool {
        self.discarded
    }
}
