//! What every engine does: compute all robots of a tick.

use closeranks_core::controller::AtOnce;
use closeranks_core::num::Vector;
use closeranks_core::robot::Robot;

use crate::attack::liars::Liars;
use crate::engine::fleet::Fleet;
use crate::engine::held::Held;
use crate::engine::lanes::composed::Lent;
use crate::engine::team::Team;
use crate::engine::workers::Workers;
use crate::faults::edges::Edges;
use crate::frame::Frame;
use crate::transport::{Bytes, Transport};

/// Computes the robots of a run. A world can go from thread to thread, and so can they.
pub(crate) trait Robots<const D: usize>: Send + Sync {
    /// One tick: fills everything in `frame` but positions, desired velocities, references and assumptions.
    fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars, workers: &dyn Workers);

    /// What computing this team side by side with others takes; `None` where that is not how it is computed.
    fn lend(&mut self) -> Option<Lent<'_>> {
        None
    }

    /// This team if it is one of held links that can be computed side by side with others.
    fn lend_held(&mut self) -> Option<&mut Held<D>> {
        None
    }

    /// What went wrong around the robots in this tick; `None` where nothing can.
    fn edges(&self) -> Option<&Edges<D>> {
        None
    }

    /// Adds the indices of those whose values of the round that is on `robot` has; false where the network is perfect, so that these are
    /// all within R.
    fn heard(&self, _robot: usize, _senders: &mut Vec<u16>) -> bool {
        false
    }

    /// What each robot told everybody in this tick, as bytes; nothing where no other team is there to hear it.
    fn told(&mut self) -> Vec<Option<Bytes>> {
        Vec::new()
    }

    /// True if `robot` reckons with one of `these` that it does not sense.
    fn reckons_unseen(&self, _robot: usize, _these: &[bool]) -> bool {
        false
    }

    /// Where robot `index` counts itself in this tick, if it keeps a reference of its own.
    fn counted(&self, _index: usize) -> Option<Counted<D>> {
        None
    }
}

/// Where a robot counts itself.
pub(crate) struct Counted<const D: usize> {
    /// The place, m.
    pub(crate) place_m: Vector<D>,
    /// True if it is not the last place plus the last move.
    pub(crate) began_anew: bool,
}

impl<const D: usize, T: Transport> Robots<D> for Fleet<D, T>
where
    Self: Send + Sync,
{
    fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars, _workers: &dyn Workers) {
        self.step(frame, liars);
    }

    fn edges(&self) -> Option<&Edges<D>> {
        Some(self.edges())
    }

    fn heard(&self, robot: usize, senders: &mut Vec<u16>) -> bool {
        let neighbors = self.running(robot).into_iter().flat_map(Robot::neighbors);
        senders.extend(neighbors.filter(|slot| slot.told_value().is_some()).map(|slot| slot.id().0 - 1));
        true
    }

    fn told(&mut self) -> Vec<Option<Bytes>> {
        self.told()
    }

    fn reckons_unseen(&self, robot: usize, these: &[bool]) -> bool {
        self.reckons_unseen(robot, these)
    }

    fn counted(&self, index: usize) -> Option<Counted<D>> {
        let robot = self.running(index)?;
        Some(Counted { place_m: robot.reference()?, began_anew: robot.began_anew() })
    }
}

impl<const D: usize, C: AtOnce<D> + Copy> Robots<D> for Team<D, C>
where
    Self: Send + Sync,
{
    fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars, workers: &dyn Workers) {
        self.step(frame, liars, workers);
    }

    fn lend(&mut self) -> Option<Lent<'_>> {
        self.lend()
    }
}

impl<const D: usize> Robots<D> for Held<D>
where
    Self: Send + Sync,
{
    fn step(&mut self, frame: &mut Frame<D>, liars: &mut Liars, workers: &dyn Workers) {
        self.step(frame, liars, workers);
    }

    fn lend_held(&mut self) -> Option<&mut Held<D>> {
        self.in_lanes().is_some().then_some(self)
    }
}
