//! Graph files: read with a bound, and refused with the line underlined.

use std::path::Path;

use annotate_snippets::{AnnotationKind, Level, Snippet};
use anyhow::{Result, bail};
use closeranks_graph::formats::{self, Format, FormatError, Named, Problem, TEXT_LIMIT};

use super::Check;
use crate::source::{self, Refused};

/// A graph and where it comes from.
pub(crate) struct Input {
    /// Name of the file.
    pub(crate) name: String,
    /// The graph.
    pub(crate) named: Named,
}

/// Longest part of a line that is shown, bytes.
const SHOWN: usize = 160;

/// Longest recording that is read, bytes.
const RECORDING_MAX: usize = 1 << 26;

/// A graph or a recorded run.
pub(super) enum Source {
    /// One graph.
    Graph(Input),
    /// A Parquet file and its name.
    Recording(String, Vec<u8>),
}

/// Reads a file, and checks it if it is a graph.
pub(super) fn read(arguments: &Check) -> Result<Source> {
    let name = source::name(&arguments.file);
    let bytes = source::bytes(&arguments.file, "graph", RECORDING_MAX)?;
    if arguments.format.is_none() && bytes.starts_with(b"PAR1") {
        return Ok(Source::Recording(name, bytes));
    }
    if bytes.len() > TEXT_LIMIT {
        bail!("the graph `{name}` is too long: allowed is at most {TEXT_LIMIT} bytes");
    }
    let text = source::decode(bytes, "graph", &name)?;
    graph(arguments, name, &text).map(Source::Graph)
}

fn graph(arguments: &Check, name: String, text: &str) -> Result<Input> {
    let asked = arguments.format.map(super::Format::of_library);
    let ending = arguments.file.extension().and_then(|ending| Format::from_extension(ending.to_str()?));
    let format = asked.or(ending).unwrap_or_else(|| Format::guess(text));
    if arguments.directed && !matches!(format, Format::EdgeList | Format::Matrix) {
        bail!(
            "--directed is not for `{name}`: {} says itself what its edges are; allowed for edge lists and matrices",
            title(format)
        );
    }
    match formats::read(text, format, arguments.directed.then_some(true)) {
        Ok(named) => Ok(Input { name, named }),
        Err(error) => {
            let strange = asked.is_none() && matches!(error.problem, Problem::Unexpected { .. });
            let hint = strange.then(|| {
                format!("read as {}, told by its {}; --format says otherwise", title(format), told_by(ending))
            });
            bail!(picture(&name, text, &error, hint))
        }
    }
}

fn told_by(ending: Option<Format>) -> &'static str {
    if ending.is_some() { "ending" } else { "content" }
}

fn title(format: Format) -> &'static str {
    match format {
        Format::EdgeList => "an edge list",
        Format::Matrix => "a matrix",
        Format::Graph6 => "graph6",
        Format::GraphMl => "GraphML",
        Format::Dot => "DOT",
        Format::Json => "JSON",
    }
}

/// The mistake with its line underlined; lines that are too long to show are cut after the mistake or left out.
fn picture(name: &str, text: &str, error: &FormatError, hint: Option<String>) -> Refused {
    let line = text.lines().nth(error.line.saturating_sub(1)).unwrap_or("");
    let place = place(line, &error.problem);
    let help = hint.map(|hint| Level::NOTE.message(hint));
    if place.end > SHOWN || line.trim().is_empty() {
        let path = format!("{}:{}", Path::new(name).display(), error.line);
        let group = Level::ERROR.primary_title(format!("{path}: {}", error.problem)).elements(help);
        return Refused::new(&[group]);
    }
    let cut = (place.end..=line.len().min(SHOWN)).rev().find(|end| line.is_char_boundary(*end));
    let shown = &line[..cut.unwrap_or(place.end)];
    let snippet = Snippet::source(shown).path(name).line_start(error.line);
    let snippet = snippet.annotation(AnnotationKind::Primary.span(place));
    Refused::new(&[Level::ERROR.primary_title(error.problem.to_string()).element(snippet).elements(help)])
}

/// What was found, if the line has it; else the whole line; its end if nothing was found.
fn place(line: &str, problem: &Problem) -> core::ops::Range<usize> {
    let start = line.len() - line.trim_start().len();
    let end = line.trim_end().len().max(start);
    match problem {
        Problem::Unexpected { found, .. } if found.is_empty() => end.saturating_sub(1)..end,
        Problem::Unexpected { found, .. } => match line.find(found.as_str()) {
            Some(at) => at..at + found.len(),
            None => start..end,
        },
        _ => start..end,
    }
}
