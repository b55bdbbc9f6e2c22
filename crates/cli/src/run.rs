//! `closeranks run FILE`.

use anyhow::{Result, bail};
use closeranks_report::content::{Figure, Page, Section};
use closeranks_report::figure::{Case, overview};
use closeranks_report::html::html;
use closeranks_report::parquet::{Metadata, write};
use closeranks_report::png::{SCALE_200_DPI, png};
use closeranks_report::recording::rounds::write_rounds;
use closeranks_report::robustness::{RobustnessSeries, points, robustness};
use closeranks_report::table::{Line, table, text};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{self, Options, Run};

use crate::compare::Name;
use crate::folder::Folder;
use crate::{json, output, progress, sentences, source};

/// Runs one scenario; false when a law that it expects was broken.
pub(crate) fn run(arguments: &crate::Run) -> Result<bool> {
    let (scenario, source) = scenario(arguments)?;
    if arguments.print {
        output::say(&source);
        return Ok(true);
    }
    let folder = arguments.output.as_deref().map(Folder::new).transpose()?;
    let bar = progress::bar(u64::from(scenario.ticks()), arguments.speech.quiet);
    bar.set_message(scenario.name.clone());
    let options = Options { record: folder.is_some(), robustness: true, ..Options::default() };
    let (run, time) =
        progress::timed(|| world::run(&scenario, options, &mut |tick| bar.set_position(u64::from(tick))));
    bar.finish_and_clear();
    let run = run?;
    let wall_s = time.as_secs_f64();
    if arguments.speech.json {
        output::say(&json::text(&json::run(&scenario, &run, wall_s)));
    } else if !arguments.speech.quiet {
        output::say(&told(&scenario, &run, wall_s));
    }
    if let (Some(folder), Some(target)) = (folder, &arguments.output) {
        save(folder, &scenario, &source, &run, wall_s)?;
        if !arguments.speech.quiet && !arguments.speech.json {
            output::say(&format!(
                "written to {}: report.html, overview.svg, overview.png, robustness.svg, run.parquet, rounds.parquet\n",
                target.display()
            ));
        }
    }
    Ok(run.summary.failures(&scenario).next().is_none())
}

/// The scenario of the file, or one that is drawn from it.
fn scenario(arguments: &crate::Run) -> Result<(Scenario, String)> {
    let controller = arguments.controller.map(Name::controller);
    let Some(run) = arguments.draw else {
        let (mut scenario, source) = source::scenario(&arguments.file)?;
        scenario.seed = arguments.seed.unwrap_or(scenario.seed);
        if let Some(controller) = controller {
            scenario = scenario.under(controller);
        }
        return Ok((scenario, source));
    };
    let (plan, text) = source::plan(&arguments.file)?;
    let seed = arguments.sweep_seed.unwrap_or(crate::sweep::SEED);
    let drawn = source::draw(&arguments.file, &text, &plan, seed, run)?;
    let Some(controller) = controller.or_else(|| Some(drawn.scenarios.first()?.0.controller)) else {
        bail!("run {run} has no scenario");
    };
    // The draws of the sweep, whatever the controller.
    let name = format!("run {run} of {} under {}", source::name(&arguments.file), controller.name());
    source::read(&name, drawn.under(controller))
}

fn told(scenario: &Scenario, run: &Run, wall_s: f64) -> String {
    let line = Line { scenario, summary: &run.summary, rounds: &run.rounds, wall_s: Some(wall_s) };
    let start = sentences::start(scenario, &run.summary);
    let laws = sentences::laws(scenario, &run.summary);
    let warning = sentences::warning(scenario).map(|warning| warning + "\n").unwrap_or_default();
    format!("{}\n{start}\n{warning}{laws}", text(&table(&[line])))
}

fn save(mut folder: Folder, scenario: &Scenario, source: &str, run: &Run, wall_s: f64) -> Result<()> {
    let Some(record) = &run.record else { return Ok(()) };
    let svg = overview(Case { title: &scenario.name, scenario, record });
    folder.add("overview.png", png(&svg, SCALE_200_DPI)?);
    let metadata = Metadata {
        scenario: source,
        seed: scenario.seed,
        version: env!("CARGO_PKG_VERSION"),
        commit: env!("CLOSERANKS_COMMIT"),
    };
    let mut parquet = Vec::new();
    write(record, &metadata, &mut parquet)?;
    folder.add("run.parquet", parquet);
    let mut rounds = Vec::new();
    write_rounds(&run.rounds, scenario.tick_s(), &metadata, &mut rounds)?;
    folder.add("rounds.parquet", rounds);
    folder.add("robustness.svg", robustness(&[robustness_of(scenario, run)]));
    folder.add("report.html", html(&page(scenario, source, run, wall_s, svg.clone())));
    folder.add("overview.svg", svg);
    folder.write()
}

fn figure(caption: &str, svg: String) -> Figure {
    Figure { caption: caption.to_owned(), svg }
}

fn robustness_of<'a>(scenario: &'a Scenario, run: &'a Run) -> RobustnessSeries<'a> {
    RobustnessSeries {
        title: &scenario.name,
        faults: scenario.faults,
        points: points(&run.rounds, scenario.tick_s()),
    }
}

fn page(scenario: &Scenario, source: &str, run: &Run, wall_s: f64, svg: String) -> Page {
    let line = Line { scenario, summary: &run.summary, rounds: &run.rounds, wall_s: Some(wall_s) };
    let mut paragraphs = vec![sentences::start(scenario, &run.summary)];
    paragraphs.extend(sentences::warning(scenario));
    paragraphs.extend(sentences::laws(scenario, &run.summary).lines().map(str::to_owned));
    let outcome = Section {
        title: "What it came to".to_owned(),
        paragraphs,
        tables: vec![(
            "Least and greatest over the run; heads as in the terminal.".to_owned(),
            table(&[line]),
        )],
        figures: vec![
            figure("Formation at the start and at the end; degree barriers and values over time.", svg),
            figure(
                "Exact robustness of the network in every round.",
                robustness(&[robustness_of(scenario, run)]),
            ),
        ],
        ..Section::default()
    };
    let text = Section {
        title: "Scenario".to_owned(),
        paragraphs: source.lines().map(str::to_owned).collect(),
        ..Section::default()
    };
    Page {
        title: scenario.name.clone(),
        lead: format!("One run of closeranks, seed {}.", scenario.seed),
        sections: vec![outcome, text],
        footer: format!("closeranks {}, commit {}", env!("CARGO_PKG_VERSION"), env!("CLOSERANKS_COMMIT")),
    }
}
