//! What a run of several teams came to together: the worst of all where one number is wanted, and sums where things are counted.

use core::ops::Range;

use closeranks_graph::verdict::Interval;

use crate::frame::Frame;
use crate::law::{Verdict, Verdicts, Violation};
use crate::monitors::robustness::Round;
use crate::monitors::{Extremes, Void};
use crate::output::attendance::Attendance;
use crate::output::conduct::Conduct;
use crate::output::summary::{StartSummary, Summary, gyration};
use crate::scenario::Scenario;
use crate::world::TeamRun;

/// The verdicts on all laws, of each team whose robots have these numbers, and of robots of different teams.
pub(super) fn verdicts<'a>(
    teams: &(impl Iterator<Item = (&'a Verdicts, &'a Range<usize>)> + Clone),
    between: &Verdicts,
) -> Verdicts {
    Verdicts::together(|law| {
        let of_teams = teams.clone().map(|(verdicts, place)| numbered(verdicts.of(law), place));
        of_teams.fold(*between.of(law), worse)
    })
}

/// With robots numbered through all teams.
fn numbered(verdict: &Verdict, place: &Range<usize>) -> Verdict {
    let number = |violation: Violation| Violation {
        robots: violation.robots.map(|robot| if robot == 0 { 0 } else { robot + small(place.start) }),
        ..violation
    };
    Verdict { first: verdict.first.map(number), first_covered: verdict.first_covered.map(number), ..*verdict }
}

fn worse(one: Verdict, other: Verdict) -> Verdict {
    let first = |one: Option<Violation>, other: Option<Violation>| {
        one.into_iter().chain(other).min_by_key(|violation| violation.tick)
    };
    Verdict {
        law: one.law,
        count: one.count + other.count,
        first: first(one.first, other.first),
        covered: one.covered + other.covered,
        first_covered: first(one.first_covered, other.first_covered),
    }
}

/// Of each round the least of all teams; `taken` has as many of each.
pub(super) fn rounds(taken: &[Vec<Round>]) -> Vec<Round> {
    let count = taken.iter().map(Vec::len).min().unwrap_or(0);
    let least = |place: usize| taken.iter().map(|rounds| rounds[place]).reduce(lesser);
    (0..count).filter_map(least).collect()
}

fn lesser(one: Round, other: Round) -> Round {
    let least = |one: Interval, other: Interval| Interval {
        least: one.least.min(other.least),
        most: one.most.min(other.most),
    };
    Round {
        tick: one.tick,
        r_max: least(one.r_max, other.r_max),
        f_max: least(one.f_max, other.f_max),
        degree_min: one.degree_min.min(other.degree_min),
        spread: one.spread.max(other.spread),
    }
}

/// One row for all teams. No two robots of different teams came nearer to each other than `least_m`.
pub(super) fn summary<const D: usize>(
    scenario: &Scenario,
    teams: &[TeamRun],
    places: &[Range<usize>],
    frame: &Frame<D>,
    least_m: f64,
    verdicts: &Verdicts,
) -> Summary {
    let all = || teams.iter().map(|team| &team.summary);
    let normal: Vec<f64> = scenario.teams.iter().map(normal_robots).collect();
    let mean = |of: &dyn Fn(&Summary) -> f64| {
        let sum: f64 = all().zip(&normal).map(|(summary, robots)| robots * of(summary)).sum();
        sum / normal.iter().sum::<f64>().max(1.0)
    };
    let most = |of: &dyn Fn(&Summary) -> f64| all().map(of).fold(0.0, f64::max);
    let liars = all().filter_map(|summary| summary.liar_distance_m);
    Summary {
        start: start(&all()),
        extremes: extremes(&all().map(|summary| summary.extremes), least_m),
        verdicts: *verdicts,
        gyration_m: gyration(&frame.positions_m),
        links: all().map(|summary| summary.links).sum(),
        liar_distance_m: liars.min_by(f64::total_cmp),
        speed_end_m_s: most(&|summary| summary.speed_end_m_s),
        spreading_m_s: [0, 1].map(|end| mean(&|summary| summary.spreading_m_s[end])),
        conduct: Conduct {
            progress_m: mean(&|summary| summary.conduct.progress_m),
            deviation_m_s: mean(&|summary| summary.conduct.deviation_m_s),
            jerk_m_s3: mean(&|summary| summary.conduct.jerk_m_s3),
            blocked_s: mean(&|summary| summary.conduct.blocked_s),
            deadlocked: all().any(|summary| summary.conduct.deadlocked),
        },
        guaranteed_share: mean(&|summary| summary.guaranteed_share),
        negative_share: mean(&|summary| summary.negative_share),
        covered_share: all().map(|summary| summary.covered_share).fold(1.0, f64::min),
        recovery_s: most(&|summary| summary.recovery_s),
        malicious_below: all().map(|summary| summary.malicious_below).sum(),
        void: void(all(), places),
        attendance: attendance(&all(), places),
        rounds: all().map(|summary| summary.rounds).max().unwrap_or(0),
        ticks: all().map(|summary| summary.ticks).max().unwrap_or(0),
    }
}

