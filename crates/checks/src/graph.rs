//! Texts that say they are graphs.

use std::collections::BTreeSet;

use closeranks_graph::formats::{
    Format, FormatError, Named, Options, Problem, Reading, TEXT_LIMIT, read, recognise, unix_lines, write,
};

/// Any text is, in each format, a graph or an error with its line; a graph that is written and read again is the same.
pub fn graph(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for format in Format::ALL {
        one_format(&text, format);
    }
    choice(&text);
}

/// Any text is a graph in the format that is found, or an error with its line. It is read once and not written, where [`graph`] reads it some
/// hundred times.
pub fn graph_text(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match read(&text, &Options::default()) {
        Ok(reading) => assert_eq!(reading.named.names.len(), reading.named.graph.node_count()),
        Err(error) => is_placed(&error, &text),
    }
}

/// Checks one format only, given by its name, so that a fuzzer can dig deeper there.
pub fn graph_as(name: &str, bytes: &[u8]) {
    let format = Format::from_name(name).expect("a format");
    one_format(&String::from_utf8_lossy(bytes), format);
}

/// What holds of one reader, whatever the direction and strictness asked for.
fn one_format(text: &str, format: Format) {
    for directed in [None, Some(false), Some(true)] {
        let options = Options { format: Some(format), directed, ..Options::default() };
        let lenient = read(text, &options);
        match &lenient {
            Ok(reading) => rewrite(&reading.named),
            Err(error) => is_placed(error, text),
        }
        let strict = read(text, &Options { strict: true, ..options });
        if let Ok(strict) = strict {
            assert_eq!(Ok(&strict), lenient.as_ref(), "strictness only refuses");
        }
        if let Ok(reading) = lenient {
            is_turned(text, &reading, &Options { transpose: true, ..options });
        }
    }
}

/// Transposing turns every edge of a directed graph round and leaves others as they are.
fn is_turned(text: &str, reading: &Reading, transpose: &Options<'_>) {
    let turned = read(text, transpose).expect("transposing refuses nothing").named;
    let graph = &reading.named.graph;
    let is_edge = |(from, to)| turned.graph.has_edge(to, from);
    assert!(graph.edges().all(is_edge) && turned.graph.edge_count() == graph.edge_count());
}

/// Without a format asked for, the text is read as the one that is recognised; or it is refused because two formats or more fit, or none does. An ending never makes a text of one format one of another.
fn choice(text: &str) {
    let options = Options::default();
    match (recognise(text, &options), read(text, &options)) {
        (Ok((format, _)), found) => {
            let asked = read(text, &Options { format: Some(format), ..options });
            let same = |a: &Reading, b: &Reading| a.named == b.named && a.notes == b.notes;
            match (&found, &asked) {
                (Ok(found), Ok(asked)) => assert!(found.format == format && same(found, asked)),
                (found, asked) => assert_eq!(found.as_ref().err(), asked.as_ref().err()),
            }
            let other = read(text, &Options { ending: Some("graph"), ..options });
            if let (Ok(found), Ok(other)) = (found, other) {
                assert_eq!(found.named, other.named, "an ending changes nothing that is clear");
            }
        }
        (Err(error), found) => {
            let unclear = match &error.problem {
                Problem::Ambiguous { formats } => formats.len() > 1,
                problem => matches!(problem, Problem::Doubtful { .. }),
            };
            assert!(unclear && found.as_ref().err() == Some(&error), "{error}");
        }
    }
}

fn is_placed(error: &FormatError, text: &str) {
    assert!(!error.problem.to_string().is_empty());
    let lines = unix_lines(text).split('\n').count();
    assert!((1..=lines).contains(&error.line), "{error} in a text of {lines} lines");
}

/// Writes `named` in each format and reads it back.
fn rewrite(named: &Named) {
    assert_eq!(named.names.len(), named.graph.node_count());
    assert_eq!(named.names.iter().collect::<BTreeSet<_>>().len(), named.names.len(), "names differ");
    for format in Format::ALL.into_iter().filter(|format| format.is_written()) {
        let text = match write(named, format) {
            Ok(text) if text.len() <= TEXT_LIMIT => text,
            Ok(_) => continue,
            Err(error) => {
                assert!(!error.to_string().is_empty());
                continue;
            }
        };
        let asked = Options { format: Some(format), ..Options::default() };
        let again = read(&text, &asked).unwrap_or_else(|error| panic!("{format:?}: {error}\n{text}")).named;
        let same = match format {
            Format::Matrix | Format::Graph6 => again.graph == named.graph,
            Format::GraphMl | Format::Json => again == *named,
            _ => by_name(&again) == by_name(named),
        };
        assert!(same, "{format:?}: {named:?} became {again:?}\n{text}");
    }
}

/// What two graphs share that differ only in the order of their nodes. Some formats sort nodes whose names are numbers.
fn by_name(named: &Named) -> (bool, BTreeSet<&str>, BTreeSet<[&str; 2]>) {
    let directed = named.graph.is_directed();
    let ends = |(from, to): (usize, usize)| {
        let mut ends = [named.names[from].as_str(), named.names[to].as_str()];
        if !directed {
            ends.sort_unstable();
        }
        ends
    };
    (directed, named.names.iter().map(String::as_str).collect(), named.graph.edges().map(ends).collect())
}
