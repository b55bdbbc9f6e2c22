//! What stands between the network and a robot: every check, in the order of its price, and what is kept to find those who
//! tell two robots two things.
//!
//! The order is length and form, purpose and roster, sender, trust, number, age, rate, and the signature last: what costs
//! 0.1 ms is done for at most [`Limits::per_s`] envelopes a sender and second. A gate is a pure state machine; its memory is
//! bounded by the number of robots.

mod bucket;
mod counts;
mod history;

use std::sync::Arc;

use closeranks_core::{Instant, RobotId};
use core::time::Duration;
use ed25519_dalek::VerifyingKey;

pub use crate::gate::counts::{Counts, Reject};

use crate::gate::bucket::Bucket;
use crate::gate::history::History;
use crate::identity::roster::Roster;
use crate::wire::envelope::{ECHOES_MAX, Echo, Envelope, Purpose};
use crate::wire::proof::Proof;

/// How much a gate takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// How many envelopes of one sender are looked at in a second, on average.
    pub per_s: f64,
    /// How many of them may come at once.
    pub burst: f64,
    /// An envelope that was sent longer ago is not used.
    pub age_max: Duration,
    /// An envelope that was sent later than now by more than this is not used: the clocks differ.
    pub ahead_max: Duration,
}

/// One sender as the gate knows it.
#[derive(Clone, Debug)]
struct Sender {
    /// Epoch and sequence of its newest envelope.
    last: Option<(u64, u64)>,
    bucket: Bucket,
    /// How many signatures are checked of what others say it sent.
    evidence: Bucket,
    history: History,
    /// What is said of it from outside.
    trusted: bool,
    /// Whether a proof says that it is two-faced. Nobody's word takes that back.
    proved: bool,
}

impl Sender {
    fn is_believed(&self) -> bool {
        self.trusted && !self.proved
    }
}

/// Takes envelopes of one purpose.
#[derive(Clone, Debug)]
pub struct Gate {
    roster: Arc<Roster>,
    purpose: Purpose,
    own: Option<RobotId>,
    limits: Limits,
    senders: Vec<Sender>,
    counts: Counts,
    /// The sender whose echo is due next.
    next_echo: usize,
    proofs: Vec<Proof>,
}

impl Gate {
    /// A gate for envelopes of this `purpose` to robot `own`, or to somebody who is no robot.
    #[must_use]
    pub fn new(roster: Arc<Roster>, purpose: Purpose, own: Option<RobotId>, limits: Limits) -> Self {
        let sender = Sender {
            last: None,
            bucket: Bucket::new(limits.per_s, limits.burst),
            evidence: Bucket::new(1.0, 4.0),
            history: History::default(),
            trusted: true,
            proved: false,
        };
        let count = roster.robots().len() + 1;
        Self {
            roster,
            purpose,
            own,
            limits,
            senders: vec![sender; count],
            counts: Counts::new(count),
            next_echo: 0,
            proofs: Vec::new(),
        }
    }