fn normal_robots(team: &Scenario) -> f64 {
    f64::from(team.team.robots) - f64::from(small(team.malicious.len()))
}

fn start<'a>(all: &(impl Iterator<Item = &'a Summary> + Clone)) -> StartSummary {
    let least = |of: &dyn Fn(&StartSummary) -> f64| {
        all.clone().map(|summary| of(&summary.start)).fold(f64::INFINITY, f64::min)
    };
    StartSummary {
        inside: all.clone().all(|summary| summary.start.inside),
        phi_min: least(&|start| start.phi_min),
        h_min: least(&|start| start.h_min),
        degree_min: all.clone().map(|summary| summary.start.degree_min).min().unwrap_or(0),
        distance_min_m: least(&|start| start.distance_min_m),
    }
}

fn extremes(all: &(impl Iterator<Item = Extremes> + Clone), least_m: f64) -> Extremes {
    let least = |of: &dyn Fn(&Extremes) -> f64| all.clone().map(|one| of(&one)).fold(f64::INFINITY, f64::min);
    // What every team must have reached is reached with the last of them, if by all.
    let last = |of: &dyn Fn(&Extremes) -> Option<u32>| {
        all.clone().map(|one| of(&one)).try_fold(0, |last, one| Some(one?.max(last)))
    };
    let lowest = |of: &dyn Fn(&Extremes) -> Option<u16>| all.clone().filter_map(|one| of(&one)).min();
    Extremes {
        degree_min: lowest(&|one| one.degree_min),
        malicious_degree_min: lowest(&|one| one.malicious_degree_min),
        h_min: least(&|one| one.h_min),
        distance_min_m: least(&|one| one.distance_min_m).min(least_m),
        clear_min_m: least(&|one| one.clear_min_m),
        phi_global_min: least(&|one| one.phi_global_min),
        phi_min: least(&|one| one.phi_min),
        inside_from: last(&|one| one.inside_from),
        safe_from: last(&|one| one.safe_from),
        rounds_to_agree: last(&|one| one.rounds_to_agree),
        spread: all.clone().map(|one| one.spread).fold(0.0, f64::max),
        spreads: [0, 1, 2].map(|place| all.clone().map(|one| one.spreads[place]).fold(0.0, f64::max)),
    }
}

fn void<'a>(all: impl Iterator<Item = &'a Summary> + Clone, places: &[Range<usize>]) -> Void {
    let first = all.clone().zip(places).filter_map(|(summary, place)| {
        let (tick, robot, liars) = summary.void.first?;
        Some((tick, robot + small(place.start), liars))
    });
    Void { first: first.min_by_key(|(tick, ..)| *tick), rounds: all.map(|summary| summary.void.rounds).sum() }
}

fn attendance<'a>(all: &(impl Iterator<Item = &'a Summary> + Clone), places: &[Range<usize>]) -> Attendance {
    let first = all.clone().zip(places).filter_map(|(summary, place)| {
        let (tick, robot, why) = summary.attendance.first?;
        Some((tick, robot + small(place.start), why))
    });
    let sum = |of: fn(&Attendance) -> u32| all.clone().map(|summary| of(&summary.attendance)).sum();
    Attendance {
        left: sum(|one| one.left),
        arrived: sum(|one| one.arrived),
        refused: sum(|one| one.refused),
        first: first.min_by_key(|(tick, ..)| *tick),
    }
}

fn small(number: usize) -> u16 {
    u16::try_from(number).unwrap_or(u16::MAX)
}
