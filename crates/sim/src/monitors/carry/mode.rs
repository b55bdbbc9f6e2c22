//! What robots say of their answers, against what is so.

use std::sync::Arc;

use closeranks_core::controller::Kept;
use closeranks_core::robot::report::Mode;
use closeranks_core::settings::params::Params;

use crate::attack::{Attack, ListsAttack, MotionAttack};
use crate::faults::Clocks;
use crate::faults::network::Network;
use crate::frame::Frame;
use crate::geometry::squared_distance;
use crate::law::{Law, Verdicts, Violation};
use crate::monitors::carry::report::{Reports, Untrue};
use crate::monitors::carry::time::{fraction, longer_ago, since};
use crate::monitors::glance::Glance;
use crate::monitors::glance::held::Lists;
use crate::monitors::rounding::level_rounding;
use crate::monitors::rounding::rounding_m2;
use crate::monitors::rule::Rule;
use crate::monitors::truth::{ROUNDING, Stranger, Truth, WHOLE_M, room_m};
use crate::scenario::Scenario;

/// Ticks in which all must have noticed that everything holds again.
const NOTICE_TICKS: u64 = 2;
/// Who lacks no more of h than this promises all the same: half of what robots take for rounding, and far more than rounding is.
const H_HAIR: f64 = 0.5 * ROUNDING;

/// Watches the modes of normal robots under `budget`.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "four facts, each with its own life")]
pub(crate) struct ModeWatch<const D: usize> {
    params: Params<D>,
    malicious: Vec<bool>,
    rule: Arc<Rule>,
    /// Pairs with a malicious robot may collide: it goes where it likes.
    free: bool,
    /// Robots know their own state exactly, and in time.
    exact: bool,
    /// Whether lists of links are lost or lied about, so that nobody need count on anybody.
    deaf: bool,
    /// Whether an assumption was broken once, and when each robot last sensed something wrong.
    broken: bool,
    wrong: Vec<Option<u32>>,
    /// How much more h may seem to be than it is.
    blur: f64,
    told_ticks: u64,
    reports: Reports,
    /// The last tick in which a robot could have noticed anything wrong.
    unwell: Option<u32>,
    /// Normal robots, by index, with malicious ones that move as they like, on whom they counted in the tick before.
    trusted: Vec<[usize; 2]>,
    /// Robot-ticks of normal robots, those of them guaranteed, and those with a negative own h.
    counted: [u64; 3],
    /// Longest time from the end of trouble until all were guaranteed again, in ticks.
    recovery_ticks: u32,
}

/// True if robots of `links` may not hear each other, or are lied to about links.
fn is_deaf<const D: usize>(scenario: &Scenario, params: &Params<D>) -> bool {
    let Attack { level, lists, .. } = scenario.attack;
    let told = level.is_message() && lists == ListsAttack::None;
    let heard = scenario.faults.network == Network::default() && (told || scenario.malicious.is_empty());
    params.controller().tells_lists() && !heard
}

impl<const D: usize> ModeWatch<D> {
    /// For the robots of `scenario`, who may use a level for `told_ticks`.
    pub(crate) fn new(scenario: &Scenario, params: Params<D>, rule: &Arc<Rule>, told_ticks: u64) -> Self {
        let steady = scenario.faults.clocks == Clocks::default();
        let Kept { errors, fall_max, .. } = *params.kept();
        Self {
            malicious: scenario.malicious_mask(),
            rule: Arc::clone(rule),
            free: scenario.attack.motion != MotionAttack::Obedient,
            exact: errors.offset_m == 0.0 && steady && scenario.faults.sensing.dropouts.is_none(),
            deaf: is_deaf(scenario, &params),
            broken: false,
            wrong: vec![None; usize::from(scenario.team.robots)],
            told_ticks,
            blur: 4.0 * errors.offset_m * fall_max * f64::from(scenario.team.robots),
            reports: Reports::new(scenario, &params),
            params,
            // Lists must have been exchanged once.
            unwell: params.controller().tells_lists().then_some(0),
            trusted: Vec::new(),
            counted: [0; 3],
            recovery_ticks: 0,
        }
    }

