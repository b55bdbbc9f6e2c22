//! `closeranks compare FILE`: the same scenario and seed under several controllers, side by side.

use anyhow::{Result, bail};
use clap::ValueEnum;
use closeranks_report::content::{Figure, Page, Section};
use closeranks_report::figure::{Case, figure1, figure2};
use closeranks_report::html::html;
use closeranks_report::png::{SCALE_200_DPI, png};
use closeranks_report::table::{Line, table, text};
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::{self, Options, Run};
use rayon::prelude::*;

use crate::folder::Folder;
use crate::{json, output, progress, sentences, source};

/// A controller by its name in scenario files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Name {
    /// The paper's.
    Composed,
    /// Ours.
    Budget,
    /// The desired velocity, cut to the box.
    None,
}

impl Name {
    /// What it names.
    pub(crate) fn controller(self) -> Controller {
        match self {
            Self::Composed => Controller::Composed,
            Self::Budget => Controller::Budget,
            Self::None => Controller::None,
        }
    }
}

/// A finished run.
struct Done {
    scenario: Scenario,
    run: Run,
    wall_s: f64,
}

/// Runs the scenario once a controller; false when a law that it expects was broken under one of them.
pub(crate) fn compare(arguments: &crate::Compare) -> Result<bool> {
    let (scenario, _) = source::scenario(&arguments.file)?;
    let scenario = Scenario { seed: arguments.seed.unwrap_or(scenario.seed), ..scenario };
    let repeated = |index: usize| arguments.controllers[..index].contains(&arguments.controllers[index]);
    if (0..arguments.controllers.len()).any(repeated) {
        bail!("`--controllers` names one twice; allowed is each of composed, budget, none once");
    }
    let folder = arguments.output.as_deref().map(Folder::new).transpose()?;
    let bar =
        progress::bar(arguments.controllers.len() as u64, arguments.speech.quiet || arguments.speech.json);
    let runs = arguments.controllers.par_iter().map(|name| {
        let done = done(&scenario, *name, folder.is_some());
        bar.inc(1);
        done
    });
    let runs = runs.collect::<Result<Vec<Done>>>()?;
    bar.finish_and_clear();
    tell(arguments, &runs);
    if let Some(folder) = folder {
        save(folder, &scenario, arguments, &runs)?;
    }
    Ok(runs.iter().all(|done| done.run.summary.failures(&done.scenario).next().is_none()))
}

fn done(scenario: &Scenario, name: Name, record: bool) -> Result<Done> {
    let named = Scenario { name: name.controller().name().to_owned(), ..scenario.clone() };
    let scenario = named.under(name.controller());
    let options = Options { record, robustness: true, ..Options::default() };
    let (run, time) = progress::timed(|| world::run(&scenario, options, &mut |_| ()));
    Ok(Done { run: run?, scenario, wall_s: time.as_secs_f64() })
}

impl Done {
    fn line(&self) -> Line<'_> {
        let Self { scenario, run, wall_s } = self;
        Line { scenario, summary: &run.summary, rounds: &run.rounds, wall_s: Some(*wall_s) }
    }
}

fn lines(runs: &[Done]) -> Vec<Line<'_>> {
    runs.iter().map(Done::line).collect()
}

fn tell(arguments: &crate::Compare, runs: &[Done]) {
    if arguments.speech.json {
        let all: Vec<_> = runs.iter().map(|done| json::run(&done.scenario, &done.run, done.wall_s)).collect();
        output::say(&json::text(&serde_json::json!({ "runs": all })));
    } else if !arguments.speech.quiet {
        output::say(&text(&table(&lines(runs))));
        for done in runs {
            let laws = sentences::laws(&done.scenario, &done.run.summary);
            output::say(&format!(
                "\n{}\n{}\n{laws}",
                done.scenario.name,
                sentences::start(&done.scenario, &done.run.summary)
            ));
        }
    }
}

fn save(mut folder: Folder, scenario: &Scenario, arguments: &crate::Compare, runs: &[Done]) -> Result<()> {
    let cases = runs.iter().filter_map(|done| {
        Some(Case { title: &done.scenario.name, scenario: &done.scenario, record: done.run.record.as_ref()? })
    });
    let cases: Vec<Case<'_>> = cases.collect();
    let captions = ["Formations at the start and at the end.", "Degree barriers and values over time."];
    let mut figures = Vec::new();
    for (name, (svg, caption)) in
        ["formations", "series"].into_iter().zip([figure1(&cases), figure2(&cases)].into_iter().zip(captions))
    {
        folder.add(format!("{name}.png"), png(&svg, SCALE_200_DPI)?);
        folder.add(format!("{name}.svg"), svg.as_bytes());
        figures.push(Figure { caption: caption.to_owned(), svg });
    }
    let section = Section {
        title: "Side by side".to_owned(),
        tables: vec![("One line a controller; heads as in the terminal.".to_owned(), table(&lines(runs)))],
        figures,
        ..Section::default()
    };
    let page = Page {
        title: format!("{}: controllers compared", scenario.name),
        lead: format!("The same scenario and seed ({}) under each controller.", scenario.seed),
        sections: vec![section],
        footer: format!("closeranks {}, commit {}", env!("CARGO_PKG_VERSION"), env!("CLOSERANKS_COMMIT")),
    };
    folder.add("report.html", html(&page));
    folder.write()?;
    if let (false, false, Some(target)) = (arguments.speech.quiet, arguments.speech.json, &arguments.output) {
        output::say(&format!(
            "\nwritten to {}: report.html, formations and series (SVG, PNG)\n",
            target.display()
        ));
    }
    Ok(())
}
