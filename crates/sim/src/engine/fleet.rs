//! The robots of a run, one by one, with every message as bytes through the network, and whatever goes wrong.
//!
//! This is the whole path that a robot in the world takes; [`crate::engine::team`] gives the same bits faster where the world is
//! perfect.

use closeranks_core::controller::links::wire::{Notice, bytes_max};
use closeranks_core::equations::composition::Composed;
use closeranks_core::message::{MESSAGE_BYTES, Message};
use closeranks_core::num::{Vector, dot};
use closeranks_core::program::Outcome;
use closeranks_core::robot::Robot;
use closeranks_core::robot::error::RobotError;
use closeranks_core::robot::neighbor::{Member, RobotId, Slot};
use closeranks_core::robot::report::Mode;
use closeranks_core::settings::params::Params;

use crate::attack::liars::{Face, Liars};
use crate::engine::memory::Memory;
use crate::engine::roster::Roster;
use crate::faults::edges::Edges;
use crate::faults::network::{FaultyNetwork, LATE_MAX};
use crate::faults::outages::Downtime;
use crate::faults::sight::Sight;
use crate::frame::Frame;
use crate::geometry::around::Around;
use crate::geometry::squared_distance;
use crate::scenario::Scenario;
use crate::transport::memory::InMemory;
use crate::transport::{Bytes, Parcel, Transport};

/// So many slots robots have at first, and get at a time, where they get them when they need them.
const SLOTS_FIRST: usize = 8;

/// All robots of a run, with whatever goes wrong around them.
#[derive(Debug)]
pub struct Fleet<const D: usize, T = FaultyNetwork<InMemory>> {
    robots: Vec<Robot<D, Vec<Slot<D>>>>,
    /// Their numbers and ranks.
    members: Vec<Member>,
    memory: Memory<D>,
    composed: Composed,
    params: Params<D>,
    /// Their initial values.
    values: Vec<f64>,
    malicious: Vec<bool>,
    outbox: Vec<Option<Message>>,
    /// What everybody says to everybody in a tick, where messages need no bytes.
    notices: Option<Vec<(usize, usize, Notice<D>)>>,
    /// Room for the longest message.
    buffer: Vec<u8>,
    transport: T,
    edges: Edges<D>,
    /// Who is within R of whom in this tick, where robots sense everybody there.
    around: Around,
    /// How many slots a robot may have.
    slots: usize,
    /// Robots tell lists of links and not levels.
    lists: bool,
    ticks_per_round: u32,
    tick: u32,
    tick_s: f64,
}

impl<const D: usize> Fleet<D> {
    /// The robots of `scenario` in a perfect world, in which they hand over what they tell without bytes.
    pub fn at_once(scenario: &Scenario, params: Params<D>, values: &[f64]) -> Result<Self, RobotError> {
        Ok(Self { notices: Some(Vec::new()), ..Self::new(scenario, params, values)? })
    }

    /// The robots of `scenario` with initial `values`, over the network of `scenario`.
    pub fn new(scenario: &Scenario, params: Params<D>, values: &[f64]) -> Result<Self, RobotError> {
        let (network, seed, robots) = (scenario.faults.network, scenario.seed, scenario.team.robots);
        // Every robot may send twice to every other one in a tick, and everything that is late may arrive in one.
        let capacity = 2 * values.len() * values.len() + LATE_MAX;
        let perfect = InMemory::new(capacity);
        let transport = FaultyNetwork::new(perfect, network, seed, robots, scenario.tick_s());
        Self::over(transport, scenario, params, values)
    }
}

