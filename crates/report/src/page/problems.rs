//! What is wrong with a scenario, with the lines underlined.

use core::fmt::Write as _;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use closeranks_sim::parse::Problem;

/// Mistakes shown; a file with more has other troubles.
const SHOWN: usize = 20;

/// Every mistake in the `text` of a scenario that messages call `name`, with its line underlined.
#[must_use]
pub fn picture(renderer: &Renderer, name: &str, text: &str, problems: &[Problem]) -> String {
    let mut out = String::new();
    for problem in problems.iter().take(SHOWN) {
        if !out.is_empty() {
            out.push('\n');
        }
        out.push_str(&renderer.render(&[group(name, text, problem)]));
        out.push('\n');
    }
    if problems.len() > SHOWN {
        let _ = writeln!(out, "and {} more", problems.len() - SHOWN);
    }
    out
}

fn group<'a>(name: &'a str, text: &'a str, problem: &'a Problem) -> Group<'a> {
    let (title, label) = if problem.field.is_empty() {
        (problem.found.clone(), String::new())
    } else {
        (format!("`{}` is {}", problem.field, problem.found), format!("allowed is {}", problem.allowed))
    };
    let annotation = AnnotationKind::Primary.span(visible(text, problem)).label(label);
    let snippet = Snippet::source(text).path(name).annotation(annotation);
    Level::ERROR.primary_title(title).element(snippet)
}

/// The first line of the place: a table that spans many is marked at its head.
fn visible(text: &str, problem: &Problem) -> core::ops::Range<usize> {
    let start = problem.span.start.min(text.len());
    let end = problem.span.end.clamp(start, text.len());
    let line_end = text.get(start..end).and_then(|part| part.find('\n')).map_or(end, |length| start + length);
    start..line_end
}
