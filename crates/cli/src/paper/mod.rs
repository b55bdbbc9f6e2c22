//! `closeranks paper`: section V, three scenarios from two starts.

mod page;

use core::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use closeranks_report::claims::SectionFive;
use closeranks_report::content::{Claim, Link};
use closeranks_report::figure::{Case, figure1, figure2, figure3};
use closeranks_report::html::html;
use closeranks_report::robustness::robustness;
use closeranks_report::table::{Line, table, text};
use closeranks_sim::output::summary::Summary;
use closeranks_sim::parse;
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::{self, Options, Run};
use indicatif::ProgressBar;
use rayon::prelude::*;

use crate::as_run::as_run;
use crate::folder::Folder;
use crate::results::tape::{self, Tape, Target};
use crate::{json, output, pages, progress, sentences};

const TITLES: [&str; 3] = ["nominal updating", "understating", "overstating"];

/// The scenario files of each start, in the paper's order.
const STARTS: [(&str, [&str; 3]); 2] = [
    (
        "published",
        [
            include_str!("../../../../scenarios/published-nominal.toml"),
            include_str!("../../../../scenarios/published-understating.toml"),
            include_str!("../../../../scenarios/published-overstating.toml"),
        ],
    ),
    (
        "inside",
        [
            include_str!("../../../../scenarios/inside-nominal.toml"),
            include_str!("../../../../scenarios/inside-understating.toml"),
            include_str!("../../../../scenarios/inside-overstating.toml"),
        ],
    ),
];

/// A finished scenario.
struct Done {
    scenario: Scenario,
    text: &'static str,
    run: Run,
    wall_s: f64,
    /// Where it was recorded.
    recorded: Option<PathBuf>,
}

/// The finished scenarios of one start.
struct Start {
    name: &'static str,
    runs: Vec<Done>,
    claims: Vec<Claim>,
}

/// What is drawn of one start, and where it lies.
struct Drawn {
    figures: [String; 4],
    files: Vec<Link>,
}

/// Names of the figures.
const FIGURES: [&str; 4] = ["figure1", "figure2", "paths", "robustness"];

/// Runs, figures twice, recordings.
const STEPS: u64 = 6 + 2 * 8 + 6;

/// Runs everything; false when a law that a scenario expects was broken.
pub(crate) fn paper(arguments: &crate::Paper) -> Result<bool> {
    let mut folder = Folder::new(&arguments.output)?;
    arguments.record.as_deref().map(check_targets).transpose()?;
    let bar = progress::bar(STEPS, arguments.speech.quiet || arguments.speech.json);
    let starts = STARTS.iter().map(|(name, texts)| start(name, texts, arguments, &bar));
    let starts: Vec<Start> = starts.collect::<Result<_>>()?;
    let mut drawn = figures(&starts, &mut folder, &bar)?;
    data(&starts, &mut drawn, &mut folder, &bar)?;
    folder.add("report.html", html(&page::page(&starts, drawn)));
    folder.write()?;
    bar.finish_and_clear();
    if arguments.speech.json {
        output::say(&json::text(&numbers(&starts)));
    } else if !arguments.speech.quiet {
        output::say(&told(&starts));
        output::say(&format!("\nwritten to {0}: open {0}/report.html\n", arguments.output.display()));
        let runs = starts.iter().flat_map(|start| &start.runs);
        tape::say(runs.filter_map(|done| done.recorded.as_deref()));
    }
    Ok(starts
        .iter()
        .flat_map(|start| &start.runs)
        .all(|done| done.run.summary.failures(&done.scenario).next().is_none()))
}

