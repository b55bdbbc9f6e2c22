//! The page of `closeranks paper`.

use closeranks_report::content::{Page, Section};
use closeranks_report::table::table;

use super::{Drawn, Start, lines, start_sentence};
use crate::pages;

/// Everything on one page.
pub(super) fn page(starts: &[Start], drawn: Vec<Drawn>) -> Page {
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
    let sections = starts.iter().zip(drawn).map(|(start, drawn)| section(start, drawn));
    Page {
        title: "Distributed resilience-aware control, section V".to_owned(),
        lead: "The simulations of Lee and Panagou, computed again from the equations. Each sentence of their section V is \
               held against the numbers: in quotation marks as printed, without them in our words."
            .to_owned(),
        sections: core::iter::once(summary).chain(sections).collect(),
        footer: pages::footer("paper"),
    }
}

fn section(start: &Start, drawn: Drawn) -> Section {
    let captions = [
        format!(
            "Fig. 1: (a) the start, (b)-(d) formations at the end of the three scenarios. {}",
            pages::FORMATIONS
        ),
        format!("Fig. 2: (a)-(c) barriers, (d)-(f) values. {}", pages::SERIES),
        format!("Not in the paper: (a)-(c) paths, (d)-(f) distances. {}", pages::PATHS),
        format!("Not in the paper: {}", pages::ROBUSTNESS),
    ];
    let figures = drawn.figures.into_iter().zip(captions);
    Section {
        title: format!("From the start “{}”", start.name),
        paragraphs: vec![start_sentence(start)],
        claims: start.claims.clone(),
        figures: figures.map(|(svg, caption)| pages::figure(&caption, svg)).collect(),
        files: drawn.files,
        ..Section::default()
    }
}
