//! `closeranks run FILE`.

use anyhow::{Result, bail};
use closeranks_graph::graph::set::NODE_LIMIT;
use closeranks_report::content::{Link, Page, Section};
use closeranks_report::figure::{Case, MANY, animation, overview, swarm};
use closeranks_report::html::html;
use closeranks_report::robustness::robustness;
use closeranks_report::table::{lines_of, table, text};
use closeranks_sim::output::snapshot::Snapshot;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Options, Run};

use crate::as_run::as_run;
use crate::folder::Folder;
use crate::live::Live;
use crate::results::recorder::Recorder;
use crate::results::tape::{self, Tape, Target};
use crate::{invocation, json, output, pages, progress, sentences, source};

/// Name of the file with every tick.
const TICKS: &str = "run.parquet";
/// Name of the file with every consensus round.
const ROUNDS: &str = "rounds.parquet";

/// Name of the picture that moves.
const ANIMATION: &str = "animation.svg";

/// A finished run.
struct Done {
    scenario: Scenario,
    /// The scenario as it was run, TOML.
    source: String,
    run: Run,
    /// How long it took; none of a run that was shown at its own pace.
    wall_s: Option<f64>,
}

/// Runs one scenario; false when a law that it expects was broken.
pub(crate) fn run(arguments: &crate::Run) -> Result<bool> {
    let (scenario, source) = scenario(arguments)?;
    if arguments.print {
        output::say(&source);
        return Ok(true);
    }
    let source = as_run(&source, &scenario);
    let mut folder = arguments.output.as_deref().map(Folder::new).transpose()?;
    let recorder = folder
        .as_mut()
        .map(|folder| Recorder::new(folder, [TICKS, ROUNDS], &scenario, &source))
        .transpose()?;
    let mut live = arguments.live.then(|| Live::new(&scenario, arguments.speed)).transpose()?;
    let target = arguments.record.as_deref().map(Target::new).transpose()?;
    let mut tape = target.map(|target| Tape::new(&target, &scenario, &source)).transpose()?;
    let bar = progress::bar(u64::from(scenario.ticks()), arguments.speech.quiet || arguments.live);
    bar.set_message(scenario.name.clone());
    let unrecorded = Options { robustness: true, digest: true, ..Options::default() };
    let mut progress = |tick| bar.set_position(u64::from(tick));
    let mut watch = |now: &Snapshot<'_>| {
        tape.as_mut().map_or(Ok(()), |tape| tape.tick(now))?;
        live.as_mut().map_or(Ok(()), |live| live.tick(now))
    };
    let (run, time) = progress::timed(|| match recorder {
        Some(recorder) => recorder.run(&scenario, &mut progress, &mut watch),
        None => tape::run(&scenario, unrecorded, &mut progress, &mut watch),
    });
    bar.finish_and_clear();
    let done = Done { source, run: run?, scenario, wall_s: (!arguments.live).then_some(time.as_secs_f64()) };
    let recorded = tape.map(Tape::finish).transpose()?;
    if arguments.speech.json {
        output::say(&json::text(&json::run(&done.scenario, &done.run, done.wall_s.unwrap_or_default())));
    } else if !arguments.speech.quiet {
        output::say(&told(arguments, &done));
    }
    if let (Some(folder), Some(target)) = (folder, &arguments.output) {
        let files = save(folder, &done)?;
        if !arguments.speech.quiet && !arguments.speech.json {
            output::say(&format!("written to {}: {files}\n", target.display()));
        }
    }
    if !arguments.speech.quiet && !arguments.speech.json {
        tape::say(recorded.as_deref().into_iter());
    }
    Ok(done.run.summary.failures(&done.scenario).next().is_none())
}

