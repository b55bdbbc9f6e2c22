//! One row of the table: what a run came to.

use closeranks_core::num::{Vector, dot, length, sqrt, subtract};

use crate::controllers::{Counted, Inside, Row};
use crate::frame::Frame;
use crate::geometry::squared_distance;
use crate::law::{Law, Verdict, Verdicts};
use crate::monitors::{Extremes, Monitors, Void};
use crate::output::attendance::Attendance;
use crate::output::conduct::{Conduct, Watch};
use crate::scenario::Scenario;

/// Where the start lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartSummary {
    /// Whether the start is in the safe set of its controller: every φ_i ≥ 0 for `composed` (thm:cbf-qp); every h_i of a
    /// normal robot ≥ 0 and no two robots closer than Δ_d for `budget`.
    pub inside: bool,
    /// Least φ_i at the start.
    pub phi_min: f64,
    /// Least h_i of a normal robot at the start, as its controller has it.
    pub h_min: f64,
    /// Least degree of all robots.
    pub degree_min: u16,
    /// Least distance of two robots, m.
    pub distance_min_m: f64,
}

/// What a run came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Where the run began.
    pub start: StartSummary,
    /// Least and greatest numbers over the run.
    pub extremes: Extremes,
    /// What became of each law.
    pub verdicts: Verdicts,
    /// Radius of gyration at the end, m: `√(Σ‖x_i − x̄‖²/n)` over all robots.
    pub gyration_m: f64,
    /// Links at the end.
    pub links: u32,
    /// Mean distance from normal to malicious robots at the end, m.
    pub liar_distance_m: Option<f64>,
    /// Greatest speed of any robot in the last tick, m/s.
    pub speed_end_m_s: f64,
    /// Rate of growth of the radius of gyration at the start and at the end, m/s.
    pub spreading_m_s: [f64; 2],
    /// How normal robots moved compared with what they wished.
    pub conduct: Conduct,
    /// Fraction of the time of normal robots in which they said that they were guaranteed.
    pub guaranteed_share: f64,
    /// Fraction of that time in which their own h was negative. With free liars such a robot only comes closer to others.
    pub negative_share: f64,
    /// Fraction of ticks in which every assumption of `budget` held, and had held long enough for what was told to be true.
    pub covered_share: f64,
    /// Longest time from when all assumptions held again until all robots said again that they were guaranteed, s.
    pub recovery_s: f64,
    /// How many malicious robots had fewer than F′ neighbours at some time.
    pub malicious_below: u16,
    /// Rounds of which nothing is promised, because more than F malicious robots were around one robot that has a rank.
    pub void: Void,
    /// Who came and went. The world fills it.
    pub attendance: Attendance,
    /// Rounds in the run.
    pub rounds: u32,
    /// Ticks in the run.
    pub ticks: u32,
}

impl Summary {
    /// How often `law` was broken.
    #[must_use]
    pub fn broken(&self, law: Law) -> u64 {
        self.verdicts.of(law).count
    }

    /// What counts against the controller: each law that it promises ([`Row::promises`]) with how often, and where first, it
    /// was broken although everything held that the promise rests on. With `budget` that is a bug, or a hole in the theorem.
    pub fn violations(&self, scenario: &Scenario) -> impl Iterator<Item = Verdict> {
        let Row { promises: laws, counted, .. } = scenario.controller.row();
        let counted =
            self.verdicts.iter().filter(|verdict| laws.contains(&verdict.law)).map(move |verdict| {
                let (count, first) = if *counted == Counted::All {
                    (verdict.count, verdict.first)
                } else {
                    (verdict.covered, verdict.first_covered)
                };
                Verdict { count, first, ..*verdict }
            });
        counted.filter(|verdict| verdict.count > 0)
    }

    /// Expected laws that were broken.
    pub fn failures<'a>(&'a self, scenario: &'a Scenario) -> impl Iterator<Item = &'a Verdict> {
        self.verdicts.iter().filter(|verdict| verdict.count > 0 && scenario.expect.contains(&verdict.law))
    }
}

/// Collects what only single frames show.
#[derive(Clone, Debug, Default)]
pub struct Collector {
    start: Option<StartSummary>,
    spreading_start_m_s: f64,
    malicious_below: Vec<bool>,
    conduct: Watch,
}

impl Collector {
    /// Looks at one tick after the monitors did.
    pub fn watch<const D: usize>(&mut self, scenario: &Scenario, frame: &Frame<D>, monitors: &Monitors<D>) {
        let malicious = monitors.malicious();
        if self.start.is_none() {
            self.start = Some(start(scenario, frame, monitors));
            self.spreading_start_m_s = spreading(frame);
            self.malicious_below = vec![false; malicious.len()];
        }
        self.conduct.watch(scenario, frame, malicious);
        let required = monitors.required_degree();
        for index in 0..malicious.len() {
            let there = malicious[index] && !frame.presence.absent[index];
            self.malicious_below[index] |= there && frame.degrees[index] < required;
        }
    }

