//! The robots of a run, one by one, with every message as bytes through the network, and whatever goes wrong.
//!
//! This is the whole path that a robot in the world takes; [`crate::engine::team`] gives the same bits faster where the world is
//! perfect.

mod note;
mod reach;
mod talk;

use closeranks_core::controller::links::wire::{Notice, bytes_max};
use closeranks_core::equations::composition::Composed;
use closeranks_core::message::{MESSAGE_BYTES, Message};
use closeranks_core::num::Vector;
use closeranks_core::obstacle::{Obstacle, is_cut};
use closeranks_core::robot::Robot;
use closeranks_core::robot::error::RobotError;
use closeranks_core::robot::neighbor::{Member, RobotId, Slot};
use closeranks_core::settings::params::Params;

use crate::attack::liars::Liars;
use crate::engine::fleet::reach::Reach;
use crate::engine::memory::Memory;
use crate::engine::roster::Roster;
use crate::faults::edges::Edges;
use crate::faults::network::{FaultyNetwork, LATE_MAX};
use crate::frame::Frame;
use crate::geometry::squared_distance;
use crate::scenario::Scenario;
use crate::transport::Transport;
use crate::transport::memory::InMemory;

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
    /// Memory for those whom a robot hears, senses or tells something.
    others: Vec<usize>,
    /// Where everybody is in this tick, m: the team, and then robots of other teams.
    plane_m: Vec<Vector<D>>,
    /// Room for the longest message.
    buffer: Vec<u8>,
    transport: T,
    /// What no message goes through.
    cutting: Vec<Obstacle<D>>,
    edges: Edges<D>,
    /// Who can meet whom in this tick.
    reach: Reach,
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
        let others = values.len().saturating_sub(1) + usize::from(scenario.strangers);
        let slots = scenario.faults.sensing.dropouts.slots.map_or(others, usize::from);
        let (members, edges) =
            (Roster::new(scenario, &params).members().to_vec(), Edges::new(scenario, &params));
        let reach = Reach::new(scenario, &params);
        // Where it is known who is near, robots get slots when they need them.
        let first = if edges.sight.is_whole() || reach.is_near() { slots.min(SLOTS_FIRST) } else { slots };
        let robots = members
            .iter()
            .zip(values)
            .map(|(member, value)| Robot::new(params, *member, *value, vec![Slot::default(); first]));
        Ok(Self {
            robots: robots.collect::<Result<_, _>>()?,
            members,
            memory: Memory::new(&params, first).among(&scenario.obstacles.in_dimension()),
            composed: scenario.composition(),
            params,
            values: values.to_vec(),
            malicious: scenario.malicious_mask(),
            outbox: vec![None; values.len()],
            notices: None,
            others: Vec::new(),
            plane_m: Vec::new(),
            buffer: vec![0; MESSAGE_BYTES.max(bytes_max(scenario.team.robots, D))],
            transport,
            cutting: scenario.obstacles.cutting(),
            edges,
            reach,
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
            self.reach.look(&frame.positions_m);
            self.send(liars);
            self.deliver();
        }
        self.overhear(frame);
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

    /// True if no message gets from one robot to another where they are in this tick.
    fn is_cut(&self, one: usize, other: usize) -> bool {
        is_cut(&self.cutting, &self.plane_m[one], &self.plane_m[other])
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
        self.plane_m.clear();
        self.plane_m.extend(frame.positions_m.iter().chain(&frame.strangers.positions_m));
        self.edges.begin_tick(self.tick, time_s, &self.plane_m, &frame.presence);
        self.transport.begin_tick(self.tick);
        liars.begin_tick(self.tick);
        if frame.presence.changed {
            self.dismiss(&frame.presence.dismissed, 0);
        }
        self.dismiss(&frame.strangers.dismissed, frame.positions_m.len());
        for (index, robot) in self.robots.iter_mut().enumerate() {
            frame.down[index] = self.edges.downtime.down(index);
            if self.edges.downtime.reborn(index) {
                // The value was good once.
                let _ = robot.restart(self.values[index]);
                self.edges.sight.forget(index);
            }
        }
    }

    /// Everybody is told that these robots have left, of which the first has this index.
    fn dismiss(&mut self, dismissed: &[bool], first: usize) {
        for index in (0..dismissed.len()).filter(|index| dismissed[*index]).map(|index| first + index) {
            self.robots.iter_mut().for_each(|robot| robot.dismiss(id(index)));
            self.edges.sight.dismiss(index);
        }
    }

    /// True if the robot `index` reckons with one of `these` that it does not sense.
    #[must_use]
    pub fn reckons_unseen(&self, index: usize, these: &[bool]) -> bool {
        let slots = self.running(index).into_iter().flat_map(Robot::neighbors);
        slots.into_iter().any(|slot| these[usize::from(slot.id().0) - 1] && !slot.is_sensed())
    }

    fn sense(&mut self, frame: &Frame<D>) {
        let radius_m = self.params.link().radius_m;
        let Self { robots, members, memory, edges, reach, others, plane_m, slots, tick, .. } = self;
        let Edges { clocks, senses, sight, downtime } = edges;
        let whole = sight.is_whole();
        let gets_slots = whole || reach.is_near();
        if gets_slots {
            reach.look_around(plane_m, radius_m);
        }
        for (observer, robot) in robots.iter_mut().enumerate() {
            if downtime.down(observer) {
                continue;
            }
            let own = &frame.positions_m[observer];
            // Sensed positions are finite and clocks rise, so nothing here is refused unless slots are too few.
            let _ = robot.sense(clocks.now(observer, *tick), senses.sense(observer, observer, own));
            if gets_slots {
                make_room(robot, reach.around(observer).len(), *slots);
                memory.fit(robot.slot_count());
            }
            if whole {
                others.clear();
                others.extend(reach.around(observer).iter().map(|index| usize::from(*index)));
            } else {
                reach.seen(observer, plane_m.len(), sight.known(observer), others);
            }
            for &index in &*others {
                let position = &plane_m[index];
                let within = whole || squared_distance(own, position) <= radius_m * radius_m;
                if sight.senses((observer, own), index, within) {
                    let sensed = senses.sense(observer, index, position);
                    sight.note((observer, index), position, &sensed);
                    let _ = match members.get(index) {
                        Some(member) => robot.observe(*member, sensed),
                        None => robot.observe_stranger(id(index), sensed),
                    };
                }
            }
        }
    }
}

fn id(index: usize) -> RobotId {
    RobotId(u16::try_from(index + 1).unwrap_or(u16::MAX))
}

/// Gives a robot slots for so many more neighbours than it has, up to `most`.
fn make_room<const D: usize>(robot: &mut Robot<D, Vec<Slot<D>>>, others: usize, most: usize) {
    let known = robot.neighbors().len() + robot.strangers().len();
    let needed = (known + others).min(most);
    if robot.slot_count() < needed {
        robot.change_slots(|slots| {
            slots.resize(needed.next_multiple_of(SLOTS_FIRST).min(most), Slot::default());
        });
    }
}
