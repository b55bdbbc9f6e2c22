//! The theorem of `budget` from tick to tick: what was safe stays safe wherever its assumptions hold.

use closeranks_core::budget::knowledge::Assume;
use closeranks_core::math::{Vector, add_scaled, dot, sqrt, subtract};
use closeranks_core::params::{Controller, Params};

use crate::attack::MotionAttack;
use crate::frame::Frame;
use crate::honesty::Honesty;
use crate::law::{Law, Verdicts, Violation};
use crate::scenario::Scenario;
use crate::truth::Truth;

/// Sums of weights, and squares of distances as a share of R², are rounded by far less than this.
pub(crate) const ROUNDING: f64 = 1e-11;

/// The tick before, and what has not held since when.
#[derive(Clone, Debug)]
pub(crate) struct Promise<const D: usize> {
    params: Params<D>,
    malicious: Vec<bool>,
    /// Pairs with a malicious robot may collide: it goes where it likes.
    free: bool,
    told_ticks: u32,
    gamma: f64,
    before: Option<Before<D>>,
    /// The last tick in which an assumption was broken.
    broken: Option<u32>,
    /// Robots and pairs that were safe once and must have been ever since: no assumption was broken.
    kept: Vec<bool>,
    apart: Vec<bool>,
    /// What robots say of it.
    honesty: Honesty<D>,
    /// Ticks, and those in which every assumption held.
    ticks: [u64; 2],
    /// Least squared distance of two robots yet, m².
    least_m2: f64,
}

#[derive(Clone, Debug)]
struct Before<const D: usize> {
    truth: Truth,
    positions_m: Vec<Vector<D>>,
    /// Moves obey the rows, and rows rest on what is true.
    moves: bool,
    claims: bool,
}

impl<const D: usize> Promise<D> {
    /// For the robots of `scenario`.
    #[must_use]
    pub(crate) fn new(scenario: &Scenario, params: Params<D>) -> Self {
        let settings = params.settings();
        let aged = settings.told_max + settings.clock_error;
        let told_ticks = aged.as_nanos().div_ceil(settings.level_period.as_nanos().max(1));
        let told_ticks = u32::try_from(told_ticks).unwrap_or(u32::MAX).saturating_add(1);
        Self {
            malicious: scenario.malicious_mask(),
            free: scenario.motion_attack != MotionAttack::Obedient,
            told_ticks,
            gamma: settings.gamma(),
            honesty: Honesty::new(scenario, params, told_ticks),
            params,
            before: None,
            broken: None,
            kept: vec![false; usize::from(scenario.robots)],
            apart: Vec::new(),
            ticks: [0; 2],
            least_m2: f64::INFINITY,
        }
    }

    /// Looks at one tick. `covered` is false where more robots lie than the team is prepared for.
    pub(crate) fn watch(
        &mut self,
        tick: u32,
        frame: &Frame<D>,
        truth: &Truth,
        covered: bool,
        verdicts: &mut Verdicts,
    ) {
        let before = self.before.take();
        let carried = before.as_ref().filter(|_| covered && !frame.renewed);
        self.watch_spares(tick, frame, truth, carried, verdicts);
        self.watch_pairs(tick, frame, truth, carried, verdicts);
        if frame.broken || !covered {
            self.broken = Some(tick);
        }
        let moves = !frame.broken && covered;
        let claims = moves && since(self.broken, tick) > self.told_ticks;
        for (counter, counts) in self.ticks.iter_mut().zip([true, claims]) {
            *counter += u64::from(counts);
        }
        if self.params.settings().controller == Controller::Budget {
            self.honesty.watch(tick, frame, truth, verdicts);
        }
        let mut now = before.unwrap_or_else(|| Before {
            truth: Truth::default(),
            positions_m: Vec::new(),
            moves: false,
            claims: false,
        });
        now.truth.clone_from(truth);
        now.positions_m.clone_from(&frame.positions_m);
        self.carry(frame, truth, &now, [moves, claims]);
        (now.moves, now.claims) = (moves, claims);
        self.before = Some(now);
    }

