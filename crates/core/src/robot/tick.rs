//! How a robot ends a tick: its decision, and what it says of it.

use core::time::Duration;

use crate::controller::{Decision, Standing, View};
use crate::equations::barrier::degree_barrier;
use crate::num::{Vector, is_finite};
use crate::program::Outcome;
use crate::robot::neighbor::Slot;
use crate::robot::report::{Mode, Output, Reason, Report, RoundReport, small};
use crate::robot::scratch::Scratch;
use crate::robot::{Robot, Slots};

impl<const D: usize, S: Slots<D>> Robot<D, S> {
    /// Ends the tick: the velocity closest to `desired` (m/s) that its controller allows, and W-MSR if a round is on.
    ///
    /// With a `scratch` that is too short for the robot it stands still and says so ([`Reason::Scratch`]).
    pub fn tick(&mut self, desired: Vector<D>, scratch: &mut Scratch<'_, D>) -> Output<D> {
        if !scratch.is_for(self.slots.as_ref().len()) {
            return self.stand(Mode::Degraded(Reason::Scratch), None);
        }
        let round = self.end_round(scratch.values);
        let sensed = core::mem::take(&mut self.sensed_now);
        let Some(position) = self.position.filter(|_| sensed) else {
            self.assurance.lose(self.now);
            let unknown = self.position.is_none();
            return self
                .stand(if unknown { Mode::Stopped } else { Mode::Degraded(Reason::NotSensed) }, round);
        };
        let (known, unshared) = (is_finite(&desired), self.now >= self.poll_at());
        let desired = if known { desired } else { [0.0; D] };
        if self.params.controller().reckons() {
            self.settle();
        }
        let decision = self.params.controller().alone(&self.view(), &desired, scratch);
        self.before = decision.velocity_m_s;
        self.ledger.wish_m_s = self.params.settings().limits.input.clip(&desired);
        self.assurance.doubt(self.now, decision.doubt);
        let mut report = self.report(Some(&decision), round);
        if !known {
            report.mode = Mode::Hold;
        } else if unshared {
            report.mode = Mode::Degraded(Reason::NotShared);
        }
        self.assurance.moved(self.now, position, decision.velocity_m_s);
        Output { velocity_m_s: decision.velocity_m_s, report }
    }

    /// What the controller is given in this tick.
    pub(crate) fn view(&self) -> View<'_, D> {
        View {
            id: self.id,
            rank: self.rank,
            now: self.now,
            told_level: self.told_level,
            position_m: self.position.unwrap_or([f64::NAN; D]),
            before_m_s: self.before,
            ledger: &self.ledger,
            slots: self.neighbors(),
            strangers: self.strangers(),
        }
    }

    /// What the robot says after a decision; `None` where it could not decide.
    pub(crate) fn report(&self, decision: Option<&Decision<D>>, round: Option<RoundReport>) -> Report {
        let degree = small(self.linked().count());
        let waits = self.params.controller().tells_levels();
        let untold = small(self.linked().filter(|slot| waits && slot.told_level().is_none()).count());
        let oldest = self.sensed().filter_map(|slot| slot.told.map(|told| told.at)).min();
        let need = self.params.need().need(self.member());
        let counts = |slot: &&Slot<D>| self.params.need().counts(self.member(), slot.member());
        let counted = small(self.linked().filter(counts).count());
        let h = degree_barrier(self.level, need);
        let phi = decision.and_then(|decision| decision.phi);
        let outcome = decision.map_or(Outcome::Infeasible, |decision| decision.outcome);
        Report {
            degree,
            degree_margin: i32::from(counted) - i32::from(need),
            level: self.level,
            h,
            phi,
            outcome,
            mode: self.mode(Standing { degree: 0, need, h, phi, outcome, untold, missing: 0, reason: None }),
            untold,
            told_age_max: oldest.map_or(Duration::ZERO, |at| self.now.since(at)),
            round,
        }
    }

    /// What the answer is worth. With stated errors, whoever is in sight may be a neighbour.
    fn mode(&self, standing: Standing) -> Mode {
        let reason = self.assurance.reason(self.now, self.params.settings().clock.told_max);
        let missing = small(self.neighbors().iter().filter(|slot| slot.is_missing()).count());
        let in_view = self.neighbors().iter().filter(|slot| slot.sensed || slot.is_missing());
        let degree = small(in_view.filter(|slot| self.counts(slot)).count());
        self.params.controller().mode(&Standing { degree, missing, reason, ..standing })
    }

    /// Stands still in a `mode` that says why.
    pub(crate) fn stand(&self, mode: Mode, round: Option<RoundReport>) -> Output<D> {
        let report = self.report(None, round);
        Output { velocity_m_s: [0.0; D], report: Report { mode, ..report } }
    }
}