impl<const D: usize, T: Transport> Fleet<D, T> {
    /// The robots of `scenario` with initial `values`, over `transport`.
    pub fn over(
        transport: T,
        scenario: &Scenario,
        params: Params<D>,
        values: &[f64],
    ) -> Result<Self, RobotError> {
        let others = values.len().saturating_sub(1);
        let slots = scenario.faults.sensing.dropouts.slots.map_or(others, usize::from);
        let (members, edges) =
            (Roster::new(scenario, &params).members().to_vec(), Edges::new(scenario, &params));
        // Where it is known who is near, robots get slots when they need them.
        let first = if edges.sight.is_whole() { slots.min(SLOTS_FIRST) } else { slots };
        let robots = members
            .iter()
            .zip(values)
            .map(|(member, value)| Robot::new(params, *member, *value, vec![Slot::default(); first]));
        Ok(Self {
            robots: robots.collect::<Result<_, _>>()?,
            members,
            memory: Memory::new(&params, others),
            composed: scenario.composition(),
            params,
            values: values.to_vec(),
            malicious: scenario.malicious_mask(),
            outbox: vec![None; values.len()],
            notices: None,
            buffer: vec![0; MESSAGE_BYTES.max(bytes_max(scenario.team.robots, D))],
            transport,
            edges,
            around: Around::default(),
            slots,
            lists: params.controller().tells_lists(),
            ticks_per_round: scenario.ticks_per_round(),
            tick: 0,
            tick_s: params.settings().clock.level_period.as_secs_f64(),
        })
    }

