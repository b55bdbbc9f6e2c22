//! Whether a consensus round met the conditions under which values must come closer.

use crate::faults::Clocks;
use crate::frame::Frame;
use crate::scenario::Scenario;

/// What robots heard in a round.
///
/// The spread shrinks by 1 − β/2 if every normal robot used, of values of this round, at least `F′ = F + ⌊n/2⌋` of robots that
/// told all the same (thm:contraction), or `F + ⌊(n − a)/2⌋` of normal ones, a the number of malicious robots (thm:two-faced). Only who
/// is heard matters to the proofs, so messages may be lost. All normal robots must run and keep the same time.
#[derive(Clone, Debug)]
pub(crate) struct Heard {
    one_voice: bool,
    same_time: bool,
    steady: bool,
    values: Vec<[u16; 2]>,
    required: u16,
    required_normal: u16,
}

/// True if no value of a round can be taken for one of the next: it is told up to `hold_max` late, with a level up to τ₁ older,
/// and clocks may differ.
fn in_time(scenario: &Scenario) -> bool {
    let late = scenario.clock.hold_max.unwrap_or(scenario.clock.level_period)
        + scenario.clock.level_period
        + scenario.clock.error;
    scenario.faults.network.delay_max_s == 0.0 || late <= scenario.clock.value_period
}

impl Heard {
    /// For the robots of `scenario`.
    #[must_use]
    pub(crate) fn new(scenario: &Scenario) -> Self {
        let malicious = u16::try_from(scenario.malicious.len()).unwrap_or(u16::MAX);
        Self {
            one_voice: scenario.attack.has_one_voice(),
            same_time: scenario.faults.clocks == Clocks::default() && in_time(scenario),
            steady: false,
            values: Vec::new(),
            required: scenario.team.faults + scenario.team.robots / 2,
            required_normal: scenario.team.faults + scenario.team.robots.saturating_sub(malicious) / 2,
        }
    }

    /// Takes in a tick.
    pub(crate) fn hear<const D: usize>(&mut self, frame: &Frame<D>) {
        self.steady &= !frame.assumptions.unsteady;
        self.values.clone_from(&frame.heard);
    }

    /// Ends a round with the tick in which the next one begins, and normal robots take up their new values. True when what
    /// was heard must have brought values closer.
    pub(crate) fn end_round<const D: usize>(&mut self, frame: &Frame<D>, malicious: &[bool]) -> bool {
        let enough = |&[all, normal]: &[u16; 2]| {
            (self.one_voice && all >= self.required) || normal >= self.required_normal
        };
        let mut normal = self.values.iter().zip(malicious).filter(|(_, malicious)| !**malicious);
        let enough = normal.all(|(heard, _)| enough(heard));
        let steady = core::mem::replace(&mut self.steady, true) && !frame.assumptions.unsteady;
        self.same_time && steady && enough
    }
}
