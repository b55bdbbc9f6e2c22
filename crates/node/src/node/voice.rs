//! How a robot speaks: what it made is sealed and published. The liars of an experiment have another voice; the robot itself
//! does not know.

use std::path::{Path, PathBuf};

use closeranks_core::num::subtract;
use closeranks_core::{Instant, Message, RobotId};
use closeranks_sim::attack::ListsAttack;
use closeranks_sim::attack::liars::{Face, Liars};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::transport::Bytes;

use crate::node::pilot::{Notice, Pilot};
use crate::node::run::Voice;
use crate::node::status::Status;
use crate::session::{Net, Out, SessionError, send};
use crate::wire::report::Report;

/// The voice of a robot that says what it knows.
pub struct Plain {
    say: Out,
    report: Out,
    status: Out,
    evidence: Vec<Out>,
    proof: Vec<Out>,
    /// Where proofs are written.
    folder: PathBuf,
    /// Who else is shown the status.
    viewer: Option<Viewer>,
}

/// Shows a status in another form.
pub type Viewer = Box<dyn FnMut(&Status) + Send>;

impl Plain {
    /// The voice of robot `id` in a team of so many, which writes proofs to `folder`.
    pub fn new(net: &Net, id: RobotId, robots: u16, folder: PathBuf) -> Result<Self, SessionError> {
        let about = |kind: &str| -> Result<Vec<Out>, SessionError> {
            (1..=robots).map(|other| net.out(&format!("{kind}/{other}"))).collect()
        };
        Ok(Self {
            say: net.out(&format!("say/{}", id.0))?,
            report: net.out(&format!("report/{}", id.0))?,
            status: net.out(&format!("status/{}", id.0))?,
            evidence: about("evidence")?,
            proof: about("proof")?,
            folder,
            viewer: None,
        })
    }

    /// The same voice, which shows every status to `viewer` too.
    #[must_use]
    pub fn seen_by(self, viewer: Option<Viewer>) -> Self {
        Self { viewer, ..self }
    }
}

impl<const D: usize> Voice<D> for Plain {
    fn say(&mut self, now: Instant, pilot: &mut Pilot<D>, message: &Message) {
        if let Some(bytes) = pilot.encode(message).and_then(|payload| pilot.say(now, &payload)) {
            send(&self.say, bytes);
        }
    }

    fn report(&mut self, now: Instant, pilot: &mut Pilot<D>, report: &mut Report<D>) {
        if let Some(bytes) = pilot.report(now, report) {
            send(&self.report, bytes);
        }
    }

    fn status(&mut self, status: &Status) {
        if let Ok(bytes) = serde_json::to_vec(status) {
            send(&self.status, bytes);
        }
        if let Some(viewer) = &mut self.viewer {
            viewer(status);
        }
    }

    fn notice(&mut self, notice: &Notice) {
        let (outs, id, bytes) = match notice {
            Notice::Evidence(id, bytes) => (&self.evidence, *id, bytes),
            Notice::Proof(id, bytes) => {
                keep(&self.folder, *id, bytes);
                (&self.proof, *id, bytes)
            }
        };
        if let Some(out) = outs.get(usize::from(id.0).wrapping_sub(1)) {
            send(out, bytes.clone());
        }
    }
}

/// Writes a proof and says so; one that is there is left alone.
fn keep(folder: &Path, id: RobotId, bytes: &[u8]) {
    let path = folder.join(format!("robot-{}.proof", id.0));
    if path.exists() {
        return;
    }
    let written = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(&path, bytes));
    let place = written.map_or_else(|error| format!("cannot be written: {error}"), |()| "written".into());
    eprintln!("robot {} is two-faced; proof {} {place}", id.0, path.display());
}

/// The voice of a robot that is not connected.
pub struct Silent;

impl<const D: usize> Voice<D> for Silent {
    fn say(&mut self, _now: Instant, _pilot: &mut Pilot<D>, _message: &Message) {}

    fn report(&mut self, _now: Instant, _pilot: &mut Pilot<D>, _report: &mut Report<D>) {}

    fn status(&mut self, _status: &Status) {}

    fn notice(&mut self, _notice: &Notice) {}
}

