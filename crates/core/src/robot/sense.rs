//! What a robot senses: the time, where it is, and where others are.

use crate::controller::links::peer::Ledger;
use crate::controller::links::protocol::Number;
use crate::equations::link::Link;
use crate::num::{Vector, dot, is_finite, subtract};
use crate::robot::error::{ObserveError, Observed, SenseError};
use crate::robot::neighbor::{Member, NO_LINK, RobotId};
use crate::robot::{Robot, Slots};
use crate::time::Instant;

impl<const D: usize, S: Slots<D>> Robot<D, S> {
    /// Begins a tick at `now` with the robot's own position x_i, m.
    pub fn sense(&mut self, now: Instant, position: Vector<D>) -> Result<(), SenseError> {
        (self.position, self.sensed_now) = (None, true);
        let went_m = self.horizon().went_m(now.since(self.now));
        for slot in &mut self.slots.as_mut()[..self.count] {
            slot.seen_before = slot.sensed;
            slot.sensed = false;
            slot.unsensed_m = 0.0;
            slot.gone_m += went_m;
        }
        if now < self.now {
            return Err(SenseError::TimeFell);
        }
        self.now = now;
        if self.ledger.looked_at.is_none() && self.count == 0 {
            // Numbers of earlier lives are not above the time at which this one begins.
            self.ledger = Ledger::begin(self.ledger.numbers.last().max(Number(now.as_nanos())));
        }
        if !is_finite(&position) {
            return Err(SenseError::NotFinite);
        }
        let promises = self.params.controller().promises();
        let place = if promises { self.assurance.place(&self.params, now, position) } else { position };
        self.position = Some(place);
        Ok(())
    }

    /// Takes the sensed position of another robot, m.
    ///
    /// Under ranks `other` is a [`Member`], with the rank that the roster has; a number alone stands for rank 0.
    pub fn observe(
        &mut self,
        other: impl Into<Member>,
        position: Vector<D>,
    ) -> Result<Observed, ObserveError> {
        let Member { id, rank } = other.into();
        if id == self.id {
            return Err(ObserveError::OwnId);
        }
        let without = if self.is_member(id) { ObserveError::NoPosition } else { ObserveError::UnknownId };
        self.see(Member { id, rank }, position, without)
    }

    /// Takes the sensed position of a robot of another team, m. Nothing is kept towards it but the distance.
    ///
    /// Whoever owns the robot knows its roster, 1 to n, and gives other robots numbers above n, each its own for as long as it is
    /// sensed. A robot of another team needs a slot like a neighbour.
    //= theory sec:strangers
    pub fn observe_stranger(
        &mut self,
        other: RobotId,
        position: Vector<D>,
    ) -> Result<Observed, ObserveError> {
        if other.0 <= self.params.settings().team.robots {
            return Err(self.refuse(ObserveError::Member));
        }
        let seen = self.see(other.into(), position, ObserveError::NoPosition)?;
        Ok(if seen == Observed::Neighbor { Observed::Stranger } else { seen })
    }

    /// Takes a sensed position; `without` is the error of a robot that has none itself, or that knows nobody of this number.
    fn see(
        &mut self,
        Member { id, rank }: Member,
        position: Vector<D>,
        without: ObserveError,
    ) -> Result<Observed, ObserveError> {
        let own = self.position.ok_or(without)?;
        let offset_m = subtract(&own, &position);
        let distance_m2 = dot(&offset_m, &offset_m);
        let link = self.link_at(distance_m2);
        let far = link.is_none() && distance_m2 > self.params.sight_m2();
        if without == ObserveError::UnknownId {
            return Err(if far { without } else { self.refuse(without) });
        }
        if !is_finite(&position) {
            return Err(self.refuse(ObserveError::NotFinite));
        }
        if far {
            self.lose(id, &offset_m);
            return Ok(Observed::OutOfRange);
        }
        let index = self.slot(id).map_err(|error| self.refuse(error))?;
        let slot = &mut self.slots.as_mut()[index];
        if slot.seen_before && self.params.controller().promises() {
            self.assurance.watch(&self.params, self.now, slot, &offset_m);
        }
        let differs = slot.sensed && (slot.position_m != position || slot.rank != rank);
        slot.rank = rank;
        (slot.sensed, slot.seen_before, slot.offset_m) = (true, false, offset_m);
        (slot.position_m, slot.sensed_at) = (position, self.now);
        (slot.gone_m, slot.unsensed_m) = (0.0, 0.0);
        (slot.linked, slot.link) = (link.is_some(), link.unwrap_or(NO_LINK));
        if differs {
            self.overlook();
        }
        Ok(if link.is_some() { Observed::Neighbor } else { Observed::InView })
    }

    /// The link of this squared length, m²; `None` beyond R. Who keeps lists has no use for its weight.
    pub(crate) fn link_at(&self, distance_m2: f64) -> Option<Link<f64>> {
        let shape = self.params.link();
        if self.params.controller().tells_lists() {
            return (distance_m2 <= shape.radius_m * shape.radius_m).then_some(NO_LINK);
        }
        shape.link_at(distance_m2)
    }
}
