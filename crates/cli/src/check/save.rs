//! The folder of `closeranks check -o`: picture and page.

use anyhow::Result;
use closeranks_report::content::{Figure, Link, Page, Section};
use closeranks_report::html::html;
use closeranks_report::network::{Network, network};
use closeranks_report::png::{SCALE_200_DPI, png};

use super::answer::Answer;
use super::input::Input;
use crate::folder::Folder;
use crate::results::pages;

/// Writes `graph.svg`, `graph.png` and `report.html`.
pub(super) fn save(mut folder: Folder, input: &Input, answer: &Answer) -> Result<()> {
    let [first, second, exempt] = answer.sets;
    let svg = network(&Network {
        graph: &input.reading.named.graph,
        names: &input.reading.named.names,
        title: &answer.caption,
        first,
        second,
        exempt,
        labels: answer.labels,
    });
    folder.add("graph.png", png(&svg, SCALE_200_DPI)?);
    folder.add("report.html", html(&page(input, answer, svg.clone())));
    folder.add("graph.svg", svg);
    folder.write()
}

fn page(input: &Input, answer: &Answer, svg: String) -> Page {
    let section = Section {
        title: "How many liars it survives".to_owned(),
        paragraphs: answer.read.iter().chain([&answer.graph]).chain(&answer.why).cloned().collect(),
        tables: answer.table.iter().map(|table| (TABLE.to_owned(), table.clone())).collect(),
        figures: vec![Figure { caption: caption(answer), svg }],
        files: vec![
            Link::new("graph.svg", "the picture, for print"),
            Link::new("graph.png", "and for slides"),
        ],
        ..Section::default()
    };
    Page {
        title: format!("Robustness of {}", input.name),
        lead: answer.sentence.clone(),
        sections: vec![section],
        footer: pages::footer("check"),
    }
}

const TABLE: &str = "For each r the largest s with (r,s)-robustness. Any F liars are survived if row F + 1 has s of F + 1 or more.";

fn caption(answer: &Answer) -> String {
    let [first, second, exempt] = answer.labels;
    let shapes = [(first, "blue circles"), (second, "orange diamonds"), (exempt, "red squares")];
    let said = shapes.iter().zip(answer.sets).filter(|(_, set)| !set.is_empty());
    let said: Vec<String> = said.map(|((label, shape), _)| format!("{label}: {shape}")).collect();
    format!("{}. {}", answer.caption, said.join("; "))
}