fn start(
    name: &'static str,
    texts: &[&'static str; 3],
    arguments: &crate::Paper,
    bar: &ProgressBar,
) -> Result<Start> {
    bar.set_message(format!("start {name}"));
    let seed = arguments.seed;
    let scenarios =
        texts.iter().map(|text| parse::scenario(text).map(|scenario| Scenario { seed, ..scenario }));
    let scenarios: Result<Vec<Scenario>, _> = scenarios.collect();
    let scenarios =
        scenarios.map_err(|problems| anyhow::anyhow!("a scenario of our own is wrong: {problems:?}"))?;
    let unfiltered = Scenario { controller: Controller::None, ..scenarios[0].clone() };
    let unfiltered = world::run(&unfiltered, Options::default(), &mut |_| ())?;
    let tapes = scenarios.iter().zip(texts).map(|(scenario, text)| tape(arguments, scenario, text));
    let tapes = tapes.collect::<Result<Vec<_>>>()?;
    let work = scenarios.into_par_iter().zip(texts.par_iter()).zip(tapes);
    let runs = work.map(|((scenario, text), tape)| done(scenario, text, tape, bar));
    let runs = runs.collect::<Result<Vec<_>>>()?;
    let record = |index: usize| {
        runs.get(index).and_then(|done: &Done| done.run.record.as_ref()).context("a run was not recorded")
    };
    let five = SectionFive {
        required: runs[0].scenario.composition().required,
        distance_min_m: runs[0].scenario.limits.distance_min_m,
        runs: [0, 1, 2].map(|index| &runs[index].run.summary),
        records: [record(0)?, record(1)?, record(2)?],
        unfiltered: &unfiltered.summary,
    };
    Ok(Start { name, claims: five.claims(), runs })
}

/// Refuses recordings that cannot be written before anything is run.
fn check_targets(file: &Path) -> Result<()> {
    let texts = STARTS.iter().flat_map(|(_, texts)| texts);
    let mut names = texts.filter_map(|text| parse::scenario(text).ok()).map(|scenario| scenario.name);
    names.try_for_each(|name| Target::of(file, &name).map(|_| ()))
}

/// Begins the recording of a scenario, if there is to be one.
fn tape(arguments: &crate::Paper, scenario: &Scenario, text: &str) -> Result<Option<Tape>> {
    let Some(file) = &arguments.record else { return Ok(None) };
    let target = Target::of(file, &scenario.name)?;
    Tape::new(&target, scenario, &as_run(text, scenario)).map(Some)
}

fn done(scenario: Scenario, text: &'static str, mut tape: Option<Tape>, bar: &ProgressBar) -> Result<Done> {
    let options = Options { record: true, robustness: true, ..Options::default() };
    let mut watch = tape::record(&mut tape);
    let (run, time) = progress::timed(|| tape::run(&scenario, options, &mut |_| (), &mut watch));
    drop(watch);
    bar.inc(1);
    let run = run?;
    let recorded = tape.map(Tape::finish).transpose()?;
    Ok(Done { run, scenario, text, wall_s: time.as_secs_f64(), recorded })
}

/// The figures of each start; they go to the folder as SVG and PNG.
fn figures(starts: &[Start], folder: &mut Folder, bar: &ProgressBar) -> Result<Vec<Drawn>> {
    bar.set_message("figures");
    starts.iter().map(|start| drawn(start, folder, bar)).collect()
}

fn drawn(start: &Start, folder: &mut Folder, bar: &ProgressBar) -> Result<Drawn> {
    let cases = start.runs.iter().zip(TITLES).filter_map(|(done, title)| {
        Some(Case { title, scenario: &done.scenario, record: done.run.record.as_ref()? })
    });
    let cases: Vec<Case<'_>> = cases.collect();
    let series = start.runs.iter().zip(TITLES);
    let series = series.filter_map(|(done, title)| pages::robustness_of(title, &done.scenario, &done.run));
    let figures =
        [figure1(&cases), figure2(&cases), figure3(&cases), robustness(&series.collect::<Vec<_>>())];
    let names = FIGURES.map(|name| format!("{}-{name}", start.name));
    let named = names.iter().zip(&figures).map(|(name, svg)| (name.as_str(), svg.as_str()));
    let files = pages::add_figures(folder, &named.collect::<Vec<_>>(), &|| bar.inc(2))?;
    Ok(Drawn { figures, files })
}

/// Adds scenarios and recordings to what the page of each start links to.
fn data(starts: &[Start], drawn: &mut [Drawn], folder: &mut Folder, bar: &ProgressBar) -> Result<()> {
    bar.set_message("data");
    for (start, drawn) in starts.iter().zip(drawn) {
        for done in &start.runs {
            let name = &done.scenario.name;
            let names = [format!("{name}.toml"), format!("{name}.parquet"), format!("{name}-rounds.parquet")];
            let names = names.each_ref().map(String::as_str);
            let text = as_run(done.text, &done.scenario);
            drawn.files.extend(pages::add_data(folder, names, &text, &done.scenario, &done.run)?);
            bar.inc(1);
        }
    }
    Ok(())
}

fn lines<'a>(starts: impl Iterator<Item = &'a Start>) -> Vec<Line<'a>> {
    let runs = starts.flat_map(|start| &start.runs);
    runs.map(|done| Line {
        scenario: &done.scenario,
        summary: &done.run.summary,
        rounds: &done.run.rounds,
        wall_s: Some(done.wall_s),
    })
    .collect()
}

fn told(starts: &[Start]) -> String {
    let mut out = text(&table(&lines(starts.iter())));
    for start in starts {
        let _ = writeln!(out, "\nSection V from the start `{}`\n{}", start.name, start_sentence(start));
        for claim in &start.claims {
            let verdict = if claim.holds { "holds              " } else { "does not hold here " };
            let sentence =
                if claim.is_quotation { format!("\"{}\"", claim.sentence) } else { claim.sentence.clone() };
            let _ = writeln!(out, "  {verdict} {sentence}\n  {:19} {}", "", claim.numbers);
        }
    }
    for done in starts.iter().flat_map(|start| &start.runs) {
        for verdict in done.run.summary.failures(&done.scenario) {
            let what = sentences::violation(&done.scenario, verdict);
            let _ = writeln!(
                out,
                "\n{}: {}: BROKEN: {what} ({})",
                done.scenario.name,
                verdict.law.name(),
                verdict.law.demand()
            );
        }
    }
    out
}

fn start_sentence(start: &Start) -> String {
    let summary: &Summary = &start.runs[0].run.summary;
    sentences::start(&start.runs[0].scenario, summary)
}

fn numbers(starts: &[Start]) -> serde_json::Value {
    let start = |start: &Start| {
        let runs: Vec<_> =
            start.runs.iter().map(|done| json::run(&done.scenario, &done.run, done.wall_s)).collect();
        serde_json::json!({ "start": start.name, "runs": runs, "claims": json::claims(&start.claims) })
    };
    serde_json::json!({ "starts": starts.iter().map(start).collect::<Vec<_>>() })
}
