//! One robot with its identity, as a state machine: bytes and times in, bytes out.
//!
//! In every tick the owner calls [`Pilot::sense`] when something was sensed, seals and sends the message that it returns, calls
//! [`Pilot::hear`] with whatever arrives meanwhile, and [`Pilot::decide`] when it is time. None of them waits for anything.

use core::time::Duration;
use std::collections::BTreeMap;
use std::sync::Arc;

use closeranks_core::num::is_finite;
use closeranks_core::{
    InputBox, Instant, Message, Mode, Params, ReceiveError, Robot, RobotError, RobotId, Slot,
};
use closeranks_sim::engine::memory::Memory;
use ed25519_dalek::SigningKey;

use crate::gate::{Counts, Gate, Limits, Reject};
use crate::identity::roster::Roster;
use crate::node::status::{Scene, Status, Watch};
use crate::wire::envelope::{ECHOES_MAX, Echo, Envelope, Letter, PAYLOAD_MAX, Purpose};
use crate::wire::report::{Report, rejects};
use crate::wire::sensed::Sensed;

/// How many messages of each other robot may wait for a decision. Its gate lets no more of them pass at once.
const WAITING_MAX: usize = 64;

/// Who a node is.
#[derive(Clone)]
pub struct Identity {
    /// The team.
    pub roster: Arc<Roster>,
    /// The robot's number.
    pub id: RobotId,
    /// Its private key.
    pub key: SigningKey,
    /// The number of its starts.
    pub epoch: u64,
}

/// What is to be published besides messages and reports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Notice {
    /// An envelope of that robot, for whoever was sent another one with the same number.
    Evidence(RobotId, Vec<u8>),
    /// A proof that a robot is two-faced.
    Proof(RobotId, Vec<u8>),
}

/// One robot of the core behind its gate.
pub struct Pilot<const D: usize> {
    identity: Identity,
    robot: Robot<D, Vec<Slot<D>>>,
    memory: Memory<D>,
    gate: Gate,
    /// What arrived since the last decision, in order.
    waiting: Vec<(RobotId, Vec<u8>)>,
    /// What the robot says of others in its next message.
    echoes: Vec<Echo>,
    said: u64,
    reported: u64,
    missed: u32,
    /// A proof of each robot that is known to be two-faced, and when all were published last.
    proofs: BTreeMap<RobotId, Vec<u8>>,
    published: Option<Instant>,
    sensed_at: Option<Instant>,
    params: Params<D>,
}

/// How much the gate for messages takes with these parameters.
#[must_use]
pub fn limits<const D: usize>(params: &Params<D>) -> Limits {
    let clock = params.settings().clock;
    let period_s = clock.level_period.as_secs_f64();
    // What a network held up for as long as a level may be old comes at once.
    let late = (clock.told_max.as_secs_f64() / period_s).min(56.0);
    Limits {
        per_s: 2.0 / period_s,
        burst: 8.0 + late,
        age_max: clock.told_max,
        ahead_max: clock.error + Duration::from_millis(1),
    }
}

impl<const D: usize> Pilot<D> {
    /// The robot of this `identity` with initial `value`.
    pub fn new(identity: Identity, params: Params<D>, value: f64) -> Result<Self, RobotError> {
        let others = usize::from(params.settings().team.robots).saturating_sub(1);
        let slots = vec![Slot::default(); others];
        let gate = Gate::new(Arc::clone(&identity.roster), Purpose::Say, Some(identity.id), limits(&params));
        Ok(Self {
            robot: Robot::new(params, identity.roster.member(identity.id), value, slots)?,
            memory: Memory::new(&params, others),
            gate,
            identity,
            waiting: Vec::new(),
            echoes: Vec::new(),
            said: 0,
            reported: 0,
            missed: 0,
            proofs: BTreeMap::new(),
            published: None,
            sensed_at: None,
            params,
        })
    }

    /// Takes what was sensed, and says what to tell now, if anything is due. Something older than the last is not used.
    pub fn sense(&mut self, sensed: &Sensed<D>) -> Option<Message> {
        if self.sensed_at.is_some_and(|last| sensed.at <= last)
            || self.robot.sense(sensed.at, sensed.own_m).is_err()
        {
            return None;
        }
        self.sensed_at = Some(sensed.at);
        for (id, position_m) in &sensed.others {
            // A robot that is not of the team, or more than fit, are left out by the core, which says so in its mode.
            let _ = self.robot.observe(self.identity.roster.member(*id), *position_m);
        }
        let message = self.robot.share(&mut self.memory.lend())?;
        self.said += 1;
        self.echoes = self.gate.echoes(ECHOES_MAX);
        Some(message)
    }

