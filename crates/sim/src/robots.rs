//! The robots of a run, one by one, with every message as bytes through the network.
//!
//! This is the whole path that a robot in the world takes; [`crate::team`] gives the same bits faster where the network
//! is perfect.

use closeranks_core::budget::knowledge::Sighting;
use closeranks_core::budget::row::Row;
use closeranks_core::message::Message;
use closeranks_core::neighbor::{RobotId, Slot};
use closeranks_core::params::Params;
use closeranks_core::refusal::RobotError;
use closeranks_core::robot::Robot;
use closeranks_core::time::Instant;

use crate::attack::Liars;
use crate::frame::Frame;

/// Memory that a fleet lends to its robots.
#[derive(Clone, Debug)]
pub struct Memory<const D: usize> {
    slots: Vec<Slot<D>>,
    values: Vec<f64>,
    sightings: Vec<Sighting<D>>,
    rows: Vec<Row<D>>,
    robots: usize,
}

impl<const D: usize> Memory<D> {
    /// For `robots` robots that may all be neighbours of each other.
    #[must_use]
    pub fn new(robots: usize) -> Self {
        let nobody = Sighting { offset_m: [0.0; D], claim: None };
        Self {
            slots: vec![Slot::default(); robots * robots],
            values: vec![0.0; robots * Self::values_each(robots)],
            sightings: vec![nobody; robots * robots],
            rows: vec![Row::default(); robots * Self::rows_each(robots)],
            robots,
        }
    }

    /// Small teams get a table of all pairs, which halves the work of `budget`.
    fn values_each(robots: usize) -> usize {
        if robots <= 64 { robots * robots } else { robots }
    }

    fn rows_each(robots: usize) -> usize {
        2 * D + 2 * robots + 1
    }
}

/// All robots of a run in a perfect network.
#[derive(Debug)]
pub struct Fleet<'memory, const D: usize> {
    robots: Vec<Robot<'memory, D>>,
    outbox: Vec<Option<Message>>,
    tick_nanos: u64,
    tick: u32,
    tick_s: f64,
}

impl<'memory, const D: usize> Fleet<'memory, D> {
    /// Robots with initial `values` in memory made for as many.
    pub fn new(
        params: Params<D>,
        values: &[f64],
        memory: &'memory mut Memory<D>,
    ) -> Result<Self, RobotError> {
        let chunk = memory.robots.max(1);
        let scratch = memory.values.chunks_mut(Memory::<D>::values_each(chunk));
        let lent = memory.slots.chunks_mut(chunk).zip(scratch);
        let rows = memory.rows.chunks_mut(Memory::<D>::rows_each(chunk));
        let more = memory.sightings.chunks_mut(chunk).zip(rows);
        let robots = (1..).zip(values).zip(lent.zip(more));
        let robots = robots.map(|((id, value), ((slots, scratch), (sightings, rows)))| {
            let robot = Robot::new(params, RobotId(id), *value, slots, scratch)?;
            Ok(robot.with_budget_memory(sightings, rows))
        });
        Ok(Self {
            robots: robots.collect::<Result<_, _>>()?,
            outbox: vec![None; values.len()],
            tick_nanos: u64::try_from(params.settings().level_period.as_nanos()).unwrap_or(u64::MAX),
            tick: 0,
            tick_s: params.settings().level_period.as_secs_f64(),
        })
    }

    /// One tick: fills everything in `frame` but positions and desired velocities.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        let now = Instant::from_nanos(u64::from(self.tick).saturating_mul(self.tick_nanos));
        self.sense(now, frame);
        liars.begin_tick(f64::from(self.tick) * self.tick_s);
        self.share(liars);
        self.deliver();
        self.control(frame, liars);
        self.tick = self.tick.saturating_add(1);
    }

    fn sense(&mut self, now: Instant, frame: &Frame<D>) {
        for (robot, own) in self.robots.iter_mut().zip(&frame.positions_m) {
            // Positions of the world are finite and time rises, so nothing here is refused.
            let _ = robot.sense(now, *own);
            for (id, position) in (1..).map(RobotId).zip(&frame.positions_m) {
                if id != robot.id() {
                    let _ = robot.observe(id, *position);
                }
            }
        }
    }

    /// Every robot shares; liars change what leaves them, and by Assumption 1 the level they hold.
    fn share(&mut self, liars: &mut Liars) {
        for (robot, slot) in self.robots.iter_mut().zip(&mut self.outbox) {
            *slot = robot.share();
        }
        if self.outbox.iter().flatten().any(|message| message.value().is_some()) {
            liars.begin_round();
        }
        for (index, (robot, slot)) in self.robots.iter_mut().zip(&mut self.outbox).enumerate() {
            let Some(message) = *slot else { continue };
            let level = liars.level(index, message.level());
            robot.restate(level);
            let value = message.value().map(|value| liars.value(index, value));
            *slot = Message::new(message.sequence(), message.stamp(), level, value).ok();
        }
    }

    /// The perfect network: bytes to every neighbour within the tick.
    fn deliver(&mut self) {
        for (sender, message) in (1..).map(RobotId).zip(&self.outbox) {
            let Some(bytes) = message.as_ref().map(Message::encode) else { continue };
            let Ok(message) = Message::parse(&bytes) else { continue };
            for robot in &mut self.robots {
                // Robots out of range are not neighbours and refuse it.
                let _ = robot.receive(sender, &message);
            }
        }
    }

    fn control(&mut self, frame: &mut Frame<D>, liars: &Liars) {
        let mut ends: u32 = 0;
        for (index, robot) in self.robots.iter_mut().enumerate() {
            let output = robot.tick(frame.desired_m_s[index]);
            frame.velocities_m_s[index] = output.velocity_m_s;
            frame.degrees[index] = output.report.degree;
            frame.levels[index] =
                robot.neighbors().iter().fold(0.0, |level, slot| level + slot.link().weight);
            frame.spares[index] = output.report.h;
            frame.told[index] = robot.told_level();
            frame.phis[index] = output.report.phi.unwrap_or_else(|| robot.phi());
            frame.outcomes[index] = output.report.outcome;
            frame.values[index] = liars.value(index, robot.value());
            ends += u32::from(output.report.degree);
        }
        frame.links = ends / 2;
    }
}
