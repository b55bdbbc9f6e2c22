//! The theorem of `budget` from tick to tick: what was safe stays safe wherever its assumptions hold.

mod before;
pub(crate) mod between;
mod clear;
mod distance;
mod held;
mod mode;
mod report;
mod rest;
mod time;

use std::sync::Arc;

use closeranks_core::settings::params::Params;

use crate::frame::{Frame, Presence};
use crate::law::{Law, Verdicts, Violation};
use crate::monitors::carry::before::Before;
use crate::monitors::carry::clear::Clear;
use crate::monitors::carry::distance::Distances;
use crate::monitors::carry::held::Held;
use crate::monitors::carry::mode::ModeWatch;
use crate::monitors::carry::rest::RestWatch;
use crate::monitors::carry::time::{fraction, longer_ago};
use crate::monitors::glance::Glance;
use crate::monitors::glance::held::Lists;
use crate::monitors::rounding::level_rounding;
use crate::monitors::rule::Rule;
use crate::monitors::truth::{ROUNDING, Truth};
use crate::scenario::Scenario;

/// The tick before, and what has not held since when.
#[derive(Clone, Debug)]
pub(crate) struct Carry<const D: usize> {
    params: Params<D>,
    malicious: Vec<bool>,
    rule: Arc<Rule>,
    /// For how long a broken assumption is felt: as long as what was told in it is used.
    settle_ticks: u64,
    /// γ, the part of h that a tick may take; written down once more.
    gamma: f64,
    before: Option<Before<D>>,
    /// The last tick in which an assumption was broken.
    broken: Option<u32>,
    /// Robots that were safe once and must have been ever since: no assumption was broken.
    kept: Vec<bool>,
    distances: Distances<D>,
    held: Held<D>,
    clear: Clear<D>,
    /// What robots say of it, and how far they move.
    mode: ModeWatch<D>,
    rest: RestWatch<D>,
    /// Ticks, and those in which every assumption held.
    ticks: [u64; 2],
}

impl<const D: usize> Carry<D> {
    /// For the robots of `scenario`.
    #[must_use]
    pub(crate) fn new(scenario: &Scenario, params: Params<D>, rule: &Arc<Rule>) -> Self {
        let settings = params.settings();
        let aged = settings.clock.told_max + settings.clock.error;
        let told_ticks = aged.as_nanos().div_ceil(settings.clock.level_period.as_nanos().max(1));
        let told_ticks = u64::try_from(told_ticks).unwrap_or(u64::MAX).saturating_add(1);
        Self {
            malicious: scenario.malicious_mask(),
            rule: Arc::clone(rule),
            settle_ticks: if params.controller().remembers() { told_ticks } else { 0 },
            gamma: params.kept().gamma,
            mode: ModeWatch::new(scenario, params, rule, told_ticks),
            rest: RestWatch::new(scenario, params, rule),
            distances: Distances::new(scenario, params),
            held: Held::new(scenario, params, rule),
            clear: Clear::new(scenario, params),
            params,
            before: None,
            broken: None,
            kept: vec![false; usize::from(scenario.team.robots)],
            ticks: [0; 2],
        }
    }

    /// Takes what was true in the last tick, before `truth` is about the next one. What comes back says nothing any more.
    pub(crate) fn keep(&mut self, truth: &mut Truth) {
        if let Some(before) = &mut self.before {
            core::mem::swap(&mut before.truth, truth);
        }
    }

