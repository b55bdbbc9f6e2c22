//! What a fleet came to.

use core::fmt;

use closeranks_sim::output::summary::Summary;
use closeranks_sim::scenario::Scenario;
use serde::Serialize;

use crate::fleet::camp::Camp;
use crate::gate::Reject;
use crate::plant::pace::Pace;

/// Below this share of reports in time a run shows little.
const TIMELY: f64 = 0.9;

/// Everything that is said at the end.
#[derive(Clone, Debug, Serialize)]
pub struct Verdict {
    /// Name of the scenario.
    pub name: String,
    /// Seed of its draws.
    pub seed: u64,
    /// Ticks that were watched, and their length, s.
    pub ticks: u32,
    /// τ₁, s.
    pub tick_s: f64,
    /// Laws that were broken although everything held that they rest on. There must be none.
    pub violations: Vec<Broken>,
    /// Laws that were broken while something did not hold that they rest on.
    pub excused: Vec<Broken>,
    /// Processes that ended although nobody ended them. There must be none.
    pub died: u64,
    /// Fraction of the time of normal robots in which they said that they were guaranteed.
    pub guaranteed_share: f64,
    /// Least degree of a normal robot, and F'.
    pub degree_min: Option<u16>,
    /// F'.
    pub degree_needed: u16,
    /// Least distance of two robots, m.
    pub distance_min_m: f64,
    /// Spread of the values of normal robots at the end.
    pub spread: f64,
    /// Reports of normal robots that did not come in time.
    pub late: u64,
    /// Fraction of the reports of normal robots that came in time. A body whose report is late stands still, so that a run in which few
    /// are in time shows little.
    pub timely_share: f64,
    /// Ticks in which this process had no time.
    pub overruns: u64,
    /// Robots that are proved two-faced.
    pub two_faced: Vec<u16>,
    /// Messages that an outsider put on the keys of the team.
    pub injected: u64,
    /// Envelopes that robots rejected, by reason.
    pub rejects: Vec<(&'static str, u64)>,
    /// What it cost.
    #[serde(flatten)]
    pub costs: Costs,
}

/// What a fleet costs.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Costs {
    /// Most memory of a robot at the start and at the end, kB.
    pub memory_kb: [u64; 2],
    /// Least, middle and greatest share of a core that a robot used.
    pub cpu_share: [f64; 3],
}

/// A law that was broken.
#[derive(Clone, Debug, Serialize)]
pub struct Broken {
    /// Which.
    pub law: &'static str,
    /// How often.
    pub count: u64,
    /// Where first: tick, robots, what was seen and what is demanded.
    pub first: Option<(u32, [u16; 2], f64, f64)>,
}

impl Verdict {
    /// What came of the run of `plant`.
    #[must_use]
    pub fn new<const D: usize>(
        scenario: &Scenario,
        plant: Pace<D>,
        camp: &Camp,
        costs: Costs,
        two_faced: Vec<u16>,
        injected: u64,
    ) -> Self {
        let overruns = plant.overruns();
        let world = plant.into_world();
        let (ticks, late) = (world.tick(), world.late());
        let normal =
            scenario.team.robots.saturating_sub(u16::try_from(scenario.malicious.len()).unwrap_or(0));
        let due = (f64::from(ticks) + 1.0) * f64::from(normal);
        #[expect(clippy::cast_precision_loss, reason = "counts of a run are far below 2^53")]
        let timely_share = 1.0 - late as f64 / due;
        let mut rejects = vec![0_u64; Reject::ALL.len()];
        for (_, report) in world.reports().iter().flatten() {
            for (sum, count) in rejects.iter_mut().zip(report.rejects) {
                *sum += u64::from(count);
            }
        }
        let rejects = Reject::ALL.map(Reject::name).into_iter().zip(rejects).filter(|(_, count)| *count > 0);
        let summary = world.finish();
        let broken = |law: closeranks_sim::law::Verdict| Broken {
            law: law.law.name(),
            count: law.count,
            first: law.first.map(|first| (first.tick, first.robots, first.seen, first.demanded)),
        };
        let violations: Vec<Broken> = summary.violations(scenario).map(broken).collect();
        let excused = excused(&summary, scenario, &violations);
        Self {
            name: scenario.name.clone(),
            seed: scenario.seed,
            ticks,
            tick_s: scenario.tick_s(),
            violations,
            excused,
            died: camp.died(),
            guaranteed_share: summary.guaranteed_share,
            degree_min: summary.extremes.degree_min,
            degree_needed: scenario.composition().required,
            distance_min_m: summary.extremes.distance_min_m,
            spread: summary.extremes.spread,
            late,
            timely_share,
            overruns,
            two_faced,
            injected,
            rejects: rejects.collect(),
            costs,
        }
    }