    /// What is safe now, or was and must still be, must be so at the next tick. `composed` promises nothing before every
    /// φ_i ≥ 0 (thm:cbf-qp).
    fn carry(&mut self, frame: &Frame<D>, truth: &Truth, before: &Before<D>, [moves, claims]: [bool; 2]) {
        let least_m = self.params.budget().distance_min_m;
        let limit_m2 = least_m * least_m - ROUNDING * self.params.settings().radius_m.powi(2);
        let budget = self.params.settings().controller == Controller::Budget;
        let inside = budget || frame.phis.iter().all(|phi| *phi >= 0.0);
        for (kept, spare) in self.kept.iter_mut().zip(&truth.spares) {
            *kept = claims && ((inside && *spare >= 0.0) || (*kept && before.claims));
        }
        self.apart.resize(truth.pairs_m2.len(), false);
        for (apart, pair_m2) in self.apart.iter_mut().zip(&truth.pairs_m2) {
            *apart = moves && ((inside && *pair_m2 >= limit_m2) || (*apart && before.moves));
        }
    }

    /// What a tick leaves of h at least (docs/budget.md), written down once more.
    fn left(&self, h: f64) -> f64 {
        let (gamma, rise) = (self.gamma, self.params.settings().rise);
        if h < 0.0 { h } else { (1.0 - gamma) * h / (1.0 + rise * gamma * h) }
    }

    /// h of normal robots, and their degrees, which follow from it (lem:connectivity).
    fn watch_spares(
        &self,
        tick: u32,
        frame: &Frame<D>,
        truth: &Truth,
        before: Option<&Before<D>>,
        verdicts: &mut Verdicts,
    ) {
        let budget = self.params.settings().controller == Controller::Budget;
        let required = self.required();
        for (robot, index) in (1_u16..).zip(0..truth.spares.len()).filter(|(_, k)| !self.malicious[*k]) {
            let spare = truth.spares[index];
            let carried = before.filter(|before| before.claims && self.kept[index]);
            let at = |seen, demanded| Violation { tick, robots: [robot, 0], seen, demanded };
            if spare < -ROUNDING {
                verdicts.broke(Law::Spare, at(spare, 0.0), carried.is_some());
            }
            if truth.degrees[index] < required {
                let seen = f64::from(truth.degrees[index]);
                verdicts.broke(
                    Law::Degree,
                    at(seen, f64::from(required)),
                    (budget && !frame.broken && spare >= 0.0) || carried.is_some(),
                );
            }
            if let Some(before) = before.filter(|_| budget) {
                let floor = self.left(before.truth.spares[index]);
                if floor >= 0.0 && spare < floor - ROUNDING {
                    verdicts.broke(Law::Decay, at(spare, floor), carried.is_some());
                }
            }
        }
    }

    /// The degree that counts: F′, or θ among normal robots with free liars.
    fn required(&self) -> u16 {
        required(&self.params)
    }