    /// Nobody promises or reports what is not so, as far as it can know; and all promise again soon after everything holds.
    /// `obstructed` says for each robot whether it may seem to be, and whether it is, too near to an obstacle.
    pub(crate) fn watch(
        &mut self,
        tick: u32,
        frame: &Frame<D>,
        truth: &Truth,
        obstructed: &[[bool; 2]],
        verdicts: &mut Verdicts,
    ) {
        let absent = &frame.presence.absent;
        let stopped = frame.modes.iter().zip(absent).any(|(mode, absent)| *mode == Mode::Stopped && !absent);
        let safe = self.is_safe(frame, truth, obstructed);
        let crowded = self.crowd(truth, false);
        // Who senses a robot where it is not may reckon with it long after it has left.
        let reckons =
            frame.missing.iter().zip(&self.malicious).any(|(missing, malicious)| *missing && !malicious);
        // Lists must be exchanged with whoever came, and in place of whoever left the team or went out of range.
        let changed =
            self.params.controller().tells_lists() && (frame.presence.changed | self.deserted(frame));
        let well = safe && !stopped && !frame.assumptions.broken && !reckons && !changed && !truth.grazes;
        if !well {
            self.unwell = Some(tick);
        }
        let healed = self.exact
            && !self.deaf
            && longer_ago(self.unwell, tick, self.told_ticks.saturating_add(NOTICE_TICKS));
        self.broken |= frame.assumptions.broken;
        for (last, wrong) in self.wrong.iter_mut().zip(&frame.assumptions.sensed_wrong) {
            *last = if *wrong { Some(tick) } else { *last };
        }
        let mut all = true;
        let normal = |(_, index): &(u16, usize)| !self.malicious[*index] && !absent[*index];
        for (robot, index) in (1_u16..).zip(0..truth.h.len()).filter(normal) {
            let guaranteed = frame.modes[index] == Mode::Guaranteed;
            all &= guaranteed;
            let negative = truth.h_own[index] < 0.0;
            for (counter, counts) in self.counted.iter_mut().zip([true, guaranteed, negative]) {
                *counter += u64::from(counts);
            }
            let at = |seen| Violation { tick, robots: [robot, 0], seen, demanded: 0.0 };
            let knows = !frame.assumptions.sensed_wrong[index] && !frame.assumptions.unsensed[index];
            let is_obstructed = obstructed.get(index).is_some_and(|[_, is]| *is);
            if guaranteed && knows && (is_obstructed || self.untrue(index, truth, &crowded)) {
                let misled =
                    !longer_ago(self.wrong[index], tick, self.told_ticks) || !self.exact && self.broken;
                let covered = (!self.params.controller().tells_lists() || !misled) && truth.is_local;
                verdicts.broke(Law::Mode, at(truth.h[index]), covered);
            }
            if let Some(Untrue { seen, demanded }) = self.reports.untrue(index, frame, truth) {
                verdicts.broke(Law::Mode, Violation { tick, robots: [robot, 0], seen, demanded }, true);
            }
            if !guaranteed && healed {
                verdicts.broke(Law::Mode, at(f64::from(since(self.unwell, tick))), true);
            }
        }
        if well && !all {
            self.recovery_ticks = self.recovery_ticks.max(since(self.unwell, tick).min(tick));
        }
    }

    /// True if a tick need not be looked at robot by robot: no robot of a team that senses exactly lacks anything or is in doubt.
    pub(crate) fn is_calm(&self, frame: &Frame<D>, glance: &Glance<'_>, lists: &Lists) -> bool {
        let least_m2 = self.params.kept().distance_min_m * self.params.kept().distance_min_m;
        let apart = glance.least_m2 >= least_m2 + rounding_m2(glance.span_m, least_m2);
        let Frame { assumptions, presence, .. } = frame;
        let wrong = assumptions.broken || assumptions.sensed_wrong.contains(&true);
        self.exact && !self.free && lists.calm && apart && !wrong && !presence.changed
    }

    /// Counts a tick that [is calm](Self::is_calm).
    pub(crate) fn glance(&mut self) {
        let normal = self.malicious.iter().filter(|malicious| !**malicious).count();
        for counter in &mut self.counted[..2] {
            *counter += u64::try_from(normal).unwrap_or(0);
        }
    }

