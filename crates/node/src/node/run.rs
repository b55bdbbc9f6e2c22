//! The loop of one robot in real time.
//!
//! Ticks begin on the grid of the clock. What the robot senses, it uses when it comes; what it tells, it tells then; and at
//! [`DECIDE`] of the tick it decides, with whatever was heard by then. It never waits for anybody.

use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};

use closeranks_core::{Instant, RobotId};

use crate::clock::{Clock, tick};
use crate::config::Network;
use crate::identity::roster::Roster;
use crate::node::figures::{Figures, Said};
use crate::node::pilot::{Notice, Pilot};
use crate::node::status::{Status, Watch};
use crate::plant::PlantPort;
use crate::session::Traffic;
use crate::wire::report::Report;

/// The part of a tick after which a robot decides. What is left of it is for the way of its report to a simulated plant.
pub const DECIDE: f64 = 0.6;

/// How many arrivals may wait.
pub const QUEUE: usize = 4096;

/// Something that arrived.
#[derive(Clone, Debug)]
pub enum Event {
    /// From another robot.
    Said(Vec<u8>),
    /// From the plant, about a robot.
    Sensed(RobotId, Vec<u8>),
    /// A copy of what another robot was sent.
    Evidence(Vec<u8>),
    /// A proof that a robot is two-faced.
    Proof(Vec<u8>),
    /// A desired velocity.
    Want(Vec<u8>),
    /// A word from outside on whether a robot is to be believed.
    Trust(Vec<u8>),
    /// Files that were changed: another roster, and who is not to be believed.
    Files(Arc<Roster>, Vec<RobotId>),
    /// The robot is to be connected in another way.
    Network(Box<Network>),
}

/// What a robot publishes.
pub trait Voice<const D: usize> {
    /// Tells the others what the last call of [`Pilot::sense`] gave.
    fn say(&mut self, now: Instant, pilot: &mut Pilot<D>, message: &closeranks_core::Message);

    /// Publishes a report, for a simulated plant and for whoever watches.
    fn report(&mut self, now: Instant, pilot: &mut Pilot<D>, report: &mut Report<D>);

    /// Publishes what planners and people want to know.
    fn status(&mut self, status: &Status);

    /// Publishes what was found out about others.
    fn notice(&mut self, notice: &Notice);
}

/// Where a robot wants to go.
pub trait Wish<const D: usize> {
    /// Takes what arrived on its key.
    fn arrived(&mut self, now: Instant, bytes: &[u8]);

    /// The desired velocity at `now` of a robot at `own_m`, m/s; NaN if there is none.
    fn desired(&mut self, now: Instant, own_m: &[f64; D]) -> [f64; D];
}

/// One robot with everything around it.
pub struct Node<'a, const D: usize> {
    /// The robot.
    pub pilot: Pilot<D>,
    /// Where it is.
    pub port: Box<dyn PlantPort<D> + 'a>,
    /// How it speaks.
    pub voice: Box<dyn Voice<D> + 'a>,
    /// Where it wants to go.
    pub wish: Box<dyn Wish<D> + 'a>,
    /// The clock.
    pub clock: Clock,
    /// τ₁.
    pub period: Duration,
    own_m: [f64; D],
    last: Option<Report<D>>,
    /// When the look of this tick came, and how long was worked on it since.
    busy: Duration,
    fresh: bool,
    watch: Watch,
    figures: Figures,
}

impl<'a, const D: usize> Node<'a, D> {
    /// A node before its first tick.
    #[must_use]
    pub fn new(
        pilot: Pilot<D>,
        port: Box<dyn PlantPort<D> + 'a>,
        voice: Box<dyn Voice<D> + 'a>,
        wish: Box<dyn Wish<D> + 'a>,
        clock: Clock,
        period: Duration,
    ) -> Self {
        let (own_m, last, busy, fresh) = ([f64::NAN; D], None, Duration::ZERO, false);
        let (watch, figures) = (Watch::default(), Figures::begin(clock.now()));
        Self { pilot, port, voice, wish, clock, period, own_m, last, busy, fresh, watch, figures }
    }

