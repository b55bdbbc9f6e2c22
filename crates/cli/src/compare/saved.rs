//! What `compare` writes to a folder: figures, data and a page.

use anyhow::Result;
use closeranks_report::comparison::comparison;
use closeranks_report::content::{Figure, Link, Page, Section};
use closeranks_report::figure::{Case, comparison as drawing, figure1, figure2, figure3};
use closeranks_report::html::html;
use closeranks_report::robustness::robustness;
use closeranks_report::table::table;
use closeranks_sim::scenario::Scenario;

use super::{Done, lines};
use crate::folder::Folder;
use crate::{pages, sentences};

/// Writes everything; says which files.
pub(super) fn save(mut folder: Folder, scenario: &Scenario, runs: &[Done]) -> Result<String> {
    let figures = figures(runs);
    let named: Vec<(&str, &str)> = figures.iter().map(|(name, _, svg)| (*name, svg.as_str())).collect();
    let mut files = Vec::new();
    for done in runs {
        let name = &done.scenario.name;
        let names = [format!("{name}.toml"), format!("{name}.parquet"), format!("{name}-rounds.parquet")];
        let names = names.each_ref().map(String::as_str);
        files.extend(pages::add_data(&mut folder, names, &done.source, &done.scenario, &done.run)?);
    }
    files.extend(pages::add_figures(&mut folder, &named, &|| ())?);
    let names = pages::names(&files);
    let figures = figures.into_iter().map(|(_, caption, svg)| pages::figure(&caption, svg)).collect();
    folder.add("report.html", html(&page(scenario, runs, figures, files)));
    folder.write()?;
    Ok(format!("report.html, {names}"))
}

/// Name, caption and picture of each figure.
fn figures(runs: &[Done]) -> Vec<(&'static str, String, String)> {
    let cases = runs.iter().filter_map(|done| {
        Some(Case { title: &done.scenario.name, scenario: &done.scenario, record: done.run.record.as_ref()? })
    });
    let cases: Vec<Case<'_>> = cases.collect();
    let formations = format!("Formations at the start and at the end. {}", pages::FORMATIONS);
    let mut figures = vec![
        ("formations", formations, figure1(&cases)),
        ("paths", pages::PATHS.to_owned(), figure3(&cases)),
        ("series", pages::SERIES.to_owned(), figure2(&cases)),
        (
            "comparison",
            "What each controller came to; a line is what is demanded.".to_owned(),
            drawing(&lines(runs)),
        ),
    ];
    let series =
        runs.iter().filter_map(|done| pages::robustness_of(&done.scenario.name, &done.scenario, &done.run));
    let series: Vec<_> = series.collect();
    if !series.is_empty() {
        figures.push(("robustness", pages::ROBUSTNESS.to_owned(), robustness(&series)));
    }
    figures
}

fn page(scenario: &Scenario, runs: &[Done], figures: Vec<Figure>, files: Vec<Link>) -> Page {
    let side_by_side = Section {
        title: "Side by side".to_owned(),
        tables: vec![
            ("One line a controller; heads as in the terminal.".to_owned(), comparison(&lines(runs), None)),
            ("Degrees, links and programs of each.".to_owned(), table(&lines(runs))),
        ],
        figures,
        ..Section::default()
    };
    let verdicts = runs.iter().map(|done| Section {
        title: format!("Under {}", done.scenario.name),
        paragraphs: core::iter::once(sentences::start(&done.scenario, &done.run.summary))
            .chain(sentences::warning(&done.scenario))
            .collect(),
        laws: sentences::law_lines(&done.scenario, &done.run.summary),
        ..Section::default()
    });
    let texts =
        runs.iter().map(|done| pages::scenario(&format!("Under {}:", done.scenario.name), &done.source));
    let data = Section {
        title: "Scenarios and data".to_owned(),
        listings: texts.collect(),
        files,
        ..Section::default()
    };
    Page {
        title: format!("{}: controllers compared", scenario.name),
        lead: format!("The same scenario and seed ({}) under each controller.", scenario.seed),
        sections: core::iter::once(side_by_side).chain(verdicts).chain([data]).collect(),
        footer: pages::footer("compare"),
    }
}
