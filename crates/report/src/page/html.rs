//! One self-contained page: no script, no network, figures inline.

use super::content::{Claim, Figure, LawLine, Link, Listing, Mark, Page, Section};
use super::html_table::table;
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
    text += &marked(&section.laws.iter().map(law).collect::<Vec<_>>());
    text.extend(section.tables.iter().map(|(caption, content)| table(caption, content)));
    text.extend(section.figures.iter().map(figure));
    text += &marked(&section.claims.iter().map(claim).collect::<Vec<_>>());
    text.extend(section.listings.iter().map(listing));
    text += &files(&section.files);
    text + "</section>\n"
}

/// Sentences with a mark each: a word, a symbol and a colour say the same.
fn marked(sentences: &[String]) -> String {
    if sentences.is_empty() {
        return String::new();
    }
    format!("<ul class=\"claims\">\n{}</ul>\n", sentences.concat())
}

/// One of them: `sentence` is markup, `numbers` is text.
fn sentence([class, symbol, word]: [&str; 3], sentence: &str, numbers: &str) -> String {
    format!(
        "<li class=\"{class}\">\n<p><strong class=\"mark\"><span aria-hidden=\"true\">{symbol}</span> {word}</strong> \
         {sentence}</p>\n{}</li>\n",
        paragraph("numbers", numbers)
    )
}

fn claim(claim: &Claim) -> String {
    let mark = if claim.holds { ["holds", "✓", "holds"] } else { ["fails", "✗", "does not hold here"] };
    let words = escape(&claim.sentence);
    let words = if claim.is_quotation { format!("<q>{words}</q>") } else { words };
    sentence(mark, &words, &claim.numbers)
}

fn law(line: &LawLine) -> String {
    let mark = match line.mark {
        Mark::Held => ["holds", "✓", "held"],
        Mark::Broken => ["fails", "✗", "broken"],
        Mark::NotExpected => ["apart", "–", "broken, not expected to hold"],
    };
    let words = format!("<b>{}</b>: {}", escape(&line.law), escape(&line.demand));
    sentence(mark, &words, &line.detail)
}

/// A text as it is, to be copied.
fn listing(listing: &Listing) -> String {
    let (caption, text) = (paragraph("", &listing.caption), escape(&listing.text));
    format!("{caption}<pre tabindex=\"0\"><code>{text}</code></pre>\n")
}

fn files(files: &[Link]) -> String {
    if files.is_empty() {
        return String::new();
    }
    let link = |link: &Link| {
        let file = escape(&link.file);
        format!("<li><a href=\"{file}\">{file}</a> {}</li>\n", escape(&link.what))
    };
    format!("<ul class=\"files\">\n{}</ul>\n", files.iter().map(link).collect::<String>())
}

/// Wide figures scroll sideways on a phone; their words would be too small to read.
const WIDE: f64 = 500.0;

fn figure(figure: &Figure) -> String {
    let root = figure.svg.find("<svg").map_or("", |start| &figure.svg[start..]);
    let class = if width_of(root) > WIDE { "card wide" } else { "card" };
    format!(
        "<figure>\n<div class=\"{class}\">\n{root}</div>\n<figcaption>{}</figcaption>\n</figure>\n",
        escape(&figure.caption)
    )
}

/// The width that an SVG document gives itself; 0 if it gives none.
fn width_of(root: &str) -> f64 {
    let head = root.split('>').next().unwrap_or_default();
    let width = head.split(" width=\"").nth(1).and_then(|rest| rest.split('"').next());
    width.and_then(|width| width.parse().ok()).unwrap_or(0.0)
}