    /// Runs until `stop`, or until nobody sends events any more; then the robot stands still, and says so. Or until it is to be connected in
    /// another way: then its base gets a velocity of 0, and the owner connects it and calls this again.
    pub fn run(&mut self, events: &Receiver<Event>, stop: &AtomicBool) -> Option<Box<Network>> {
        let part = self.period.mul_f64(DECIDE);
        let mut decide_at = tick(self.clock.now(), self.period).after(part);
        while !stop.load(Ordering::Relaxed) {
            let now = self.clock.now();
            if now >= decide_at {
                self.decide(now);
                decide_at =
                    tick(self.clock.now().after(self.period.saturating_sub(part)), self.period).after(part);
                continue;
            }
            let next = self.port.next_at().map_or(decide_at, |at| at.min(decide_at));
            match events.recv_timeout(next.since(now)) {
                Ok(Event::Network(network)) => {
                    self.port.drive(self.clock.now(), &[0.0; D]);
                    return Some(network);
                }
                Ok(event) => self.handle(event),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            self.sense();
        }
        self.stop();
        None
    }

    fn handle(&mut self, event: Event) {
        let now = self.clock.now();
        let notices = match event {
            Event::Said(bytes) => self.pilot.hear(now, &bytes),
            Event::Evidence(bytes) => self.pilot.hear_evidence(now, &bytes),
            Event::Proof(bytes) => self.pilot.hear_proof(now, &bytes),
            Event::Sensed(from, bytes) => {
                self.port.arrived(now, from, &bytes);
                Vec::new()
            }
            Event::Want(bytes) => {
                self.wish.arrived(now, &bytes);
                Vec::new()
            }
            Event::Trust(bytes) => {
                match self.pilot.hear_trust(&bytes) {
                    Some((id, true)) => eprintln!("robot {} is believed", id.0),
                    Some((id, false)) => eprintln!("robot {} is not believed", id.0),
                    None => eprintln!(
                        "a word on trust is not used: it must be {{\"robot\": ID, \"trust\": 0 or 1}}"
                    ),
                }
                Vec::new()
            }
            Event::Files(roster, distrusted) => {
                self.renew(&roster, &distrusted);
                Vec::new()
            }
            // Only `run` can do something about it.
            Event::Network(_) => Vec::new(),
        };
        for notice in &notices {
            self.voice.notice(notice);
        }
    }

    fn sense(&mut self) {
        let began = self.clock.now();
        let Some(sensed) = self.port.sensed(began) else { return };
        self.own_m = sensed.own_m;
        self.fresh = true;
        self.figures.shown(began);
        if let Some(message) = self.pilot.sense(&sensed) {
            self.voice.say(began, &mut self.pilot, &message);
        }
        self.busy = self.clock.now().since(began);
    }

    fn decide(&mut self, now: Instant) {
        if !core::mem::take(&mut self.fresh) {
            self.pilot.miss();
        }
        let desired = self.wish.desired(now, &self.own_m);
        let wished = desired.iter().all(|component| component.is_finite());
        let mut report = self.pilot.decide(desired);
        self.busy += self.clock.now().since(now);
        report.busy_us = u32::try_from(self.busy.as_micros()).unwrap_or(u32::MAX);
        self.port.drive(now, &report.velocity_m_s);
        self.figures.drove(self.clock.now(), report.busy_us);
        let status = self.pilot.status(&mut self.watch, now, wished, &report);
        self.voice.report(self.clock.now(), &mut self.pilot, &mut report);
        self.voice.status(&status);
        self.last = Some(report);
    }

    fn renew(&mut self, roster: &Arc<Roster>, distrusted: &[RobotId]) {
        match self.pilot.renew(roster) {
            Ok(()) => eprintln!("the roster and the list of those who are not believed were read anew"),
            Err(why) => return eprintln!("the new roster is not used: {why}"),
        }
        for id in (1..=u16::try_from(roster.robots().len()).unwrap_or(u16::MAX)).map(RobotId) {
            self.pilot.trust(id, !distrusted.contains(&id));
        }
    }

    fn stop(&mut self) {
        let now = self.clock.now();
        self.port.drive(now, &[0.0; D]);
        if let Some(mut report) = self.pilot.stopped(self.last.as_ref()) {
            self.voice.report(now, &mut self.pilot, &mut report);
        }
    }

    /// What it cost, with what went through its sessions.
    pub(crate) fn end(self, traffic: Traffic) -> Said {
        self.figures.end(self.clock.now(), traffic)
    }

    /// The last report.
    #[must_use]
    pub fn last(&self) -> Option<&Report<D>> {
        self.last.as_ref()
    }
}
