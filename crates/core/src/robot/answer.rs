//! How a robot makes its report about a tick.

use core::time::Duration;

use crate::controller::{Decision, Standing};
use crate::equations::barrier::degree_barrier;
use crate::program::Outcome;
use crate::robot::neighbor::Slot;
use crate::robot::report::{Mode, Output, Report, RoundReport, small};
use crate::robot::{Robot, Slots};

impl<const D: usize, S: Slots<D>> Robot<D, S> {
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