    /// One tick: fills everything in `frame` but positions, desired velocities, references and assumptions.
    pub fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        self.begin_tick(frame, liars);
        self.sense(frame);
        self.share(liars);
        if self.notices.is_some() {
            self.hand_over();
        } else {
            self.send(liars);
            self.deliver();
        }
        self.control(frame, liars);
        self.tick = self.tick.saturating_add(1);
    }

    /// What stands between the robots and the world in this tick.
    #[must_use]
    pub fn edges(&self) -> &Edges<D> {
        &self.edges
    }

    /// The robot `index`, unless it is down in this tick.
    #[must_use]
    pub fn running(&self, index: usize) -> Option<&Robot<D, Vec<Slot<D>>>> {
        self.robots.get(index).filter(|_| !self.edges.downtime.down(index))
    }

    fn time_s(&self) -> f64 {
        f64::from(self.tick) * self.tick_s
    }

    fn begin_tick(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        let time_s = self.time_s();
        if self.tick.is_multiple_of(self.ticks_per_round) {
            frame.heard.fill([0; 2]);
            frame.listened.fill([0; 2]);
        }
        self.edges.begin_tick(self.tick, time_s, &frame.positions_m);
        self.transport.begin_tick(self.tick);
        liars.begin_tick(self.tick);
        for (index, robot) in self.robots.iter_mut().enumerate() {
            frame.down[index] = self.edges.downtime.down(index);
            if self.edges.downtime.reborn(index) {
                // The value was good once.
                let _ = robot.restart(self.values[index]);
                self.edges.sight.forget(index);
            }
        }
    }

    fn sense(&mut self, frame: &Frame<D>) {
        let sight_m2 = self.params.link().radius_m * self.params.link().radius_m;
        let Edges { clocks, senses, sight, downtime } = &mut self.edges;
        let whole = sight.is_whole();
        if whole {
            self.around.look(&frame.positions_m, self.params.link().radius_m);
        }
        for (observer, robot) in self.robots.iter_mut().enumerate() {
            if downtime.down(observer) {
                continue;
            }
            let own = &frame.positions_m[observer];
            // Sensed positions are finite and clocks rise, so nothing here is refused unless slots are too few.
            let _ = robot.sense(clocks.now(observer, self.tick), senses.sense(observer, observer, own));
            if whole {
                make_room(robot, self.around.of(observer).len(), self.slots);
            }
            let mut observe = |index: usize, position: &Vector<D>, sight: &mut Sight<D>| {
                let sensed = senses.sense(observer, index, position);
                sight.note((observer, index), position, &sensed);
                let _ = robot.observe(self.members[index], sensed);
            };
            if whole {
                for index in self.around.of(observer).iter().map(|index| usize::from(*index)) {
                    observe(index, &frame.positions_m[index], sight);
                }
                continue;
            }
            for (index, position) in frame.positions_m.iter().enumerate() {
                let within = squared_distance(own, position) <= sight_m2;
                if index != observer && sight.senses((observer, own), index, within) {
                    observe(index, position, sight);
                }
            }
        }
    }

    /// Every robot shares; by Assumption 1 liars hold the level that they tell.
    fn share(&mut self, liars: &mut Liars) {
        let mut scratch = self.memory.lend();
        for (index, (robot, slot)) in self.robots.iter_mut().zip(&mut self.outbox).enumerate() {
            *slot = if self.edges.downtime.down(index) { None } else { robot.share(&mut scratch) };
        }
        if self.outbox.iter().flatten().any(|message| message.value().is_some()) {
            liars.begin_round(self.robots.iter().map(Robot::value));
        }
        for (index, (robot, slot)) in self.robots.iter_mut().zip(&mut self.outbox).enumerate() {
            let Some(message) = *slot else { continue };
            let level = message.level().map(|level| liars.level(index, level));
            if let Some(level) = level {
                robot.restate(level);
            }
            if liars.binds(index) {
                robot.oblige();
            }
            let value = message.value().map(|value| liars.value(index, value));
            *slot = Message::new(message.sequence(), message.stamp(), level, value).ok();
        }
    }

    /// What is told to every other robot, without bytes and with the same bits.
    fn hand_over(&mut self) {
        let mut notices = self.notices.take().unwrap_or_default();
        notices.clear();
        for (receiver, robot) in self.robots.iter().enumerate() {
            // All others refuse it: they are out of range.
            for sender in robot.neighbors().iter().map(|slot| usize::from(slot.id().0) - 1) {
                let Some(message) = &self.outbox[sender] else { continue };
                let notice = self.robots[sender].notice(message, id(receiver));
                notices.extend(notice.map(|notice| (sender, receiver, notice)));
            }
        }
        for (sender, receiver, notice) in &notices {
            let _ = self.robots[*receiver].receive_notice(id(*sender), notice);
        }
        self.notices = Some(notices);
    }

    /// Bytes to every other robot, each with its own fate.
    fn send(&mut self, liars: &mut Liars) {
        for (sender, message) in self.outbox.iter().enumerate() {
            let Some(message) = message else { continue };
            let own = &self.robots[sender];
            let all = encode(own, message, &mut self.buffer);
            for (receiver, robot) in self.robots.iter().enumerate() {
                if receiver == sender {
                    continue;
                }
                let bytes = match liars.face(sender, message, robot.value()) {
                    Face::Silence => None,
                    Face::Bytes(bytes) => Some(bytes.into()),
                    Face::Message(told) if told == *message => all.clone(),
                    Face::Message(told) => encode(own, &told, &mut self.buffer),
                };
                let bytes = match bytes {
                    Some(bytes) if self.lists => liars.lists(sender, id(receiver), robot.wish_m_s(), bytes),
                    bytes => bytes,
                };
                if let Some(bytes) = bytes {
                    // A message for which there is no room is lost.
                    let _ = self.transport.send(Parcel { sender, receiver, bytes });
                }
            }
        }
    }

    fn deliver(&mut self) {
        while let Some(Parcel { sender, receiver, bytes }) = self.transport.poll() {
            if self.edges.downtime.down(receiver) {
                continue;
            }
            // Robots refuse what is no message, and what comes from out of range.
            let _ = self.robots[receiver].receive_bytes(id(sender), &bytes);
        }
    }

    fn control(&mut self, frame: &mut Frame<D>, liars: &mut Liars) {
        let input = self.params.settings().limits.input;
        let mut scratch = self.memory.lend();
        let (mut ends, tells): (u32, bool) = (0, self.params.tells_paper_levels());
        for (index, robot) in self.robots.iter_mut().enumerate() {
            if self.edges.downtime.down(index) {
                stand(index, frame, &self.edges.downtime);
                continue;
            }
            let output = robot.tick(frame.asked_m_s[index], &mut scratch);
            frame.velocities_m_s[index] = match liars.velocity(index, &frame.positions_m, &input) {
                Some(velocity) => velocity,
                None => output.velocity_m_s,
            };
            frame.degrees[index] = output.report.degree;
            frame.levels[index] = if self.lists {
                output.report.level
            } else {
                let counted = robot.neighbors().iter().filter(|slot| robot.counts(slot));
                counted.fold(0.0, |level, slot| level + slot.link().weight)
            };
            frame.h[index] = output.report.h;
            frame.told[index] = robot.told_level();
            frame.phis[index] = match output.report.phi {
                Some(phi) => phi,
                None if frame.wants_phi && tells => phi(robot, &self.composed),
                None => f64::NAN,
            };
            frame.outcomes[index] = output.report.outcome;
            frame.missing[index] = robot.misses_somebody();
            frame.modes[index] = output.report.mode;
            frame.values[index] = liars.value(index, robot.value());
            frame.held[index] = robot.value();
            if self.lists {
                frame.counted[index].clear();
                frame.counted[index].extend(robot.counted().map(|id| id.0));
                frame.rows[index].clear();
                frame.rows[index].extend(robot.keeps_rows_for().map(|id| id.0));
            }
            ends += u32::from(output.report.degree);
            if output.report.round.is_some() {
                let [counted, [all, liars]] = heard(robot, &self.malicious);
                // A robot whose clock differs may end two rounds of its own in one of the world.
                let [all_before, liars_before] = frame.listened[index];
                frame.heard[index] = counted;
                frame.listened[index] = [all.max(all_before), liars.max(liars_before)];
            }
        }
        frame.links = ends / 2;
    }
}