    /// True if nothing is held against it.
    #[must_use]
    pub fn is_good(&self) -> bool {
        self.violations.is_empty() && self.died == 0
    }
}

/// Promised laws that were broken and do not count.
fn excused(summary: &Summary, scenario: &Scenario, violations: &[Broken]) -> Vec<Broken> {
    let promised = scenario.controller.row().promises;
    let counted = |name| violations.iter().find(|broken| broken.law == name).map_or(0, |broken| broken.count);
    let rest =
        summary.verdicts.iter().filter(|verdict| promised.contains(&verdict.law)).map(|verdict| Broken {
            law: verdict.law.name(),
            count: verdict.count.saturating_sub(counted(verdict.law.name())),
            first: verdict.first.map(|first| (first.tick, first.robots, first.seen, first.demanded)),
        });
    rest.filter(|broken| broken.count > 0).collect()
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let seconds = f64::from(self.ticks) * self.tick_s;
        writeln!(
            f,
            "{}, seed {}: {} ticks of {} s, {seconds:.1} s",
            self.name, self.seed, self.ticks, self.tick_s
        )?;
        for broken in &self.violations {
            writeln!(f, "VIOLATION  {} {} times, first {:?}", broken.law, broken.count, broken.first)?;
        }
        for broken in &self.excused {
            writeln!(f, "outside its assumptions: {} {} times", broken.law, broken.count)?;
        }
        if self.died > 0 {
            writeln!(f, "VIOLATION  {} processes died", self.died)?;
        }
        let degree = self.degree_min.map_or_else(|| "-".into(), |degree| degree.to_string());
        writeln!(
            f,
            "least degree {degree}, needed {}; least distance {:.3} m",
            self.degree_needed, self.distance_min_m
        )?;
        writeln!(
            f,
            "guaranteed {:.1} % of the time; spread of values {:.3}",
            100.0 * self.guaranteed_share,
            self.spread
        )?;
        writeln!(
            f,
            "late reports {}, overruns {}, two-faced {:?}, injected {}",
            self.late, self.overruns, self.two_faced, self.injected
        )?;
        let rejects: Vec<String> =
            self.rejects.iter().map(|(name, count)| format!("{name} {count}")).collect();
        writeln!(f, "rejected: {}", if rejects.is_empty() { "nothing".into() } else { rejects.join(", ") })?;
        writeln!(
            f,
            "memory of a robot {} kB at the start, {} kB at the end; CPU {:.1} to {:.1} % of a core",
            self.costs.memory_kb[0],
            self.costs.memory_kb[1],
            100.0 * self.costs.cpu_share[0],
            100.0 * self.costs.cpu_share[2]
        )?;
        writeln!(f, "in time {:.1} % of the reports", 100.0 * self.timely_share)?;
        if self.timely_share < TIMELY {
            writeln!(f, "THIS SHOWS LITTLE: the machine is too slow for ticks of {} s", self.tick_s)?;
        }
        write!(f, "{}", if self.is_good() { "it held" } else { "IT DID NOT HOLD" })
    }
}
