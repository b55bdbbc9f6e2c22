//! Graph files: read with a bound, and refused with the line underlined.

use std::path::Path;

use annotate_snippets::{AnnotationKind, Level, Snippet};
use anyhow::{Context as _, Result, bail};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use closeranks_graph::formats::{
    self, Format, FormatError, NETWORK_TEXT_LIMIT, NetworkReading, Options, Problem, Reading, ToldBy,
};
use closeranks_graph::graph::set::NODE_LIMIT;
use closeranks_report::recording::elsewhere::{is_head, read_csv};
use closeranks_report::recording::{ReadError, Recording, read as read_parquet};

use super::Check;
use crate::source::{self, Refused};

/// A graph and where it comes from.
pub(crate) struct Input {
    /// Name of the file.
    pub(crate) name: String,
    /// The graph, and what it was read as.
    pub(crate) reading: Reading,
}

/// Longest part of a line that is shown, bytes.
const SHOWN: usize = 160;

/// Longest recording that is read, bytes.
const RECORDING_MAX: usize = 1 << 26;

/// A network of more robots than exact search takes, and where it comes from.
pub(super) struct NetworkInput {
    /// Name of the file.
    pub(super) name: String,
    /// The network, and what it was read as.
    pub(super) reading: NetworkReading,
    /// Whether all names are numbers.
    numbered: bool,
}

impl NetworkInput {
    /// The name of a node: a number if every name of the network is one.
    pub(super) fn value(&self, node: usize) -> serde_json::Value {
        let name = self.reading.names.get(node).map_or("", String::as_str);
        match name.parse::<u64>() {
            Ok(number) if self.numbered => number.into(),
            _ => name.into(),
        }
    }
}

/// A graph or a recorded run.
pub(super) enum Source {
    /// One graph.
    Graph(Input),
    /// One that is too large for exact search.
    Network(NetworkInput),
    /// Recorded positions and the name of their file.
    Recording(String, Recording),
}

/// Reads a file, and checks it if it is a graph.
pub(super) fn read(arguments: &Check) -> Result<Source> {
    let name = source::name(&arguments.file);
    let bytes = source::bytes(&arguments.file, "graph", NETWORK_TEXT_LIMIT)?;
    let recorded = bytes.starts_with(b"PAR1") || is_table(&bytes);
    if arguments.format.is_none() && recorded && bytes.len() > RECORDING_MAX {
        bail!("the recording `{name}` is too long: allowed is at most {RECORDING_MAX} bytes");
    }
    if arguments.format.is_none() && bytes.starts_with(b"PAR1") {
        return recording(name, read_parquet(bytes));
    }
    if arguments.format.is_none() && is_table(&bytes) {
        let text = decode(bytes, &name)?;
        return recording(name, read_csv(&text));
    }
    let text = decode(bytes, &name)?;
    graph(arguments, name, &text)
}

fn recording(name: String, read: Result<Recording, ReadError>) -> Result<Source> {
    let recording = read.with_context(|| format!("the recording `{name}` cannot be read"))?;
    Ok(Source::Recording(name, recording))
}

/// True if the first line names columns of positions.
fn is_table(bytes: &[u8]) -> bool {
    let line = bytes.split(|byte| matches!(byte, b'\n' | b'\r')).next().unwrap_or(&[]);
    core::str::from_utf8(line).is_ok_and(is_head)
}

/// The formats that `--format` may name.
pub(super) fn formats() -> impl TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::ALL.map(Format::name))
        .try_map(|name| Format::from_name(&name).ok_or("no such format"))
}

/// Bytes as text: UTF-8, or UTF-16 with a mark of its byte order, as Windows writes it.
fn decode(bytes: Vec<u8>, name: &str) -> Result<String> {
    let wide = match bytes.as_slice() {
        [0xff, 0xfe, rest @ ..] => Some((rest, u16::from_le_bytes as fn([u8; 2]) -> u16)),
        [0xfe, 0xff, rest @ ..] => Some((rest, u16::from_be_bytes as fn([u8; 2]) -> u16)),
        [0x1f, 0x8b, ..] => bail!("the graph `{name}` is compressed: allowed is text, as gunzip writes it"),
        _ => None,
    };
    let Some((rest, join)) = wide else {
        return source::decode(bytes, "graph", name);
    };
    let units = rest.chunks(2).map(|pair| join([pair[0], pair.get(1).copied().unwrap_or(0)]));
    let text: Result<String, _> = char::decode_utf16(units).collect();
    match text {
        Ok(text) if rest.len() % 2 == 0 => Ok(text),
        _ => bail!("the graph `{name}` is not text: it begins as UTF-16 but is none"),
    }
}

