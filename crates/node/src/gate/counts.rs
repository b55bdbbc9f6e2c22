//! What was rejected, by sender and reason.

use closeranks_core::RobotId;

/// Why an envelope was not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reject {
    /// It has not the form of an envelope, or is for another purpose.
    Form,
    /// It is of another team, or of one with another roster.
    Roster,
    /// No such sender is in the roster, or it is the robot itself.
    Sender,
    /// The sender is proved two-faced, or is not to be believed by an operator's word.
    Distrusted,
    /// It is of an earlier start of its sender.
    Epoch,
    /// It came before, or a newer one did.
    Replay,
    /// It was sent later than now: the clocks differ by more than is stated.
    Future,
    /// It was sent too long ago, or the clocks differ.
    Old,
    /// Its sender sends too many.
    Flood,
    /// Its sender did not sign it.
    Signature,
    /// Its sender signed another one with the same number.
    TwoFaced,
    /// What is in it is not what should be.
    Payload,
}

impl Reject {
    /// All reasons, in their order.
    pub const ALL: [Self; 12] = [
        Self::Form,
        Self::Roster,
        Self::Sender,
        Self::Distrusted,
        Self::Epoch,
        Self::Replay,
        Self::Future,
        Self::Old,
        Self::Flood,
        Self::Signature,
        Self::TwoFaced,
        Self::Payload,
    ];

    /// Its name in tables and reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Form => "form",
            Self::Roster => "roster",
            Self::Sender => "sender",
            Self::Distrusted => "distrusted",
            Self::Epoch => "epoch",
            Self::Replay => "replay",
            Self::Future => "future",
            Self::Old => "old",
            Self::Flood => "flood",
            Self::Signature => "signature",
            Self::TwoFaced => "two-faced",
            Self::Payload => "payload",
        }
    }
}

/// Counters for each sender. What has no known sender is counted under number 0. They stop at their greatest number.
#[derive(Clone, Debug)]
pub struct Counts {
    rows: Vec<[u32; Reject::ALL.len()]>,
}

impl Counts {
    pub(crate) fn new(senders: usize) -> Self {
        Self { rows: vec![[0; Reject::ALL.len()]; senders.max(1)] }
    }

    pub(crate) fn add(&mut self, id: Option<RobotId>, reject: Reject) {
        let index = id.map_or(0, |id| usize::from(id.0));
        let index = if index < self.rows.len() { index } else { 0 };
        let count = &mut self.rows[index][reject as usize];
        *count = count.saturating_add(1);
    }

    /// How many envelopes under the name of a sender were rejected for this reason.
    #[must_use]
    pub fn of(&self, id: RobotId, reject: Reject) -> u32 {
        self.rows.get(usize::from(id.0)).map_or(0, |row| row[reject as usize])
    }

    /// How many were rejected for this reason.
    #[must_use]
    pub fn total(&self, reject: Reject) -> u32 {
        self.rows.iter().fold(0, |sum, row| sum.saturating_add(row[reject as usize]))
    }
}