    /// Takes an envelope that arrived at `now`, or says why not. Every rejection is counted.
    pub fn take<'a>(&mut self, now: Instant, bytes: &'a [u8]) -> Result<Envelope<'a>, Reject> {
        let envelope = Envelope::parse(bytes);
        let taken = envelope.ok_or(Reject::Form).and_then(|envelope| self.check(now, &envelope));
        if let Err(reject) = taken {
            self.counts.add(envelope.map(|envelope| envelope.id), reject);
        }
        taken?;
        envelope.ok_or(Reject::Form)
    }

    fn check(&mut self, now: Instant, envelope: &Envelope<'_>) -> Result<(), Reject> {
        let key = self.sender(envelope)?;
        let (number, limits) = ((envelope.epoch, envelope.sequence), self.limits);
        let index = usize::from(envelope.id.0);
        let sender = &mut self.senders[index];
        if !sender.is_believed() {
            return Err(Reject::Distrusted);
        }
        let known = sender.last.is_some_and(|last| number <= last);
        let two_faced = known && sender.history.differs(number, envelope.bytes());
        if known && !two_faced {
            let older = sender.last.is_some_and(|(epoch, _)| envelope.epoch < epoch);
            return Err(if older { Reject::Epoch } else { Reject::Replay });
        }
        if envelope.sent > now.after(limits.ahead_max) {
            return Err(Reject::Future);
        }
        if now.since(envelope.sent) > limits.age_max {
            return Err(Reject::Old);
        }
        if !sender.bucket.take(now) {
            return Err(Reject::Flood);
        }
        if !envelope.is_signed_by(self.roster.hash(), &key) {
            return Err(Reject::Signature);
        }
        if two_faced {
            if self.purpose != Purpose::Sensed {
                self.convict(envelope);
            }
            return Err(Reject::TwoFaced);
        }
        let sender = &mut self.senders[index];
        sender.last = Some(number);
        sender.history.push(number, envelope.bytes());
        Ok(())
    }

    /// The key of the sender, if the envelope may come here at all.
    fn sender(&self, envelope: &Envelope<'_>) -> Result<VerifyingKey, Reject> {
        if envelope.purpose != self.purpose {
            return Err(Reject::Form);
        }
        if self.roster.hash()[..8] != envelope.roster {
            return Err(Reject::Roster);
        }
        // The plant writes to the robot itself, and robots to all others.
        let plant = self.purpose == Purpose::Sensed;
        let key = if plant { self.roster.plant() } else { self.roster.key(envelope.id) };
        key.filter(|_| plant == (self.own == Some(envelope.id))).copied().ok_or(Reject::Sender)
    }

    /// Keeps the proof that the sender has two faces, and believes it nothing any more.
    fn convict(&mut self, envelope: &Envelope<'_>) {
        let sender = &mut self.senders[usize::from(envelope.id.0)];
        let number = (envelope.epoch, envelope.sequence);
        let Some(kept) = sender.history.get(number) else { return };
        self.proofs.push(Proof { first: kept.to_vec(), second: envelope.bytes().to_vec() });
        sender.proved = true;
    }

    /// Looks at an envelope that another robot says it was sent. It is used for nothing but a proof.
    pub fn evidence(&mut self, now: Instant, bytes: &[u8]) -> Result<(), Reject> {
        let envelope = Envelope::parse(bytes).ok_or(Reject::Form)?;
        let key = self.sender(&envelope)?;
        let sender = &mut self.senders[usize::from(envelope.id.0)];
        let differs = sender.history.differs((envelope.epoch, envelope.sequence), bytes);
        if !sender.is_believed() || !differs {
            return Err(Reject::Replay);
        }
        if !sender.evidence.take(now) {
            return Err(Reject::Flood);
        }
        if !envelope.is_signed_by(self.roster.hash(), &key) {
            return Err(Reject::Signature);
        }
        self.convict(&envelope);
        Ok(())
    }

    /// Takes a proof that somebody else found; an error if it proves nothing, or nothing new.
    pub fn proof(&mut self, now: Instant, bytes: &[u8]) -> Result<RobotId, Reject> {
        let proof = Proof::parse(bytes).map_err(|_| Reject::Form)?;
        let id = Envelope::parse(&proof.first).map(|envelope| envelope.id).ok_or(Reject::Form)?;
        let sender = self.senders.get_mut(usize::from(id.0)).ok_or(Reject::Sender)?;
        if !sender.is_believed() {
            return Err(Reject::Replay);
        }
        if !sender.evidence.take(now) {
            return Err(Reject::Flood);
        }
        let id = proof.verify(&self.roster).map_err(|_| Reject::Signature)?;
        let sender = &mut self.senders[usize::from(id.0)];
        sender.proved = true;
        self.proofs.push(proof);
        Ok(id)
    }

    /// Own copies of what the sender of `envelope` has heard otherwise. Published, they let it, or whoever has its copy,
    /// prove who is two-faced; an echo alone proves nothing, since it may be a lie.
    pub fn contradictions(&mut self, now: Instant, envelope: &Envelope<'_>) -> Vec<Vec<u8>> {
        let mut found = Vec::new();
        for echo in envelope.echoes() {
            let Some(sender) = self.senders.get_mut(usize::from(echo.id.0)) else { continue };
            let Some((bytes, hash)) = sender.history.hashed((echo.epoch, echo.sequence)) else { continue };
            if sender.is_believed() && hash != echo.hash && sender.evidence.take(now) {
                found.push(bytes.to_vec());
            }
        }
        found
    }

    /// What to say of the newest envelopes that came: up to `most` senders, each in its turn.
    pub fn echoes(&mut self, most: usize) -> Vec<Echo> {
        let count = self.senders.len();
        let mut echoes = Vec::new();
        for _ in 0..count {
            if echoes.len() >= most.min(ECHOES_MAX) {
                break;
            }
            let index = self.next_echo % count;
            self.next_echo = index + 1;
            let (id, sender) = (RobotId(u16::try_from(index).unwrap_or(u16::MAX)), &self.senders[index]);
            let Some(number) = sender.last else { continue };
            if let Some((_, hash)) = sender.history.hashed(number) {
                echoes.push(Echo { id, epoch: number.0, sequence: number.1, hash });
            }
        }
        echoes
    }

    /// Proofs since the last call.
    pub fn take_proofs(&mut self) -> Vec<Proof> {
        core::mem::take(&mut self.proofs)
    }

    /// Counts what passed the gate and was refused behind it.
    pub fn reject(&mut self, id: RobotId, reject: Reject) {
        self.counts.add(Some(id), reject);
    }

    /// What was rejected, and why.
    #[must_use]
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// The number of starts of a sender, as far as it was heard.
    #[must_use]
    pub fn epoch(&self, id: RobotId) -> Option<u64> {
        self.senders.get(usize::from(id.0))?.last.map(|(epoch, _)| epoch)
    }

    /// Whether a robot is believed.
    #[must_use]
    pub fn trusts(&self, id: RobotId) -> bool {
        self.senders.get(usize::from(id.0)).is_some_and(Sender::is_believed)
    }

    /// Says from outside whether a robot is to be believed. Who is proved two-faced never is.
    pub fn trust(&mut self, id: RobotId, trusted: bool) {
        if let Some(sender) = self.senders.get_mut(usize::from(id.0)) {
            sender.trusted = trusted;
        }
    }

    /// Takes another roster with as many robots. A sender with another key than before begins without a history; a word against it stays,
    /// and what was proved against the old key does not.
    pub fn renew(&mut self, roster: &Arc<Roster>) {
        for (index, sender) in (0..).zip(&mut self.senders) {
            let id = RobotId(index);
            if roster.key(id) != self.roster.key(id) {
                (sender.last, sender.history) = (None, History::default());
                sender.proved = false;
            }
        }
        self.roster = Arc::clone(roster);
    }
}

#[cfg(test)]
mod tests;
