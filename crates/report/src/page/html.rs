//! One self-contained page: no script, no network, figures inline.

use crate::page::content::{Claim, Figure, Page, Section, Table};
use crate::svg::escape;

/// Look of the page, in light, dark and print.
const STYLE: &str = include_str!("page.css");

/// Everything before the title.
const START: &str = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
    <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";

/// The page as an HTML5 document.
///
/// Every text is escaped; only [`Figure::svg`] is taken as it is, from its root element on, so it must come from
/// [`crate::figure`] or be as trustworthy. The same page gives the same bytes.
#[must_use]
pub fn html(page: &Page) -> String {
    let sections: String =
        page.sections.iter().enumerate().map(|(index, part)| section(index, part)).collect();
    [
        START,
        &element("title", &page.title),
        "<style>\n",
        STYLE,
        "</style>\n</head>\n<body>\n<main>\n<header>\n",
        &element("h1", &page.title),
        &paragraph("lead", &page.lead),
        &contents(&page.sections),
        "</header>\n",
        &sections,
        "</main>\n<footer>\n",
        &paragraph("", &page.footer),
        "</footer>\n</body>\n</html>\n",
    ]
    .concat()
}

fn element(name: &str, text: &str) -> String {
    format!("<{name}>{}</{name}>\n", escape(text))
}

/// A paragraph, or nothing if there is no text.
fn paragraph(class: &str, text: &str) -> String {
    match (text, class) {
        ("", _) => String::new(),
        (text, "") => element("p", text),
        (text, class) => format!("<p class=\"{class}\">{}</p>\n", escape(text)),
    }
}

/// Where to find what; a page with one part needs none.
fn contents(sections: &[Section]) -> String {
    if sections.len() < 2 {
        return String::new();
    }
    let link = |(index, part): (usize, &Section)| {
        format!("<li><a href=\"#part-{}\">{}</a></li>\n", index + 1, escape(&part.title))
    };
    let links: String = sections.iter().enumerate().map(link).collect();
    format!("<nav aria-label=\"Contents\">\n<ul>\n{links}</ul>\n</nav>\n")
}

fn section(index: usize, section: &Section) -> String {
    let mut text = format!("<section id=\"part-{}\">\n", index + 1);
    text += &element("h2", &section.title);
    text.extend(section.paragraphs.iter().map(|words| paragraph("", words)));
    text.extend(section.tables.iter().map(|(caption, content)| table(caption, content)));
    text.extend(section.figures.iter().map(figure));
    text += &claims(&section.claims);
    text + "</section>\n"
}

/// A table that scrolls sideways where it is too wide, also by keyboard. The first column names the rows.
fn table(caption: &str, table: &Table) -> String {
    let heads: String = (0..table.heads.len()).map(|column| head(column, table)).collect();
    let rows: String = table.rows.iter().map(|cells| row(cells, table.heads.len())).collect();
    let label = escape(caption);
    format!(
        "<div class=\"scroll\" role=\"region\" aria-label=\"{label}\" tabindex=\"0\">\n<table>\n\
         <caption>{label}</caption>\n<thead>\n<tr>{heads}</tr>\n</thead>\n<tbody>\n{rows}</tbody>\n</table>\n</div>\n"
    )
}

/// The head of a column, aligned as what is below it.
fn head(column: usize, table: &Table) -> String {
    let mut cells = table.rows.iter().filter_map(|row| row.get(column)).filter(|text| !text.is_empty());
    let class = if column > 0 && cells.all(|text| is_number(text)) { " class=\"number\"" } else { "" };
    format!("<th scope=\"col\"{class}>{}</th>", escape(&table.heads[column]))
}

/// A row; short ones are filled up.
fn row(cells: &[String], columns: usize) -> String {
    let blank = String::new();
    let width = columns.max(cells.len());
    let cells = cells.iter().chain(core::iter::repeat(&blank)).take(width).enumerate();
    let cells: String = cells.map(|(column, text)| cell(column, text)).collect();
    format!("<tr>{cells}</tr>\n")
}

fn cell(column: usize, text: &str) -> String {
    match (column, is_number(text)) {
        (0, _) => format!("<th scope=\"row\">{}</th>", escape(text)),
        (_, true) => format!("<td class=\"number\">{}</td>", escape(text)),
        (_, false) => format!("<td>{}</td>", escape(text)),
    }
}

/// Numbers are aligned to the right.
fn is_number(text: &str) -> bool {
    text.trim_start_matches(['-', '\u{2212}', '+']).starts_with(|first: char| first.is_ascii_digit())
}

/// Sentences with a mark each: a word, a symbol and a colour say the same.
fn claims(claims: &[Claim]) -> String {
    if claims.is_empty() {
        return String::new();
    }
    format!("<ul class=\"claims\">\n{}</ul>\n", claims.iter().map(claim).collect::<String>())
}

fn claim(claim: &Claim) -> String {
    let (class, symbol, word) =
        if claim.holds { ("holds", "✓", "holds") } else { ("fails", "✗", "does not hold here") };
    format!(
        "<li class=\"{class}\">\n<p><strong class=\"mark\"><span aria-hidden=\"true\">{symbol}</span> {word}</strong> \
         <q>{}</q></p>\n{}</li>\n",
        escape(&claim.sentence),
        paragraph("numbers", &claim.numbers)
    )
}

fn figure(figure: &Figure) -> String {
    let root = figure.svg.find("<svg").map_or("", |start| &figure.svg[start..]);
    format!(
        "<figure>\n<div class=\"card\">\n{root}</div>\n<figcaption>{}</figcaption>\n</figure>\n",
        escape(&figure.caption)
    )
}