    /// The bytes of a message, of the kind that robots with this controller tell.
    #[must_use]
    pub fn encode(&self, message: &Message) -> Option<Vec<u8>> {
        let mut bytes = vec![0; PAYLOAD_MAX];
        let length = self.robot.encode(message, &mut bytes)?;
        bytes.truncate(length);
        Some(bytes)
    }

    /// The envelope with what the robot tells, which was made of the last message of [`sense`](Self::sense).
    #[must_use]
    pub fn say(&self, now: Instant, payload: &[u8]) -> Option<Vec<u8>> {
        let Identity { roster, id, key, epoch } = &self.identity;
        let (purpose, sequence) = (Purpose::Say, self.said);
        let letter =
            Letter { purpose, id: *id, epoch: *epoch, sequence, sent: now, payload, echoes: &self.echoes };
        letter.seal(roster.hash(), key)
    }

    /// Takes the bytes of an envelope that arrived at `now`.
    pub fn hear(&mut self, now: Instant, bytes: &[u8]) -> Vec<Notice> {
        let mut notices = Vec::new();
        let before = Envelope::parse(bytes).and_then(|envelope| self.gate.epoch(envelope.id));
        if let Ok(envelope) = self.gate.take(now, bytes) {
            if before != Some(envelope.epoch) {
                notices.extend(self.publish_again(now));
            }
            self.wait(envelope.id, envelope.payload);
            for copy in self.gate.contradictions(now, &envelope) {
                if let Some(of) = Envelope::parse(&copy) {
                    notices.push(Notice::Evidence(of.id, copy));
                }
            }
        }
        notices.extend(self.proofs());
        notices
    }

    fn wait(&mut self, id: RobotId, payload: &[u8]) {
        if self.waiting.iter().filter(|(other, _)| *other == id).count() >= WAITING_MAX {
            self.gate.reject(id, Reject::Flood);
        } else {
            self.waiting.push((id, payload.to_vec()));
        }
    }

    /// Takes what another robot says it was sent.
    pub fn hear_evidence(&mut self, now: Instant, bytes: &[u8]) -> Vec<Notice> {
        // What is no evidence is of no use and does no harm.
        let _ = self.gate.evidence(now, bytes);
        self.proofs()
    }

    /// Takes a proof that another robot found.
    pub fn hear_proof(&mut self, now: Instant, bytes: &[u8]) -> Vec<Notice> {
        let _ = self.gate.proof(now, bytes);
        self.proofs()
    }

    fn proofs(&mut self) -> Vec<Notice> {
        let mut notices = Vec::new();
        for proof in self.gate.take_proofs() {
            let Some(id) = Envelope::parse(&proof.first).map(|envelope| envelope.id) else { continue };
            let bytes = proof.encode();
            self.proofs.insert(id, bytes.clone());
            notices.push(Notice::Proof(id, bytes));
        }
        notices
    }

    /// All proofs once more, because a robot has started that does not know them; once a second at most.
    fn publish_again(&mut self, now: Instant) -> Vec<Notice> {
        if self.published.is_some_and(|last| now.since(last) < Duration::from_secs(1)) {
            return Vec::new();
        }
        self.published = Some(now);
        self.proofs.iter().map(|(id, bytes)| Notice::Proof(*id, bytes.clone())).collect()
    }

    /// Notes a tick in which nothing was sensed.
    pub fn miss(&mut self) {
        self.missed = self.missed.saturating_add(1);
    }

    /// Ends the tick: what was heard is used, and the velocity closest to `desired` (m/s) decided on. A desired velocity that
    /// is not finite stands for none.
    pub fn decide(&mut self, desired: [f64; D]) -> Report<D> {
        for (id, payload) in core::mem::take(&mut self.waiting) {
            // Who is not in sight is no neighbour, and what is older than what is known is of no use.
            if let Err(ReceiveError::Bytes(_)) = self.robot.receive_bytes(id, &payload) {
                self.gate.reject(id, Reject::Payload);
            }
        }
        let output = self.robot.tick(desired, &mut self.memory.lend());
        let ended = output.report.round.is_some();
        let used = |slot: &&Slot<D>| ended && slot.told_value().is_some() && self.robot.listens_to(slot);
        let spoke = self.robot.neighbors().iter().filter(used);
        let heard = spoke.map(Slot::id).collect();
        let report = output.report;
        Report {
            at: self.sensed_at.unwrap_or_default(),
            velocity_m_s: output.velocity_m_s,
            desired_m_s: if is_finite(&desired) { desired } else { [0.0; D] },
            reference_m: self.robot.reference().unwrap_or([0.0; D]),
            began_anew: self.robot.began_anew(),
            mode: report.mode,
            outcome: report.outcome,
            degree: report.degree,
            degree_margin: report.degree_margin,
            level: report.level,
            told: self.robot.told_level(),
            h: report.h,
            value: self.robot.value(),
            held: self.robot.value(),
            heard,
            counted: self.robot.counted().collect(),
            rows: self.robot.keeps_rows_for().collect(),
            told_age_ms: u32::try_from(report.told_age_max.as_millis()).unwrap_or(u32::MAX),
            missed: self.missed,
            busy_us: 0,
            rejects: rejects(self.gate.counts()),
        }
    }