    fn watch_pairs(
        &mut self,
        tick: u32,
        frame: &Frame<D>,
        truth: &Truth,
        before: Option<&Before<D>>,
        verdicts: &mut Verdicts,
    ) {
        let radius_m = self.params.settings().radius_m;
        let blur_m2 = ROUNDING * radius_m * radius_m;
        let (least_m, own_least_m) =
            (self.params.settings().distance_min_m, self.params.budget().distance_min_m);
        let budget = self.params.settings().controller == Controller::Budget;
        let mut pair = 0;
        for (second, x) in (0..).zip(&frame.positions_m) {
            for (first, y) in (0..second).zip(&frame.positions_m) {
                let place = pair;
                pair += 1;
                let offset = subtract(x, y);
                let distance_m2 = dot(&offset, &offset);
                self.least_m2 = self.least_m2.min(distance_m2);
                if self.free && (self.malicious[first] || self.malicious[second]) {
                    continue;
                }
                let robots = [first, second].map(|index| u16::try_from(index + 1).unwrap_or(u16::MAX));
                let carried = before.filter(|before| before.moves && self.apart[place]);
                let at = |seen, demanded| Violation { tick, robots, seen, demanded };
                if distance_m2 < least_m * least_m - blur_m2 {
                    verdicts.broke(Law::Distance, at(sqrt(distance_m2), least_m), carried.is_some());
                }
                let Some(before) = before else { continue };
                let path_m2 = nearest_m2(
                    &subtract(&before.positions_m[second], &before.positions_m[first]),
                    &offset,
                    least_m,
                );
                if path_m2 < least_m * least_m - blur_m2 {
                    verdicts.broke(Law::Path, at(sqrt(path_m2), least_m), carried.is_some());
                }
                let spare_m2 = before.truth.pairs_m2[place] - own_least_m * own_least_m;
                let floor_m2 = (1.0 - self.params.settings().gamma_c) * spare_m2;
                let linked =
                    before.truth.pairs_m2[place] <= self.params.budget().curvature.link().radius_m.powi(2);
                let now_m2 = truth.pairs_m2[place] - own_least_m * own_least_m;
                if budget && linked && floor_m2 >= 0.0 && now_m2 < floor_m2 - blur_m2 {
                    verdicts.broke(Law::Decay, at(now_m2, floor_m2), carried.is_some());
                }
            }
        }
    }

    /// Shares of time in which normal robots were guaranteed, in which their own h was negative, and in which every assumption
    /// held.
    #[must_use]
    pub(crate) fn shares(&self) -> [f64; 3] {
        let [guaranteed, negative] = self.honesty.shares();
        [guaranteed, negative, share(self.ticks[1], self.ticks[0])]
    }

    /// Longest time from the end of trouble until all were guaranteed again, in ticks.
    pub(crate) fn recovery_ticks(&self) -> u32 {
        self.honesty.recovery_ticks()
    }

    /// Least squared distance of two robots yet, m².
    pub(crate) fn least_m2(&self) -> f64 {
        self.least_m2
    }
}

/// F′, or θ with free liars: written down once more, so that monitors do not rest on what they watch.
pub(crate) fn required<const D: usize>(params: &Params<D>) -> u16 {
    let (robots, faults) = (params.settings().robots, params.settings().faults);
    let free = params.settings().controller == Controller::Budget && params.settings().assume == Assume::Free;
    faults + if free { (robots - faults) / 2 } else { robots / 2 }
}

/// `part/whole`, 0 of nothing.
pub(crate) fn share(part: u64, whole: u64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "counts")]
    let share = part as f64 / whole.max(1) as f64;
    share
}

/// Ticks since `then`; for ever if it never was.
pub(crate) fn since(then: Option<u32>, tick: u32) -> u32 {
    then.map_or(u32::MAX, |then| tick - then)
}

/// Square of the least distance while an offset goes straight from `start` to `end`, m²; what is farther than twice `least_m`
/// may come out as the end.
fn nearest_m2<const D: usize>(start: &Vector<D>, end: &Vector<D>, least_m: f64) -> f64 {
    let step = subtract(end, start);
    let (length_m2, start_m2) = (dot(&step, &step), dot(start, start));
    let end_m2 = dot(end, end);
    if length_m2 == 0.0 || (start_m2 > 4.0 * least_m * least_m && length_m2 < least_m * least_m) {
        return end_m2;
    }
    let share = (-dot(start, &step) / length_m2).clamp(0.0, 1.0);
    let nearest = add_scaled(start, share, &step);
    dot(&nearest, &nearest).min(end_m2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robots_that_pass_each_other_between_ticks_are_seen() {
        assert_eq!(nearest_m2(&[-1.0, 0.25], &[1.0, 0.25], 0.3), 0.0625);
        assert_eq!(nearest_m2(&[1.0, 0.0], &[2.0, 0.0], 0.3), 1.0);
        assert_eq!(nearest_m2(&[2.0, 0.0], &[2.0, 0.0], 0.3), 4.0);
    }
}
