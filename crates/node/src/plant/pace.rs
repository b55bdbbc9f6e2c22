//! The simulated plant in real time: looks go out at the beginning of a tick, reports come in until its end.

use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};

use closeranks_core::{Instant, RobotId};
use core::time::Duration;
use ed25519_dalek::SigningKey;

use crate::clock::Clock;
use crate::identity::roster::Roster;
use crate::plant::world::World;
use crate::session::{Ear, Net, Out, SessionError, send};
use crate::wire::envelope::{Letter, Purpose};

/// A simulated plant with its clock and its way to the robots.
pub struct Pace<const D: usize> {
    world: World<D>,
    roster: Arc<Roster>,
    key: SigningKey,
    epoch: u64,
    sequence: u64,
    clock: Clock,
    outs: Vec<Out>,
    reports: Receiver<Vec<u8>>,
    _ear: Ear,
    overruns: u64,
}

/// What the owner of a plant does in every tick, after it ended: for tables and for what happens to processes.
pub type Watch<'a, const D: usize> = &'a mut dyn FnMut(&World<D>, Instant);

impl<const D: usize> Pace<D> {
    /// A plant over `net`. Its looks are signed with `key`, as those of its start number `epoch`.
    pub fn new(
        world: World<D>,
        roster: Arc<Roster>,
        key: SigningKey,
        epoch: u64,
        clock: Clock,
        net: &Net,
    ) -> Result<Self, SessionError> {
        let (queue, reports) = std::sync::mpsc::sync_channel(crate::node::run::QUEUE);
        let outs = roster.robots().iter().map(|entry| net.out(&format!("sensed/{}", entry.id)));
        Ok(Self {
            world,
            outs: outs.collect::<Result<_, _>>()?,
            roster,
            key,
            epoch,
            sequence: 0,
            clock,
            reports,
            _ear: net.listen("report/*", queue, |_, bytes| Some(bytes))?,
            overruns: 0,
        })
    }

    /// Waits until every robot has reported, for `patience` at most; then begins at the next round. False if some robot did not.
    pub fn gather(&mut self, patience: Duration, stop: &AtomicBool, watch: Watch<'_, D>) -> bool {
        let end = self.clock.now().after(patience);
        while !self.world.all_are_there() && self.clock.now() < end && !stop.load(Ordering::Relaxed) {
            self.take_until(self.clock.now().after(Duration::from_millis(100)));
            watch(&self.world, self.clock.now());
        }
        self.world.start_at(self.clock.now());
        self.world.all_are_there()
    }

    /// Ticks for `duration` of its time, or until `stop`.
    pub fn run(&mut self, duration: Duration, stop: &AtomicBool, watch: Watch<'_, D>) {
        let period = self.world.period();
        let end = self.world.began().after(duration);
        while self.world.next_begins() < end && !stop.load(Ordering::Relaxed) {
            let begins = self.world.next_begins();
            self.take_until(begins);
            let looks = self.world.begin_tick();
            let overrun = self.clock.now() > begins.after(period / 2);
            if overrun {
                // This process had no time: nobody gets a look, and every body stands still.
                self.overruns += 1;
            } else {
                self.show(&looks);
                self.take_until(begins.after(period));
            }
            self.world.end_tick();
            watch(&self.world, self.clock.now());
        }
    }

    fn show(&mut self, looks: &[crate::wire::sensed::Sensed<D>]) {
        self.sequence += 1;
        for (id, (look, out)) in (1..).zip(looks.iter().zip(&self.outs)) {
            let payload = &look.encode();
            let letter = Letter {
                purpose: Purpose::Sensed,
                id: RobotId(id),
                epoch: self.epoch,
                sequence: self.sequence,
                sent: self.clock.now(),
                payload,
                echoes: &[],
            };
            if let Some(bytes) = letter.seal(self.roster.hash(), &self.key) {
                send(out, bytes);
            }
        }
    }

    fn take_until(&mut self, end: Instant) {
        loop {
            let left = end.since(self.clock.now());
            match self.reports.recv_timeout(left) {
                // What is rejected is counted at the gate.
                Ok(bytes) => _ = self.world.take(self.clock.now(), &bytes),
                Err(RecvTimeoutError::Timeout) => return,
                Err(RecvTimeoutError::Disconnected) => return std::thread::sleep(left),
            }
            if self.clock.now() >= end {
                return;
            }
        }
    }

    /// How many ticks passed in which this process had no time.
    #[must_use]
    pub fn overruns(&self) -> u64 {
        self.overruns
    }

    /// The world.
    #[must_use]
    pub fn world(&self) -> &World<D> {
        &self.world
    }

    /// The world, at the end.
    #[must_use]
    pub fn into_world(self) -> World<D> {
        self.world
    }
}