/// The scenario of the file, or one that is drawn from it.
fn scenario(arguments: &crate::Run) -> Result<(Scenario, String)> {
    let controller = arguments.controller;
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

/// Says that nobody searched for exact robustness, in a team for which that cannot be done.
fn too_large(scenario: &Scenario) -> Option<String> {
    (usize::from(scenario.team.robots) > NODE_LIMIT).then(|| {
        format!("note: exact robustness is searched in teams of up to {NODE_LIMIT} robots, not here")
    })
}

fn told(arguments: &crate::Run, Done { scenario, run, wall_s, .. }: &Done) -> String {
    let start = sentences::start(scenario, &run.summary);
    let laws = sentences::laws(scenario, &run.summary);
    let mut notes = sentences::notes(scenario, &run.summary);
    notes.extend(too_large(scenario));
    if arguments.draw.is_none() {
        let file = invocation::quoted(&arguments.file.display().to_string());
        notes.extend(sentences::advice(scenario, &run.summary, &file));
    }
    let lines: Vec<&str> = [start.as_str()].into_iter().chain(notes.iter().map(String::as_str)).collect();
    let digest = run.digest.map(|digest| format!("digest: {digest:016x}\n")).unwrap_or_default();
    let rows = table(&lines_of(scenario, run, *wall_s));
    format!("{}\n{}\n{laws}{digest}", text(&rows), lines.join("\n"))
}

/// Writes everything; says which files.
fn save(mut folder: Folder, done: &Done) -> Result<String> {
    let Done { scenario, source, run, .. } = done;
    let Some(record) = &run.record else { return Ok(String::new()) };
    let case = Case { title: &scenario.name, scenario, record };
    let svg = if record.robots > MANY { swarm(&[case]) } else { overview(case) };
    let series = pages::robustness_of_all(&scenario.name, scenario, run);
    let robustness = (!series.is_empty()).then(|| robustness(&series));
    let mut figures = vec![("overview", svg.as_str())];
    figures.extend(robustness.as_deref().map(|svg| ("robustness", svg)));
    let mut files = pages::add_data(&mut folder, ["scenario.toml", TICKS, ROUNDS], source, scenario, run)?;
    files.extend(pages::add_figures(&mut folder, &figures, &|| ())?);
    if let Some(film) = animation(Case { title: &scenario.name, scenario, record }) {
        folder.add(ANIMATION, film);
        files.push(Link::new(ANIMATION, "the run in some seconds, as a picture that moves"));
    }
    let names = pages::names(&files);
    folder.add("report.html", html(&page(done, svg.clone(), robustness, files)));
    folder.write()?;
    Ok(format!("report.html, {names}"))
}

fn page(done: &Done, overview: String, robustness: Option<String>, files: Vec<Link>) -> Page {
    let Done { scenario, source, run, wall_s } = done;
    let mut paragraphs = vec![sentences::start(scenario, &run.summary)];
    paragraphs.extend(sentences::notes(scenario, &run.summary));
    let caption = if scenario.team.robots > MANY {
        pages::SWARM.to_owned()
    } else {
        format!("{} {} {}", pages::FORMATIONS, pages::PATHS, pages::SERIES)
    };
    let mut figures = vec![pages::figure(&caption, overview)];
    match robustness {
        Some(svg) => figures.push(pages::figure(pages::ROBUSTNESS, svg)),
        None => {
            paragraphs.push(format!("Exact robustness is searched in teams of up to {NODE_LIMIT} robots."));
        }
    }
    let outcome = Section {
        title: "What it came to".to_owned(),
        paragraphs,
        laws: sentences::law_lines(scenario, &run.summary),
        tables: vec![(
            "Least and greatest over the run; heads as in the terminal.".to_owned(),
            table(&lines_of(scenario, run, *wall_s)),
        )],
        figures,
        ..Section::default()
    };
    let data = Section {
        title: "Scenario and data".to_owned(),
        listings: vec![pages::scenario("As it was run, with its seed and controller:", source)],
        files,
        ..Section::default()
    };
    Page {
        title: scenario.name.clone(),
        lead: format!(
            "One run of closeranks under the controller {}, seed {}.",
            scenario.controller.name(),
            scenario.seed
        ),
        sections: vec![outcome, data],
        footer: pages::footer("run"),
    }
}
