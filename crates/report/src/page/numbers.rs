//! What a run came to, as numbers for machines: the command line prints them as JSON, bindings hand them out.

use closeranks_sim::law::{Law, Verdict};
use closeranks_sim::monitors::robustness::{narrowest, weakest};
use closeranks_sim::output::attendance::Attendance;
use closeranks_sim::output::conduct::Conduct;
use closeranks_sim::output::summary::Summary;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Run, TeamRun};
use serde_json::{Map, Value, json};

use super::table::uses_phi;

/// Which program ran it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Program<'a> {
    /// Its version.
    pub version: &'a str,
    /// The commit that it was built from.
    pub commit: &'a str,
}

/// What a run came to. Numbers that do not exist are null, and so is phi for controllers that do not use it.
/// Seconds are simulated ones.
#[must_use]
pub fn numbers(scenario: &Scenario, run: &Run, program: Program<'_>) -> Map<String, Value> {
    let summary = &run.summary;
    let weakest = weakest(&run.rounds);
    let phi = uses_phi(scenario);
    let extremes = &summary.extremes;
    let laws = summary.verdicts.iter().map(|verdict| (verdict.law.name().to_owned(), law(scenario, verdict)));
    let numbers = json!({
        "name": scenario.name,
        "seed": scenario.seed,
        "version": program.version,
        "commit": program.commit,
        "digest": run.digest.map(|digest| format!("{digest:016x}")),
        "weight": scenario.link_shape().ok().map(|link| json!({ "q2": link.q2, "epsilon": link.q1 - 2.0 })),
        "start": {
            "inside": summary.start.inside,
            "phi_min": phi.then_some(summary.start.phi_min),
            "h_min": summary.start.h_min,
            "degree_min": summary.start.degree_min,
            "distance_min_m": summary.start.distance_min_m,
            "inside_from_s": extremes.inside_from.map(|tick| f64::from(tick) * scenario.tick_s()),
            "safe_from_s": extremes.safe_from.map(|tick| f64::from(tick) * scenario.tick_s()),
        },
        "degree_min_normal": extremes.degree_min,
        "h_min_normal": extremes.h_min,
        "degree_min_malicious": extremes.malicious_degree_min,
        "malicious_below_required": summary.malicious_below,
        "distance_min_m": extremes.distance_min_m,
        "gyration_m": summary.gyration_m,
        "links": summary.links,
        "distance_to_malicious_m": summary.liar_distance_m,
        "rounds_to_agree": extremes.rounds_to_agree,
        "spread": extremes.spread,
        "infeasible": summary.broken(Law::Feasible),
        "phi_negative": phi.then_some(summary.broken(Law::Shares)),
        "phi_min": phi.then_some(extremes.phi_min),
        "phi_global_min": phi.then_some(extremes.phi_global_min),
        "r_max_least": narrowest(&run.rounds).map(|round| round.r_max.least),
        "f_max_least": weakest.map(|round| round.f_max.least),
        "guaranteed_share": summary.guaranteed_share,
        "negative_share": summary.negative_share,
        "recovery_s": summary.recovery_s,
        "violations": summary.violations(scenario).map(|verdict| verdict.count).sum::<u64>(),
        "duration_s": f64::from(summary.ticks) * scenario.tick_s(),
        "ticks": summary.ticks,
        "rounds": summary.rounds,
        "laws": laws.collect::<Map<_, _>>(),
        "ok": summary.failures(scenario).next().is_none(),
    });
    let mut numbers = if let Value::Object(numbers) = numbers { numbers } else { Map::new() };
    let more = [
        clear(scenario, extremes.clear_min_m),
        presence(scenario, &summary.attendance),
        spreads(scenario, extremes.spreads),
        teams(scenario, run, program),
    ];
    numbers.extend(conduct(&summary.conduct).into_iter().chain(more.into_iter().flatten()));
    numbers.extend(void(scenario, summary));
    numbers
}

