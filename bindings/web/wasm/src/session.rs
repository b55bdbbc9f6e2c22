//! One open world, in the plane.

use closeranks_core::need::{Keep, Need};
use closeranks_core::num::{Vector, subtract};
use closeranks_core::robot::neighbor::{Member, RobotId};
use closeranks_sim::attack::MotionAttack;
use closeranks_sim::law::Verdict;
use closeranks_sim::parse;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::given::Given;
use closeranks_sim::world::{Options, World, want};
use serde_json::{Value, json};

use crate::{facts, network};

/// Robots that a page shows at most.
const ROBOTS_MAX: u16 = 200;
/// Speed at which a robot is drawn, m/s.
const PULL_M_S: f64 = 1.0;
/// Distance within which a drawn robot slows down, m.
const ARRIVAL_M: f64 = 0.1;

/// Numbers before those of robots: ticks computed, number of links.
pub(crate) const HEAD: usize = 2;
/// Numbers a robot: x, y, m; u_x, u_y, m/s; degree (neighbours that count for it), level, told level, h, value, outcome (0 free, 1 active, 2 infeasible,
/// 3 recovering), values used in the last round, and those of normal robots among them.
pub(crate) const FIELDS: usize = 12;

/// A world and its last tick as numbers.
pub(crate) struct Session {
    world: World<2>,
    frame: Vec<f64>,
    /// Who counts for whom, where the scenario has ranks.
    ranked: Option<Ranked>,
}

/// The rule of a team with ranks.
struct Ranked {
    need: Need,
    members: Vec<Member>,
}

impl Ranked {
    /// The rule of a scenario; `None` without ranks.
    fn new(scenario: &Scenario) -> Option<Self> {
        let ranks = scenario.ranks::<2>().ok()??;
        let (team, core) = (scenario.team, scenario.ranking()?.core());
        let need = Need::ranked(team.robots, core, team.faults, Keep::Neighbors);
        let members =
            (1..=team.robots).zip(ranks).map(|(robot, rank)| Member { id: RobotId(robot), rank }).collect();
        Some(Self { need, members })
    }

    /// How many robots in range count for the robot of an index.
    fn degree(&self, index: usize, positions_m: &[Vector<2>], radius_m: f64) -> u32 {
        let me = self.members[index];
        let counted = self.members.iter().zip(positions_m).filter(|(other, position_m)| {
            let [x, y] = subtract(position_m, &positions_m[index]);
            self.need.counts(me, **other) && x * x + y * y <= radius_m * radius_m
        });
        counted.map(|_| 1).sum()
    }
}

impl Session {
    /// Reads a scenario and computes its first tick.
    pub(crate) fn open(text: &str) -> Result<Self, Value> {
        let problem = |line: usize, message: String| json!({ "line": line, "message": message });
        let scenario = parse::scenario(text).map_err(|problems| {
            problems.iter().map(|found| problem(found.line(text), found.to_string())).collect::<Value>()
        })?;
        if scenario.dimension != 2 {
            return Err(json!([problem(1, "`dimension` is 3, allowed on this page is 2".to_owned())]));
        }
        if !scenario.teams.is_empty() {
            let message = "`teams`: this page shows one team, allowed is [team]".to_owned();
            return Err(json!([problem(1, message)]));
        }
        if !scenario.absences.is_empty() {
            let message = "`team.absent`: this page does not show robots that come and go".to_owned();
            return Err(json!([problem(1, message)]));
        }
        let robots = scenario.team.robots;
        if robots > ROBOTS_MAX {
            let message = format!("`team.robots` is {robots}, allowed on this page is at most {ROBOTS_MAX}");
            return Err(json!([problem(1, message)]));
        }
        let options = Options { digest: true, without_phi: true, ..Options::default() };
        let world = World::new(&scenario, options).map_err(|error| json!([problem(1, error.to_string())]))?;
        let mut session = Self { world, frame: Vec::new(), ranked: Ranked::new(&scenario) };
        session.step(1);
        Ok(session)
    }

    /// Computes up to so many ticks, not beyond the last.
    pub(crate) fn step(&mut self, ticks: u32) -> u32 {
        for _ in 0..ticks {
            if self.world.is_over() {
                break;
            }
            self.world.step();
        }
        self.world.ticks_done()
    }

    /// Computes so many ticks while one robot is drawn towards a point.
    pub(crate) fn pull(&mut self, ticks: u32, robot: u32, to_m: [f64; 2]) -> u32 {
        let index = (robot as usize).wrapping_sub(1);
        for _ in 0..ticks {
            if self.world.is_over() {
                break;
            }
            let mut frame = self.world.frame().clone();
            want(self.world.scenario(), self.world.ticks_done(), &mut frame);
            if let Some(desired) = frame.desired_m_s.get_mut(index) {
                *desired = toward(&frame.positions_m[index], &to_m);
            }
            let given = Given { desired_m_s: Some(&frame.desired_m_s), ..Given::default() };
            if self.world.step_with(&given).is_err() {
                break;
            }
        }
        self.world.ticks_done()
    }

