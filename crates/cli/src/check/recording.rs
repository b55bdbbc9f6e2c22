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
use closeranks_report::recording::Recording;
use closeranks_report::robustness::{Point, Survey, robustness};
use closeranks_report::table::number;
use closeranks_sim::consensus::Rule;
use closeranks_sim::parse;
use closeranks_sweep::PROGRAM;
use serde_json::{Value, json};

use super::answer::Answer;
use super::{Check, analysis, rule, words};
use crate::folder::Folder;
use crate::progress::Watch;

/// One moment of the run.
struct Round {
    tick: usize,
    time_s: f64,
    r_max: Interval,
    f_max: Interval,
    degree_min: usize,
}

/// What is known of a recording besides its positions.
struct Setting {
    name: String,
    radius_m: f64,
    /// F of the scenario; others say none.
    faults: Option<u16>,
    /// How many ticks lie between two that are looked at.
    every: usize,
    /// Length of a tick of our own recordings.
    tick_s: f64,
}

impl Setting {
    fn of(recording: &Recording, name: &str, arguments: &Check) -> Result<Self> {
        let Some(text) = &recording.scenario else {
            let Some(radius_m) = arguments.radius else {
                bail!(
                    "`{name}` does not say how far robots hear each other: allowed is with --radius METRES"
                );
            };
            return Ok(Self { name: name.to_owned(), radius_m, faults: None, every: 1, tick_s: 1.0 });
        };
        let scenario = parse::scenario(text)
            .map_err(|problems| anyhow!(problems.first().map_or(String::new(), ToString::to_string)))
            .with_context(|| format!("the scenario in the metadata of `{name}` is wrong"))?;
        if scenario.obstacles.cut_links() {
            bail!(
                "in `{name}` obstacles cut links, which positions alone do not show: allowed is the `--robustness` of the run itself"
            );
        }
        Ok(Self {
            radius_m: arguments.radius.unwrap_or(scenario.link.radius_m),
            faults: Some(scenario.team.faults),
            every: scenario.ticks_per_round() as usize,
            tick_s: scenario.tick_s(),
            name: scenario.name,
        })
    }

    /// When, s; of a recording of others with ticks alone its tick.
    fn time_s(&self, recording: &Recording, tick: usize) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "at most 20 million ticks")]
        let ticks = tick as f64;
        recording.times.get(tick).copied().unwrap_or(ticks * self.tick_s)
    }
}

/// Answers about recorded positions; false if an F asked for is not survived in every round, or if not all was settled.
pub(super) fn check(
    arguments: &Check,
    name: &str,
    recording: &Recording,
    folder: Option<Folder>,
) -> Result<bool> {
    let exact =
        arguments.r.is_some() || arguments.local || arguments.additions || !arguments.leaders.is_empty();
    if exact || arguments.certificate.is_some() || arguments.hops.is_some() {
        bail!(
            "`{name}` is a recorded run: allowed with it are --F, --radius, --every, --window, --time-limit, --effort, --json and -o"
        );
    }
    let setting = Setting::of(recording, name, arguments)?;
    let mut watch = arguments.watch();
    let every = arguments.every.map_or(setting.every, |every| every as usize);
    let faults = arguments.faults.map(u16::from).or(setting.faults);
    let joint = arguments.window.map(|_| Rule::SwMsr);
    if let Some(rule) = arguments.rule.or(joint) {
        let (window, faults) = (arguments.window.map_or(5, usize::from), usize::from(faults.unwrap_or(0)));
        let answer = rule::recorded(
            recording,
            (rule, faults),
            (setting.radius_m, every, window),
            arguments.sets(),
            &mut watch,
        )?;
        watch.finish();
        super::tell(arguments, &answer, "");
        return Ok(answer.holds);
    }
    let rounds = rounds(recording, &setting, (every, arguments.sets()), &mut watch)?;
    watch.finish();
    let answer = answer(recording, &setting, faults, &rounds, arguments);
    if let Some(folder) = folder {
        save(folder, name, &answer, &rounds, faults.unwrap_or(0))?;
    }
    super::tell(arguments, &answer, "report.html, robustness.svg, robustness.png, robustness.csv");
    Ok(answer.holds)
}