/// The spread of each number of a value, if it has several.
fn spreads(scenario: &Scenario, spreads: [f64; 3]) -> Option<(String, Value)> {
    let numbers = scenario.consensus.dimension;
    (numbers > 1).then(|| ("spreads".to_owned(), json!(spreads[..numbers.min(3)])))
}

/// What each of several teams came to by itself; its robots have numbers of their own there.
fn teams(scenario: &Scenario, run: &Run, program: Program<'_>) -> Option<(String, Value)> {
    let alone = |(team, came): (&Scenario, &TeamRun)| {
        let TeamRun { summary, rounds } = came.clone();
        let run = Run { record: None, digest: None, rounds, summary, teams: Vec::new() };
        let mut numbers = self::numbers(team, &run, program);
        for shared in ["version", "commit", "digest"] {
            numbers.remove(shared);
        }
        numbers.insert("robots".to_owned(), json!(team.team.robots));
        Value::Object(numbers)
    };
    let all: Vec<Value> = scenario.teams.iter().zip(&run.teams).map(alone).collect();
    (!all.is_empty()).then(|| ("teams".to_owned(), json!(all)))
}

/// The ranks of a team, if it has any, and of how many rounds nothing is promised.
fn void(scenario: &Scenario, summary: &Summary) -> Vec<(String, Value)> {
    let Some(ranks) = ranks(scenario) else { return Vec::new() };
    let first = summary.void.first.map(|(tick, robot, liars)| {
        json!({ "time_s": f64::from(tick) * scenario.tick_s(), "robot": robot, "listened_to": liars })
    });
    let void = json!({ "rounds": summary.void.rounds, "first": first });
    vec![("ranks".to_owned(), json!(ranks)), ("void".to_owned(), void)]
}

/// Who came and went, if anybody does.
fn presence(scenario: &Scenario, attendance: &Attendance) -> Option<(String, Value)> {
    let Attendance { left, arrived, refused, first } = attendance;
    let first = first.map(|(tick, robot, why)| {
        json!({ "time_s": f64::from(tick) * scenario.tick_s(), "robot": robot, "why": why.to_string() })
    });
    let numbers =
        json!({ "left": left, "arrived": arrived, "refused_ticks": refused, "first_refused": first });
    (!scenario.absences.is_empty()).then(|| ("presence".to_owned(), numbers))
}

/// How near a normal robot came to an obstacle, if there are any.
fn clear(scenario: &Scenario, least_m: f64) -> Option<(String, Value)> {
    (!scenario.obstacles.list.is_empty()).then(|| ("clear_min_m".to_owned(), json!(least_m)))
}

/// How normal robots moved, means over them and the run.
fn conduct(conduct: &Conduct) -> [(String, Value); 5] {
    let Conduct { progress_m, deviation_m_s, jerk_m_s3, blocked_s, deadlocked } = *conduct;
    let numbers = [
        ("progress_m", json!(progress_m)),
        ("deviation_m_s", json!(deviation_m_s)),
        ("jerk_m_s3", json!(jerk_m_s3)),
        ("blocked_s", json!(blocked_s)),
        ("deadlocked", json!(deadlocked)),
    ];
    numbers.map(|(name, number)| (name.to_owned(), number))
}

/// The rank of each robot, if there are ranks.
pub(super) fn ranks(scenario: &Scenario) -> Option<Vec<u16>> {
    let ranks = match scenario.dimension {
        3 => scenario.ranks::<3>(),
        _ => scenario.ranks::<2>(),
    };
    ranks.ok().flatten()
}

/// What became of a law.
#[must_use]
pub fn law(scenario: &Scenario, verdict: &Verdict) -> Value {
    let first = verdict.first.map(|first| {
        json!({
            "time_s": f64::from(first.tick) * scenario.tick_s(),
            "tick": first.tick,
            "robots": first.robots.iter().filter(|robot| **robot > 0).collect::<Vec<_>>(),
            "seen": first.seen,
            "demanded": first.demanded,
        })
    });
    json!({
        "expected": scenario.expect.contains(&verdict.law),
        "broken": verdict.count,
        "broken_where_assumptions_hold": verdict.covered,
        "first": first,
    })
}