    /// Looks at one tick; what was true in the one before was [kept](Self::keep). `covered` is false where more robots lie than the team is prepared for.
    pub(crate) fn watch(
        &mut self,
        tick: u32,
        frame: &Frame<D>,
        truth: &Truth,
        covered: bool,
        verdicts: &mut Verdicts,
    ) {
        let mut before = self.before.take();
        if let Some(before) = &mut before {
            before.truth.pairs.catch_up(&before.positions_m);
        }
        self.distances.find(before.as_ref(), truth);
        let carried = before.as_ref().filter(|_| covered && !frame.assumptions.renewed);
        self.watch_h(tick, frame, truth, carried, verdicts);
        self.distances.watch(tick, frame, truth, carried, verdicts);
        self.clear.watch(tick, frame, before.as_ref(), verdicts);
        let moved = carried.is_some_and(|before| before.moves);
        let [moves, settled] = self.assume(tick, frame, covered);
        if self.lists() {
            self.held.watch(tick, frame, [moved, moves], verdicts);
        }
        if self.params.controller().promises() {
            self.mode.watch(tick, frame, truth, &self.clear.obstructed(frame), verdicts);
            self.rest.watch(tick, frame, truth, &self.clear, verdicts);
        }
        let now = before.unwrap_or_default();
        self.carry(frame, truth, &now, [moves, settled]);
        self.remember(now, frame, [moves, settled]);
    }

    /// Looks at a tick of a plain team from afar, with the same outcome: false if robots must be looked at, and then nothing was done.
    pub(crate) fn glance(&mut self, tick: u32, frame: &Frame<D>, glance: &Glance<'_>, covered: bool) -> bool {
        if let Some(lists) = &glance.lists {
            return self.glance_at_lists(tick, frame, (glance, lists), covered);
        }
        let required = f64::from(self.rule.required(0));
        let kept = glance.normal_level_min - required >= -ROUNDING && glance.degree_min >= required;
        let inside = glance.phi_min >= 0.0;
        let all_keep = inside && glance.level_min - required >= 0.0;
        // Who is outside carries what it had, and nothing new; who is inside and short of neighbours must be looked at.
        let clear = kept && (all_keep || !inside) && self.distances.are_far(glance);
        let Some(now) = self.before.take_if(|_| clear) else { return false };
        let [moves, settled] = self.assume(tick, frame, covered);
        match inside {
            true => self.kept.fill(settled),
            false if !(settled && now.settled) => self.kept.fill(false),
            false => {}
        }
        self.distances.glance(glance, now.moves, inside, moves);
        self.remember(now, frame, [moves, settled]);
        true
    }