/// The bytes of a message of `robot`.
fn encode<const D: usize>(
    robot: &Robot<D, Vec<Slot<D>>>,
    message: &Message,
    buffer: &mut [u8],
) -> Option<Bytes> {
    let length = robot.encode(message, buffer)?;
    Some(Bytes::from(&buffer[..length]))
}

/// What is known of a robot that is down: how it moves. It has no φ_i and solves no program; the rest stays as it was.
fn stand<const D: usize>(index: usize, frame: &mut Frame<D>, downtime: &Downtime) {
    frame.velocities_m_s[index] = downtime.without_command(index, frame.velocities_m_s[index]);
    frame.missing[index] = false;
    frame.modes[index] = Mode::Stopped;
    frame.outcomes[index] = Outcome::Free;
    frame.phis[index] = f64::NAN;
}

fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap_or(u16::MAX))
}

/// Gives a robot slots for so many more neighbours than it has, up to `most`.
fn make_room<const D: usize>(robot: &mut Robot<D, Vec<Slot<D>>>, others: usize, most: usize) {
    let needed = (robot.neighbors().len() + others).min(most);
    if robot.slot_count() < needed {
        robot.change_slots(|slots| {
            slots.resize(needed.next_multiple_of(SLOTS_FIRST).min(most), Slot::default());
        });
    }
}

/// φ_i of a robot whose controller does not use it, from what it senses and was told.
fn phi<const D: usize>(robot: &Robot<D, Vec<Slot<D>>>, composed: &Composed) -> f64 {
    let slots = || robot.neighbors().iter();
    let distances_m2 = slots().map(|slot| dot(&slot.offset_m(), &slot.offset_m()));
    composed.phi(robot.told_level(), slots().filter_map(Slot::told_level), distances_m2)
}

/// How many values of robots that count for it a robot used in its round, and how many of them were those of normal robots; and how
/// many values it used at all, and how many of them were those of malicious robots.
fn heard<const D: usize>(robot: &Robot<D, Vec<Slot<D>>>, malicious: &[bool]) -> [[u16; 2]; 2] {
    let spoke = robot.neighbors().iter().filter(|slot| slot.told_value().is_some() && robot.listens_to(slot));
    let [mut counted, mut normal, mut all, mut liars] = [0; 4];
    for slot in spoke {
        let (counts, lies) = (robot.counts(slot), malicious[usize::from(slot.id().0) - 1]);
        all += 1;
        counted += u16::from(counts);
        normal += u16::from(counts && !lies);
        liars += u16::from(lies);
    }
    [[counted, normal], [all, liars]]
}
