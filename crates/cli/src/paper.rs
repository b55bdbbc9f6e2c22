//! `closeranks paper`: section V, three scenarios from two starts.

use core::fmt::Write as _;

use anyhow::Result;
use closeranks_report::claims::SectionFive;
use closeranks_report::content::{Claim, Figure, Page, Section};
use closeranks_report::figure::{Case, figure1, figure2};
use closeranks_report::html::html;
use closeranks_report::parquet::{Metadata, write};
use closeranks_report::png::{SCALE_200_DPI, png};
use closeranks_report::recording::rounds::write_rounds;
use closeranks_report::robustness::{RobustnessSeries, points, robustness};
use closeranks_report::table::{Line, table, text};
use closeranks_sim::output::summary::Summary;
use closeranks_sim::parse;
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::{self, Options, Run};
use indicatif::ProgressBar;
use rayon::prelude::*;

use crate::folder::Folder;
use crate::{json, output, progress, sentences};

const TITLES: [&str; 3] = ["nominal updating", "understating", "overstating"];

/// The scenario files of each start, in the paper's order.
const STARTS: [(&str, [&str; 3]); 2] = [
    (
        "published",
        [
            include_str!("../../../scenarios/published-nominal.toml"),
            include_str!("../../../scenarios/published-understating.toml"),
            include_str!("../../../scenarios/published-overstating.toml"),
        ],
    ),
    (
        "inside",
        [
            include_str!("../../../scenarios/inside-nominal.toml"),
            include_str!("../../../scenarios/inside-understating.toml"),
            include_str!("../../../scenarios/inside-overstating.toml"),
        ],
    ),
];

/// A finished scenario.
struct Done {
    scenario: Scenario,
    text: &'static str,
    run: Run,
    wall_s: f64,
}

/// The finished scenarios of one start.
struct Start {
    name: &'static str,
    runs: Vec<Done>,
    claims: Vec<Claim>,
}

/// Runs everything; false when a law that a scenario expects was broken.
pub(crate) fn paper(arguments: &crate::Paper) -> Result<bool> {
    let mut folder = Folder::new(&arguments.output)?;
    let bar = progress::bar(24, arguments.speech.quiet || arguments.speech.json);
    let starts = STARTS.iter().map(|(name, texts)| start(name, texts, arguments.seed, &bar));
    let starts: Vec<Start> = starts.collect::<Result<_>>()?;
    let figures = figures(&starts, &mut folder, &bar)?;
    data(&starts, arguments.seed, &mut folder, &bar)?;
    folder.add("report.html", html(&page(&starts, figures)));
    folder.write()?;
    bar.finish_and_clear();
    if arguments.speech.json {
        output::say(&json::text(&numbers(&starts)));
    } else if !arguments.speech.quiet {
        output::say(&told(&starts));
        output::say(&format!("\nwritten to {0}: open {0}/report.html\n", arguments.output.display()));
    }
    Ok(starts
        .iter()
        .flat_map(|start| &start.runs)
        .all(|done| done.run.summary.failures(&done.scenario).next().is_none()))
}

fn start(name: &'static str, texts: &[&'static str; 3], seed: u64, bar: &ProgressBar) -> Result<Start> {
    bar.set_message(format!("start {name}"));
    let scenarios =
        texts.iter().map(|text| parse::scenario(text).map(|scenario| Scenario { seed, ..scenario }));
    let scenarios: Result<Vec<Scenario>, _> = scenarios.collect();
    let scenarios =
        scenarios.map_err(|problems| anyhow::anyhow!("a scenario of our own is wrong: {problems:?}"))?;
    let unfiltered = Scenario { controller: Controller::None, ..scenarios[0].clone() };
    let unfiltered = world::run(&unfiltered, Options::default(), &mut |_| ())?;
    let work = scenarios.into_par_iter().zip(texts.par_iter());
    let runs = work.map(|(scenario, text)| done(scenario, text, bar)).collect::<Result<Vec<_>>>()?;
    let params = runs[0].scenario.params::<2>()?;
    let five = SectionFive {
        required: params.required_degree(),
        distance_min_m: runs[0].scenario.distance_min_m,
        runs: [0, 1, 2].map(|index| &runs[index].run.summary),
        unfiltered: &unfiltered.summary,
    };
    Ok(Start { name, claims: five.claims(), runs })
}

fn done(scenario: Scenario, text: &'static str, bar: &ProgressBar) -> Result<Done> {
    let options = Options { record: true, robustness: true, ..Options::default() };
    let (run, time) = progress::timed(|| world::run(&scenario, options, &mut |_| ()));
    bar.inc(1);
    Ok(Done { run: run?, scenario, text, wall_s: time.as_secs_f64() })
}

