//! A recorded run: robustness at every consensus round.

use core::fmt::Write as _;

use anyhow::{Context, Result, anyhow, bail};
use closeranks_graph::decide::Robustness;
use closeranks_graph::effort::{Effort, Meter, Progress};
use closeranks_graph::graph::Graph;
use closeranks_graph::makers::random::geometric;
use closeranks_graph::verdict::Interval;
use closeranks_report::content::{Figure, Page, Section};
use closeranks_report::html::html;
use closeranks_report::png::{SCALE_200_DPI, png};
use closeranks_report::recording::{Recording, read};
use closeranks_report::robustness::{Point, Survey, robustness};
use closeranks_report::table::number;
use closeranks_sim::parse;
use closeranks_sim::scenario::Scenario;
use serde_json::{Value, json};

use super::answer::Answer;
use super::{Check, analysis, words};
use crate::folder::Folder;
use crate::progress::Watch;

/// One moment of the run.
struct Round {
    tick: usize,
    time_s: f64,
    r_max: Interval,
    f_max: Interval,
}

/// Answers about the run in `file`; false if an F asked for is not survived in every round, or if not all was settled.
pub(super) fn check(arguments: &Check, name: &str, file: Vec<u8>, folder: Option<Folder>) -> Result<bool> {
    if arguments.r.is_some() || arguments.local || arguments.additions || !arguments.leaders.is_empty() {
        bail!("`{name}` is a recorded run: allowed with it are --F, --every, --time-limit, --json and -o");
    }
    let recording = read(file).with_context(|| format!("the recording `{name}` cannot be read"))?;
    let scenario = parse::scenario(&recording.scenario)
        .map_err(|problems| anyhow!(problems.first().map_or(String::new(), ToString::to_string)))
        .with_context(|| format!("the scenario in the metadata of `{name}` is wrong"))?;
    let every = arguments.every.unwrap_or(scenario.ticks_per_round()) as usize;
    let mut watch = Watch::new(arguments.time_limit, arguments.quiet);
    let rounds = rounds(&recording, &scenario, every, &mut watch)?;
    watch.finish();
    let faults = arguments.faults.map_or(scenario.team.faults, u16::from);
    let answer = answer(&recording, &scenario, faults, &rounds, arguments);
    if let Some(folder) = folder {
        save(folder, name, &answer, &rounds, faults)?;
    }
    super::tell(arguments, &answer, "report.html, robustness.svg, robustness.png, robustness.csv");
    Ok(answer.holds)
}

/// Every `every`-th tick; a graph that did not change is not asked again.
fn rounds(recording: &Recording, scenario: &Scenario, every: usize, watch: &mut Watch) -> Result<Vec<Round>> {
    let mut rounds: Vec<Round> = Vec::new();
    let mut before: Option<Graph> = None;
    for tick in (0..recording.ticks()).step_by(every) {
        let graph = geometric(recording.at(tick), scenario.link.radius_m)?;
        let (r_max, f_max) = match rounds.last() {
            Some(last) if before.as_ref() == Some(&graph) => (last.r_max, last.f_max),
            _ => largest(&graph, watch),
        };
        #[expect(clippy::cast_precision_loss, reason = "at most 20 million ticks")]
        let time_s = tick as f64 * scenario.tick_s();
        rounds.push(Round { tick, time_s, r_max, f_max });
        before = Some(graph);
    }
    Ok(rounds)
}

fn largest(graph: &Graph, watch: &mut Watch) -> (Interval, Interval) {
    let mut look = |progress: &Progress| watch.look(progress);
    let mut meter = Meter::new(u64::MAX, &mut look);
    let mut robustness = Robustness::new(graph, &Effort::UNLIMITED);
    (robustness.r_max(&mut meter), robustness.f_max(&mut meter))
}

