//! The page: what is in it, and that nothing of it is taken for markup.

use closeranks_report::content::{Claim, Figure, Page, Section, Table};
use closeranks_report::html::html;

const NASTY: &str = "</title><script>\"a\" & 'b'</script>";
const SAFE: &str = "&lt;/title&gt;&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/script&gt;";

fn claim(holds: bool) -> Claim {
    Claim { sentence: NASTY.into(), holds, numbers: NASTY.into() }
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
    };
    let sections = vec![section.clone(), section];
    Page { title: NASTY.into(), lead: NASTY.into(), sections, footer: NASTY.into() }
}

#[test]
fn every_text_is_escaped() {
    let text = html(&page());
    assert!(!text.contains("<script") && !text.contains("\"a\""));
    // Title twice, lead, footer; in each part: its head and link, a paragraph, a caption and its label, three cells,
    // two sentences, two lines of numbers and a caption.
    assert_eq!(text.matches(SAFE).count(), 4 + 2 * 13);
}

#[test]
fn every_element_is_closed() {
    let text = html(&page());
    let names = "html head body title style main header nav section h1 h2 p ul li table caption thead tbody tr td div \
                 figure figcaption footer strong span q a";
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
}

#[test]
fn short_rows_are_filled_and_numbers_marked() {
    let text = html(&page());
    assert!(text.contains("<td class=\"number\">\u{2212}1.5</td><td></td></tr>"));
}

#[test]
fn an_empty_page_is_a_page() {
    let text = html(&Page::default());
    assert!(text.starts_with("<!DOCTYPE html>") && text.ends_with("</html>\n"));
    assert!(!text.contains("<nav"));
}
