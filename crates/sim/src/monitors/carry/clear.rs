//! How near robots come to obstacles, between ticks too.

use closeranks_core::num::{Vector, add_scaled, dot, length, subtract};
use closeranks_core::obstacle::Obstacle;
use closeranks_core::settings::params::Params;

use crate::frame::Frame;
use crate::law::{Law, Verdicts, Violation};
use crate::monitors::carry::before::Before;
use crate::scenario::Scenario;

/// Positions are rounded by less than this, m; robots keep ten times as much more.
const ROUNDING_M: f64 = 1e-10;
/// What robots keep more than they must, and rounding, m.
const KEPT_MORE_M: f64 = 2e-9;
/// The least distance of a way is found to a part of 2⁻⁶⁰ of the way.
const THIRDS: u32 = 100;

/// Watches normal robots. What one of them keeps from an obstacle rests on itself alone: on its place, on its body, and on its
/// last velocity being held no longer than is stated.
#[derive(Clone, Debug)]
pub(crate) struct Clear<const D: usize> {
    obstacles: Vec<Obstacle<D>>,
    malicious: Vec<bool>,
    /// What is demanded of robots, and of references, m.
    demanded_m: f64,
    reference_m: f64,
    /// How wrong a robot may sense its own place, m.
    error_m: f64,
    /// Robots that were clear once and must have been ever since: no assumption was broken.
    kept: Vec<bool>,
    least_m: f64,
}

impl<const D: usize> Clear<D> {
    /// For the robots of `scenario`.
    pub(crate) fn new(scenario: &Scenario, params: Params<D>) -> Self {
        let demanded_m = params.settings().limits.clearance_m;
        Self {
            obstacles: scenario.obstacles.in_dimension(),
            malicious: scenario.malicious_mask(),
            demanded_m,
            reference_m: demanded_m + params.kept().errors.away_m,
            error_m: params.settings().errors.position_m,
            kept: vec![false; usize::from(scenario.team.robots)],
            least_m: f64::INFINITY,
        }
    }

    /// Least distance of a normal robot to an obstacle yet, m.
    pub(crate) fn least_m(&self) -> f64 {
        self.least_m
    }

    /// For each robot whether it may seem to be, and whether it certainly is, nearer to an obstacle than it may be; empty where none is.
    pub(crate) fn obstructed(&self, frame: &Frame<D>) -> Vec<[bool; 2]> {
        if self.obstacles.is_empty() {
            return Vec::new();
        }
        let lacks = |index, blur_m| self.missing_m(index, frame, blur_m).next().is_some();
        let both = |index| [lacks(index, ROUNDING_M), lacks(index, -2.0 * self.error_m - ROUNDING_M)];
        (0..self.kept.len()).map(both).collect()
    }

    /// How far robot `index` may wish to go away from obstacles, m, if no obstacle asks for more than `longest_m`.
    pub(crate) fn demand_m(&self, index: usize, frame: &Frame<D>, longest_m: f64) -> f64 {
        let missing_m = self.missing_m(index, frame, 2.0 * self.error_m + KEPT_MORE_M);
        missing_m.map(|missing_m| missing_m.min(longest_m)).sum()
    }

    /// What each obstacle that is too near to robot `index` lacks, m, where places may be wrong by `blur_m`.
    fn missing_m(&self, index: usize, frame: &Frame<D>, blur_m: f64) -> impl Iterator<Item = f64> {
        let (x, reference_m) = (frame.references_m[index], self.reference_m);
        let missing_m = move |obstacle: &Obstacle<D>| reference_m + blur_m - gap_m(obstacle, &x);
        self.obstacles.iter().map(missing_m).filter(|missing_m| *missing_m > 0.0)
    }