    /// The summary, from the last frame.
    #[must_use]
    pub fn finish<const D: usize>(
        self,
        scenario: &Scenario,
        frame: &Frame<D>,
        monitors: &Monitors<D>,
    ) -> Summary {
        let speeds = frame.velocities_m_s.iter().map(|velocity| squared_distance(velocity, &[0.0; D]));
        let [guaranteed_share, negative_share, covered_share] = monitors.carry().shares();
        let normal = monitors.malicious().iter().filter(|lies| !**lies).count();
        let below = self.malicious_below.iter().filter(|below| **below).count();
        Summary {
            start: self.start.unwrap_or(NO_START),
            extremes: *monitors.extremes(),
            verdicts: *monitors.verdicts(),
            gyration_m: gyration(&frame.positions_m),
            links: frame.links,
            liar_distance_m: mean_distance_to_liars(&frame.positions_m, &scenario.malicious_mask()),
            speed_end_m_s: sqrt(speeds.fold(0.0, f64::max)),
            spreading_m_s: [self.spreading_start_m_s, spreading(frame)],
            conduct: self.conduct.finish(scenario, normal),
            guaranteed_share,
            negative_share,
            covered_share,
            recovery_s: f64::from(monitors.carry().recovery_ticks()) * scenario.tick_s(),
            malicious_below: u16::try_from(below).unwrap_or(u16::MAX),
            void: *monitors.void(),
            attendance: Attendance::default(),
            rounds: scenario.ticks() / scenario.ticks_per_round(),
            ticks: scenario.ticks(),
        }
    }
}

/// Stands for the start of a run without a single tick; there is no such run.
const NO_START: StartSummary = StartSummary {
    inside: false,
    phi_min: f64::NAN,
    h_min: f64::NAN,
    degree_min: 0,
    distance_min_m: f64::NAN,
};

fn start<const D: usize>(scenario: &Scenario, frame: &Frame<D>, monitors: &Monitors<D>) -> StartSummary {
    let Extremes { phi_min, distance_min_m, inside_from, .. } = *monitors.extremes();
    let normal = frame.h.iter().zip(monitors.malicious()).filter(|(_, malicious)| !**malicious);
    let h_min = normal.map(|(h, _)| *h).fold(f64::INFINITY, f64::min);
    let absent = &frame.presence.absent;
    let normal = |robot: &usize| !monitors.malicious()[*robot] && !absent[*robot];
    let degrees = (0..absent.len()).filter(normal).all(|robot| monitors.can_keep(robot));
    let clear = monitors.extremes().clear_min_m >= scenario.limits.clearance_m;
    let inside = match scenario.controller.row().inside {
        Inside::Margins => clear && h_min >= 0.0 && distance_min_m >= scenario.limits.distance_min_m,
        Inside::Degrees => clear && degrees && distance_min_m >= scenario.limits.distance_min_m,
        Inside::Shares => inside_from.is_some(),
    };
    let there = frame.degrees.iter().zip(absent).filter(|(_, absent)| !**absent);
    let degree_min = there.map(|(degree, _)| *degree).min().unwrap_or(0);
    StartSummary { inside, phi_min, h_min, degree_min, distance_min_m }
}

/// Those of `vectors` that are places.
fn there<const D: usize>(vectors: &[Vector<D>]) -> impl Iterator<Item = &Vector<D>> + Clone {
    vectors.iter().filter(|vector| !vector[0].is_nan())
}

fn mean<const D: usize>(vectors: &[Vector<D>]) -> Vector<D> {
    let robots = count(there(vectors).count());
    core::array::from_fn(|d| there(vectors).map(|vector| vector[d]).sum::<f64>() / robots)
}

fn count(length: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "teams are far below 2^53")]
    let count = length.max(1) as f64;
    count
}

/// Radius of gyration of those who are there, m.
#[must_use]
pub fn gyration<const D: usize>(positions: &[Vector<D>]) -> f64 {
    let centre = mean(positions);
    sqrt(
        there(positions).map(|position| squared_distance(position, &centre)).sum::<f64>()
            / count(there(positions).count()),
    )
}

/// Mean distance from normal to malicious robots, m; `None` without both kinds.
fn mean_distance_to_liars<const D: usize>(positions: &[Vector<D>], malicious: &[bool]) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0_u32);
    let robots = || positions.iter().zip(malicious).filter(|(x, _)| !x[0].is_nan());
    for (x, _) in robots().filter(|(_, malicious)| !**malicious) {
        for (y, _) in robots().filter(|(_, malicious)| **malicious) {
            sum += length(&subtract(x, y));
            count += 1;
        }
    }
    (count > 0).then(|| sum / f64::from(count))
}

/// Rate of growth of the radius of gyration under the inputs of a frame, m/s: `Σ (x_i − x̄)·u_i / (n r_g)`.
fn spreading<const D: usize>(frame: &Frame<D>) -> f64 {
    let centre = mean(&frame.positions_m);
    let radius = gyration(&frame.positions_m);
    let pairs = frame.positions_m.iter().zip(&frame.velocities_m_s).filter(|(x, _)| !x[0].is_nan());
    let outward: f64 = pairs.map(|(x, u)| dot(&subtract(x, &centre), u)).sum();
    if radius > 0.0 { outward / (count(there(&frame.positions_m).count()) * radius) } else { 0.0 }
}
