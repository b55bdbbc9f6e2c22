//! Texts that say they are graphs.

use std::collections::BTreeSet;

use closeranks_graph::formats::{Format, FormatError, Named, TEXT_LIMIT, read, write};

/// Any text is, in each format, a graph or an error with its line; a graph that is written and read again is the same.
pub fn graph(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    assert!(Format::ALL.contains(&Format::guess(&text)));
    for format in Format::ALL {
        for directed in [None, Some(false), Some(true)] {
            match read(&text, format, directed) {
                Ok(named) => rewrite(&named),
                Err(error) => is_placed(&error, &text),
            }
        }
    }
}

fn is_placed(error: &FormatError, text: &str) {
    assert!(!error.problem.to_string().is_empty());
    let lines = text.split('\n').count();
    assert!((1..=lines).contains(&error.line), "{error} in a text of {lines} lines");
}

/// Writes `named` in each format and reads it back.
fn rewrite(named: &Named) {
    assert_eq!(named.names.len(), named.graph.node_count());
    assert_eq!(named.names.iter().collect::<BTreeSet<_>>().len(), named.names.len(), "names differ");
    for format in Format::ALL {
        let text = match write(named, format) {
            Ok(text) if text.len() <= TEXT_LIMIT => text,
            Ok(_) => continue,
            Err(error) => {
                assert!(!error.to_string().is_empty());
                continue;
            }
        };
        let again = read(&text, format, None).unwrap_or_else(|error| panic!("{format:?}: {error}\n{text}"));
        let same = match format {
            Format::Matrix | Format::Graph6 => again.graph == named.graph,
            Format::GraphMl | Format::Json => again == *named,
            Format::EdgeList | Format::Dot => by_name(&again) == by_name(named),
        };
        assert!(same, "{format:?}: {named:?} became {again:?}\n{text}");
    }
}

/// The same whatever the order of nodes: these formats put nodes whose names are numbers in their order.
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