    /// The same of a team that holds links.
    fn glance_at_lists(
        &mut self,
        tick: u32,
        frame: &Frame<D>,
        (glance, lists): (&Glance<'_>, &Lists),
        covered: bool,
    ) -> bool {
        let [required, keep] = [self.rule.required(0), self.rule.keep(0)].map(f64::from);
        let linked = glance.degree_min >= required.max(keep) && glance.malicious_degree_min >= required;
        let held = lists.sound && lists.counted_min >= keep;
        let calm = covered && !frame.assumptions.renewed && self.mode.is_calm(frame, glance, lists);
        let clear = linked && held && calm && self.distances.are_apart(glance, lists);
        let Some(now) = self.before.take_if(|_| clear) else { return false };
        let [moves, settled] = self.assume(tick, frame, covered);
        self.kept.fill(settled);
        self.distances.glance(glance, now.moves, true, moves);
        self.held.glance(frame, lists.relisted);
        self.mode.glance();
        self.remember(now, frame, [moves, settled]);
        true
    }

    /// Whether moves obey the rows and rows rest on what is true, and whether they have done so for long enough.
    fn assume(&mut self, tick: u32, frame: &Frame<D>, covered: bool) -> [bool; 2] {
        let moves = !frame.assumptions.broken && covered;
        if !moves {
            self.broken = Some(tick);
        }
        let settled = moves && longer_ago(self.broken, tick, self.settle_ticks);
        for (counter, counts) in self.ticks.iter_mut().zip([true, settled]) {
            *counter += u64::from(counts);
        }
        [moves, settled]
    }

    /// Keeps a tick for the next one, whose truth is [kept](Self::keep) by itself.
    fn remember(&mut self, mut now: Before<D>, frame: &Frame<D>, [moves, settled]: [bool; 2]) {
        now.positions_m.clone_from(&frame.positions_m);
        (now.moves, now.settled) = (moves, settled);
        now.clear = !frame.assumptions.misplaced;
        self.before = Some(now);
    }

    /// What is safe now, or was and must still be, must be so at the next tick. `composed` promises nothing before every
    /// φ_i ≥ 0 (thm:cbf-qp).
    fn carry(&mut self, frame: &Frame<D>, truth: &Truth, before: &Before<D>, [moves, settled]: [bool; 2]) {
        let budget = self.params.controller().promises();
        let lists = self.lists();
        let presence = &frame.presence;
        let there = frame.phis.iter().zip(&presence.absent).filter(|(_, absent)| !**absent);
        let inside = budget || there.into_iter().all(|(phi, _)| *phi >= 0.0);
        // Whoever comes or leaves takes all of a team of `composed` to another φ.
        let goes_on = budget || !presence.changed;
        for (index, (kept, h)) in self.kept.iter_mut().zip(&truth.h).enumerate() {
            let safe = if lists { self.held.is_kept(index) } else { inside && *h >= 0.0 };
            let carried = *kept && before.settled && goes_on;
            let theirs = !presence.bereft[index] && !presence.absent[index];
            *kept = settled && (safe || (carried && theirs));
        }
        self.distances.carry(truth, before.moves && goes_on, inside, moves);
    }

    /// True if robots keep lists of links and not sums of weights.
    fn lists(&self) -> bool {
        self.params.controller().tells_lists()
    }

    /// What a tick leaves of h at least (docs/budget.md), written down once more.
    fn left(&self, h: f64) -> f64 {
        if h < 0.0 { h } else { (1.0 - self.gamma) * h }
    }

    /// h of normal robots, and their degrees, which follow from it (lem:connectivity).
    fn watch_h(
        &self,
        tick: u32,
        frame: &Frame<D>,
        truth: &Truth,
        before: Option<&Before<D>>,
        verdicts: &mut Verdicts,
    ) {
        let budget = self.params.controller().promises();
        let Presence { absent, bereft, .. } = &frame.presence;
        let normal = |(_, index): &(u16, usize)| !self.malicious[*index] && !absent[*index];
        for (robot, index) in (1_u16..).zip(0..truth.h.len()).filter(normal) {
            let (h, required) = (truth.h[index], self.rule.required(index));
            // What somebody took along who left is nobody's fault.
            let before = before.filter(|_| !bereft[index]);
            let carried = before.filter(|before| before.settled && self.kept[index]);
            let at = |seen, demanded| Violation { tick, robots: [robot, 0], seen, demanded };
            let rounding = level_rounding(truth.neighbors[index]);
            if h < -rounding {
                verdicts.broke(Law::Spare, at(h, 0.0), carried.is_some());
            }
            if truth.degrees[index] < required {
                let seen = f64::from(truth.degrees[index]);
                verdicts.broke(
                    Law::Degree,
                    at(seen, f64::from(required)),
                    (budget && !frame.assumptions.broken && h >= 0.0) || carried.is_some(),
                );
            }
            if let Some(before) = before.filter(|_| budget && !self.lists()) {
                let floor = self.left(before.truth.h[index]);
                if floor >= 0.0 && h < floor - rounding {
                    verdicts.broke(Law::Decay, at(h, floor), carried.is_some());
                }
            }
        }
    }

    /// Shares of time in which normal robots were guaranteed, in which their own h was negative, and in which every assumption
    /// held.
    #[must_use]
    pub(crate) fn shares(&self) -> [f64; 3] {
        let [guaranteed, negative] = self.mode.shares();
        [guaranteed, negative, fraction(self.ticks[1], self.ticks[0])]
    }

    /// Longest time from the end of trouble until all were guaranteed again, in ticks.
    pub(crate) fn recovery_ticks(&self) -> u32 {
        self.mode.recovery_ticks()
    }

    /// Least distance of a normal robot to an obstacle yet, m.
    pub(crate) fn least_clear_m(&self) -> f64 {
        self.clear.least_m()
    }

    /// Least squared distance of two robots yet, m².
    pub(crate) fn least_m2(&self) -> f64 {
        self.distances.least_m2()
    }
}