fn answer(
    recording: &Recording,
    scenario: &Scenario,
    faults: u16,
    rounds: &[Round],
    arguments: &Check,
) -> Answer {
    let survived = rounds.iter().filter(|round| round.f_max.least >= i32::from(faults)).count();
    let exact = rounds.iter().all(|round| round.r_max.exactly().and(round.f_max.exactly()).is_some());
    let least_r = rounds.iter().min_by_key(|round| round.r_max.least);
    let least_f = rounds.iter().min_by_key(|round| round.f_max.least);
    let when = |round: Option<&Round>| {
        round.map_or(String::new(), |round| format!("t = {} s", number(round.time_s, 3)))
    };
    let (r, f) = (least_r.map_or(0, |round| round.r_max.least), least_f.map_or(0, |round| round.f_max.least));
    let liars = words::liars(usize::from(faults));
    let sentence = format!(
        "Survives any {liars} in {survived} of {} rounds ({} %); least F {f} (first at {}), least r {r} (first at {}).",
        rounds.len(),
        percent(survived, rounds.len()),
        when(least_f),
        when(least_r)
    );
    let open = "Some rounds were not settled within the time limit: their proved least numbers are counted.";
    Answer {
        holds: exact && (arguments.faults.is_none() || survived == rounds.len()),
        sentence,
        caption: format!("{}: r and F of every round", scenario.name),
        why: if exact { Vec::new() } else { vec![open.to_owned()] },
        graph: format!("{}, {} ticks, radius {} m", scenario.name, recording.ticks(), scenario.link.radius_m),
        numbers: numbers(recording, faults, survived, exact, rounds),
        ..Answer::default()
    }
}

/// Share in percent, rounded down: 100 means all.
fn percent(part: usize, all: usize) -> String {
    let tenths = part * 1000 / all.max(1);
    format!("{}.{}", tenths / 10, tenths % 10)
}

fn numbers(recording: &Recording, faults: u16, survived: usize, exact: bool, rounds: &[Round]) -> Value {
    let round = |round: &Round| {
        json!({
            "tick": round.tick,
            "time_s": round.time_s,
            "r_max": analysis::value(round.r_max),
            "f_max": analysis::value(round.f_max),
        })
    };
    json!({
        "n": recording.robots,
        "directed": false,
        "F": faults,
        "rounds_survived": survived,
        "r_max_least": rounds.iter().map(|round| round.r_max.least).min(),
        "f_max_least": rounds.iter().map(|round| round.f_max.least).min(),
        "proved": if exact { "exactly" } else { "bounds" },
        "rounds": rounds.iter().map(round).collect::<Vec<Value>>(),
    })
}

fn save(mut folder: Folder, name: &str, answer: &Answer, rounds: &[Round], faults: u16) -> Result<()> {
    let point =
        |round: &Round| Point { time_s: round.time_s, r_max: round.r_max.least, f_max: round.f_max.least };
    let points = rounds.iter().map(point).collect();
    let svg = robustness(&[Survey { title: &answer.caption, faults, points }]);
    folder.add("robustness.png", png(&svg, SCALE_200_DPI)?);
    folder.add("robustness.csv", table(rounds));
    let section = Section {
        title: "Robustness over time".to_owned(),
        paragraphs: [&answer.graph].into_iter().chain(&answer.why).cloned().collect(),
        figures: vec![Figure { caption: answer.caption.clone(), svg: svg.clone() }],
        ..Section::default()
    };
    folder.add(
        "report.html",
        html(&Page {
            title: format!("Robustness of {name}"),
            lead: answer.sentence.clone(),
            sections: vec![section],
            footer: format!("closeranks {}, commit {}", env!("CARGO_PKG_VERSION"), env!("CLOSERANKS_COMMIT")),
        }),
    );
    folder.add("robustness.svg", svg);
    folder.write()
}

/// One line a round; least and most are equal where the number is exact.
fn table(rounds: &[Round]) -> String {
    let mut text = "tick,time_s,r_max_least,r_max_most,f_max_least,f_max_most\n".to_owned();
    for Round { tick, time_s, r_max, f_max } in rounds {
        let _ =
            writeln!(text, "{tick},{time_s},{},{},{},{}", r_max.least, r_max.most, f_max.least, f_max.most);
    }
    text
}