/// Every `every`-th tick; a graph that did not change is not asked again.
fn rounds(
    recording: &Recording,
    setting: &Setting,
    (every, sets): (usize, u64),
    watch: &mut Watch,
) -> Result<Vec<Round>> {
    let mut rounds: Vec<Round> = Vec::new();
    let mut before: Option<Graph> = None;
    for tick in (0..recording.ticks()).step_by(every) {
        let graph = geometric(recording.at(tick), setting.radius_m)?;
        let (r_max, f_max) = match rounds.last() {
            Some(last) if before.as_ref() == Some(&graph) => (last.r_max, last.f_max),
            _ => largest(&graph, sets, watch),
        };
        let (time_s, degree_min) = (setting.time_s(recording, tick), graph.degree_min());
        rounds.push(Round { tick, time_s, r_max, f_max, degree_min });
        before = Some(graph);
    }
    Ok(rounds)
}

/// `sets` for each graph.
fn largest(graph: &Graph, sets: u64, watch: &mut Watch) -> (Interval, Interval) {
    let mut look = |progress: &Progress| watch.look(progress);
    let mut meter = Meter::new(sets, &mut look);
    let mut robustness = Robustness::new(graph, &Effort::UNLIMITED);
    (robustness.r_max(&mut meter), robustness.f_max(&mut meter))
}

fn answer(
    recording: &Recording,
    setting: &Setting,
    faults: Option<u16>,
    rounds: &[Round],
    arguments: &Check,
) -> Answer {
    let survives = |round: &&Round| round.f_max.least >= i32::from(faults.unwrap_or(0));
    let survived = rounds.iter().filter(survives).count();
    let exact = rounds.iter().all(|round| round.r_max.exactly().and(round.f_max.exactly()).is_some());
    let least_r = rounds.iter().min_by_key(|round| round.r_max.least);
    let least_f = rounds.iter().min_by_key(|round| round.f_max.least);
    let when = |round: Option<&Round>| {
        let time = |round: &Round| match recording.time_name {
            "tick" if recording.scenario.is_none() => format!("tick {}", round.time_s),
            _ => format!("t = {} s", number(round.time_s, 3)),
        };
        round.map_or(String::new(), time)
    };
    let (r, f) = (least_r.map_or(0, |round| round.r_max.least), least_f.map_or(0, |round| round.f_max.least));
    let degree = rounds.iter().map(|round| round.degree_min).min().unwrap_or(0);
    let survival = faults.map(|faults| {
        let (liars, count) = (words::liars(usize::from(faults)), rounds.len());
        format!("survives any {liars} in {survived} of {count} rounds ({} %); ", percent(survived, count))
    });
    let sentence = format!(
        "{}least F {f} (first at {}), least r {r} (first at {}).",
        survival.unwrap_or_default(),
        when(least_f),
        when(least_r)
    );
    let sentence = words::capital(&sentence);
    let open = "Some rounds were not settled within the limit: their proved least numbers are counted.";
    Answer {
        holds: exact && (arguments.faults.is_none() || survived == rounds.len()),
        sentence,
        caption: format!("{}: r and F of every round", setting.name),
        why: if exact { Vec::new() } else { vec![open.to_owned()] },
        graph: format!(
            "{}, {} robots, {} ticks, radius {} m, least degree {degree}",
            setting.name,
            recording.robots,
            recording.ticks(),
            setting.radius_m
        ),
        numbers: numbers(recording, faults, survived, exact, rounds),
        ..Answer::default()
    }
}

/// Share in percent, rounded down: 100 means all.
fn percent(part: usize, all: usize) -> String {
    let tenths = part * 1000 / all.max(1);
    format!("{}.{}", tenths / 10, tenths % 10)
}

fn numbers(
    recording: &Recording,
    faults: Option<u16>,
    survived: usize,
    exact: bool,
    rounds: &[Round],
) -> Value {
    let round = |round: &Round| {
        json!({
            "tick": round.tick,
            "time_s": round.time_s,
            "r_max": analysis::value(round.r_max),
            "f_max": analysis::value(round.f_max),
            "degree_min": round.degree_min,
        })
    };
    json!({
        "n": recording.robots,
        "directed": false,
        "F": faults,
        "rounds_survived": faults.map(|_| survived),
        "degree_least": rounds.iter().map(|round| round.degree_min).min(),
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
            footer: format!("closeranks {}, commit {}", PROGRAM.version, PROGRAM.commit),
        }),
    );
    folder.add("robustness.svg", svg);
    folder.write()
}

/// One line a round; least and most are equal where the number is exact.
fn table(rounds: &[Round]) -> String {
    let mut text = "tick,time_s,r_max_least,r_max_most,f_max_least,f_max_most,degree_min\n".to_owned();
    for Round { tick, time_s, r_max, f_max, degree_min } in rounds {
        let [r, f] = [r_max, f_max].map(|number| format!("{},{}", number.least, number.most));
        let _ = writeln!(text, "{tick},{time_s},{r},{f},{degree_min}");
    }
    text
}
