//! The theorems as code: each law names what must hold and remembers where it first did not.

mod agreement;
pub(crate) mod carry;
mod extremes;
pub(crate) mod glance;
mod heard;
mod numbers;
mod pairs;
pub mod robustness;
mod rounding;
mod rule;
pub(crate) mod truth;
mod values;

use std::sync::Arc;

use closeranks_core::equations::barrier::degree_barrier;
use closeranks_core::equations::composition::Composed;
use closeranks_core::num::{length, sqrt};
use closeranks_core::program::{InputBox, Outcome};
use closeranks_core::settings::params::Params;

use crate::consensus::Consensus;
use crate::frame::Frame;
use crate::law::{Law, Verdicts, Violation};
use crate::monitors::carry::Carry;
pub use crate::monitors::extremes::Extremes;
use crate::monitors::extremes::lower;
use crate::monitors::glance::Glance;
pub use crate::monitors::heard::Void;
use crate::monitors::heard::{Heard, Met};
use crate::monitors::numbers::{Numbers, Outside};
use crate::monitors::rule::Rule;
use crate::monitors::truth::Truth;
use crate::monitors::values::Values;
use crate::output::snapshot::Snapshot;
use crate::scenario::Scenario;

/// Watches the frames of one run.
#[derive(Clone, Debug)]
pub struct Monitors<const D: usize> {
    params: Params<D>,
    /// The paper's composition and F′, whatever the controller.
    composed: Composed,
    required_degree: u16,
    malicious: Vec<bool>,
    /// Robots of which nothing is demanded in this tick: malicious ones, and those that are absent.
    aside: Vec<bool>,
    ticks_per_round: u32,
    /// Whether the robots know their true levels, and no more of them lie than the team is prepared for.
    plain: bool,
    few_lie: bool,
    /// Whether numbers of the whole team can say that nothing is broken.
    glances: bool,
    consensus: Consensus,
    rule: Arc<Rule>,
    truth: Truth,
    carry: Carry<D>,
    verdicts: Verdicts,
    numbers: Numbers,
    values: Values,
    heard: Heard,
    extremes: Extremes,
    /// Memory for E^c of the pairs of a tick.
    collisions: Vec<f64>,
}

