//! Whether a consensus round met the conditions under which values must come closer.

use std::sync::Arc;

use crate::faults::Clocks;
use crate::frame::Frame;
use crate::monitors::rule::Rule;
use crate::scenario::Scenario;

/// What robots heard in a round.
///
/// The spread shrinks by 1 − β/2 if every normal robot used, of values of this round, at least `F′ = F + ⌊n/2⌋` of robots that
/// told all the same (thm:contraction), or `F + ⌊(n − a)/2⌋` of normal ones, a the number of malicious robots (thm:two-faced).
/// With ranks this holds of the core, and any other normal robot must have used the values of more than F normal robots of lower
/// ranks (thm:ranks). Only who is heard matters to the proofs, so messages may be lost. All normal robots must run and keep
/// the same time, and at most F of those that a normal robot listens to may be malicious.
#[derive(Clone, Debug)]
pub(crate) struct Heard {
    one_voice: bool,
    same_time: bool,
    steady: bool,
    values: Vec<[u16; 2]>,
    /// Values used, and how many of them were those of malicious robots; empty without ranks.
    listened: Vec<[u16; 2]>,
    rule: Arc<Rule>,
    /// How many of those that all count for each other are malicious.
    among: u16,
    void: Void,
}

/// What a round came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Met {
    /// What was heard must have brought values closer.
    pub(crate) suffices: bool,
    /// Some normal robot listened to more malicious robots than it is prepared for: values may be anything.
    pub(crate) is_void: bool,
    /// The most values that a normal robot used.
    pub(crate) most_heard: u16,
}

/// Rounds of which nothing is promised: more than F of those that some normal robot listened to were malicious.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Void {
    /// How many.
    pub rounds: u32,
    /// The tick in which the first of them ended, a robot, and how many malicious ones it listened to.
    pub first: Option<(u32, u16, u16)>,
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
    /// For the robots of `scenario`, who count for each other by `rule`.
    #[must_use]
    pub(crate) fn new(scenario: &Scenario, rule: &Arc<Rule>) -> Self {
        let in_core = |robot: u16| rule.ranks().is_none_or(|ranks| ranks[usize::from(robot) - 1] == 0);
        let among = scenario.malicious.iter().filter(|robot| in_core(**robot)).count();
        Self {
            one_voice: scenario.attack.has_one_voice(),
            same_time: scenario.faults.clocks == Clocks::default() && in_time(scenario),
            steady: false,
            values: Vec::new(),
            listened: Vec::new(),
            rule: Arc::clone(rule),
            among: u16::try_from(among).unwrap_or(u16::MAX),
            void: Void::default(),
        }
    }

    /// Takes in a tick.
    pub(crate) fn hear<const D: usize>(&mut self, frame: &Frame<D>) {
        self.steady &= !frame.assumptions.unsteady;
        self.values.clone_from(&frame.heard);
        if self.rule.ranks().is_some() {
            self.listened.clone_from(&frame.listened);
        }
    }

    /// Rounds of which nothing is promised.
    pub(crate) fn void(&self) -> &Void {
        &self.void
    }

    /// Ends a round with the tick in which the next one begins, and all but those `aside` take up their new values.
    pub(crate) fn end_round<const D: usize>(&mut self, tick: u32, frame: &Frame<D>, aside: &[bool]) -> Met {
        let is_void = self.watch_liars(tick, aside);
        let mut normal = self.values.iter().enumerate().filter(|(robot, _)| !aside[*robot]);
        let most_heard = self.listened.iter().map(|[all, _]| *all).max().unwrap_or(0);
        let enough =
            normal.all(|(robot, heard)| self.rule.hears_enough(robot, *heard, self.one_voice, self.among));
        let steady = core::mem::replace(&mut self.steady, true) && !frame.assumptions.unsteady;
        Met { suffices: self.same_time && steady && enough && !is_void, is_void, most_heard }
    }

    /// True if a normal robot listened to too many malicious ones, which is noted.
    fn watch_liars(&mut self, tick: u32, aside: &[bool]) -> bool {
        let robots = (1_u16..).zip(&self.listened).zip(aside);
        let mut normal = robots.filter(|(_, lies)| !**lies).map(|((robot, [_, liars]), _)| (robot, *liars));
        let Some((robot, liars)) = normal.find(|(_, liars)| *liars > self.rule.faults()) else {
            return false;
        };
        self.void.rounds += 1;
        self.void.first.get_or_insert((tick, robot, liars));
        true
    }
}