/// The figures of each start, as SVG; SVG and PNG go to the folder.
fn figures(starts: &[Start], folder: &mut Folder, bar: &ProgressBar) -> Result<Vec<[String; 3]>> {
    bar.set_message("figures");
    let drawn = starts.iter().map(|start| {
        let cases = start.runs.iter().zip(TITLES).filter_map(|(done, title)| {
            Some(Case { title, scenario: &done.scenario, record: done.run.record.as_ref()? })
        });
        let cases: Vec<Case<'_>> = cases.collect();
        [figure1(&cases), figure2(&cases), robustness(&robustness_series(start))]
    });
    let drawn: Vec<[String; 3]> = drawn.collect();
    let named = starts.iter().zip(&drawn).flat_map(|(start, pair)| {
        pair.iter()
            .zip(1..)
            .map(move |(svg, number)| (format!("{}-{}", start.name, figure_name(number)), svg))
    });
    let named: Vec<(String, &String)> = named.collect();
    let painted = named.par_iter().map(|(name, svg)| {
        let bytes = png(svg, SCALE_200_DPI)?;
        bar.inc(2);
        Ok((name, svg, bytes))
    });
    for (name, svg, bytes) in painted.collect::<Result<Vec<_>>>()? {
        folder.add(format!("{name}.svg"), svg.as_bytes());
        folder.add(format!("{name}.png"), bytes);
    }
    Ok(drawn)
}

fn figure_name(number: u32) -> String {
    if number < 3 { format!("figure{number}") } else { "robustness".to_owned() }
}

fn robustness_series(start: &Start) -> Vec<RobustnessSeries<'_>> {
    start.runs.iter().zip(TITLES).map(|(done, title)| robustness_of(done, title)).collect()
}

fn robustness_of<'a>(done: &'a Done, title: &'a str) -> RobustnessSeries<'a> {
    RobustnessSeries {
        title,
        faults: done.scenario.faults,
        points: points(&done.run.rounds, done.scenario.tick_s()),
    }
}

fn data(starts: &[Start], seed: u64, folder: &mut Folder, bar: &ProgressBar) -> Result<()> {
    bar.set_message("data");
    for done in starts.iter().flat_map(|start| &start.runs) {
        let Some(record) = &done.run.record else { continue };
        let (version, commit) = (env!("CARGO_PKG_VERSION"), env!("CLOSERANKS_COMMIT"));
        let metadata = Metadata { scenario: done.text, seed, version, commit };
        let (mut bytes, mut rounds) = (Vec::new(), Vec::new());
        write(record, &metadata, &mut bytes)?;
        write_rounds(&done.run.rounds, done.scenario.tick_s(), &metadata, &mut rounds)?;
        folder.add(format!("{}.parquet", done.scenario.name), bytes);
        folder.add(format!("{}-rounds.parquet", done.scenario.name), rounds);
        bar.inc(1);
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
            let _ = writeln!(out, "  {verdict} {}\n  {:19} {}", claim.sentence, "", claim.numbers);
        }
    }
    for done in starts.iter().flat_map(|start| &start.runs) {
        for verdict in done.run.summary.failures(&done.scenario) {
            let what = sentences::violation(&done.scenario, verdict);
            let _ = writeln!(out, "\n{}: {}: BROKEN: {what}", done.scenario.name, verdict.law.name());
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

fn page(starts: &[Start], figures: Vec<[String; 3]>) -> Page {
    let summary = Section {
        title: "All runs".to_owned(),
        paragraphs: vec![
            "Least values are over the whole run of 10 s; gyration, links and distances are those of the last tick. \
             Two starts: “published” as read from the paper's figure, where robots 1 and 10 stand 0.22 m apart, closer \
             than the 0.3 m that the paper demands; and “inside”, ours, a hexagonal patch in which every hypothesis \
             holds. Which robot has which place in “inside” was chosen so that the paper's effects show together, as \
             they do for one assignment in four."
                .to_owned(),
        ],
        tables: vec![("One line a scenario.".to_owned(), table(&lines(starts.iter())))],
        ..Section::default()
    };
    let sections = starts.iter().zip(figures).map(|(start, pictures)| section(start, pictures));
    Page {
        title: "Distributed resilience-aware control, section V".to_owned(),
        lead: "The simulations of Lee and Panagou, computed again from the equations. Each sentence of their section V is \
               held against the numbers."
            .to_owned(),
        sections: core::iter::once(summary).chain(sections).collect(),
        footer: format!(
            "closeranks {}, commit {}: closeranks paper",
            env!("CARGO_PKG_VERSION"),
            env!("CLOSERANKS_COMMIT")
        ),
    }
}

fn section(start: &Start, pictures: [String; 3]) -> Section {
    let captions = [
        "Fig. 1: (a) the start, (b)-(d) formations at the end of the three scenarios. Normal robots are blue circles, \
         malicious ones red squares; dotted lines are links, red ones involve a malicious robot.",
        "Fig. 2: (a)-(c) h_i of every robot; normal robots must stay above 0. (d)-(f) values y_i; malicious robots draw \
         theirs anew in every round.",
        "Exact robustness of the network in every consensus round: largest r for which it is r-robust, and largest F for \
         which it is (F+1, F+1)-robust. All robots count here, malicious ones too, so F_max may fall below what the degrees \
         of normal robots guarantee (docs/robustness.md).",
    ];
    let figures = pictures.into_iter().zip(captions);
    Section {
        title: format!("From the start “{}”", start.name),
        paragraphs: vec![start_sentence(start)],
        tables: Vec::new(),
        claims: start.claims.clone(),
        figures: figures.map(|(svg, caption)| Figure { caption: caption.to_owned(), svg }).collect(),
    }
}