impl<const D: usize> Monitors<D> {
    /// For the robots of `scenario`.
    #[must_use]
    pub fn new(scenario: &Scenario, params: Params<D>) -> Self {
        let rule = Arc::new(Rule::new(scenario, &params));
        Self {
            composed: scenario.composition(),
            required_degree: scenario.composition().required,
            params,
            glances: glances(scenario, &params, &rule),
            malicious: scenario.malicious_mask(),
            aside: scenario.malicious_mask(),
            ticks_per_round: scenario.ticks_per_round(),
            plain: scenario.is_plain() && !params.controller().promises(),
            few_lie: rule.ranks().is_some() || scenario.malicious.len() <= usize::from(scenario.team.faults),
            truth: Truth::default(),
            carry: Carry::new(scenario, params, &rule),
            values: Values::new(&rule),
            verdicts: Verdicts::default(),
            heard: Heard::new(scenario, &rule),
            numbers: Numbers::new(&scenario.consensus, &rule),
            rule,
            consensus: scenario.consensus.clone(),
            collisions: Vec::new(),
            extremes: Extremes::new(),
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
        self.required_degree
    }

    /// What became of each law.
    #[must_use]
    pub fn verdicts(&self) -> &Verdicts {
        &self.verdicts
    }

    /// Least and greatest.
    #[must_use]
    pub fn extremes(&self) -> &Extremes {
        &self.extremes
    }

    /// The state of the last tick as it is.
    pub(crate) fn truth(&self) -> &Truth {
        &self.truth
    }

    /// The last tick that was watched, of which `frame` is what robots said, as whoever watches the run sees it.
    #[must_use]
    pub fn snapshot<'a>(&'a self, tick: u32, tick_s: f64, frame: &'a Frame<D>) -> Snapshot<'a> {
        Snapshot::new(tick, tick_s, self.required_degree, frame, &self.truth)
    }

    /// True if a robot has as many neighbours that count as it must have so that a controller without weights can keep
    /// enough.
    #[must_use]
    pub fn can_keep(&self, robot: usize) -> bool {
        self.truth.degrees.get(robot).is_some_and(|degree| *degree >= self.rule.keep(robot))
    }

    /// The rank of each robot, if the team has ranks.
    #[must_use]
    pub fn ranks(&self) -> Option<&[u16]> {
        self.rule.ranks()
    }

    /// Rounds in which more than F malicious robots were listened to by one normal robot, under ranks: nothing is promised of them.
    #[must_use]
    pub fn void(&self) -> &Void {
        self.heard.void()
    }

    /// What the theorem of `budget` came to.
    #[must_use]
    pub(crate) fn carry(&self) -> &Carry<D> {
        &self.carry
    }

    /// Looks at one tick, after its robots ticked and before they move.
    pub fn watch(&mut self, tick: u32, frame: &Frame<D>) {
        self.watch_with(tick, frame, None);
    }

    /// The same for whoever has taken a `glance` at the tick, with the same outcome.
    pub(crate) fn watch_with(&mut self, tick: u32, frame: &Frame<D>, glance: Option<&Glance<'_>>) {
        let glance = glance.filter(|_| self.glances);
        let broken = |verdicts: &Verdicts| verdicts.of(Law::Degree).count + verdicts.of(Law::Distance).count;
        let before = broken(&self.verdicts);
        let absent = &frame.presence.absent;
        for (aside, (malicious, absent)) in self.aside.iter_mut().zip(self.malicious.iter().zip(absent)) {
            *aside = *malicious || *absent;
        }
        self.watch_carry(tick, frame, glance);
        self.watch_degrees(frame, glance);
        if tick.is_multiple_of(self.ticks_per_round) {
            self.watch_values(tick, frame);
        }
        self.heard.hear(frame);
        if frame.wants_phi {
            self.watch_composition(tick, frame.collisions, glance);
        }
        self.watch_programs(tick, frame, glance);
        if broken(&self.verdicts) > before {
            self.extremes.safe_from = None;
        } else if self.extremes.safe_from.is_none() {
            self.extremes.safe_from = Some(tick);
        }
    }

    /// What must hold from tick to tick.
    fn watch_carry(&mut self, tick: u32, frame: &Frame<D>, glance: Option<&Glance<'_>>) {
        self.carry.keep(&mut self.truth);
        if let Some(glance) = glance
            && self.carry.glance(tick, frame, glance, self.few_lie)
        {
            return self.truth.glance(frame, glance);
        }
        self.truth.look(&self.params, &self.rule, &self.malicious, frame, self.plain);
        // Who obeys keeps links whatever else it does; of those who move as they like there must be few.
        let covered = self.few_lie && (self.truth.is_local || !self.rule.is_free());
        self.carry.watch(tick, frame, &self.truth, covered, &mut self.verdicts);
    }

    fn broke(&mut self, law: Law, violation: Violation) {
        let covered = self.few_lie && law.is_kept_by(&self.consensus);
        self.verdicts.broke(law, violation, covered);
    }

    fn watch_degrees(&mut self, frame: &Frame<D>, glance: Option<&Glance<'_>>) {
        match glance {
            Some(glance) => self.glance_at_degrees(glance),
            None => self.look_at_degrees(frame),
        }
        self.extremes.distance_min_m = sqrt(self.carry.least_m2());
        self.extremes.clear_min_m = self.carry.least_clear_m();
    }

    fn glance_at_degrees(&mut self, glance: &Glance<'_>) {
        let Glance { degree_min, malicious_degree_min, normal_level_min, .. } = *glance;
        let Extremes { degree_min: normal, malicious_degree_min: malicious, h_min, .. } = &mut self.extremes;
        for (least, degree) in [(normal, degree_min), (malicious, malicious_degree_min)] {
            if degree.is_finite() {
                lower(least, whole(degree));
            }
        }
        *h_min = h_min.min(degree_barrier(normal_level_min, self.required_degree));
    }

    fn look_at_degrees(&mut self, frame: &Frame<D>) {
        let (required, ranked) = (self.required_degree, self.rule.ranks().is_some());
        for index in 0..self.truth.degrees.len() {
            let degree = self.truth.degrees[index];
            if frame.presence.absent[index] {
                continue;
            }
            if self.malicious[index] {
                lower(&mut self.extremes.malicious_degree_min, degree);
                continue;
            }
            lower(&mut self.extremes.degree_min, degree);
            let h =
                if ranked { self.truth.h[index] } else { degree_barrier(self.truth.levels[index], required) };
            self.extremes.h_min = self.extremes.h_min.min(h);
        }
    }

    /// φ of the true levels, of the paper's weight whatever the controller.
    //= paper eq:composition
    fn watch_composition(&mut self, tick: u32, collisions: Option<f64>, glance: Option<&Glance<'_>>) {
        let collisions = collisions.filter(|_| self.plain);
        let lists = glance.and_then(|glance| glance.lists);
        let collisions = lists.map(|lists| lists.collisions).or(collisions);
        let degrees = glance.map_or_else(|| self.degree_terms(), |glance| glance.terms);
        let phi = 1.0 - degrees - collisions.unwrap_or_else(|| self.collisions());
        self.extremes.phi_global_min = self.extremes.phi_global_min.min(phi);
        if phi < 0.0 {
            self.broke(Law::Composition, Violation { tick, robots: [0, 0], seen: phi, demanded: 0.0 });
        }
    }

    /// The sum of E_k over all robots.
    fn degree_terms(&self) -> f64 {
        let there = self.truth.paper_levels.iter().filter(|level| !level.is_nan());
        there.map(|level| self.composed.degree_term::<f64>(*level)).sum()
    }

    /// The sum of E^c over all links.
    fn collisions(&mut self) -> f64 {
        let (composed, radius_m) = (self.composed, self.params.link().radius_m);
        let near = self.truth.pairs.references_m2().iter().filter(|pair| **pair <= radius_m * radius_m);
        self.collisions.clear();
        self.collisions.extend(near);
        composed.collision_terms(&mut self.collisions);
        self.collisions.iter().fold(0.0, |sum, term| sum + term)
    }

    fn watch_programs(&mut self, tick: u32, frame: &Frame<D>, glance: Option<&Glance<'_>>) {
        if let Some(Glance { phi_min, .. }) = glance.filter(|glance| glance.phi_min >= 0.0 && glance.boxed) {
            self.extremes.phi_min = self.extremes.phi_min.min(*phi_min);
            self.extremes.inside_from.get_or_insert(tick);
            return;
        }
        let input = self.params.settings().limits.input;
        let mut inside = true;
        for (robot, index) in (1_u16..).zip(0..frame.phis.len()) {
            if frame.presence.absent[index] {
                continue;
            }
            let (phi, velocity) = (frame.phis[index], frame.velocities_m_s[index]);
            let at = |seen, demanded| Violation { tick, robots: [robot, 0], seen, demanded };
            self.extremes.phi_min = self.extremes.phi_min.min(phi);
            // Of a robot that is down nobody knows φ_i.
            inside &= phi >= 0.0 || !frame.wants_phi;
            if phi < 0.0 {
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
        let met = self.heard.end_round(tick, frame, &self.aside);
        let (few_lie, consensus) = (self.few_lie, &self.consensus);
        let verdicts = &mut self.verdicts;
        let spread = self.values.end_round(tick, &frame.values, &self.aside, met, |law, violation| {
            verdicts.broke(law, violation, few_lie && law.is_kept_by(consensus));
        });
        let more = self.watch_numbers(tick, frame, met);
        let all = [spread].into_iter().chain(more);
        self.extremes.spreads.iter_mut().zip(all).for_each(|(place, spread)| *place = spread);
        let spread = self.extremes.spreads.iter().fold(0.0_f64, |most, spread| most.max(*spread));
        if spread < 1.0 && self.extremes.rounds_to_agree.is_none() {
            self.extremes.rounds_to_agree = Some(tick / self.ticks_per_round);
        }
        self.extremes.spread = spread;
    }

    /// Numbers beyond the first; the spread of each.
    fn watch_numbers(&mut self, tick: u32, frame: &Frame<D>, met: Met) -> Vec<f64> {
        let mut broken = Vec::new();
        let spreads = self.numbers.watch(frame, &self.malicious, met, &mut |outside| broken.push(outside));
        for Outside { law, robot, seen, demanded } in broken {
            let robots = [u16::try_from(robot).unwrap_or(u16::MAX), 0];
            self.broke(law, Violation { tick, robots, seen, demanded });
        }
        spreads
    }
}

/// Whether the laws of `scenario` can be seen to hold from numbers of the whole team: everybody counts for everybody and is there, knows
/// its level or holds links, and obeys, and nothing else is in the way.
fn glances<const D: usize>(scenario: &Scenario, params: &Params<D>, rule: &Rule) -> bool {
    let plain = scenario.is_plain() && scenario.obstacles.list.is_empty();
    let (controller, kept) = (params.controller(), params.kept());
    let lists = controller.tells_lists() && kept.errors.offset_m == 0.0 && !params.weighs_its_own_way();
    let known = lists || controller.tells_levels() && kept.gamma_c == 1.0;
    plain && known && !rule.is_free() && rule.ranks().is_none() && kept.errors.away_m == 0.0
}

/// A degree that is a number among others.
fn whole(degree: f64) -> u16 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a sum of a few ones")]
    let degree = degree as u16;
    degree
}

/// The speed if it is too great, or the first component outside its bounds, and the bound.
fn worst_component<const D: usize>(velocity: &[f64; D], input: &InputBox<D>) -> (f64, f64) {
    let speed_m_s = length(velocity);
    if speed_m_s > input.speed_max_m_s {
        return (speed_m_s, input.speed_max_m_s);
    }
    let cut = input.clip(velocity);
    (0..D).map(|d| (velocity[d], cut[d])).find(|(seen, allowed)| seen != allowed).unwrap_or((0.0, 0.0))
}
