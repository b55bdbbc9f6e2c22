//! The page: what is in it, and that nothing of it is taken for markup.

use closeranks_report::content::{Claim, Figure, LawLine, Link, Listing, Mark, Page, Section, Table};
use closeranks_report::html::html;

const NASTY: &str = "</title><script>\"a\" & 'b'</script>";
const SAFE: &str = "&lt;/title&gt;&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/script&gt;";

fn claim(holds: bool) -> Claim {
    Claim { sentence: NASTY.into(), is_quotation: holds, holds, numbers: NASTY.into() }
}

fn law(mark: Mark) -> LawLine {
    LawLine { law: NASTY.into(), demand: NASTY.into(), mark, detail: NASTY.into() }
}

fn page() -> Page {
    let table = Table {
        heads: vec![NASTY.into(), "h".into(), "note".into()],
        rows: vec![vec![NASTY.into(), "\u{2212}1.5".into()], vec!["b".into(), "2".into(), NASTY.into()]],
    };
    let svg = "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"/>\n".to_owned();
    let section = Section {
        title: NASTY.into(),
        paragraphs: vec![NASTY.into()],
        tables: vec![(NASTY.into(), table)],
        claims: vec![claim(true), claim(false)],
        figures: vec![Figure { caption: NASTY.into(), svg }],
        laws: vec![law(Mark::Held), law(Mark::Broken), law(Mark::NotExpected)],
        listings: vec![Listing { caption: NASTY.into(), text: NASTY.into() }],
        files: vec![Link::new(NASTY, NASTY)],
    };
    let sections = vec![section.clone(), section];
    Page { title: NASTY.into(), lead: NASTY.into(), sections, footer: NASTY.into() }
}

#[test]
fn every_text_is_escaped() {
    let text = html(&page());
    assert!(!text.contains("<script") && !text.contains("\"a\""));
    // Title twice, lead, footer; in each part: its head and link, a paragraph, a caption and its label, three cells,
    // two sentences, two lines of numbers and a caption; three laws of three texts, a listing of two, a link of three.
    assert_eq!(text.matches(SAFE).count(), 4 + 2 * (13 + 9 + 2 + 3));
}

#[test]
fn every_element_is_closed() {
    let text = html(&page());
    let names = "html head body title style main header nav section h1 h2 p ul li table caption thead tbody tr td div \
                 figure figcaption footer strong span q a b pre code";
    for name in names.split_whitespace() {
        let opened = text.matches(&format!("<{name}>")).count() + text.matches(&format!("<{name} ")).count();
        assert_eq!(opened, text.matches(&format!("</{name}>")).count(), "{name}");
        assert!(opened > 0, "{name}");
    }
}

#[test]
fn the_page_needs_nothing_from_outside() {
    let text = html(&page()).replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    for outside in ["http:", "https:", "src=", "@import", "url(", "<link", "<?xml"] {
        assert!(!text.contains(outside), "{outside}");
    }
}

#[test]
fn claims_say_it_in_words() {
    let text = html(&page());
    assert_eq!(text.matches("</span> holds</strong>").count(), 2);
    assert_eq!(text.matches("</span> does not hold here</strong>").count(), 2);
    assert_eq!(text.matches("<q>").count(), 2, "what is not the paper's words is in no quotation marks");
}

/// A page of a run used to have its laws as plain lines, and its scenario as a paragraph a line.
#[test]
fn laws_have_marks_and_texts_can_be_copied() {
    let text = html(&page());
    for mark in ["held", "broken", "broken, not expected to hold"] {
        assert_eq!(text.matches(&format!("</span> {mark}</strong>")).count(), 2, "{mark}");
    }
    let listing = Listing { caption: String::new(), text: "a = 1\n\n[b]\n  c = 2\n".into() };
    let section = Section { listings: vec![listing], ..Section::default() };
    let text = html(&Page { sections: vec![section], ..Page::default() });
    assert!(text.contains("<pre tabindex=\"0\"><code>a = 1\n\n[b]\n  c = 2\n</code></pre>"), "{text}");
}

#[test]
fn short_rows_are_filled_and_numbers_marked() {
    let text = html(&page());
    assert!(text.contains(
        "<td class=\"number\" data-label=\"h\">\u{2212}1.5</td><td data-label=\"note\"></td></tr>"
    ));
}

#[test]
fn an_empty_page_is_a_page() {
    let text = html(&Page::default());
    assert!(text.starts_with("<!DOCTYPE html>") && text.ends_with("</html>\n"));
    assert!(!text.contains("<nav"));
}
