//! What a run came to, in sentences: where it started and what became of each law.

use core::fmt::Write as _;

use closeranks_sim::controllers::{Counted, Inside};
use closeranks_sim::law::{Law, Verdict};
use closeranks_sim::output::attendance::Attendance;
use closeranks_sim::output::summary::Summary;
use closeranks_sim::scenario::Scenario;

use super::content::{LawLine, Mark};
use super::table::{number, telling, uses_phi};

/// Where the start lies, and when a start outside came inside.
#[must_use]
pub fn start(scenario: &Scenario, summary: &Summary) -> String {
    let start = &summary.start;
    let row = scenario.controller.row();
    let measure = match row.inside {
        Inside::Shares => format!("least phi_i {}, ", telling(start.phi_min, 4)),
        Inside::Margins => format!("least h {}{}, ", number(start.h_min, 3), weight(scenario)),
        Inside::Degrees => String::new(),
    };
    let place = format!(
        "{measure}least degree {}, least distance {} m",
        start.degree_min,
        number(start.distance_min_m, 3)
    );
    if !keeps_degrees(scenario) {
        return format!("start: {place}; {} keeps no degrees", row.name);
    }
    if start.inside {
        return format!("start: inside the safe set ({place})");
    }
    let came = match summary.extremes.inside_from {
        _ if row.inside != Inside::Shares => "recovering".to_owned(),
        Some(tick) => format!("inside from t = {}", time(scenario, tick)),
        None => "never inside".to_owned(),
    };
    let safe = match summary.extremes.safe_from {
        Some(tick) => format!("degrees and distances hold from t = {} to the end", time(scenario, tick)),
        None => "degrees and distances do not hold at the end".to_owned(),
    };
    format!("start: OUTSIDE the safe set ({place}): no theorem covers this run; {came}; {safe}")
}

/// By which weight of links h is judged.
fn weight(scenario: &Scenario) -> String {
    scenario.link_shape().map_or_else(
        |_| String::new(),
        |link| {
            let (q2, epsilon) = (telling(link.q2, 3), telling(link.q1 - 2.0, 3));
            format!(" by links with q2 = {q2} and epsilon = {epsilon}")
        },
    )
}

/// True if the controller promises to keep degrees.
fn keeps_degrees(scenario: &Scenario) -> bool {
    let row = scenario.controller.row();
    row.promises.contains(&Law::Degree) && row.counted != Counted::All
}

/// Where to ask what is possible, if the start of `file` lies outside the safe set.
#[must_use]
pub fn advice(scenario: &Scenario, summary: &Summary, file: &str) -> Option<String> {
    let is_outside = keeps_degrees(scenario) && !summary.start.inside;
    is_outside
        .then(|| format!("note: `closeranks advise {file}` says which starts, speeds and F are possible"))
}

/// What stands below the table of a run: a warning, who is of which team, what ranks there are, and who came and went.
#[must_use]
pub fn notes(scenario: &Scenario, summary: &Summary) -> Vec<String> {
    let notes = [warning(scenario), teams(scenario), ranks(scenario, summary), presence(scenario, summary)];
    notes.into_iter().flatten().collect()
}

/// A warning when more robots lie than the team is prepared for.
#[must_use]
pub fn warning(scenario: &Scenario) -> Option<String> {
    if !scenario.teams.is_empty() {
        return scenario.teams.iter().find_map(warning);
    }
    let liars = scenario.malicious.len();
    (liars > usize::from(scenario.team.faults) && scenario.ranking().is_none()).then(|| {
        format!(
            "note: {liars} malicious robots, but the team is prepared for F = {}: no theorem covers this run",
            scenario.team.faults
        )
    })
}

/// Which robots are of which of several teams.
#[must_use]
pub fn teams(scenario: &Scenario) -> Option<String> {
    let mut first = 1;
    let of = |team: &Scenario| {
        let (robots, faults) = (team.team.robots, team.team.faults);
        let from = first;
        first += robots;
        format!("robots {from} to {} are `{}` with F = {faults}", from + robots - 1, team.name)
    };
    let teams: Vec<String> = scenario.teams.iter().map(of).collect();
    (!teams.is_empty()).then(|| {
        format!(
            "teams: {}; numbers of all together are the worst of them, distances those between all robots",
            teams.join(", ")
        )
    })
}

/// What ranks a team has, and where more than F malicious robots were around one robot: nothing is promised of such rounds.
#[must_use]
pub fn ranks(scenario: &Scenario, summary: &Summary) -> Option<String> {
    let ranks = super::numbers::ranks(scenario)?;
    let core: Vec<String> = (1..)
        .zip(&ranks)
        .filter(|(_, rank)| **rank == 0)
        .map(|(robot, _): (u16, _)| robot.to_string())
        .collect();
    let (shown, more) = core.split_at(core.len().min(CORE_SHOWN));
    let more = if more.is_empty() { String::new() } else { format!(" and {} others", more.len()) };
    let highest = ranks.iter().copied().max().unwrap_or(0);
    let faults = scenario.team.faults;
    let void = match (summary.void.rounds, summary.void.first) {
        (rounds, Some((tick, robot, liars))) => format!(
            "; at most F = {faults} liars around each robot was NOT so in {rounds} rounds, first at t = {}, when robot {robot} \
             listened to {liars}: nothing is promised of those",
            time(scenario, tick)
        ),
        _ => format!("; at most F = {faults} liars around each robot, {} in all", scenario.malicious.len()),
    };
    let core_size = core.len();
    Some(format!(
        "ranks: a core of {core_size} (robots {}{more}), ranks up to {highest}{void}",
        shown.join(", ")
    ))
}

