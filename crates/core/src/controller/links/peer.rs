//! What a robot holds of one neighbour, and of its own messages, from tick to tick.

use core::time::Duration;

use crate::controller::links::deal::{Deal, Look};
use crate::controller::links::protocol::{Hold, Number, Numbers};
use crate::controller::links::wire::{Head, Item, Notice};
use crate::id::RobotId;
use crate::num::Vector;
use crate::time::Instant;

/// What a robot holds of one neighbour.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "four facts, each with its own life")]
pub struct Peer<const D: usize> {
    /// Who lists whom, and what was acknowledged.
    pub(crate) hold: Hold,
    /// True while the neighbour is counted on, once it was certainly within the held radius.
    pub(crate) held: bool,
    /// Ticks since the neighbour was last sensed; 0 if it is sensed now.
    pub(crate) unseen_ticks: u32,
    /// True if it was not sensed first in a tick in which it must still have been within R.
    pub(crate) vanished: bool,
    /// True if it is not sensed and must still be within R: it cannot have gone so far since.
    pub(crate) inside: bool,
    /// What the newest message says to all, and whether it promises a release.
    pub(crate) told: Option<Told<D>>,
    /// True if the robot promises it a release.
    pub(crate) promised: bool,
    /// What was agreed on with it, and what came of the look at it in this tick.
    pub(crate) deal: Deal,
    pub(crate) look: Look,
}

/// What the newest message of a neighbour says besides lists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Told<const D: usize> {
    pub(crate) head: Head<D>,
    pub(crate) promised: bool,
    /// When it was received, by the own clock.
    pub(crate) at: Instant,
}

impl<const D: usize> Peer<D> {
    /// Nothing is known of a neighbour; `last` is the number of the robot's own newest message.
    #[must_use]
    pub(crate) fn new(last: Number) -> Self {
        Self {
            hold: Hold::new(last),
            held: false,
            unseen_ticks: 0,
            vanished: false,
            inside: false,
            told: None,
            promised: false,
            deal: Deal::default(),
            look: Look::default(),
        }
    }

    /// Takes what a message says. False if it is not newer than the newest one.
    /// `last` is the number of the robot's own newest message.
    pub(crate) fn hear(&mut self, notice: &Notice<D>, last: Number, now: Instant) -> bool {
        let newer = self.hold.hear(notice.word, last);
        if newer {
            self.told = Some(Told { head: notice.head, promised: notice.promised, at: now });
        }
        newer
    }

    /// What it told at most `age_max` before `now`, if anything.
    pub(crate) fn told_within(&self, now: Instant, age_max: Duration) -> Option<&Told<D>> {
        self.told.as_ref().filter(|told| now.is_within(age_max, told.at))
    }

    /// True if it is counted on and within the held radius.
    pub(crate) fn is_counted(&self) -> bool {
        self.held && self.hold.counts()
    }

    /// What is told of the neighbour `id`.
    pub(crate) fn item(&self, id: RobotId) -> Item {
        Item { id, entry: self.hold.entry(), promised: self.promised }
    }
}

/// What a robot holds of its own messages.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger<const D: usize> {
    pub(crate) numbers: Numbers,
    /// The head of the newest message.
    pub(crate) head: Option<Head<D>>,
    /// Where it wants to go, m/s, as it was told last.
    pub(crate) wish_m_s: Vector<D>,
    /// What it tells of the price of a promise, m.
    pub(crate) price_m: f64,
    /// True if it keeps its row for every neighbour, whatever was agreed.
    pub(crate) obliged: bool,
    /// When it last looked at its list; `None` before the first time.
    pub(crate) looked_at: Option<Instant>,
}

impl<const D: usize> Ledger<D> {
    /// A life that begins after all messages with numbers up to `before`.
    #[must_use]
    pub(crate) fn begin(before: Number) -> Self {
        let numbers = Numbers::begin(before);
        Self {
            numbers,
            head: None,
            wish_m_s: [0.0; D],
            price_m: f64::INFINITY,
            obliged: false,
            looked_at: None,
        }
    }

    /// The head of the message that is sent at `now`; `None` at the end of all numbers.
    pub(crate) fn head(&mut self, now: Instant, value: Option<f64>) -> Option<Head<D>> {
        let number = self.numbers.next(Number(now.as_nanos()))?;
        self.head = Some(Head { number, value, price_m: self.price_m, wish_m_s: self.wish_m_s });
        self.head
    }
}