    /// Looks at one tick; `before` is the last one.
    //= theory thm:clear
    pub(crate) fn watch(
        &mut self,
        tick: u32,
        frame: &Frame<D>,
        before: Option<&Before<D>>,
        verdicts: &mut Verdicts,
    ) {
        if self.obstacles.is_empty() {
            return;
        }
        let moved = before.is_some_and(|before| before.clear) && !frame.assumptions.renewed;
        for (robot, index) in (1_u16..).zip(0..self.kept.len()).filter(|(_, index)| !self.malicious[*index]) {
            let x = &frame.positions_m[index];
            if frame.presence.absent[index] {
                self.kept[index] = false;
                continue;
            }
            let was_there = before.filter(|_| !frame.presence.arrived[index]);
            let start = was_there.map_or(x, |before| &before.positions_m[index]);
            let least_m = self.way_m(start, x);
            self.least_m = self.least_m.min(least_m);
            let kept = self.kept[index] && moved;
            if least_m < self.demanded_m - ROUNDING_M {
                let at = Violation { tick, robots: [robot, 0], seen: least_m, demanded: self.demanded_m };
                verdicts.broke(Law::Clear, at, kept);
            }
            let reference = &frame.references_m[index];
            let is_clear = self.way_m(reference, reference) >= self.reference_m - ROUNDING_M;
            self.kept[index] = kept || is_clear;
        }
    }

    /// The least distance to any obstacle on the straight way from `start` to `end`, m; of one that is farther away than matters, the
    /// distance from `end`.
    fn way_m(&self, start: &Vector<D>, end: &Vector<D>) -> f64 {
        let step_m = length(&subtract(end, start));
        let least_m = |obstacle: &Obstacle<D>| {
            let end_m = gap_m(obstacle, end);
            if end_m > self.demanded_m + step_m || step_m == 0.0 {
                end_m
            } else {
                nearest_m(obstacle, start, end)
            }
        };
        self.obstacles.iter().map(least_m).fold(f64::INFINITY, f64::min)
    }
}

/// The distance to a convex set falls and then rises along a way: thirds of it that cannot hold the least are left out.
fn nearest_m<const D: usize>(obstacle: &Obstacle<D>, start: &Vector<D>, end: &Vector<D>) -> f64 {
    let step = subtract(end, start);
    let at = |share: f64| gap_m(obstacle, &add_scaled(start, share, &step));
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..THIRDS {
        let third = (high - low) / 3.0;
        if at(low + third) < at(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    at(low).min(at(0.0)).min(at(1.0))
}

/// The distance from `x` to an obstacle, m, written down once more: to the ends of its segment, and to what lies between.
fn gap_m<const D: usize>(obstacle: &Obstacle<D>, x: &Vector<D>) -> f64 {
    let (to_from, to_to) = (subtract(x, &obstacle.from_m), subtract(x, &obstacle.to_m));
    let along = subtract(&obstacle.to_m, &obstacle.from_m);
    let ends_m = length(&to_from).min(length(&to_to));
    let is_beside = dot(&to_from, &along) > 0.0 && dot(&to_to, &along) < 0.0;
    let beside_m = if is_beside {
        let unit = along.map(|component| component / length(&along));
        length(&add_scaled(&to_from, -dot(&to_from, &unit), &unit))
    } else {
        ends_m
    };
    beside_m.min(ends_m) - obstacle.radius_m
}

#[cfg(test)]
mod tests {
    use super::*;

    //= theory thm:clear type=test
    #[test]
    fn a_way_past_a_corner_is_seen() {
        let wall = Obstacle::wall([0.0, 0.0], [1.0, 0.0]);
        assert!((nearest_m(&wall, &[-1.0, 0.3], &[2.0, 0.3]) - 0.3).abs() < 1e-12);
        assert!((nearest_m(&wall, &[1.0, 0.5], &[1.5, 0.0]) - 0.5 * 0.5_f64.sqrt()).abs() < 1e-12);
        assert!(nearest_m(&wall, &[0.5, -1.0], &[0.5, 1.0]).abs() < 1e-12);
        let disc = Obstacle::disc([0.0, 0.0], 0.5);
        assert!((nearest_m(&disc, &[-1.0, 0.7], &[1.0, 0.7]) - 0.2).abs() < 1e-12);
        for (k, obstacle) in [wall, disc].iter().cycle().enumerate().take(400) {
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let x = [0.01 * k as f64 - 1.5, 1.7 - 0.009 * k as f64];
            let other_m = length(&obstacle.offset_m(&x)) - obstacle.radius_m;
            assert!((gap_m(obstacle, &x) - other_m).abs() < 1e-12);
        }
    }
}