    /// True if a malicious robot that moves as it likes has gone beyond R of a normal one that counted on it in the tick before, or to where
    /// something cuts the link.
    fn deserted(&mut self, frame: &Frame<D>) -> bool {
        if !self.free {
            return false;
        }
        let radius_m = self.params.kept().link.radius_m;
        let gone = |&[robot, liar]: &[usize; 2]| {
            let [own, other] = [&frame.references_m[robot], &frame.references_m[liar]];
            squared_distance(own, other) > radius_m * radius_m || room_m(&frame.cutting, own, other) < WHOLE_M
        };
        let deserted = self.trusted.iter().any(gone);
        self.trusted.clear();
        for (robot, counted) in frame.counted.iter().enumerate().filter(|(robot, _)| !self.malicious[*robot])
        {
            let liars =
                counted.iter().map(|number| usize::from(*number) - 1).filter(|other| self.malicious[*other]);
            self.trusted.extend(liars.map(|liar| [robot, liar]));
        }
        deserted
    }

    /// True if nobody lacks anything: neighbours, distances to robots, distances to obstacles.
    fn is_safe(&self, frame: &Frame<D>, truth: &Truth, obstructed: &[[bool; 2]]) -> bool {
        let absent = &frame.presence.absent;
        let mut obstructed = obstructed.iter().zip(&self.malicious);
        (0..truth.h_own.len())
            .filter(|robot| !absent[*robot])
            .all(|robot| truth.h_own[robot] >= -H_HAIR && self.can_count(robot, truth))
            && !self.crowd(truth, true).contains(&true)
            && !obstructed.any(|([seems, _], malicious)| *seems && !malicious)
    }

    /// True unless a normal robot keeps lists and may not find as many as it must count on. Where malicious robots move as they like that
    /// is more than it needs, and they may be the ones that are out of range.
    fn can_count(&self, robot: usize, truth: &Truth) -> bool {
        let lists = self.params.controller().tells_lists();
        !lists || self.malicious[robot] || truth.degrees[robot] >= self.rule.keep(robot)
    }

    /// True when a robot that senses within the stated errors must know that its h is negative, its degree too low, or another
    /// robot too close.
    fn untrue(&self, robot: usize, truth: &Truth, crowded: &[bool]) -> bool {
        let degree_low = self.exact && truth.degrees[robot] < self.rule.required(robot);
        let h_low = truth.h[robot] < -level_rounding(truth.neighbors[robot]) - self.blur;
        degree_low || h_low || crowded.get(robot) == Some(&true)
    }

    /// For each robot whether another one is certainly too close to it; `anybody` counts disobedient ones too. Empty if nobody
    /// is too close to anybody.
    fn crowd(&self, truth: &Truth, anybody: bool) -> Vec<bool> {
        let kept = self.params.kept();
        let blur_m2 = truth.rounding_m2(kept.distance_min_m * kept.distance_min_m);
        // A hair more for who must promise than for who may not: at the limit itself either is right.
        let limit_m2 = if anybody {
            kept.distance_min_m * kept.distance_min_m + blur_m2
        } else {
            let least_m = (kept.distance_min_m - 2.0 * kept.errors.offset_m).max(0.0);
            least_m * least_m - blur_m2
        };
        let near = |stranger: &&Stranger| stranger.distance_m2 < limit_m2;
        let mut strangers = truth.strangers.iter().filter(near).peekable();
        if truth.least_m2 >= limit_m2 && strangers.peek().is_none() {
            return Vec::new();
        }
        let mut crowded = vec![false; truth.h_own.len()];
        truth.pairs.each(|place, [first, second]| {
            let free = self.free && (self.malicious[first] || self.malicious[second]);
            if truth.pairs.references_m2()[place] < limit_m2 && (anybody || !free) {
                (crowded[first], crowded[second]) = (true, true);
            }
        });
        for stranger in strangers {
            let free = stranger.disobedient || self.free && self.malicious[stranger.robot];
            crowded[stranger.robot] |= anybody || !free;
        }
        crowded
    }

    /// Shares of time in which normal robots were guaranteed, and in which their own h was negative.
    pub(crate) fn shares(&self) -> [f64; 2] {
        let [all, guaranteed, negative] = self.counted;
        [fraction(guaranteed, all), fraction(negative, all)]
    }

    /// Longest time from the end of trouble until all were guaranteed again, in ticks.
    pub(crate) fn recovery_ticks(&self) -> u32 {
        self.recovery_ticks
    }
}
