//! The theorems as code: each law names what must hold and remembers where it first did not.

use closeranks_core::barrier::degree_barrier;
use closeranks_core::math::sqrt;
use closeranks_core::params::Params;
use closeranks_core::program::{InputBox, Outcome};

use crate::frame::Frame;
use crate::law::{Law, Verdict, Violation};
use crate::scenario::Scenario;
use crate::start::squared_distance;

/// A pair that keeps Δ_d exactly may miss it by the rounding of its positions, far less than this part of Δ_d².
const ROUNDING: f64 = 1e-12;

/// Watches the frames of one run.
#[derive(Clone, Debug)]
pub struct Monitors<const D: usize> {
    params: Params<D>,
    malicious: Vec<bool>,
    ticks_per_round: u32,
    verdicts: [Verdict; 8],
    interval: Option<[f64; 2]>,
    spread: Option<f64>,
    degrees_held: bool,
    degrees_held_in_round: bool,
    extremes: Extremes,
}

/// Least and greatest over a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// Least degree of normal robots, if there are any.
    pub degree_min: Option<u16>,
    /// Least degree of malicious robots, if there are any.
    pub malicious_degree_min: Option<u16>,
    /// Least h_i of normal robots.
    pub h_min: f64,
    /// Least distance of two robots, m.
    pub distance_min_m: f64,
    /// Least global φ.
    pub phi_global_min: f64,
    /// Least φ_i.
    pub phi_min: f64,
    /// First tick at which every φ_i ≥ 0.
    pub inside_from: Option<u32>,
    /// First tick of the last stretch in which degrees and distances hold to the end.
    pub safe_from: Option<u32>,
    /// First round after which the spread of normal values is below 1.
    pub rounds_to_agree: Option<u32>,
    /// Spread of normal values at the end.
    pub spread: f64,
}

impl<const D: usize> Monitors<D> {
    /// For the robots of `scenario`.
    #[must_use]
    pub fn new(scenario: &Scenario, params: Params<D>) -> Self {
        Self {
            params,
            malicious: scenario.malicious_mask(),
            ticks_per_round: scenario.ticks_per_round(),
            verdicts: Law::ALL.map(|law| Verdict { law, count: 0, first: None }),
            interval: None,
            spread: None,
            degrees_held: true,
            degrees_held_in_round: false,
            extremes: Extremes {
                degree_min: None,
                malicious_degree_min: None,
                h_min: f64::INFINITY,
                distance_min_m: f64::INFINITY,
                phi_global_min: f64::INFINITY,
                phi_min: f64::INFINITY,
                inside_from: None,
                safe_from: None,
                rounds_to_agree: None,
                spread: 0.0,
            },
        }
    }

    /// Which robots are malicious.
    #[must_use]
    pub fn malicious(&self) -> &[bool] {
        &self.malicious
    }

    /// F′.
    #[must_use]
    pub fn required_degree(&self) -> u16 {
        self.params.required_degree()
    }

    /// What became of each law.
    #[must_use]
    pub fn verdicts(&self) -> &[Verdict; 8] {
        &self.verdicts
    }

    /// Least and greatest.
    #[must_use]
    pub fn extremes(&self) -> &Extremes {
        &self.extremes
    }

    /// Looks at one tick, after its robots ticked and before they move.
    pub fn watch(&mut self, tick: u32, frame: &Frame<D>) {
        let broken = |verdicts: &[Verdict; 8]| verdicts[0].count + verdicts[1].count;
        let before = broken(&self.verdicts);
        self.watch_degrees(tick, frame);
        if tick.is_multiple_of(self.ticks_per_round) {
            self.watch_values(tick, frame);
            self.degrees_held_in_round = self.degrees_held;
        }
        self.watch_distances(tick, frame);
        self.watch_programs(tick, frame);
        if broken(&self.verdicts) > before {
            self.extremes.safe_from = None;
        } else if self.extremes.safe_from.is_none() {
            self.extremes.safe_from = Some(tick);
        }
    }

    fn broke(&mut self, law: Law, violation: Violation) {
        let verdict = &mut self.verdicts[law as usize];
        verdict.count += 1;
        verdict.first.get_or_insert(violation);
    }

    fn watch_degrees(&mut self, tick: u32, frame: &Frame<D>) {
        let required = self.params.required_degree();
        self.degrees_held = true;
        for (robot, index) in (1_u16..).zip(0..frame.degrees.len()) {
            let degree = frame.degrees[index];
            if self.malicious[index] {
                lower(&mut self.extremes.malicious_degree_min, degree);
                continue;
            }
            lower(&mut self.extremes.degree_min, degree);
            self.extremes.h_min = self.extremes.h_min.min(degree_barrier(frame.levels[index], required));
            if degree < required {
                self.degrees_held = false;
                let (seen, demanded) = (f64::from(degree), f64::from(required));
                self.broke(Law::Degree, Violation { tick, robots: [robot, 0], seen, demanded });
            }
        }
    }