fn graph(arguments: &Check, name: String, text: &str) -> Result<Source> {
    let ending = arguments.file.extension().and_then(|ending| ending.to_str());
    let options = Options {
        format: arguments.format,
        ending,
        directed: arguments.directed.then_some(true).or(arguments.undirected.then_some(false)),
        transpose: arguments.transpose,
        strict: arguments.strict,
        weights: arguments.weights,
        which: arguments.which.map(|which| which as usize),
    };
    let refused =
        |error: &FormatError, format: Option<Format>| picture(&name, text, error, hint(error, format));
    let (format, told_by) = formats::recognise(text, &options).map_err(|error| refused(&error, None))?;
    refuse_useless(arguments, &name, format)?;
    let reading = match formats::read_as(text, (format, told_by), &options) {
        Ok(reading) => reading,
        Err(error) => bail!(refused(&error, (told_by != ToldBy::Request).then_some(format))),
    };
    if reading.network.node_count() > NODE_LIMIT {
        let number = |name: &String| name.parse::<u64>().is_ok_and(|number| number.to_string() == *name);
        let numbered = reading.names.iter().all(number);
        return Ok(Source::Network(NetworkInput { name, reading, numbered }));
    }
    match reading.small() {
        Ok(reading) => Ok(Source::Graph(Input { name, reading })),
        Err(error) => bail!(refused(&error, None)),
    }
}

/// Options that the format has no use for are refused: who gives them expects something else.
fn refuse_useless(arguments: &Check, name: &str, format: Format) -> Result<()> {
    let title = format.title();
    if (arguments.directed || arguments.undirected) && !format.leaves_direction_open() {
        let option = if arguments.directed { "--directed" } else { "--undirected" };
        bail!(
            "{option} is not for `{name}`: {title} says itself what its edges are; allowed for formats that leave it open"
        );
    }
    if arguments.which.is_some() && format != Format::Graph6 {
        bail!("--which is not for `{name}`: {title} has one graph; allowed for graph6 and its relatives");
    }
    if arguments.weights && !matches!(format, Format::Matrix | Format::MatrixMarket) {
        bail!("--weights is not for `{name}`, read as {title}; allowed for matrices");
    }
    Ok(())
}

/// What else the reader of a message may want to try; `format` as it was told by the content or the ending.
fn hint(error: &FormatError, format: Option<Format>) -> Option<String> {
    let shape = matches!(
        error.problem,
        Problem::Unexpected { .. }
            | Problem::Missing { .. }
            | Problem::Columns { .. }
            | Problem::Count { .. }
            | Problem::UnknownNode { .. }
            | Problem::NodeTwice { .. }
    );
    match (&error.problem, format) {
        (Problem::Ambiguous { .. } | Problem::Doubtful { .. }, _) => {
            Some("--format NAME says which format it is".to_owned())
        }
        (Problem::OneSided { .. }, _) => Some("if it is a directed graph, --directed says so".to_owned()),
        (Problem::DirectionUnclear, _) => Some("--directed or --undirected says which".to_owned()),
        (Problem::Which { .. }, _) => Some("--which K chooses".to_owned()),
        (_, Some(format)) if shape => {
            Some(format!("read as {}; --format NAME says otherwise", format.title()))
        }
        _ => None,
    }
}

/// How the format was found, in words.
pub(super) fn told(told_by: ToldBy) -> &'static str {
    match told_by {
        ToldBy::Content => "by its content",
        ToldBy::Ending => "by its ending",
        ToldBy::Request => "as --format says",
    }
}

/// The mistake with its line underlined; lines that are too long to show are cut after the mistake or left out.
fn picture(name: &str, text: &str, error: &FormatError, hint: Option<String>) -> Refused {
    let text = formats::unix_lines(text);
    let line = text.split('\n').nth(error.line.saturating_sub(1)).unwrap_or("");
    let place = place(line, error);
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

/// What was found, where it was found or first stands in the line; else the whole line; its end if nothing was found.
fn place(line: &str, error: &FormatError) -> core::ops::Range<usize> {
    let start = line.len() - line.trim_start().len();
    let end = line.trim_end().len().max(start);
    let Problem::Unexpected { found, .. } = &error.problem else {
        return start..end;
    };
    if found.is_empty() {
        return end.saturating_sub(1)..end;
    }
    let known =
        error.column.filter(|&at| line.get(at..).is_some_and(|rest| rest.starts_with(found.as_str())));
    match known.or_else(|| line.find(found.as_str())) {
        Some(at) => at..at + found.len(),
        None => start..end,
    }
}