    /// The envelope with a report.
    #[must_use]
    pub fn report(&mut self, now: Instant, report: &Report<D>) -> Option<Vec<u8>> {
        self.reported += 1;
        let Identity { roster, id, key, epoch } = &self.identity;
        let payload = &report.encode();
        let (purpose, sequence) = (Purpose::Report, self.reported);
        Letter { purpose, id: *id, epoch: *epoch, sequence, sent: now, payload, echoes: &[] }
            .seal(roster.hash(), key)
    }

    /// A report of a robot that stands still because it is to stop.
    #[must_use]
    pub fn stopped(&self, last: Option<&Report<D>>) -> Option<Report<D>> {
        let last = last?.clone();
        Some(Report { velocity_m_s: [0.0; D], mode: Mode::Stopped, heard: Vec::new(), ..last })
    }

    /// The velocities that it may be given.
    #[must_use]
    pub fn input(&self) -> InputBox<D> {
        self.params.settings().limits.input
    }

    /// The robot of the core.
    #[must_use]
    pub fn robot(&self) -> &Robot<D, Vec<Slot<D>>> {
        &self.robot
    }

    /// Makes the robot hold another level, as a liar of the paper does ([`Robot::restate`]).
    pub fn restate(&mut self, level: f64) {
        self.robot.restate(level);
    }

    /// Makes the robot keep its row for everybody, as a liar must that acknowledges what it did not receive ([`Robot::oblige`]).
    pub fn oblige(&mut self) {
        self.robot.oblige();
    }

    /// What was rejected, and why.
    #[must_use]
    pub fn counts(&self) -> &Counts {
        self.gate.counts()
    }

    /// Says from outside whether a robot is to be believed: what it tells is used, or not. It is still seen and avoided.
    pub fn trust(&mut self, id: RobotId, trusted: bool) {
        self.gate.trust(id, trusted);
    }

    /// Takes an operator's or a detector's word: `{"robot": 3, "trust": 0}`. 0 lets nothing count that the robot tells, 1 takes that back.
    /// Who is proved two-faced stays so. Gives the robot and whether it is believed now; `None` if the bytes are no such word.
    pub fn hear_trust(&mut self, bytes: &[u8]) -> Option<(RobotId, bool)> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Word {
            robot: u16,
            trust: f64,
        }
        let word: Word = if bytes.len() <= 256 { serde_json::from_slice(bytes).ok()? } else { return None };
        let (id, robots) = (RobotId(word.robot), self.params.settings().team.robots);
        if id == self.identity.id
            || !(1..=robots).contains(&id.0)
            || !(word.trust == 0.0 || word.trust == 1.0)
        {
            return None;
        }
        self.trust(id, word.trust == 1.0);
        Some((id, self.trusts(id)))
    }

    /// Takes another roster of the same operator at run time. Numbers, names and settings must be as before, and the own key too, because
    /// everything rests on them; keys of other robots may differ. A robot with a new key begins without a history and without what was proved of the old one.
    /// Says why not, otherwise.
    pub fn renew(&mut self, roster: &Arc<Roster>) -> Result<(), &'static str> {
        let (old, own) = (&self.identity.roster, self.identity.id);
        if roster.operator() != old.operator() {
            return Err("another operator signed it");
        }
        if roster.parameters() != old.parameters() {
            return Err("its settings differ: all robots must be started anew with it");
        }
        let names = |of: &Roster| of.robots().iter().map(|entry| entry.name.clone()).collect::<Vec<_>>();
        if names(roster) != names(old) {
            return Err(
                "its robots have other names or another order: all robots must be started anew with it",
            );
        }
        if roster.key(own) != old.key(own) {
            return Err("it has another key for this robot, which must be started anew with that key");
        }
        // Others who have the new roster cannot check what was signed for the old one.
        self.proofs.clear();
        self.gate.renew(roster);
        self.identity.roster = Arc::clone(roster);
        Ok(())
    }

    /// What is to be said to planners and people after a decision.
    pub fn status(&self, watch: &mut Watch, now: Instant, wished: bool, report: &Report<D>) -> Status {
        let (id, params) = (self.identity.id, &self.params);
        let scene = Scene { id, params, slots: self.robot.neighbors(), wished };
        let all = (1..=params.settings().team.robots).filter(|other| *other != id.0);
        watch.status(now, &scene, report, all.filter(|other| !self.trusts(RobotId(*other))).collect())
    }

    /// Whether a robot is believed.
    #[must_use]
    pub fn trusts(&self, id: RobotId) -> bool {
        self.gate.trusts(id)
    }
}
