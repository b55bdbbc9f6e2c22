//! Texts that say they are scenarios.

use closeranks_sim::law::Law;
use closeranks_sim::output::record::Record;
use closeranks_sim::parse::{self, Problem, TEXT_MAX};
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::sweep::Plan;
use closeranks_sim::world::{Engine, Options, run};

/// Robots and ticks of the runs that are tried.
const ROBOTS: u16 = 12;
const TICKS: f64 = 20.0;
/// Texts that are drawn from, in bytes: what cannot be run is drawn a thousand times.
const DRAWN_MAX: usize = 1_500;

/// Any text is a scenario that can be run, or a list of problems with their places; and so is any text with draws.
pub fn scenario(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    if text.len() < DRAWN_MAX {
        draws(&text);
    }
    match parse::scenario(&text) {
        Ok(scenario) => is_runnable(&scenario),
        Err(problems) => are_placed(&problems, &text),
    }
}

/// Any text is a scenario, or a list of problems with their places. Nothing is drawn and nothing is run, which takes most of the time of
/// [`scenario`].
pub fn scenario_text(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    if let Err(problems) = parse::scenario(&text) {
        are_placed(&problems, &text);
    }
}

/// What is drawn from a text can be run.
fn draws(text: &str) {
    let problems = match Plan::read(text).map(|plan| plan.draw(1, 0)) {
        Ok(Ok(run)) => return run.scenarios.iter().for_each(|(scenario, _)| is_runnable(scenario)),
        Ok(Err(problems)) | Err(problems) => problems,
    };
    are_placed(&problems, text);
}

fn are_placed(problems: &[Problem], text: &str) {
    assert!(!problems.is_empty());
    for problem in problems {
        is_placed(problem, text);
    }
}

fn is_placed(problem: &Problem, text: &str) {
    assert!(!problem.found.is_empty() && !problem.to_string().is_empty(), "{problem:?}");
    assert!(text.get(problem.span.clone()).is_some() || text.len() > TEXT_MAX, "{problem:?}");
    assert!((1..=text.split('\n').count()).contains(&problem.line(text)), "{problem:?}");
}

fn is_runnable(scenario: &Scenario) {
    match scenario.dimension {
        2 => is_ready::<2>(scenario),
        3 => is_ready::<3>(scenario),
        other => panic!("dimension {other}"),
    }
    if scenario.team.robots <= ROBOTS {
        let short =
            Scenario { duration_s: scenario.duration_s.min(TICKS * scenario.tick_s()), ..scenario.clone() };
        runs(&short);
    }
}

fn is_ready<const D: usize>(scenario: &Scenario) {
    scenario.params::<D>().unwrap_or_else(|error| panic!("{error}"));
    let start = scenario.positions::<D>().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(start.len(), usize::from(scenario.team.robots));
    assert!(start.iter().flatten().all(|component| component.is_finite()));
}

/// Runs it with both engines, which must agree, and looks at every number.
fn runs(scenario: &Scenario) {
    let [team, robots] = [Engine::Team, Engine::Robots].map(|engine| {
        let options = Options { record: true, engine, ..Options::default() };
        run(scenario, options, &mut |_| ()).unwrap_or_else(|error| panic!("{error}"))
    });
    let record = team.record.unwrap_or_else(|| panic!("a record was asked for"));
    is_finite(&record);
    assert_eq!(team.summary.broken(Law::Input), 0, "{scenario:?}");
    if scenario.controller != Controller::None {
        assert_eq!(team.summary.broken(Law::Interval), 0, "{scenario:?}");
    }
    assert_eq!(Some(record.digest()), robots.record.map(|record| record.digest()), "{scenario:?}");
}

fn is_finite(record: &Record) {
    let single = [&record.level, &record.h, &record.value];
    let columns = record.positions_m.iter().chain(&record.inputs_m_s).chain(single);
    for (place, column) in columns.enumerate() {
        let stray = column.iter().position(|number| !number.is_finite());
        assert_eq!(stray, None, "row of column {place}");
    }
    let stray = record.phi.iter().position(|phi| phi.is_infinite());
    assert_eq!(stray, None, "phi of who is down is NaN, never infinite");
}
