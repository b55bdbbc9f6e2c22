//! What robots tell each other in a tick, and how it gets there.

use closeranks_core::controller::links::wire::LinkMessage;
use closeranks_core::message::Message;
use closeranks_core::obstacle::is_cut;
use closeranks_core::robot::Robot;
use closeranks_core::robot::neighbor::Slot;

use crate::attack::liars::{Face, Liars};
use crate::engine::fleet::{Fleet, id};
use crate::frame::Frame;
use crate::transport::{Bytes, Parcel, Transport};

impl<const D: usize, T: Transport> Fleet<D, T> {
    /// Every robot shares; by Assumption 1 liars hold the level that they tell.
    pub(super) fn share(&mut self, liars: &mut Liars) {
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
    pub(super) fn hand_over(&mut self) {
        if self.lists {
            self.hand_over_lists();
        } else {
            self.hand_over_messages();
        }
    }

    fn hand_over_messages(&mut self) {
        for (receiver, robot) in self.robots.iter_mut().enumerate() {
            // All others are refused: they are out of range.
            self.others.clear();
            self.others.extend(robot.neighbors().iter().map(|slot| usize::from(slot.id().0) - 1));
            for sender in self.others.iter().filter(|sender| **sender != receiver) {
                if let Some(message) = &self.outbox[*sender] {
                    let _ = robot.receive(id(*sender), message);
                }
            }
        }
    }

    fn hand_over_lists(&mut self) {
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

    /// Bytes to every other robot that they can reach, each with its own fate.
    pub(super) fn send(&mut self, liars: &mut Liars) {
        let mut receivers = core::mem::take(&mut self.others);
        for (sender, message) in self.outbox.iter().enumerate() {
            let Some(message) = message else { continue };
            let own = &self.robots[sender];
            let all = encode(own, message, &mut self.buffer);
            self.reach.receivers(sender, self.robots.len(), &mut receivers);
            receivers.retain(|receiver| !self.is_cut(sender, *receiver));
            for &receiver in &receivers {
                let robot = &self.robots[receiver];
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
        self.others = receivers;
    }

    /// Robots refuse what is no message, and what comes from out of range. What has been on its way for long must not meet an obstacle
    /// at the end either.
    pub(super) fn deliver(&mut self) {
        let parcels: Vec<Parcel> = core::iter::from_fn(|| self.transport.poll()).collect();
        // Lists that went to many robots are parsed once, as long as nothing else comes between.
        let mut read: Option<(&Bytes, Option<LinkMessage<'_, D>>)> = None;
        for Parcel { sender, receiver, bytes } in &parcels {
            if self.is_cut(*sender, *receiver) {
                continue;
            }
            let robot = &mut self.robots[*receiver];
            if self.edges.downtime.down(*receiver) || !robot.knows(id(*sender)) {
                continue;
            }
            if !self.lists {
                let _ = robot.receive_bytes(id(*sender), bytes);
                continue;
            }
            let (_, message) = match read {
                Some(read) if read.0.is_shared_with(bytes) => read,
                _ => *read.insert((bytes, LinkMessage::parse(bytes).ok())),
            };
            let _ = message.map(|message| robot.receive_notice(id(*sender), &message.to(id(*receiver))));
        }
    }

    /// Robots of other teams that are near are heard too, a tick late. Nobody listens to them.
    //= theory sec:strangers
    pub(super) fn overhear(&mut self, frame: &Frame<D>) {
        let (team, told) = (self.robots.len(), &frame.strangers.told);
        if told.is_empty() {
            return;
        }
        for (receiver, robot) in self.robots.iter_mut().enumerate() {
            if self.edges.downtime.down(receiver) {
                continue;
            }
            self.others.clear();
            self.others.extend(robot.strangers().iter().map(|slot| usize::from(slot.id().0) - 1));
            for sender in &self.others {
                if is_cut(&self.cutting, &self.plane_m[receiver], &self.plane_m[*sender]) {
                    continue;
                }
                if let Some(Some(bytes)) = told.get(sender - team) {
                    let _ = robot.receive_bytes(id(*sender), bytes);
                }
            }
        }
    }

    /// What each robot told everybody in this tick, as bytes.
    pub(crate) fn told(&mut self) -> Vec<Option<Bytes>> {
        let Self { robots, outbox, buffer, .. } = self;
        let messages = robots.iter().zip(&*outbox);
        messages.map(|(robot, message)| encode(robot, message.as_ref()?, buffer)).collect()
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