/// Who came and went, and who had to wait.
#[must_use]
pub fn presence(scenario: &Scenario, summary: &Summary) -> Option<String> {
    let Attendance { left, arrived, refused, first } = summary.attendance;
    let waited = first.map_or_else(String::new, |(tick, robot, why)| {
        format!(
            "; in {refused} ticks a robot waited to come, first at t = {} robot {robot}: {why}",
            time(scenario, tick)
        )
    });
    (!scenario.absences.is_empty())
        .then(|| format!("presence: robots left {left} times and came {arrived} times{waited}"))
}

/// So many robots of a core are named.
const CORE_SHOWN: usize = 12;

/// What became of each law that is expected, or that was broken.
#[must_use]
pub fn law_lines(scenario: &Scenario, summary: &Summary) -> Vec<LawLine> {
    summary.verdicts.iter().filter_map(|verdict| law_line(scenario, verdict)).collect()
}

fn law_line(scenario: &Scenario, verdict: &Verdict) -> Option<LawLine> {
    let expected = scenario.expect.contains(&verdict.law);
    // φ belongs to the paper's controller; beside another one it says nothing.
    let is_foreign = verdict.law.is_about_phi() && !uses_phi(scenario);
    let mark = match (verdict.count > 0, expected) {
        (false, true) => Mark::Held,
        (true, true) => Mark::Broken,
        (true, false) if !is_foreign => Mark::NotExpected,
        _ => return None,
    };
    let mut detail = String::new();
    if verdict.count > 0 {
        detail = violation(scenario, verdict);
        if scenario.controller.promises(verdict.law) && scenario.controller.row().counted == Counted::Covered
        {
            detail = format!("{detail}; {}", covered(scenario, verdict));
        }
    }
    let (law, demand) = (verdict.law.name().to_owned(), verdict.law.demand().to_owned());
    Some(LawLine { law, demand, mark, detail })
}

/// One line for each law that was broken; those that were expected to hold are marked. Then those that held.
#[must_use]
pub fn laws(scenario: &Scenario, summary: &Summary) -> String {
    let mut out = String::new();
    let lines = law_lines(scenario, summary);
    for LawLine { law, demand, mark, detail } in &lines {
        let mark = match mark {
            Mark::Held => continue,
            Mark::Broken => "BROKEN",
            Mark::NotExpected => "broken, not expected to hold",
        };
        let (first, more) = detail.split_once("; ").unwrap_or((detail, ""));
        let _ = writeln!(out, "{law}: {mark}: {first} ({demand})");
        if !more.is_empty() {
            let _ = writeln!(out, "    {more}");
        }
    }
    let held = lines.iter().filter(|line| line.mark == Mark::Held).map(|line| line.law.as_str());
    let held: Vec<&str> = held.collect();
    if !held.is_empty() {
        let _ = writeln!(out, "held at every tick: {}", held.join(", "));
    }
    out
}

/// Whether that is a fault of the controller.
fn covered(scenario: &Scenario, verdict: &Verdict) -> String {
    match verdict.first_covered {
        None => "never where its assumptions held".to_owned(),
        Some(first) => {
            let (times, time) = (verdict.covered, time(scenario, first.tick));
            format!(
                "{times} times WHERE ITS ASSUMPTIONS HELD, first at t = {time}: a bug, or a hole in the theorem"
            )
        }
    }
}

/// How often, where first and by how much.
#[must_use]
pub fn violation(scenario: &Scenario, verdict: &Verdict) -> String {
    let Some(first) = verdict.first else { return "never".to_owned() };
    let who = match first.robots {
        [0, _] => String::new(),
        [robot, 0] => format!(", robot {robot}"),
        [robot, other] => format!(", robots {robot} and {other}"),
    };
    let amount = match verdict.law {
        Law::Feasible => "no input in the box satisfies the row".to_owned(),
        Law::Degree => format!("{}, demanded {}", number(first.seen, 0), number(first.demanded, 0)),
        _ => format!("{}, demanded {}", telling(first.seen, 4), number(first.demanded, 4)),
    };
    let times = if verdict.count == 1 { "once".to_owned() } else { format!("{} times", verdict.count) };
    format!("{times}, first at t = {}{who}: {amount}", time(scenario, first.tick))
}

fn time(scenario: &Scenario, tick: u32) -> String {
    format!("{} s", number(f64::from(tick) * scenario.tick_s(), 3))
}
