//! What every answer of a robot must keep.

use closeranks_core::num::{Vector, is_finite};
use closeranks_core::program::Outcome;
use closeranks_core::robot::neighbor::Slot;
use closeranks_core::robot::report::{Mode, Output, Reason, Report};

use super::calls::Play;

impl<const D: usize> Play<'_, D> {
    /// After any call: what it holds is finite, in order and no more than there is memory for.
    pub(super) fn check_state(&self) {
        let robot = &self.robot;
        let [low, high] = self.hull;
        assert!((low..=high).contains(&robot.value()), "{} left {low} to {high}", robot.value());
        assert!(robot.told_level().is_finite());
        assert!(robot.neighbors().len() <= self.slots);
        assert!(robot.neighbors().is_sorted_by(|a, b| a.id() < b.id()));
        for slot in robot.neighbors() {
            assert!(is_finite(&slot.offset_m()) && slot.link().weight.is_finite(), "{slot:?}");
            assert!(slot.told_level().is_none_or(f64::is_finite), "{slot:?}");
        }
    }

    /// After a tick that began with so many neighbours: the velocity is in its box, the report is of numbers, the mode does not
    /// promise too much.
    pub(super) fn check_answer(&self, desired: &Vector<D>, before: usize, output: &Output<D>) {
        let Output { velocity_m_s, report } = output;
        let input = &self.params.settings().limits.input;
        assert!(is_finite(velocity_m_s) && input.contains(velocity_m_s), "{velocity_m_s:?} in {input:?}");
        self.check_numbers(report);
        self.check_round(report, before);
        if !self.placed {
            assert_eq!((report.mode, *velocity_m_s), (Mode::Stopped, [0.0; D]));
        }
        if self.placed && !self.sensed {
            assert_eq!((report.mode, *velocity_m_s), (Mode::Degraded(Reason::NotSensed), [0.0; D]));
            return;
        }
        if !is_finite(desired) {
            assert!(matches!(report.mode, Mode::Hold | Mode::Stopped), "{report:?}");
            assert!(report.outcome != Outcome::Free || *velocity_m_s == [0.0; D], "{velocity_m_s:?}");
        }
        // With a margin, or while neighbours are missing, what is sensed may be less than what is promised to be there.
        let missing = self.robot.neighbors().iter().any(Slot::is_missing);
        let exact = self.params.kept().errors.offset_m == 0.0 && !missing;
        if report.mode == Mode::Guaranteed && exact {
            // A neighbour that is counted on may not be sensed for a while.
            let unseen = self.params.controller().tells_lists();
            assert!((unseen || report.degree_margin >= 0) && report.h >= 0.0, "{report:?}");
        }
    }

    fn check_numbers(&self, report: &Report) {
        let largest = 1.0 / f64::from(self.params.settings().team.robots);
        assert!(report.phi.is_none_or(|phi| phi.is_finite() && phi <= largest), "{report:?}");
        assert!(report.h.is_finite() && report.level.is_finite() && report.level >= 0.0, "{report:?}");
        assert!(usize::from(report.degree) <= self.slots && report.untold <= report.degree, "{report:?}");
    }

    /// A round counts the neighbours with which the tick began. Some of them may be forgotten in the same tick, because they must be gone.
    fn check_round(&self, report: &Report, before: usize) {
        let Some(round) = report.round else { return };
        let neighbors = self.robot.neighbors();
        let all = usize::from(round.kept) + usize::from(round.discarded) + usize::from(round.silent);
        assert_eq!(all, before, "{round:?}");
        let discarded = neighbors.iter().filter(|slot| slot.discarded()).count();
        let forgotten = before - neighbors.len();
        assert!((discarded..=discarded + forgotten).contains(&usize::from(round.discarded)), "{round:?}");
    }
}
