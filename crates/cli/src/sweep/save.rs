//! Figures and page of a finished sweep.

use anyhow::Result;
use closeranks_report::content::{Link, Page, Section};
use closeranks_report::html::html;
use closeranks_report::png::{SCALE_200_DPI, png};
use closeranks_report::sweep::broken;
use closeranks_report::sweep::figure::{gyrations, shares};
use closeranks_report::sweep::spread::Spread;
use closeranks_report::sweep::tables::{controllers, values};

use closeranks_sweep::outcome::Outcome;
use closeranks_sweep::store::Store;

use crate::pages;

pub(super) use closeranks_sweep::store::PAGES;

/// Writes [`PAGES`].
pub(crate) fn save(store: &Store, outcome: &Outcome<'_>, spread: &Spread) -> Result<()> {
    let laws = shares(outcome.tally, outcome.laws);
    let gyration = gyrations(outcome.tally, spread);
    for (name, svg) in [("laws", &laws), ("gyration", &gyration)] {
        store.put(&format!("{name}.svg"), svg.as_bytes())?;
        store.put(&format!("{name}.png"), &png(svg, SCALE_200_DPI)?)?;
    }
    store.put("report.html", html(&page(outcome, store.rows(), laws, gyration)).as_bytes())
}

fn page(outcome: &Outcome<'_>, rows: &str, laws: String, gyration: String) -> Page {
    let text = Section {
        title: "Sweep file and data".to_owned(),
        listings: vec![pages::scenario("What was drawn from:", &outcome.manifest.text)],
        files: files(rows),
        ..Section::default()
    };
    Page {
        title: format!("Sweep of {}", outcome.manifest.file.rsplit('/').next().unwrap_or_default()),
        lead: format!("{}.", outcome.head()),
        sections: vec![came_to(outcome, laws, gyration), by_value(outcome), violations(outcome), text],
        footer: pages::footer("sweep"),
    }
}

fn files(rows: &str) -> Vec<Link> {
    vec![
        Link::new(rows, "one row a run and controller: what was drawn and what it came to (docs/sweeps.md)"),
        Link::new("sweep.json", "what decides the rows: file, seed, number of runs, shard, version"),
        Link::new("laws.svg", "share of runs in which each law was violated"),
        Link::new("laws.png", "and for slides"),
        Link::new("gyration.svg", "radius of gyration at the end"),
        Link::new("gyration.png", "and for slides"),
    ]
}

fn came_to(outcome: &Outcome<'_>, laws: String, gyration: String) -> Section {
    let caption =
        "Runs in which a law was violated; \"at most\" is the exact one-sided bound of Clopper and Pearson.";
    Section {
        title: "What it came to".to_owned(),
        tables: vec![
            (caption.to_owned(), controllers(outcome.tally, outcome.laws)),
            (broken::CAPTION.to_owned(), broken::table(outcome.tally)),
        ],
        figures: vec![
            pages::figure("Share of runs in which each law was violated; hollow where it never was.", laws),
            pages::figure("Radius of gyration of the team at the end: farther right is wider.", gyration),
        ],
        ..Section::default()
    }
}

fn by_value(outcome: &Outcome<'_>) -> Section {
    let table = values(outcome.tally);
    let none = "No field was drawn from a few values.".to_owned();
    Section {
        title: "By drawn value".to_owned(),
        paragraphs: if table.rows.is_empty() { vec![none] } else { Vec::new() },
        tables: if table.rows.is_empty() {
            Vec::new()
        } else {
            vec![("Violating runs of all runs with this value.".to_owned(), table)]
        },
        ..Section::default()
    }
}

fn violations(outcome: &Outcome<'_>) -> Section {
    let told = outcome.violating();
    let none = "No promised law was violated.".to_owned();
    Section {
        title: "First violations".to_owned(),
        paragraphs: if told.is_empty() { vec![none] } else { Vec::new() },
        listings: told
            .iter()
            .map(|(what, command)| pages::scenario(&format!("{what}. To repeat it:"), command))
            .collect(),
        ..Section::default()
    }
}