    fn watch_distances(&mut self, tick: u32, frame: &Frame<D>) {
        let settings = *self.params.settings();
        let allowed = settings.distance_min_m * settings.distance_min_m;
        let (mut least, mut collisions) = (f64::INFINITY, 0.0);
        for (second, x) in (1_u16..).zip(&frame.positions_m) {
            for (first, y) in (1..second).zip(&frame.positions_m) {
                let distance_m2 = squared_distance(x, y);
                least = least.min(distance_m2);
                if distance_m2 <= settings.radius_m * settings.radius_m {
                    collisions += self.params.composed().collision_term::<f64>(distance_m2);
                }
                if distance_m2 < allowed * (1.0 - ROUNDING) {
                    let (seen, demanded) = (sqrt(distance_m2), settings.distance_min_m);
                    self.broke(Law::Distance, Violation { tick, robots: [first, second], seen, demanded });
                }
            }
        }
        self.extremes.distance_min_m = self.extremes.distance_min_m.min(sqrt(least));
        self.watch_composition(tick, frame, collisions);
    }

    /// φ of the true levels.
    //= paper eq:composition
    fn watch_composition(&mut self, tick: u32, frame: &Frame<D>, collisions: f64) {
        let degrees: f64 =
            frame.levels.iter().map(|level| self.params.composed().degree_term::<f64>(*level)).sum();
        let phi = 1.0 - degrees - collisions;
        self.extremes.phi_global_min = self.extremes.phi_global_min.min(phi);
        if phi < 0.0 {
            self.broke(Law::Composition, Violation { tick, robots: [0, 0], seen: phi, demanded: 0.0 });
        }
    }

    fn watch_programs(&mut self, tick: u32, frame: &Frame<D>) {
        let input = self.params.settings().input;
        let mut inside = true;
        for (robot, index) in (1_u16..).zip(0..frame.phis.len()) {
            let (phi, velocity) = (frame.phis[index], frame.velocities_m_s[index]);
            let at = |seen, demanded| Violation { tick, robots: [robot, 0], seen, demanded };
            self.extremes.phi_min = self.extremes.phi_min.min(phi);
            if phi < 0.0 {
                inside = false;
                self.broke(Law::Shares, at(phi, 0.0));
            }
            if frame.outcomes[index] == Outcome::Infeasible {
                self.broke(Law::Feasible, at(phi, 0.0));
            }
            if !input.contains(&velocity) {
                let (seen, demanded) = worst_component(&velocity, &input);
                self.broke(Law::Input, at(seen, demanded));
            }
        }
        if inside && self.extremes.inside_from.is_none() {
            self.extremes.inside_from = Some(tick);
        }
    }

    /// Values are updated once a round, so they are looked at once a round.
    fn watch_values(&mut self, tick: u32, frame: &Frame<D>) {
        let normal =
            || frame.values.iter().zip(&self.malicious).filter(|(_, liar)| !**liar).map(|(value, _)| *value);
        let (low, high) =
            (normal().fold(f64::INFINITY, f64::min), normal().fold(f64::NEG_INFINITY, f64::max));
        let [least, most] = *self.interval.get_or_insert([low, high]);
        for index in 0..frame.values.len() {
            let value = frame.values[index];
            if !self.malicious[index] && !(least..=most).contains(&value) {
                let robots = [u16::try_from(index + 1).unwrap_or(u16::MAX), 0];
                let demanded = if value < least { least } else { most };
                self.broke(Law::Interval, Violation { tick, robots, seen: value, demanded });
            }
        }
        self.watch_spread(tick, (high - low).max(0.0), least.abs().max(most.abs()));
    }

    //= paper thm:rs_robust
    fn watch_spread(&mut self, tick: u32, spread: f64, magnitude: f64) {
        let beta = 1.0 / f64::from(self.params.settings().robots);
        if let Some(before) = self.spread.filter(|_| self.degrees_held_in_round) {
            // A value is rounded a few times in a round: far less than this.
            let demanded = before * (1.0 - 0.5 * beta) + 1e-13 * magnitude;
            if spread > demanded {
                self.broke(Law::Agreement, Violation { tick, robots: [0, 0], seen: spread, demanded });
            }
        }
        if spread < 1.0 && self.extremes.rounds_to_agree.is_none() {
            self.extremes.rounds_to_agree = Some(tick / self.ticks_per_round);
        }
        self.spread = Some(spread);
        self.extremes.spread = spread;
    }
}

fn lower(least: &mut Option<u16>, degree: u16) {
    *least = Some(least.map_or(degree, |least| least.min(degree)));
}

/// The first component outside its bounds, and the bound.
fn worst_component<const D: usize>(velocity: &[f64; D], input: &InputBox<D>) -> (f64, f64) {
    let cut = input.clip(velocity);
    (0..D).map(|d| (velocity[d], cut[d])).find(|(seen, allowed)| seen != allowed).unwrap_or((0.0, 0.0))
}
