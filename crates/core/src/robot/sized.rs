//! A robot with all its memory in one value of fixed size, for firmware and for whoever has a single robot.

use core::ops::Deref;

use crate::controller::links::wire::Notice;
use crate::message::Message;
use crate::num::Vector;
use crate::obstacle::Obstacle;
use crate::robot::Robot;
use crate::robot::error::{ObserveError, Observed, ReceiveError, RobotError, SenseError};
use crate::robot::memory::RobotMemory;
use crate::robot::neighbor::{Member, RobotId, Slot};
use crate::robot::report::Output;
use crate::settings::params::Params;
use crate::time::Instant;

/// A [`Robot`] for up to `N` neighbours with its [`RobotMemory`]. What a robot can be asked, this can be asked too.
///
/// `K` rows a neighbour are enough without stated errors; otherwise [`new`](Self::new) says how many are needed.
#[derive(Debug)]
pub struct SizedRobot<const D: usize, const N: usize, const K: usize = 10> {
    robot: Robot<D, [Slot<D>; N]>,
    memory: RobotMemory<D, N, K>,
}

impl<const D: usize, const N: usize, const K: usize> SizedRobot<D, N, K> {
    /// A robot with initial value `y_i(t₀)`; see [`Robot::new`] and [`RobotMemory::new`] for what is refused.
    pub fn new(params: Params<D>, own: impl Into<Member>, value: f64) -> Result<Self, RobotError> {
        let memory = RobotMemory::new(&params)?;
        Ok(Self { robot: Robot::new(params, own, value, [Slot::default(); N])?, memory })
    }

    /// See [`Robot::restart`].
    pub fn restart(&mut self, value: f64) -> Result<(), RobotError> {
        self.robot.restart(value)
    }

    /// See [`Robot::sense`].
    pub fn sense(&mut self, now: Instant, position: Vector<D>) -> Result<(), SenseError> {
        self.robot.sense(now, position)
    }

    /// See [`Robot::observe`].
    pub fn observe(
        &mut self,
        other: impl Into<Member>,
        position: Vector<D>,
    ) -> Result<Observed, ObserveError> {
        self.robot.observe(other, position)
    }

    /// See [`Robot::observe_stranger`].
    pub fn observe_stranger(
        &mut self,
        other: RobotId,
        position: Vector<D>,
    ) -> Result<Observed, ObserveError> {
        self.robot.observe_stranger(other, position)
    }

    /// See [`Robot::dismiss`].
    pub fn dismiss(&mut self, id: RobotId) {
        self.robot.dismiss(id);
    }

    /// See [`Robot::share`].
    pub fn share(&mut self) -> Option<Message> {
        self.robot.share(&mut self.memory.scratch())
    }

    /// Shares as [`share`](Self::share) does, among the obstacles of `map`: whoever knows of some that cut links must say so here too.
    pub fn share_among(&mut self, map: &[Obstacle<D>]) -> Option<Message> {
        self.robot.share(&mut self.memory.scratch().among(map))
    }

    /// See [`Robot::receive`].
    pub fn receive(&mut self, sender: RobotId, message: &Message) -> Result<(), ReceiveError> {
        self.robot.receive(sender, message)
    }

    /// See [`Robot::receive_bytes`].
    pub fn receive_bytes(&mut self, sender: RobotId, bytes: &[u8]) -> Result<(), ReceiveError> {
        self.robot.receive_bytes(sender, bytes)
    }

    /// See [`Robot::receive_notice`].
    pub fn receive_notice(&mut self, sender: RobotId, notice: &Notice<D>) -> Result<(), ReceiveError> {
        self.robot.receive_notice(sender, notice)
    }

    /// See [`Robot::restate`].
    pub fn restate(&mut self, level: f64) {
        self.robot.restate(level);
    }

    /// See [`Robot::tick`].
    pub fn tick(&mut self, desired: Vector<D>) -> Output<D> {
        self.robot.tick(desired, &mut self.memory.scratch())
    }

    /// Ends the tick as [`tick`](Self::tick) does, among the obstacles of `map`; see [`Scratch::among`](crate::robot::scratch::Scratch::among).
    pub fn tick_among(&mut self, desired: Vector<D>, map: &[Obstacle<D>]) -> Output<D> {
        self.robot.tick(desired, &mut self.memory.scratch().among(map))
    }
}

impl<const D: usize, const N: usize, const K: usize> Deref for SizedRobot<D, N, K> {
    type Target = Robot<D, [Slot<D>; N]>;

    fn deref(&self) -> &Self::Target {
        &self.robot
    }
}