    /// The last tick, [`HEAD`] numbers and then [`FIELDS`] for each robot.
    pub(crate) fn frame(&mut self) -> &[f64] {
        let (frame, radius_m) = (self.world.frame(), self.world.scenario().link.radius_m);
        self.frame.clear();
        self.frame.extend([f64::from(self.world.ticks_done()), f64::from(frame.links)]);
        for index in 0..frame.positions_m.len() {
            self.frame.extend(frame.positions_m[index]);
            self.frame.extend(frame.velocities_m_s[index]);
            let among = |ranked: &Ranked| f64::from(ranked.degree(index, &frame.positions_m, radius_m));
            let degree = self.ranked.as_ref().map_or(f64::from(frame.degrees[index]), among);
            self.frame.extend([degree, frame.levels[index], frame.told[index]]);
            self.frame.extend([frame.h[index], frame.values[index], f64::from(frame.outcomes[index] as u8)]);
            self.frame.extend(frame.heard[index].map(f64::from));
        }
        &self.frame
    }

    /// What does not change while the world goes on.
    pub(crate) fn facts(&self) -> Value {
        let scenario = self.world.scenario();
        json!({
            "name": scenario.name,
            "robots": scenario.team.robots,
            "faults": scenario.team.faults,
            "required": self.world.monitors().required_degree(),
            "ranks": self.ranked.as_ref().map(|ranked| ranked.members.iter().map(|member| member.rank).collect::<Vec<_>>()),
            "needs": self.ranked.as_ref().map(|ranked| ranked.members.iter().map(|member| ranked.need.need(*member)).collect::<Vec<_>>()),
            "malicious": scenario.malicious,
            "radius_m": scenario.link.radius_m,
            "distance_min_m": scenario.limits.distance_min_m,
            "tick_s": scenario.tick_s(),
            "ticks": scenario.ticks(),
            "ticks_per_round": scenario.ticks_per_round(),
            "rule": facts::rule(scenario.consensus.rule),
            "controller": facts::controller(scenario.controller),
            "obedient": scenario.attack.motion == MotionAttack::Obedient,
            "one_voice": scenario.attack.has_one_voice(),
            "head": HEAD,
            "fields": FIELDS,
        })
    }

    /// Least and greatest so far, and what became of each law that the controller is held to or that was broken.
    pub(crate) fn report(&self) -> Value {
        let (scenario, monitors) = (self.world.scenario(), self.world.monitors());
        let extremes = monitors.extremes();
        let laws = monitors.verdicts().iter().filter(|verdict| scenario.controller.watches(verdict.law));
        json!({
            "degree_min": extremes.degree_min,
            "h_min": finite(extremes.h_min),
            "distance_min_m": finite(extremes.distance_min_m),
            "spread": finite(extremes.spread),
            "laws": laws.map(|verdict| law(scenario, verdict)).collect::<Value>(),
        })
    }

    /// The robustness of the network as it is now.
    pub(crate) fn network(&self, nodes: u32) -> Value {
        let scenario = self.world.scenario();
        let positions = &self.world.frame().positions_m;
        network::network(positions, scenario.link.radius_m, scenario.team.faults, u64::from(nodes))
    }

    /// The digest of all ticks so far.
    pub(crate) fn digest(&self) -> u64 {
        self.world.digest().unwrap_or_default()
    }
}

/// The velocity towards a point, slower when it is near; none if the point is no point.
fn toward([x, y]: &[f64; 2], [to_x, to_y]: &[f64; 2]) -> [f64; 2] {
    let way = [to_x - x, to_y - y];
    let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
    if !(length.is_finite() && length > 0.0) {
        return [0.0; 2];
    }
    let speed = PULL_M_S * (length / ARRIVAL_M).min(1.0);
    way.map(|component| component / length * speed)
}

fn law(scenario: &Scenario, verdict: &Verdict) -> Value {
    let first = verdict.first.map(|first| {
        let robots: Vec<u16> = first.robots.into_iter().filter(|robot| *robot > 0).collect();
        json!({ "tick": first.tick, "robots": robots, "seen": finite(first.seen), "demanded": finite(first.demanded) })
    });
    json!({
        "name": verdict.law.name(),
        "demand": verdict.law.demand(),
        "promised": scenario.controller.promises(verdict.law),
        "broken": verdict.count,
        "covered": verdict.covered,
        "first": first,
    })
}

fn finite(number: f64) -> Option<f64> {
    number.is_finite().then_some(number)
}