/// The voice of a malicious robot of an experiment: the lies of a scenario, properly signed.
pub struct Lying {
    plain: Plain,
    /// To each other robot alone.
    aside: Vec<Option<Out>>,
    liars: Liars,
    index: usize,
    /// Whether every neighbour is told the same.
    alike: bool,
    tick: u32,
    told: Option<f64>,
}

impl Lying {
    /// The voice of robot `id` with the lies of `scenario`.
    pub fn new(plain: Plain, net: &Net, id: RobotId, scenario: &Scenario) -> Result<Self, SessionError> {
        let mut aside = Vec::new();
        for other in 1..=scenario.team.robots {
            let key = format!("aside/{}/{other}", id.0);
            aside.push(if other == id.0 { None } else { Some(net.out(&key)?) });
        }
        Ok(Self {
            plain,
            aside,
            liars: Liars::new(scenario),
            index: usize::from(id.0) - 1,
            alike: scenario.attack.level.is_alike_for_all()
                && scenario.attack.value.is_alike_for_all()
                && scenario.attack.lists == ListsAttack::default(),
            tick: 0,
            told: None,
        })
    }

    /// The value of each robot, as far as it was told, and else the own one.
    fn values<const D: usize>(&self, pilot: &Pilot<D>) -> Vec<f64> {
        let robot = pilot.robot();
        let mut values = vec![robot.value(); self.aside.len()];
        for slot in robot.neighbors() {
            if let (Some(value), Some(place)) =
                (slot.told_value(), values.get_mut(usize::from(slot.id().0).wrapping_sub(1)))
            {
                *place = value;
            }
        }
        values
    }
}

impl<const D: usize> Voice<D> for Lying {
    fn say(&mut self, now: Instant, pilot: &mut Pilot<D>, message: &Message) {
        self.liars.begin_tick(self.tick);
        self.tick = self.tick.saturating_add(1);
        let values = self.values(pilot);
        if message.value().is_some() {
            self.liars.begin_round(values.iter().copied());
        }
        let level = message.level().map(|level| self.liars.level(self.index, level));
        if let Some(level) = level {
            pilot.restate(level);
        }
        if self.liars.binds(self.index) {
            pilot.oblige();
        }
        let value = message.value().map(|value| self.liars.value(self.index, value));
        self.told = value.or(self.told);
        let Ok(lie) = Message::new(message.sequence(), message.stamp(), level, value) else { return };
        if self.alike {
            return self.plain.say(now, pilot, &lie);
        }
        for (reader, (out, held)) in (1..).map(RobotId).zip(self.aside.iter().zip(values)) {
            let Some(out) = out else { continue };
            let face = match self.liars.face(self.index, &lie, held) {
                Face::Silence => None,
                Face::Bytes(bytes) => Some(Bytes::from(bytes)),
                Face::Message(told) => pilot.encode(&told).map(|bytes| Bytes::from(&bytes[..])),
            };
            // What others want is not known here; the liar takes its own wish for theirs.
            let wish_m_s = pilot.robot().wish_m_s();
            let face = face.and_then(|face| self.liars.lists(self.index, reader, wish_m_s, face));
            if let Some(bytes) = face.and_then(|face| pilot.say(now, &face)) {
                send(out, bytes);
            }
        }
    }

    fn report(&mut self, now: Instant, pilot: &mut Pilot<D>, report: &mut Report<D>) {
        let own = report.reference_m;
        let mut positions_m = vec![own; self.aside.len()];
        for slot in pilot.robot().neighbors() {
            if let Some(place) = positions_m.get_mut(usize::from(slot.id().0).wrapping_sub(1)) {
                *place = subtract(&own, &slot.offset_m());
            }
        }
        let input = pilot.input();
        if let Some(velocity) = self.liars.velocity(self.index, &positions_m, &input) {
            report.velocity_m_s = velocity;
        }
        report.value = self.told.unwrap_or(report.value);
        Voice::<D>::report(&mut self.plain, now, pilot, report);
    }

    fn status(&mut self, status: &Status) {
        Voice::<D>::status(&mut self.plain, status);
    }

    /// A liar does not tell on others, nor on itself.
    fn notice(&mut self, _notice: &Notice) {}
}
